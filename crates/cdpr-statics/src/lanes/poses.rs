//! The inverse model at many poses of one robot, one pose in each lane.
//!
//! The scalar model solves the first poses until one has tensions. Those after it come in blocks of
//! [`BLOCK`], cut into [`SEQUENCES`] sequences, and the lanes go along them together: each pose starts from
//! the last solution of its own sequence, with the horizontal forces and multipliers of its cables, and each
//! sequence from the nearest end of one of the block before. What a lane does not decide, and what is not
//! proved to be the least of all minima where cables sag, is left to the scalar model. After a pose without
//! tensions the next one is first asked for a proof that it has none, from the tensions that came nearest
//! there. No result depends on the vector unit, because no sequence of a block knows another.

mod in_lanes;
mod loaded;
mod loaded_pose;
mod placed;
mod slopes;

use crate::error::StaticsError;
#[cfg(doc)]
use crate::inverse::free_solutions;
use crate::inverse::{InTurn, InverseSolution, inverse_at, refuse_offsets, rest};
use crate::lanes::poses::in_lanes::{Asked, InLanes, LaneSolution, Near, Setting};
use crate::lanes::poses::placed::PlacedRobot;
use crate::local::cable::Shape;
use crate::problem::DirectProblem;
use crate::state::{Load, Residual, Wanted, WantedPose};
use cdpr_number::lanes::{Lanes, MAX_LANES, Simd, WithSimd, dispatch};
use cdpr_robot::{Pose, Robot};
pub use loaded::loaded_poses;
pub use loaded_pose::{Loaded, LoadedPose, PoseSlopes};

/// Poses that are cut into sequences together.
const BLOCK: usize = 64;

/// Sequences of a block: as many as the widest vector unit has lanes.
const SEQUENCES: usize = MAX_LANES;

/// Greatest error of (I2) in a cable, relative to the sum of tensions.
const STATIONARY: f64 = 1e-10;

/// The unstrained lengths with which the platform rests at a wanted pose, or at each of many, under its
/// weight and `load`.
///
/// Within their limits the tensions are as near as possible to the reference that is wanted or that of the
/// robot, which is zero unless it is stated: the least-norm tensions.
///
/// With fewer cables than free motions, the free coordinates are found: a stable solution close to the given
/// pose is taken without a search for others, else the first one of [`free_solutions`].
///
/// **Many poses** should follow each other closely, as along the lines of a grid: robots with a cable for
/// each free motion are then solved in the lanes of the vector unit, each pose from the one before it, and
/// all others one by one. A result found in lanes counts no
/// iterations. It depends on the poses before it in the same call, in the last digits; it does not depend on
/// the vector unit. Where (I1) has several minima, the result at one pose is the best that several starts
/// lead to; one in lanes with a cable that sags is proved to be the least of all on a grid of its tensions.
///
/// ```
/// use cdpr_robot::{Pose, Robot};
/// use cdpr_statics::{Load, WantedPose, inverse};
///
/// let robot = Robot::from_library("caroca")?;
/// let pose = Pose::at(0.0, 0.0, 1.75);
/// let least_norm = inverse(&robot, &pose, &Load::none())?;
/// let wanted = WantedPose::at(&pose).tension_reference(&[900.0; 8]);
/// assert!(inverse(&robot, wanted, &Load::none())?.tensions[0] > least_norm.tensions[0]);
///
/// let line: Vec<Pose> = (0..20).map(|k| Pose::at(0.05 * f64::from(k), 0.0, 1.75)).collect();
/// assert!(inverse(&robot, &line, &Load::none()).iter().all(Result::is_ok));
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
///
/// # Errors
/// - [`StaticsError::NoTensions`] where no tensions within the limits were found that hold the pose.
/// - [`StaticsError::Overstrained`] where the tensions strain a cable by more than the models are valid for.
/// - [`StaticsError::ExitLimit`] where the limits of a cable contradict each other at this pose.
/// - [`StaticsError::Cable`] where a cable's own weight demands more than the greatest tension.
/// - [`StaticsError::Invalid`] for a pose, load or reference that is not finite, a reference of another
///   number of cables, and offsets of set-points.
/// - [`StaticsError::FreeCoordinates`] for a robot with fewer cables than free motions, where not as many
///   coordinates are free.
/// - [`StaticsError::InverseNotConverged`] where tensions hold the pose but their optimum was not found.
/// - Those of [`free_solutions`] where coordinates are free.
pub fn inverse<W: Wanted>(
    robot: &Robot,
    wanted: W,
    load: &Load,
) -> W::Results<Result<InverseSolution, StaticsError>> {
    let one = |wanted: &WantedPose| {
        let wanted = refuse_offsets(*wanted)?;
        if wanted.free.is_empty() {
            return inverse_at(robot, &wanted.pose, load, wanted.tension_reference);
        }
        rest(robot, &wanted, load).map(InverseSolution::from)
    };
    wanted.results(one, |poses| inverse_all(robot, poses, load))
}

/// The inverse model at poses that follow each other.
fn inverse_all(robot: &Robot, poses: &[Pose], load: &Load) -> Vec<Result<InverseSolution, StaticsError>> {
    match Setting::of(robot, load) {
        Some(setting) => {
            let mut ends = Vec::with_capacity(SEQUENCES);
            poses.chunks(BLOCK).flat_map(|block| setting.block(block, &mut ends)).collect()
        }
        None => {
            let mut scalar = InTurn::new(robot, load);
            poses.iter().map(|pose| scalar.solve(pose)).collect()
        }
    }
}

/// Poses in a row.
struct Sequence<'a> {
    poses: &'a [Pose],
    near: Near,
    scalar: InTurn<'a>,
    results: Vec<Result<InverseSolution, StaticsError>>,
}

impl<'a> Setting<'a> {
    /// `None` for a robot that is not one for the lanes.
    fn of(robot: &'a Robot, load: &'a Load) -> Option<Self> {
        let placed = PlacedRobot::of(robot)?;
        let shared = placed.shared(load);
        Some(Self { placed, load, shared })
    }

    /// Solves a block from the `ends` of the sequences before it, and leaves its own there.
    fn block(&self, poses: &'a [Pose], ends: &mut Vec<Near>) -> Vec<Result<InverseSolution, StaticsError>> {
        let mut results = Vec::with_capacity(poses.len());
        let mut scalar = InTurn::new(self.placed.robot, self.load);
        while let (true, Some(pose)) = (ends.is_empty(), poses.get(results.len())) {
            let result = scalar.solve(pose);
            ends.extend(result.as_ref().ok().map(|solution| self.near(pose, solution)));
            results.push(result);
        }
        let rest = &poses[results.len()..];
        let length = rest.len().div_ceil(SEQUENCES).max(1);
        let sequence = |poses: &'a [Pose]| {
            let first = poses.first()?.position;
            let way = |near: &Near| (near.position - first).norm();
            // The last one of several.
            let near = ends.iter().rev().min_by(|one, other| way(one).total_cmp(&way(other)))?.clone();
            let scalar = InTurn::new(self.placed.robot, self.load);
            Some(Sequence { poses, near, scalar, results: Vec::with_capacity(length) })
        };
        let mut sequences: Vec<_> = rest.chunks(length).filter_map(sequence).collect();
        for k in 0..length {
            self.next(&mut sequences, k);
        }
        if !sequences.is_empty() {
            ends.clear();
        }
        for Sequence { near, results: found, .. } in sequences {
            ends.push(near);
            results.extend(found);
        }
        results
    }

    /// Solves pose number `k` of every sequence; the last sequence may be shorter.
    fn next(&self, sequences: &mut [Sequence], k: usize) {
        let mut open = Vec::with_capacity(sequences.len());
        for sequence in sequences {
            let Some(pose) = sequence.poses.get(k) else { continue };
            match sequence.scalar.refusal(pose) {
                Some(refusal) => sequence.results.push(Err(refusal)),
                None => open.push((pose, sequence)),
            }
        }
        let asked: Vec<_> =
            open.iter().map(|(pose, sequence)| Asked { pose, near: &sequence.near }).collect();
        let found = dispatch(Batch { setting: self, asked: &asked });
        for ((pose, sequence), found) in open.into_iter().zip(found) {
            let result = match found {
                Some((solution, near)) => {
                    sequence.scalar.solved_elsewhere();
                    sequence.near = near;
                    Ok(solution)
                }
                None => sequence.scalar.solution(pose).inspect(|solution| {
                    sequence.near = self.near(pose, solution);
                }),
            };
            sequence.results.push(result);
        }
    }

    /// The solution of a lane, if its equations are solved to rounding.
    fn checked(&self, (solution, near): LaneSolution) -> Option<LaneSolution> {
        let InverseSolution { lengths, tensions, equilibrium, stationarity, .. } = &solution;
        let problem = DirectProblem::new(self.placed.robot, lengths, self.load).ok()?;
        let residual = Residual::of(&problem, equilibrium);
        let is_solved = problem.check_strains(equilibrium).is_ok()
            && residual.is_rounding(&problem, equilibrium)
            && *stationarity <= STATIONARY * tensions.iter().sum::<f64>();
        is_solved.then_some((InverseSolution { residual, ..solution }, near))
    }

    /// What a result of the scalar model is for the next pose.
    fn near(&self, pose: &Pose, solution: &InverseSolution) -> Near {
        let robot = self.placed.robot;
        let shape = |i: usize| Shape::of(robot, i, solution.lengths[i], &solution.equilibrium);
        let shapes = (0..robot.cables.len()).map(shape).collect();
        let multipliers = self.placed.both(PlacedRobot::to_level, &solution.multipliers);
        Near { position: pose.position, shapes, multipliers }
    }
}

/// Poses for the lanes.
struct Batch<'a> {
    setting: &'a Setting<'a>,
    asked: &'a [Asked<'a>],
}

impl WithSimd for Batch<'_> {
    type Output = Vec<Option<LaneSolution>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let mut found = Vec::with_capacity(self.asked.len());
        for asked in self.asked.chunks(Lanes::<S>::COUNT) {
            let results = InLanes { simd, setting: self.setting, asked }.solutions();
            found.extend(results.into_iter().map(|result| self.setting.checked(result?)));
        }
        found
    }
}
