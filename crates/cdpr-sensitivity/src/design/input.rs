//! Input of a model: a name, a law, and the steps to which its value is rounded.
//!
//! With c the middle of the law's domain, h the step, and `k_min` and `k_max` the outermost whole steps
//! within the support,
//!
//! ```text
//! nearest:     x = c + h round((F⁻¹(u) - c) / h),   clamped to k_min .. k_max         (In1)
//! equal mass:  x = c + h (k_min + floor(u n)),      n = k_max - k_min + 1 levels      (In2)
//! ```
//!
//! (In1) is the "discretization step" of Tables 3 and 4 of the paper (Baklouti, Caro, Courteille, 2017).
//! Where the step divides the range, the two end levels of a uniform law have half the weight of the others.
//! (In2) gives each level of a uniform law the same weight.

use serde::{Deserialize, Serialize};

use crate::error::{SensitivityError, require};
use crate::law::{Law, Support};

/// Steps to which the values of an input are rounded, on a grid centred on the middle of its law.
///
/// A step that does not divide the range leaves a remainder without a level at both ends. For example,
/// ±0.01015 in steps of 3e-5 has 677 levels. The last one lies at 338 · 3e-5 = 0.01014, and the probability
/// of the remainder falls on it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Steps {
    /// Rounding to the nearest level, Eq. (In1).
    Nearest {
        /// Distance between two levels, positive, in the unit of the input.
        step: f64,
    },
    /// Levels of equal mass, Eq. (In2), for a uniform law only.
    EqualMass {
        /// Distance between two levels, positive, in the unit of the input.
        step: f64,
    },
}

/// An uncertain input of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// Name, as reports show it.
    pub name: String,
    /// Law of its value.
    pub law: Law,
    /// Steps of its value, `None` for a continuous one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<Steps>,
}

/// Steps on each side of the middle that can be told apart.
const MOST_STEPS: f64 = 1e15;

impl Input {
    /// A continuous input.
    pub fn continuous(name: impl Into<String>, law: Law) -> Self {
        Self { name: name.into(), law, steps: None }
    }

    /// A stepped input.
    pub fn stepped(name: impl Into<String>, law: Law, steps: Steps) -> Self {
        Self { name: name.into(), law, steps: Some(steps) }
    }

    /// Checks the law and the steps. The other methods expect a valid input.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidInput`] with the reason: an invalid law, a step that is not positive,
    /// longer than the distance from the middle to an end, or too short to be counted, or steps of equal mass
    /// for a law that is not uniform.
    pub fn validate(&self) -> Result<(), SensitivityError> {
        let check = || {
            self.law.validate()?;
            let Some(Steps::Nearest { step } | Steps::EqualMass { step }) = self.steps else {
                return Ok(());
            };
            require(step > 0.0 && step.is_finite(), "step", step, "a positive finite number")?;
            let (lowest, highest) = self.grid(step);
            let fits = lowest <= -1.0 && highest >= 1.0;
            require(fits, "step", step, "at most the distance from the middle to each end of the range")?;
            // Numbers are no finer, and the number of steps must not overflow.
            let steps = |u: f64| ((self.law.quantile(u) - self.law.middle()) / step).abs();
            let counted = steps(f64::EPSILON).max(steps(1.0 - f64::EPSILON)) < MOST_STEPS;
            require(counted, "step", step, "at least 1e-15 of the range")?;
            let uniform = matches!(self.law, Law::Uniform { .. });
            if matches!(self.steps, Some(Steps::EqualMass { .. })) && !uniform {
                return Err(SensitivityError::EqualMassNeedsUniform);
            }
            Ok(())
        };
        check().map_err(|source| SensitivityError::InvalidInput {
            name: self.name.clone(),
            source: Box::new(source),
        })
    }

    /// Value at the probability `u` in [0, 1]: the quantile of the law, rounded to the steps.
    #[must_use]
    pub fn value(&self, u: f64) -> f64 {
        self.prepare().value(u)
    }

    /// Prepares the input for many values: whatever does not depend on `u` is computed once.
    pub(crate) fn prepare(&self) -> Prepared {
        let Some(steps) = self.steps else { return Prepared { law: self.law, levels: None } };
        let (Steps::Nearest { step } | Steps::EqualMass { step }) = steps;
        let (Support { min, max }, (lowest, highest)) = (self.law.support(), self.grid(step));
        let levels = Levels { steps, middle: self.law.middle(), min, max, lowest, highest };
        Prepared { law: self.law, levels: Some(levels) }
    }

    /// Number of levels of a stepped input, infinite for an unbounded law. A continuous input has `None`.
    #[must_use]
    pub fn levels(&self) -> Option<f64> {
        let (Steps::Nearest { step } | Steps::EqualMass { step }) = self.steps?;
        let (lowest, highest) = self.grid(step);
        Some(highest - lowest + 1.0)
    }

    /// Mean of its values, steps included.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.weighted_levels().map_or_else(|| self.law.mean(), |levels| moments(&levels).0)
    }

    /// Standard deviation of its values, steps included.
    #[must_use]
    pub fn std(&self) -> f64 {
        self.weighted_levels().map_or_else(|| self.law.std(), |levels| moments(&levels).1.sqrt())
    }

    /// Ratio of its standard deviation to that of its law without steps.
    fn stretch(&self) -> f64 {
        if self.steps.is_some() { self.std() / self.law.std() } else { 1.0 }
    }

    /// Whether its steps are so long that no continuous law stands for its values: by their variance.
    pub(crate) fn is_coarse(&self) -> bool {
        const MOST: f64 = 0.01;
        (self.stretch().powi(2) - 1.0).abs() > MOST
    }

    /// The law without steps, of a uniform or normal one with the variance that the steps have.
    pub(crate) fn smooth_law(&self) -> Law {
        match self.law {
            Law::Uniform { min, max } if self.steps.is_some() => {
                let (middle, half) = (0.5 * (min + max), 0.5 * (max - min) * self.stretch());
                Law::Uniform { min: middle - half, max: middle + half }
            }
            Law::Normal { mean, std } => Law::Normal { mean, std: std * self.stretch() },
            law => law,
        }
    }

    /// Levels of a stepped input and their probabilities. A continuous input has `None`, and so has one with
    /// more than 2^16 levels that are likely to occur: its steps are negligible.
    pub(crate) fn weighted_levels(&self) -> Option<Vec<(f64, f64)>> {
        const MOST: f64 = 65_536.0;
        const TAIL: f64 = f64::EPSILON;
        let steps = self.steps?;
        let (Steps::Nearest { step } | Steps::EqualMass { step }) = steps;
        let (Support { min, max }, middle) = (self.law.support(), self.law.middle());
        let of_quantile = |u: f64| ((self.law.quantile(u) - middle) / step).round();
        let (lowest, highest) = self.grid(step);
        let (first, last) = (lowest.max(of_quantile(TAIL)), highest.min(of_quantile(1.0 - TAIL)));
        let level = |k: f64| {
            let below = |k: f64| self.law.cdf(middle + (k - 0.5) * step);
            let from = if k == lowest { 0.0 } else { below(k) };
            let to = if k == highest { 1.0 } else { below(k + 1.0) };
            let weight = if matches!(steps, Steps::EqualMass { .. }) { 1.0 } else { to - from };
            (within(middle + k * step, min, max), weight)
        };
        let count = last - first + 1.0;
        (count <= MOST).then(|| (0..count as usize).map(|k| level(first + k as f64)).collect())
    }

    /// Outermost steps `k_min` and `k_max`.
    ///
    /// A remainder of 1e-9 steps counts as rounding of the range: 0.015 / 0.0006 is 25 steps.
    fn grid(&self, step: f64) -> (f64, f64) {
        const ROUNDING: f64 = 1e-9;
        let Support { min, max } = self.law.support();
        let middle = self.law.middle();
        (((min - middle) / step - ROUNDING).ceil(), ((max - middle) / step + ROUNDING).floor())
    }
}

/// Input that is ready for many values.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Prepared {
    law: Law,
    levels: Option<Levels>,
}

#[derive(Debug, Clone, Copy)]
struct Levels {
    steps: Steps,
    middle: f64,
    min: f64,
    max: f64,
    lowest: f64,
    highest: f64,
}

impl Prepared {
    /// Value at the probability `u`, Eq. (In1) or (In2).
    pub(crate) fn value(&self, u: f64) -> f64 {
        let Some(Levels { steps, middle, min, max, lowest, highest }) = self.levels else {
            return self.law.quantile(u);
        };
        let (level, step) = match steps {
            Steps::Nearest { step } => (round((self.law.quantile(u) - middle) / step), step),
            Steps::EqualMass { step } => (lowest + (u * (highest - lowest + 1.0)).floor(), step),
        };
        within(middle + within(level, lowest, highest) * step, min, max)
    }
}

/// Clamps `x`; NaN stays NaN.
fn within(x: f64, min: f64, max: f64) -> f64 {
    let x = if x < min { min } else { x };
    if x > max { max } else { x }
}

/// Rounds as `f64::round`, but without the library call that it makes on a baseline x86-64 processor.
fn round(x: f64) -> f64 {
    const WHOLE: f64 = (1_u64 << 52) as f64;
    if x.abs() < WHOLE { (x + 0.5_f64.next_down().copysign(x)) as i64 as f64 } else { x }
}

/// Mean and variance of levels with these weights.
fn moments(levels: &[(f64, f64)]) -> (f64, f64) {
    let all: f64 = levels.iter().map(|(_, weight)| weight).sum();
    let mean = levels.iter().map(|(level, weight)| weight * level).sum::<f64>() / all;
    let variance = levels.iter().map(|(level, weight)| weight * (level - mean).powi(2)).sum::<f64>() / all;
    (mean, variance)
}

#[cfg(test)]
mod tests {
    #[test]
    fn halves_are_rounded_away_from_zero_and_nothing_else_is() {
        let half = 0.5_f64;
        for x in [0.0, -0.0, half.next_down(), half, -half, 1.5, 2.5, -2.5, 1e15 + 0.5, 1e300, f64::INFINITY]
        {
            for x in [x, -x, x.next_up(), x.next_down()] {
                assert_eq!(super::round(x), x.round(), "{x:e}");
            }
        }
        assert!(super::round(f64::NAN).is_nan());
    }
}
