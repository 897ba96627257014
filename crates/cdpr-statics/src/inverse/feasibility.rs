//! Whether tensions hold a pose, without a choice among them.

use super::InverseSolution;
use super::feasible::{has_tensions, search};
use super::free::rest;
use super::problem::InverseProblem;
use super::wanted::refuse_offsets;
use crate::error::StaticsError;
use crate::state::{Load, Wanted, WantedPose, one_by_one};
use cdpr_robot::Robot;

/// Whether tensions within the limits hold the platform at a wanted pose, or at each of many, under its
/// weight and `load`, as far as the search from the tensions of straight cables shows.
///
/// A yes is certain. A no comes much sooner than from [`crate::inverse`], which tries other starts before it
/// calls a pose infeasible: cables that sag may hold a pose with tensions far from those of straight ones.
/// With free coordinates the result is whether [`crate::inverse`] finds the platform at rest.
///
/// # Errors
/// Those of [`crate::inverse`] but [`StaticsError::NoTensions`], [`StaticsError::InverseNotConverged`] and
/// [`StaticsError::NoRest`].
pub fn is_feasible<W: Wanted>(
    robot: &Robot,
    wanted: W,
    load: &Load,
) -> W::Results<Result<bool, StaticsError>> {
    one_by_one(wanted, |wanted| {
        let wanted = refuse_offsets(*wanted)?;
        if wanted.free.is_empty() {
            return is_feasible_at(robot, &wanted, load);
        }
        match rest(robot, &wanted, load) {
            Ok(_) => Ok(true),
            Err(StaticsError::NoRest { .. }) => Ok(false),
            Err(error) => Err(error),
        }
    })
}

fn is_feasible_at(robot: &Robot, wanted: &WantedPose, load: &Load) -> Result<bool, StaticsError> {
    let problem = InverseProblem::of_whole_pose(robot, &wanted.pose, load, wanted.tension_reference)?;
    let limits = problem.limits.iter().enumerate();
    if limits.into_iter().any(|(i, limits)| robot.cable(i).overstrain(limits.max).is_some()) {
        // Tensions within the limits may strain a cable too much.
        return Ok(search(&problem).and_then(|found| InverseSolution::new(&problem, found)).is_ok());
    }
    has_tensions(&problem)
}
