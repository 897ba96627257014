//! Values that count as true, kept in `target/statistics/exact.json`: a function is computed once, and other
//! programs read its inputs and values there (`xtask/peers/statistics.py`).

use std::collections::BTreeMap;
use std::fs;

use cdpr_sensitivity::{
    Input, MorrisDesign, SensitivityError, ShapleyDesign, morris_effects, observe, shapley_effects,
};
use serde::{Deserialize, Serialize};

use crate::functions::Function;
use crate::indices::indices;
use crate::tables::OfTables;

/// Blocks and walks behind the values that no formula gives.
const BLOCKS: usize = 1 << 18;

const FOLDER: &str = "target/statistics";
const FILE: &str = "target/statistics/exact.json";

/// Values of one function that count as true.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Exact {
    inputs: Vec<Input>,
    /// A point, and the output there: other values are of another function.
    point: Vec<f64>,
    output: Option<f64>,
    /// First-order and total Sobol' indices.
    pub(crate) first: Vec<f64>,
    pub(crate) total: Vec<f64>,
    /// Morris's μ* on four levels.
    pub(crate) morris: Vec<f64>,
    pub(crate) shapley: Vec<f64>,
    /// Measures of tables.
    #[serde(default)]
    pub(crate) tables: OfTables,
}

impl Exact {
    /// From the file, or computed and written to it.
    pub(crate) fn of(function: &Function) -> Result<Self, SensitivityError> {
        let mut known = known();
        let (point, output) = check(function);
        let same =
            |exact: &Self| (&exact.inputs, &exact.point, exact.output) == (&function.inputs, &point, output);
        let mut exact = match known.remove(function.name).filter(same) {
            Some(exact) if exact.tables != OfTables::default() => return Ok(exact),
            Some(exact) => exact,
            None => match additive(function) {
                Some(exact) => exact,
                None => sampled(function)?,
            },
        };
        exact.tables = OfTables::of(function)?;
        let exact = Self { point, output, inputs: function.inputs.clone(), ..exact };
        known.insert(function.name.to_owned(), exact.clone());
        keep(&known);
        Ok(exact)
    }
}

fn known() -> BTreeMap<String, Exact> {
    fs::read_to_string(FILE).ok().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
}

fn keep(known: &BTreeMap<String, Exact>) {
    let written = serde_json::to_string_pretty(known)
        .map_err(std::io::Error::from)
        .and_then(|text| fs::create_dir_all(FOLDER).and_then(|()| fs::write(FILE, text)));
    if let Err(error) = written {
        println!("{FILE}: {error}");
    }
}

/// A point that is nowhere special, and the output there.
fn check(function: &Function) -> (Vec<f64>, Option<f64>) {
    let at = |(i, input): (usize, &Input)| input.law.quantile(((i + 1) as f64 * 0.618).fract());
    let point: Vec<f64> = function.inputs.iter().enumerate().map(at).collect();
    let output = (function.model)(&point);
    (point, output)
}

/// Values of a sum Σ x_i / i of uniform inputs from 0 to 1.
fn additive(function: &Function) -> Option<Exact> {
    if function.name != "additive, 100" {
        return None;
    }
    let morris: Vec<f64> = (1..=function.inputs.len()).map(|i| 1.0 / i as f64).collect();
    let whole: f64 = morris.iter().map(|slope| slope * slope).sum();
    let shares: Vec<f64> = morris.iter().map(|slope| slope * slope / whole).collect();
    Some(Exact {
        inputs: vec![],
        point: vec![],
        output: None,
        first: shares.clone(),
        total: shares.clone(),
        shapley: shares,
        morris,
        tables: OfTables::default(),
    })
}

fn sampled(function: &Function) -> Result<Exact, SensitivityError> {
    let found = indices(function, BLOCKS, u64::MAX)?;
    let design = ShapleyDesign::new(function.inputs.clone(), BLOCKS, u64::MAX)?;
    let shapley = shapley_effects(&design, &observe(&design, function.model)?, 0.95)?;
    let design = MorrisDesign::trajectories(function.inputs.clone(), BLOCKS / 4, 4, u64::MAX)?;
    let morris = morris_effects(&design, &observe(&design, function.model)?, 0.95)?;
    Ok(Exact {
        inputs: vec![],
        point: vec![],
        output: None,
        first: found.inputs.iter().map(|of| of.first.value).collect(),
        total: found.inputs.iter().map(|of| of.total.value).collect(),
        morris: morris.iter().map(|of| of.mean_absolute.value).collect(),
        shapley: shapley.iter().map(|of| of.effect.value).collect(),
        tables: OfTables::default(),
    })
}
