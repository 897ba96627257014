//! Robustness of the direct model: how often it finds the true pose from a wrong start.
//!
//! A test draws poses from a region and keeps those that the robot holds in a stable equilibrium. The inverse
//! model gives the lengths of each; the direct model is asked for the pose that belongs to them, from a start
//! that is off by a given distance and angle in random directions. Distance and angle make up
//! [`StartOffset`]; what came of it is a [`Solve`].
//!
//! Pose and start follow from the index of the draw alone. Poses are drawn in parallel, solved and timed one
//! by one.

mod protocol;
mod summary;

pub use protocol::{Assignment, PoseRegion, Protocol, Published, StartOffset, protocols};
pub(crate) use summary::in_degrees;
pub use summary::{Draws, ProtocolSummary, RobustnessRow, RobustnessSummary, Spread};

use crate::error::AssessError;
use cdpr_robot::{Pose, Robot, Vector3, Vector6};
use cdpr_sensitivity::{RandomDesign, SampleDesign};
use cdpr_statics::{
    DirectMethod, DirectProblem, DirectSolution, DirectStart, Load, Residual, StaticsError, Unstable,
    WantedPose, direct, inverse,
};
use cdpr_study::StudyError;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::time::Instant;

/// A pose that was drawn and then rejected.
#[derive(Clone, Debug, PartialEq)]
pub struct RefusedPose {
    /// Index of the pose among those drawn.
    pub draw: usize,
    /// The pose.
    pub pose: Pose,
    /// Why it was rejected.
    pub refusal: Refusal,
}

/// Why a pose was rejected.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// The inverse model has no lengths for it.
    Infeasible(StaticsError),
    /// Started at its equilibrium, the direct model moves to another pose.
    Unstable,
    /// The direct model has no answer from its equilibrium.
    Unanswered(StaticsError),
}

/// How a solve ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Within [`Protocol::found_distance`] and [`FOUND_ANGLE`] of the true pose.
    TruePose,
    /// Farther away, with residuals that say that it is an equilibrium.
    OtherEquilibrium,
    /// No answer, or an answer whose residuals are too large.
    Failed,
}

/// An answer of the direct model beside the true pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The pose found.
    pub pose: Pose,
    /// Distance of P from the true one [m].
    pub distance: f64,
    /// Angle between the rotations [rad].
    pub angle: f64,
    /// [`anchor_distance`] from the true pose [m].
    pub anchor_distance: f64,
    /// The method that found it.
    pub method: DirectMethod,
    /// Iterations of that method.
    pub iterations: usize,
    /// Residuals of all equations.
    pub residual: Residual,
    /// Whether the residuals are small enough for an equilibrium.
    pub is_equilibrium: bool,
}

/// One solve of the direct model.
#[derive(Clone, Debug, PartialEq)]
pub struct Solve {
    /// Index of the pose among those drawn.
    pub draw: usize,
    /// Index of the start offset in the test's list.
    pub start_offset: usize,
    /// The true pose.
    pub wanted: Pose,
    /// Where the direct model started.
    pub start: Pose,
    /// [`anchor_distance`] of the start from the true pose [m].
    pub start_distance: f64,
    /// The answer, or the error.
    pub answer: Result<Answer, StaticsError>,
    /// Wall time of the call [µs].
    pub microseconds: f64,
}

/// A test that has run.
#[derive(Clone, Debug, PartialEq)]
pub struct RobustnessResult {
    /// Its settings.
    pub protocol: Protocol,
    /// Poses drawn until enough had a stable equilibrium.
    pub drawn: usize,
    /// The rejected poses among them.
    pub refused: Vec<RefusedPose>,
    /// All solves, in the order of the poses.
    pub solves: Vec<Solve>,
}

/// The true pose is found if the rotation is this near [rad], and P within [`Protocol::found_distance`].
pub const FOUND_ANGLE: f64 = PI / 180.0;

/// An equilibrium is stable if the direct model, started there, stays within this distance [m, rad].
const STABLE: f64 = 1e-6;
/// Largest residual wrench of an equilibrium, relative to the platform's weight (and its size).
const OPEN_WRENCH: f64 = 1e-8;
/// Largest closure residual of an equilibrium, relative to the longest cable.
const OPEN_CLOSURE: f64 = 1e-10;

impl Refusal {
    /// Name in files: `unstable`, `infeasible_tension`, ...
    pub fn name(&self) -> &'static str {
        match self {
            Self::Infeasible(error) | Self::Unanswered(error) => error.kind(),
            Self::Unstable => "unstable",
        }
    }
}

impl Solve {
    /// How it ended, if a pose within `found_distance` [m] of the true one is the true one.
    pub fn outcome(&self, found_distance: f64) -> Outcome {
        match &self.answer {
            Ok(answer) if !answer.is_equilibrium => Outcome::Failed,
            Ok(answer) if answer.distance <= found_distance && answer.angle <= FOUND_ANGLE => {
                Outcome::TruePose
            }
            Ok(_) => Outcome::OtherEquilibrium,
            Err(_) => Outcome::Failed,
        }
    }

    /// Kind of failure, if it failed.
    pub fn failure(&self) -> Option<&'static str> {
        match &self.answer {
            Ok(answer) => (!answer.is_equilibrium).then_some("large_residual"),
            Err(error) => Some(error.kind()),
        }
    }
}

impl Outcome {
    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::TruePose => "true_pose",
            Self::OtherEquilibrium => "other_equilibrium",
            Self::Failed => "failed",
        }
    }
}

/// Root mean square distance of the anchor points at two poses [m]: position and rotation in one figure.
pub fn anchor_distance(robot: &Robot, one: &Pose, other: &Pose) -> f64 {
    let squares = (0..robot.cables.len())
        .map(|i| (robot.span(one, i) - robot.span(other, i)).norm_squared())
        .sum::<f64>();
    (squares / robot.cables.len() as f64).sqrt()
}

/// Runs a test. `tick` is called after each pose collected and after each solve.
///
/// # Errors
/// [`AssessError::Study`] for an invalid setting; [`AssessError::TooFewPoses`] where hardly any pose is held.
/// A failed solve is a result.
pub fn run_robustness(
    robot: &Robot,
    protocol: &Protocol,
    tick: &(dyn Fn() + Sync),
) -> Result<RobustnessResult, AssessError> {
    protocol.validate()?;
    let robot = &protocol.robot(robot);
    let (poses, drawn, refused) = collect_poses(robot, protocol, tick)?;
    let mut solves = Vec::with_capacity(protocol.solves());
    for (number, pose) in poses.iter().enumerate() {
        let starts = match protocol.assignment {
            Assignment::InTurn => number % protocol.starts.len()..number % protocol.starts.len() + 1,
            Assignment::Each => 0..protocol.starts.len(),
        };
        for start in starts {
            solves.push(solve(robot, pose, start, &protocol.starts[start]));
            tick();
        }
    }
    Ok(RobustnessResult { protocol: protocol.clone(), drawn, refused, solves })
}

/// A pose that the robot holds in a stable equilibrium.
struct PoseLengths {
    draw: usize,
    pose: Pose,
    lengths: Vec<f64>,
    /// Unit vectors: direction in which the start is away, axis about which it is turned.
    directions: [Vector3<f64>; 2],
}

fn collect_poses(
    robot: &Robot,
    protocol: &Protocol,
    tick: &(dyn Fn() + Sync),
) -> Result<(Vec<PoseLengths>, usize, Vec<RefusedPose>), AssessError> {
    let design = protocol.design()?;
    let (mut poses, mut refused) = (Vec::new(), Vec::new());
    let mut drawn = 0;
    // With free coordinates each takes a thousand times as long.
    let most = if protocol.free.is_empty() { 4096 } else { 128 };
    while poses.len() < protocol.poses {
        let last = design.points().min(drawn + (2 * (protocol.poses - poses.len())).clamp(64, most));
        if drawn == last || protocol.holds_too_few(poses.len(), drawn) {
            let infeasible =
                refused.iter().filter(|r: &&RefusedPose| matches!(r.refusal, Refusal::Infeasible(_))).count();
            return Err(AssessError::TooFewPoses {
                wanted: protocol.poses,
                found: poses.len(),
                drawn,
                infeasible,
                unstable: refused.len() - infeasible,
            });
        }
        let outcomes: Vec<_> =
            (drawn..last).into_par_iter().map(|index| draw(robot, protocol, &design, index)).collect();
        for outcome in outcomes {
            drawn += 1;
            match outcome {
                Ok(pose) => {
                    poses.push(pose);
                    tick();
                }
                Err(pose) => {
                    // That is no matter of the pose.
                    if let Refusal::Infeasible(error) = &pose.refusal
                        && let Some(expected) = expected_free(error)
                    {
                        let names: Vec<_> = protocol.free.iter().map(ToString::to_string).collect();
                        let value = format!("[{}]", names.join(", "));
                        return Err(StudyError::setting("free", value, expected).into());
                    }
                    refused.push(*pose);
                }
            }
            if poses.len() == protocol.poses {
                break;
            }
        }
    }
    Ok((poses, drawn, refused))
}

/// What is expected of the free coordinates, if an error is about them.
fn expected_free(error: &StaticsError) -> Option<String> {
    match error {
        StaticsError::FreeCoordinates { cables, freedoms, .. } => {
            let missing = freedoms.saturating_sub(*cables);
            let names = "x, y, z, roll, pitch, yaw";
            Some(format!("{missing} of {names}, for {cables} cables and {freedoms} free motions"))
        }
        StaticsError::Invalid { field, expected, .. } if field == "free" => Some(expected.clone()),
        _ => None,
    }
}

fn draw(
    robot: &Robot,
    protocol: &Protocol,
    design: &RandomDesign,
    index: usize,
) -> Result<PoseLengths, Box<RefusedPose>> {
    let mut row = [0.0; 10];
    // The index is below the number of points and the row as long as the inputs.
    let drawn = design.row(index, &mut row);
    debug_assert_eq!(drawn, Ok(()));
    let [x, y, z, angle, directions @ ..] = row;
    let [axis, away, about] = [0, 2, 4].map(|k| on_unit_sphere(directions[k], directions[k + 1]));
    let place = protocol.region.place([x, y, z]);
    // Few cables do not hold a platform at any rotation: it is drawn level, and turns as it rests.
    let angle = if protocol.free.is_empty() { angle } else { 0.0 };
    let pose = moved(robot, &Pose::at(place.x, place.y, place.z), Vector3::zeros(), angle * axis);
    let refuse = |refusal| Box::new(RefusedPose { draw: index, pose, refusal });
    let held = inverse(robot, WantedPose::at(&pose).free(&protocol.free), &Load::none())
        .map_err(|e| refuse(Refusal::Infeasible(e)))?;
    let found = DirectProblem::new(robot, &held.lengths, &Load::none())
        .and_then(|problem| {
            problem.with_unstable(Unstable::Accepted).direct(DirectStart::Near(&held.equilibrium))
        })
        .map_err(|error| refuse(Refusal::Unanswered(error)))?;
    // Only the stability of the equilibrium at the true pose matters, not what the direct model does from
    // there.
    let pose = held.equilibrium.pose;
    let motion = pose.motion_to(&found.equilibrium.pose);
    if !found.stability.is_stable()
        || motion.fixed_rows::<3>(0).norm().max(motion.fixed_rows::<3>(3).norm()) > STABLE
    {
        return Err(refuse(Refusal::Unstable));
    }
    Ok(PoseLengths { draw: index, pose, lengths: held.lengths, directions: [away, about] })
}

/// A pose after the free ones among the motions of a displacement [m] and a rotation [rad].
fn moved(robot: &Robot, pose: &Pose, displacement: Vector3<f64>, rotation: Vector3<f64>) -> Pose {
    let [x, y, z] = displacement.into();
    let [a, b, c] = rotation.into();
    let free = robot.freedoms().of_vector(&Vector6::new(x, y, z, a, b, c));
    pose.moved(free.fixed_rows::<3>(0).into(), free.fixed_rows::<3>(3).into())
}

fn on_unit_sphere(height: f64, azimuth: f64) -> Vector3<f64> {
    let radius = (1.0 - height * height).sqrt();
    Vector3::new(radius * azimuth.cos(), radius * azimuth.sin(), height)
}

fn solve(robot: &Robot, held: &PoseLengths, start_offset: usize, offset: &StartOffset) -> Solve {
    let [away, about] = held.directions;
    let start = moved(robot, &held.pose, offset.distance * away, offset.angle * about);
    let clock = Instant::now();
    let found = direct(robot, &held.lengths, &Load::none(), DirectStart::Pose(&start));
    let microseconds = 1e6 * clock.elapsed().as_secs_f64();
    Solve {
        draw: held.draw,
        start_offset,
        wanted: held.pose,
        start,
        start_distance: anchor_distance(robot, &held.pose, &start),
        answer: found.map(|found| answer(robot, held, &found)),
        microseconds,
    }
}

fn answer(robot: &Robot, held: &PoseLengths, found: &DirectSolution) -> Answer {
    let pose = found.equilibrium.pose;
    let motion = held.pose.motion_to(&pose);
    let residual = found.report.residual;
    // Without gravity the tensions stand in for the weight.
    let least = (0..robot.cables.len()).map(|i| robot.limits(i).min).fold(f64::INFINITY, f64::min);
    let weight = (robot.platform.mass * robot.gravity.magnitude()).max(least);
    let longest = held.lengths.iter().copied().fold(0.0, f64::max);
    let is_equilibrium = residual.force <= OPEN_WRENCH * weight
        && residual.moment <= OPEN_WRENCH * weight * robot.platform_size()
        && residual.closure <= OPEN_CLOSURE * longest;
    Answer {
        pose,
        distance: motion.fixed_rows::<3>(0).norm(),
        angle: motion.fixed_rows::<3>(3).norm(),
        anchor_distance: anchor_distance(robot, &held.pose, &pose),
        method: found.report.method,
        iterations: found.report.iterations,
        residual,
        is_equilibrium,
    }
}
