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
use crate::design::input::Input;
use crate::error::{SensitivityError, require};
use crate::sample::summary::{Moments, Summary, mean_and_squares};

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
    let mut sums = EffectSums::new(design.inputs(), outputs.iter().find_map(|output| *output).unwrap_or(0.0));
    let mut row = vec![0.0; design.inputs().len()];
    for (index, &output) in outputs.iter().enumerate() {
        if let Some(value) = output.filter(|value| !value.is_finite()) {
            return Err(SensitivityError::NotFinite { field: "outputs", index, value });
        }
        design.row(index, &mut row)?;
        sums.add(&row, output);
    }
    sums.effects(design.inputs())
}

/// Interval (3) of the effect of each input at a confidence `level` in (0, 1), from at least two replicates of one
/// design, each with its outputs.
///
/// # Errors
/// Those of [`intervals_of_effects`] and [`student_effects`].
pub fn effect_intervals<D: IndependentSample>(
    replicates: &[(D, Vec<Option<f64>>)],
    level: f64,
) -> Result<Vec<EffectInterval>, SensitivityError> {
    let designs: Vec<&D> = replicates.iter().map(|(design, _)| design).collect();
    check_replicates(&designs)?;
    let effects: Vec<Effects> = replicates
        .par_iter()
        .map(|(design, outputs)| student_effects(design, outputs))
        .collect::<Result<_, _>>()?;
    intervals_of_effects(&designs, &effects, level)
}

/// The same from the effects of each replicate.
///
/// # Errors
/// - [`SensitivityError::InvalidParameter`] for the level;
/// - [`SensitivityError::OutOfRange`] for fewer than two replicates;
/// - [`SensitivityError::NotAReplicate`] for a design without a seed, with the seed of another one, or of other inputs
///   or size;
/// - [`SensitivityError::LengthMismatch`] unless there are effects for each replicate.
pub fn intervals_of_effects<D: IndependentSample>(
    designs: &[&D],
    replicates: &[Effects],
    level: f64,
) -> Result<Vec<EffectInterval>, SensitivityError> {
    require(level > 0.0 && level < 1.0, "level", level, "a number between 0 and 1")?;
    check_replicates(designs)?;
    if replicates.len() != designs.len() {
        let (value, expected) = (replicates.len(), designs.len());
        return Err(SensitivityError::LengthMismatch { field: "replicates", value, expected });
    }
    let first = designs[0];
    let mut effects = vec![Vec::with_capacity(replicates.len()); first.inputs().len()];
    for replicate in replicates {
        for (effects, effect) in effects.iter_mut().zip(&replicate.effects) {
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
    let interval = |(input, effects): (&Input, &Vec<f64>)| {
        let (effect, squares) = mean_and_squares(effects);
        let standard_error = (squares / freedom / (freedom + 1.0)).sqrt();
        let half_width = factor * standard_error;
        let input = input.name.clone();
        EffectInterval { input, effect, standard_error, low: effect - half_width, high: effect + half_width }
    };
    Ok(first.inputs().iter().zip(&effects).map(interval).collect())
}

fn check_replicates<D: IndependentSample>(designs: &[&D]) -> Result<(), SensitivityError> {
    if designs.len() < 2 {
        return Err(SensitivityError::OutOfRange {
            field: "replicates",
            value: designs.len() as u64,
            minimum: 2,
            maximum: u64::MAX,
        });
    }
    let first = designs[0];
    let mut seeds = std::collections::BTreeSet::new();
    for (index, design) in designs.iter().enumerate() {
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

/// What the effects of all inputs need of the observations, which come one by one and need not be kept.
///
/// Sums of blocks of observations can be merged. The result depends on the order of observations and blocks by rounding only; where it
/// matters, merge blocks of fixed size in the order of their indices.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectSums {
    outputs: Moments,
    shift: f64,
    middles: Vec<f64>,
    above: Parts,
    below: Parts,
}

/// Outputs in one part of the domain of each input: how many, how many failed, and the sum of `output - shift`. Counts are whole
/// numbers up to 2^53.
#[derive(Debug, Clone, PartialEq)]
struct Parts {
    count: Vec<f64>,
    failed: Vec<f64>,
    sum: Vec<f64>,
}

impl Parts {
    fn new(inputs: usize) -> Self {
        let zeros = || vec![0.0; inputs];
        Self { count: zeros(), failed: zeros(), sum: zeros() }
    }

    /// Adds an observation to the parts that it lies in. Sums of chosen numbers instead of branches, which on random inputs would be
    /// foreseen half of the time, and no index to check: the loop fills a vector unit.
    fn add(
        &mut self,
        row: &[f64],
        middles: &[f64],
        inside: impl Fn(f64, f64) -> bool,
        [counted, failed, deviation]: [f64; 3],
    ) {
        let parts = self.count.iter_mut().zip(&mut self.failed).zip(&mut self.sum);
        for (((count, failures), sum), (value, middle)) in parts.zip(row.iter().zip(middles)) {
            let inside = inside(*value, *middle);
            let chosen = |value: f64| if inside { value } else { 0.0 };
            *count += chosen(counted);
            *failures += chosen(failed);
            *sum += chosen(deviation);
        }
    }

    fn merge(&mut self, other: &Self) {
        let add = |to: &mut [f64], from: &[f64]| to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
        add(&mut self.count, &other.count);
        add(&mut self.failed, &other.failed);
        add(&mut self.sum, &other.sum);
    }
}

impl EffectSums {
    /// No observation yet. `shift` is an output that is near the others, of the nominal model say: deviations from it keep their
    /// digits in the sums.
    #[must_use]
    pub fn new(inputs: &[Input], shift: f64) -> Self {
        let middles: Vec<f64> = inputs.iter().map(|input| input.law.middle()).collect();
        let parts = Parts::new(middles.len());
        Self { outputs: Moments::default(), shift, middles, above: parts.clone(), below: parts }
    }

    /// Adds an observation: the values of its inputs and its finite output, `None` if it failed.
    pub fn add(&mut self, row: &[f64], output: Option<f64>) {
        self.outputs.add(output);
        // An observation that failed counts where it failed, with nothing to add.
        let counted_failed_deviation = match output {
            Some(output) => [1.0, 0.0, output - self.shift],
            None => [0.0, 1.0, 0.0],
        };
        let middles = &self.middles;
        self.above.add(row, middles, |value, middle| value > middle, counted_failed_deviation);
        self.below.add(row, middles, |value, middle| value < middle, counted_failed_deviation);
    }

    /// Adds the observations of other sums with the same inputs and shift.
    pub fn merge(&mut self, other: &Self) {
        self.outputs.merge(&other.outputs);
        self.above.merge(&other.above);
        self.below.merge(&other.below);
    }

    /// Moments and extremes of the outputs.
    #[must_use]
    pub fn outputs(&self) -> &Moments {
        &self.outputs
    }

    /// Effects, Eq. (1) and (2), of the inputs these sums were made for.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for fewer than two values, [`SensitivityError::EmptyHalf`] if no value is left in one half of
    /// an input.
    pub fn effects(&self, inputs: &[Input]) -> Result<Effects, SensitivityError> {
        let outputs = self.outputs.summary()?;
        let effect = |(j, input): (usize, &Input)| {
            let input = input.name.clone();
            let (n_above, n_below) = (self.above.count[j], self.below.count[j]);
            let (above, below) = (n_above as usize, n_below as usize);
            if above == 0 || below == 0 {
                return Err(SensitivityError::EmptyHalf { input, above, below });
            }
            let (mean_above, mean_below) = (self.above.sum[j] / n_above, self.below.sum[j] / n_below);
            let effect = mean_above - mean_below;
            let standard_error = outputs.std * (1.0 / n_below + 1.0 / n_above).sqrt();
            Ok(Effect {
                input,
                above,
                below,
                on_middle: outputs.count - above - below,
                failed_above: self.above.failed[j] as usize,
                failed_below: self.below.failed[j] as usize,
                mean_above: self.shift + mean_above,
                mean_below: self.shift + mean_below,
                effect,
                student: if standard_error > 0.0 { effect.abs() / standard_error } else { 0.0 },
            })
        };
        let effects = inputs.iter().enumerate().map(effect).collect::<Result<_, _>>()?;
        Ok(Effects { outputs, effects })
    }
}
