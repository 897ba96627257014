//! `cdpr direct`: where the platform stands for given unstrained lengths.
//!
//! Cases come one from the arguments, or one or many from a file.

mod case;
mod table;

use crate::program::answer::Found;
use crate::program::arguments::poses::{self, PoseArguments};
use crate::program::arguments::{self, Lengths, Printing, RobotArgument};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, patiently, print_sentence, progress};
use crate::program::pose::at_pose::Failure;
use crate::program::questions;
use case::{Case, CaseError, Cases};
use cdpr_assess::doubtful_rest;
use cdpr_robot::{Doubts, Pose, Robot, frame, plausible, shown};
use cdpr_statics::multistart::Starts;
use cdpr_statics::{
    Certificate, DirectProblem, DirectSolution, DirectStart, StaticsError, check_lengths, rough_pose,
};
use serde::Serialize;
use std::path::PathBuf;

/// Reach of further starts over the size of the frame, and their greatest turn about each axis [rad].
const REACH: (f64, f64) = (0.2, 1.5);

/// The robot, the lengths and the load.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("what").required(true).args(["lengths", "from"]))]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// Unstrained lengths of the cables, in the order of the file: l1,..,ln [m]; or a table with a set of them
    /// on each line, length_1_m to length_n_m.
    ///
    /// Poses of the table, x_m,y_m,z_m and so on as `inverse` has them, are where the searches start. The
    /// answers are lines of CSV, or of JSON with `--format json`, with all columns of the table.
    #[arg(long, value_parser = arguments::lengths, allow_hyphen_values = true)]
    lengths: Option<Lengths>,
    /// Mass of the platform with all it carries, instead of the file's [kg].
    #[arg(long, value_parser = arguments::number, allow_hyphen_values = true)]
    mass: Option<f64>,
    /// Force on the platform, in the base frame: fx,fy,fz [N].
    #[arg(long, value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    force: Option<[f64; 3]>,
    /// Moment about P, of constant components in the base frame: mx,my,mz [N m].
    #[arg(long, value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    moment: Option<[f64; 3]>,
    /// Mass added at the platform's centre of mass [kg].
    #[arg(long, value_parser = arguments::mass, allow_hyphen_values = true)]
    payload: Option<f64>,
    #[command(flatten)]
    pose: PoseArguments,
    /// certificate: prove how close the exact equilibrium is. starts=N: search from N poses around the start,
    /// too, and print all that are found.
    ///
    /// Without --pose the search starts level, where straight cables would hold a point. Lengths may hold a
    /// platform at several poses; the one that is found is near the start.
    #[arg(long, value_name = "NAMES", value_parser = arguments::with)]
    with: Option<arguments::With>,
    /// JSON file with cases: one, a list, or one a line, as `inverse` and `deflection` print them with
    /// `--format json`, or a table of lengths; - for the standard input.
    ///
    /// A case: {"lengths": [..], "mass": .., "force": [..], "moment": [..], "payload": .., "pose": [..]}.
    #[arg(long, value_name = "FILE")]
    #[arg(conflicts_with_all = ["lengths", "mass", "force", "moment", "payload", "pose", "rpy"])]
    from: Option<PathBuf>,
    #[command(flatten)]
    printing: Printing,
}

/// What is done at an equilibrium.
#[derive(Clone, Copy)]
struct How {
    /// Whether it is proved.
    certify: bool,
    /// Number of starts from which others are sought.
    starts: Option<usize>,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let robot = questions::open_robot(settings.robot.path())?;
    let (name, how) = (shown(&robot.name), settings.how()?);
    let cases = match (&settings.from, &settings.lengths) {
        (_, Some(Lengths::Table(path))) => return table::run(settings, &robot, path),
        (Some(path), _) => match Cases::read(path)? {
            Some(cases) => cases,
            None => return table::run(settings, &robot, path),
        },
        (None, lengths) => {
            let listed = lengths.as_ref().map(Lengths::listed).transpose()?;
            Cases::One(Box::new(settings.case(listed.unwrap_or_default().to_vec())?))
        }
    };
    match cases {
        Cases::One(case) => {
            case.question(&robot);
            let answer = patiently("solving", || solve_and_ask(&robot, &case, "the equilibrium", how));
            let answer = match &settings.from {
                Some(path) => answer.map_err(ProgramError::in_file(path))?,
                None => answer?,
            };
            settings.printing.format().print(&answer, |answer| answer.print(&name, &case.lengths))?;
            Ok(answer.ending())
        }
        Cases::List(cases) => {
            cases.iter().for_each(|case| case.question(&robot));
            let progress = progress(cases.len(), "cases");
            let answer = |(i, case): (usize, &Case)| {
                let name = format!("the equilibrium of case {}", i + 1);
                let answer = solve_and_ask(&robot, case, &name, how).into();
                progress.inc(1);
                answer
            };
            let answers: Vec<Entry> = cases.iter().enumerate().map(answer).collect();
            progress.finish_and_clear();
            settings.printing.format().print(&answers, |answers| {
                for (i, (entry, case)) in answers.iter().zip(&cases).enumerate() {
                    entry.print(&format!("Case {}", i + 1), &case.lengths);
                }
            })?;
            let well = answers.iter().all(|entry| entry.ending() == Ending::Well);
            Ok(if well { Ending::Well } else { Ending::SomethingWrong })
        }
    }
}

impl Settings {
    fn how(&self) -> Result<How, ProgramError> {
        let with = self.with.clone().unwrap_or_default();
        with.check(&["certificate", "starts"])?;
        let starts = with.value("starts", None, arguments::count::<1, 10_000>)?;
        Ok(How { certify: with.has("certificate")?, starts })
    }

    /// The case of these lengths [m].
    fn case(&self, lengths: Vec<f64>) -> Result<Case, ProgramError> {
        let mut case = Case::default().with_lengths(lengths);
        (case.mass, case.payload) = (self.mass, self.payload);
        (case.force, case.moment) = (self.force, self.moment);
        case.pose = self.pose.given()?.map(|pose| poses::pose_numbers(&pose).to_vec());
        Ok(case)
    }
}

/// The equilibrium of a case.
#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    found: Found,
    #[serde(skip_serializing_if = "Option::is_none")]
    certificate: Option<Proof>,
    /// Other stable equilibria that further starts have found.
    #[serde(skip_serializing_if = "Option::is_none")]
    others: Option<Vec<Found>>,
}

/// The proof of how close the exact equilibrium is, or why there is no proof.
#[derive(Serialize)]
#[serde(untagged)]
enum Proof {
    Given { position: f64, rotation: f64, force: f64, least_stiffness: f64, stable: bool },
    None { error: Failure },
}

/// The answer to one case of a list.
#[derive(Serialize)]
#[serde(untagged)]
enum Entry {
    Answer(Box<Answer>),
    Failed { error: Failure },
}

/// Solves a case and asks about the answer, which is called `name`.
fn solve_and_ask(robot: &Robot, case: &Case, name: &str, how: How) -> Result<Answer, StaticsError> {
    let mut doubts = Doubts::new();
    let answer = solve(robot, case, name, how, &mut doubts);
    questions::ask(doubts);
    answer
}

/// Solves a case; what is doubtful about the answer, which is called `name`, is added to the doubts.
fn solve(
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
    fn ending(&self) -> Ending {
        match self.certificate {
            Some(Proof::None { .. }) => Ending::SomethingWrong,
            _ => self.found.ending(),
        }
    }

    fn print(&self, name: &str, lengths: &[f64]) {
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

impl Entry {
    fn ending(&self) -> Ending {
        match self {
            Self::Answer(answer) => answer.ending(),
            Self::Failed { .. } => Ending::SomethingWrong,
        }
    }

    fn print(&self, name: &str, lengths: &[f64]) {
        match self {
            Self::Answer(answer) => answer.print(name, lengths),
            Self::Failed { error } => print_sentence(&format!("{name} has no answer: {}", error.message)),
        }
    }
}

impl From<Result<Answer, StaticsError>> for Entry {
    fn from(answer: Result<Answer, StaticsError>) -> Self {
        match answer {
            Ok(answer) => Self::Answer(Box::new(answer)),
            Err(error) => Self::Failed { error: error.into() },
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
