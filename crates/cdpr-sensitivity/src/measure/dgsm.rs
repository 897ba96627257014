//! Derivative-based measures, and the bounds that they set on total indices.
//!
//! With C the constant of Poincaré's inequality for the law of input i, `Var g ≤ C E g'²`, and V the variance
//! of the output,
//!
//! ```text
//! ν_i = E (∂f/∂x_i)²                                                     (Dg1)
//! T_i ≤ C_i ν_i / V                                                      (Dg2)
//! ```
//!
//! ν is a mean of squares. The bound has the interval of a positive estimate
//! ([`crate::sample::interval`], Eq. (CI6)), whose deviation is that of the mean of
//! `g²/ν - (f - E f)²/V`, relative to the bound. Where few rows decide ν, it is too short.
//!
//! I. M. Sobol', S. Kucherenko, *Derivative based global sensitivity measures and their link with global
//! sensitivity indices*, Math. Comput. Simul. 79 (2009). The constants are the best ones
//! ([`crate::measure::poincare`]). Short steps of an input count as a wider law; where
//! they change its variance by more than 1 %, there is no bound.

use serde::{Deserialize, Serialize};

use crate::design::IndependentSample;
use crate::design::input::Input;
use crate::error::{SensitivityError, check_finite, check_length, check_level, check_range};
use crate::measure::poincare::poincare_constant;
use crate::sample::interval::{Estimate, effective};
use crate::sample::summary::{Spread, check_varies};

/// Output of an observation and its derivatives with respect to the inputs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Slopes {
    /// Output.
    pub output: f64,
    /// ∂f/∂x for each input, in the unit of the output per that of the input.
    pub gradient: Vec<f64>,
}

/// Derivative-based measure of one input.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct DerivativeMeasure {
    /// Name of the input.
    pub input: String,
    /// ν (Dg1) with Student's interval, in the square of the unit of the output per that of the input.
    pub mean_square: Estimate,
    /// Bound (Dg2) on the total index with its interval, `None` for a law without a constant.
    pub total_bound: Option<Estimate>,
    /// Whether ν rests on [`DerivativeMeasure::RELIABLE_ROWS`] rows of equal weight. Otherwise the intervals
    /// are an indication: the next square may be larger than all before.
    pub reliable: bool,
}

impl DerivativeMeasure {
    /// Least number of rows of equal weight on which ν rests where its intervals hold: (Σ g²)² / Σ g⁴, as
    /// (Mo3) of [`crate::measure::morris`].
    pub const RELIABLE_ROWS: f64 = 20.0;

    pub(crate) fn is_reliable(squares: &[f64]) -> bool {
        effective(squares) >= Self::RELIABLE_ROWS
    }
}

/// Measures of all inputs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct DerivativeMeasures {
    /// Number of observations that gave slopes.
    pub observed: usize,
    /// Number of failed observations.
    pub failed: usize,
    /// Variance V of the output, in the square of its unit.
    pub variance: f64,
    /// Measures, one per input in the order of the design.
    pub inputs: Vec<DerivativeMeasure>,
}

/// Estimates the measures from the output and gradient at each row of a design, `None` for a failed
/// observation.
///
/// The intervals of ν have the confidence `level` in (0, 1).
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless there is one element per row, with one derivative per input;
/// - [`SensitivityError::NotFinite`] for an output or a derivative that is not finite;
/// - [`SensitivityError::OutOfRange`] for fewer than two observations with slopes;
/// - [`SensitivityError::ConstantSample`] if all outputs are equal;
/// - [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
pub fn dgsm<D: IndependentSample>(
    design: &D,
    slopes: &[Option<Slopes>],
    level: f64,
) -> Result<DerivativeMeasures, SensitivityError> {
    check_level(level)?;
    checked(design, slopes)?;
    let inputs = design.inputs();
    let observed: Vec<&Slopes> = slopes.iter().flatten().collect();
    check_range("observed outputs", observed.len() as u64, 2, u64::MAX)?;
    let outputs: Vec<f64> = observed.iter().map(|slopes| slopes.output).collect();
    check_varies(&outputs)?;
    let spread = Spread::of(&outputs);
    let variance = spread.variance();
    let measure = |(i, input): (usize, &Input)| {
        let squares: Vec<f64> = observed.iter().map(|slopes| slopes.gradient[i].powi(2)).collect();
        let mean_square = Estimate::of_mean(&squares, level)?;
        let relative = |(square, output): (&f64, &f64)| {
            // Without any slope the bound is zero for every row.
            let of_slopes = if mean_square.value > 0.0 { square / mean_square.value } else { 0.0 };
            of_slopes - (output - spread.mean).powi(2) / variance
        };
        let relative: Vec<f64> = squares.iter().zip(&outputs).map(relative).collect();
        let bound = |c: f64| {
            let value = c * mean_square.value / variance;
            let deviation = value * Spread::of(&relative).standard_error();
            Estimate::of_positive(value, deviation * deviation, outputs.len() as f64 - 1.0, level)
        };
        Ok(DerivativeMeasure {
            input: input.name.clone(),
            mean_square,
            total_bound: constant(input).map(bound).transpose()?,
            reliable: DerivativeMeasure::is_reliable(&squares),
        })
    };
    Ok(DerivativeMeasures {
        observed: observed.len(),
        failed: slopes.len() - observed.len(),
        variance,
        inputs: inputs.iter().enumerate().map(measure).collect::<Result<_, _>>()?,
    })
}

/// The constant of Poincaré's inequality for the values of an input: none where steps change its variance.
fn constant(input: &Input) -> Option<f64> {
    if input.is_coarse() { None } else { poincare_constant(&input.smooth_law()) }
}

/// Checks that there is one element per row, with one finite derivative per input.
pub(crate) fn checked<D: IndependentSample>(
    design: &D,
    slopes: &[Option<Slopes>],
) -> Result<(), SensitivityError> {
    check_length("slopes", slopes.len(), design.points())?;
    for (index, Slopes { output, gradient }) in
        slopes.iter().enumerate().filter_map(|(index, slopes)| Some((index, slopes.as_ref()?)))
    {
        check_length("gradient", gradient.len(), design.inputs().len())?;
        gradient.iter().try_for_each(|&slope| check_finite("gradient", index, slope))?;
        check_finite("outputs", index, *output)?;
    }
    Ok(())
}
