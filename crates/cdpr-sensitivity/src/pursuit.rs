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
//! ```
//!
//! (1), (2): Y. C. Pati, R. Rezaiifar, P. S. Krishnaprasad, *Orthogonal matching pursuit* (1993). (4) is the leave-one-out
//! error of P terms from one fit, by its leverages (3), times the correction of O. Chapelle, V. Vapnik, Y. Bengio (2002)
//! for small n, as G. Blatman and B. Sudret (2011) choose the terms of chaos expansions.

use rayon::prelude::*;

use crate::summary::mean_and_squares;

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
    let n = y.len();
    let limit = columns.len().min(n / 2);
    // The path ends when ε has not fallen for so many steps.
    let patience = (limit / 10).max(20);
    let squares = mean_and_squares(y).1;
    let norms: Vec<f64> = columns.par_iter().map(|column| dot(column, column).sqrt()).collect();
    let mut open = vec![true; columns.len()];
    let mut factors = Factors { q: vec![], inverse: vec![], projections: vec![] };
    let mut residual = y.to_vec();
    let mut leverages = vec![0.0; n];
    let mut chosen = Vec::new();
    let mut best = (f64::INFINITY, 0);
    let mut next = Some((vec![1.0; n], None));
    while let Some((column, candidate)) = next {
        if factors.push(&column, &mut residual) {
            chosen.extend(candidate);
            for (leverage, q) in leverages.iter_mut().zip(&factors.q[factors.q.len() - 1]) {
                *leverage += q * q;
            }
            let error = factors.corrected_error(&residual, &leverages, squares);
            if error < best.0 {
                best = (error, chosen.len());
            }
        }
        let going = chosen.len() < limit && chosen.len() < best.1 + patience;
        next = closest(columns, &norms, &open, &residual).filter(|_| going).map(|j| {
            open[j] = false;
            (columns[j].clone(), Some(j))
        });
    }
    let (error, terms) = best;
    let coefficients = factors.coefficients(terms + 1);
    Pursuit {
        constant: coefficients[0],
        terms: chosen.into_iter().zip(coefficients[1..].iter().copied()).collect(),
        error,
    }
}

/// Eq. (1); `None` when no candidate is left.
fn closest(columns: &[Vec<f64>], norms: &[f64], open: &[bool], residual: &[f64]) -> Option<usize> {
    let correlation = |j: usize| dot(&columns[j], residual).abs() / norms[j];
    let correlations: Vec<f64> =
        (0..columns.len()).into_par_iter().map(|j| if open[j] { correlation(j) } else { -1.0 }).collect();
    let largest = |best: usize, j| if correlations[j] > correlations[best] { j } else { best };
    (0..columns.len()).reduce(largest).filter(|&j| open[j])
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// X = Q R of the chosen columns.
struct Factors {
    q: Vec<Vec<f64>>,
    /// Columns of R⁻¹, without the zeros.
    inverse: Vec<Vec<f64>>,
    /// Qᵀ y.
    projections: Vec<f64>,
}

impl Factors {
    /// Takes in a column, Eq. (2), unless it depends on the others.
    fn push(&mut self, column: &[f64], residual: &mut [f64]) -> bool {
        /// Distance from the space of the others over length.
        const DEPENDENT: f64 = 1e-8;
        let mut q = column.to_vec();
        let mut r = vec![0.0; self.q.len()];
        // Twice is enough (W. Kahan): Gram and Schmidt's method, repeated, is as orthogonal as Householder's.
        for _ in 0..2 {
            for (r, other) in r.iter_mut().zip(&self.q) {
                let projection = dot(&q, other);
                *r += projection;
                q.iter_mut().zip(other).for_each(|(q, other)| *q -= projection * other);
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
            inverse.iter_mut().zip(column).for_each(|(sum, entry)| *sum -= entry * r / norm);
        }
        let projection = dot(&q, residual);
        residual.iter_mut().zip(&q).for_each(|(residual, q)| *residual -= projection * q);
        self.projections.push(projection);
        self.inverse.push(inverse);
        self.q.push(q);
        true
    }

    /// ε (4), infinite where one value has all the leverage.
    fn corrected_error(&self, residual: &[f64], leverages: &[f64], squares: f64) -> f64 {
        let n = residual.len() as f64;
        let left_out = |(r, h): (&f64, &f64)| if *h < 1.0 { (r / (1.0 - h)).powi(2) } else { f64::INFINITY };
        let sum: f64 = residual.iter().zip(leverages).map(left_out).sum();
        let trace: f64 = self.inverse.iter().map(|column| dot(column, column)).sum();
        sum / squares * n / (n - self.q.len() as f64) * (1.0 + trace)
    }

    /// R⁻¹ Qᵀ y of the first `count` columns.
    fn coefficients(&self, count: usize) -> Vec<f64> {
        let mut coefficients = vec![0.0; count];
        for (column, projection) in self.inverse[..count].iter().zip(&self.projections) {
            coefficients.iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry * projection);
        }
        coefficients
    }
}
