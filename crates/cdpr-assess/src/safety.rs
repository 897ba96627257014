//! What becomes of a platform when a cable breaks: each cable alone, and pairs of cables.
//!
//! The winches do not move: the other cables keep the unstrained lengths that held the pose. The platform is
//! released there, and comes to rest at the minimum of the potential that lies downhill
//! ([`DirectStart::Released`]). This is where a strongly damped platform ends. On the way it swings, its tensions
//! exceed those of the rest, and with little damping it may pass a ridge and rest elsewhere: `cdpr-dynamics`
//! follows that motion.

use crate::inspection::is_below_floor;
use cdpr_robot::{Pose, Robot, UnitQuaternion};
use cdpr_statics::limits::{OutOfLimits, tensions_out_of_limits};
use cdpr_statics::{DirectProblem, DirectStart, Load, Residual, StaticsError, WantedPose, inverse};

/// A robot at a pose, whole and with broken cables.
#[derive(Clone, Debug, PartialEq)]
pub struct Safety {
    /// The pose, with its free coordinates as they are found.
    pub pose: Pose,
    /// Unstrained lengths that hold it [m].
    pub lengths: Vec<f64>,
    /// Tension of each cable at the platform [N].
    pub tensions: Vec<f64>,
    /// Every cable that breaks alone, in the order of their numbers, then every pair, if asked for.
    pub broken: Vec<Broken>,
}

/// What becomes of the platform when cables break.
#[derive(Clone, Debug, PartialEq)]
pub struct Broken {
    /// Indices of these cables, from 0.
    pub cables: Vec<usize>,
    /// Where it comes to rest, or why no rest was found.
    pub rest: Result<BrokenRest, StaticsError>,
}

/// Where a platform comes to rest without some of its cables.
#[derive(Clone, Debug, PartialEq)]
pub struct BrokenRest {
    /// The pose.
    pub pose: Pose,
    /// Distance of P from where it was [m].
    pub moved: f64,
    /// Angle of the rotation from where it was [rad], at most π.
    pub turned: f64,
    /// Tension of each cable at the platform and at the exit point [N], zero for a broken one.
    pub tensions: Vec<[f64; 2]>,
    /// Indices of cables that are slack and not broken.
    pub slack: Vec<usize>,
    /// Tensions of the other cables that are out of limits.
    pub out_of_limits: Vec<OutOfLimits>,
    /// Least breaking force over greatest tension of the other cables, and the index of that cable; `None` where
    /// no breaking force is known.
    pub safety_factor: Option<(f64, usize)>,
    /// Whether P or an anchor point is below `ground_z`, or, where the file has none, below what robots stand on.
    pub below_ground: bool,
    /// Residuals of the equilibrium.
    pub residual: Residual,
}

impl BrokenRest {
    /// The greatest tension at either end [N], and the index of its cable.
    pub fn greatest_tension(&self) -> (f64, usize) {
        let of_cable = |(i, ends): (usize, &[f64; 2])| (ends[0].max(ends[1]), i);
        let greatest = |a: (f64, usize), b: (f64, usize)| if b.0 > a.0 { b } else { a };
        self.tensions.iter().enumerate().map(of_cable).fold((0.0, 0), greatest)
    }

    /// Whether another cable is loaded beyond its greatest tension or its breaking force.
    pub fn is_overloaded(&self) -> bool {
        self.out_of_limits.iter().any(OutOfLimits::is_too_much)
    }
}

/// The robot at a pose under a load with each cable broken alone, and with each pair of cables if `pairs`.
///
/// # Errors
/// Those of [`inverse`] at the pose. A break after which no rest is found has the reason in its place.
pub fn safety_at(
    robot: &Robot,
    wanted: WantedPose,
    load: &Load,
    pairs: bool,
) -> Result<Safety, StaticsError> {
    let held = inverse(robot, wanted, load)?;
    let (pose, count) = (held.equilibrium.pose, robot.cables.len());
    let mut sets: Vec<Vec<usize>> = (0..count).map(|i| vec![i]).collect();
    if pairs {
        sets.extend((0..count).flat_map(|i| (i + 1..count).map(move |j| vec![i, j])));
    }
    let break_these = |cables: Vec<usize>| {
        let rest = rest_without(robot, &cables, &held.lengths, load, &pose);
        Broken { cables, rest }
    };
    let broken = sets.into_iter().map(break_these).collect();
    Ok(Safety { pose, lengths: held.lengths, tensions: held.tensions, broken })
}

/// Where the platform rests that is released at a pose without these cables.
fn rest_without(
    robot: &Robot,
    broken: &[usize],
    lengths: &[f64],
    load: &Load,
    from: &Pose,
) -> Result<BrokenRest, StaticsError> {
    let kept: Vec<usize> = (0..robot.cables.len()).filter(|i| !broken.contains(i)).collect();
    let others = Robot {
        cables: kept.iter().map(|i| robot.cables[*i].clone()).collect(),
        // The tensions that the inverse model prefers are of no importance to a rest.
        tension_reference: None,
        ..robot.clone()
    };
    let lengths: Vec<f64> = kept.iter().map(|i| lengths[*i]).collect();
    let found = DirectProblem::new(&others, &lengths, load)
        .and_then(|problem| problem.direct(DirectStart::Released(from)))
        .map_err(|error| error.with_cables(|i| kept[i]))?;
    let at = &found.equilibrium;
    let mut tensions = vec![[0.0; 2]; robot.cables.len()];
    for (i, ends) in kept.iter().zip(at.tensions().into_iter().zip(at.exit_tensions(&others, &lengths))) {
        tensions[*i] = ends.into();
    }
    let [before, after] = [from, &at.pose].map(|pose| UnitQuaternion::from_rotation_matrix(&pose.rotation));
    let out_of_limits = tensions_out_of_limits(robot, std::slice::from_ref(&tensions));
    let factor = |i: &usize| {
        let force = robot.cables[*i].properties.breaking_force?;
        Some((force / tensions[*i][0].max(tensions[*i][1]), *i))
    };
    Ok(BrokenRest {
        pose: at.pose,
        moved: (at.pose.position - from.position).norm(),
        turned: before.angle_to(&after),
        slack: found.report.slack.iter().map(|i| kept[*i]).collect(),
        out_of_limits: out_of_limits.into_iter().filter(|one| !broken.contains(&one.cable)).collect(),
        safety_factor: kept.iter().filter_map(factor).min_by(|a, b| a.0.total_cmp(&b.0)),
        below_ground: is_below_floor(robot, &at.pose),
        residual: found.report.residual,
        tensions,
    })
}
