//! Columns of a table and the cells that hold no number.

use crate::error::StudyError;
use crate::table::{Blank, Cells, Table, TableError};
use cdpr_sensitivity::SensitivityError;
use serde::Serialize;
use std::collections::HashSet;
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

/// A column of numbers, or of words.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenColumn {
    /// Its name.
    pub name: String,
    /// Its numbers, or those of its words among the labels; NaN where a cell has none.
    pub values: Vec<f64>,
    /// Its different words in alphabetical order; none for numbers.
    pub labels: Vec<String>,
}

impl GivenColumn {
    fn of_words(name: String, words: &[String]) -> Self {
        let mut labels: Vec<String> = words.iter().filter(|word| !word.is_empty()).cloned().collect();
        labels.sort_unstable();
        labels.dedup();
        let code = |word: &String| labels.binary_search(word).map_or(f64::NAN, |code| code as f64);
        Self { name, values: words.iter().map(code).collect(), labels }
    }

    /// Whether it has words instead of numbers.
    pub fn is_words(&self) -> bool {
        !self.labels.is_empty()
    }
}

/// A table of named columns.
#[derive(Clone, Debug)]
pub struct GivenTable {
    /// The file.
    pub path: PathBuf,
    /// Number of rows.
    pub rows: usize,
    /// Columns of numbers and of words.
    pub columns: Vec<GivenColumn>,
    /// Names of the columns without any value.
    pub empty: Vec<String>,
    /// The cells without a finite number in the columns of numbers, by row.
    pub bad: Vec<BadCell>,
    /// Columns with a cell that cannot be read, and what is wrong with it.
    pub(super) unread: Vec<(String, TableError)>,
    /// Columns of words with numbers among them, and what they have.
    pub(super) mixed: Vec<(String, String)>,
}

/// Columns that number the rows.
const INDEX: [&str; 2] = ["index", "row"];

/// Beginning of the columns of inputs in tables of studies.
const DEVIATION: &str = "d_";

impl GivenTable {
    /// Makes a table of what a file has.
    pub(super) fn of(path: &Path, table: Table) -> Self {
        let rows = table.rows();
        let mut given = Self {
            path: path.to_owned(),
            rows,
            columns: vec![],
            empty: vec![],
            bad: vec![],
            unread: vec![],
            mixed: vec![],
        };
        for column in table.columns {
            if let Some([number, word]) = column.number_and_word().filter(|_| column.cells().is_ok()) {
                let at = |row: usize| format!("line {} has `{}`", table.lines[row], column.text(row));
                given.mixed.push((column.name.clone(), format!("{} and {}", at(word), at(number))));
            }
            match column.cells() {
                Err(error) => given.unread.push((column.name, error)),
                Ok(Cells::Numbers(values)) if column.blanks.len() < rows => {
                    let bad = |blank: &Blank| BadCell {
                        row: blank.row + 1,
                        column: column.name.clone(),
                        text: blank.text.clone(),
                    };
                    given.bad.extend(column.blanks.iter().map(bad));
                    let (name, values) = (column.name.clone(), values.clone());
                    given.columns.push(GivenColumn { name, values, labels: vec![] });
                }
                Ok(Cells::Text(words)) if words.iter().any(|word| !word.is_empty()) => {
                    given.columns.push(GivenColumn::of_words(column.name.clone(), words));
                }
                Ok(_) => given.empty.push(column.name),
            }
        }
        given.bad.sort_by_key(|cell| cell.row);
        given
    }

    /// The error of the first column that could not be read and that `wanted` is true of.
    pub(super) fn readable(&self, wanted: impl Fn(&str) -> bool) -> Result<(), StudyError> {
        match self.unread.iter().find(|(name, _)| wanted(name)) {
            Some((_, error)) => Err(StudyError::Table { path: self.path.clone(), source: error.clone() }),
            None => Ok(()),
        }
    }

    /// Numbers of the columns of these names; `NAME*` stands for all that begin so. Words do for inputs only.
    pub(super) fn named(&self, field: &str, names: &[String]) -> Result<Vec<usize>, StudyError> {
        let takes_words = field == "input";
        let fits = |column: &GivenColumn| takes_words || !column.is_words();
        let mut found = Vec::new();
        for name in names {
            let matches = |column: &str| match name.strip_suffix('*') {
                Some(start) => column.starts_with(start),
                None => column == name,
            };
            self.readable(matches)?;
            let before = found.len();
            let columns = self.columns.iter().enumerate();
            found.extend(columns.filter(|(_, of)| matches(&of.name) && fits(of)).map(|(i, _)| i));
            if found.len() == before {
                let kind = if takes_words { "a column with values" } else { "a column of numbers" };
                let expected = format!("{kind}, one of {}", self.shown_names(fits));
                return Err(self.invalid(field, name, &expected));
            }
        }
        let mut seen = HashSet::new();
        found.retain(|column| seen.insert(*column));
        Ok(found)
    }

    /// The inputs, if none is named: the columns `d_..` of a table of a study, otherwise all that are no
    /// output. Words are inputs if most of them occur several times where an output has a value, whichever
    /// output: a status, a name or a date is not an input.
    pub(super) fn usual_inputs(&self, outputs: &[usize]) -> Vec<usize> {
        let deviations = self.deviations();
        let varies_with = |column: &GivenColumn, output: usize| {
            let values = &self.columns[output].values;
            let observed =
                (0..self.rows).filter(|&row| !values[row].is_nan() && !column.values[row].is_nan());
            let mut codes: Vec<u64> = observed.map(|row| column.values[row].to_bits()).collect();
            let count = codes.len();
            codes.sort_unstable();
            codes.dedup();
            codes.len() > 1 && 2 * codes.len() <= count
        };
        let is_input = |column: &GivenColumn| {
            !column.is_words() || outputs.iter().all(|&output| varies_with(column, output))
        };
        let candidates = if deviations.is_empty() {
            let is_index = |of: &GivenColumn| INDEX.contains(&of.name.as_str());
            let columns = self.columns.iter().enumerate();
            columns.filter(|(_, of)| !is_index(of) && is_input(of)).map(|(i, _)| i).collect()
        } else {
            deviations
        };
        candidates.into_iter().filter(|column| !outputs.contains(column)).collect()
    }

    /// The output, if none is named: the last column of numbers that is no input of a study.
    pub(super) fn usual_output(&self) -> Option<usize> {
        let deviations = self.deviations();
        (0..self.columns.len())
            .rev()
            .find(|column| !deviations.contains(column) && !self.columns[*column].is_words())
    }

    /// Inputs that nobody named and whose names are those of outputs: `y1` where the output is `y2`, or
    /// `magnitude_mm`.
    /// The deviations of a study are inputs, such as `d_a1.y`.
    pub(super) fn like_outputs(&self, inputs: &[usize], output: usize) -> Vec<String> {
        const WORDS: [&str; 15] = [
            "y",
            "out",
            "output",
            "result",
            "response",
            "target",
            "objective",
            "magnitude",
            "rms",
            "error",
            "deflection",
            "displacement",
            "cost",
            "loss",
            "stress",
        ];
        let stem = |column: usize| self.columns[column].name.trim_end_matches(|c: char| c.is_ascii_digit());
        let alike = |&&input: &&usize| stem(input) == stem(output);
        // Columns of one stem throughout have no names to judge by.
        let by_stem = 2 * inputs.iter().filter(alike).count() <= inputs.len();
        let by_word = |&&input: &&usize| {
            let name = self.columns[input].name.to_lowercase();
            name.split(|c: char| !c.is_alphabetic()).any(|word| WORDS.contains(&word))
        };
        let like = |input: &&usize| {
            let is_deviation = self.columns[**input].name.starts_with(DEVIATION);
            !is_deviation && (by_stem && alike(input) || by_word(input))
        };
        inputs.iter().filter(like).map(|&input| self.columns[input].name.clone()).collect()
    }

    fn deviations(&self) -> Vec<usize> {
        let columns = self.columns.iter().enumerate();
        columns.filter(|(_, of)| of.name.starts_with(DEVIATION) && !of.is_words()).map(|(i, _)| i).collect()
    }

    fn shown_names(&self, fits: impl Fn(&GivenColumn) -> bool) -> String {
        const MOST: usize = 20;
        let names: Vec<&str> =
            self.columns.iter().filter(|column| fits(column)).map(|column| column.name.as_str()).collect();
        match names.len().checked_sub(MOST) {
            Some(more) if more > 0 => format!("{} and {more} more", names[..MOST].join(", ")),
            _ => names.join(", "),
        }
    }

    /// The error of statistics of a column.
    pub(super) fn statistics(&self, field: &str, source: SensitivityError) -> StudyError {
        StudyError::Statistics { path: self.path.clone(), field: field.to_owned(), source }
    }

    pub(super) fn invalid(&self, field: &str, value: &str, expected: &str) -> StudyError {
        StudyError::invalid(&self.path, field, value, expected)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn given(text: &str) -> GivenTable {
        GivenTable::of("table.csv".as_ref(), Table::read(text.as_bytes()).unwrap())
    }

    #[test]
    fn cells_without_a_number_are_named_and_columns_of_words_too() {
        let found = given("x,y,status\n1,nan,failed\n2,3,ok\n,4,ok\n");
        let status = &found.columns[2];
        assert_eq!(
            (&status.labels[..], &status.values[..]),
            (&["failed".into(), "ok".into()][..], &[0.0, 1.0, 1.0][..])
        );
        assert_eq!(found.usual_inputs(&[1]), [0], "a status is no input");
        let bad: Vec<_> = found.bad.iter().map(|cell| (cell.row, cell.column.as_str())).collect();
        assert_eq!(bad, [(1, "y"), (3, "x")]);
        assert_eq!(found.bad[0].text, "nan");
    }

    #[test]
    fn a_status_of_rows_in_which_one_of_several_outputs_failed_is_no_input() {
        let rows = "1,2,nan,failed\n2,3,4,ok\n3,1,5,ok\n4,7,nan,failed\n5,6,1,ok\n6,5,2,ok\n";
        let found = given(&format!("x,force,y,status\n{rows}"));
        assert_eq!(found.usual_inputs(&[1, 2]), [0], "force has a value in failed rows, too");
        let apart = "1,2,,a\n2,3,,b\n3,1,,a\n4,7,,b\n5,,1,a\n6,,2,b\n7,,3,a\n8,,4,b\n";
        let found = given(&format!("x,force,y,material\n{apart}"));
        assert_eq!(found.usual_inputs(&[1, 2]), [0, 3], "a material of each output is an input");
    }

    #[test]
    fn words_are_inputs_and_columns_named_as_outputs_are_asked_for() {
        let found = given("mat,x,y1,y2\na,1,2,3\nb,2,3,4\na,3,4,5\nb,4,5,6\n");
        assert_eq!((found.usual_output(), found.usual_inputs(&[3])), (Some(3), vec![0, 1, 2]));
        assert_eq!(found.like_outputs(&[0, 1, 2], 3), ["y1"]);
        let plain = given("x1,x2,x3,x4\n1,2,3,4\n");
        assert!(plain.like_outputs(&[0, 1, 2], 3).is_empty());
    }

    #[test]
    fn a_column_that_cannot_be_read_is_an_error_for_those_who_ask_for_it() {
        let found = given("x,y\n1,2\n3,four\n4,5\n");
        assert!(found.named("input", &["x".to_owned()]).is_ok());
        let error = found.named("output", &["y".to_owned()]).unwrap_err().to_string();
        assert!(error.starts_with("table.csv: line 3, column y: `four`: expected a number"), "{error}");
        assert!(found.readable(|_| true).is_err());
    }
}
