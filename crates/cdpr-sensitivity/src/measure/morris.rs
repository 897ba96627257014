//! Screening by elementary effects.
//!
//! An elementary effect is the change of the output between two points that differ in input i alone, divided
//! by the probability that lies between the two values of the input:
//!
//! ```text
//! e_i = (y(x') - y(x)) / (F_i(x'_i) - F_i(x_i))                                        (Mo1)
//! μ_i = mean(e_i),   μ*_i = mean(|e_i|),   σ_i² = Σ (e_i - μ_i)² / (n - 1)             (Mo2)
//! n_eff = (Σ |e_i|)² / Σ e_i²                                                          (Mo3)
//! ```
//!
//! In a design with groups an effect is that of a group, whose change is divided by the root mean square of
//! the probabilities by which its inputs have moved; those that steps leave where they are count with zero.
//! It has no direction if the group has several inputs: μ* alone describes it then.
//!
//! μ* ranks the inputs. A large σ shows curvature or interactions. In a linear model of uniform inputs, e = b
//! (max - min). If steps round the two values of an input to the same level, there is no elementary effect.
//!
//! (Mo3) is the number of effects on which μ* rests: n if all have the same size, 1 if all but one are
//! zero. An interval that rests on few effects is too short: those that are rare and large may be
//! missing. `cargo xtask statistics reliability` measures how often it holds.
//!
//! (Mo1): M. D. Morris, *Factorial sampling plans for preliminary computational experiments*, Technometrics
//! 33 (1991). μ*: F. Campolongo, J. Cariboni, A. Saltelli, *An effective screening design for sensitivity
//! analysis of large models* (2007). (Mo3): L. Kish, *Survey sampling* (1965).

use serde::{Deserialize, Serialize};

use crate::design::SampleDesign;
use crate::design::group::Group;
use crate::design::input::Input;
use crate::design::morris::MorrisDesign;
use crate::design::observation::check_outputs;
use crate::error::{SensitivityError, check_level, check_range};
use crate::sample::interval::{Estimate, effective};
use crate::sample::summary::Spread;

/// Elementary effects of one input, in the unit of the output.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct MorrisEffect {
    /// Name of the input, or of the group.
    pub input: String,
    /// Number of elementary effects.
    pub effects: usize,
    /// Number of elementary effects lost to failed observations.
    pub failed: usize,
    /// Mean μ (Mo2). It says nothing of a group of several inputs.
    pub mean: f64,
    /// Mean μ* of the absolute values (Mo2) with its interval over the blocks, which allows for their
    /// skewness: where most effects are small, the law of their absolute values has a long tail.
    pub mean_absolute: Estimate,
    /// Whether that interval has its level: from [`MorrisEffect::RELIABLE_EFFECTS`] effects on, if μ* rests
    /// on at least [`MorrisEffect::RELIABLE_EFFECTIVE`] of them (Mo3). Otherwise it is an indication: the
    /// next effect may be larger than all before. If all n effects are zero, the interval is reliable, but up
    /// to 3 / n of all effects may still differ from zero.
    pub reliable: bool,
    /// Standard deviation σ (Mo2).
    pub std: f64,
}

impl MorrisEffect {
    /// Least number of elementary effects of a reliable interval.
    pub const RELIABLE_EFFECTS: usize = 24;
    /// Least number of effects on which the mean of a reliable interval rests, Eq. (Mo3).
    pub const RELIABLE_EFFECTIVE: f64 = 5.0;
}

/// Estimates the moments (Mo2) of the elementary effects (Mo1) of all inputs.
///
/// `outputs` has one output per row of the design, `None` for a failed observation. The interval of μ* has
/// the confidence `level` in (0, 1).
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless there is one output per row;
/// - [`SensitivityError::NotFinite`] for a value that is not finite;
/// - [`SensitivityError::InvalidInput`] with [`SensitivityError::OutOfRange`] for an input with fewer than
///   two elementary effects;
/// - [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
pub fn morris_effects(
    design: &MorrisDesign,
    outputs: &[Option<f64>],
    level: f64,
) -> Result<Vec<MorrisEffect>, SensitivityError> {
    check_level(level)?;
    check_outputs(design, outputs)?;
    let inputs = design.inputs();
    let groups = design.groups();
    let mut found = vec![(Vec::new(), 0); groups.len()];
    let mut rows = vec![vec![0.0; inputs.len()]; groups.len() + 1];
    for (block, outputs) in outputs.chunks(rows.len()).enumerate() {
        for (k, row) in rows.iter_mut().enumerate() {
            design.row(block * (groups.len() + 1) + k, row)?;
        }
        for k in 1..rows.len() {
            let reference = design.reference(k);
            let (from, to) = (&rows[reference], &rows[k]);
            // No input differs if steps have rounded the two values to the same level.
            let Some(moved) = (0..inputs.len()).find(|&input| from[input] != to[input]) else {
                continue;
            };
            // Radial blocks move the groups in their order, trajectories in a random one.
            let of_trajectory = groups.iter().position(|group| group.contains(moved));
            let Some(group) = design.levels().map_or(Some(k - 1), |_| of_trajectory) else { continue };
            match (outputs[reference], outputs[k]) {
                (Some(before), Some(after)) => {
                    let distance = distance(&groups[group], inputs, from, to);
                    found[group].0.push((after - before) / distance);
                }
                _ => found[group].1 += 1,
            }
        }
    }
    let summary = |(group, (effects, failed)): (&Group, (Vec<f64>, usize))| {
        check_range("elementary effects", effects.len() as u64, 2, u64::MAX).map_err(|source| {
            SensitivityError::InvalidInput { name: group.name.clone(), source: Box::new(source) }
        })?;
        let spread = Spread::of(&effects);
        let absolute: Vec<f64> = effects.iter().map(|effect| effect.abs()).collect();
        Ok(MorrisEffect {
            input: group.name.clone(),
            effects: effects.len(),
            failed,
            mean: spread.mean,
            mean_absolute: Estimate::of_skewed_mean(&absolute, level)?,
            reliable: is_reliable(&absolute),
            std: spread.std(),
        })
    };
    groups.iter().zip(found).map(summary).collect()
}

/// [`MorrisEffect::reliable`] of the sizes of effects.
fn is_reliable(sizes: &[f64]) -> bool {
    sizes.len() >= MorrisEffect::RELIABLE_EFFECTS && effective(sizes) >= MorrisEffect::RELIABLE_EFFECTIVE
}

/// Probability by which a group has moved: of one input with its sign, of several the root mean square.
fn distance(group: &Group, inputs: &[Input], from: &[f64], to: &[f64]) -> f64 {
    let of_input = |&i: &usize| inputs[i].law.cdf(to[i]) - inputs[i].law.cdf(from[i]);
    match &group.inputs[..] {
        [input] => of_input(input),
        several => {
            let squares: f64 = several.iter().map(|input| of_input(input).powi(2)).sum();
            (squares / several.len() as f64).sqrt()
        }
    }
}
