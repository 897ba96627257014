//! The unstrained length that gives a wanted tension at the anchor point.
//!
//! Over a given span the tension at A falls as cable is paid out, passes a minimum, and rises again with the
//! weight of the cable that hangs below. The answer is the shorter of the two cables. Newton's method solves
//! for the direction θ of the force and the length `L`, with `f = T (cos θ, sin θ)`:
//!
//! ```text
//! (x, z)(f, L) = end,      d(x, z)/dθ = C (-fz, fx),      d(x, z)/dL = (fx, V0) (1/T0 + 1/EA)
//! ```
//!
//! C is the flexibility. Where that does not end on the falling branch, the length is found by bisection of
//! the tension.

use crate::cable::Cable;
use crate::catenary::Catenary;
use crate::error::{CableError, SMALLEST, check};
use crate::guide::Straight;
use crate::solve::end_force::{Solution, check_end, end_force, straightened};
use crate::solve::held::HeldCable;
use nalgebra::Vector2;

/// The cable from the origin to `end = (x, z)` [m], `x >= 0`, with the tension `tension` [N] at A.
///
/// # Errors
/// [`CableError::InvalidInput`] for an invalid value; [`CableError::TensionTooSmall`], with the least
/// tension, where the weight of the cable alone demands more.
pub fn length_for_tension<'a>(
    cable: &Cable<'a>,
    end: Vector2<f64>,
    tension: f64,
) -> Result<Solution<'a>, CableError> {
    check_inputs(cable, end, tension)?;
    match newton(start(cable, end, tension)?, end, tension) {
        Some(solution) => Ok(solution),
        None => bisect(cable, end, tension).map_err(|error| match error {
            CableError::InvalidInput { field: "unstrained_length", .. } => CableError::InvalidInput {
                field: "end",
                value: end.norm(),
                expected: "an end position that a cable of 1e-30 m to 1e30 m reaches with this tension",
            },
            error => error,
        }),
    }
}

/// The answer of [`length_for_tension`], started from a catenary with nearly this end position and tension.
///
/// # Errors
/// As [`length_for_tension`].
pub fn length_for_tension_near<'a>(
    near: &Catenary<'a>,
    end: Vector2<f64>,
    tension: f64,
) -> Result<Solution<'a>, CableError> {
    check_inputs(&near.cable, end, tension)?;
    let scale = tension / near.anchor_tension();
    let start = Catenary { force: near.force * scale, ..*near };
    match newton(start, end, tension) {
        Some(solution) => Ok(solution),
        None => length_for_tension(&near.cable, end, tension),
    }
}

impl HeldCable<'_> {
    /// The same cable with the tension `tension` [N] at A, on its taut branch.
    ///
    /// # Errors
    /// As [`length_for_tension`].
    pub fn with_tension(&self, tension: f64) -> Result<Self, CableError> {
        Ok(Self::of(length_for_tension_near(&self.catenary, self.end, tension)?.catenary, self.end))
    }
}

fn check_inputs(cable: &Cable, end: Vector2<f64>, tension: f64) -> Result<(), CableError> {
    cable.validate()?;
    check_end(end)?;
    check("tension", tension, tension >= SMALLEST, "a tension from 1e-30 to 1e30 [N]")?;
    check("end", end.norm(), end.norm() >= SMALLEST, "an end position away from the exit point [m]")
}

/// A catenary with nearly this end position and tension.
fn start<'a>(cable: &Cable<'a>, end: Vector2<f64>, tension: f64) -> Result<Catenary<'a>, CableError> {
    let Some(guide) = &cable.guide else { return Ok(taut_start(cable, end, tension)) };
    let (Straight { guided, .. }, plain, beyond) = straightened(cable, guide, end)?;
    // A cable that cannot have this tension without its guide can hardly have it with it: the search for
    // the least tension decides.
    let free = match length_for_tension(&plain, beyond, tension) {
        Ok(solution) => solution.catenary,
        Err(_) => taut_start(&plain, beyond, tension),
    };
    let led = guided / (1.0 + cable.strain(free.exit_tension()));
    Ok(Catenary { cable: *cable, unstrained_length: free.unstrained_length + led, force: free.force })
}

/// A straight spring, rotated by half its weight and lengthened by the sag of a parabola.
fn taut_start<'a>(cable: &Cable<'a>, end: Vector2<f64>, tension: f64) -> Catenary<'a> {
    let chord = end.norm();
    let w = cable.weight_per_length;
    let length = chord / (1.0 + cable.strain(tension));
    let across = w * end.x / (chord * tension);
    let pull = end * (tension / chord) + Vector2::new(0.0, 0.5 * w * length);
    Catenary {
        cable: *cable,
        unstrained_length: length * (1.0 + (across * length).powi(2) / 24.0),
        force: pull * (tension / pull.norm()),
    }
}

fn newton<'a>(start: Catenary<'a>, end: Vector2<f64>, tension: f64) -> Option<Solution<'a>> {
    let chord = end.norm();
    let mut now = start;
    let mut response = now.response();
    for iteration in 1..=20 {
        let per_angle = response.flexibility_matrix() * Vector2::new(-now.force.y, now.force.x);
        let per_length = Vector2::from(response.end_per_length);
        let miss = end - Vector2::from(response.end);
        // Cramer's rule. The step of a singular system is not finite.
        let step = Vector2::new(miss.perp(&per_length), per_angle.perp(&miss)) / per_angle.perp(&per_length);
        let (sin, cos) = step.x.sin_cos();
        let (fx, fz) = (now.force.x, now.force.y);
        now.force = Vector2::new(cos * fx - sin * fz, sin * fx + cos * fz);
        now.force *= tension / now.force.norm();
        now.unstrained_length += step.y;
        if !(step.norm() < 1e3 && now.unstrained_length > 0.0 && now.force.x >= -1e-9 * tension) {
            return None;
        }
        now.force.x = now.force.x.max(0.0);
        response = now.response();
        if step.x.abs() <= 1e-8 && step.y.abs() <= 1e-8 * chord {
            let residual = (end - Vector2::from(response.end)).norm();
            let at_rounding = residual <= 64.0 * f64::EPSILON * (chord + now.unstrained_length);
            let shorter = now.force.dot(&response.force_per_length()) < 0.0;
            return (at_rounding && shorter).then_some(Solution {
                catenary: now,
                end,
                iterations: iteration,
                residual,
            });
        }
    }
    None
}

/// dT/dL [N/m] with both ends held; negative on the branch of the shorter cable.
fn tension_slope(catenary: &Catenary) -> f64 {
    catenary.force.dot(&catenary.response().force_per_length()) / catenary.anchor_tension()
}

fn bisect<'a>(cable: &Cable<'a>, end: Vector2<f64>, tension: f64) -> Result<Solution<'a>, CableError> {
    let lowest = lowest(cable, end, tension)?;
    if lowest.anchor_tension() > tension {
        return Err(CableError::TensionTooSmall { tension, least: lowest.anchor_tension() });
    }
    let mut low = lowest.unstrained_length;
    let mut high = short_enough(cable, end, tension)?;
    let mut iterations = 0;
    while iterations < 200 {
        let middle = 0.5 * (low + high);
        if middle >= low || middle <= high {
            break;
        }
        iterations += 1;
        if end_force(cable, middle, end)?.catenary.anchor_tension() > tension {
            high = middle;
        } else {
            low = middle;
        }
    }
    let solution = end_force(cable, low, end)?;
    Ok(Solution { iterations, ..solution })
}

/// A length [m] so short that the tension is at least `tension` [N].
fn short_enough(cable: &Cable, end: Vector2<f64>, tension: f64) -> Result<f64, CableError> {
    let straight = cable.straight_length(end);
    let mut short = straight / (1.0 + cable.strain(tension + cable.weight_per_length * straight));
    while end_force(cable, short, end)?.catenary.anchor_tension() < tension {
        short *= 0.5;
    }
    Ok(short)
}

/// The catenary of least tension, or the first one found on the way with at most `enough` [N].
fn lowest<'a>(cable: &Cable<'a>, end: Vector2<f64>, enough: f64) -> Result<Catenary<'a>, CableError> {
    let solve = |length: f64| end_force(cable, length, end).map(|solution| solution.catenary);
    // A cable so long that it has passed the least tension; without weight it is slack.
    let mut long = 2.0 * cable.straight_length(end);
    while cable.weight_per_length > 0.0 && tension_slope(&solve(long)?) < 0.0 {
        long *= 2.0;
    }
    let (mut falling, mut rising) = (short_enough(cable, end, enough)?, long);
    for _ in 0..200 {
        let middle = 0.5 * (falling + rising);
        if middle <= falling || middle >= rising {
            break;
        }
        let catenary = solve(middle)?;
        if catenary.anchor_tension() <= enough {
            return Ok(catenary);
        }
        if tension_slope(&catenary) < 0.0 {
            falling = middle;
        } else {
            rising = middle;
        }
    }
    let (before, after) = (solve(falling)?, solve(rising)?);
    Ok(if before.anchor_tension() < after.anchor_tension() { before } else { after })
}
