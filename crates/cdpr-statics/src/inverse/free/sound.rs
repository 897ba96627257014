//! What is expected of a solution with free coordinates, besides the balance.
//!
//! A balance alone is satisfied by cables that no winch should pay out: one that would have to push is
//! replaced by a loop so long that its weight pushes. A solution is *sound* where no cable is a loop, none is
//! below the ground, and all tensions are within their limits.

use super::solution::FreeSolution;
use crate::inverse::PoseLengths;
use crate::out_of_limits::{Limit, OutOfLimits, out_of_limits};
use crate::problem::DirectProblem;
use crate::rest_fault::RestFault;
use crate::state::{Equilibrium, Load};
use cdpr_robot::Robot;

/// The longest cable between its exit and its anchor point, unstrained and in chords, that is not called a
/// loop.
///
/// A cable whose tension falls as it is paid out has at most 1.3 chords ([`crate::inverse`] takes no longer
/// one). Beyond, the tension rises with the length, as more of the cable hangs on its ends. Three chords
/// leave room for a heavy cable that hangs from a near exit point; one that is longer hangs lower than its
/// chord is long, and carries its own weight more than the platform.
pub const LONGEST: f64 = 3.0;

/// What bounds the cables of a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Loops {
    /// None longer than [`LONGEST`] chords.
    Refused,
    /// A length of any number of chords.
    Allowed,
}

impl Loops {
    /// The first thing that is wrong about a solution, the most serious first.
    pub(super) fn fault(self, robot: &Robot, found: &PoseLengths) -> Option<RestFault> {
        let PoseLengths { lengths, equilibrium } = found;
        let (cable, chords) = longest(robot, lengths, equilibrium)?;
        if self == Self::Refused && chords > LONGEST {
            return Some(RestFault::Loop { cable, chords, most: LONGEST });
        }
        let all = out_of_limits(robot, lengths, &[equilibrium]).into_iter();
        let passed = all.filter(|one| matches!(one.limit, Limit::Min | Limit::Max));
        let beyond = |one: &OutOfLimits| (one.tension / one.value).ln().abs();
        let worst = passed.max_by(|one, other| beyond(one).total_cmp(&beyond(other)));
        below_ground(robot, lengths, equilibrium, worst).or(worst.map(RestFault::Limit))
    }
}

/// Unstrained lengths of the cables between exit and anchor points, in chords.
fn chords(robot: &Robot, lengths: &[f64], equilibrium: &Equilibrium) -> Vec<f64> {
    let of_cable = |(i, force): (usize, &cdpr_robot::Vector2<f64>)| {
        let chord = robot.span(&equilibrium.pose, i).norm();
        let problem = DirectProblem::new(robot, lengths, &Load::none());
        problem.map_or(f64::INFINITY, |it| it.catenary_at(&equilibrium.pose, i, *force).free_length() / chord)
    };
    equilibrium.cable_forces.iter().enumerate().map(of_cable).collect()
}

pub(super) fn longest(robot: &Robot, lengths: &[f64], equilibrium: &Equilibrium) -> Option<(usize, f64)> {
    let all = chords(robot, lengths, equilibrium).into_iter().enumerate();
    all.max_by(|one, other| one.1.total_cmp(&other.1))
}

/// Heights of cable `i` at a solution: of its anchor point and of its lowest point, in the base frame [m].
fn heights(robot: &Robot, lengths: &[f64], equilibrium: &Equilibrium, i: usize) -> Option<[f64; 2]> {
    const POINTS: usize = 65;
    let pose = &equilibrium.pose;
    let anchor = pose.position.z + robot.anchor_arm(pose, i).z;
    let none = Load::none();
    let problem = DirectProblem::new(robot, lengths, &none).ok()?;
    let lowest = if robot.gravity.level().is_none() {
        let catenary = problem.catenary_at(pose, i, equilibrium.cable_forces[i]);
        robot.cables[i].exit_point.z + catenary.lowest_point().y
    } else {
        let shape = problem.shape(equilibrium, i, 2, POINTS).ok()?;
        shape.points.iter().map(|point| point.z).fold(f64::INFINITY, f64::min)
    };
    Some([anchor, lowest])
}

/// The point that is farthest below the ground, with a limit that is passed `also`. A cable is not below
/// where its exit point is lower, in a pit.
fn below_ground(
    robot: &Robot,
    lengths: &[f64],
    equilibrium: &Equilibrium,
    also: Option<OutOfLimits>,
) -> Option<RestFault> {
    let ground = robot.ground_z?;
    let rounding = 1e-9 * lengths.iter().copied().fold(ground.abs(), f64::max);
    let mut deepest: Option<(f64, RestFault)> = None;
    for cable in 0..robot.cables.len() {
        let [anchor, lowest] = heights(robot, lengths, equilibrium, cable)?;
        let exit = robot.cables[cable].exit_point.z;
        for (is_anchor, height, least) in [(true, anchor, ground), (false, lowest, ground.min(exit))] {
            let depth = least - height;
            if depth > rounding && deepest.as_ref().is_none_or(|(most, _)| depth > *most) {
                deepest = Some((depth, RestFault::BelowGround { cable, is_anchor, height, ground, also }));
            }
        }
    }
    deepest.map(|(_, fault)| fault)
}

impl FreeSolution {
    /// Cables that hang in a loop, longer than [`LONGEST`] chords: index, and length over chord.
    pub fn loops(&self, robot: &Robot) -> Vec<(usize, f64)> {
        let all = chords(robot, &self.lengths, &self.equilibrium).into_iter().enumerate();
        all.filter(|(_, chords)| *chords > LONGEST).collect()
    }
}
