//! The force of a cable over a pulley with a tilted axis, by Newton's method in space.

use crate::cable::Cable;
use crate::catenary::spatial::{SpatialCable, guide, horizontal};
use crate::error::{CableError, SMALLEST, check, check_length};
use crate::guide::Straight;
use crate::solve::end_force::end_force;
use nalgebra::{Vector2, Vector3};

/// The cable of unstrained length `length` [m] over its pulley to A at `end` [m] from D, which has the force
/// `near` [N] there or thereabouts.
///
/// # Errors
/// [`CableError::InvalidInput`] for an invalid value; [`CableError::NotConverged`] with the residual.
pub fn spatial_end_force<'a>(
    cable: &Cable<'a>,
    length: f64,
    end: Vector3<f64>,
    near: Option<Vector3<f64>>,
) -> Result<SpatialCable<'a>, CableError> {
    cable.validate()?;
    check_length(length)?;
    check_end(end)?;
    let at = |force| SpatialCable { cable: *cable, unstrained_length: length, force };
    if let Some(force) = near
        && let Ok(found) = newton(at(force), end, 10)
    {
        return Ok(found);
    }
    let (straight, plain, beyond) = straightened(cable, end)?;
    let strain = ((straight.free + straight.guided) / length - 1.0).max(cable.strain(0.0));
    let (in_plane, azimuth) = flat(beyond);
    let force = end_force(&plain, length - straight.guided / (1.0 + strain), in_plane)?.catenary.force;
    let start = at(lifted(force, azimuth));
    if cable.is_weightless(length) { Ok(start) } else { newton(start, end, 200) }
}

pub(super) fn check_end(end: Vector3<f64>) -> Result<(), CableError> {
    check("end", end.norm(), end.norm() >= SMALLEST, "an end position away from the entry point [m]")
}

/// The straight cable to `end` [m], the cable without its guide, and the end from where it leaves the wheel.
pub(super) fn straightened<'a>(
    cable: &Cable<'a>,
    end: Vector3<f64>,
) -> Result<(Straight, Cable<'a>, Vector3<f64>), CableError> {
    let guide = guide(cable);
    let axis = Vector3::from(guide.entry.axis());
    let straight = guide.straight(end).ok_or_else(|| below_the_pulley(end, axis))?;
    let beyond = end - straight.leave;
    Ok((straight, Cable { guide: None, ..*cable }, beyond))
}

fn below_the_pulley(end: Vector3<f64>, axis: Vector3<f64>) -> CableError {
    CableError::InvalidInput {
        field: "end",
        value: (end - axis * end.dot(&axis)).norm(),
        expected: "a distance [m] from the swivel axis at which the cable can leave the pulley away from the \
                   axis: more than its diameter beyond the wheel",
    }
}

/// Why the search for the force ended: in a cable that turns straight back on its wheel, whose swivel has no
/// direction then, because the end lies where a cable would lean back towards the axis.
fn lost(last: &SpatialCable, end: Vector3<f64>, iterations: usize, residual: f64) -> CableError {
    if last.in_plane().0.wrap() > STRAIGHT_BACK {
        return below_the_pulley(end, guide(&last.cable).entry.axis().into());
    }
    CableError::NotConverged { iterations, residual }
}

/// A cable that lies on its wheel over this angle turns straight back [rad].
const STRAIGHT_BACK: f64 = 0.999 * std::f64::consts::PI;

/// A vector in its vertical plane, and the direction of the plane.
pub(super) fn flat(v: Vector3<f64>) -> (Vector2<f64>, [f64; 2]) {
    let (x, azimuth) = horizontal(&v.into());
    (Vector2::new(x, v.z), azimuth)
}

pub(super) fn lifted(v: Vector2<f64>, [c, s]: [f64; 2]) -> Vector3<f64> {
    Vector3::new(c * v.x, s * v.x, v.y)
}

fn newton<'a>(
    start: SpatialCable<'a>,
    end: Vector3<f64>,
    iterations: usize,
) -> Result<SpatialCable<'a>, CableError> {
    let mut now = start;
    let mut response = now.response();
    let mut residual = end - response.end;
    let size = now.unstrained_length + end.norm();
    for iteration in 1..=iterations {
        let failed = || lost(&now, end, iteration, residual.norm());
        let stiffness = response.flexibility.try_inverse().ok_or_else(failed)?;
        let step = stiffness * residual;
        let forces = now.force.norm() + now.cable.weight_per_length * now.unstrained_length;
        // Of its own sums, and of the force that the end is computed from.
        let rounding = f64::EPSILON * (size + response.flexibility.norm() * forces);
        let at_rounding = |share: f64| residual.norm() <= share * rounding.min(1e-12 * size);
        if at_rounding(16.0) {
            // One more step, as long as it brings the end nearer.
            let last = SpatialCable { force: now.force + step, ..now };
            let nearer = (end - last.response().end).norm() < residual.norm();
            return Ok(if nearer { last } else { now });
        }
        let mut fraction = 1.0;
        loop {
            let next = SpatialCable { force: now.force + fraction * step, ..now };
            let next_response = next.response();
            let next_residual = end - next_response.end;
            // Not past the maximum of the concave function along the step, or clearly closer.
            let forwards = next_residual.dot(&step) >= 0.0;
            if next_residual.norm() <= 0.5 * residual.norm() || (forwards && next_residual.norm().is_finite())
            {
                (now, response, residual) = (next, next_response, next_residual);
                break;
            }
            fraction *= 0.5;
            if fraction < 1e-14 {
                // No step gains anything: the residual is rounding, or there is no solution.
                return if at_rounding(1e3) { Ok(now) } else { Err(failed()) };
            }
        }
    }
    Err(lost(&now, end, iterations, residual.norm()))
}
