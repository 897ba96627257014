//! What becomes of a platform when a cable breaks: each cable alone, and pairs of cables.
//!
//! The winches do not move: the other cables keep the unstrained lengths that held the pose. The platform is
//! released there, and comes to rest at the minimum of the potential that lies downhill
//! ([`DirectStart::Released`]). This is where a strongly damped platform ends. On the way it swings, its
//! tensions exceed those of the rest, and with little damping it may pass a ridge and rest elsewhere: the
//! motion without damping is followed if asked for.

pub(crate) mod factored;
pub(crate) mod factors;
pub(crate) mod winds;

use crate::inspection::is_below_floor;
use crate::safety::winds::safety_factor;
use cdpr_dynamics::DynamicsError;
use cdpr_dynamics::simulate::{Change, CutAt, Difference, Event, Settings, simulate};
use cdpr_robot::{Pose, Robot, UnitQuaternion};
use cdpr_statics::limits::{OutOfLimits, tensions_out_of_limits};
use cdpr_statics::{
    DirectProblem, DirectStart, InverseSolution, Load, Residual, StaticsError, WantedPose, inverse,
};
use std::f64::consts::FRAC_PI_2;

/// Which breaks are looked at, and how.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Breaks {
    /// Whether every pair of cables breaks, too.
    pub pairs: bool,
    /// For how long the motion after each break is followed [s]; `None` for the rests alone.
    pub follow: Option<f64>,
}

/// A robot at a pose, whole and with broken cables.
#[derive(Clone, Debug, PartialEq)]
pub struct Safety {
    /// The pose, with its free coordinates as they are found.
    pub pose: Pose,
    /// Unstrained lengths that hold it [m].
    pub lengths: Vec<f64>,
    /// Tension of each cable at the platform [N].
    pub tensions: Vec<f64>,
    /// Tension of each cable at the exit point [N].
    pub exit_tensions: Vec<f64>,
    /// Least breaking force over greatest tension, and the index of that cable; `None` where a breaking
    /// force is not known.
    pub safety_factor: Option<(f64, usize)>,
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
    /// How it swings, if that is followed, or why it could not be.
    pub swing: Option<Result<Swing, DynamicsError>>,
}

/// How a platform swings when cables part at their anchor points, without damping.
#[derive(Clone, Debug, PartialEq)]
pub struct Swing {
    /// Greatest tension of the other cables at either end [N], the index of that cable, and when [s].
    pub greatest: (f64, usize, f64),
    /// Greatest distance of P from where it was [m].
    pub moved: f64,
    /// Whether it was greatest at the end, so that the platform may move farther.
    pub moves_away: bool,
    /// Greatest tensions of the other cables that are out of limits.
    pub out_of_limits: Vec<OutOfLimits>,
    /// Least breaking force over greatest tension of the other cables, and the index of that cable; `None`
    /// where a breaking force is not known.
    pub safety_factor: Option<(f64, usize)>,
    /// The same with tensions that are greater by their `difference`.
    pub factor_at_least: Option<f64>,
    /// Whether P or an anchor point comes below the ground, as in [`BrokenRest::below_ground`].
    pub below_ground: bool,
    /// Differences between two computations of the motion.
    pub difference: Difference,
    /// Whether a tension that is greater by its `difference` would be above a greatest tension or a breaking
    /// force.
    pub may_be_overloaded: bool,
}

impl Swing {
    /// Whether another cable is loaded beyond its greatest tension or its breaking force.
    pub fn is_overloaded(&self) -> bool {
        self.out_of_limits.iter().any(OutOfLimits::is_too_much)
    }
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
    /// Least breaking force over greatest tension of the other cables, and the index of that cable; `None`
    /// where a breaking force is not known.
    pub safety_factor: Option<(f64, usize)>,
    /// Whether P or an anchor point is below `ground_z`, or, where the file has none, below what robots stand
    /// on.
    pub below_ground: bool,
    /// Residuals of the equilibrium.
    pub residual: Residual,
}

impl BrokenRest {
    /// Whether the platform turns by more than a right angle. Its cables then lie against it, or through it,
    /// which the models do not know.
    pub fn turns_over(&self) -> bool {
        self.turned > FRAC_PI_2
    }

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

/// The robot at a pose under a load with each cable broken alone, and with each pair of cables if asked for.
///
/// A motion needs the inertia of the platform. One whose energy is off, or that strains a cable by more
/// than the models are valid for, is [`DynamicsError::Implausible`].
///
/// # Errors
/// Those of [`inverse`] at the pose, and [`StaticsError::Unstable`] where the platform does not stay. A break
/// after which no rest is found, or whose motion cannot be
/// followed, has the reason in its place.
pub fn safety_at(
    robot: &Robot,
    wanted: WantedPose,
    load: &Load,
    breaks: Breaks,
) -> Result<Safety, StaticsError> {
    let held = inverse(robot, wanted, load)?;
    let (pose, count) = (held.equilibrium.pose, robot.cables.len());
    let stability = DirectProblem::new(robot, &held.lengths, load)?.stability(&held.equilibrium)?;
    if !stability.is_stable() {
        let least_stiffness = stability.least_stiffness();
        return Err(StaticsError::Unstable { pose: Box::new(pose), least_stiffness });
    }
    let mut sets: Vec<Vec<usize>> = (0..count).map(|i| vec![i]).collect();
    if breaks.pairs {
        sets.extend((0..count).flat_map(|i| (i + 1..count).map(move |j| vec![i, j])));
    }
    let break_these = |cables: Vec<usize>| {
        let rest = rest_without(robot, &cables, &held.lengths, load, &pose);
        let swing = breaks.follow.map(|until| swing_without(robot, &cables, &held, load, until));
        Broken { cables, rest, swing }
    };
    let broken = sets.into_iter().map(break_these).collect();
    let exit_tensions = held.equilibrium.exit_tensions(robot, &held.lengths);
    let ends: Vec<[f64; 2]> =
        held.tensions.iter().zip(&exit_tensions).map(|(at, exit)| [*at, *exit]).collect();
    let safety_factor = safety_factor(robot, &(0..count).collect::<Vec<_>>(), &ends);
    let InverseSolution { lengths, tensions, .. } = held;
    Ok(Safety { pose, lengths, tensions, exit_tensions, safety_factor, broken })
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
    Ok(BrokenRest {
        pose: at.pose,
        moved: (at.pose.position - from.position).norm(),
        turned: before.angle_to(&after),
        slack: found.report.slack.iter().map(|i| kept[*i]).collect(),
        out_of_limits: beyond(robot, broken, &tensions),
        safety_factor: safety_factor(robot, &kept, &tensions),
        below_ground: is_below_floor(robot, from, &at.pose),
        residual: found.report.residual,
        tensions,
    })
}

/// Tensions of the cables that are not broken beyond their limits.
fn beyond(robot: &Robot, broken: &[usize], tensions: &Vec<[f64; 2]>) -> Vec<OutOfLimits> {
    let found = tensions_out_of_limits(robot, std::slice::from_ref(tensions));
    found.into_iter().filter(|one| !broken.contains(&one.cable)).collect()
}

/// How the platform swings for some time [s] after these cables part.
fn swing_without(
    robot: &Robot,
    broken: &[usize],
    held: &InverseSolution,
    load: &Load,
    until: f64,
) -> Result<Swing, DynamicsError> {
    /// Samples at least, and each second: between them nothing is known of the ground.
    const SAMPLES: f64 = 100.0;
    /// Share of the greatest distance that is the greatest one but for steps between samples.
    const NEARLY: f64 = 1.0 - 1e-6;
    let cut = |cable: &usize| Event { time: 0.0, change: Change::Cut { cable: *cable, at: CutAt::Anchor } };
    let events: Vec<Event> = broken.iter().map(cut).collect();
    let (problem, from) = (DirectProblem::new(robot, &held.lengths, load)?, &held.equilibrium.pose);
    let settings = Settings { rate: (SAMPLES / until).max(SAMPLES), ..Settings::until(until) };
    let series = simulate(&problem, &held.equilibrium, &events, &settings)?;
    series.check(robot)?;
    let kept: Vec<usize> = (0..robot.cables.len()).filter(|i| !broken.contains(i)).collect();
    let mut tensions = vec![[0.0; 2]; robot.cables.len()];
    for i in &kept {
        let [exit, anchor] = series.end_peaks[*i];
        tensions[*i] = [anchor, exit];
    }
    let more = |tension: f64| tension + series.difference.tension;
    let more: Vec<[f64; 2]> = tensions.iter().map(|ends| ends.map(more)).collect();
    let at_end = series.samples.last().map_or(0.0, |last| (last.pose.position - from.position).norm());
    let greatest = kept.iter().max_by(|a, b| series.peaks[**a].0.total_cmp(&series.peaks[**b].0));
    Ok(Swing {
        greatest: greatest.map_or((0.0, 0, 0.0), |i| (series.peaks[*i].0, *i, series.peaks[*i].1)),
        moved: series.excursion.distance,
        moves_away: at_end >= NEARLY * series.excursion.distance,
        out_of_limits: beyond(robot, broken, &tensions),
        safety_factor: safety_factor(robot, &kept, &tensions),
        factor_at_least: safety_factor(robot, &kept, &more).map(|(factor, _)| factor),
        may_be_overloaded: beyond(robot, broken, &more).iter().any(OutOfLimits::is_too_much),
        below_ground: series.samples.iter().any(|sample| is_below_floor(robot, from, &sample.pose)),
        difference: series.difference,
    })
}
