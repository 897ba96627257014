//! The nominal robot at the poses of a study, solved once for each.

use cdpr_robot::{Coordinate, Pose, Robot};
use cdpr_statics::limits::{OutOfLimits, in_words, out_of_limits};
use cdpr_statics::{
    Deflection, DirectProblem, DirectSolution, DirectStart, Load, StaticsError, WantedPose, deflection,
    deflection_from,
};
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
    load: Load,
    at: NominalAt,
    deflection: Deflection,
}

/// Where a platform is wanted: at a pose with `free` coordinates that are found, or near it on given lengths.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NominalAt {
    pub(crate) pose: Pose,
    pub(crate) free: Vec<Coordinate>,
    /// Unstrained lengths [m].
    pub(crate) lengths: Option<Vec<f64>>,
}

impl Nominals {
    /// The deflection of a robot without offsets of its tensions.
    ///
    /// # Errors
    /// As [`cdpr_statics::deflection`]; on given lengths as [`cdpr_statics::deflection_from`].
    pub(crate) fn deflection(
        &self,
        robot: &Robot,
        at: &NominalAt,
        load: &Load,
    ) -> Result<Deflection, StaticsError> {
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let same = |of: &&Nominal| of.at == *at && of.load == *load && of.robot == *robot;
        if let Some(found) = known().iter().find(same) {
            return Ok(found.deflection.clone());
        }
        let found = match &at.lengths {
            None => deflection(robot, WantedPose::at(&at.pose).free(&at.free), load)?,
            Some(lengths) => {
                let problem = DirectProblem::new(robot, lengths, &Load::none())?;
                let rest = problem.direct(DirectStart::Pose(&at.pose))?.equilibrium;
                deflection_from(robot, lengths.clone(), load, &rest)?
            }
        };
        let mut known = known();
        if known.len() < MOST {
            known.push(Nominal {
                robot: robot.clone(),
                load: *load,
                at: at.clone(),
                deflection: found.clone(),
            });
        }
        Ok(found)
    }
}

/// The tensions of a deflection above their limits or breaking forces, in words.
pub(crate) fn too_much(robot: &Robot, Deflection { lengths, unloaded, loaded }: &Deflection) -> Vec<String> {
    let words = |when: &str, at: &DirectSolution| {
        let mut found = out_of_limits(robot, lengths, &[&at.equilibrium]);
        found.retain(OutOfLimits::is_too_much);
        in_words(&found).into_iter().map(|line| format!("{when} the payload: {line}")).collect::<Vec<_>>()
    };
    [words("without", unloaded), words("with", loaded)].concat()
}
