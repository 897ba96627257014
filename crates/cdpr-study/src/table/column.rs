//! A column: all numbers, or all texts, or an error.

use crate::table::cell::{Marks, Reading, reading, with_comma, with_unit};
use crate::table::error::TableError;
use crate::table::unit::{Dimension, Unit, plain, split};

/// The cells of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Finite numbers; NaN where a cell is blank, [`Column::blanks`].
    Numbers(Vec<f64>),
    /// Texts, as they stand there, without blanks around them.
    Text(Vec<String>),
}

/// A cell of a column of numbers that is empty or says that there is no finite one (`nan`, `NA`, `inf`).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Blank {
    /// Its row, from 0.
    pub row: usize,
    /// Its text.
    pub text: String,
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name, as it stands there.
    pub name: String,
    /// The cells without a number, if it has numbers.
    pub blanks: Vec<Blank>,
    cells: Cells,
    flaw: Option<TableError>,
}

impl Column {
    /// The column of these texts, whose lines and whose table's decimal marks are known.
    pub(super) fn of(name: String, texts: &[&str], lines: &[usize], table: Marks) -> Self {
        let readings: Vec<Reading> = texts.iter().map(|text| reading(text)).collect();
        let own = texts.iter().fold(Marks::default(), |marks, text| marks.with(text));
        let commas_are_decimal = own.comma || table.comma && !table.point;
        let is_flaw = |reading: &Reading| match reading {
            Reading::Number { mark, .. } => *mark == Some(',') && own.point,
            Reading::Unclear => !commas_are_decimal || own.point,
            Reading::Thousands | Reading::Word => true,
            Reading::Blank => false,
        };
        let words = readings.iter().filter(|reading| **reading == Reading::Word).count();
        let blank = readings.iter().filter(|reading| **reading == Reading::Blank).count();
        let numbers = readings.len() - words - blank;
        // A column of `3.2 mm` has numbers.
        let with_units = texts.iter().filter(|text| with_unit(text).is_some()).count();
        if words > 0 && numbers + with_units <= words - with_units {
            return Self::of_texts(name, texts.iter().map(|text| text.trim().to_owned()).collect());
        }
        if let Some(row) = readings.iter().position(is_flaw) {
            let texts: Vec<String> = texts.iter().map(|text| text.trim().to_owned()).collect();
            let cell = texts[row].clone();
            let expected = match with_unit(&cell) {
                Some((value, unit)) => {
                    let right = format!("{value}, and the unit in the name of the column: {name} [{unit}]");
                    let is_other = |text: &String| with_unit(text).is_some_and(|(_, other)| other != unit);
                    match texts.iter().position(is_other) {
                        Some(other) => {
                            let (line, cell) = (lines[other], &texts[other]);
                            format!("{right}; line {line} has another unit, `{cell}`: all cells in one unit")
                        }
                        None => right,
                    }
                }
                None => expected(&readings[row], &cell, own),
            };
            let flaw = Some(TableError::Cell { line: lines[row], column: name.clone(), cell, expected });
            return Self { flaw, ..Self::of_texts(name, texts) };
        }
        let value = |(reading, text): (&Reading, &&str)| match reading {
            Reading::Number { value, .. } => *value,
            Reading::Unclear => with_comma(text),
            _ => f64::NAN,
        };
        let values = readings.iter().zip(texts).map(value).collect();
        Self::of_numbers(name, values, |row| texts[row].trim().to_owned())
    }

    /// A column of numbers; those that are not finite are blank, with a text.
    pub(crate) fn of_numbers(name: String, mut values: Vec<f64>, text: impl Fn(usize) -> String) -> Self {
        let rows = values.iter().enumerate().filter(|(_, value)| !value.is_finite());
        let blanks = rows.map(|(row, _)| Blank { row, text: text(row) }).collect();
        values.iter_mut().filter(|value| !value.is_finite()).for_each(|value| *value = f64::NAN);
        Self { name, blanks, cells: Cells::Numbers(values), flaw: None }
    }

    /// A column of texts.
    pub(crate) fn of_texts(name: String, texts: Vec<String>) -> Self {
        Self { name, blanks: Vec::new(), cells: Cells::Text(texts), flaw: None }
    }

    /// The cells.
    ///
    /// # Errors
    /// [`TableError::Cell`] for a word among numbers, two decimal marks in one column, marks of thousands.
    pub fn cells(&self) -> Result<&Cells, TableError> {
        self.flaw.clone().map_or(Ok(&self.cells), Err)
    }

    /// Text of a cell: of a number, its shortest one.
    pub fn text(&self, row: usize) -> String {
        match &self.cells {
            Cells::Text(texts) => texts.get(row).cloned().unwrap_or_default(),
            Cells::Numbers(values) => match self.blanks.iter().find(|blank| blank.row == row) {
                Some(blank) => blank.text.clone(),
                None => values.get(row).map(ToString::to_string).unwrap_or_default(),
            },
        }
    }

    /// Rows of the first number and of the first word, of a column of texts that has both.
    pub fn number_and_word(&self) -> Option<[usize; 2]> {
        let Cells::Text(texts) = &self.cells else { return None };
        let is_number = |text: &String| matches!(reading(text), Reading::Number { .. });
        let is_word = |text: &String| reading(text) == Reading::Word;
        Some([texts.iter().position(is_number)?, texts.iter().position(is_word)?])
    }

    /// Whether a list of quantities may have it beside them: texts, the time, the number of a row.
    pub fn is_aside(&self) -> bool {
        const ASIDE: [&str; 11] = ["t", "time", "row", "index", "i", "k", "n", "no", "nr", "number", "id"];
        let (quantity, unit) = self.quantity();
        let is_time = unit.is_none_or(|unit| unit.dimension == Dimension::Time);
        matches!(self.cells, Cells::Text(_)) && self.flaw.is_none()
            || self.blanks.len() == self.len()
            || is_time && ASIDE.contains(&quantity.as_str())
    }

    fn len(&self) -> usize {
        match &self.cells {
            Cells::Numbers(values) => values.len(),
            Cells::Text(texts) => texts.len(),
        }
    }

    /// The name in small letters, with its unit behind a `_`: `x_mm` of `X [mm]`.
    pub fn plain_name(&self) -> String {
        plain(&self.name)
    }

    /// What the name says: the quantity in small letters, and the unit behind it, of `x_mm`, `x [mm]` or
    /// `x (mm)`.
    pub fn quantity(&self) -> (String, Option<Unit>) {
        split(&self.name)
    }
}

/// What would be right in place of a cell.
fn expected(reading: &Reading, cell: &str, own: Marks) -> String {
    let bare = |mark: char| cell.replace(mark, "");
    match reading {
        Reading::Unclear if own.point => format!("{} or {}", bare(','), cell.replace(',', ".")),
        Reading::Unclear => {
            format!("{} or {}: a comma of thousands or a decimal one", bare(','), cell.replace(',', "."))
        }
        Reading::Thousands => "a number without marks of thousands".to_owned(),
        Reading::Number { .. } => "a decimal point, as elsewhere in this column".to_owned(),
        _ => "a number, as elsewhere in this column, or an empty cell".to_owned(),
    }
}
