//! Lengths of all cables in a table: a set of them on each line.

use super::{POSITION, at, listed, named_poses, passed, rows};
use crate::program::error::ProgramError;
use cdpr_dynamics::simulate::WinchLengths;
use cdpr_robot::{Pose, Robot};
use cdpr_study::{Column, Dimension, InputKind, Table, TableError, read_bytes};
use std::path::Path;

const OPTION: &str = "--lengths";

/// Lengths of a table, where their searches start, and all of its columns.
pub(crate) struct LengthTable {
    /// Those of each line [m]; nothing where its cells are empty.
    pub(crate) lengths: Vec<Vec<f64>>,
    /// The poses of the table, if it has any.
    pub(crate) starts: Option<Vec<Pose>>,
    /// Names and cells, which the answer has, too.
    pub(crate) columns: Vec<(String, Vec<String>)>,
}

/// Lengths from a table, of all cables on each line: the columns `length_1_m` and so on, or that many plain
/// numbers. Poses of the table, as `inverse` prints them with its lengths, are starts.
pub(crate) fn length_file(path: &Path, robot: &Robot) -> Result<LengthTable, ProgramError> {
    let (what, cables) = ("the length of each cable", robot.cables.len());
    listed(OPTION, (path, read_bytes(path, InputKind::Poses)?), what, |table| {
        let Some(header) = table.header else {
            if table.columns.len() != cables {
                return Err(format!("{} columns: expected {cables}, {what} [m]", table.columns.len()));
            }
            let columns: Vec<_> = table.columns.iter().map(|column| (column, 1.0)).collect();
            let names = (1..=cables).map(|i| format!("length_{i}_m"));
            let cells = table.columns.iter().map(|column| passed(table, column).1);
            return Ok(LengthTable {
                lengths: rows(table, &columns, |row| Ok(row.to_vec()))?,
                starts: None,
                columns: names.zip(cells).collect(),
            });
        };
        let columns = length_columns(table, cables).map_err(|reason| at(header, &reason))?;
        let is_position = |name: &str| table.columns.iter().any(|column| column.quantity().0 == name);
        let normal = robot.plane.map(|plane| POSITION[plane.normal()]);
        let has_poses = POSITION.into_iter().all(|name| Some(name) == normal || is_position(name));
        let starts = has_poses.then(|| named_poses(table, header, robot)).transpose()?;
        Ok(LengthTable {
            lengths: all_or_none(table, &columns)?,
            starts: starts.map(|(poses, _)| poses),
            columns: table.columns.iter().map(|column| passed(table, column)).collect(),
        })
    })
}

/// The columns of the lengths with their factors to metres.
fn length_columns(table: &Table, cables: usize) -> Result<Vec<(&Column, f64)>, String> {
    let name_of = |column: &Column| -> Option<usize> {
        column.quantity().0.strip_prefix("length_").and_then(|number| number.parse().ok())
    };
    let expected = format!("expected the columns length_1_m to length_{cables}_m");
    if let Some(column) = table.columns.iter().find(|column| name_of(column).is_some_and(|i| i > cables)) {
        return Err(format!("column {}: {expected}, one for each cable of the robot", column.name));
    }
    let find = |i: usize| {
        let mut all = table.columns.iter().filter(|column| name_of(column) == Some(i));
        let column = all.next().ok_or_else(|| format!("no column length_{i}_m: {expected}"))?;
        if all.next().is_some() {
            return Err(format!("column {}: the length of cable {i} is there twice", column.name));
        }
        match column.quantity().1 {
            Some(unit) if unit.dimension == Dimension::Length => Ok((column, unit.factor)),
            _ => Err(format!("column {}: {expected}, or other units of length", column.name)),
        }
    };
    (1..=cables).map(find).collect()
}

/// The lengths of each line [m]. A line without any is one for which the inverse model had none.
fn all_or_none(table: &Table, columns: &[(&Column, f64)]) -> Result<Vec<Vec<f64>>, String> {
    let numbers = |(column, factor): &(&Column, f64)| {
        Ok(table.numbers(column)?.iter().map(|value| value * factor).collect::<Vec<_>>())
    };
    let numbers: Result<Vec<_>, TableError> = columns.iter().map(numbers).collect();
    let numbers = numbers.map_err(|error| error.to_string())?;
    let line = |row: usize| {
        let lengths: Vec<f64> = numbers.iter().map(|column| column[row]).collect();
        match lengths.iter().position(|length| length.is_nan()) {
            None => Ok(lengths),
            Some(_) if lengths.iter().all(|length| length.is_nan()) => Ok(Vec::new()),
            Some(i) => Err(table
                .cell_error(row, columns[i].0, "a length, or no length on the whole line")
                .to_string()),
        }
    };
    (0..table.rows()).map(line).collect()
}

/// Lengths over time from a table: the time `t_s`, and `length_1_m` and so on for each cable; other columns
/// are further ones.
pub(crate) fn winch_file(path: &Path, cables: usize) -> Result<WinchLengths, ProgramError> {
    let rows = listed(OPTION, (path, read_bytes(path, InputKind::Poses)?), "a time and lengths", |table| {
        let names = ["t_s".to_owned()].into_iter().chain((1..=cables).map(|i| format!("length_{i}_m")));
        let column = |name: String| {
            let found = table.column(&name).map(|column| (column, 1.0));
            found.ok_or_else(|| {
                format!("expected the columns t_s and length_1_m to length_{cables}_m, no {name}")
            })
        };
        let columns = names.map(column).collect::<Result<Vec<_>, _>>()?;
        rows(table, &columns, |row| Ok(row.to_vec()))
    })?;
    let times: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let rows: Vec<Vec<f64>> = rows.iter().map(|row| row[1..].to_vec()).collect();
    WinchLengths::new(&times, &rows).map_err(|error| {
        let reason = error.to_string();
        ProgramError::List { option: OPTION, path: path.to_owned(), reason }
    })
}
