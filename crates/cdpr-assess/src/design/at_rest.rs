//! A robot at a pose before and with the load, as the scalar models or the lanes find it.

use crate::design::goal::Goal;
use crate::design::problem::DesignProblem;
use cdpr_robot::Robot;
use cdpr_statics::batch::{LoadedPose, loaded_poses};
use cdpr_statics::{Deflection, Equilibrium, InverseSolution, StaticsError};

/// A robot at a pose, with the lengths of the pose without the load.
pub(crate) enum AtRest {
    /// By the scalar models.
    Alone(Box<Deflection>),
    /// In lanes, with the unstrained lengths [m].
    Lanes(Vec<f64>, LoadedPose),
}

impl AtRest {
    /// Unstrained lengths [m].
    pub(crate) fn lengths(&self) -> &[f64] {
        match self {
            Self::Alone(found) => &found.lengths,
            Self::Lanes(lengths, _) => lengths,
        }
    }

    /// |dp| [m].
    pub(crate) fn magnitude(&self) -> f64 {
        match self {
            Self::Alone(found) => found.magnitude(),
            Self::Lanes(_, found) => found.displacement.norm(),
        }
    }

    /// The equilibrium with the load; `None` of lanes.
    pub(crate) fn equilibrium(&self) -> Option<&Equilibrium> {
        match self {
            Self::Alone(found) => Some(&found.loaded.equilibrium),
            Self::Lanes(..) => None,
        }
    }

    /// Tensions at the anchor points with the load [N].
    pub(crate) fn tensions(&self) -> Vec<f64> {
        match self {
            Self::Alone(found) => found.loaded.equilibrium.tensions(),
            Self::Lanes(_, found) => found.tensions[1].iter().map(|ends| ends[0]).collect(),
        }
    }

    /// Tensions at the exit points with the load [N].
    pub(crate) fn exit_tensions(&self, robot: &Robot) -> Vec<f64> {
        match self {
            Self::Alone(found) => found.loaded.equilibrium.exit_tensions(robot, &found.lengths),
            Self::Lanes(_, found) => found.tensions[1].iter().map(|ends| ends[1]).collect(),
        }
    }
}

impl DesignProblem {
    /// Whether the lanes find all that is observed without derivatives: no frequency, and a stiffness only
    /// where the robot measures rotations by the length of the problem.
    pub(crate) fn is_for_lanes(&self, robot: &Robot) -> bool {
        let size = robot.platform_size();
        let length = if size > 0.0 { size } else { 1.0 };
        self.free.is_empty()
            && !self.needs(Goal::Frequency)
            && !self.needs(Goal::PlatformFrequency)
            && (!self.needs(Goal::Stiffness) || length == self.characteristic_length)
    }

    /// The robot under the load at poses that the inverse model has solved without it.
    ///
    /// # Errors
    /// Why it is not held at a pose.
    pub(crate) fn loaded(
        &self,
        robot: &Robot,
        solved: Vec<Result<InverseSolution, StaticsError>>,
    ) -> Result<Vec<AtRest>, StaticsError> {
        let held: Vec<InverseSolution> = solved.into_iter().collect::<Result<_, _>>()?;
        let found: Vec<LoadedPose> = loaded_poses(robot, &held.iter().collect::<Vec<_>>(), &self.load)
            .into_iter()
            .collect::<Result<_, _>>()?;
        Ok(held.into_iter().zip(found).map(|(held, found)| AtRest::Lanes(held.lengths, found)).collect())
    }
}
