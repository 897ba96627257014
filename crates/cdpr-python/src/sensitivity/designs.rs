//! Designs of experiments and their estimators. The classes of `designs.py` hold these; what is estimated
//! goes to them as JSON.

use crate::convert::{Answer, Numbers, Raised, run, to_json, whole};
use crate::sensitivity::expansion::Expansion;
use crate::sensitivity::independent::Independent;
use crate::sensitivity::observed::{Inputs, inputs, outputs, rows, slopes, vectors};
use cdpr_sensitivity::{
    Bootstrap, Correlated, Group, Order, SampleDesign, SensitivityError, SobolIndices, Truncation,
};
use pyo3::prelude::*;
use serde::Serialize;

/// A sample of the joint law of the inputs.
#[pyclass(frozen, module = "cdpr._core")]
pub(crate) struct Sample {
    points: Points,
}

enum Points {
    Independent(Independent),
    Correlated(Correlated<Independent>),
}

/// Blocks for Sobol' indices.
#[pyclass(frozen, module = "cdpr._core")]
pub(crate) struct Saltelli {
    design: cdpr_sensitivity::SaltelliDesign,
}

/// Blocks for elementary effects.
#[pyclass(frozen, module = "cdpr._core")]
pub(crate) struct Morris {
    design: cdpr_sensitivity::MorrisDesign,
}

/// Walks for Shapley effects.
#[pyclass(frozen, module = "cdpr._core")]
pub(crate) struct Shapley {
    design: cdpr_sensitivity::ShapleyDesign,
}

/// Groups as `designs.py` makes them: name and indices of inputs.
type Groups = Vec<(String, Vec<usize>)>;

fn groups(given: Groups) -> Vec<Group> {
    given.into_iter().map(|(name, inputs)| Group { name, inputs }).collect()
}

fn seed_of(seed: Option<Bound<PyAny>>) -> Answer<Option<u64>> {
    seed.map(|seed| whole("seed", &seed)).transpose()
}

/// What is estimated on all cores without Python's lock, as JSON.
fn found<T: Serialize + Send>(
    py: Python,
    estimate: impl FnOnce() -> Result<T, SensitivityError> + Send,
) -> Answer<String> {
    to_json(&run(py, |_| estimate())??)
}

#[pymethods]
impl Sample {
    #[new]
    fn new(
        py: Python,
        kind: &str,
        given: Inputs,
        points: Bound<PyAny>,
        first_index: Bound<PyAny>,
        seed: Option<Bound<PyAny>>,
        correlation: Option<Vec<Vec<f64>>>,
    ) -> Answer<Self> {
        let (inputs, points) = (inputs(&given)?, whole("points", &points)?);
        let (first_index, seed) = (whole("first_index", &first_index)?, seed_of(seed)?);
        let design = run(py, |_| Independent::new(kind, inputs, points, first_index, seed))??;
        let points = match correlation {
            None => Points::Independent(design),
            Some(matrix) => Points::Correlated(Correlated::new(design, &matrix)?),
        };
        Ok(Self { points })
    }

    fn size(&self) -> usize {
        match &self.points {
            Points::Independent(design) => design.points(),
            Points::Correlated(design) => design.points(),
        }
    }

    fn rows(&self, py: Python) -> Answer<Py<PyAny>> {
        match &self.points {
            Points::Independent(design) => rows(py, design),
            Points::Correlated(design) => rows(py, design),
        }
    }

    fn effects(&self, py: Python, given: Numbers) -> Answer<String> {
        let (design, outputs) = (self.independent("effects")?, outputs(&given)?);
        found(py, || cdpr_sensitivity::student_effects(design, &outputs))
    }

    fn regression(&self, py: Python, given: Numbers, ranks: bool) -> Answer<String> {
        use cdpr_sensitivity::{rank_regression, regression};
        let outputs = outputs(&given)?;
        found(py, || match (&self.points, ranks) {
            (Points::Independent(design), false) => regression(design, &outputs),
            (Points::Independent(design), true) => rank_regression(design, &outputs),
            (Points::Correlated(design), false) => regression(design, &outputs),
            (Points::Correlated(design), true) => rank_regression(design, &outputs),
        })
    }

    fn expansion(
        &self,
        py: Python,
        given: Numbers,
        max_degree: usize,
        norm: f64,
        interactions: usize,
    ) -> Answer<Expansion> {
        let (design, outputs) = (self.independent("expansion")?, outputs(&given)?);
        let truncation = Truncation { max_degree, norm, interactions };
        let expansion = run(py, |_| cdpr_sensitivity::expansion(design, &outputs, truncation))??;
        Ok(Expansion { expansion })
    }

    #[allow(clippy::too_many_arguments)]
    fn gradient_expansion(
        &self,
        py: Python,
        given: Numbers,
        gradients: Numbers,
        max_degree: usize,
        norm: f64,
        interactions: usize,
    ) -> Answer<Expansion> {
        let design = self.independent("gradient_expansion")?;
        let slopes = slopes(&given, &gradients, design.inputs().len())?;
        let truncation = Truncation { max_degree, norm, interactions };
        let expansion = run(py, |_| cdpr_sensitivity::gradient_expansion(design, &slopes, truncation))??;
        Ok(Expansion { expansion })
    }

    fn derivative_measures(
        &self,
        py: Python,
        given: Numbers,
        gradients: Numbers,
        level: f64,
    ) -> Answer<String> {
        let design = self.independent("derivative_measures")?;
        let slopes = slopes(&given, &gradients, design.inputs().len())?;
        found(py, || cdpr_sensitivity::dgsm(design, &slopes, level))
    }

    fn brackets(
        &self,
        py: Python,
        given: Numbers,
        gradients: Numbers,
        level: f64,
        seed: Bound<PyAny>,
    ) -> Answer<String> {
        let (design, seed) = (self.independent("brackets")?, whole("seed", &seed)?);
        let slopes = slopes(&given, &gradients, design.inputs().len())?;
        found(py, || cdpr_sensitivity::brackets(design, &slopes, level, seed))
    }

    /// The subspace, and for each share of the sum of eigenvalues the number of directions that have it.
    #[allow(clippy::too_many_arguments)]
    fn active_subspace(
        &self,
        py: Python,
        given: Numbers,
        gradients: Numbers,
        shares: Vec<f64>,
        level: f64,
        resamples: Bound<PyAny>,
        seed: Bound<PyAny>,
    ) -> Answer<(String, Vec<[usize; 3]>)> {
        let design = self.independent("active_subspace")?;
        let slopes = slopes(&given, &gradients, design.inputs().len())?;
        let bootstrap = bootstrap(&resamples, &seed)?;
        let subspace = run(py, |_| cdpr_sensitivity::active_subspace(design, &slopes, bootstrap, level))??;
        let needed = shares.iter().map(|&share| subspace.needed(share, level));
        Ok((to_json(&subspace)?, needed.collect::<Result<_, _>>()?))
    }
}

impl Sample {
    /// The design, if its inputs are independent.
    fn independent(&self, estimator: &str) -> Answer<&Independent> {
        match &self.points {
            Points::Independent(design) => Ok(design),
            Points::Correlated(_) => Err(Raised::Input(format!(
                "correlation is given: `{estimator}` expects independent inputs; of correlated ones there are \
                 `regression` and ShapleyDesign"
            ))),
        }
    }
}

fn bootstrap(resamples: &Bound<PyAny>, seed: &Bound<PyAny>) -> Answer<Bootstrap> {
    Ok(Bootstrap { resamples: whole("resamples", resamples)?, seed: whole("seed", seed)? })
}

#[pymethods]
impl Saltelli {
    #[new]
    fn new(
        py: Python,
        given: Inputs,
        blocks: Bound<PyAny>,
        seed: Option<Bound<PyAny>>,
        pairs: bool,
        first_index: Bound<PyAny>,
        grouped: Option<Groups>,
    ) -> Answer<Self> {
        let (inputs, blocks, seed) = (inputs(&given)?, whole("blocks", &blocks)?, seed_of(seed)?);
        let first_index: u32 = whole("first_index", &first_index)?;
        let order = if pairs { Order::Second } else { Order::First };
        if seed.is_some() && first_index > 0 {
            let message = format!("first_index is {first_index}: expected 0 where there is a seed");
            return Err(Raised::Input(message));
        }
        let design = run(py, |_| {
            let design = match seed {
                None => cdpr_sensitivity::SaltelliDesign::new(inputs, first_index, blocks, order),
                Some(seed) => cdpr_sensitivity::SaltelliDesign::scrambled(inputs, blocks, order, seed),
            }?;
            grouped.map_or(Ok(design.clone()), |grouped| design.grouped(groups(grouped)))
        })?;
        Ok(Self { design: design? })
    }

    fn size(&self) -> usize {
        self.design.points()
    }

    fn rows(&self, py: Python) -> Answer<Py<PyAny>> {
        rows(py, &self.design)
    }

    fn indices(
        &self,
        py: Python,
        given: Numbers,
        level: f64,
        resamples: Bound<PyAny>,
        seed: Bound<PyAny>,
    ) -> Answer<String> {
        let (outputs, bootstrap) = (outputs(&given)?, bootstrap(&resamples, &seed)?);
        found(py, || cdpr_sensitivity::sobol_indices(&self.design, &outputs, bootstrap, level))
    }

    fn vector_indices(
        &self,
        py: Python,
        given: Numbers,
        level: f64,
        resamples: Bound<PyAny>,
        seed: Bound<PyAny>,
    ) -> Answer<String> {
        let (outputs, bootstrap) = (vectors(&given)?, bootstrap(&resamples, &seed)?);
        found(py, || cdpr_sensitivity::vector_sobol_indices(&self.design, &outputs, bootstrap, level))
    }

    fn convergence(
        &self,
        py: Python,
        given: Numbers,
        level: f64,
        resamples: Bound<PyAny>,
        seed: Bound<PyAny>,
    ) -> Answer<String> {
        let (outputs, bootstrap) = (outputs(&given)?, bootstrap(&resamples, &seed)?);
        found(py, || -> Result<Vec<SobolIndices>, _> {
            cdpr_sensitivity::convergence(&self.design, &outputs, bootstrap, level)
        })
    }
}

#[pymethods]
impl Morris {
    #[new]
    fn new(
        py: Python,
        given: Inputs,
        blocks: Bound<PyAny>,
        seed: Bound<PyAny>,
        levels: Option<Bound<PyAny>>,
        grouped: Option<Groups>,
    ) -> Answer<Self> {
        let (inputs, blocks, seed) = (inputs(&given)?, whole("blocks", &blocks)?, whole("seed", &seed)?);
        let levels: Option<u32> = levels.map(|levels| whole("levels", &levels)).transpose()?;
        let design = run(py, |_| {
            let design = match levels {
                Some(levels) => cdpr_sensitivity::MorrisDesign::trajectories(inputs, blocks, levels, seed),
                None => cdpr_sensitivity::MorrisDesign::radial(inputs, blocks, seed),
            }?;
            grouped.map_or(Ok(design.clone()), |grouped| design.grouped(groups(grouped)))
        })?;
        Ok(Self { design: design? })
    }

    fn size(&self) -> usize {
        self.design.points()
    }

    fn rows(&self, py: Python) -> Answer<Py<PyAny>> {
        rows(py, &self.design)
    }

    fn effects(&self, py: Python, given: Numbers, level: f64) -> Answer<String> {
        let outputs = outputs(&given)?;
        found(py, || cdpr_sensitivity::morris_effects(&self.design, &outputs, level))
    }
}

#[pymethods]
impl Shapley {
    #[new]
    fn new(
        py: Python,
        given: Inputs,
        walks: Bound<PyAny>,
        seed: Bound<PyAny>,
        correlation: Option<Vec<Vec<f64>>>,
        grouped: Option<Groups>,
    ) -> Answer<Self> {
        let (inputs, walks, seed) = (inputs(&given)?, whole("walks", &walks)?, whole("seed", &seed)?);
        let design = run(py, |_| {
            let mut design = cdpr_sensitivity::ShapleyDesign::new(inputs, walks, seed)?;
            if let Some(matrix) = correlation {
                design = design.correlated(&matrix)?;
            }
            grouped.map_or(Ok(design.clone()), |grouped| design.grouped(groups(grouped)))
        })?;
        Ok(Self { design: design? })
    }

    fn size(&self) -> usize {
        self.design.points()
    }

    fn rows(&self, py: Python) -> Answer<Py<PyAny>> {
        rows(py, &self.design)
    }

    fn effects(&self, py: Python, given: Numbers, level: f64) -> Answer<String> {
        let outputs = outputs(&given)?;
        found(py, || cdpr_sensitivity::shapley_effects(&self.design, &outputs, level))
    }
}

/// Intervals of effects from the outputs of several samples that differ in their seeds, as JSON.
#[pyfunction]
pub(crate) fn effect_intervals(
    py: Python,
    samples: Vec<Py<Sample>>,
    given: Vec<Numbers>,
    level: f64,
) -> Answer<String> {
    let replicate = |(sample, given): (&Py<Sample>, &Numbers)| -> Answer<_> {
        let design = sample.get().independent("effect_intervals")?.clone();
        Ok(cdpr_sensitivity::Replicate { design, outputs: outputs(given)? })
    };
    let replicates = samples.iter().zip(&given).map(replicate).collect::<Answer<Vec<_>>>()?;
    found(py, || cdpr_sensitivity::effect_intervals(&replicates, level))
}
