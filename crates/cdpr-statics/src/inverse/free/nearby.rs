//! The rest of a robot that differs a little from one whose rest is known.
//!
//! From the chord forces and coordinates of the known rest, steps in (ln σ, q) follow the inverse H of its
//! slopes, which Broyden's update (1965) corrects by each step s and the change y of the residual,
//!
//! ```text
//! H' = H + (s - H y) sᵀH/(s·H y)                                                                  (I8)
//! ```
//!
//! so that no slope is computed anew as long as every step halves the residual at least.

use super::search::{Outcome, Point, ROUNDING, SINGULAR_VALUES, SOLVED, Search, Unknowns};
use super::sound::Loops;
use super::{check_free, held_at};
use crate::error::StaticsError;
use crate::inverse::HeldPose;
use crate::rest_fault::RestFault;
use crate::state::{Equilibrium, Load, WantedPose};
use cdpr_robot::{Coordinate, Pose, Robot};
use nalgebra::{DMatrix, DVector};

/// A platform that rests under its own weight with free coordinates, from which the rest of other robots is
/// found.
#[derive(Clone, Debug)]
pub(crate) struct FreeBranch {
    free: Vec<Coordinate>,
    rest: HeldPose,
    /// Where steps start; `None` where the slopes have no inverse.
    start: Option<Known>,
}

/// What is known of a rest.
#[derive(Clone, Debug)]
struct Known {
    /// Changes of the free coordinates, in their units.
    changes: Vec<f64>,
    /// [N]
    chord_forces: Vec<f64>,
    /// H, the inverse of dF/d(ln σ, q).
    inverse: DMatrix<f64>,
}

/// Steps until a residual that is halved at least by each is rounding.
const MAX_STEPS: usize = 60;

impl FreeBranch {
    /// The rest of `robot` beside `pose`, as [`crate::inverse`] finds it.
    ///
    /// # Errors
    /// Those of [`crate::inverse`].
    pub(crate) fn of(robot: &Robot, pose: &Pose, free: &[Coordinate]) -> Result<Self, StaticsError> {
        check_free(robot, free)?;
        let none = Load::none();
        let rest = held_at(robot, &WantedPose::at(pose).free(free), &none)?;
        let search = Search::new(robot, &rest.equilibrium.pose, &none, free)?;
        let start = search
            .known(chord_forces(robot, &rest.equilibrium))
            .and_then(|near| Some(search.follow(near)?.1));
        Ok(Self { free: free.to_vec(), rest, start })
    }

    /// Where the platform rests.
    pub(crate) fn rest(&self) -> &HeldPose {
        &self.rest
    }

    /// The free coordinates.
    pub(crate) fn coordinates(&self) -> &[Coordinate] {
        &self.free
    }

    /// The rest of a robot that differs a little: the one to which steps lead from this one, if it is stable,
    /// within the limits of tension and close to it, or else that of [`crate::inverse`].
    ///
    /// # Errors
    /// Those of [`crate::inverse`].
    pub(crate) fn nearby(&self, robot: &Robot) -> Result<HeldPose, StaticsError> {
        let (pose, none) = (&self.rest.equilibrium.pose, Load::none());
        if let Some(known) = &self.start {
            let search = Search::new(robot, pose, &none, &self.free)?;
            if let Some((point, _)) = search.follow(known.clone())
                && let Some(found) = search.accepted(point, 0)?
            {
                return Ok(HeldPose { lengths: found.lengths, equilibrium: found.equilibrium });
            }
        }
        held_at(robot, &WantedPose::at(pose).free(&self.free), &none)
    }
}

/// The rest under another load to which steps lead from one nearby, in or out of the limits, stable or
/// not: the same branch.
///
/// # Errors
/// [`StaticsError::NoRest`] where the steps lead to none, to a loop or below the ground; those of
/// [`crate::free_coordinates::free_solutions`] for invalid inputs.
pub fn rest_near(
    robot: &Robot,
    near: &Equilibrium,
    load: &Load,
    free: &[Coordinate],
) -> Result<HeldPose, StaticsError> {
    check_free(robot, free)?;
    let search = Search::new(robot, &near.pose, load, free)?;
    let chord_forces = search.in_proportion(chord_forces(robot, near));
    let start = Unknowns { changes: vec![0.0; free.len()], chord_forces };
    let no_rest = |nearest| Err(StaticsError::NoRest { starts: 1, nearest });
    let point = match search.descend(start) {
        Outcome::Found(point, ..) => point,
        Outcome::Stuck(point) => return no_rest(search.left(&point)),
        Outcome::Lost => return no_rest(search.unbalanced()),
    };
    match Loops::Refused.fault(robot, &point.held) {
        None | Some(RestFault::Limit(_)) => Ok(point.held),
        Some(fault) => no_rest(fault),
    }
}

/// Chord forces of the cables [N], (C16) of `cdpr_cable`; of vertical ones their tensions.
fn chord_forces(robot: &Robot, equilibrium: &Equilibrium) -> Vec<f64> {
    let of_cable = |(i, force): (usize, &cdpr_robot::Vector2<f64>)| {
        let span = robot.span(&equilibrium.pose, i);
        let span = robot.gravity.level().map_or(span, |level| level * span);
        let across = span.xy().norm();
        if across > 1e-6 * span.norm() { force.x * span.norm() / across } else { force.norm() }
    };
    equilibrium.cable_forces.iter().enumerate().map(of_cable).collect()
}

impl Search<'_> {
    /// Chord forces [N] in proportion to the load, where this leaves less of the balance than the forces that
    /// hold another load.
    fn in_proportion(&self, chord_forces: Vec<f64>) -> Vec<f64> {
        let changes = vec![0.0; self.free.len()];
        let Some(point) = self.point(&changes, &chord_forces) else { return chord_forces };
        let external = self.question.external;
        let ratio = external.norm() / (point.residual - external).norm();
        if !(ratio.is_finite() && ratio > 0.0) {
            return chord_forces;
        }
        let scaled: Vec<f64> = chord_forces.iter().map(|force| ratio * force).collect();
        let left = |point: &Point| point.residual.norm() / point.forces;
        let is_nearer = self.point(&changes, &scaled).is_some_and(|other| left(&other) < left(&point));
        if is_nearer { scaled } else { chord_forces }
    }

    /// The given coordinates with these chord forces [N].
    fn known(&self, chord_forces: Vec<f64>) -> Option<Known> {
        let changes = vec![0.0; self.free.len()];
        let point = self.point(&changes, &chord_forces)?;
        let inverse = self.inverse_slopes(&changes, &chord_forces, &point)?;
        Some(Known { changes, chord_forces, inverse })
    }

    fn inverse_slopes(&self, changes: &[f64], chord_forces: &[f64], point: &Point) -> Option<DMatrix<f64>> {
        let slopes = self.slopes(changes, chord_forces, point)?;
        let svd = slopes.try_svd(true, true, f64::EPSILON, SINGULAR_VALUES)?;
        let greatest = svd.singular_values.max();
        svd.pseudo_inverse(1e-13 * greatest).ok()
    }

    /// The solution that steps lead to which halve the residual at least, and what is known of it.
    fn follow(&self, mut known: Known) -> Option<(Point, Known)> {
        let mut point = self.point(&known.changes, &known.chord_forces)?;
        // Slopes are computed anew where those at hand do not halve the residual.
        let mut exact = false;
        for _ in 0..MAX_STEPS {
            let norm = point.residual.norm();
            if norm <= ROUNDING * point.forces {
                return Some((point, known));
            }
            let residual = DVector::from_column_slice(point.residual.as_slice());
            let step = -(&known.inverse * &residual);
            let moved = self.moved(&known.changes, &known.chord_forces, &step);
            let moved = moved.filter(|(_, _, next)| next.residual.norm() <= 0.5 * norm);
            let Some((changes, chord_forces, next)) = moved else {
                if norm <= SOLVED * point.forces {
                    return Some((point, known));
                }
                if exact {
                    return None;
                }
                known.inverse = self.inverse_slopes(&known.changes, &known.chord_forces, &point)?;
                exact = true;
                continue;
            };
            let change = DVector::from_column_slice((next.residual - point.residual).as_slice());
            let predicted = &known.inverse * change;
            let row = step.transpose() * &known.inverse;
            let scale = step.dot(&predicted);
            known.inverse += (&step - predicted) * row / scale;
            (known.changes, known.chord_forces, point) = (changes, chord_forces, next);
            exact = false;
        }
        None
    }
}
