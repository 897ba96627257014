//! A polynomial chaos expansion, which predicts.

use crate::convert::{Answer, Array, Numbers, Raised, run, to_json};
use cdpr_robot::from_json;
use numpy::PyArray1;
use pyo3::prelude::*;
use rayon::prelude::*;
use serde_json::json;

/// A sparse polynomial chaos expansion.
#[pyclass(frozen, module = "cdpr._core")]
pub(crate) struct Expansion {
    pub(crate) expansion: cdpr_sensitivity::Expansion,
}

#[pymethods]
impl Expansion {
    #[new]
    fn new(text: &str) -> Answer<Self> {
        let expansion = from_json(text).map_err(|error| Raised::Input(error.to_string()))?;
        Ok(Self { expansion })
    }

    /// Makes it again for `pickle`, which carries it as JSON.
    fn __getnewargs__(&self) -> Answer<(String,)> {
        Ok((to_json(&self.expansion)?,))
    }

    /// What it says of the inputs, as JSON.
    fn summary(&self) -> Answer<String> {
        let of = &self.expansion;
        let names: Vec<&str> = of.inputs.iter().map(|input| input.name.as_str()).collect();
        let input = |(name, shares): (&&str, cdpr_sensitivity::Shares)| {
            let (first, total) = (shares.closed, shares.total);
            json!({"input": name, "first": first, "total": total})
        };
        let pair = |pair: &cdpr_sensitivity::PairShare| {
            let inputs = pair.inputs.map(|input| names[input]);
            json!({"inputs": inputs, "share": pair.share})
        };
        to_json(&json!({
            "inputs": names.iter().zip(of.indices()).map(input).collect::<Vec<_>>(),
            "pairs": of.pairs().iter().map(pair).collect::<Vec<_>>(),
            "mean": of.mean,
            "variance": of.variance(),
            "degree": of.degree,
            "terms": of.terms.len(),
            "leave_one_out": of.leave_one_out,
            "derivatives": of.derivatives,
            "observed": of.observed,
            "failed": of.failed,
        }))
    }

    /// Shares of a group of inputs: closed and total.
    fn group(&self, names: Vec<String>) -> Answer<(f64, f64)> {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let shares = self.expansion.group(&names)?;
        Ok((shares.closed, shares.total))
    }

    fn predict(&self, py: Python, rows: Numbers) -> Answer<Py<PyAny>> {
        let Array { shape, values } = Array::new("rows", &rows)?;
        let width = self.expansion.inputs.len();
        if shape.len() != 2 || shape[1] != width {
            return Err(Raised::Input(format!("rows has the shape {shape:?}: expected (m, {width})")));
        }
        let predict = |row| self.expansion.predict(row);
        let outputs =
            run(py, |_| values.par_chunks_exact(width).map(predict).collect::<Result<Vec<_>, _>>())??;
        Ok(PyArray1::from_vec(py, outputs).into_any().unbind())
    }
}
