//! Columns of a table and the cells that hold no number.

use crate::error::StudyError;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// A cell that holds no finite number where one is needed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct BadCell {
    /// Row, from 1; the line of a header does not count.
    pub row: usize,
    /// Name of the column.
    pub column: String,
    /// Text of the cell.
    pub text: String,
}

/// A table of named columns. Columns without any number, such as a status, are left out.
#[derive(Clone, Debug)]
pub struct GivenTable {
    /// The file.
    pub path: PathBuf,
    /// Number of rows.
    pub rows: usize,
    /// Columns of numbers; a cell without a finite number is NaN.
    pub columns: Vec<(String, Vec<f64>)>,
    /// Names of the columns without numbers.
    pub texts: Vec<String>,
    /// The cells without a finite number in the columns of numbers, by row.
    pub bad: Vec<BadCell>,
}

/// Columns that number the rows.
const INDEX: [&str; 2] = ["index", "row"];

/// Beginning of the columns of inputs in tables of studies.
const DEVIATION: &str = "d_";

impl GivenTable {
    /// Makes a table of columns of texts.
    pub(super) fn of_texts(
        path: &Path,
        names: Vec<String>,
        cells: &[Vec<String>],
    ) -> Result<Self, StudyError> {
        let rows = cells.first().map_or(0, Vec::len);
        let number = |text: &String| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let columns = names.into_iter().zip(cells).map(|(name, texts)| {
            let values = texts.iter().map(|text| number(text).unwrap_or(f64::NAN)).collect();
            (name, values, |row: usize| texts[row].clone())
        });
        Self::of_columns(path, rows, columns.collect::<Vec<_>>())
    }

    /// Makes a table of columns, each with its values, NaN without a number, and the texts of its cells.
    pub(super) fn of_columns(
        path: &Path,
        rows: usize,
        columns: Vec<(String, Vec<f64>, impl Fn(usize) -> String)>,
    ) -> Result<Self, StudyError> {
        let mut table = Self { path: path.to_owned(), rows, columns: vec![], texts: vec![], bad: vec![] };
        for (number, (name, values, text)) in columns.into_iter().enumerate() {
            let name = if name.is_empty() { format!("column{}", number + 1) } else { name };
            if table.columns.iter().any(|(known, _)| *known == name) || table.texts.contains(&name) {
                return Err(table.invalid("header", &name, "a different name for each column"));
            }
            if values.iter().all(|value| value.is_nan()) {
                table.texts.push(name);
                continue;
            }
            let bad = values.iter().enumerate().filter(|(_, value)| value.is_nan());
            table.bad.extend(bad.map(|(row, _)| BadCell {
                row: row + 1,
                column: name.clone(),
                text: text(row),
            }));
            table.columns.push((name, values));
        }
        table.bad.sort_by_key(|cell| cell.row);
        Ok(table)
    }

    /// Numbers of the columns of these names; `NAME*` stands for all that begin so.
    pub(super) fn named(&self, field: &str, names: &[String]) -> Result<Vec<usize>, StudyError> {
        let mut found = Vec::new();
        for name in names {
            let matches = |column: &str| match name.strip_suffix('*') {
                Some(start) => column.starts_with(start),
                None => column == name,
            };
            let before = found.len();
            found.extend((0..self.columns.len()).filter(|&i| matches(&self.columns[i].0)));
            if found.len() == before {
                let expected = format!("a column of numbers, one of {}", self.shown_names());
                return Err(self.invalid(field, name, &expected));
            }
        }
        let mut seen = Vec::new();
        found.retain(|column| {
            !seen.contains(column) && {
                seen.push(*column);
                true
            }
        });
        Ok(found)
    }

    /// The inputs, if none is named: the columns `d_..` of a table of a study, otherwise all that are no
    /// output.
    pub(super) fn usual_inputs(&self, outputs: &[usize]) -> Vec<usize> {
        let deviations = self.deviations();
        let candidates = if deviations.is_empty() {
            (0..self.columns.len()).filter(|&i| !INDEX.contains(&self.columns[i].0.as_str())).collect()
        } else {
            deviations
        };
        candidates.into_iter().filter(|column| !outputs.contains(column)).collect()
    }

    /// The output, if none is named: the last column of numbers that is no input of a study.
    pub(super) fn usual_output(&self) -> Option<usize> {
        let deviations = self.deviations();
        (0..self.columns.len()).rev().find(|column| !deviations.contains(column))
    }

    fn deviations(&self) -> Vec<usize> {
        (0..self.columns.len()).filter(|&i| self.columns[i].0.starts_with(DEVIATION)).collect()
    }

    fn shown_names(&self) -> String {
        const MOST: usize = 20;
        let names: Vec<&str> = self.columns.iter().map(|(name, _)| name.as_str()).collect();
        match names.len().checked_sub(MOST) {
            Some(more) if more > 0 => format!("{} and {more} more", names[..MOST].join(", ")),
            _ => names.join(", "),
        }
    }

    pub(super) fn invalid(&self, field: &str, value: &str, expected: &str) -> StudyError {
        invalid(&self.path, field, value, expected)
    }
}

pub(super) fn invalid(path: &Path, field: &str, value: &str, expected: &str) -> StudyError {
    StudyError::Invalid {
        path: path.to_owned(),
        field: field.to_owned(),
        value: value.to_owned(),
        expected: expected.to_owned(),
    }
}
