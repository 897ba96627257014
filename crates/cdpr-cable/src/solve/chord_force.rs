//! The cable of least tension of all between the same fixed ends, by its chord force.

use crate::cable::Cable;
use crate::error::{CableError, SMALLEST, check};

/// A cable between fixed ends as a function of its chord force alone.
pub(crate) trait ByChordForce: Sized {
    /// σ [N].
    fn chord_force(&self) -> f64;
    /// dt/dσ and d²t/dσ² [1/N].
    fn tension_slopes(&self) -> [f64; 2];
    /// The cable with another chord force [N].
    fn to(&self, chord_force: f64) -> Result<Self, CableError>;
}

/// A cable below this chord force, relative to its weight per length times the chord, is nearly vertical and
/// folded, or has passed its least tension. Its tension at A is within 1e-10 of its weight of that at any
/// lower chord force, which rounding of the vertical force at B would hide.
const FOLDED: f64 = 1.0 / 24.0;

/// The cable of least tension at A; `first` has a chord force [N].
///
/// Weight per length times `chord` [m] is the scale of chord forces. It is the chord of a plain cable; over a
/// guide, where the chord from the leave point covers the horizontal distance h' of the whole one, c over h,
/// it is `c h'/h`, because both have the same fx.
pub(crate) fn at_least_tension<Held: ByChordForce>(
    cable: &Cable,
    chord: f64,
    first: impl FnOnce(f64) -> Result<Held, CableError>,
) -> Result<Held, CableError> {
    let w = cable.weight_per_length;
    check("weight_per_length", w, w >= SMALLEST, "a weight per length from 1e-30 to 1e30 [N/m]")?;
    let folded = FOLDED * w * chord;
    // The least tension of a level cable, w h/2 coth u with u tanh u = 1.
    let mut now = first(w * chord / 2.4)?;
    let (mut low, mut high) = (folded, f64::INFINITY);
    for _ in 0..100 {
        let (sigma, [slope, second]) = (now.chord_force(), now.tension_slopes());
        *(if slope > 0.0 { &mut high } else { &mut low }) = sigma;
        // Newton's method for dt/d(ln σ) = 0, within a factor of e and the bounds.
        let curvature = slope + sigma * second;
        let step = if curvature > 0.0 { -slope / curvature } else { -slope.signum() };
        let mut next = sigma * step.clamp(-1.0, 1.0).exp();
        if next <= low || next >= high {
            next = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * sigma };
        }
        if next <= 1.001 * folded {
            return Ok(now);
        }
        now = now.to(next)?;
        // The step squares this one.
        if (next - sigma).abs() <= 1e-8 * sigma {
            return Ok(now);
        }
    }
    Ok(now)
}
