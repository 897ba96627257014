//! The rest of a robot that differs a little from one whose rest is known.
//!
//! Newton's steps lead to it from the chord forces and coordinates of the known rest, each of which halves
//! the residual at least.

use super::search::{Outcome, Point, ROUNDING, SOLVED, Search, Unknowns, newton_step};
use super::solution::FreeSolution;
use super::sound::Loops;
use super::{NEXT_TO_POSE, Nearby, check_free, lengths_at};
use crate::error::StaticsError;
use crate::inverse::PoseLengths;
use crate::rest_fault::RestFault;
use crate::state::{Equilibrium, Load, WantedPose};
use cdpr_robot::{Coordinate, Pose, Robot};

/// A platform that rests under its own weight with free coordinates, from which the rest of other robots is
/// found.
#[derive(Clone, Debug)]
pub(crate) struct FreeBranch {
    free: Vec<Coordinate>,
    rest: PoseLengths,
    /// Where steps start; `None` where none led there.
    start: Option<Unknowns>,
    /// Whether it is nearly that of straight cables, so that these show what becomes of it.
    is_straight: bool,
}

/// Steps until a residual that is halved at least by each is rounding.
const MAX_STEPS: usize = 60;

/// A rest belongs to a known one where steps lead from that to it, no farther than this, in radians and
/// relative to the longest span.
const REACH: f64 = 0.3;

/// Starts from which straight cables are solved before a rest is called lost.
const STARTS: usize = 9;

impl FreeBranch {
    /// The rest of `robot` near `pose`, as [`crate::inverse`] finds it.
    ///
    /// # Errors
    /// Those of [`crate::inverse`].
    pub(crate) fn of(robot: &Robot, pose: &Pose, free: &[Coordinate]) -> Result<Self, StaticsError> {
        check_free(robot, free)?;
        let none = Load::none();
        let rest = lengths_at(robot, &WantedPose::at(pose).free(free), &none)?;
        let search = Search::new(robot, &rest.equilibrium.pose, &none, free)?;
        let changes = vec![0.0; free.len()];
        let near = Unknowns { changes, chord_forces: chord_forces(robot, &rest.equilibrium) };
        let start = search.follow(near).map(|(_, start)| start);
        let is_straight = search.is_straight();
        Ok(Self { free: free.to_vec(), rest, start, is_straight })
    }

    /// Where the platform rests.
    pub(crate) fn rest(&self) -> &PoseLengths {
        &self.rest
    }

    /// The free coordinates.
    pub(crate) fn coordinates(&self) -> &[Coordinate] {
        &self.free
    }

    /// The rest of a robot that differs a little: the one that belongs to this one.
    ///
    /// Where that is out of limits, below the ground or unstable, where a cable would have to push, or where
    /// it is lost, no other is looked for. Where the steps lead far away, or where cables that sag may hold
    /// the platform otherwise, the rest is that of [`crate::inverse`].
    ///
    /// # Errors
    /// [`StaticsError::NoRest`] and [`StaticsError::Unstable`] for such a rest; those of [`crate::inverse`].
    pub(crate) fn nearby(&self, robot: &Robot) -> Result<PoseLengths, StaticsError> {
        let (pose, none) = (&self.rest.equilibrium.pose, Load::none());
        let search = Search::new(robot, pose, &none, &self.free)?;
        let found = match &self.start {
            Some(known) => search.belonging(known.clone(), self.is_straight)?,
            None => None,
        };
        match found {
            Some(FreeSolution { lengths, equilibrium, .. }) => Ok(PoseLengths { lengths, equilibrium }),
            None => lengths_at(robot, &WantedPose::at(pose).free(&self.free), &none),
        }
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
) -> Result<PoseLengths, StaticsError> {
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
    match Loops::Refused.fault(robot, &point.found) {
        None | Some(RestFault::Limit(_)) => Ok(point.found),
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
    /// The rest that belongs to a known one; `None` where that is open.
    ///
    /// # Errors
    /// [`StaticsError::NoRest`] and [`StaticsError::Unstable`] where it is refused or lost.
    fn belonging(&self, known: Unknowns, is_straight: bool) -> Result<Option<FreeSolution>, StaticsError> {
        if let Some((point, _)) = self.follow(known) {
            return self.decided(point, 0, REACH)?.solution();
        }
        let given = vec![0.0; self.free.len()];
        let chord_forces = self.straight_forces(&given);
        // Whether a rest next to the known one may be left, whether one may be farther away.
        let (mut is_open, mut is_far, mut nearest) = (!is_straight, false, None);
        match self.reached(Unknowns { changes: given, chord_forces })? {
            Ok(Nearby::Solution(found)) => return Ok(Some(*found)),
            Ok(Nearby::Refused(error)) => return Err(error),
            Ok(Nearby::Open) => is_far = true,
            Err(left) => nearest = Some(left),
        }
        let starts = (0..if is_straight { STARTS } else { 0 }).map(|start| self.start(start, [REACH, REACH]));
        for root in starts.filter_map(|start| self.straight_root(start)) {
            let (cable, tension) = root.slackest();
            if root.distance > REACH {
                is_far |= self.may_sag(&root);
                continue;
            }
            if self.may_sag(&root) {
                match self.reached(root.unknowns(self.least_force()))? {
                    Ok(Nearby::Solution(found)) => return Ok(Some(*found)),
                    Ok(Nearby::Refused(error)) => return Err(error),
                    Ok(Nearby::Open) => is_open = true,
                    Err(_) => is_open |= tension > 0.0,
                }
            }
            let fault = RestFault::Pushing { cable, force: -tension };
            let is_less = |old: &RestFault| (fault.order(), fault.extent()) < (old.order(), old.extent());
            if tension < 0.0 && nearest.as_ref().is_none_or(is_less) {
                nearest = Some(fault);
            }
        }
        match nearest {
            Some(RestFault::Residual { .. }) if is_far => Ok(None),
            Some(nearest) if !is_open => Err(StaticsError::NoRest { starts: 1, nearest }),
            _ => Ok(None),
        }
    }

    /// What the solution decides to which the search leads, or what it leaves of the balance.
    fn reached(&self, from: Unknowns) -> Result<Result<Nearby, RestFault>, StaticsError> {
        let (point, unknowns, iterations) = match self.descend(from) {
            Outcome::Found(point, unknowns, iterations) => (point, unknowns, iterations),
            Outcome::Stuck(point) => return Ok(Err(self.left(&point))),
            Outcome::Lost => return Ok(Err(self.unbalanced())),
        };
        let decided = self.decided(point, iterations, REACH)?;
        if matches!(decided, Nearby::Solution(_)) {
            self.check_unique(&unknowns)?;
        }
        Ok(Ok(decided))
    }

    /// Whether straight cables hold the platform next to the given coordinates.
    fn is_straight(&self) -> bool {
        let root = self.straight_root(vec![0.0; self.free.len()]);
        root.is_some_and(|root| root.distance <= NEXT_TO_POSE && root.slackest().1 > 0.0)
    }

    /// Chord forces [N] in proportion to the load, where this leaves less of the balance than the forces that
    /// hold another load.
    fn in_proportion(&self, chord_forces: Vec<f64>) -> Vec<f64> {
        let changes = vec![0.0; self.free.len()];
        let Some(point) = self.point(&changes, &chord_forces) else { return chord_forces };
        let external = self.problem.external;
        let ratio = external.norm() / (point.residual - external).norm();
        if !(ratio.is_finite() && ratio > 0.0) {
            return chord_forces;
        }
        let scaled: Vec<f64> = chord_forces.iter().map(|force| ratio * force).collect();
        let left = |point: &Point| point.residual.norm() / point.forces;
        let is_nearer = self.point(&changes, &scaled).is_some_and(|other| left(&other) < left(&point));
        if is_nearer { scaled } else { chord_forces }
    }

    /// The solution that steps lead to which halve the residual at least.
    fn follow(&self, mut at: Unknowns) -> Option<(Point, Unknowns)> {
        let mut point = self.point(&at.changes, &at.chord_forces)?;
        for _ in 0..MAX_STEPS {
            let norm = point.residual.norm();
            if norm <= ROUNDING * point.forces {
                break;
            }
            let step = newton_step(&self.slopes(&at.changes, &at.chord_forces, &point)?, &point.residual)?;
            let moved = self.moved(&at.changes, &at.chord_forces, &step);
            let Some((changes, chord_forces, next)) = moved.filter(|to| to.2.residual.norm() <= 0.5 * norm)
            else {
                break;
            };
            (at, point) = (Unknowns { changes, chord_forces }, next);
        }
        (point.residual.norm() <= SOLVED * point.forces).then_some((point, at))
    }
}
