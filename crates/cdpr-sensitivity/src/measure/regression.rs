//! Regression coefficients as measures of sensitivity.
//!
//! With the values of inputs and output standardised to mean 0 and deviation 1, or their ranks,
//!
//! ```text
//! y = Σ β_i x_i + r,   least Σ r²                                         (1)
//! R² = 1 - Σ r² / Σ y²                                                    (2)
//! p_i = β_i / √(β_i² + Σ r² g_ii),   g = (Xᵀ X)⁻¹                          (3)
//! ```
//!
//! β (1) is the standardised regression coefficient (SRC; SRRC of ranks). For independent inputs the squares β² add up to
//! R² but for the sample's own correlations, and are the shares of the variance of a linear model: A. Saltelli, K. Chan,
//! E. M. Scott, *Sensitivity analysis* (2000), section 6.6.2. p (3) is the correlation of an input and the output once
//! the other inputs are taken out of both (PCC; PRCC of ranks), from the t value of β. Ranks serve monotonic models: R. L.
//! Iman, W. J. Conover, *The use of the rank transform in regression*, Technometrics 21 (1979); equal values share their
//! mean rank.
//!
//! Correlated inputs have coefficients like others. Their squares are no shares then: what two inputs do jointly
//! belongs to neither.

use serde::{Deserialize, Serialize};

use crate::design::JointSample;
use crate::design::input::Input;
use crate::design::observation::Observed;
use crate::error::SensitivityError;
use crate::measure::least_squares::least_squares;
use crate::sample::summary::mean_and_squares;

/// Coefficients of one input.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Coefficient {
    /// Name of the input.
    pub input: String,
    /// Standardised coefficient β (1).
    pub standardised: f64,
    /// Its square.
    pub share: f64,
    /// Partial correlation p (3). 0 for an input without influence in a model that is exactly linear.
    pub partial: f64,
}

/// A linear model of standardised values or ranks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Regression {
    /// Observations that it rests on.
    pub observed: usize,
    /// Observations that failed.
    pub failed: usize,
    /// R² (2): the share of the variance that the linear model explains.
    pub r_squared: f64,
    /// One an input, in the order of the design.
    pub inputs: Vec<Coefficient>,
}

/// Coefficients of values (SRC, PCC), from one output a row, `None` where it has failed.
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless there is one output a row;
/// - [`SensitivityError::NotFinite`] for a value that is not finite;
/// - [`SensitivityError::OutOfRange`] for fewer than two outputs more than inputs;
/// - [`SensitivityError::ConstantSample`] if all outputs are equal;
/// - [`SensitivityError::Collinear`] for an input whose values do not vary, or follow linearly from the others.
pub fn regression<D: JointSample>(
    design: &D,
    outputs: &[Option<f64>],
) -> Result<Regression, SensitivityError> {
    of_observed(design, outputs, |values| values)
}

/// Coefficients of ranks (SRRC, PRCC), from one output a row, `None` where it has failed.
///
/// # Errors
/// As [`regression`].
pub fn rank_regression<D: JointSample>(
    design: &D,
    outputs: &[Option<f64>],
) -> Result<Regression, SensitivityError> {
    of_observed(design, outputs, |values| ranks(&values))
}

/// Spearman's rank correlation of two lists of equal length: the correlation of their ranks. `None` if the values of one do
/// not vary.
#[must_use]
pub fn rank_correlation(one: &[f64], other: &[f64]) -> Option<f64> {
    let (one, other) = (standardised(ranks(one))?, standardised(ranks(other))?);
    let products: f64 = one.iter().zip(&other).map(|(x, y)| x * y).sum();
    Some(products / (one.len() as f64 - 1.0))
}

fn of_observed<D: JointSample>(
    design: &D,
    outputs: &[Option<f64>],
    transform: impl Fn(Vec<f64>) -> Vec<f64>,
) -> Result<Regression, SensitivityError> {
    let inputs = design.inputs();
    let observed = Observed::new(design, outputs, inputs.len() + 2)?;
    let collinear = |i: usize| SensitivityError::Collinear { input: inputs[i].name.clone() };
    let standard = |(i, values)| standardised(transform(values)).ok_or_else(|| collinear(i));
    let columns: Vec<_> = observed.columns.into_iter().enumerate().map(standard).collect::<Result<_, _>>()?;
    let (n, value) = (observed.outputs.len(), observed.outputs[0]);
    let y = standardised(transform(observed.outputs))
        .ok_or(SensitivityError::ConstantSample { value, count: n })?;
    let fit = least_squares(&columns, &y).map_err(collinear)?;
    let coefficient = |((input, &beta), gram): ((&Input, &f64), &f64)| {
        let scale = (beta * beta + fit.residual_squares * gram).sqrt();
        Coefficient {
            input: input.name.clone(),
            standardised: beta,
            share: beta * beta,
            partial: if scale > 0.0 { beta / scale } else { 0.0 },
        }
    };
    Ok(Regression {
        observed: n,
        failed: observed.failed,
        r_squared: 1.0 - fit.residual_squares / (n as f64 - 1.0),
        inputs: inputs.iter().zip(&fit.coefficients).zip(&fit.inverse_gram).map(coefficient).collect(),
    })
}

/// To mean 0 and deviation 1; `None` for values that do not vary.
fn standardised(mut values: Vec<f64>) -> Option<Vec<f64>> {
    let (mean, squares) = mean_and_squares(&values);
    let std = (squares / (values.len() as f64 - 1.0)).sqrt();
    for value in &mut values {
        *value = (*value - mean) / std;
    }
    (std > 0.0).then_some(values)
}

/// Ranks from 1 on.
fn ranks(values: &[f64]) -> Vec<f64> {
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
