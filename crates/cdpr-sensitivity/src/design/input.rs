//! An input of a model: a name, a law, and the steps that its value is rounded to.
//!
//! With c the middle of the law's domain, h the step and `k_min`, `k_max` the outermost whole steps inside of the support,
//!
//! ```text
//! nearest:     x = c + h round((F⁻¹(u) - c) / h),   clamped to k_min .. k_max          (1)
//! equal mass:  x = c + h (k_min + floor(u n)),      n = k_max - k_min + 1 levels      (2)
//! ```
//!
//! (1) is the "discretisation step" of the source paper's Tables 3 and 4: where the step divides the range, the two
//! end levels of a uniform law get half the weight of the others. (2) gives each level of a uniform law the same weight.

use serde::{Deserialize, Serialize};

use crate::error::{SensitivityError, require};
use crate::law::Law;

/// Steps that the values of an input are rounded to, on a grid centred on the middle of its law.
///
/// A step that does not divide the range leaves a remainder at both ends that holds no level: ±0.01015 in steps of
/// 3e-5 has 677 levels, the last one at 338 · 3e-5 = 0.01014, and takes the mass of the remainder there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Steps {
    /// Rounding to the nearest level, Eq. (1).
    Nearest {
        /// Distance of two levels, in the unit of the input, positive.
        step: f64,
    },
    /// Levels of equal mass, Eq. (2): for a uniform law only.
    EqualMass {
        /// Distance of two levels, in the unit of the input, positive.
        step: f64,
    },
}

/// An uncertain input of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// Name, for reports.
    pub name: String,
    /// Law of its value.
    pub law: Law,
    /// Steps of its value, `None` for a continuous one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<Steps>,
}

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
    /// [`SensitivityError::InvalidInput`] with what is wrong: the law, a step that is not positive or that is
    /// longer than the distance from the middle to an end, equal-mass steps of a law that is not uniform.
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

    /// The value at the probability `u` in [0, 1]: the law's quantile, rounded as the steps say.
    #[must_use]
    pub fn value(&self, u: f64) -> f64 {
        self.prepare().value(u)
    }

    /// The same for many values: what does not depend on `u` is computed once.
    pub(crate) fn prepare(&self) -> Prepared {
        let Some(steps) = self.steps else { return Prepared { law: self.law, levels: None } };
        let (Steps::Nearest { step } | Steps::EqualMass { step }) = steps;
        let ((min, max), (lowest, highest)) = (self.law.support(), self.grid(step));
        let levels = Levels { steps, middle: self.law.middle(), min, max, lowest, highest };
        Prepared { law: self.law, levels: Some(levels) }
    }

    /// Number of levels of a stepped input, infinite for an unbounded law; `None` for a continuous one.
    #[must_use]
    pub fn levels(&self) -> Option<f64> {
        let (Steps::Nearest { step } | Steps::EqualMass { step }) = self.steps?;
        let (lowest, highest) = self.grid(step);
        Some(highest - lowest + 1.0)
    }

    /// `k_min` and `k_max`. A remainder of 1e-9 steps is taken for rounding of the range: 0.015 / 0.0006 is 25 steps.
    fn grid(&self, step: f64) -> (f64, f64) {
        const ROUNDING: f64 = 1e-9;
        let (min, max) = self.law.support();
        let middle = self.law.middle();
        (((min - middle) / step - ROUNDING).ceil(), ((max - middle) / step + ROUNDING).floor())
    }
}

/// An input ready for many values.
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
    /// Eq. (1) or (2).
    pub(crate) fn value(&self, u: f64) -> f64 {
        let Some(Levels { steps, middle, min, max, lowest, highest }) = self.levels else {
            return self.law.quantile(u);
        };
        let (level, step) = match steps {
            Steps::Nearest { step } => {
                let quantile = match self.law {
                    Law::Uniform { min, max } => min + u * (max - min),
                    law => law.quantile(u),
                };
                (round((quantile - middle) / step), step)
            }
            Steps::EqualMass { step } => (lowest + (u * (highest - lowest + 1.0)).floor(), step),
        };
        within(middle + within(level, lowest, highest) * step, min, max)
    }
}

/// `x` clamped; no number stays none.
fn within(x: f64, min: f64, max: f64) -> f64 {
    let x = if x < min { min } else { x };
    if x > max { max } else { x }
}

/// `f64::round` without the call into a library that processors of the common denominator need for it.
fn round(x: f64) -> f64 {
    const WHOLE: f64 = (1_u64 << 52) as f64;
    if x.abs() < WHOLE { (x + 0.5_f64.next_down().copysign(x)) as i64 as f64 } else { x }
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
