//! Designs of experiments for any model.

use crate::convert::{Answer, Array, Numbers, Raised, filled, json_text, run, to_json, whole};
use crate::sensitivity::estimates::{Effects, Expansion, MorrisEffects, SobolIndices, intervals, vector};
use cdpr_robot::from_json;
use cdpr_sensitivity::{
    Bootstrap, Estimate, Input, Order, SampleDesign, Truncation, expansion, morris_effects, sobol_indices,
    student_effects,
};
use numpy::{IxDyn, PyArray1, PyArrayMethods};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use std::sync::atomic::Ordering;

/// Consecutive points of Sobol's sequence in the laws of k inputs.
///
/// The sequence is plain or, with a seed, under a nested scrambling. Sizes of 2^m, from index 0, keep its
/// balance.
///
/// inputs: law of each input by its name; see `uniform`, `normal` and the other laws.
/// points: number of rows.
/// first_index: index of the first row in the plain sequence; 1 where a law has no lower end.
/// seed: seed of the scrambling; None for the plain sequence.
///
/// Raises InputError.
#[pyclass(frozen, module = "cdpr.sensitivity")]
pub(crate) struct SobolDesign {
    design: cdpr_sensitivity::SobolDesign,
}

/// Blocks of k + 2 rows for Sobol' indices (2k + 2 for those of pairs).
///
/// Blocks lie on 8 scrambled sequences in rotation or, without a seed, on the plain one. Other arguments are
/// as of `SobolDesign`.
///
/// blocks: number of blocks N, at least 16.
/// pairs: whether indices of pairs of inputs are wanted.
#[pyclass(frozen, module = "cdpr.sensitivity")]
pub(crate) struct SaltelliDesign {
    design: cdpr_sensitivity::SaltelliDesign,
}

/// Blocks of k + 1 rows for Morris's elementary effects: radial ones on points of the scrambled Sobol sequence,
/// or trajectories.
///
/// blocks: number of blocks, at least 2.
/// seed: seed of the scrambling or of the trajectories.
/// levels: levels of the trajectories, an even number; None for radial blocks.
#[pyclass(frozen, module = "cdpr.sensitivity")]
pub(crate) struct MorrisDesign {
    design: cdpr_sensitivity::MorrisDesign,
}

#[pymethods]
impl SobolDesign {
    #[new]
    #[pyo3(signature = (inputs, points, *, first_index=0, seed=None))]
    fn new(
        py: Python,
        inputs: &Bound<PyDict>,
        points: Bound<PyAny>,
        first_index: u32,
        seed: Option<Bound<PyAny>>,
    ) -> Answer<Self> {
        let (inputs, points, seed) =
            (laws(inputs)?, whole("points", &points)?, scrambling(seed, first_index)?);
        let design = run(py, |_| match seed {
            None => cdpr_sensitivity::SobolDesign::new(inputs, first_index, points),
            Some(seed) => cdpr_sensitivity::SobolDesign::scrambled(inputs, points, seed),
        })?;
        Ok(Self { design: design? })
    }

    /// Arguments that make the design again, for `pickle`.
    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> Answer<Made<'py>> {
        let settings = PyDict::new(py);
        settings.set_item("first_index", self.design.first_index())?;
        settings.set_item("seed", self.design.seed())?;
        made(py, &self.design, self.design.points(), settings)
    }

    fn __repr__(&self) -> String {
        summary("SobolDesign", &self.design)
    }

    /// Returns the values of the inputs, (points, k).
    fn rows(&self, py: Python) -> Answer<Py<PyAny>> {
        rows(py, &self.design)
    }

    /// Estimates the effect of each input from one output a row, NaN where the model failed, (points,).
    fn effects(&self, py: Python, outputs: Numbers) -> Answer<Effects> {
        let outputs = values(&outputs)?;
        let found = run(py, |_| student_effects(&self.design, &outputs))??;
        Ok(Effects {
            inputs: names(&self.design),
            effect: vector(py, found.effects.iter().map(|effect| effect.effect)),
            student: vector(py, found.effects.iter().map(|effect| effect.student)),
            mean: found.outputs.mean,
            std: found.outputs.std,
            failed: found.outputs.failed,
        })
    }

    /// Fits a polynomial chaos expansion to one output a row, NaN where the model failed, (points,).
    ///
    /// max_degree: largest degree that is tried.
    /// norm: q in (0, 1] of the hyperbolic truncation; 1 for all products up to the degree.
    /// interactions: largest number of inputs in one product.
    #[pyo3(signature = (outputs, *, max_degree=5, norm=1.0, interactions=2))]
    fn expansion(
        &self,
        py: Python,
        outputs: Numbers,
        max_degree: usize,
        norm: f64,
        interactions: usize,
    ) -> Answer<Expansion> {
        let (outputs, truncation) = (values(&outputs)?, Truncation { max_degree, norm, interactions });
        Ok(Expansion { expansion: run(py, |_| expansion(&self.design, &outputs, truncation))?? })
    }
}

#[pymethods]
impl SaltelliDesign {
    #[new]
    #[pyo3(signature = (inputs, blocks, *, seed=None, pairs=false, first_index=0))]
    fn new(
        py: Python,
        inputs: &Bound<PyDict>,
        blocks: Bound<PyAny>,
        seed: Option<Bound<PyAny>>,
        pairs: bool,
        first_index: u32,
    ) -> Answer<Self> {
        let (inputs, blocks, seed) =
            (laws(inputs)?, whole("blocks", &blocks)?, scrambling(seed, first_index)?);
        let order = if pairs { Order::Second } else { Order::First };
        let design = run(py, |_| match seed {
            None => cdpr_sensitivity::SaltelliDesign::new(inputs, first_index, blocks, order),
            Some(seed) => cdpr_sensitivity::SaltelliDesign::scrambled(inputs, blocks, order, seed),
        })?;
        Ok(Self { design: design? })
    }

    /// Arguments that make the design again, for `pickle`.
    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> Answer<Made<'py>> {
        let settings = PyDict::new(py);
        settings.set_item("first_index", self.design.first_index())?;
        settings.set_item("seed", self.design.seed())?;
        settings.set_item("pairs", matches!(self.design.order(), Order::Second))?;
        made(py, &self.design, self.design.blocks(), settings)
    }

    fn __repr__(&self) -> String {
        summary("SaltelliDesign", &self.design)
    }

    /// Returns the values of the inputs, (points, k).
    fn rows(&self, py: Python) -> Answer<Py<PyAny>> {
        rows(py, &self.design)
    }

    /// Estimates Sobol' indices with intervals from one output a row, NaN where the model failed.
    ///
    /// It warns where the intervals do not have their level: without a seed, or with fewer than 64 blocks.
    ///
    /// level: confidence of the intervals.
    /// resamples: number of resamples of the bootstrap.
    /// seed: seed of the bootstrap; 0 if left out, so that the same outputs have the same intervals.
    #[pyo3(signature = (outputs, *, level=0.95, resamples=1000, seed=None))]
    fn indices(
        &self,
        py: Python,
        outputs: Numbers,
        level: f64,
        resamples: usize,
        seed: Option<Bound<PyAny>>,
    ) -> Answer<SobolIndices> {
        let seed = seed.map_or(Ok(0), |seed| whole("seed", &seed))?;
        let (outputs, bootstrap) = (values(&outputs)?, Bootstrap { resamples, seed });
        let found = run(py, |_| sobol_indices(&self.design, &outputs, bootstrap, level))??;
        if !found.reliable {
            let message =
                c"intervals are an indication: they have their level with a seed, from 64 blocks on";
            PyErr::warn(py, &py.get_type::<PyUserWarning>(), message, 1)?;
        }
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
            input_blocks: found.inputs.iter().map(|index| index.blocks).collect(),
            reliable: found.reliable,
        })
    }
}

#[pymethods]
impl MorrisDesign {
    #[new]
    #[pyo3(signature = (inputs, blocks, *, seed, levels=None))]
    fn new(
        py: Python,
        inputs: &Bound<PyDict>,
        blocks: Bound<PyAny>,
        seed: Bound<PyAny>,
        levels: Option<Bound<PyAny>>,
    ) -> Answer<Self> {
        let (inputs, blocks, seed) = (laws(inputs)?, whole("blocks", &blocks)?, whole("seed", &seed)?);
        let levels: Option<u32> = levels.map(|levels| whole("levels", &levels)).transpose()?;
        let design = run(py, |_| match levels {
            Some(levels) => cdpr_sensitivity::MorrisDesign::trajectories(inputs, blocks, levels, seed),
            None => cdpr_sensitivity::MorrisDesign::radial(inputs, blocks, seed),
        })?;
        Ok(Self { design: design? })
    }

    /// Arguments that make the design again, for `pickle`.
    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> Answer<Made<'py>> {
        let settings = PyDict::new(py);
        settings.set_item("seed", self.design.seed())?;
        settings.set_item("levels", self.design.levels())?;
        made(py, &self.design, self.design.blocks(), settings)
    }

    fn __repr__(&self) -> String {
        summary("MorrisDesign", &self.design)
    }

    /// Returns the values of the inputs, (points, k).
    fn rows(&self, py: Python) -> Answer<Py<PyAny>> {
        rows(py, &self.design)
    }

    /// Estimates elementary effects from one output a row, NaN where the model failed, (points,).
    #[pyo3(signature = (outputs, *, level=0.95))]
    fn effects(&self, py: Python, outputs: Numbers, level: f64) -> Answer<MorrisEffects> {
        let outputs = values(&outputs)?;
        let found = run(py, |_| morris_effects(&self.design, &outputs, level))??;
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

/// Number of rows that a thread makes at a time.
const PART: usize = 1024;

/// Inputs from their laws, as they stand in study files: `{"uniform": {"min": .., "max": ..}}`.
fn laws(inputs: &Bound<PyDict>) -> Answer<Vec<Input>> {
    let input = |(name, law): (Bound<PyAny>, Bound<PyAny>)| -> Answer<Input> {
        let name: String = name.extract()?;
        let text = json_text(&format!("law of input `{name}`"), &law)?;
        let law =
            from_json(&text).map_err(|error| Raised::Input(format!("law of input `{name}`: {error}")))?;
        Ok(Input::continuous(name, law))
    };
    inputs.iter().map(input).collect()
}

/// Arguments that make a design again: by position and by name.
type Made<'py> = ((Bound<'py, PyDict>, usize), Bound<'py, PyDict>);

fn made<'py>(
    py: Python<'py>,
    design: &impl SampleDesign,
    size: usize,
    settings: Bound<'py, PyDict>,
) -> Answer<Made<'py>> {
    let (laws, loads) = (PyDict::new(py), py.import("json")?.getattr("loads")?);
    for input in design.inputs() {
        laws.set_item(&input.name, loads.call1((to_json(&input.law)?,))?)?;
    }
    Ok(((laws, size), settings))
}

fn summary(class: &str, design: &impl SampleDesign) -> String {
    format!("<cdpr.sensitivity.{class} of {} inputs, {} rows>", design.inputs().len(), design.points())
}

/// The seed of a scrambled sequence, which starts at index 0.
fn scrambling(seed: Option<Bound<PyAny>>, first_index: u32) -> Answer<Option<u64>> {
    match seed.map(|seed| whole("seed", &seed)).transpose()? {
        Some(_) if first_index > 0 => {
            Err(Raised::Input(format!("first_index is {first_index}: expected 0 where there is a seed")))
        }
        seed => Ok(seed),
    }
}

fn names(design: &impl SampleDesign) -> Vec<String> {
    design.inputs().iter().map(|input| input.name.clone()).collect()
}

fn rows(py: Python, design: &impl SampleDesign) -> Answer<Py<PyAny>> {
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
fn values(outputs: &Numbers) -> Answer<Vec<Option<f64>>> {
    let Array { shape, values } = Array::new("outputs", outputs)?;
    match shape[..] {
        [_] => Ok(values.into_iter().map(|value| (!value.is_nan()).then_some(value)).collect()),
        _ => Err(Raised::Input(format!("outputs has the shape {shape:?}: expected one output a row"))),
    }
}
