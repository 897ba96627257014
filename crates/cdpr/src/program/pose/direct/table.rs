//! A table of lengths: where the platform rests for each of its lines.

use super::answer::{Answer, How, Proof, solve};
use super::case::Case;
use crate::program::answer::OutOfLimits;
use crate::program::arguments::poses::{self, pose_numbers};
use crate::program::arguments::{Format, print_record};
use crate::program::error::ProgramError;
use crate::program::lists::{LengthTable, length_file};
use crate::program::output::{Ending, progress};
use crate::program::pose::at_pose::{Failure, cell_value, cells, numbered};
use crate::program::questions;
use cdpr_robot::{Doubt, Doubts, Robot, plausible};
use cdpr_statics::StaticsError;
use indexmap::IndexMap;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::Value;
use std::path::Path;

/// Lines that are answered before they are printed.
const CHUNK: usize = 1024;

/// A line of JSON.
#[derive(Serialize)]
struct Line<'a> {
    /// Columns of the table.
    given: IndexMap<&'a str, Value>,
    lengths: &'a [f64],
    #[serde(flatten)]
    answer: Option<&'a Answer>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a Failure>,
}

/// A table with its answers.
struct Rows<'a> {
    robot: &'a Robot,
    how: How,
    table: LengthTable,
}

/// Answers each line of the table of a robot, with what all lines have in common.
pub(super) fn run(
    format: Format,
    (robot, path): (&Robot, &Path),
    common: &Case,
    how: How,
) -> Result<Ending, ProgramError> {
    let rows = Rows { robot, how, table: length_file(path, robot)? };
    let LengthTable { lengths, starts, .. } = &rows.table;
    if starts.is_some() && common.pose.is_some() {
        let why = "--pose: the table has poses, at which its searches start: expected one of them";
        return Err(ProgramError::Usage(why.to_owned()));
    }
    common.question(robot);
    if let Some(starts) = starts {
        questions::about_poses(robot, "the table", starts);
    }
    ask_first("line", lengths.iter().map(|lengths| plausible::lengths(robot, lengths).into_iter().collect()));
    let bar = progress(lengths.len(), "rows");
    let (mut ending, mut doubts) = (Ending::Well, Vec::new());
    for (number, chunk) in lengths.chunks(CHUNK).enumerate() {
        let answer = |(k, lengths): (usize, &Vec<f64>)| {
            let row = number * CHUNK + k;
            let mut case = common.with_lengths(lengths.clone());
            if let Some(starts) = starts {
                case.pose = Some(pose_numbers(&starts[row]).to_vec());
            }
            let mut doubts = Doubts::new();
            let name = format!("the equilibrium of row {}", row + 1);
            let answer = match lengths.is_empty() {
                true => Err(no_lengths()),
                false => solve(robot, &case, &name, rows.how, &mut doubts),
            };
            bar.inc(1);
            (answer.map_err(Failure::from), doubts)
        };
        let found: Vec<_> = chunk.par_iter().enumerate().map(answer).collect();
        let (answers, new): (Vec<_>, Vec<Doubts>) = found.into_iter().unzip();
        doubts.extend(new);
        for answer in &answers {
            ending = ending.and(answer.as_ref().map_or(Ending::SomethingWrong, Answer::ending));
        }
        bar.suspend(|| rows.print(format, number * CHUNK, &answers))?;
    }
    bar.finish_and_clear();
    ask_first("row", doubts.into_iter());
    Ok(ending)
}

/// Of a line whose cells are empty.
fn no_lengths() -> StaticsError {
    StaticsError::Invalid {
        field: "lengths".to_owned(),
        value: "missing".to_owned(),
        expected: "a length of each cable [m]".to_owned(),
    }
}

/// Asks about the first doubtful row of a table, and says how many are.
fn ask_first(what: &str, doubts: impl Iterator<Item = Doubts>) {
    let mut doubts = doubts.enumerate().filter_map(|(row, doubts)| Some((row, doubts.into_iter().next()?)));
    let Some((row, doubt)) = doubts.next() else { return };
    let others = match doubts.count() {
        0 => String::new(),
        more => format!(", and there are {more} more of these"),
    };
    let quantity = match doubt.quantity.contains("row") {
        true => doubt.quantity.clone(),
        false => format!("{} of {what} {}", doubt.quantity, row + 1),
    };
    questions::ask([Doubt { quantity, value: format!("{}{others}", doubt.value), ..doubt }]);
}

impl Rows<'_> {
    /// Prints the answers of the rows from `first` on, below the names before the first of all.
    fn print(
        &self,
        format: Format,
        first: usize,
        answers: &[Result<Answer, Failure>],
    ) -> Result<(), ProgramError> {
        if first == 0 && format != Format::Json {
            print_record(&self.names());
        }
        for (row, answer) in (first..).zip(answers) {
            if format == Format::Json {
                let given = self.table.columns.iter();
                let line = Line {
                    given: given.map(|(name, cells)| (name.as_str(), cell_value(&cells[row]))).collect(),
                    lengths: &self.table.lengths[row],
                    answer: answer.as_ref().ok(),
                    error: answer.as_ref().err(),
                };
                println!("{}", questions::added_to(serde_json::to_string(&line)?)?);
            } else {
                print_record(&self.cells(row, answer));
            }
        }
        Ok(())
    }

    /// Names of the columns: the pose that is found, those of the table, and the answer.
    fn names(&self) -> Vec<String> {
        let answer = self.own_names();
        let given = self.table.columns.iter().map(|(name, _)| {
            let is_taken = poses::COLUMNS.contains(&name.as_str()) || answer.contains(name);
            if is_taken { format!("given_{name}") } else { name.clone() }
        });
        poses::COLUMNS.iter().map(ToString::to_string).chain(given).chain(answer.clone()).collect()
    }

    fn own_names(&self) -> Vec<String> {
        let cables = self.robot.cables.len();
        let tensions = ["tension", "exit_tension"].into_iter().flat_map(|name| numbered(name, "n", cables));
        let proof =
            if self.how.certify { &["certificate_position_m", "certificate_rotation_rad"][..] } else { &[] };
        let others = if self.how.starts.is_some() { &["others"][..] } else { &[] };
        let more = ["stable", "least_stiffness_n_per_m"].iter().chain(proof).chain(others).chain(&["reason"]);
        ["status".to_owned()].into_iter().chain(tensions).chain(more.map(ToString::to_string)).collect()
    }

    fn cells(&self, row: usize, answer: &Result<Answer, Failure>) -> Vec<String> {
        let given = self.table.columns.iter().map(|(_, cells)| cells[row].clone());
        let columns = self.own_names().len();
        let (pose, own) = match answer {
            Ok(answer) => (cells(&pose_numbers(&answer.found.pose)), self.found(answer)),
            Err(Failure { kind, message, .. }) => {
                let blank = std::iter::repeat_n(String::new(), columns - 2);
                let own = [(*kind).to_owned()].into_iter().chain(blank).chain([message.clone()]);
                (vec![String::new(); poses::COLUMNS.len()], own.collect())
            }
        };
        pose.into_iter().chain(given).chain(own).collect()
    }

    /// The cells of an answer behind its pose.
    fn found(&self, answer: &Answer) -> Vec<String> {
        let found = &answer.found;
        let mut own = vec!["held".to_owned()];
        own.extend(cells(found.tensions.iter().chain(&found.exit_tensions)));
        own.extend([found.is_stable().to_string(), format!("{:?}", found.least_stiffness())]);
        let mut remarks: Vec<String> = Vec::new();
        if self.how.certify {
            match &answer.certificate {
                Some(Proof::Given { position, rotation, .. }) => own.extend(cells([position, rotation])),
                Some(Proof::None { error }) => {
                    own.extend([String::new(), String::new()]);
                    remarks.push(error.message.clone());
                }
                None => own.extend([String::new(), String::new()]),
            }
        }
        if self.how.starts.is_some() {
            own.push(answer.others.as_ref().map_or(0, Vec::len).to_string());
        }
        if !found.out_of_limits.is_empty() {
            remarks.push(OutOfLimits::cell(&found.out_of_limits));
        }
        own.push(remarks.join("; "));
        own
    }
}
