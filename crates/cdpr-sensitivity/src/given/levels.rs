//! Inputs of few levels, or of words: the mean output at each level, and the share of the variance between
//! them.
//!
//! With m levels of `n_l` rows, their means `y_l`, and the variance V of all n outputs (n - 1),
//!
//! ```text
//! S = 1 - θ,   θ = Σ (y_i - y_l(i))² / ((n - m) V)                                   (Le1)
//! u_i = (y_i - y_l(i))² n / (n - m) - θ (y_i - ȳ)²                                   (Le2)
//! Var θ = Σ u_i² / (n (n - m) V²) + 2 (m - 1) θ² / n²                                (Le3)
//! f = (n - m) min(1, 3 n* / n),   n* = (Σ (y - ȳ)²)² / Σ (y - ȳ)⁴                    (Le4)
//! ```
//!
//! (Le1) is the correlation ratio, corrected for chance: 0 in the mean without an effect (T. L. Kelley, *An
//! unbiased correlation ratio measure*, Proc. Natl. Acad. Sci. 21, 1935). (Le3) is its variance to the first
//! order and, without an effect, that of a quotient of χ². The interval is from `1 - θ exp(h / θ)` to
//! `1 - θ + h`, with `h = t √(Var θ)` and f degrees of freedom: fewer where few rows decide the variance.

use serde::{Deserialize, Serialize};

use crate::error::SensitivityError;
use crate::sample::interval::{Estimate, effective};
use crate::sample::summary::Spread;

/// The outputs at one level of an input.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct LevelMean {
    /// The level.
    pub level: String,
    /// Number of its rows.
    pub rows: usize,
    /// Mean of their outputs, in the unit of the output.
    pub mean: f64,
}

/// Largest number of levels that an input of numbers has a share by levels for.
const MOST: usize = 10;
/// Least number of rows beyond that of the levels.
const LEAST_FREEDOMS: usize = 5;

/// Number and mean of the outputs of each level, by its code.
fn means(codes: &[usize], outputs: &[f64]) -> Vec<(usize, f64)> {
    let count = codes.iter().max().map_or(0, |most| most + 1);
    let mut sums = vec![(0, 0.0); count];
    for (&code, y) in codes.iter().zip(outputs) {
        sums[code] = (sums[code].0 + 1, sums[code].1 + y);
    }
    sums.into_iter().map(|(rows, sum)| (rows, sum / rows as f64)).collect()
}

/// The levels of an input of words that occur, in the order of their labels.
pub(crate) fn of_labels(labels: &[String], column: &[f64], outputs: &[f64]) -> Vec<LevelMean> {
    let codes: Vec<usize> = column.iter().map(|&code| code as usize).collect();
    let level =
        |(label, (rows, mean)): (&String, (usize, f64))| LevelMean { level: label.clone(), rows, mean };
    labels.iter().zip(means(&codes, outputs)).filter(|(_, (rows, _))| *rows > 0).map(level).collect()
}

/// Code of the level of each value, from 0, and their number.
pub(crate) fn codes(column: &[f64]) -> (Vec<usize>, usize) {
    let mut levels = column.to_vec();
    levels.sort_unstable_by(f64::total_cmp);
    levels.dedup();
    let code = |x: &f64| levels.partition_point(|level| level < x);
    (column.iter().map(code).collect(), levels.len())
}

/// Whether the share of an input is that between its levels: words, or few numbers.
pub(crate) fn has_levels(column: &[f64], words: bool) -> bool {
    let (_, count) = codes(column);
    (words || count <= MOST) && column.len() >= count + LEAST_FREEDOMS
}

/// Share (Le1) with its interval, of an input that [`has_levels`].
pub(crate) fn share(column: &[f64], outputs: &[f64], level: f64) -> Result<Estimate, SensitivityError> {
    let (codes, m) = codes(column);
    let means = means(&codes, outputs);
    let spread = Spread::of(outputs);
    let (n, variance) = (outputs.len() as f64, spread.variance());
    let freedoms = n - m as f64;
    let within = |(&code, y): (&usize, &f64)| (y - means[code].1).powi(2);
    let squares: Vec<f64> = codes.iter().zip(outputs).map(within).collect();
    let noise = squares.iter().sum::<f64>() / (freedoms * variance);
    let squared: Vec<f64> = outputs.iter().map(|y| (y - spread.mean).powi(2)).collect();
    let sum = |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
    let [own, both, other] = [sum(&squares, &squares), sum(&squares, &squared), sum(&squared, &squared)]
        .map(|of| of / variance.powi(2));
    let scale = n / freedoms;
    let terms = (scale * scale * own - 2.0 * noise * scale * both + noise * noise * other).max(0.0);
    let of_noise = terms / (n * freedoms) + 2.0 * (m as f64 - 1.0) * (noise / n).powi(2);
    let freedoms = freedoms * (3.0 * effective(&squared) / n).min(1.0);
    let estimate = Estimate::of_variance(1.0 - noise, of_noise, freedoms.max(1.0), level)?;
    let half = estimate.high - estimate.value;
    let low = if noise > 0.0 { 1.0 - noise * (half / noise).exp() } else { estimate.low };
    Ok(Estimate { low, ..estimate })
}
