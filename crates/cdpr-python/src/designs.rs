//! Designs of experiments for any model, and what is estimated from its outputs at their rows.

use crate::arrays::Numbers;
use crate::error::{Answer, Raised};
use cdpr_robot::from_json;
use cdpr_sensitivity::{
    Bootstrap, Estimate, Input, Order, SampleDesign, Truncation, expansion, morris_effects, sobol_indices,
    student_effects,
};
use numpy::{IxDyn, PyArray1, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Consecutive points of Sobol's sequence in the laws of k inputs, plain or, with a seed, under Owen's scrambling. Sizes of 2^m, from
/// index 0, keep its balance.
///
/// inputs: law of each input by its name; see `uniform`, `normal` and the other laws.
/// points: number of rows.
/// first_index: index in the plain sequence of the first row; 1 where a law has no lower end.
/// seed: of the scrambling; None for the plain sequence.
///
/// Raises InputError.
#[pyclass(frozen, module = "cdpr.sensitivity")]
pub(crate) struct SobolDesign {
    design: cdpr_sensitivity::SobolDesign,
}

/// Blocks of k + 2 rows for Sobol' indices (2k + 2 for those of pairs), on 8 scrambled sequences by turns or, without a seed, on the plain
/// one. Arguments as of `SobolDesign`.
///
/// blocks: number of blocks N, 16 at least.
/// pairs: whether indices of pairs of inputs are wanted.
#[pyclass(frozen, module = "cdpr.sensitivity")]
pub(crate) struct SaltelliDesign {
    design: cdpr_sensitivity::SaltelliDesign,
}

/// Radial blocks of k + 1 rows for Morris's elementary effects, on points of the scrambled Sobol sequence.
///
/// blocks: number of blocks, 2 at least.
/// seed: of the scrambling.
#[pyclass(frozen, module = "cdpr.sensitivity")]
pub(crate) struct MorrisDesign {
    design: cdpr_sensitivity::MorrisDesign,
}

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
    /// Their standard deviation, with n - 1.
    std: f64,
    /// Observations without an output.
    failed: usize,
}

/// Sobol' indices of k inputs with intervals.
#[pyclass(frozen, get_all, module = "cdpr.sensitivity")]
pub(crate) struct SobolIndices {
    /// Names of the inputs.
    inputs: Vec<String>,
    /// Share of the variance that each causes alone, (k,).
    first: Py<PyAny>,
    /// Its interval, (k, 2).
    first_interval: Py<PyAny>,
    /// Share of the variance that each takes part in, (k,).
    total: Py<PyAny>,
    /// Its interval, (k, 2).
    total_interval: Py<PyAny>,
    /// Names of the pairs of inputs; none unless they are asked for.
    pairs: Vec<(String, String)>,
    /// Share of the variance that each pair causes together beyond what each causes alone, (pairs,).
    second: Py<PyAny>,
    /// Its interval, (pairs, 2).
    second_interval: Py<PyAny>,
    /// Variance of the output.
    variance: f64,
    /// Blocks that the indices rest on.
    blocks: usize,
    /// Blocks left out for an output that failed.
    failed_blocks: usize,
}

/// Morris's elementary effects of k inputs, in the unit of the output.
#[pyclass(frozen, get_all, module = "cdpr.sensitivity")]
pub(crate) struct MorrisEffects {
    /// Names of the inputs.
    inputs: Vec<String>,
    /// mu: mean, (k,).
    mean: Py<PyAny>,
    /// mu*: mean of absolute values, (k,).
    mean_absolute: Py<PyAny>,
    /// Its interval, (k, 2).
    mean_absolute_interval: Py<PyAny>,
    /// sigma: standard deviation, (k,).
    std: Py<PyAny>,
}

/// A sparse polynomial chaos expansion of the output in k inputs.
#[pyclass(frozen, module = "cdpr.sensitivity")]
pub(crate) struct Expansion {
    expansion: cdpr_sensitivity::Expansion,
}

#[pymethods]
impl SobolDesign {
    #[new]
    #[pyo3(signature = (inputs, points, *, first_index=0, seed=None))]
    fn new(inputs: &Bound<PyDict>, points: usize, first_index: u32, seed: Option<u64>) -> Answer<Self> {
        let inputs = laws(inputs)?;
        let design = match (seed, first_index) {
            (None, first) => cdpr_sensitivity::SobolDesign::new(inputs, first, points)?,
            (Some(seed), 0) => cdpr_sensitivity::SobolDesign::scrambled(inputs, points, seed)?,
            (Some(_), first) => {
                return Err(Raised::Input(format!(
                    "first_index is {first}: expected 0 for a scrambled sequence"
                )));
            }
        };
        Ok(Self { design })
    }

    /// Values of the inputs, (points, k).
    fn rows(&self, py: Python) -> Answer<Py<PyAny>> {
        rows(py, &self.design)
    }

    /// Effect of each input from one output a row, NaN where the model failed, (points,).
    fn effects(&self, py: Python, outputs: Numbers) -> Answer<Effects> {
        let found = student_effects(&self.design, &values(&outputs)?)?;
        Ok(Effects {
            inputs: names(&self.design),
            effect: vector(py, found.effects.iter().map(|effect| effect.effect)),
            student: vector(py, found.effects.iter().map(|effect| effect.student)),
            mean: found.outputs.mean,
            std: found.outputs.std,
            failed: found.outputs.failed,
        })
    }

    /// A polynomial chaos expansion from one output a row, NaN where the model failed, (points,).
    ///
    /// max_degree: largest degree that is tried.
    /// norm: q in (0, 1] of the hyperbolic truncation; 1 for all products up to the degree.
    /// interactions: most inputs in one product.
    #[pyo3(signature = (outputs, *, max_degree=5, norm=1.0, interactions=2))]
    fn expansion(
        &self,
        outputs: Numbers,
        max_degree: usize,
        norm: f64,
        interactions: usize,
    ) -> Answer<Expansion> {
        let truncation = Truncation { max_degree, norm, interactions };
        Ok(Expansion { expansion: expansion(&self.design, &values(&outputs)?, truncation)? })
    }
}

#[pymethods]
impl SaltelliDesign {
    #[new]
    #[pyo3(signature = (inputs, blocks, *, seed=None, pairs=false, first_index=0))]
    fn new(
        inputs: &Bound<PyDict>,
        blocks: usize,
        seed: Option<u64>,
        pairs: bool,
        first_index: u32,
    ) -> Answer<Self> {
        let inputs = laws(inputs)?;
        let order = if pairs { Order::Second } else { Order::First };
        let design = match (seed, first_index) {
            (None, first) => cdpr_sensitivity::SaltelliDesign::new(inputs, first, blocks, order)?,
            (Some(seed), 0) => cdpr_sensitivity::SaltelliDesign::scrambled(inputs, blocks, order, seed)?,
            (Some(_), first) => {
                return Err(Raised::Input(format!(
                    "first_index is {first}: expected 0 for scrambled sequences"
                )));
            }
        };
        Ok(Self { design })
    }

    /// Values of the inputs, (points, k).
    fn rows(&self, py: Python) -> Answer<Py<PyAny>> {
        rows(py, &self.design)
    }

    /// Sobol' indices from one output a row, NaN where the model failed, (points,), with bootstrap intervals.
    #[pyo3(signature = (outputs, *, level=0.95, resamples=1000, seed=0))]
    fn indices(
        &self,
        py: Python,
        outputs: Numbers,
        level: f64,
        resamples: usize,
        seed: u64,
    ) -> Answer<SobolIndices> {
        let found = sobol_indices(&self.design, &values(&outputs)?, Bootstrap { resamples, seed }, level)?;
        let first: Vec<Estimate> = found.inputs.iter().map(|index| index.first).collect();
        let total: Vec<Estimate> = found.inputs.iter().map(|index| index.total).collect();
        let second: Vec<Estimate> = found.pairs.iter().map(|index| index.second).collect();
        Ok(SobolIndices {
            inputs: names(&self.design),
            first: vector(py, first.iter().map(|estimate| estimate.value)),
            first_interval: intervals(py, &first)?,
            total: vector(py, total.iter().map(|estimate| estimate.value)),
            total_interval: intervals(py, &total)?,
            second: vector(py, second.iter().map(|estimate| estimate.value)),
            second_interval: intervals(py, &second)?,
            pairs: found.pairs.into_iter().map(|pair| pair.inputs.into()).collect(),
            variance: found.variance,
            blocks: found.blocks,
            failed_blocks: found.failed_blocks,
        })
    }
}

#[pymethods]
impl MorrisDesign {
    #[new]
    #[pyo3(signature = (inputs, blocks, *, seed))]
    fn new(inputs: &Bound<PyDict>, blocks: usize, seed: u64) -> Answer<Self> {
        Ok(Self { design: cdpr_sensitivity::MorrisDesign::radial(laws(inputs)?, blocks, seed)? })
    }

    /// Values of the inputs, (points, k).
    fn rows(&self, py: Python) -> Answer<Py<PyAny>> {
        rows(py, &self.design)
    }

    /// Elementary effects from one output a row, NaN where the model failed, (points,).
    #[pyo3(signature = (outputs, *, level=0.95))]
    fn effects(&self, py: Python, outputs: Numbers, level: f64) -> Answer<MorrisEffects> {
        let found = morris_effects(&self.design, &values(&outputs)?, level)?;
        let absolute: Vec<Estimate> = found.iter().map(|effect| effect.mean_absolute).collect();
        Ok(MorrisEffects {
            inputs: names(&self.design),
            mean: vector(py, found.iter().map(|effect| effect.mean)),
            mean_absolute: vector(py, absolute.iter().map(|estimate| estimate.value)),
            mean_absolute_interval: intervals(py, &absolute)?,
            std: vector(py, found.iter().map(|effect| effect.std)),
        })
    }
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

    /// Degree chosen.
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

    /// The expansion at rows of values of the inputs, (m, k): m outputs.
    fn predict(&self, py: Python, rows: Numbers) -> Answer<Py<PyAny>> {
        let shape = rows.shape();
        let [_, width] = *shape else {
            return Err(Raised::Input(format!(
                "rows has the shape {shape:?}: expected (m, {})",
                self.inputs().len()
            )));
        };
        let values: Vec<f64> = rows.as_array().iter().copied().collect();
        let outputs: Vec<f64> = values
            .chunks_exact(width.max(1))
            .map(|row| self.expansion.predict(row))
            .collect::<Result<_, _>>()?;
        Ok(vector(py, outputs.into_iter()))
    }
}

/// Inputs from their laws, as they stand in study files: `{"uniform": {"min": .., "max": ..}}`.
fn laws(inputs: &Bound<PyDict>) -> Answer<Vec<Input>> {
    let dumps = inputs.py().import("json")?.getattr("dumps")?;
    let input = |(name, law): (Bound<PyAny>, Bound<PyAny>)| -> Answer<Input> {
        let name: String = name.extract()?;
        let text: String = dumps.call1((law,))?.extract()?;
        let law =
            from_json(&text).map_err(|error| Raised::Input(format!("law of input `{name}`: {error}")))?;
        Ok(Input::continuous(name, law))
    };
    inputs.iter().map(input).collect()
}

fn names(design: &impl SampleDesign) -> Vec<String> {
    design.inputs().iter().map(|input| input.name.clone()).collect()
}

fn rows(py: Python, design: &impl SampleDesign) -> Answer<Py<PyAny>> {
    let (points, inputs) = (design.points(), design.inputs().len());
    let mut values = vec![0.0; points * inputs];
    py.detach(|| design.rows(0, &mut values))?;
    Ok(PyArray1::from_vec(py, values).reshape(IxDyn(&[points, inputs]))?.into_any().unbind())
}

/// One output a row, `None` for NaN.
fn values(outputs: &Numbers) -> Answer<Vec<Option<f64>>> {
    match outputs.shape() {
        [_] => Ok(outputs.as_array().iter().map(|value| (!value.is_nan()).then_some(*value)).collect()),
        shape => Err(Raised::Input(format!("outputs has the shape {shape:?}: expected one output a row"))),
    }
}

fn vector(py: Python, values: impl Iterator<Item = f64>) -> Py<PyAny> {
    PyArray1::from_vec(py, values.collect()).into_any().unbind()
}

fn intervals(py: Python, estimates: &[Estimate]) -> PyResult<Py<PyAny>> {
    let ends = estimates.iter().flat_map(|estimate| [estimate.low, estimate.high]).collect::<Vec<f64>>();
    Ok(PyArray1::from_vec(py, ends).reshape(IxDyn(&[estimates.len(), 2]))?.into_any().unbind())
}
