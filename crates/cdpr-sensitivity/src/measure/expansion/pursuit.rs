//! Sparse least squares by orthogonal matching pursuit, its size chosen by the leave-one-out error.
//!
//! With r the residual, the next column is that of the largest correlation with it; the chosen columns are kept
//! factored, X = Q R, so that each step costs one pass over the candidates:
//!
//! ```text
//! j = argmax |x_j · r| / |x_j|                                            (1)
//! r ← r - (q · r) q,   q = x_j less its projections on Q, normalised      (2)
//! h_i = Σ q_i²                                                            (3)
//! ε = mean((r_i / (1 - h_i))²) / Var y · n / (n - P) · (1 + tr (Xᵀ X)⁻¹)      (4)
//! |x_j · r| / |x_j| ≤ √(2 ln p) |r| / √(n - P)                             (5)
//! ```
//!
//! (1), (2): Y. C. Pati, R. Rezaiifar, P. S. Krishnaprasad, *Orthogonal matching pursuit* (1993). (4) is the leave-one-out
//! error of P terms from one fit, by its leverages (3), times the correction of O. Chapelle, V. Vapnik, Y. Bengio (2002)
//! for small n, as G. Blatman and B. Sudret (2011) choose the terms of chaos expansions.
//!
//! (4) does not know that the terms were looked for: the best of p candidates fits even noise, and many such terms make an
//! ε that is too small by a third. So the path ends at (5), where the best of the p candidates is no better than that
//! of noise would be: T. T. Cai, L. Wang, *Orthogonal matching pursuit for sparse signal recovery with noise*, IEEE Trans.
//! Inf. Theory 57 (2011).

use rayon::prelude::*;

use crate::sample::summary::mean_and_squares;

/// A sparse least-squares model.
pub(crate) struct Pursuit {
    pub(crate) constant: f64,
    /// Candidate and its coefficient.
    pub(crate) terms: Vec<(usize, f64)>,
    /// ε (4).
    pub(crate) error: f64,
}

/// The model of the least ε along the path, at most half as many terms as values. `columns` are the candidates beside the
/// constant; `y` holds at least two different values.
pub(crate) fn pursue(columns: &[Vec<f64>], y: &[f64]) -> Pursuit {
    let limit = columns.len().min(y.len() / 2);
    let squares = mean_and_squares(y).1;
    // A column of zeros is no candidate, but correlates with nothing.
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

/// Eq. (1), with the correlation; `None` when no candidate is left.
fn closest(columns: &[Vec<f64>], norms: &[f64], open: &[bool], residual: &[f64]) -> Option<(usize, f64)> {
    let correlation = |j: usize| (j, dot(&columns[j], residual).abs() / norms[j]);
    let left: Vec<_> = (0..columns.len()).into_par_iter().filter(|&j| open[j]).map(correlation).collect();
    left.into_iter().reduce(|best, other| if other.1 > best.1 { other } else { best })
}

/// In eight sums, which the processor adds at once.
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

/// X = Q R of the columns chosen so far, the constant first.
struct Path {
    q: Vec<Vec<f64>>,
    /// Columns of R⁻¹, without the zeros.
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

    /// Takes in a column, Eq. (2), unless it depends on the others.
    fn push(&mut self, column: &[f64]) -> bool {
        /// Distance from the space of the others over length.
        const DEPENDENT: f64 = 1e-8;
        let mut q = column.to_vec();
        let mut r = vec![0.0; self.q.len()];
        // Twice is enough (W. Kahan): Gram and Schmidt's method, repeated, is as orthogonal as Householder's.
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

    /// `|r| / √(n - P)`.
    fn noise(&self) -> f64 {
        (dot(&self.residual, &self.residual) / (self.residual.len() - self.q.len()) as f64).sqrt()
    }

    /// ε (4), infinite where one value has all the leverage.
    fn corrected_error(&self, squares: f64) -> f64 {
        let n = self.residual.len() as f64;
        let left_out = |(r, h): (&f64, &f64)| if *h < 1.0 { (r / (1.0 - h)).powi(2) } else { f64::INFINITY };
        let sum: f64 = self.residual.iter().zip(&self.leverages).map(left_out).sum();
        let trace: f64 = self.inverse.iter().map(|column| dot(column, column)).sum();
        sum / squares * n / (n - self.q.len() as f64) * (1.0 + trace)
    }

    /// R⁻¹ Qᵀ y of the first `count` columns.
    fn coefficients(&self, count: usize) -> Vec<f64> {
        let mut coefficients = vec![0.0; count];
        for (column, projection) in self.inverse[..count].iter().zip(&self.projections) {
            add(&mut coefficients, *projection, column);
        }
        coefficients
    }
}

/// `sum += factor * vector`, as far as the vector goes.
fn add(sum: &mut [f64], factor: f64, vector: &[f64]) {
    sum.iter_mut().zip(vector).for_each(|(sum, entry)| *sum += factor * entry);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::least_squares::{LeastSquares, least_squares};

    #[test]
    fn the_error_is_that_of_fits_without_each_value_and_the_coefficients_are_those_of_householder() {
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
        let (_, squares) = mean_and_squares(&y);
        let corrected = sum / squares * 12.0 / 9.0 * (1.0 + whole.inverse_gram.iter().sum::<f64>());
        assert!((path.corrected_error(squares) / corrected - 1.0).abs() < 1e-10);
        for (one, other) in path.coefficients(3).iter().zip(&whole.coefficients) {
            assert!((one - other).abs() < 1e-12);
        }
        assert!((path.noise().powi(2) * 9.0 / whole.residual_squares - 1.0).abs() < 1e-10);
    }
}
