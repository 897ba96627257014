//! A robot at a pose, or at each pose of a file: arguments and answers of several commands.

use crate::program::answer::OutOfLimits;
use crate::program::arguments::poses::{COLUMNS, PoseArguments, place, pose_numbers};
use crate::program::arguments::{
    Format, FreeArguments, LoadArguments, Preference, Printing, RobotArgument, print_record,
};
use crate::program::error::ProgramError;
use crate::program::lists::{PoseTable, pose_file};
use crate::program::output::{Ending, patiently, print_sentence, progress};
use crate::program::questions;
use cdpr_robot::{Pose, Robot, shown};
use cdpr_statics::StaticsError;
use cdpr_study::is_not_finite;
use indexmap::IndexMap;
use indicatif::ProgressBar;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Why a cell is empty at a pose that has an answer.
const NOT_FINITE: &str = "numbers that are too large for the computer are left out";

const POSE_EXPECTED: &str = "expected --pose x,y,z, or --poses with a table of poses";

/// Poses that are answered before their rows are printed.
const CHUNK: usize = 1024;

/// A robot at a pose or at each of a file with a load, and how the answer is printed.
#[derive(clap::Args)]
pub(crate) struct RobotAtPose {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    pose: PoseArguments,
    /// Table of poses: x_m,y_m,z_m, then qw,qx,qy,qz or roll_deg,pitch_deg,yaw_deg or nothing; or answers of
    /// `direct` in JSON; - for the standard input.
    ///
    /// The answers are lines of CSV, or of JSON with `--format json`. A pose without an answer has a line
    /// with the reason, and the exit code is 3.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["pose", "rpy"])]
    poses: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) printing: Printing,
    #[command(flatten)]
    pub(crate) load: LoadArguments,
    #[command(flatten)]
    preference: Preference,
}

/// A robot at a pose, and the coordinates that are found.
#[derive(clap::Args)]
pub(crate) struct RobotAtFreePose {
    #[command(flatten)]
    pub(super) at: RobotAtPose,
    #[command(flatten)]
    pub(super) free: FreeArguments,
}

/// An answer that is a row of a table.
pub(crate) trait Row: Serialize + Send {
    /// Names of the columns for a robot.
    fn columns(robot: &Robot) -> Vec<String>;

    /// Its cells.
    fn cells(&self) -> Vec<String>;

    /// Its cases as a table, names first, where the table of a single pose has a row for each of them.
    fn cases(&self) -> Option<Vec<Vec<String>>> {
        None
    }

    /// Its tensions that are out of limits, in one list for each of its equilibria.
    fn out_of_limits(&self) -> Vec<&[OutOfLimits]>;

    /// How a command ends that gives this answer.
    fn ending(&self) -> Ending {
        let lists = self.out_of_limits().into_iter();
        lists.fold(Ending::Well, |ending, list| ending.and(OutOfLimits::ending(list)))
    }

    /// The pose with its free coordinates as they are found, if there are any.
    fn found_pose(&self) -> Option<Pose> {
        None
    }

    /// What is doubtful about its numbers, if anything is.
    fn warning(&self) -> Option<&str> {
        None
    }

    /// What is to be said of it in a table.
    fn remark(&self) -> String {
        let lists = self.out_of_limits().into_iter();
        let beyond = lists.filter(|list| !list.is_empty()).map(OutOfLimits::cell);
        beyond.chain(self.warning().map(|warning| warning.replace('\n', " "))).collect::<Vec<_>>().join("; ")
    }
}

/// Why there is no answer.
#[derive(Serialize)]
pub(crate) struct Failure {
    pub(crate) kind: &'static str,
    pub(crate) message: String,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    fall: Option<Box<Fall>>,
}

/// Where the platform falls while a load is raised; poses have a quaternion.
#[derive(Serialize)]
struct Fall {
    /// Share of the load at which it falls.
    share: f64,
    /// The last pose before.
    falls_from: [f64; 7],
    /// `None` where it is not known.
    falls_to: Option<[f64; 7]>,
}

impl Failure {
    /// Whether the platform falls.
    pub(crate) fn is_fall(&self) -> bool {
        self.fall.is_some()
    }
}

impl From<StaticsError> for Failure {
    fn from(error: StaticsError) -> Self {
        let (kind, message) = (error.kind(), error.to_string());
        let fall = match error {
            StaticsError::BranchEnds(end) => Some(Fall {
                share: end.share,
                falls_from: pose_numbers(&end.pose),
                falls_to: end.falls_to.ok().as_ref().map(pose_numbers),
            }),
            _ => None,
        };
        Self { kind, message, fall: fall.map(Box::new) }
    }
}

/// A line of JSON: the answer at a pose, or the reason why the pose has no answer.
#[derive(Serialize)]
struct Line<'a, T> {
    pose: [f64; 7],
    /// Further columns of the table of poses.
    #[serde(skip_serializing_if = "IndexMap::is_empty")]
    given: IndexMap<&'a str, Value>,
    #[serde(flatten)]
    answer: Option<&'a T>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a Failure>,
}

impl RobotAtPose {
    /// Answers what `solve` answers at the pose, or at each pose of the file.
    ///
    /// A single answer is one line of JSON, or what `text` prints below a heading of robot and pose.
    pub(crate) fn answer<T: Row>(
        &self,
        solve: impl Fn(&Robot, &Pose) -> Result<T, StaticsError> + Sync,
        text: impl FnOnce(&T, &str),
    ) -> Result<Ending, ProgramError> {
        let robot = self.robot()?;
        let pose = match &self.poses {
            Some(path) => {
                let solve = |pose: &Pose, progress: &ProgressBar| {
                    let answer = solve(&robot, pose);
                    progress.inc(1);
                    answer
                };
                return self.answer_all(&robot, path, |poses, progress| {
                    poses.par_iter().map(|pose| solve(pose, progress)).collect()
                });
            }
            None => self.pose.given()?.ok_or_else(|| ProgramError::Usage(POSE_EXPECTED.to_owned()))?,
        };
        let format = self.printing.format();
        match patiently("solving", || solve(&robot, &pose)) {
            Err(error @ StaticsError::BranchEnds(_)) => print_fall(format, &robot, &pose, error),
            answer => self.print(&robot, &pose, &answer?, |answer| {
                text(answer, &heading(&robot, &answer.found_pose().unwrap_or(pose)));
            }),
        }
    }

    /// Prints the answer at a pose.
    pub(crate) fn print<T: Row>(
        &self,
        robot: &Robot,
        pose: &Pose,
        answer: &T,
        text: impl FnOnce(&T),
    ) -> Result<Ending, ProgramError> {
        match self.printing.format() {
            Format::Csv => match answer.cases() {
                Some(cases) => print_cases(&answer.found_pose().unwrap_or(*pose), cases),
                None => {
                    print_names::<T>(robot, &[]);
                    print_row(pose, &[], Ok(answer), 0);
                }
            },
            format => format.print(answer, text)?,
        }
        Ok(answer.ending())
    }

    /// The pose, if one is given.
    pub(crate) fn pose(&self) -> Result<Option<Pose>, ProgramError> {
        self.pose.given()
    }

    /// The robot of the file, once load and pose have been compared with it.
    pub(crate) fn robot(&self) -> Result<Robot, ProgramError> {
        let robot = self.preference.open_robot(self.robot.path())?;
        questions::about_load(&robot, &self.load.load());
        if let Some(pose) = self.pose.given()? {
            questions::about_pose(&robot, "--pose", &pose);
        }
        Ok(robot)
    }

    fn poses_path(&self) -> Result<&Path, ProgramError> {
        let expected = || ProgramError::Usage("expected --poses FILE, the poses of the path".to_owned());
        self.poses.as_deref().ok_or_else(expected)
    }

    /// The poses of the file.
    pub(crate) fn poses(&self, robot: &Robot) -> Result<Vec<Pose>, ProgramError> {
        let path = self.poses_path()?;
        let PoseTable { poses, .. } = pose_file(path, robot)?;
        questions::about_poses(robot, "--poses", &poses);
        Ok(poses)
    }

    /// Answers what `solve` answers at the poses of the file, one after the other.
    pub(crate) fn answer_in_order<T: Row>(
        &self,
        robot: &Robot,
        mut solve: impl FnMut(&Pose) -> Result<T, StaticsError>,
    ) -> Result<Ending, ProgramError> {
        let path = self.poses_path()?;
        let mut solve = |pose: &Pose, progress: &ProgressBar| {
            let answer = solve(pose);
            progress.inc(1);
            answer
        };
        self.answer_all(robot, path, |poses, progress| {
            poses.iter().map(|pose| solve(pose, progress)).collect()
        })
    }

    fn answer_all<T: Row>(
        &self,
        robot: &Robot,
        path: &Path,
        mut solve: impl FnMut(&[Pose], &ProgressBar) -> Vec<Result<T, StaticsError>>,
    ) -> Result<Ending, ProgramError> {
        let PoseTable { poses, further } = pose_file(path, robot)?;
        questions::about_poses(robot, "--poses", &poses);
        let (columns, format) = (T::columns(robot).len(), self.printing.format());
        let mut ending = Ending::Well;
        let progress = progress(poses.len(), "poses");
        for (number, chunk) in poses.chunks(CHUNK).enumerate() {
            let answers = solve(chunk, &progress).into_iter().map(at_one).collect::<Result<Vec<_>, _>>()?;
            if number == 0 && format != Format::Json {
                print_names::<T>(robot, &further);
            }
            for answer in &answers {
                ending = ending.and(answer.as_ref().map_or(Ending::SomethingWrong, Row::ending));
            }
            let print = || {
                let given = |k: usize| -> Vec<(&str, &str)> {
                    let row = number * CHUNK + k;
                    further.iter().map(|(name, cells)| (name.as_str(), cells[row].as_str())).collect()
                };
                let mut rows = chunk.iter().zip(&answers).enumerate();
                rows.try_for_each(|(k, (pose, answer))| {
                    print_answer(format, pose, &given(k), answer, columns)
                })
            };
            progress.suspend(print)?;
        }
        progress.finish_and_clear();
        Ok(ending)
    }
}

/// Prints the answer at one of many poses; where the pose has no answer, `columns` cells stay empty.
fn print_answer<T: Row>(
    format: Format,
    pose: &Pose,
    given: &[(&str, &str)],
    answer: &Result<T, Failure>,
    columns: usize,
) -> Result<(), ProgramError> {
    match format {
        Format::Json => print_line(pose, given, answer.as_ref())?,
        Format::Text | Format::Csv => print_row(pose, given, answer.as_ref(), columns),
    }
    Ok(())
}

/// The answer at one of many poses. Free coordinates that are missing are missing at all of them.
fn at_one<T>(answer: Result<T, StaticsError>) -> Result<Result<T, Failure>, StaticsError> {
    match answer {
        Err(error @ StaticsError::FreeCoordinates { .. }) => Err(error),
        answer => Ok(answer.map_err(Failure::from)),
    }
}

fn heading(robot: &Robot, pose: &Pose) -> String {
    format!("{} at {}", shown(&robot.name), place(pose))
}

/// Prints that the platform falls before the whole load is on it: that is an answer.
pub(crate) fn print_fall(
    format: Format,
    robot: &Robot,
    pose: &Pose,
    error: StaticsError,
) -> Result<Ending, ProgramError> {
    let failure = Failure::from(error);
    match format {
        Format::Json => print_line::<()>(pose, &[], Err(&failure))?,
        Format::Text | Format::Csv => {
            print_sentence(&format!("{}: {}", heading(robot, pose), failure.message));
        }
    }
    Ok(Ending::SomethingWrong)
}

/// Prints the line of JSON of a pose.
fn print_line<T: Serialize>(
    pose: &Pose,
    given: &[(&str, &str)],
    answer: Result<&T, &Failure>,
) -> Result<(), ProgramError> {
    let given = given.iter().map(|(name, text)| (*name, cell_value(text))).collect();
    let line = Line { pose: pose_numbers(pose), given, answer: answer.ok(), error: answer.err() };
    println!("{}", questions::added_to(serde_json::to_string(&line)?)?);
    Ok(())
}

/// Prints the line of CSV of a pose; `columns` of them are empty where there is no answer.
fn print_row<T: Row>(pose: &Pose, given: &[(&str, &str)], answer: Result<&T, &Failure>, columns: usize) {
    let (status, found, reason) = match answer {
        Ok(answer) => {
            let (cells, remark) = (answer.cells(), answer.remark());
            let beyond = cells.iter().any(|cell| is_not_finite(cell)).then(|| NOT_FINITE.to_owned());
            let remarks = Some(remark).filter(|remark| !remark.is_empty()).into_iter().chain(beyond);
            ("held", cells, remarks.collect::<Vec<_>>().join("; "))
        }
        Err(Failure { kind, message, .. }) => (*kind, vec![String::new(); columns], message.clone()),
    };
    let pose = cells(&pose_numbers(pose));
    let given = given.iter().map(|(_, text)| (*text).to_owned());
    let row = pose.into_iter().chain(given).chain([status.to_owned()]).chain(found).chain([reason]);
    print_record(&row.collect::<Vec<_>>());
}

/// Prints the cases of a pose, names first.
fn print_cases(pose: &Pose, cases: Vec<Vec<String>>) {
    let names = std::iter::once(COLUMNS.map(str::to_owned).to_vec());
    let at = names.chain(std::iter::repeat(cells(&pose_numbers(pose))));
    cases.into_iter().zip(at).for_each(|(case, at)| print_record(&[at, case].concat()));
}

/// Prints the names of the columns.
fn print_names<T: Row>(robot: &Robot, further: &[(String, Vec<String>)]) {
    let own: Vec<String> =
        ["status".to_owned()].into_iter().chain(T::columns(robot)).chain(["reason".to_owned()]).collect();
    // A table may be the answer to another question.
    let given = |(name, _): &(String, Vec<String>)| match own.contains(name) {
        true => format!("given_{name}"),
        false => name.clone(),
    };
    let names = COLUMNS.iter().map(ToString::to_string).chain(further.iter().map(given));
    print_record(&names.chain(own.clone()).collect::<Vec<_>>());
}

/// The number or the text of a cell.
pub(crate) fn cell_value(text: &str) -> Value {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => number.into(),
        _ => text.into(),
    }
}

/// Names with numbers from 1, such as `tension_1_n`, of `count` values each.
pub(crate) fn numbered(name: &str, unit: &str, count: usize) -> impl Iterator<Item = String> {
    (1..=count).map(move |i| format!("{name}_{i}_{unit}"))
}

/// Cells of numbers, to the last bit.
pub(crate) fn cells<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> Vec<String> {
    numbers.into_iter().map(|number| format!("{number:?}")).collect()
}
