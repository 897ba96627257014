//! Effect of each input: outputs in the upper half of its domain against those in the lower half.
//!
//! With M₊, n₊ the mean and number of the outputs whose input lies above the middle of its domain, M₋, n₋ of those
//! below it,
//!
//! ```text
//! effect = M₊ - M₋                                                        (1)
//! t = |M₋ - M₊| / √(V_g² / n₋ + V_g² / n₊)                                (2)
//! interval = ē ± t_(R-1, (1 + level) / 2) s_e / √R                         (3)
//! ```
//!
//! (2) is the "t-Student" index of the source paper, section 5.2. Its "general variance" `V_g²` is taken as the variance
//! (n - 1) of **all** observed outputs. Student's own test has the pooled variance within the two halves instead; with
//! N outputs, none of them on a middle, the two are tied by `t_pooled²` = t² (N - 2) / (N - 1 - t²) and nearly equal
//! while t² is small beside N.
//!
//! **Student's significance is not to be read from t on a Sobol design**: it assumes independent observations, and
//! the points of the sequence are balanced. Inputs without any effect have a mean t of √(2/π) = 0.80 on random points;
//! on 2000 Sobol points it is 0.14 in the linear model of 62 inputs of `tests/effect.rs`. The interval (3) over
//! independent randomisations holds on both: each replicate gives one effect e, and the R effects are independent of
//! each other (A. B. Owen, *Monte Carlo theory, methods and examples*, 2013, section 17).
//!
//! For y = Σ b x and uniform inputs, the expected effect of an input is b (max - min) / 2.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::design::IndependentSample;
use crate::error::{SensitivityError, require};
use crate::summary::{Sample, Summary, mean_and_squares};

/// Effect of one input, and the observations it rests on. An observation whose input lies exactly on the middle of
/// its domain belongs to neither half.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Effect {
    /// Name of the input.
    pub input: String,
    /// Observed outputs in the upper half, n₊.
    pub above: usize,
    /// Observed outputs in the lower half, n₋.
    pub below: usize,
    /// Observed outputs on the middle.
    pub on_middle: usize,
    /// Failed observations in the upper half.
    pub failed_above: usize,
    /// Failed observations in the lower half.
    pub failed_below: usize,
    /// M₊, in the unit of the output.
    pub mean_above: f64,
    /// M₋, in the unit of the output.
    pub mean_below: f64,
    /// Signed effect (1), in the unit of the output.
    pub effect: f64,
    /// Index t (2). 0 for an output that never changes.
    pub student: f64,
}

/// Effects of all inputs of a design.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Effects {
    /// The outputs themselves; [`Summary::failed`] counts the observations without one.
    pub outputs: Summary,
    /// One an input, in the order of the design.
    pub effects: Vec<Effect>,
}

/// Signed effect of one input over independent replicates of a design, Eq. (3).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct EffectInterval {
    /// Name of the input.
    pub input: String,
    /// Mean of the effects of the replicates, in the unit of the output.
    pub effect: f64,
    /// Its standard error `s_e` / √R.
    pub standard_error: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

/// Effects of all inputs on one output, one value an observation of the design, `None` where it has failed.
///
/// Failed observations take part in no mean. If they gather in one half of an input ([`Effect::failed_above`],
/// [`Effect::failed_below`]), its effect is that of the observations that did not fail only.
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless there is one output a row;
/// - [`SensitivityError::NotFinite`] for a value that is not finite;
/// - [`SensitivityError::OutOfRange`] for fewer than two values;
/// - [`SensitivityError::EmptyHalf`] if no value is left in one half of an input.
pub fn student_effects<D: IndependentSample>(
    design: &D,
    outputs: &[Option<f64>],
) -> Result<Effects, SensitivityError> {
    if outputs.len() != design.points() {
        let (value, expected) = (outputs.len(), design.points());
        return Err(SensitivityError::LengthMismatch { field: "outputs", value, expected });
    }
    let summary = Sample::new(outputs)?.summary();
    let middles: Vec<f64> = design.inputs().iter().map(|input| input.law.middle()).collect();
    let mut halves = vec![Halves::default(); middles.len()];
    let mut row = vec![0.0; middles.len()];
    for (index, &output) in outputs.iter().enumerate() {
        design.row(index, &mut row)?;
        // Deviations from the mean: no digits are lost in the sums.
        let deviation = output.map(|output| output - summary.mean);
        for ((halves, value), middle) in halves.iter_mut().zip(&row).zip(&middles) {
            if value > middle {
                halves.above.add(deviation);
            } else if value < middle {
                halves.below.add(deviation);
            } else {
                halves.on_middle.add(deviation);
            }
        }
    }
    let effects =
        design.inputs().iter().zip(&halves).map(|(input, halves)| halves.effect(&input.name, &summary));
    Ok(Effects { outputs: summary, effects: effects.collect::<Result<_, _>>()? })
}

/// Interval (3) of the effect of each input at a confidence `level` in (0, 1), from at least two replicates of one
/// design, each with its outputs.
///
/// # Errors
/// - [`SensitivityError::InvalidParameter`] for the level;
/// - [`SensitivityError::OutOfRange`] for fewer than two replicates;
/// - [`SensitivityError::NotAReplicate`] for a design without a seed, with the seed of another one, or of other inputs
///   or size;
/// - those of [`student_effects`].
pub fn effect_intervals<D: IndependentSample>(
    replicates: &[(D, Vec<Option<f64>>)],
    level: f64,
) -> Result<Vec<EffectInterval>, SensitivityError> {
    require(level > 0.0 && level < 1.0, "level", level, "a number between 0 and 1")?;
    check_replicates(replicates)?;
    let (first, _) = &replicates[0];
    let mut effects = vec![Vec::with_capacity(replicates.len()); first.inputs().len()];
    let of_replicates: Vec<Effects> = replicates
        .par_iter()
        .map(|(design, outputs)| student_effects(design, outputs))
        .collect::<Result<_, _>>()?;
    for replicate in of_replicates {
        for (effects, effect) in effects.iter_mut().zip(replicate.effects) {
            effects.push(effect.effect);
        }
    }
    let freedom = replicates.len() as f64 - 1.0;
    let factor = StudentsT::new(0.0, 1.0, freedom)
        .map_err(|_| SensitivityError::InvalidParameter {
            field: "replicates",
            value: freedom + 1.0,
            expected: "two at least",
        })?
        .inverse_cdf(0.5 * (1.0 + level));
    let interval = |(input, effects): (&crate::Input, &Vec<f64>)| {
        let (effect, squares) = mean_and_squares(effects);
        let standard_error = (squares / freedom / (freedom + 1.0)).sqrt();
        let half_width = factor * standard_error;
        let input = input.name.clone();
        EffectInterval { input, effect, standard_error, low: effect - half_width, high: effect + half_width }
    };
    Ok(first.inputs().iter().zip(&effects).map(interval).collect())
}

fn check_replicates<D: IndependentSample>(
    replicates: &[(D, Vec<Option<f64>>)],
) -> Result<(), SensitivityError> {
    if replicates.len() < 2 {
        return Err(SensitivityError::OutOfRange {
            field: "replicates",
            value: replicates.len() as u64,
            minimum: 2,
            maximum: u64::MAX,
        });
    }
    let (first, _) = &replicates[0];
    let mut seeds = std::collections::BTreeSet::new();
    for (index, (design, _)) in replicates.iter().enumerate() {
        let wrong = |expected| Err(SensitivityError::NotAReplicate { index, expected });
        let Some(seed) = design.seed() else {
            return wrong("a randomised design");
        };
        if !seeds.insert(seed) {
            return wrong("a seed that no other replicate has");
        }
        if design.inputs() != first.inputs() || design.points() != first.points() {
            return wrong("the inputs and the size of the first replicate");
        }
    }
    Ok(())
}

/// Outputs in one part of the domain of an input.
#[derive(Debug, Clone, Copy, Default)]
struct Part {
    count: usize,
    failed: usize,
    sum: f64,
}

impl Part {
    fn add(&mut self, deviation: Option<f64>) {
        match deviation {
            Some(deviation) => {
                self.count += 1;
                self.sum += deviation;
            }
            None => self.failed += 1,
        }
    }
}

#[derive(Debug, Clone, Copy, Default)]
struct Halves {
    above: Part,
    below: Part,
    on_middle: Part,
}

impl Halves {
    /// Eq. (1) and (2).
    fn effect(&self, input: &str, outputs: &Summary) -> Result<Effect, SensitivityError> {
        let Self { above, below, on_middle } = self;
        if above.count == 0 || below.count == 0 {
            let (above, below) = (above.count, below.count);
            return Err(SensitivityError::EmptyHalf { input: input.to_owned(), above, below });
        }
        let (n_above, n_below) = (above.count as f64, below.count as f64);
        let effect = above.sum / n_above - below.sum / n_below;
        let standard_error = outputs.std * (1.0 / n_below + 1.0 / n_above).sqrt();
        Ok(Effect {
            input: input.to_owned(),
            above: above.count,
            below: below.count,
            on_middle: on_middle.count,
            failed_above: above.failed,
            failed_below: below.failed,
            mean_above: outputs.mean + above.sum / n_above,
            mean_below: outputs.mean + below.sum / n_below,
            effect,
            student: if standard_error > 0.0 { effect.abs() / standard_error } else { 0.0 },
        })
    }
}
