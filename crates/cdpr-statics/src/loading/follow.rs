//! Following an equilibrium from one setting of lengths and load to another.

use crate::direct::{DirectStart, Path, Setting, direct, follow_from};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use cdpr_robot::Robot;

/// Follows the stable equilibrium near `start` from one setting to another.
///
/// # Errors
/// Those of [`direct`] at the first setting. That the equilibrium is lost on the way is a result, not an
/// error.
pub fn follow(robot: &Robot, from: &Setting, to: &Setting, start: DirectStart) -> Result<Path, StaticsError> {
    DirectProblem::new(robot, &to.lengths, &to.load)?;
    let first = direct(robot, &from.lengths, &from.load, start)?;
    follow_from(robot, from, to, first)
}
