//! The handles of a tracker and of a path, which own their robot.

use crate::data::CdprReport;
use crate::failure::Failure;
use cdpr_robot::{Pose, Robot, Vector2, Vector3};
use cdpr_statics::{DirectStart, InversePath, Load, PathSolution, Tracker, WantedPose, direct};
use std::sync::Arc;

/// Follows the pose of the platform while lengths and load change: the handle of `cdpr_tracker_new`. One
/// thread at a time may use it.
pub struct CdprTracker {
    tracker: Tracker<Arc<Robot>>,
}

impl CdprTracker {
    /// Starts at the equilibrium for `lengths` and `load` that the direct model finds from `start`.
    pub(crate) fn new(
        robot: &Arc<Robot>,
        lengths: &[f64],
        load: &Load,
        start: &Pose,
    ) -> Result<Self, Failure> {
        let found = direct(robot, lengths, load, DirectStart::Pose(start))?;
        let tracker = Tracker::new(Arc::clone(robot), lengths, load, &found.equilibrium)?;
        if tracker.takes_steps() {
            return Ok(Self { tracker });
        }
        Err(Failure::Unsupported(
            "a robot with cables of different elastic laws, or with a motion that nothing resists,",
        ))
    }

    pub(crate) fn cables(&self) -> usize {
        self.tracker.equilibrium().cable_forces.len()
    }

    /// One step, and whether it converged; the report is that of the state after it.
    pub(crate) fn step(
        &mut self,
        lengths: &[f64],
        load: &Load,
    ) -> Result<(CdprReport, Result<(), Failure>), Failure> {
        let step = self.tracker.step(lengths, load)?;
        let report = CdprReport::new(self.tracker.residual(), step.iterations);
        let kept = Failure::NotConverged { iterations: step.iterations };
        Ok((report, if step.converged { Ok(()) } else { Err(kept) }))
    }

    pub(crate) fn pose(&self) -> &Pose {
        &self.tracker.equilibrium().pose
    }

    /// Points of a cable at equal distances along it, from where it leaves its pulley or exit point to its
    /// anchor point [m].
    pub(crate) fn shape(&self, cable: usize, points: usize) -> Result<Vec<Vector3<f64>>, Failure> {
        let mut shape = self.tracker.shape(cable, 2, points)?.points;
        Ok(shape.split_off(shape.len() - points))
    }

    /// Tensions at the platform [N].
    pub(crate) fn tensions(&self) -> impl Iterator<Item = f64> {
        self.tracker.equilibrium().cable_forces.iter().map(Vector2::norm)
    }
}

/// Lengths and tensions along a path of poses: the handle of `cdpr_path_new`. One thread at a time may use
/// it.
pub struct CdprPath {
    path: InversePath<Arc<Robot>>,
    cables: usize,
}

impl CdprPath {
    /// A path has no free coordinates: a robot with fewer cables than free motions is refused.
    pub(crate) fn new(robot: &Arc<Robot>) -> Result<Self, Failure> {
        if robot.cables.len() < robot.freedoms().count() {
            return Err(Failure::FEW_CABLES);
        }
        Ok(Self { path: InversePath::new(Arc::clone(robot)), cables: robot.cables.len() })
    }

    pub(crate) fn cables(&self) -> usize {
        self.cables
    }

    pub(crate) fn limit_change(&mut self, change: f64) -> Result<(), Failure> {
        Ok(self.path.limit_change(change)?)
    }

    /// The next pose, with the tensions nearest to `reference` [N], or to that of the robot.
    pub(crate) fn next(
        &mut self,
        pose: &Pose,
        load: &Load,
        reference: Option<&[f64]>,
    ) -> Result<PathSolution, Failure> {
        let wanted = WantedPose { tension_reference: reference, ..pose.into() };
        Ok(self.path.solve(wanted, load)?)
    }
}
