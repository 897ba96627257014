//! The analysis of a table that was not made by a design.

use crate::convert::{Answer, Array, Numbers, Raised, run, to_json, whole};
use crate::sensitivity::observed::vectors;
use cdpr_sensitivity::{Analyser, Analysis, GivenData, Limit};
use pyo3::prelude::*;
use serde::Serialize;

/// The analysis of an output, and the number of rows that are left out.
#[derive(Serialize)]
struct Found {
    left_out: usize,
    #[serde(flatten)]
    analysis: Analysis,
}

/// Analyses rows of inputs, (n, k), and an output of them, (n,), one of `all_outputs`: the analysis as JSON.
///
/// An input of words has its labels, and their numbers as values.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn analyse(
    py: Python,
    rows: Numbers,
    outputs: Numbers,
    names: Vec<String>,
    labels: Vec<Vec<String>>,
    limit: Option<(String, f64)>,
    level: f64,
    seed: u64,
    dependence_rows: usize,
    all_outputs: usize,
) -> Answer<String> {
    let (x, y) = (Array::new("X", &rows)?, Array::new("Y", &outputs)?);
    let k = names.len();
    if x.shape.len() != 2 || x.shape[1] != k || y.shape[..] != x.shape[..1] {
        let (x, y) = (x.shape, y.shape);
        return Err(Raised::Input(format!(
            "X has the shape {x:?} and Y {y:?}: expected (n, {k}) and (n,), a name for each column"
        )));
    }
    let limit = limit.map(|(sign, value)| match sign.as_str() {
        "<" => Ok(Limit::Below(value)),
        "<=" => Ok(Limit::AtMost(value)),
        ">" => Ok(Limit::Above(value)),
        ">=" => Ok(Limit::AtLeast(value)),
        sign => Err(Raised::Input(format!("limit has the sign `{sign}`: expected <, <=, > or >="))),
    });
    let limit = limit.transpose()?;
    let found = run(py, |_| {
        let complete: Vec<usize> = (0..y.values.len())
            .filter(|row| x.values[row * k..(row + 1) * k].iter().all(|value| value.is_finite()))
            .collect();
        let column = |input: usize| complete.iter().map(|row| x.values[row * k + input]).collect();
        let outputs = complete.iter().map(|&row| Some(y.values[row]).filter(|value| value.is_finite()));
        let mut data = GivenData::new(names, (0..k).map(column).collect(), outputs.collect())?;
        for (input, labels) in labels.into_iter().enumerate().filter(|(_, labels)| !labels.is_empty()) {
            data = data.with_levels(input, labels)?;
        }
        let analysis =
            Analyser { level, seed, dependence_rows, limit, outputs: all_outputs }.analyse(&data)?;
        Ok::<_, cdpr_sensitivity::SensitivityError>(Found {
            left_out: y.values.len() - complete.len(),
            analysis,
        })
    })?;
    to_json(&found?)
}

/// Indices of Wasserstein and Bures of rows of inputs, (n, k), and of vectors, (n, m), as JSON.
#[pyfunction]
pub(crate) fn wasserstein_bures(
    py: Python,
    rows: Numbers,
    given: Numbers,
    level: f64,
    seed: Bound<PyAny>,
) -> Answer<String> {
    let (x, outputs, seed) = (Array::new("rows", &rows)?, vectors(&given)?, whole("seed", &seed)?);
    let [n, k] = x.shape[..] else {
        return Err(Raised::Input(format!("rows has the shape {:?}: expected (n, k)", x.shape)));
    };
    if n != outputs.len() {
        return Err(Raised::Input(format!(
            "rows has {n} rows and outputs {}: expected as many",
            outputs.len()
        )));
    }
    let column = |input: usize| x.values.iter().skip(input).step_by(k).copied().collect();
    let columns: Vec<Vec<f64>> = (0..k).map(column).collect();
    to_json(&run(py, |_| cdpr_sensitivity::wasserstein_bures(&columns, &outputs, level, seed))??)
}
