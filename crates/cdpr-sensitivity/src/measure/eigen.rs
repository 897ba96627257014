//! Eigenvalues and eigenvectors of symmetric matrices by Jacobi's rotations: G. H. Golub, C. F. Van Loan,
//! *Matrix computations*, 4th ed. (2013), section 8.5.

/// Eigenvalues of a symmetric matrix in descending order, and the unit eigenvector of each. The first
/// component of a vector that is not zero is positive.
pub(crate) fn symmetric_eigen(mut a: Vec<Vec<f64>>) -> (Vec<f64>, Vec<Vec<f64>>) {
    const SWEEPS: usize = 60;
    /// Share of the largest entry below which an entry counts as zero.
    const NEGLIGIBLE: f64 = 1e-3 * f64::EPSILON;
    let n = a.len();
    // Row i of v becomes eigenvector i.
    let mut v: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| f64::from(i == j)).collect()).collect();
    let size = a.iter().flatten().fold(0.0_f64, |size, entry| size.max(entry.abs()));
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for p in 0..n {
            for q in p + 1..n {
                if a[p][q].abs() <= NEGLIGIBLE * size {
                    continue;
                }
                rotated = true;
                let tau = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let t = tau.signum() / (tau.abs() + tau.hypot(1.0));
                let c = 1.0 / t.hypot(1.0);
                rotate(&mut a, p, q, [c, t * c]);
                for row in &mut a {
                    let (x, y) = (row[p], row[q]);
                    (row[p], row[q]) = (c * x - t * c * y, t * c * x + c * y);
                }
                rotate(&mut v, p, q, [c, t * c]);
            }
        }
        if !rotated {
            break;
        }
    }
    let mut pairs: Vec<(f64, Vec<f64>)> = v
        .into_iter()
        .enumerate()
        .map(|(i, mut vector)| {
            if vector.iter().find(|x| **x != 0.0).is_some_and(|first| *first < 0.0) {
                vector.iter_mut().for_each(|x| *x = -*x);
            }
            (a[i][i], vector)
        })
        .collect();
    pairs.sort_by(|one, other| other.0.total_cmp(&one.0));
    pairs.into_iter().unzip()
}

/// Rotates rows p < q by an angle of this cosine and sine.
fn rotate(matrix: &mut [Vec<f64>], p: usize, q: usize, [c, s]: [f64; 2]) {
    let (head, tail) = matrix.split_at_mut(q);
    for (x, y) in head[p].iter_mut().zip(&mut tail[0]) {
        (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::random::{stream, uniform};

    #[test]
    fn a_matrix_is_the_sum_of_its_eigenvalues_times_the_projections_on_its_eigenvectors() {
        for n in [1, 2, 3, 20, 62] {
            let mut generator = stream(n as u64, 0);
            let half: Vec<f64> = (0..n * n).map(|_| uniform(&mut generator) - 0.5).collect();
            let entry = |i: usize, j: usize| half[n * i.max(j) + i.min(j)];
            let a: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
            let (values, vectors) = symmetric_eigen(a.clone());
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
