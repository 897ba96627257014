//! What goes between Python and the designs: laws, rows, outputs and gradients.

use crate::convert::{Answer, Array, Numbers, Raised, filled, json_text, run};
use cdpr_robot::from_json;
use cdpr_sensitivity::{Input, Law, SampleDesign, Slopes, Steps};
use numpy::{IxDyn, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;
use serde::de::DeserializeOwned;
use std::sync::atomic::Ordering;

/// Inputs as `designs.py` makes them: name, law and steps as they stand in study files.
pub(crate) type Inputs<'py> = Vec<(String, Bound<'py, PyAny>, Option<Bound<'py, PyAny>>)>;

pub(crate) fn inputs(given: &Inputs) -> Answer<Vec<Input>> {
    let input = |(name, law, steps): &(String, Bound<PyAny>, Option<Bound<PyAny>>)| -> Answer<Input> {
        let law: Law = read(&format!("law of input `{name}`"), law)?;
        let steps: Option<Steps> =
            steps.as_ref().map(|steps| read(&format!("steps of input `{name}`"), steps)).transpose()?;
        Ok(Input { name: name.clone(), law, steps })
    };
    given.iter().map(input).collect()
}

/// A value that is given as a dictionary.
pub(crate) fn read<T: DeserializeOwned>(name: &str, content: &Bound<PyAny>) -> Answer<T> {
    let text = json_text(name, content)?;
    from_json(&text).map_err(|error| Raised::Input(format!("{name}: {error}")))
}

/// Number of rows that a thread makes at a time.
const PART: usize = 1024;

/// The rows of a design, (points, k).
pub(crate) fn rows(py: Python, design: &impl SampleDesign) -> Answer<Py<PyAny>> {
    let (points, inputs) = (design.points(), design.inputs().len());
    let values = run(py, |stop| -> Answer<Vec<f64>> {
        let mut values = filled(&[points, inputs], 0.0)?;
        let part = |(part, rows): (usize, &mut [f64])| {
            if stop.load(Ordering::Relaxed) { Ok(()) } else { design.rows(part * PART, rows) }
        };
        values.par_chunks_mut(PART * inputs).enumerate().try_for_each(part)?;
        Ok(values)
    })??;
    Ok(PyArray1::from_vec(py, values).reshape(IxDyn(&[points, inputs]))?.into_any().unbind())
}

/// One output a row, `None` for NaN.
pub(crate) fn outputs(outputs: &Numbers) -> Answer<Vec<Option<f64>>> {
    let Array { shape, values } = Array::new("outputs", outputs)?;
    match shape[..] {
        [_] => Ok(values.into_iter().map(|value| (!value.is_nan()).then_some(value)).collect()),
        _ => Err(Raised::Input(format!("outputs has the shape {shape:?}: expected one output a row"))),
    }
}

/// An output of several components a row, `None` where one of them is NaN.
pub(crate) fn vectors(outputs: &Numbers) -> Answer<Vec<Option<Vec<f64>>>> {
    let Array { shape, values } = Array::new("outputs", outputs)?;
    let [_, width] = shape[..] else {
        return Err(Raised::Input(format!(
            "outputs has the shape {shape:?}: expected (n, m), a column for each component"
        )));
    };
    let row = |row: &[f64]| (!row.iter().any(|value| value.is_nan())).then(|| row.to_vec());
    Ok(values.chunks_exact(width.max(1)).map(row).collect())
}

/// An output and its derivatives by `inputs` inputs a row, `None` where one of them is NaN.
pub(crate) fn slopes(outputs: &Numbers, gradients: &Numbers, inputs: usize) -> Answer<Vec<Option<Slopes>>> {
    let outputs = self::outputs(outputs)?;
    let Array { shape, values } = Array::new("gradients", gradients)?;
    let n = outputs.len();
    if shape != [n, inputs] {
        return Err(Raised::Input(format!("gradients has the shape {shape:?}: expected ({n}, {inputs})")));
    }
    let row = |(output, gradient): (Option<f64>, &[f64])| {
        let gradient = (!gradient.iter().any(|slope| slope.is_nan())).then(|| gradient.to_vec());
        Some(Slopes { output: output?, gradient: gradient? })
    };
    Ok(outputs.into_iter().zip(values.chunks_exact(inputs.max(1))).map(row).collect())
}
