//! The answer of a direct problem.

use super::case::{Case, CaseError};
use crate::program::answer::Found;
use crate::program::arguments::poses;
use crate::program::output::{Ending, print_sentence};
use crate::program::pose::at_pose::Failure;
use cdpr_assess::doubtful_rest;
use cdpr_robot::{Doubts, Pose, Robot, frame, plausible};
use cdpr_statics::multistart::Starts;
use cdpr_statics::{
    Certificate, DirectProblem, DirectSolution, DirectStart, StaticsError, check_lengths, rough_pose,
};
use serde::Serialize;

/// Reach of further starts over the size of the frame, and their greatest turn about each axis [rad].
const REACH: (f64, f64) = (0.2, 1.5);

/// What is done at an equilibrium.
#[derive(Clone, Copy)]
pub(super) struct How {
    /// Whether it is proved.
    pub(super) certify: bool,
    /// Number of starts from which others are sought.
    pub(super) starts: Option<usize>,
}

/// The equilibrium of a case.
#[derive(Serialize)]
pub(super) struct Answer {
    #[serde(flatten)]
    pub(super) found: Found,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) certificate: Option<Proof>,
    /// Other stable equilibria that further starts have found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) others: Option<Vec<Found>>,
}

/// The proof of how close the exact equilibrium is, or why there is no proof.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Proof {
    Given {
        #[serde(rename = "position_m")]
        position: f64,
        #[serde(rename = "rotation_rad")]
        rotation: f64,
        #[serde(rename = "force_n")]
        force: f64,
        #[serde(rename = "least_stiffness_n_per_m")]
        least_stiffness: f64,
        stable: bool,
    },
    None {
        error: Failure,
    },
}

/// Solves a case; what is doubtful about the answer, which is called `name`, is added to the doubts.
pub(super) fn solve(
    robot: &Robot,
    case: &Case,
    name: &str,
    how: How,
    doubts: &mut Doubts,
) -> Result<Answer, StaticsError> {
    let mut robot = robot.clone();
    if let Some(mass) = case.mass {
        robot.platform.mass = mass;
        robot.validate()?;
    }
    if let Some(CaseError { message }) = &case.error {
        return Err(StaticsError::Invalid {
            field: "lengths".to_owned(),
            value: "missing".to_owned(),
            expected: format!("lengths; the inverse model has none: {message}"),
        });
    }
    let load = case.load();
    let start = match case.start() {
        Some(numbers) => poses::stated_pose(numbers).map_err(|_| StaticsError::Invalid {
            field: "pose".to_owned(),
            value: format!("{numbers:?}"),
            expected: "x,y,z [m] or x,y,z,qw,qx,qy,qz, with a unit quaternion, qw first".to_owned(),
        })?,
        None => rough_pose(&robot, &case.lengths),
    };
    if !start.is_finite() {
        return Err(StaticsError::Invalid {
            field: "lengths".to_owned(),
            value: format!("{:?}", case.lengths),
            expected: "lengths within reach of the robot's frame [m]".to_owned(),
        });
    }
    check_lengths(&robot, &case.lengths)?;
    let problem = DirectProblem::new(&robot, &case.lengths, &load)?;
    let (solution, others) = rests(&robot, &problem, &start, how.starts).inspect_err(|_| {
        if case.start().is_some() {
            doubts.extend(plausible::lengths_at(&robot, &case.lengths, &start));
        }
    })?;
    let stated = case.start().map(|_| &start);
    doubts.extend(doubtful_rest(&robot, name, (&case.lengths, &load), &solution, stated));
    let certificate = (how.certify || case.certify).then(|| problem.certify(&solution).into());
    let found = |solution: &DirectSolution| Found::new(&robot, &case.lengths, solution);
    Ok(Answer {
        found: found(&solution),
        certificate,
        others: others.map(|others| others.iter().map(found).collect()),
    })
}

/// The equilibrium from a start, or else from one of the poses around it, and the other stable ones of these.
fn rests(
    robot: &Robot,
    problem: &DirectProblem,
    start: &Pose,
    starts: Option<usize>,
) -> Result<(DirectSolution, Option<Vec<DirectSolution>>), StaticsError> {
    let first = problem.direct(DirectStart::Pose(start));
    let Some(count) = starts else { return first.map(|solution| (solution, None)) };
    let size = frame(robot).iter().map(|[low, high]| high - low).fold(0.0, f64::max);
    let starts = Starts { center: *start, reach: REACH.0 * size, rotation: REACH.1, count };
    let found = problem.equilibria(&starts)?.found.into_iter().map(|found| found.solution);
    let mut stable: Vec<DirectSolution> = found.filter(|found| found.stability.is_stable()).collect();
    let first = match first {
        Err(error) if stable.is_empty() => return Err(error),
        Err(_) => stable.remove(0),
        Ok(first) => first,
    };
    stable.retain(|other| !problem.is_same(&first, other));
    Ok((first, Some(stable)))
}

impl Answer {
    pub(super) fn ending(&self) -> Ending {
        match self.certificate {
            Some(Proof::None { .. }) => Ending::SomethingWrong,
            _ => self.found.ending(),
        }
    }

    pub(super) fn print(&self, name: &str, lengths: &[f64]) {
        self.found.print(name, lengths);
        match &self.certificate {
            Some(Proof::Given { position, rotation, force, least_stiffness, .. }) => {
                print_sentence(&format!(
                    "proved: an exact equilibrium is within {position:.1e} m, {rotation:.1e} rad and {force:.1e} N of \
                     this one, whose residuals are what is left of the equations here; softest motion at least \
                     {least_stiffness:.1} N/m"
                ));
            }
            Some(Proof::None { error }) => print_sentence(&error.message),
            None => {}
        }
        for other in self.others.iter().flatten() {
            print_sentence(&format!("also stable at {}", other.place));
        }
        if self.others.as_ref().is_some_and(Vec::is_empty) {
            println!("no other stable equilibrium was found from these starts");
        }
    }
}

impl From<Result<Certificate, StaticsError>> for Proof {
    fn from(certificate: Result<Certificate, StaticsError>) -> Self {
        match certificate {
            Ok(proof) => Self::Given {
                position: proof.position,
                rotation: proof.rotation,
                force: proof.force,
                least_stiffness: proof.least_stiffness,
                stable: proof.is_stable(),
            },
            Err(error) => Self::None { error: error.into() },
        }
    }
}
