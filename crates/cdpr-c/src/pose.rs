//! The models at one pose, with results as C has them.

use crate::data::{CdprReport, CdprStiffness};
use crate::failure::Failure;
use cdpr_robot::{Pose, Robot};
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::{DMatrix, Derivatives, DirectProblem, DirectSolution, Load};

pub(crate) fn report(solution: &DirectSolution) -> CdprReport {
    CdprReport::new(solution.report.residual, solution.report.iterations)
}

/// The stiffness at a pose that the inverse model holds.
pub(crate) fn stiffness(
    robot: &Robot,
    pose: &Pose,
    load: &Load,
) -> Result<(CdprStiffness, CdprReport), Failure> {
    let found = stiffness_at(robot, pose, load)?;
    let residual = DirectProblem::new(robot, &found.lengths, load)?.residual(&found.equilibrium)?;
    let matrix = found.matrix.transpose().into();
    let is_stable = u32::from(found.stability.is_stable());
    let stiffness = CdprStiffness { matrix, least: found.stability.least_stiffness(), is_stable };
    Ok((stiffness, CdprReport::new(residual, 0)))
}

/// The entries of a matrix, row by row.
pub(crate) fn rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// The derivatives of the displacement, row by row.
pub(crate) fn displacement(derivatives: &Derivatives) -> Vec<f64> {
    derivatives.displacement().transpose().as_slice().to_vec()
}
