//! A table of inputs and one output, as estimators take it.

use crate::design::JointSample;
use crate::design::observation::Observed;
use crate::error::{SensitivityError, check_length, check_range, check_values, require};

/// What the values of an input are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Quantities.
    Numbers,
    /// Codes of levels without an order, such as words.
    Levels,
}

/// Values of named inputs and the output of each row.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenData {
    names: Vec<String>,
    /// Values of each input, one per row.
    columns: Vec<Vec<f64>>,
    /// Labels of the levels of an input of words, whose values are their numbers; none for quantities.
    labels: Vec<Vec<String>>,
    /// `None` for a failed observation.
    outputs: Vec<Option<f64>>,
}

impl GivenData {
    /// Takes a column of values for each input, and an output for each row, `None` for a failed observation.
    ///
    /// # Errors
    /// - [`SensitivityError::OutOfRange`] for no input;
    /// - [`SensitivityError::LengthMismatch`] unless there is a name for each column, and a value in each
    ///   column for each output;
    /// - [`SensitivityError::InvalidInput`] with [`SensitivityError::NotFinite`] for a value of an input that
    ///   is not finite, [`SensitivityError::NotFinite`] for such an output; the same with
    ///   [`SensitivityError::Scale`] for values whose squares a computer does not hold.
    pub fn new(
        names: Vec<String>,
        mut columns: Vec<Vec<f64>>,
        outputs: Vec<Option<f64>>,
    ) -> Result<Self, SensitivityError> {
        check_range("inputs", columns.len() as u64, 1, u64::MAX)?;
        check_length("names", names.len(), columns.len())?;
        for (name, column) in names.iter().zip(&mut columns) {
            let of_input =
                |source| SensitivityError::InvalidInput { name: name.clone(), source: Box::new(source) };
            check_length("column", column.len(), outputs.len()).map_err(of_input)?;
            check_values("row", column.iter().copied().enumerate()).map_err(of_input)?;
            // -0 is 0.
            column.iter_mut().for_each(|value| *value += 0.0);
        }
        check_values("outputs", outputs.iter().enumerate().filter_map(|(row, y)| Some((row, (*y)?))))?;
        Ok(Self { labels: vec![vec![]; names.len()], names, columns, outputs })
    }

    /// The same data where an input has levels of these labels, such as words. Its values are their numbers,
    /// from 0.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for an input that does not exist, [`SensitivityError::InvalidInput`]
    /// for a value that is no number of a label.
    pub fn with_levels(mut self, input: usize, labels: Vec<String>) -> Result<Self, SensitivityError> {
        check_range("input", input as u64, 0, self.names.len() as u64 - 1)?;
        let is_code = |code: f64| code.fract() == 0.0 && code >= 0.0 && code < labels.len() as f64;
        for &code in &self.columns[input] {
            require(is_code(code), "level", code, "the number of a label").map_err(|source| {
                SensitivityError::InvalidInput { name: self.names[input].clone(), source: Box::new(source) }
            })?;
        }
        self.labels[input] = labels;
        Ok(self)
    }

    /// Labels of the levels of an input; none for quantities.
    #[must_use]
    pub fn labels(&self, input: usize) -> &[String] {
        &self.labels[input]
    }

    pub(crate) fn kind(&self, input: usize) -> Kind {
        if self.labels[input].is_empty() { Kind::Numbers } else { Kind::Levels }
    }

    /// The rows of a design and their outputs, `None` for a failed observation.
    ///
    /// # Errors
    /// [`SensitivityError::LengthMismatch`] unless there is one output per row,
    /// [`SensitivityError::NotFinite`] for a value that is not finite.
    pub fn of_design<D: JointSample>(design: &D, outputs: &[Option<f64>]) -> Result<Self, SensitivityError> {
        check_length("outputs", outputs.len(), design.points())?;
        let mut columns = vec![Vec::with_capacity(outputs.len()); design.inputs().len()];
        let mut row = vec![0.0; columns.len()];
        for index in 0..outputs.len() {
            design.row(index, &mut row)?;
            columns.iter_mut().zip(&row).for_each(|(column, &value)| column.push(value));
        }
        let names = design.inputs().iter().map(|input| input.name.clone()).collect();
        Self::new(names, columns, outputs.to_vec())
    }

    /// Names of the inputs.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Values of each input, one per row.
    #[must_use]
    pub fn columns(&self) -> &[Vec<f64>] {
        &self.columns
    }

    /// Output of each row, `None` for a failed observation.
    #[must_use]
    pub fn outputs(&self) -> &[Option<f64>] {
        &self.outputs
    }

    /// The rows that have an output: at least `minimum`, and not all of the same output.
    pub(crate) fn observed(&self, minimum: usize) -> Result<Observed, SensitivityError> {
        Observed::of_columns(&self.columns, &self.outputs, minimum)
    }
}
