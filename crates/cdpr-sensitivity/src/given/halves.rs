//! Which way each input acts: the outputs of its upper half of values against those of its lower half.
//!
//! As in [`crate::measure::effect`], Eq. (U1) and (U2) there, with the median of the values in place of the
//! middle of a law that is not known:
//!
//! ```text
//! effect = M₊ - M₋,   t = |M₊ - M₋| / √(V / n₋ + V / n₊)                              (E1)
//! ```
//!
//! The effect has the unit of the output. For independent random rows t is that of Student, with the variance
//! V of all outputs; rows of a balanced design make it too small (see [`crate::measure::effect`]). An effect
//! that turns round within the range of an input is not seen.

use serde::{Deserialize, Serialize};

use crate::design::observation::Observed;
use crate::error::SensitivityError;
use crate::given::data::GivenData;
use crate::sample::summary::Spread;

/// Effect (E1) of one input.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Half {
    /// Signed effect, in the unit of the output. It is 0 for an input of which one half has no value.
    pub effect: f64,
    /// t.
    pub student: f64,
}

/// Effects of all inputs.
///
/// # Errors
/// [`SensitivityError::OutOfRange`] for fewer than two outputs, [`SensitivityError::ConstantSample`] if all
/// are equal.
pub fn halves(data: &GivenData) -> Result<Vec<Half>, SensitivityError> {
    Ok(of_observed(&data.observed(2)?))
}

pub(crate) fn of_observed(observed: &Observed) -> Vec<Half> {
    let variance = Spread::of(&observed.outputs).variance();
    let of_input = |column: &Vec<f64>| {
        let median = median(column);
        let [mut above, mut below] = [(0.0, 0.0); 2];
        for (&x, &y) in column.iter().zip(&observed.outputs) {
            let half = match x.total_cmp(&median) {
                std::cmp::Ordering::Greater => &mut above,
                std::cmp::Ordering::Less => &mut below,
                std::cmp::Ordering::Equal => continue,
            };
            *half = (half.0 + 1.0, half.1 + y);
        }
        if above.0 == 0.0 || below.0 == 0.0 {
            return Half { effect: 0.0, student: 0.0 };
        }
        let effect = above.1 / above.0 - below.1 / below.0;
        Half { effect, student: effect.abs() / (variance / above.0 + variance / below.0).sqrt() }
    };
    observed.columns.iter().map(of_input).collect()
}

fn median(values: &[f64]) -> f64 {
    let mut values = values.to_vec();
    let middle = values.len() / 2;
    let (_, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    if values.len() % 2 == 1 {
        return upper;
    }
    let lower = values[..middle].iter().copied().fold(f64::NEG_INFINITY, f64::max);
    lower.midpoint(upper)
}
