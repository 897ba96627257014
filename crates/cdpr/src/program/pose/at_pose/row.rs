//! An answer at a pose as a row of a table or a line of JSON; why a pose has none.

use crate::program::answer::OutOfLimits;
use crate::program::arguments::poses::{COLUMNS, pose_numbers};
use crate::program::arguments::{Format, print_record};
use crate::program::error::ProgramError;
use crate::program::output::Ending;
use crate::program::questions;
use cdpr_robot::{Pose, Robot};
use cdpr_statics::StaticsError;
use cdpr_study::is_not_finite;
use indexmap::IndexMap;
use serde::Serialize;
use serde_json::Value;

/// Why a cell is empty at a pose that has an answer.
const NOT_FINITE: &str = "numbers that are too large for the computer are left out";

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

    /// Its most telling numbers, for the sentence and the short table of many poses.
    fn brief(&self) -> Vec<Brief>;

    /// Whether the lengths may jump here.
    fn jumps(&self) -> bool {
        false
    }

    /// What is wrong with it, behind a count of poses, where its ending says that something is.
    fn wrong(&self) -> String {
        "with a tension beyond its limits".to_owned()
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

/// A number of an answer, for the table of many poses and their sentence.
pub(crate) enum Brief {
    /// Least and greatest tension of all cables [N]; what comes before them in the sentence.
    Tensions(&'static str, [f64; 2]),
    /// Name, unit and value of what is to be small, and of what is to be great.
    Most(&'static str, &'static str, Option<f64>),
    Least(&'static str, &'static str, Option<f64>),
    /// The same of what the table alone has.
    Shown(&'static str, &'static str, Option<f64>),
}

impl Brief {
    /// The tensions of all cables [N].
    pub(crate) fn tensions(words: &'static str, all: &[f64]) -> Self {
        let least = all.iter().copied().fold(f64::INFINITY, f64::min);
        Self::Tensions(words, [least, all.iter().copied().fold(0.0, f64::max)])
    }

    pub(super) fn headers(&self) -> Vec<String> {
        match self {
            Self::Tensions(..) => vec!["least tension [N]".to_owned(), "greatest [N]".to_owned()],
            Self::Most(name, unit, _) | Self::Least(name, unit, _) | Self::Shown(name, unit, _) => {
                vec![format!("{name} [{unit}]")]
            }
        }
    }

    pub(super) fn values(&self) -> Vec<Option<f64>> {
        match self {
            Self::Tensions(_, ends) => ends.map(Some).to_vec(),
            Self::Most(_, _, value) | Self::Least(_, _, value) | Self::Shown(_, _, value) => vec![*value],
        }
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

/// Prints the answer at one of many poses; where the pose has no answer, `columns` cells stay empty.
pub(super) fn print_answer<T: Row>(
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
pub(super) fn at_one<T>(answer: Result<T, StaticsError>) -> Result<Result<T, Failure>, StaticsError> {
    match answer {
        Err(error @ StaticsError::FreeCoordinates { .. }) => Err(error),
        answer => Ok(answer.map_err(Failure::from)),
    }
}

/// Prints the line of JSON of a pose.
pub(super) fn print_line<T: Serialize>(
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
pub(super) fn print_row<T: Row>(
    pose: &Pose,
    given: &[(&str, &str)],
    answer: Result<&T, &Failure>,
    columns: usize,
) {
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
pub(super) fn print_cases(pose: &Pose, cases: Vec<Vec<String>>) {
    let names = std::iter::once(COLUMNS.map(str::to_owned).to_vec());
    let at = names.chain(std::iter::repeat(cells(&pose_numbers(pose))));
    cases.into_iter().zip(at).for_each(|(case, at)| print_record(&[at, case].concat()));
}

/// Prints the names of the columns.
pub(super) fn print_names<T: Row>(robot: &Robot, further: &[(String, Vec<String>)]) {
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
