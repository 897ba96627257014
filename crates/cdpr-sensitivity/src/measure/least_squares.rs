//! Linear least squares by Householder's QR factorisation. No other module of this crate names faer.
//!
//! ```text
//! X = Q R,   b = R⁻¹ Qᵀ y,   (Xᵀ X)⁻¹ = R⁻¹ R⁻ᵀ                            (W1)
//! ```
//!
//! G. H. Golub, C. F. Van Loan, *Matrix computations*, 4th ed. (2013), section 5.3.

use faer::linalg::solvers::{Qr, SolveLstsq};
use faer::linalg::triangular_solve::solve_upper_triangular_in_place;
use faer::{Mat, Par};

/// Solution of `min |y - X b|`.
pub(crate) struct LeastSquares {
    /// Coefficients b, one per column.
    pub(crate) coefficients: Vec<f64>,
    /// Diagonal of `(Xᵀ X)⁻¹`.
    pub(crate) inverse_gram: Vec<f64>,
    /// `|y - X b|²`.
    pub(crate) residual_squares: f64,
}

/// Solves the least-squares problem (W1).
///
/// # Errors
/// The index of the first column that depends on those before it: its length is at least 1e10 times its
/// distance from their space.
pub(crate) fn least_squares(columns: &[Vec<f64>], y: &[f64]) -> Result<LeastSquares, usize> {
    const DEPENDENT: f64 = 1e-10;
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
