//! The nominal robot at the poses of a study, solved once for each.

use cdpr_robot::{Coordinate, Pose, Robot};
use cdpr_statics::limits::{OutOfLimits, out_of_limits};
use cdpr_statics::{Deflection, DirectSolution, Load, StaticsError, WantedPose, deflection};
use std::sync::{Arc, Mutex, PoisonError};

/// Poses that are kept: those of single samplings and of surfaces, and the first ones of a sampling at
/// several.
const MOST: usize = 64;

/// Deflections of the nominal robot, shared by all copies of a study: its check, its run and its figures ask
/// for the same.
#[derive(Clone, Debug, Default)]
pub(crate) struct Nominals(Arc<Mutex<Vec<Nominal>>>);

/// A deflection and what it is of.
#[derive(Clone, Debug)]
struct Nominal {
    robot: Robot,
    pose: Pose,
    load: Load,
    free: Vec<Coordinate>,
    deflection: Deflection,
}

impl Nominals {
    /// The deflection of a robot without offsets of its tensions, with the `free` coordinates found.
    ///
    /// # Errors
    /// As [`cdpr_statics::deflection`].
    pub(crate) fn deflection(
        &self,
        robot: &Robot,
        pose: &Pose,
        load: &Load,
        free: &[Coordinate],
    ) -> Result<Deflection, StaticsError> {
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let same =
            |of: &&Nominal| of.pose == *pose && of.load == *load && of.free == *free && of.robot == *robot;
        if let Some(found) = known().iter().find(same) {
            return Ok(found.deflection.clone());
        }
        let found = deflection(robot, WantedPose::at(pose).free(free), load)?;
        let mut known = known();
        if known.len() < MOST {
            let (robot, free, deflection) = (robot.clone(), free.to_vec(), found.clone());
            known.push(Nominal { robot, pose: *pose, load: *load, free, deflection });
        }
        Ok(found)
    }
}

/// The tensions of a deflection above their limits or breaking forces, in words.
pub(crate) fn too_much(robot: &Robot, Deflection { lengths, unloaded, loaded }: &Deflection) -> Vec<String> {
    let words = |when: &str, at: &DirectSolution| {
        let found = out_of_limits(robot, lengths, &[&at.equilibrium]).into_iter();
        let found = found.filter(OutOfLimits::is_too_much);
        found.map(|one| format!("{when} the payload: {one}")).collect::<Vec<_>>()
    };
    [words("without", unloaded), words("with", loaded)].concat()
}
