//! `cdpr direct`: where the platform stands for given unstrained lengths.
//!
//! Cases come one from the arguments, or one or many from a file.

mod answer;
mod case;
mod table;

use crate::program::arguments::poses::{self, PoseArguments};
use crate::program::arguments::{self, Lengths, Printing, RobotArgument};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, patiently, print_sentence, progress};
use crate::program::pose::at_pose::Failure;
use crate::program::questions;
use answer::{Answer, How, solve};
use case::{Case, Cases};
use cdpr_robot::{Doubts, Robot, shown};
use cdpr_statics::StaticsError;
use serde::Serialize;
use std::path::PathBuf;

/// The robot, the lengths and the load.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("what").required(true).args(["lengths", "from"]))]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// Unstrained lengths of the cables, in the order of the file: l1,..,ln [m]; or a table with a set of
    /// them on each line, length_1_m to length_n_m.
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

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let robot = questions::open_robot(settings.robot.path())?;
    let (name, how) = (shown(&robot.name), settings.how()?);
    let table = |path| {
        let common = settings.case(Vec::new())?;
        table::run(settings.printing.format(), (&robot, path), &common, how)
    };
    let cases = match (&settings.from, &settings.lengths) {
        (_, Some(Lengths::Table(path))) => return table(path),
        (Some(path), _) => match Cases::read(path)? {
            Some(cases) => cases,
            None => return table(path),
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
        let with = arguments::With::known(self.with.as_ref(), &["certificate", "starts"])?;
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
