//! The end force of a cable for a given end position and unstrained length.
//!
//! The force maximizes the concave function `f·r - U*(f)`, so it is unique. Newton's method on the gradient
//! `r - (x, z)(f)`, which halves a step until it does not pass the maximum, starts from the better of two
//! approximations:
//!
//! * taut: a spring along the chord whose elongation makes up for the sag of a parabola,
//!   `T/EA - w² x² L²/(24 l² T²) = (l - L)/L` with l the chord (Irvine 1981, section 2.3, inclined as in
//!   section 2.5);
//! * slack: the inextensible catenary, `sinh λ/λ = sqrt(L² - z²)/x`, `fx = w x/(2λ)`,
//!   `fz = (w/2)(z coth λ + L)`.
//!
//! A vertical cable (`x = 0`) is the limit of a nearly vertical one.

use crate::cable::Cable;
use crate::catenary::Catenary;
use crate::catenary::spatial::{flat, lifted};
use crate::error::{CableError, SMALLEST, check, check_length};
use crate::guide::{Straight, in_plane};
use crate::kernel::Response;
use crate::law::ElasticLaw;
use nalgebra::{Vector2, Vector3};

/// A cable in equilibrium between two given points, with its closure residual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution<'a> {
    /// The equilibrium.
    pub catenary: Catenary<'a>,
    /// Prescribed end position (x, z), or that follows from a given force [m].
    pub end: Vector2<f64>,
    /// Iterations of Newton's method; 0 for a closed form.
    pub iterations: usize,
    /// Distance between the end of the catenary and the prescribed end [m].
    pub residual: f64,
}

impl<'a> Solution<'a> {
    pub(crate) fn of(catenary: Catenary<'a>, end: Vector2<f64>, iterations: usize) -> Self {
        Self { catenary, end, iterations, residual: catenary.closure(end).norm() }
    }
}

/// Share of the length that stands for the horizontal distance of a vertical cable: its horizontal force is
/// below rounding of the weight.
const VERTICAL: f64 = 1e-18;

const MAX_ITERATIONS: usize = 200;

/// After this many iterations from a start that is given as near, the closed-form starts are faster.
const MAX_ITERATIONS_NEAR: usize = 8;

/// A step below this, relative to the force at either end, is the last one.
///
/// Newton's method squares the error: what is left is below rounding.
const LAST_STEP: f64 = 1e-8;

/// The force on a cable of this unstrained length [m] whose end A lies at `end = (x, z)` [m], `x >= 0`.
///
/// Every input has exactly one answer: a chord longer than the cable strains it, a shorter one lets it hang.
///
/// # Errors
/// [`CableError::InvalidInput`] for an invalid value; [`CableError::NotConverged`] with the closure residual.
pub fn end_force<'a>(
    cable: &Cable<'a>,
    unstrained_length: f64,
    end: Vector2<f64>,
) -> Result<Solution<'a>, CableError> {
    cable.validate()?;
    check_length(unstrained_length)?;
    check_end(end)?;
    let at = |force| Catenary { cable: *cable, unstrained_length, force };
    if cable.guide.is_some() {
        check_plane(cable)?;
        let start = at(flat(guided_start(cable, unstrained_length, in_plane(end.into()))?).0);
        return if cable.is_weightless(unstrained_length) {
            Ok(Solution::of(start, end, 0))
        } else {
            newton(start, end, MAX_ITERATIONS)
        };
    }
    if cable.is_weightless(unstrained_length) {
        let cable = &Cable { weight_per_length: 0.0, ..*cable };
        let at = |force| Catenary { cable: *cable, unstrained_length, force };
        return Ok(Solution::of(at(spring_force(cable, unstrained_length, end)), end, 0));
    }
    let (given, end) = (end, Vector2::new(end.x.max(VERTICAL * unstrained_length), end.y));
    let dual = |force: Vector2<f64>| force.dot(&end) - at(force).complementary_energy();
    let taut = taut_start(cable, unstrained_length, end);
    let slack = slack_start(cable, unstrained_length, end);
    let start = match (taut, slack) {
        (Some(taut), Some(slack)) if dual(slack) > dual(taut) => slack,
        (Some(taut), _) => taut,
        (None, Some(slack)) => slack,
        (None, None) => Vector2::new(cable.weight_per_length * unstrained_length, 0.0),
    };
    let mut solution = newton(at(start), end, MAX_ITERATIONS)?;
    if given != end {
        (solution.end, solution.catenary.force.x) = (given, 0.0);
    }
    Ok(solution)
}

/// The answer of [`end_force`], started from a catenary with nearly this end position.
///
/// It takes fewer iterations where `near` is near, and gives the same answer from anywhere.
///
/// # Errors
/// As [`end_force`].
pub fn end_force_near<'a>(near: &Catenary<'a>, end: Vector2<f64>) -> Result<Solution<'a>, CableError> {
    let regular = near.force.x > 0.0 && !near.cable.is_weightless(near.unstrained_length);
    if regular && end.x > VERTICAL * near.unstrained_length && end.x.is_finite() && end.y.is_finite() {
        let solution = newton(*near, end, MAX_ITERATIONS_NEAR);
        // From a distant start the iteration may end at a nearly folded cable, whose rounding explains any
        // residual.
        let exact = 1e-13 * (near.unstrained_length + end.norm());
        if solution.as_ref().is_ok_and(|solution| solution.residual <= exact) {
            return solution;
        }
    }
    end_force(&near.cable, near.unstrained_length, end)
}

/// The force [N] of a cable to A at `end` [m] that leaves its pulley where a straight one does; exact without
/// weight.
pub(super) fn guided_start(
    cable: &Cable,
    unstrained_length: f64,
    end: Vector3<f64>,
) -> Result<Vector3<f64>, CableError> {
    let (Straight { free, guided, .. }, plain, beyond) = cable.straightened(end)?;
    let strain = ((free + guided) / unstrained_length - 1.0).max(cable.strain(0.0));
    // At least what the strain leaves to it, however long the lead.
    let least = unstrained_length * (free / (free + guided));
    let rest = (unstrained_length - guided / (1.0 + strain)).max(least);
    check(
        "unstrained_length",
        unstrained_length,
        rest >= SMALLEST,
        "a length of which 1e-30 m or more remain beyond lead and pulley [m]",
    )?;
    let (beyond, azimuth) = flat(beyond);
    Ok(lifted(end_force(&plain, rest, beyond)?.catenary.force, azimuth))
}

/// Refuses a cable over a tilted axis.
pub(crate) fn check_plane(cable: &Cable) -> Result<(), CableError> {
    const UPRIGHT: &str = "a vertical axis: cables over pulleys with other axes do not stay in a known plane";
    check("pulley.axis", 0.0, !cable.leaves_its_plane(), UPRIGHT)
}

/// Checks that an end position is finite and not on the wrong side of the exit point.
pub(crate) fn check_end(end: Vector2<f64>) -> Result<(), CableError> {
    check("end.x", end.x, end.x >= 0.0, "a finite horizontal distance, zero or more [m]")?;
    check("end.z", end.y, true, "a finite height difference [m]")
}

fn newton<'a>(start: Catenary<'a>, end: Vector2<f64>, iterations: usize) -> Result<Solution<'a>, CableError> {
    let mut catenary = start;
    let mut response = catenary.response();
    let mut residual = end - Vector2::from(response.end);
    for iteration in 1..=iterations {
        let force = catenary.force;
        let rounding = rounding(&catenary, &response, end);
        // A residual below rounding is left alone: for a stiff cable it is worth a visible force.
        let above = residual.zip_map(&rounding, |open, noise| if open.abs() <= noise { 0.0 } else { open });
        let step = response.stiffness_matrix() * above;
        let mut fraction = 1.0;
        let next = loop {
            let tried = force + fraction * step;
            // The horizontal force stays positive: a step takes nine tenths of it away at most.
            catenary.force = Vector2::new(tried.x.max(0.1 * force.x), tried.y);
            let next_response = catenary.response();
            let next_residual = end - Vector2::from(next_response.end);
            // Not past the maximum along the step, but for rounding: then the concave function has grown. Or
            // clearly closer.
            let moved = catenary.force - force;
            if next_residual.dot(&moved) >= -rounding.dot(&moved.abs())
                || next_residual.norm() <= 0.5 * residual.norm()
            {
                break Some((next_response, next_residual, moved));
            }
            fraction *= 0.5;
            // A nearly vertical cable as long as its chord needs steps down to a ten billionth.
            if fraction < 1e-14 {
                break None;
            }
        };
        let Some((next_response, next_residual, moved)) = next else {
            // No step gains anything: the residual is rounding, or there is no solution.
            return accept(Catenary { force, ..catenary }, end, iteration);
        };
        let at_rounding = next_residual.x.abs() <= rounding.x && next_residual.y.abs() <= rounding.y;
        // After a full step as small as this the next one is below rounding, unless the step met a kink or
        // left out the asymmetry of a guide.
        let last = fraction == 1.0
            && matches!(catenary.cable.law, ElasticLaw::Linear)
            && catenary.cable.guide.is_none()
            && moved.x.abs() <= LAST_STEP * catenary.force.x
            && moved.y.abs() <= LAST_STEP * catenary.anchor_tension().min(catenary.exit_tension());
        (response, residual) = (next_response, next_residual);
        if last || at_rounding {
            return accept(catenary, end, iteration);
        }
    }
    accept(catenary, end, iterations)
}

/// Rounding error of the computed end position [m]: of its own sums and of the force it is computed from.
#[inline(always)]
fn rounding(catenary: &Catenary, response: &Response<f64>, end: Vector2<f64>) -> Vector2<f64> {
    let forces = Vector2::new(catenary.force.x, catenary.force.y.abs() + catenary.weight());
    let sums = Vector2::new(8.0 * end.x, 2.0 * (catenary.unstrained_length + end.norm()));
    f64::EPSILON * (sums + response.flexibility_matrix().abs() * forces)
}

fn accept<'a>(
    catenary: Catenary<'a>,
    end: Vector2<f64>,
    iterations: usize,
) -> Result<Solution<'a>, CableError> {
    let solution = Solution::of(catenary, end, iterations);
    // However large the rounding may be, an end farther off than this is no solution.
    let largest = 1e-9 * (catenary.unstrained_length + end.norm());
    if solution.residual <= (16.0 * rounding(&catenary, &catenary.response(), end).norm()).min(largest) {
        Ok(solution)
    } else {
        Err(CableError::NotConverged { iterations, residual: solution.residual })
    }
}

/// Force of a cable without weight, a spring that cannot push.
fn spring_force(cable: &Cable, unstrained_length: f64, end: Vector2<f64>) -> Vector2<f64> {
    let chord = end.norm();
    if let ElasticLaw::Piecewise(_) = cable.law {
        let tension = cable.tension((chord - unstrained_length) / unstrained_length);
        return if tension > 0.0 { end * (tension / chord) } else { Vector2::zeros() };
    }
    if chord <= unstrained_length {
        return Vector2::zeros();
    }
    end * (cable.axial_stiffness * (chord - unstrained_length) / (unstrained_length * chord))
}

fn taut_start(cable: &Cable, unstrained_length: f64, end: Vector2<f64>) -> Option<Vector2<f64>> {
    let Cable { weight_per_length: w, axial_stiffness: ea, .. } = *cable;
    let chord = end.norm();
    let strain = (chord - unstrained_length) / unstrained_length;
    let across = w * unstrained_length * end.x / chord;
    let k = across * across / 24.0;
    let floor = (k * ea).cbrt();
    if floor == 0.0 {
        return None;
    }
    // T/EA - k/T² grows and is concave: from below, Newton's method climbs to the root.
    let mut tension =
        if strain >= 0.0 { floor.max(ea * strain) } else { 1.0 / ((-strain / k).sqrt() + 1.0 / floor) };
    for _ in 0..6 {
        let sag = k / (tension * tension);
        tension += (strain - tension / ea + sag) / (1.0 / ea + 2.0 * sag / tension);
    }
    Some(end * (tension / chord) + Vector2::new(0.0, 0.5 * w * unstrained_length))
}

fn slack_start(cable: &Cable, unstrained_length: f64, end: Vector2<f64>) -> Option<Vector2<f64>> {
    let (x, z) = (end.x, end.y);
    if unstrained_length <= end.norm() {
        return None;
    }
    let ratio = ((unstrained_length - z) * (unstrained_length + z)).sqrt() / x;
    let target = ratio.ln();
    let mut lambda = if ratio < 3.0 { (6.0 * (ratio - 1.0)).sqrt() } else { (2.0 * ratio).ln() };
    for _ in 0..8 {
        // ln(sinh λ/λ) - ln(ratio)
        let error = lambda + (-(-2.0 * lambda).exp()).ln_1p() - (2.0 * lambda).ln() - target;
        let slope = 1.0 / lambda.tanh() - 1.0 / lambda;
        lambda = (lambda - error / slope).max(0.5 * lambda);
    }
    let w = cable.weight_per_length;
    let force = Vector2::new(w * x / (2.0 * lambda), 0.5 * w * (z / lambda.tanh() + unstrained_length));
    force.iter().all(|f| f.is_finite()).then_some(force)
}
