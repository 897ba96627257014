//! A sample with errors that are independent and of unit size, and what it says about the unknowns.
//!
//! With the residuals e of the tensions, their derivatives J by the unknowns in units of their prior standard
//! deviations, and the covariance `V = L Lᵀ` of e for known unknowns,
//!
//! ```text
//! V = diag(σ_i²) + σ_L² (∂t/∂L)(∂t/∂L)ᵀ,      ẽ = L⁻¹ e,   J̃ = L⁻¹ J                               (O3)
//! χ²(A) = eᵀ (V + J A⁻¹ Jᵀ)⁻¹ e = ẽ·ẽ - (J̃ᵀ ẽ)ᵀ (A + J̃ᵀ J̃)⁻¹ (J̃ᵀ ẽ)                              (O4)
//! ```
//!
//! where A is the information that the unknowns have without the sample (Woodbury's identity). χ²(A) has the
//! chi-square distribution with a degree of freedom for each cable where the model and A are right.

use crate::rest::{Rest, Unknowns};
use nalgebra::{Cholesky, Const, Matrix5};

/// Memory of a sample, which is used again for the next one.
#[derive(Clone)]
pub(crate) struct Sample {
    /// Residuals, later ẽ.
    pub(crate) residuals: Vec<f64>,
    /// J, later J̃.
    pub(crate) rows: Vec<Unknowns>,
    /// V, later L below the diagonal: n x n, row by row.
    noise: Vec<f64>,
    column: Vec<f64>,
}

/// J̃ᵀ J̃, J̃ᵀ ẽ and ẽ·ẽ.
pub(crate) struct Normal {
    pub(crate) matrix: Matrix5<f64>,
    pub(crate) right: Unknowns,
    pub(crate) square: f64,
}

impl Sample {
    pub(crate) fn new(cables: usize) -> Self {
        Self {
            residuals: vec![0.0; cables],
            rows: vec![Unknowns::zeros(); cables],
            noise: vec![0.0; cables * cables],
            column: vec![0.0; cables],
        }
    }

    /// Whitens residuals and rows, (O3); `None` where V is not positive definite.
    pub(crate) fn whiten(
        &mut self,
        rest: &Rest,
        lengths: &[f64],
        tension_std: &[f64],
        length_std: f64,
    ) -> Option<()> {
        let Self { residuals, rows, noise, column } = self;
        let n = residuals.len();
        noise.fill(0.0);
        tension_std.iter().enumerate().for_each(|(i, std)| noise[i * n + i] = std * std);
        if length_std > 0.0 {
            for j in 0..n {
                rest.tensions_per_length(j, lengths, column);
                for i in 0..n {
                    for k in 0..=i {
                        noise[i * n + k] += length_std * length_std * column[i] * column[k];
                    }
                }
            }
        }
        for i in 0..n {
            for j in 0..=i {
                let known: f64 = (0..j).map(|k| noise[i * n + k] * noise[j * n + k]).sum();
                let rest = noise[i * n + j] - known;
                if i == j && rest <= 0.0 {
                    return None;
                }
                noise[i * n + j] = if i == j { rest.sqrt() } else { rest / noise[j * n + j] };
            }
            for j in 0..i {
                let factor = noise[i * n + j];
                residuals[i] -= factor * residuals[j];
                rows[i] = rows[i] - factor * rows[j];
            }
            residuals[i] /= noise[i * n + i];
            rows[i] /= noise[i * n + i];
        }
        Some(())
    }

    pub(crate) fn normal(&self) -> Normal {
        let mut normal = Normal { matrix: Matrix5::zeros(), right: Unknowns::zeros(), square: 0.0 };
        for (row, residual) in self.rows.iter().zip(&self.residuals) {
            normal.matrix += row * row.transpose();
            normal.right += row * *residual;
            normal.square += residual * residual;
        }
        normal
    }
}

impl Normal {
    /// (O4), and the factor of `A + J̃ᵀ J̃`.
    pub(crate) fn chi_square(&self, information: &Matrix5<f64>) -> Option<(f64, Cholesky<f64, Const<5>>)> {
        let factor = (information + self.matrix).cholesky()?;
        Some((self.square - self.right.dot(&factor.solve(&self.right)), factor))
    }
}
