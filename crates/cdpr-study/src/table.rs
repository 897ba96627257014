//! The one reader of tables: bytes to named columns of numbers or texts.
//!
//! It takes what spreadsheets and scripts write: `,` `;` tabs or blanks between cells, a first line `sep=;`,
//! decimal commas, quotes, comments with `#`, UTF-8, UTF-16 and Latin-1, names or none. It drops nothing: a
//! cell that is no number among numbers, or one that can be read in two ways, is an error that names line,
//! column and cell.

mod cell;
mod column;
mod error;
mod lines;
mod text;
mod unit;

pub use column::{Blank, Cells, Column};
pub use error::TableError;
pub use unit::{Dimension, Unit};

use cell::{Marks, Reading, reading};
use csv::StringRecord;
use lines::Line;
use std::collections::HashSet;

/// A table: columns of equal length, and the line of each row.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The columns.
    pub columns: Vec<Column>,
    /// The line of each row in the text, from 1.
    pub lines: Vec<usize>,
    /// The line of the names, if there is one. Columns without a name are `column1`, `column2` ...
    pub header: Option<usize>,
}

impl Table {
    /// Reads a table.
    ///
    /// # Errors
    /// [`TableError`] for bytes that are no text, lines of different widths and equal names. What is wrong
    /// with the cells of a column, only those hear who ask for it, [`Column::cells`].
    pub fn read(bytes: &[u8]) -> Result<Self, TableError> {
        let all = lines::split(&text::decoded(bytes)?)?;
        let width = all.first().map_or(0, |line| line.cells.len());
        let names = has_names(&all);
        let (header, rows) = all.split_at(usize::from(names));
        let header = header.first();
        let name = |k: usize| {
            let own = header.map_or("", |line| line.cells[k].trim()).replace(lines::KEPT, " ");
            if own.is_empty() { format!("column{}", k + 1) } else { own }
        };
        // An end of each line with a separator, as of spreadsheets, makes no column.
        let is_void = |k: usize| all.iter().all(|line| line.cells[k].trim().is_empty());
        let width = if width > 1 && is_void(width - 1) { width - 1 } else { width };
        let names: Vec<String> = (0..width).map(name).collect();
        let mut seen = HashSet::new();
        if let Some(name) = names.iter().find(|name| !seen.insert(name.as_str())) {
            let line = header.map_or(1, |line| line.number);
            return Err(TableError::Twice { line, name: name.clone() });
        }
        let lines: Vec<usize> = rows.iter().map(|line| line.number).collect();
        let cells = rows.iter().flat_map(|line| line.cells.iter());
        let marks = cells.fold(Marks::default(), Marks::with);
        let column = |(k, name): (usize, String)| {
            let cells: Vec<&str> = rows.iter().map(|line| &line.cells[k]).collect();
            Column::of(name, &cells, &lines, marks)
        };
        let columns = names.into_iter().enumerate().map(column).collect();
        Ok(Self { columns, header: header.map(|line| line.number), lines })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.lines.len()
    }

    /// The column of a name: exactly so, or else with other capitals.
    pub fn column(&self, name: &str) -> Option<&Column> {
        let exact = self.columns.iter().find(|column| column.name == name);
        exact.or_else(|| self.columns.iter().find(|column| column.name.eq_ignore_ascii_case(name)))
    }

    /// The numbers of a column, NaN in blank cells.
    ///
    /// # Errors
    /// As [`Column::cells`]; [`TableError::Cell`] for the first word of a column of texts.
    pub fn numbers<'a>(&self, column: &'a Column) -> Result<&'a [f64], TableError> {
        match column.cells()? {
            Cells::Numbers(values) => Ok(values),
            Cells::Text(texts) => {
                let word = texts.iter().position(|text| reading(text) == Reading::Word);
                Err(self.cell_error(word.unwrap_or_default(), column, "a number"))
            }
        }
    }

    /// The numbers of a column without blank cells.
    ///
    /// # Errors
    /// As [`Table::numbers`]; [`TableError::Cell`] for the first blank cell.
    pub fn finite<'a>(&self, column: &'a Column) -> Result<&'a [f64], TableError> {
        let values = self.numbers(column)?;
        match column.blanks.first() {
            Some(blank) => Err(self.cell_error(blank.row, column, "a finite number")),
            None => Ok(values),
        }
    }

    /// The error of a cell that is not what its reader needs.
    pub fn cell_error(&self, row: usize, column: &Column, expected: &str) -> TableError {
        TableError::Cell {
            line: self.lines.get(row).copied().unwrap_or_default(),
            column: column.name.clone(),
            cell: column.text(row),
            expected: expected.to_owned(),
        }
    }
}

/// Whether the first line has the names: no number is in it, or a word that stands above a number.
fn has_names(lines: &[Line]) -> bool {
    let Some((first, rest)) = lines.split_first() else { return false };
    let is_number = |cell: &str| matches!(reading(cell), Reading::Number { .. });
    let is_word = |cell: &str| !cell.trim().is_empty() && !is_number(cell);
    if first.cells.iter().all(|cell| !is_number(cell)) {
        return first.cells.iter().any(is_word);
    }
    let different = |cells: &StringRecord| cells.iter().collect::<HashSet<_>>().len() == cells.len();
    let above = |(k, cell): (usize, &str)| {
        let below = rest.iter().map(|line| &line.cells[k]).find(|cell| !cell.trim().is_empty());
        is_word(cell) && below.is_some_and(is_number)
    };
    different(&first.cells) && first.cells.iter().enumerate().any(above)
}

#[cfg(test)]
mod tests;
