//! Laws of inputs, and laws fitted to a sample.

use crate::convert::{Answer, Array, Numbers, Raised, guarded, run, to_json, whole};
use crate::sensitivity::observed::{outputs, read};
use cdpr_sensitivity::{BestFit, Bootstrap, Family, Fit, Law, fit, fit_all, poincare_constant};
use numpy::{IxDyn, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use serde::Serialize;

/// A function of a law at each value of an array.
#[pyfunction]
pub(crate) fn law_values(py: Python, law: Bound<PyAny>, of: &str, values: Numbers) -> Answer<Py<PyAny>> {
    let law: Law = read("law", &law)?;
    law.validate()?;
    let Array { shape, values } = Array::new("values", &values)?;
    let function: fn(&Law, f64) -> f64 = match of {
        "cdf" => Law::cdf,
        "pdf" => |law, x| law.ln_pdf(x).exp(),
        "quantile" => {
            if let Some(u) = values.iter().find(|u| !(0.0..=1.0).contains(*u)) {
                return Err(Raised::Input(format!("u is {u}: expected a probability from 0 to 1")));
            }
            Law::quantile
        }
        _ => return Err(Raised::Input(format!("{of:?}: expected cdf, pdf or quantile"))),
    };
    let values = guarded(|| values.iter().map(|&value| function(&law, value)).collect())?;
    Ok(PyArray1::from_vec(py, values).reshape(IxDyn(&shape))?.into_any().unbind())
}

/// Mean, standard deviation and constant of Poincaré's inequality.
#[pyfunction]
pub(crate) fn law_moments(law: Bound<PyAny>) -> Answer<(f64, f64, Option<f64>)> {
    let law: Law = read("law", &law)?;
    law.validate()?;
    guarded(|| (law.mean(), law.std(), poincare_constant(&law)))
}

#[derive(Serialize)]
struct Fitted {
    fits: Vec<Fit>,
    best: Option<BestFit>,
    /// The same in words.
    verdict: Option<String>,
}

/// Laws fitted to a sample, of one family or of all that apply, as JSON.
#[pyfunction]
pub(crate) fn fit_laws(
    py: Python,
    values: Numbers,
    family: Option<Bound<PyAny>>,
    resamples: Bound<PyAny>,
    seed: Bound<PyAny>,
) -> Answer<String> {
    let bootstrap = Bootstrap { resamples: whole("resamples", &resamples)?, seed: whole("seed", &seed)? };
    let family: Option<Family> = family.map(|family| read("family", &family)).transpose()?;
    let values = outputs(&values)?;
    let fitted = run(py, |_| {
        let sample = cdpr_sensitivity::Sample::new(&values)?;
        let fits = match family {
            Some(family) => vec![fit(&sample, family, bootstrap)?],
            None => fit_all(&sample, bootstrap)?,
        };
        let best = BestFit::of(&fits);
        let verdict = best.map(|best| best.to_string());
        Ok::<_, cdpr_sensitivity::SensitivityError>(Fitted { fits, best, verdict })
    })??;
    to_json(&fitted)
}

/// Factors of tolerances that leave a variance at the least cost.
#[pyfunction]
pub(crate) fn allocate(py: Python, variances: Vec<f64>, costs: Vec<f64>, target: f64) -> Answer<Py<PyAny>> {
    let factors = guarded(|| cdpr_sensitivity::allocate(&variances, &costs, target))??;
    Ok(PyArray1::from_vec(py, factors).into_any().unbind())
}
