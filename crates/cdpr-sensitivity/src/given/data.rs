//! A table of inputs and one output, as estimators take it.

use crate::design::JointSample;
use crate::design::observation::Observed;
use crate::error::{SensitivityError, check_finite, check_length, check_range};

/// Values of named inputs and the output of each row.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenData {
    names: Vec<String>,
    /// Values of each input, one per row.
    columns: Vec<Vec<f64>>,
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
    ///   is not finite, [`SensitivityError::NotFinite`] for such an output.
    pub fn new(
        names: Vec<String>,
        columns: Vec<Vec<f64>>,
        outputs: Vec<Option<f64>>,
    ) -> Result<Self, SensitivityError> {
        check_range("inputs", columns.len() as u64, 1, u64::MAX)?;
        check_length("names", names.len(), columns.len())?;
        for (name, column) in names.iter().zip(&columns) {
            let finite = |(row, &value): (usize, &f64)| check_finite("row", row, value);
            check_length("column", column.len(), outputs.len())
                .and_then(|()| column.iter().enumerate().try_for_each(finite))
                .map_err(|source| SensitivityError::InvalidInput {
                    name: name.clone(),
                    source: Box::new(source),
                })?;
        }
        for (row, output) in outputs.iter().enumerate() {
            check_finite("outputs", row, output.unwrap_or(0.0))?;
        }
        Ok(Self { names, columns, outputs })
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
