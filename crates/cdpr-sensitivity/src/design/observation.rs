//! From a design to the outputs of a model, and from both to the numbers that an estimator works on.

use std::ops::Range;

use rayon::prelude::*;

use crate::design::SampleDesign;
use crate::error::{SensitivityError, check_length, check_range};

/// Runs a model at all points of a design, in parallel: one output a row, `None` where the model has none.
///
/// # Errors
/// Those of [`SampleDesign::row`], which a sound design does not have.
pub fn observe<D: SampleDesign>(
    design: &D,
    model: impl Fn(&[f64]) -> Option<f64> + Sync,
) -> Result<Vec<Option<f64>>, SensitivityError> {
    observe_rows(design, 0..design.points(), model)
}

/// [`observe`], of some rows.
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

/// One output a row of the design, each a finite number or `None`.
pub(crate) fn check_outputs(
    design: &impl SampleDesign,
    outputs: &[Option<f64>],
) -> Result<(), SensitivityError> {
    check_length("outputs", outputs.len(), design.points())?;
    match outputs.iter().enumerate().find(|(_, output)| output.is_some_and(|value| !value.is_finite())) {
        Some((index, &Some(value))) => Err(SensitivityError::NotFinite { field: "outputs", index, value }),
        _ => Ok(()),
    }
}

/// The observations of a design that gave an output.
pub(crate) struct Observed {
    /// Values of each input.
    pub(crate) columns: Vec<Vec<f64>>,
    pub(crate) outputs: Vec<f64>,
    /// Observations that gave none.
    pub(crate) failed: usize,
}

impl Observed {
    /// At least `minimum` of them, not all equal.
    pub(crate) fn new(
        design: &impl SampleDesign,
        outputs: &[Option<f64>],
        minimum: usize,
    ) -> Result<Self, SensitivityError> {
        check_outputs(design, outputs)?;
        let values: Vec<f64> = outputs.iter().copied().flatten().collect();
        check_range("observed outputs", values.len() as u64, minimum as u64, u64::MAX)?;
        check_variance(&values)?;
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
}

/// At least two different values.
pub(crate) fn check_variance(values: &[f64]) -> Result<(), SensitivityError> {
    if values.iter().all(|value| *value == values[0]) {
        return Err(SensitivityError::ConstantSample { value: values[0], count: values.len() });
    }
    Ok(())
}
