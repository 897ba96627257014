//! Which way each input acts: the outputs of its upper half of values against those of its lower half.
//!
//! As in [`crate::measure::effect`], Eq. (Ef1) and (Ef2) there, with the median of the values instead of the
//! middle of a law that is not known:
//!
//! ```text
//! effect = M₊ - M₋,   t = |M₊ - M₋| / √(V / n₋ + V / n₊)                             (Ha1)
//! ```
//!
//! The effect has the unit of the output. For independent random rows t is that of Student, with the variance
//! V of all outputs; rows of a balanced design make it too small (see [`crate::measure::effect`]). An effect
//! that turns round within the range of an input is not seen.
//!
//! Values equal to the median are in neither half. Where no value lies below it (or none above), as for an
//! input of two levels, they are the lower (or upper) half. A constant input has no halves and no effect.

use serde::{Deserialize, Serialize};

use crate::design::observation::Observed;
use crate::error::SensitivityError;
use crate::given::data::GivenData;
use crate::sample::summary::Spread;

/// Effect (Ha1) of one input.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Half {
    /// Signed effect, in the unit of the output.
    pub effect: f64,
    /// t.
    pub student: f64,
}

/// Effects of all inputs, `None` for a constant one.
///
/// # Errors
/// [`SensitivityError::OutOfRange`] for fewer than two outputs, [`SensitivityError::ConstantSample`] if all
/// are equal.
pub fn halves(data: &GivenData) -> Result<Vec<Option<Half>>, SensitivityError> {
    Ok(of_observed(&data.observed(2)?))
}

pub(crate) fn of_observed(observed: &Observed) -> Vec<Option<Half>> {
    let variance = Spread::of(&observed.outputs).variance();
    let of_input = |column: &Vec<f64>| {
        let median = median(column);
        // Number and sum of the outputs below the median, at it and above it.
        let mut parts = [(0.0, 0.0); 3];
        for (&x, &y) in column.iter().zip(&observed.outputs) {
            let part = &mut parts[(1 + x.total_cmp(&median) as i8) as usize];
            *part = (part.0 + 1.0, part.1 + y);
        }
        let [below, at, above] = parts;
        let (lower, upper) = match (below.0 > 0.0, above.0 > 0.0) {
            (true, true) => (below, above),
            (false, true) => (at, above),
            (true, false) => (below, at),
            (false, false) => return None,
        };
        let effect = upper.1 / upper.0 - lower.1 / lower.0;
        Some(Half { effect, student: effect.abs() / (variance / upper.0 + variance / lower.0).sqrt() })
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
