//! Which way each input acts: the outputs of its upper half of values against those of its lower half.
//!
//! As in [`crate::measure::effect`], Eq. (Ef1) and (Ef2) there, with the median of the values instead of the
//! middle of a law that is not known:
//!
//! ```text
//! effect = M₊ - M₋,   t = |M₊ - M₋| / √(V / n₋ + V / n₊)                             (Ha1)
//! V = (Σ₊ (y - M₊)² + Σ₋ (y - M₋)²) / (n₊ + n₋ - 2)                                  (Ha2)
//! ```
//!
//! The effect has the unit of the output. For independent random rows t is that of Student's test of two
//! means (Student 1908), with the variance V within the halves and n₊ + n₋ - 2 degrees of freedom. The
//! index of the paper, (Ef2), has the variance of all outputs instead, which contains the effect: it is
//! smaller. Rows of a balanced design make t too small (see [`crate::measure::effect`]). An effect that
//! turns round within the range of an input is not seen.
//!
//! Values equal to the median are in neither half. Where no value lies below it (or none above), as for an
//! input of two levels, they are the lower (or upper) half. A constant input has no halves and no effect.

use serde::{Deserialize, Serialize};

use crate::design::observation::Observed;
use crate::error::SensitivityError;
use crate::given::data::GivenData;
use crate::sample::summary::{Spread, check_varies};

/// Effect (Ha1) of one input.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Half {
    /// Signed effect, in the unit of the output.
    pub effect: f64,
    /// Student's t, positive; none where the outputs do not vary within either half.
    pub student: Option<f64>,
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
    let of_input = |column: &Vec<f64>| {
        let median = median(column);
        // The outputs below the median, at it and above it.
        let mut parts: [Vec<f64>; 3] = Default::default();
        for (x, &y) in column.iter().zip(&observed.outputs) {
            parts[(1 + x.total_cmp(&median) as i8) as usize].push(y);
        }
        let [below, at, above] = parts;
        let (lower, upper) = match (below.is_empty(), above.is_empty()) {
            (false, false) => (below, above),
            (true, false) => (at, above),
            (false, true) => (below, at),
            (true, true) => return None,
        };
        let [of_lower, of_upper] = [&lower, &upper].map(|half| Spread::of(half));
        let [n_lower, n_upper] = [&lower, &upper].map(|half| half.len() as f64);
        let effect = of_upper.mean - of_lower.mean;
        let student = || {
            let variance = (of_lower.squares + of_upper.squares) / (n_lower + n_upper - 2.0);
            effect.abs() / (variance / n_lower + variance / n_upper).sqrt()
        };
        let varies = check_varies(&lower).is_ok() || check_varies(&upper).is_ok();
        Some(Half { effect, student: varies.then(student) })
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
