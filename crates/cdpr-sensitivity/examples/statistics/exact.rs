//! Values that count as true, kept in `target/statistics/exact.json`: a function is computed once, and other
//! programs read its inputs and values there (`peers/statistics.py`).

use std::collections::BTreeMap;
use std::fs;

use cdpr_sensitivity::{
    Estimate, Input, MorrisDesign, SensitivityError, ShapleyDesign, morris_effects, observe, shapley_effects,
};
use serde::{Deserialize, Serialize};

use crate::functions::Function;
use crate::measures::indices;
use crate::tables::OfTables;

/// Blocks and walks behind the values that no formula gives.
const BLOCKS: usize = 1 << 18;

/// Relative error of the values that count as true. A judge's tolerance is a share of what it judges: an
/// absolute one would call every interval of a smaller index true.
pub(crate) const NEAR: f64 = 1e-3;

/// Whether an interval holds a value that counts as true.
pub(crate) fn holds(interval: &Estimate, exact: f64) -> bool {
    let near = NEAR * exact.abs();
    interval.low - near <= exact && exact <= interval.high + near
}

const FOLDER: &str = "target/statistics";
const FILE: &str = "target/statistics/exact.json";

/// Values of one function that count as true.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
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
    /// From the file, or computed and written to it; without the measures of tables if these are not known.
    pub(crate) fn of(function: &Function) -> Result<Self, SensitivityError> {
        let (point, output) = check(function);
        let formula = by_formula(function);
        // Those of this function, and of its formula.
        let same = |exact: &Self| {
            (&exact.inputs, &exact.point, exact.output) == (&function.inputs, &point, output)
                && formula
                    .as_ref()
                    .is_none_or(|(first, total)| (&exact.first, &exact.total) == (first, total))
        };
        if let Some(exact) = known().remove(function.name).filter(same) {
            return Ok(exact);
        }
        let mut exact = match additive(function) {
            Some(exact) => exact,
            None => sampled(function)?,
        };
        if let Some((first, total)) = formula {
            (exact.first, exact.total) = (first, total);
        }
        Self { point, output, inputs: function.inputs.clone(), ..exact }.kept(function)
    }

    /// The same with the measures of tables.
    pub(crate) fn with_tables(self, function: &Function) -> Result<Self, SensitivityError> {
        if self.tables != OfTables::default() {
            return Ok(self);
        }
        Self { tables: OfTables::of(function)?, ..self }.kept(function)
    }

    fn kept(self, function: &Function) -> Result<Self, SensitivityError> {
        let mut known = known();
        known.insert(function.name.to_owned(), self.clone());
        keep(&known);
        Ok(self)
    }
}

/// First-order and total indices, by their formula where there is one.
pub(crate) fn sobol_values(function: &Function) -> Result<(Vec<f64>, Vec<f64>), SensitivityError> {
    if let Some(values) = by_formula(function).or(additive(function).map(|exact| (exact.first, exact.total)))
    {
        return Ok(values);
    }
    let found = indices(function, BLOCKS, u64::MAX)?.inputs;
    Ok((found.iter().map(|of| of.first.value).collect(), found.iter().map(|of| of.total.value).collect()))
}

/// Indices of Bratley's function, whose last inputs matter where all before are near 1: so rarely that 2^18
/// blocks leave an error of several percent.
///
/// With `s_i` = ∓1, `R_i = s_i + x_(i+1) R_(i+1)` and the product P of the inputs before i, f has the part
/// `P x_i R_i`.
fn by_formula(function: &Function) -> Option<(Vec<f64>, Vec<f64>)> {
    if function.name != "Bratley" {
        return None;
    }
    let k = function.inputs.len();
    let (mut mean, mut square) = (vec![0.0; k + 1], vec![0.0; k + 1]);
    for i in (0..k).rev() {
        let sign = if i % 2 == 0 { -1.0 } else { 1.0 };
        mean[i] = sign + 0.5 * mean[i + 1];
        square[i] = 1.0 + sign * mean[i + 1] + square[i + 1] / 3.0;
    }
    let variance = square[0] / 3.0 - 0.25 * mean[0] * mean[0];
    let share =
        |i: usize, of_product: f64, of_rest: f64| of_product.powi(i as i32) * of_rest / 12.0 / variance;
    let first = (0..k).map(|i| share(i, 0.25, mean[i] * mean[i])).collect();
    let total = (0..k).map(|i| share(i, 1.0 / 3.0, square[i])).collect();
    Some((first, total))
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
    let [first, total] = [(); 2].map(|()| shares.clone());
    Some(Exact { first, total, shapley: shares, morris, ..Exact::default() })
}

fn sampled(function: &Function) -> Result<Exact, SensitivityError> {
    let found = indices(function, BLOCKS, u64::MAX)?;
    let design = ShapleyDesign::new(function.inputs.clone(), BLOCKS, u64::MAX)?;
    let shapley = shapley_effects(&design, &observe(&design, function.model)?, 0.95)?;
    let design = MorrisDesign::trajectories(function.inputs.clone(), BLOCKS / 4, 4, u64::MAX)?;
    let morris = morris_effects(&design, &observe(&design, function.model)?, 0.95)?;
    Ok(Exact {
        first: found.inputs.iter().map(|of| of.first.value).collect(),
        total: found.inputs.iter().map(|of| of.total.value).collect(),
        morris: morris.iter().map(|of| of.mean_absolute.value).collect(),
        shapley: shapley.iter().map(|of| of.effect.value).collect(),
        ..Exact::default()
    })
}
