//! The inverse problem: a robot, a pose, a load, and which tensions are chosen.

use super::limits::platform_limits;
use crate::error::StaticsError;
use crate::out_of_limits::allowed;
use crate::state::Load;
use cdpr_robot::{Pose, Robot, TensionDistribution, TensionLimits, Vector6};

/// The inverse problem of a robot at a pose.
#[derive(Clone)]
pub(super) struct InverseProblem<'a> {
    pub(super) robot: &'a Robot,
    pub(super) pose: &'a Pose,
    pub(super) load: &'a Load,
    /// Which tensions are chosen.
    pub(super) distribution: TensionDistribution,
    /// Reference tensions [N].
    pub(super) reference: Vec<f64>,
    pub(super) limits: Vec<TensionLimits>,
    /// The length [m] that makes moments comparable with forces: of the platform, or of a cable where the
    /// platform is a point.
    pub(super) characteristic_length: f64,
    /// w_ex, moments divided by the characteristic length [N]; zero along constrained motions.
    pub(super) external: Vector6<f64>,
}

impl<'a> InverseProblem<'a> {
    /// The problem of a robot with a cable for every free motion, its inputs checked.
    pub(super) fn of_whole_pose(
        robot: &'a Robot,
        pose: &'a Pose,
        load: &'a Load,
        reference: Option<&[f64]>,
    ) -> Result<Self, StaticsError> {
        let (cables, freedoms) = (robot.cables.len(), robot.freedoms().count());
        if cables < freedoms {
            return Err(StaticsError::FreeCoordinates { cables, freedoms, named: 0 });
        }
        let problem = Self::with_platform_limits(robot, pose, load, reference)?;
        Ok(Self { limits: platform_limits(robot, pose)?, ..problem })
    }

    /// The same with every limit taken as one at the platform: for a pose that is not known yet.
    pub(super) fn with_platform_limits(
        robot: &'a Robot,
        pose: &'a Pose,
        load: &'a Load,
        reference: Option<&[f64]>,
    ) -> Result<Self, StaticsError> {
        let n = robot.cables.len();
        load.validate()?;
        StaticsError::finite_pose("pose", pose)?;
        if let Some(i) = (0..n).find(|i| robot.span(pose, *i).norm() == 0.0) {
            return Err(StaticsError::invalid(
                format!("cables[{i}].exit_point"),
                format!("{:?}", robot.cables[i].exit_point.as_slice()),
                "a point away from the cable's anchor point at this pose",
            ));
        }
        // Tensions stated here are those to come near to.
        let distribution = reference.map_or(robot.distribution, |_| TensionDistribution::Nearest);
        let reference = reference.map_or_else(|| robot.reference(), <[f64]>::to_vec);
        StaticsError::one_per_cable("reference", &reference, n)?;
        if let Some((i, value)) = reference.iter().enumerate().find(|(_, value)| !value.is_finite()) {
            return Err(StaticsError::invalid(format!("reference[{i}]"), value, "a finite tension [N]"));
        }
        let limits = (0..n).map(|i| allowed(robot, i)).collect();
        let (characteristic_length, external) = external(robot, pose, load);
        Ok(Self { robot, pose, load, distribution, reference, limits, characteristic_length, external })
    }

    /// The problem at a pose nearby, within the same limits.
    pub(super) fn nearby(&self, pose: &'a Pose, load: &'a Load, reference: Vec<f64>) -> Self {
        let (characteristic_length, external) = external(self.robot, pose, load);
        Self { pose, load, reference, limits: self.limits.clone(), characteristic_length, external, ..*self }
    }

    /// Narrows the limits to tensions that differ by at most `change` [N] from others.
    pub(super) fn narrow(&mut self, tensions: &[f64], change: f64) -> Result<(), StaticsError> {
        for (i, (limits, tension)) in self.limits.iter_mut().zip(tensions).enumerate() {
            let (min, max) = (limits.min.max(tension - change), limits.max.min(tension + change));
            if max < min {
                let expected = format!("{} to {} N at this pose", limits.min, limits.max);
                return Err(StaticsError::invalid(format!("tensions[{i}]"), tension, expected));
            }
            *limits = TensionLimits { min, max };
        }
        Ok(())
    }

    pub(super) fn cables(&self) -> usize {
        self.reference.len()
    }
}

/// The characteristic length [m], and w_ex with its moments divided by it.
fn external(robot: &Robot, pose: &Pose, load: &Load) -> (f64, Vector6<f64>) {
    let longest = (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max);
    let characteristic_length = robot.platform_size().max(1e-3 * longest);
    let mut wrench = load.total(robot, pose).to_vector();
    wrench.fixed_rows_mut::<3>(3).unscale_mut(characteristic_length);
    (characteristic_length, robot.freedoms().of_vector(&wrench))
}
