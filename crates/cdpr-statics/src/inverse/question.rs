//! What the inverse model is asked.

use crate::state::Load;
use cdpr_robot::{Pose, Robot, TensionLimits, Vector6};

/// A robot to be held at a pose.
pub(super) struct Question<'a> {
    pub(super) robot: &'a Robot,
    pub(super) pose: &'a Pose,
    pub(super) load: &'a Load,
    /// Reference tensions [N].
    pub(super) reference: Vec<f64>,
    pub(super) limits: Vec<TensionLimits>,
}

impl Question<'_> {
    pub(super) fn cables(&self) -> usize {
        self.reference.len()
    }

    /// The length [m] that makes moments comparable with forces: of the platform, or of a cable where the
    /// platform is a point.
    pub(super) fn arm(&self) -> f64 {
        let longest = (0..self.cables()).map(|i| self.robot.span(self.pose, i).norm()).fold(0.0, f64::max);
        self.robot.platform_size().max(1e-3 * longest)
    }

    /// w_ex, moments divided by the arm [N].
    pub(super) fn external(&self) -> Vector6<f64> {
        let mut wrench = self.load.total(self.robot, self.pose).to_vector();
        wrench.fixed_rows_mut::<3>(3).unscale_mut(self.arm());
        wrench
    }
}
