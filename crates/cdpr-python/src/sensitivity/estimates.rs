//! Estimates from the outputs of any model at the rows of a design.

use crate::convert::{Answer, Array, Numbers, Raised, answer, run, to_json};
use cdpr_robot::from_json;
use cdpr_sensitivity::Estimate;
use numpy::{IxDyn, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;

answer! {
    /// Effects of k inputs by halves of their domains.
    #[pyclass(frozen, get_all, module = "cdpr.sensitivity")]
    pub(crate) struct Effects {
        /// Names of the inputs.
        inputs: Vec<String>,
        /// Mean output in the upper half minus that in the lower half, (k,).
        effect: Py<PyAny>,
        /// The paper's t-Student index, (k,). On Sobol points its significance levels do not hold.
        student: Py<PyAny>,
        /// Mean of the outputs.
        mean: f64,
        /// Standard deviation of the outputs, with n - 1.
        std: f64,
        /// Number of observations without an output.
        failed: usize,
    }
}

answer! {
    /// Sobol' indices of k inputs with intervals.
    #[pyclass(frozen, get_all, module = "cdpr.sensitivity")]
    pub(crate) struct SobolIndices {
        /// Names of the inputs.
        inputs: Vec<String>,
        /// Share of the variance that each input causes alone, (k,).
        first: Py<PyAny>,
        /// Intervals of these, (k, 2).
        first_interval: Py<PyAny>,
        /// Share of the variance that each input takes part in, (k,).
        total: Py<PyAny>,
        /// Intervals of these, (k, 2).
        total_interval: Py<PyAny>,
        /// Names of the pairs of inputs; empty unless pairs are asked for.
        pairs: Vec<(String, String)>,
        /// Share of the variance that each pair causes together beyond what each causes alone, (pairs,).
        second: Py<PyAny>,
        /// Intervals of these, (pairs, 2).
        second_interval: Py<PyAny>,
        /// Variance of the output.
        variance: f64,
        /// Number of blocks of the design.
        blocks: usize,
        /// Number of blocks with a failed output.
        failed_blocks: usize,
        /// Number of blocks behind the indices of each input.
        input_blocks: Vec<usize>,
        /// Whether the intervals have their level: with a seed, from 64 blocks on.
        reliable: bool,
    }
}

answer! {
    /// Morris's elementary effects of k inputs, in the unit of the output.
    #[pyclass(frozen, get_all, module = "cdpr.sensitivity")]
    pub(crate) struct MorrisEffects {
        /// Names of the inputs.
        inputs: Vec<String>,
        /// mu: mean, (k,).
        mean: Py<PyAny>,
        /// mu*: mean of absolute values, (k,).
        mean_absolute: Py<PyAny>,
        /// Intervals of these, (k, 2).
        mean_absolute_interval: Py<PyAny>,
        /// sigma: standard deviation, (k,).
        std: Py<PyAny>,
    }
}

/// A sparse polynomial chaos expansion of the output in k inputs.
#[pyclass(frozen, module = "cdpr.sensitivity")]
pub(crate) struct Expansion {
    pub(crate) expansion: cdpr_sensitivity::Expansion,
}

#[pymethods]
impl Expansion {
    /// Names of the inputs.
    #[getter]
    fn inputs(&self) -> Vec<String> {
        self.expansion.inputs.iter().map(|input| input.name.clone()).collect()
    }

    /// Mean of the output.
    #[getter]
    fn mean(&self) -> f64 {
        self.expansion.mean
    }

    /// Variance of the output.
    #[getter]
    fn variance(&self) -> f64 {
        self.expansion.variance()
    }

    /// Degree of the expansion.
    #[getter]
    fn degree(&self) -> usize {
        self.expansion.degree
    }

    /// Leave-one-out error, as a share of the variance of the outputs.
    #[getter]
    fn leave_one_out(&self) -> f64 {
        self.expansion.leave_one_out
    }

    /// Share of the variance that each input causes alone, (k,).
    #[getter]
    fn first(&self, py: Python) -> Py<PyAny> {
        vector(py, self.expansion.indices().iter().map(|shares| shares.closed))
    }

    /// Share of the variance that each input takes part in, (k,).
    #[getter]
    fn total(&self, py: Python) -> Py<PyAny> {
        vector(py, self.expansion.indices().iter().map(|shares| shares.total))
    }

    /// Evaluates the expansion at rows of values of the inputs, (m, k): m outputs.
    fn predict(&self, py: Python, rows: Numbers) -> Answer<Py<PyAny>> {
        let Array { shape, values } = Array::new("rows", &rows)?;
        let width = self.expansion.inputs.len();
        if shape.len() != 2 || shape[1] != width {
            return Err(Raised::Input(format!("rows has the shape {shape:?}: expected (m, {width})")));
        }
        let predict = |row| self.expansion.predict(row);
        let outputs =
            run(py, |_| values.par_chunks_exact(width).map(predict).collect::<Result<Vec<_>, _>>())??;
        Ok(vector(py, outputs.into_iter()))
    }

    /// Makes an expansion again for `pickle`, which carries it as JSON.
    fn __reduce__<'py>(&self, py: Python<'py>) -> Answer<(Bound<'py, PyAny>, (String,))> {
        let text = to_json(&self.expansion)?;
        Ok((py.get_type::<Self>().getattr("_from_json")?, (text,)))
    }

    #[staticmethod]
    fn _from_json(text: &str) -> Answer<Self> {
        let expansion = from_json(text).map_err(|error| Raised::Input(error.to_string()))?;
        Ok(Self { expansion })
    }

    fn __repr__(&self) -> String {
        let (inputs, degree) = (self.expansion.inputs.len(), self.expansion.degree);
        format!("<cdpr.sensitivity.Expansion in {inputs} inputs, degree {degree}>")
    }
}

pub(crate) fn vector(py: Python, values: impl Iterator<Item = f64>) -> Py<PyAny> {
    PyArray1::from_vec(py, values.collect()).into_any().unbind()
}

pub(crate) fn intervals(py: Python, estimates: &[Estimate]) -> PyResult<Py<PyAny>> {
    let ends = estimates.iter().flat_map(|estimate| [estimate.low, estimate.high]).collect::<Vec<f64>>();
    Ok(PyArray1::from_vec(py, ends).reshape(IxDyn(&[estimates.len(), 2]))?.into_any().unbind())
}
