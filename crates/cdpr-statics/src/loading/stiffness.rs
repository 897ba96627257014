//! The Cartesian stiffness at a wanted pose.

use crate::direct::{DirectStart, Stability};
use crate::error::StaticsError;
use crate::inverse::{lengths_at, refuse_offsets};
use crate::problem::{DirectProblem, Unstable};
use crate::state::{Equilibrium, Load, WantedPose};
use cdpr_robot::Robot;
use nalgebra::Matrix6;

/// Stiffness of a robot at a pose that the inverse model holds.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseStiffness {
    /// Stiffness K in (dp, dφ) [N/m, N/rad, N, N m/rad], the true tangent: see
    /// [`crate::stiffness::Linearization::stiffness`].
    pub matrix: Matrix6<f64>,
    /// Its symmetric part, which differs from it under a moment.
    pub symmetric_part: Matrix6<f64>,
    /// Eigenvalues and motions of the symmetric part, and whether the equilibrium is stable.
    pub stability: Stability,
    /// Unstrained lengths [m].
    pub lengths: Vec<f64>,
    /// The equilibrium.
    pub equilibrium: Equilibrium,
}

/// The Cartesian stiffness at a wanted pose under the platform's weight and `load`, be the equilibrium there
/// stable or not.
///
/// # Errors
/// Those of [`crate::inverse`] and of [`DirectProblem::direct`].
pub fn stiffness_at<'a>(
    robot: &Robot,
    wanted: impl Into<WantedPose<'a>>,
    load: &Load,
) -> Result<PoseStiffness, StaticsError> {
    let wanted = lengths_at(robot, &refuse_offsets(wanted.into())?, load)?;
    let problem = DirectProblem::new(robot, &wanted.lengths, load)?;
    let found = problem.with_unstable(Unstable::Accepted).direct(DirectStart::Near(&wanted.equilibrium))?;
    let linearization = problem.linearize(&found.equilibrium)?;
    Ok(PoseStiffness {
        matrix: *linearization.stiffness(),
        symmetric_part: linearization.symmetric_stiffness(),
        stability: found.stability,
        lengths: wanted.lengths.clone(),
        equilibrium: found.equilibrium,
    })
}
