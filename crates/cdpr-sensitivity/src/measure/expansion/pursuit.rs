//! Sparse least squares by orthogonal matching pursuit. The leave-one-out error decides the number of terms.
//!
//! With r the residual, the next column is the one with the largest correlation with r. The chosen columns
//! are kept factored, X = Q R, so that each step costs one pass over the candidates:
//!
//! ```text
//! j = argmax |x_j · r| / |x_j|                                            (Z1)
//! r ← r - (q · r) q,   q = x_j less its projections on Q, normalised      (Z2)
//! h_i = Σ q_i²                                                            (Z3)
//! ε = mean((r_i / (1 - h_i))²) / Var y · n / (n - P) · (1 + tr (Xᵀ X)⁻¹)      (Z4)
//! |x_j · r| / |x_j| ≤ √(2 ln p) |r| / √(n - P)                             (Z5)
//! ```
//!
//! - (Z1), (Z2): Y. C. Pati, R. Rezaiifar, P. S. Krishnaprasad, *Orthogonal matching pursuit* (1993).
//! - (Z4) is the leave-one-out error of P terms, which follows from one fit by its leverages (Z3), times the
//!   correction of O. Chapelle, V. Vapnik, Y. Bengio, *Model selection for small sample regression* (2002).
//!   G. Blatman and B. Sudret (2011) choose the terms of chaos expansions in this way.
//! - (Z5) ends the path: T. T. Cai, L. Wang, *Orthogonal matching pursuit for sparse signal recovery with
//!   noise*, IEEE Trans. Inf. Theory 57 (2011).
//!
//! (Z4) does not account for the choice among candidates. The best of p candidates fits even noise, and many
//! such terms make ε too small by a third. The path therefore ends where the best of the p candidates
//! correlates no better than the best of p candidates would with noise.

use crate::parallel::*;
use crate::sample::summary::Spread;

/// Sparse least-squares model.
pub(crate) struct Pursuit {
    pub(crate) constant: f64,
    /// Indices of the candidates and their coefficients.
    pub(crate) terms: Vec<(usize, f64)>,
    /// Error ε (Z4).
    pub(crate) error: f64,
}

/// Finds the model of the least ε along the path. It has at most half as many terms as there are values.
///
/// `columns` are the candidates besides the constant. `y` holds at least two different values.
pub(crate) fn pursue(columns: &[Vec<f64>], y: &[f64]) -> Pursuit {
    let limit = columns.len().min(y.len() / 2);
    let squares = Spread::of(y).squares;
    // A column of zeros has no norm, but it correlates with nothing either.
    let norm = |column: &Vec<f64>| dot(column, column).sqrt().max(f64::MIN_POSITIVE);
    let norms: Vec<f64> = columns.par_iter().map(norm).collect();
    let mut open = vec![true; columns.len()];
    let mut path = Path::new(y);
    let mut chosen = Vec::new();
    let mut best = (path.corrected_error(squares), 0);
    while chosen.len() < limit {
        let noise = path.noise();
        let Some((j, correlation)) = closest(columns, &norms, &open, &path.residual) else {
            break;
        };
        if correlation <= (2.0 * (columns.len() as f64).ln()).sqrt() * noise {
            break;
        }
        open[j] = false;
        if path.push(&columns[j]) {
            chosen.push(j);
            let error = path.corrected_error(squares);
            if error < best.0 {
                best = (error, chosen.len());
            }
        }
    }
    let (error, terms) = best;
    let coefficients = path.coefficients(terms + 1);
    Pursuit {
        constant: coefficients[0],
        terms: chosen.into_iter().zip(coefficients[1..].iter().copied()).collect(),
        error,
    }
}

/// Next candidate (Z1) and its correlation, or `None` if no candidate is left.
fn closest(columns: &[Vec<f64>], norms: &[f64], open: &[bool], residual: &[f64]) -> Option<(usize, f64)> {
    let correlation = |j: usize| (j, dot(&columns[j], residual).abs() / norms[j]);
    let left: Vec<_> = (0..columns.len()).into_par_iter().filter(|&j| open[j]).map(correlation).collect();
    left.into_iter().reduce(|best, other| if other.1 > best.1 { other } else { best })
}

/// Dot product in eight partial sums, which the processor adds at once.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a_eights, a_rest) = a.as_chunks::<8>();
    let (b_eights, b_rest) = b.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (a, b) in a_eights.iter().zip(b_eights) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    sums.iter().sum::<f64>() + a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f64>()
}

/// Factors X = Q R of the columns chosen so far, with the constant first.
struct Path {
    q: Vec<Vec<f64>>,
    /// Columns of R⁻¹ without their zeros.
    inverse: Vec<Vec<f64>>,
    /// Qᵀ y.
    projections: Vec<f64>,
    residual: Vec<f64>,
    leverages: Vec<f64>,
}

impl Path {
    fn new(y: &[f64]) -> Self {
        let mut path = Self {
            q: vec![],
            inverse: vec![],
            projections: vec![],
            residual: y.to_vec(),
            leverages: vec![0.0; y.len()],
        };
        path.push(&vec![1.0; y.len()]);
        path
    }

    /// Adds a column, Eq. (Z2), unless it depends linearly on the others.
    fn push(&mut self, column: &[f64]) -> bool {
        /// Least distance of a column from the space of the others, over its length.
        const DEPENDENT: f64 = 1e-8;
        let mut q = column.to_vec();
        let mut r = vec![0.0; self.q.len()];
        // Gram and Schmidt's method, applied twice, is as orthogonal as Householder's (W. Kahan: "twice is
        // enough").
        for _ in 0..2 {
            for (r, other) in r.iter_mut().zip(&self.q) {
                let projection = dot(&q, other);
                *r += projection;
                add(&mut q, -projection, other);
            }
        }
        let norm = dot(&q, &q).sqrt();
        if norm <= DEPENDENT * dot(column, column).sqrt() {
            return false;
        }
        q.iter_mut().for_each(|q| *q /= norm);
        let mut inverse = vec![0.0; r.len() + 1];
        inverse[r.len()] = 1.0 / norm;
        for (column, r) in self.inverse.iter().zip(&r) {
            add(&mut inverse, -r / norm, column);
        }
        let projection = dot(&q, &self.residual);
        add(&mut self.residual, -projection, &q);
        self.leverages.iter_mut().zip(&q).for_each(|(leverage, q)| *leverage += q * q);
        self.projections.push(projection);
        self.inverse.push(inverse);
        self.q.push(q);
        true
    }

    /// Deviation of the residual, `|r| / √(n - P)`.
    fn noise(&self) -> f64 {
        (dot(&self.residual, &self.residual) / (self.residual.len() - self.q.len()) as f64).sqrt()
    }

    /// Error ε (Z4). It is infinite if one value has a leverage of 1.
    fn corrected_error(&self, squares: f64) -> f64 {
        let n = self.residual.len() as f64;
        let left_out = |(r, h): (&f64, &f64)| if *h < 1.0 { (r / (1.0 - h)).powi(2) } else { f64::INFINITY };
        let sum: f64 = self.residual.iter().zip(&self.leverages).map(left_out).sum();
        let trace: f64 = self.inverse.iter().map(|column| dot(column, column)).sum();
        sum / squares * n / (n - self.q.len() as f64) * (1.0 + trace)
    }

    /// Coefficients R⁻¹ Qᵀ y of the first `count` columns.
    fn coefficients(&self, count: usize) -> Vec<f64> {
        let mut coefficients = vec![0.0; count];
        for (column, projection) in self.inverse[..count].iter().zip(&self.projections) {
            add(&mut coefficients, *projection, column);
        }
        coefficients
    }
}

/// Adds `factor * vector` to the first elements of `sum`.
fn add(sum: &mut [f64], factor: f64, vector: &[f64]) {
    sum.iter_mut().zip(vector).for_each(|(sum, entry)| *sum += factor * entry);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::linear_algebra::{LeastSquares, least_squares};

    #[test]
    fn the_error_is_that_of_fits_that_leave_out_each_value_and_the_coefficients_are_those_of_householder() {
        let x: Vec<f64> = (0..12).map(|i| (1.7 * f64::from(i)).sin()).collect();
        let y: Vec<f64> = x.iter().enumerate().map(|(i, x)| x + x * x + 0.3 * (i as f64).cos()).collect();
        let columns = [vec![1.0; 12], x.clone(), x.iter().map(|x| x.exp()).collect()];
        let mut path = Path::new(&y);
        assert!(path.push(&columns[1]) && path.push(&columns[2]) && !path.push(&columns[1]));

        let without = |values: &[f64], i: usize| [&values[..i], &values[i + 1..]].concat();
        let left_out = |i: usize| {
            let rest: Vec<_> = columns.iter().map(|column| without(column, i)).collect();
            let LeastSquares { coefficients, .. } =
                least_squares(&rest, &without(&y, i)).unwrap_or_else(|j| panic!("{j}"));
            y[i] - columns.iter().zip(&coefficients).map(|(column, c)| c * column[i]).sum::<f64>()
        };
        let sum: f64 = (0..12).map(|i| left_out(i).powi(2)).sum();
        let whole = least_squares(&columns, &y).unwrap_or_else(|j| panic!("{j}"));
        let squares = Spread::of(&y).squares;
        let corrected = sum / squares * 12.0 / 9.0 * (1.0 + whole.inverse_gram.iter().sum::<f64>());
        assert!((path.corrected_error(squares) / corrected - 1.0).abs() < 1e-10);
        for (one, other) in path.coefficients(3).iter().zip(&whole.coefficients) {
            assert!((one - other).abs() < 1e-12);
        }
        assert!((path.noise().powi(2) * 9.0 / whole.residual_squares - 1.0).abs() < 1e-10);
    }
}
