//! Linear least squares by Householder's QR factorization, and eigenvectors of symmetric matrices. No other
//! module of this crate names faer. Without the feature `faer` the reflections are formed here, column by
//! column; results agree up to rounding. Eigenvectors need the feature.
//!
//! ```text
//! X = Q R,   b = R⁻¹ Qᵀ y,   (Xᵀ X)⁻¹ = R⁻¹ R⁻ᵀ                           (La1)
//! A = W Λ Wᵀ,   λ_1 >= λ_2 >= ..                                          (La2)
//! ```
//!
//! G. H. Golub, C. F. Van Loan, *Matrix computations*, 4th ed. (2013), sections 5.3 and 8.3.

#[cfg(feature = "faer")]
use by_faer::solve;
#[cfg(feature = "faer")]
pub(crate) use by_faer::symmetric_eigen;
#[cfg(not(feature = "faer"))]
use by_reflections::solve;

/// Solution of `min |y - X b|`.
pub(crate) struct LeastSquares {
    /// Coefficients b, one per column.
    pub(crate) coefficients: Vec<f64>,
    /// Diagonal of `(Xᵀ X)⁻¹`.
    pub(crate) inverse_gram: Vec<f64>,
    /// `|y - X b|²`.
    pub(crate) residual_squares: f64,
}

/// Solves the least-squares problem (La1).
///
/// # Errors
/// The index of the first column that depends on those before it: its length is at least 1e10 times its
/// distance from their space.
pub(crate) fn least_squares(columns: &[Vec<f64>], y: &[f64]) -> Result<LeastSquares, usize> {
    solve(columns, y)
}

const DEPENDENT: f64 = 1e-10;

#[cfg(feature = "faer")]
mod by_faer {
    use faer::linalg::solvers::{Qr, SelfAdjointEigen, SolveLstsq};
    use faer::linalg::triangular_solve::solve_upper_triangular_in_place;
    use faer::{Mat, Par, Side};

    use crate::measure::linear_algebra::{DEPENDENT, LeastSquares};

    pub(super) fn solve(columns: &[Vec<f64>], y: &[f64]) -> Result<LeastSquares, usize> {
        let (n, k) = (y.len(), columns.len());
        let x = Mat::from_fn(n, k, |i, j| columns[j][i]);
        let qr = Qr::new(x.as_ref());
        let r = qr.thin_R();
        let dependent = |j: &usize| r[(*j, *j)].abs() <= DEPENDENT * x.col(*j).norm_l2();
        if let Some(j) = (0..k).find(dependent) {
            return Err(j);
        }
        let right = Mat::from_fn(n, 1, |i, _| y[i]);
        let solution = qr.solve_lstsq(&right);
        let residual = right - x * &solution;
        let mut inverse = Mat::<f64>::identity(k, k);
        solve_upper_triangular_in_place(r, inverse.as_mut(), Par::Seq);
        Ok(LeastSquares {
            coefficients: (0..k).map(|j| solution[(j, 0)]).collect(),
            inverse_gram: (0..k).map(|j| inverse.row(j).squared_norm_l2()).collect(),
            residual_squares: residual.squared_norm_l2(),
        })
    }

    /// Eigenvalues (La2) of a symmetric matrix of finite entries in descending order, and the unit
    /// eigenvector of each. The first component of a vector that is not zero is positive. Entries above the
    /// diagonal do not count.
    ///
    /// # Errors
    /// The number of rows, if the iteration does not converge.
    pub(crate) fn symmetric_eigen(a: &[Vec<f64>]) -> Result<(Vec<f64>, Vec<Vec<f64>>), usize> {
        let n = a.len();
        let matrix = Mat::from_fn(n, n, |i, j| a[i][j]);
        let found = SelfAdjointEigen::new(matrix.as_ref(), Side::Lower).map_err(|_| n)?;
        let pair = |j: usize| {
            let vector: Vec<f64> = found.U().col(j).iter().copied().collect();
            let sign = vector.iter().find(|x| **x != 0.0).map_or(1.0, |first| first.signum());
            (found.S()[j], vector.iter().map(|x| sign * x).collect())
        };
        let mut pairs: Vec<(f64, Vec<f64>)> = (0..n).map(pair).collect();
        pairs.sort_by(|one, other| other.0.total_cmp(&one.0));
        Ok(pairs.into_iter().unzip())
    }
}

#[cfg(any(test, not(feature = "faer")))]
mod by_reflections {
    use crate::measure::linear_algebra::{DEPENDENT, LeastSquares};

    pub(super) fn solve(columns: &[Vec<f64>], y: &[f64]) -> Result<LeastSquares, usize> {
        let k = columns.len();
        let (mut a, mut right) = (columns.to_vec(), y.to_vec());
        let mut diagonal = vec![0.0; k];
        for j in 0..k {
            let length = norm(&columns[j]);
            let (head, tail) = a.split_at_mut(j + 1);
            // The vector v of the reflection 1 - 2 v vᵀ / vᵀ v, in place of the column below its row j.
            let v = &mut head[j][j..];
            let size = norm(v);
            if size <= DEPENDENT * length {
                return Err(j);
            }
            diagonal[j] = if v[0] > 0.0 { -size } else { size };
            v[0] -= diagonal[j];
            let squares = dot(v, v);
            for column in tail.iter_mut().chain([&mut right]) {
                let column = &mut column[j..];
                let factor = 2.0 * dot(v, column) / squares;
                column.iter_mut().zip(&*v).for_each(|(x, v)| *x -= factor * v);
            }
        }
        // R has its columns above row j in a, and its diagonal beside it.
        let back = |mut b: Vec<f64>| {
            for j in (0..k).rev() {
                b[j] /= diagonal[j];
                for i in 0..j {
                    b[i] -= a[j][i] * b[j];
                }
            }
            b
        };
        let residual_squares = dot(&right[k..], &right[k..]);
        let unit = |j: usize| (0..k).map(|i| f64::from(i == j)).collect();
        let mut inverse_gram = vec![0.0; k];
        for column in (0..k).map(|j| back(unit(j))) {
            inverse_gram.iter_mut().zip(column).for_each(|(sum, x)| *sum += x * x);
        }
        Ok(LeastSquares { coefficients: back(right[..k].to_vec()), inverse_gram, residual_squares })
    }

    fn dot(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    fn norm(a: &[f64]) -> f64 {
        dot(a, a).sqrt()
    }
}

#[cfg(all(test, feature = "faer"))]
mod tests {
    use super::*;
    use crate::sample::random::{stream, uniform};

    #[test]
    fn faer_and_the_reflections_agree() {
        let mut generator = stream(1, 0);
        let mut column = |scale: f64| (0..40).map(|_| scale * (uniform(&mut generator) - 0.4)).collect();
        let mut columns: Vec<Vec<f64>> = [1.0, 1e-3, 1e4, 1.0, 7.0].map(&mut column).to_vec();
        let y = column(1.0);
        let (one, Ok(other)) = (by_faer::solve(&columns, &y), by_reflections::solve(&columns, &y)) else {
            panic!("independent columns");
        };
        let Ok(one) = one else { panic!("independent columns") };
        let near = |x: f64, y: f64| (x - y).abs() <= 1e-12 * x.abs().max(y.abs());
        assert!(one.coefficients.iter().zip(&other.coefficients).all(|(x, y)| near(*x, *y)));
        assert!(one.inverse_gram.iter().zip(&other.inverse_gram).all(|(x, y)| near(*x, *y)));
        assert!(near(one.residual_squares, other.residual_squares));
        columns[3] = columns[0].iter().zip(&columns[1]).map(|(x, y)| x + 3.0 * y).collect();
        assert_eq!(by_faer::solve(&columns, &y).err(), Some(3));
        assert_eq!(by_reflections::solve(&columns, &y).err(), Some(3));
    }

    #[test]
    fn a_matrix_is_the_sum_of_its_eigenvalues_times_the_projections_on_its_eigenvectors() {
        for n in [1, 2, 3, 20, 62] {
            let mut generator = stream(n as u64, 0);
            let half: Vec<f64> = (0..n * n).map(|_| uniform(&mut generator) - 0.5).collect();
            let entry = |i: usize, j: usize| half[n * i.max(j) + i.min(j)];
            let a: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
            let (values, vectors) = symmetric_eigen(&a).unwrap();
            assert!(values.is_sorted_by(|one, other| one >= other));
            for i in 0..n {
                for j in 0..n {
                    let sum: f64 = (0..n).map(|k| values[k] * vectors[k][i] * vectors[k][j]).sum();
                    assert!((sum - a[i][j]).abs() < 1e-12, "{n}: {i} {j}");
                    let product: f64 = vectors[i].iter().zip(&vectors[j]).map(|(x, y)| x * y).sum();
                    assert!((product - f64::from(i == j)).abs() < 1e-12);
                }
            }
        }
    }
}
