//! From a design to the outputs of a model, and on to the numbers on which an estimator works.

use std::ops::Range;

use crate::design::SampleDesign;
use crate::error::{SensitivityError, check_finite, check_length, check_range};
use crate::parallel::*;
use crate::sample::summary::check_varies;

/// Runs a model at all points of a design in parallel. It returns one output per row, `None` where the model
/// failed.
///
/// # Errors
/// Those of [`SampleDesign::row`]. The designs of this crate do not return any.
pub fn observe<D: SampleDesign>(
    design: &D,
    model: impl Fn(&[f64]) -> Option<f64> + Sync,
) -> Result<Vec<Option<f64>>, SensitivityError> {
    observe_rows(design, 0..design.points(), model)
}

/// Runs a model at some rows of a design, as [`observe`] does at all.
pub(crate) fn observe_rows<D: SampleDesign>(
    design: &D,
    rows: Range<usize>,
    model: impl Fn(&[f64]) -> Option<f64> + Sync,
) -> Result<Vec<Option<f64>>, SensitivityError> {
    let output = |row: &mut Vec<f64>, index| {
        design.row(index, row)?;
        Ok(model(row))
    };
    rows.into_par_iter().map_init(|| vec![0.0; design.inputs().len()], output).collect()
}

/// Checks that there is one output per row, and that each is finite or `None`.
pub(crate) fn check_outputs(
    design: &impl SampleDesign,
    outputs: &[Option<f64>],
) -> Result<(), SensitivityError> {
    check_length("outputs", outputs.len(), design.points())?;
    let mut observed = outputs.iter().enumerate().filter_map(|(index, output)| Some((index, (*output)?)));
    observed.try_for_each(|(index, value)| check_finite("outputs", index, value))
}

/// Observations that gave an output.
#[derive(Debug, Clone)]
pub(crate) struct Observed {
    /// Values of each input, one per observation.
    pub(crate) columns: Vec<Vec<f64>>,
    pub(crate) outputs: Vec<f64>,
    /// Number of failed observations.
    pub(crate) failed: usize,
}

impl Observed {
    /// Selects them. There must be at least `minimum`, and their outputs must not all be equal.
    pub(crate) fn new(
        design: &impl SampleDesign,
        outputs: &[Option<f64>],
        minimum: usize,
    ) -> Result<Self, SensitivityError> {
        check_outputs(design, outputs)?;
        let values = observed(outputs, minimum)?;
        let mut columns = vec![Vec::with_capacity(values.len()); design.inputs().len()];
        let mut row = vec![0.0; columns.len()];
        for index in (0..outputs.len()).filter(|&index| outputs[index].is_some()) {
            design.row(index, &mut row)?;
            for (column, &value) in columns.iter_mut().zip(&row) {
                column.push(value);
            }
        }
        Ok(Self { columns, failed: outputs.len() - values.len(), outputs: values })
    }

    /// The same of columns that hold a value for each output, all of which are finite.
    pub(crate) fn of_columns(
        columns: &[Vec<f64>],
        outputs: &[Option<f64>],
        minimum: usize,
    ) -> Result<Self, SensitivityError> {
        let values = observed(outputs, minimum)?;
        let select = |column: &Vec<f64>| {
            column
                .iter()
                .zip(outputs)
                .filter(|(_, output)| output.is_some())
                .map(|(value, _)| *value)
                .collect()
        };
        let columns = columns.iter().map(select).collect();
        Ok(Self { columns, failed: outputs.len() - values.len(), outputs: values })
    }
}

/// The outputs that were observed: at least `minimum`, and not all equal.
fn observed(outputs: &[Option<f64>], minimum: usize) -> Result<Vec<f64>, SensitivityError> {
    let values: Vec<f64> = outputs.iter().copied().flatten().collect();
    check_range("observed outputs", values.len() as u64, minimum as u64, u64::MAX)?;
    check_varies(&values)?;
    Ok(values)
}
