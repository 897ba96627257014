//! Correlated inputs: a Gaussian copula over any design of independent inputs.
//!
//! With Φ the standard normal distribution function, C the correlation matrix and L its Cholesky factor,
//!
//! ```text
//! C = L Lᵀ                                                               (Co1)
//! z = L Φ⁻¹(u),   v = Φ(z),   x_j = F_j⁻¹(v_j)                           (Co2)
//! ```
//!
//! R. L. Iman, W. J. Conover, *A distribution-free approach to inducing rank correlation among input
//! variables* (1982); R. B. Nelsen, *An introduction to copulas* (2006). Each input keeps its law and its
//! steps. C is the correlation of the normal scores z. It is also that of normal inputs; uniform inputs have
//! the correlation (6/π) asin(C / 2).
//!
//! The design is not an [`IndependentSample`]: effects, chaos expansions and derivative-based measures do not
//! accept it.
//!
//! ```compile_fail,E0277
//! use cdpr_sensitivity::{Correlated, SobolDesign, Truncation, expansion};
//! fn model(design: &Correlated<SobolDesign>, outputs: &[Option<f64>], truncation: Truncation) {
//!     let _ = expansion(design, outputs, truncation);
//! }
//! ```
//!
//! ```compile_fail,E0277
//! use cdpr_sensitivity::{Correlated, SobolDesign, student_effects};
//! fn effects(design: &Correlated<SobolDesign>, outputs: &[Option<f64>]) {
//!     let _ = student_effects(design, outputs);
//! }
//! ```
//!
//! Regression accepts it, because it needs a [`JointSample`] only:
//!
//! ```
//! use cdpr_sensitivity::{Correlated, SobolDesign, regression};
//! fn coefficients(design: &Correlated<SobolDesign>, outputs: &[Option<f64>]) {
//!     let _ = regression(design, outputs);
//! }
//! ```

use crate::design::{IndependentSample, JointSample, Layout, SampleDesign};
use crate::error::{SensitivityError, check_length};
use crate::law::normal::{standard_normal_cdf, standard_normal_quantile};

/// Points of a design of independent inputs, correlated by Eq. (Co2).
#[derive(Debug, Clone)]
pub struct Correlated<D> {
    design: D,
    /// L, row by row, without its zeros.
    factor: Vec<Vec<f64>>,
}

impl<D: IndependentSample> Correlated<D> {
    /// Correlates the inputs of `design` by a correlation matrix, which is given row by row.
    ///
    /// # Errors
    /// - [`SensitivityError::LengthMismatch`] unless the matrix has a row and a column for each input;
    /// - [`SensitivityError::NotACorrelation`] unless the matrix is symmetric and positive definite with ones
    ///   on its diagonal;
    /// - [`SensitivityError::UnboundedAtZero`] for a design that starts at point 0 of an unscrambled
    ///   sequence, whose normal scores are infinite.
    pub fn new(design: D, correlation: &[Vec<f64>]) -> Result<Self, SensitivityError> {
        let inputs = design.inputs();
        check_length("correlation", correlation.len(), inputs.len())?;
        for row in correlation {
            check_length("row of the correlation", row.len(), inputs.len())?;
        }
        let factor = cholesky(correlation)?;
        let mut first = vec![0.0; inputs.len()];
        design.unit_point(0, &mut first)?;
        if let Some((input, _)) = inputs.iter().zip(&first).find(|(_, u)| **u == 0.0) {
            return Err(SensitivityError::UnboundedAtZero { name: input.name.clone() });
        }
        Ok(Self { design, factor })
    }
}

impl<D: IndependentSample> SampleDesign for Correlated<D> {
    fn layout(&self) -> &Layout {
        self.design.layout()
    }

    fn replicate(&self, seed: u64) -> Self {
        Self { design: self.design.replicate(seed), factor: self.factor.clone() }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        self.design.unit_point(index, point)?;
        for u in point.iter_mut() {
            *u = standard_normal_quantile(*u);
        }
        // The last input comes first, because an input needs only the scores of those before it.
        for (j, row) in self.factor.iter().enumerate().rev() {
            let z = row.iter().zip(&*point).map(|(l, score)| l * score).sum();
            point[j] = standard_normal_cdf(z).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON);
        }
        Ok(())
    }
}

impl<D: IndependentSample> JointSample for Correlated<D> {}

/// Cholesky factor of a correlation matrix, Eq. (Co1).
pub(crate) fn cholesky(matrix: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, SensitivityError> {
    /// A squared pivot up to this value is rounding.
    const SINGULAR: f64 = 1e-12;
    let mut factor: Vec<Vec<f64>> = Vec::with_capacity(matrix.len());
    for (row, entries) in matrix.iter().enumerate() {
        let wrong =
            |column, value, expected| SensitivityError::NotACorrelation { row, column, value, expected };
        let mut line: Vec<f64> = Vec::with_capacity(row + 1);
        for (column, &entry) in entries[..=row].iter().enumerate() {
            if entry != matrix[column][row] || !entry.is_finite() {
                return Err(wrong(column, entry, "a finite symmetric matrix"));
            }
            let other = factor.get(column).unwrap_or(&line);
            let rest = entry - line.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
            if column < row {
                line.push(rest / factor[column][column]);
            } else if entry != 1.0 {
                return Err(wrong(column, entry, "1 on the diagonal"));
            } else if rest <= SINGULAR {
                return Err(wrong(column, rest, "a positive definite matrix"));
            } else {
                line.push(rest.sqrt());
            }
        }
        factor.push(line);
    }
    Ok(factor)
}
