//! Screening by elementary effects.
//!
//! An elementary effect is the change of the output between two points that differ in input i alone, over the probability
//! that lies between its two values:
//!
//! ```text
//! e_i = (y(x') - y(x)) / (F_i(x'_i) - F_i(x_i))                           (1)
//! μ_i = mean(e_i),   μ*_i = mean(|e_i|),   σ_i² = Σ (e_i - μ_i)² / (n - 1)              (2)
//! ```
//!
//! μ* ranks the inputs; σ tells of curvature and interactions. In a linear model of uniform inputs, e = b (max - min).
//! Two values that steps have made one have no elementary effect.
//!
//! (1): M. D. Morris, *Factorial sampling plans for preliminary computational experiments*, Technometrics 33 (1991). μ*:
//! F. Campolongo, J. Cariboni, A. Saltelli, *An effective screening design for sensitivity analysis of large models* (2007).

use serde::{Deserialize, Serialize};

use crate::design::SampleDesign;
use crate::design::input::Input;
use crate::design::morris::MorrisDesign;
use crate::design::observation::check_outputs;
use crate::error::{SensitivityError, check_level, check_range};
use crate::sample::interval::Estimate;
use crate::sample::summary::mean_and_squares;

/// Elementary effects of one input, in the unit of the output.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct MorrisEffect {
    /// Name of the input.
    pub input: String,
    /// Elementary effects found.
    pub effects: usize,
    /// Elementary effects lost to a failed observation.
    pub failed: usize,
    /// μ (2).
    pub mean: f64,
    /// μ* (2), with Student's interval over the blocks.
    pub mean_absolute: Estimate,
    /// σ (2).
    pub std: f64,
}

/// Elementary effects (1) of all inputs and their moments (2), from one output a row, `None` where it has failed, with the
/// interval of μ* at a confidence `level` in (0, 1).
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless there is one output a row;
/// - [`SensitivityError::NotFinite`] for a value that is not finite;
/// - [`SensitivityError::InvalidInput`] with [`SensitivityError::OutOfRange`] for an input with fewer than two
///   elementary effects;
/// - [`SensitivityError::InvalidParameter`] for the level.
pub fn morris_effects(
    design: &MorrisDesign,
    outputs: &[Option<f64>],
    level: f64,
) -> Result<Vec<MorrisEffect>, SensitivityError> {
    check_level(level)?;
    check_outputs(design, outputs)?;
    let inputs = design.inputs();
    let mut found = vec![(Vec::new(), 0); inputs.len()];
    let mut rows = vec![vec![0.0; inputs.len()]; inputs.len() + 1];
    for (block, outputs) in outputs.chunks(rows.len()).enumerate() {
        for (place, row) in rows.iter_mut().enumerate() {
            design.row(block * (inputs.len() + 1) + place, row)?;
        }
        for place in 1..rows.len() {
            let reference = design.reference(place);
            let (from, to) = (&rows[reference], &rows[place]);
            // None if steps have made the two values one.
            let Some(input) = (0..inputs.len()).find(|&input| from[input] != to[input]) else {
                continue;
            };
            let law = &inputs[input].law;
            match (outputs[reference], outputs[place]) {
                (Some(before), Some(after)) => {
                    found[input].0.push((after - before) / (law.cdf(to[input]) - law.cdf(from[input])));
                }
                _ => found[input].1 += 1,
            }
        }
    }
    let summary = |(input, (effects, failed)): (&Input, (Vec<f64>, usize))| {
        check_range("elementary effects", effects.len() as u64, 2, u64::MAX).map_err(|source| {
            SensitivityError::InvalidInput { name: input.name.clone(), source: Box::new(source) }
        })?;
        let (mean, squares) = mean_and_squares(&effects);
        let absolute: Vec<f64> = effects.iter().map(|effect| effect.abs()).collect();
        Ok(MorrisEffect {
            input: input.name.clone(),
            effects: effects.len(),
            failed,
            mean,
            mean_absolute: Estimate::of_mean(&absolute, level)?,
            std: (squares / (effects.len() as f64 - 1.0)).sqrt(),
        })
    };
    inputs.iter().zip(found).map(summary).collect()
}
