//! Regression coefficients as measures of sensitivity.
//!
//! With the values (or ranks) of inputs and output standardized to mean 0 and deviation 1,
//!
//! ```text
//! y = Σ β_i x_i + r,   least Σ r²                                         (Re1)
//! R² = 1 - Σ r² / Σ y²                                                    (Re2)
//! p_i = β_i / √(β_i² + Σ r² g_ii),   g = (Xᵀ X)⁻¹                         (Re3)
//! ```
//!
//! - β (Re1) is the standardized regression coefficient (SRC; SRRC for ranks). For independent inputs the
//!   squares β² add up to R², apart from the correlations within the sample, and are the shares of the
//!   variance of a linear model: A. Saltelli, K. Chan, E. M. Scott, *Sensitivity analysis* (2000), section
//!   6.6.2.
//! - p (Re3) is the correlation of an input and the output after the other inputs are removed from both (PCC;
//!   PRCC for ranks). It follows from the t value of β.
//! - Ranks serve monotonic models: R. L. Iman, W. J. Conover, *The use of the rank transform in regression*,
//!   Technometrics 21 (1979). Equal values share their mean rank.
//!
//! Correlated inputs have coefficients, too, but the squares are not shares of the variance: the part that
//! two inputs cause jointly belongs to neither.

use serde::{Deserialize, Serialize};

use crate::design::JointSample;
use crate::design::observation::Observed;
use crate::error::{SensitivityError, check_range};
use crate::measure::linear_algebra::least_squares;
use crate::sample::summary::Spread;

/// Coefficients of one input.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Coefficient {
    /// Name of the input.
    pub input: String,
    /// Standardized coefficient β (Re1).
    pub standardized: f64,
    /// Square β² of the coefficient.
    pub share: f64,
    /// Partial correlation p (Re3). It is 0 for an input without influence in an exactly linear model.
    pub partial: f64,
}

/// Linear model of standardized values or ranks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Regression {
    /// Number of observations on which the model is based.
    pub observed: usize,
    /// Number of failed observations.
    pub failed: usize,
    /// R² (Re2): share of the variance that the linear model explains.
    pub r_squared: f64,
    /// Coefficients, one per input in the order of the design.
    pub inputs: Vec<Coefficient>,
}

/// Coefficients of values (SRC, PCC), from one output per row, `None` for a failed observation.
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless there is one output per row;
/// - [`SensitivityError::NotFinite`] for a value that is not finite;
/// - [`SensitivityError::OutOfRange`] unless there are at least two more outputs than inputs;
/// - [`SensitivityError::ConstantSample`] if all outputs are equal;
/// - [`SensitivityError::Collinear`] for an input whose values are constant or follow linearly from other
///   inputs.
pub fn regression<D: JointSample>(
    design: &D,
    outputs: &[Option<f64>],
) -> Result<Regression, SensitivityError> {
    of_design(design, outputs, Of::Values)
}

/// Coefficients of ranks (SRRC, PRCC), from one output per row, `None` for a failed observation.
///
/// # Errors
/// As [`regression`].
pub fn rank_regression<D: JointSample>(
    design: &D,
    outputs: &[Option<f64>],
) -> Result<Regression, SensitivityError> {
    of_design(design, outputs, Of::Ranks)
}

/// Spearman's rank correlation of two lists of equal length, or `None` if the values of one are constant.
#[must_use]
pub fn rank_correlation(one: &[f64], other: &[f64]) -> Option<f64> {
    let (one, other) = (standardized(ranks(one))?, standardized(ranks(other))?);
    let products: f64 = one.iter().zip(&other).map(|(x, y)| x * y).sum();
    Some(products / (one.len() as f64 - 1.0))
}

fn of_design<D: JointSample>(
    design: &D,
    outputs: &[Option<f64>],
    of: Of,
) -> Result<Regression, SensitivityError> {
    let names: Vec<&str> = design.inputs().iter().map(|input| input.name.as_str()).collect();
    of_observed(&names, Observed::new(design, outputs, names.len() + 2)?, of)
}

/// What the linear model is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Of {
    Values,
    Ranks,
}

/// Coefficients of the inputs of these names, from at least two more outputs than there are inputs.
pub(crate) fn of_observed(
    names: &[&str],
    observed: Observed,
    of: Of,
) -> Result<Regression, SensitivityError> {
    check_range("observed outputs", observed.outputs.len() as u64, names.len() as u64 + 2, u64::MAX)?;
    let transform = |values: Vec<f64>| match of {
        Of::Values => values,
        Of::Ranks => ranks(&values),
    };
    let collinear = |i: usize| SensitivityError::Collinear { input: names[i].to_owned() };
    let standard = |(i, values)| standardized(transform(values)).ok_or_else(|| collinear(i));
    let columns: Vec<_> = observed.columns.into_iter().enumerate().map(standard).collect::<Result<_, _>>()?;
    let (n, value) = (observed.outputs.len(), observed.outputs[0]);
    let y = standardized(transform(observed.outputs))
        .ok_or(SensitivityError::ConstantSample { value, count: n })?;
    let fit = least_squares(&columns, &y).map_err(collinear)?;
    let coefficient = |((name, &beta), gram): ((&&str, &f64), &f64)| {
        let scale = (beta * beta + fit.residual_squares * gram).sqrt();
        Coefficient {
            input: (*name).to_owned(),
            standardized: beta,
            share: beta * beta,
            partial: if scale > 0.0 { beta / scale } else { 0.0 },
        }
    };
    Ok(Regression {
        observed: n,
        failed: observed.failed,
        r_squared: 1.0 - fit.residual_squares / (n as f64 - 1.0),
        inputs: names.iter().zip(&fit.coefficients).zip(&fit.inverse_gram).map(coefficient).collect(),
    })
}

/// Standardizes values to mean 0 and deviation 1. Constant values give `None`.
pub(crate) fn standardized(mut values: Vec<f64>) -> Option<Vec<f64>> {
    let spread = Spread::of(&values);
    let std = spread.std();
    for value in &mut values {
        *value = (*value - spread.mean) / std;
    }
    (std > 0.0).then_some(values)
}

/// Ranks of values, starting at 1.
pub(crate) fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_unstable_by(|&i, &j| values[i].total_cmp(&values[j]));
    let mut ranks = vec![0.0; values.len()];
    let mut before = 0;
    for ties in order.chunk_by(|&i, &j| values[i] == values[j]) {
        let rank = before as f64 + 0.5 * (ties.len() as f64 + 1.0);
        ties.iter().for_each(|&i| ranks[i] = rank);
        before += ties.len();
    }
    ranks
}
