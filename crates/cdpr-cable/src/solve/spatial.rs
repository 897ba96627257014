//! The force of a cable between points in space; over a pulley with a tilted axis by Newton's method there.

use crate::cable::Cable;
use crate::catenary::Catenary;
use crate::catenary::spatial::{SpatialCable, flat, lifted};
use crate::error::{CableError, SMALLEST, check, check_length};
use crate::solve::end_force::{end_force, end_force_near, guided_start};
use nalgebra::Vector3;

/// The cable of unstrained length `length` [m] to A at `end` [m] from its exit point, which has the force
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
    let at = |force| SpatialCable { cable: *cable, unstrained_length: length, force };
    if !cable.leaves_its_plane() {
        let (end, azimuth) = flat(end);
        let near =
            near.map(|near| Catenary { cable: *cable, unstrained_length: length, force: flat(near).0 });
        let found = match near {
            Some(near) => end_force_near(&near, end)?,
            None => end_force(cable, length, end)?,
        };
        return Ok(at(lifted(found.catenary.force, azimuth)));
    }
    cable.validate()?;
    check_length(length)?;
    check_end(end)?;
    if let Some(force) = near
        && let Ok(found) = newton(at(force), end, 10)
    {
        return Ok(found);
    }
    let start = at(guided_start(cable, length, end)?);
    if cable.is_weightless(length) { Ok(start) } else { newton(start, end, 200) }
}

pub(super) fn check_end(end: Vector3<f64>) -> Result<(), CableError> {
    check("end", end.norm(), end.norm() >= SMALLEST, "an end position away from the entry point [m]")
}

/// Why the search for the force ended: in a cable that turns straight back on its wheel, whose swivel has no
/// direction then, because the end lies where a cable would lean back towards the axis.
fn lost(last: &SpatialCable, end: Vector3<f64>, iterations: usize, residual: f64) -> CableError {
    if last.in_plane().0.wrap() > STRAIGHT_BACK {
        return last.cable.below_the_pulley(end);
    }
    CableError::NotConverged { iterations, residual }
}

/// A cable that lies on its wheel over this angle turns straight back [rad].
const STRAIGHT_BACK: f64 = 0.999 * std::f64::consts::PI;

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
