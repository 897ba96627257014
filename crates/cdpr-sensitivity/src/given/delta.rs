//! Borgonovo's δ: how much an input moves the density of the output.
//!
//! With f the density of all outputs and `f_m` that of the part m of the rows, cut by the values of input i,
//!
//! ```text
//! δ = E ∫ |f(y) - f(y | x_i)| dy / 2 ≈ Σ_m n_m / n · ∫ |f - f_m| dy / 2                (B1)
//! corrected:  δ_c = 2 δ - mean δ*                                                     (B2)
//! parts:  n^(2 / (7 + tanh((1500 - n) / 500))), at most 48                            (B3)
//! ```
//!
//! - (B1): E. Borgonovo, *A new uncertainty importance measure*, Reliab. Eng. Syst. Saf. 92 (2007). It lies
//!   between 0 (independent) and 1 and has no unit. It stays the same where the output is replaced by a
//!   monotonic function of it, but for the smoothing.
//! - The sum over parts, its correction (B2) by the mean over bootstrap resamples of the rows, and (B3):
//!   E. Plischke, E. Borgonovo, C. L. Smith, *Global sensitivity measures from given data*, Eur. J. Oper.
//!   Res. 226 (2013). Densities are Gaussian sums of Silverman's width, on a grid.
//! - The sum is above 0 without an effect, too; (B2) takes a part of this away. The level that 95 of 100
//!   inputs without an effect stay below is estimated by outputs dealt to the rows at random.

use rand::RngExt;
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

use crate::error::{SensitivityError, check_level};
use crate::given::data::GivenData;
use crate::given::rank::order;
use crate::parallel::*;
use crate::sample::interval::Estimate;
use crate::sample::random::{Bootstrap, stream};
use crate::sample::summary::Spread;

/// δ of one input.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Delta {
    /// Corrected estimate (B2) with the interval over the resamples.
    ///
    /// The interval shows the scatter alone. What smoothing and the width of the parts take away is not in it:
    /// with few hundred rows it is below the true δ of strong inputs (docs/STATISTICS.md).
    pub delta: Estimate,
    /// Corrected estimate that an input without an effect stays below in 95 of 100 tables.
    pub noise: f64,
}

/// Least number of rows.
pub const MIN_ROWS: usize = 20;
/// Points of the grid of densities.
const GRID: usize = 128;
/// Number of deals behind the level of the noise, and the place of that level among them.
const DEALS: usize = 39;
const LEVEL: usize = 38;

/// δ of all inputs, with intervals at a confidence `level` in (0, 1).
///
/// # Errors
/// - [`SensitivityError::OutOfRange`] for fewer than [`MIN_ROWS`] outputs or two resamples;
/// - [`SensitivityError::ConstantSample`] if all outputs are equal;
/// - [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
pub fn delta(data: &GivenData, bootstrap: Bootstrap, level: f64) -> Result<Vec<Delta>, SensitivityError> {
    let observed = data.observed(MIN_ROWS)?;
    of_columns(&observed.columns, &observed.outputs, bootstrap, level)
}

pub(crate) fn of_columns(
    columns: &[Vec<f64>],
    outputs: &[f64],
    bootstrap: Bootstrap,
    level: f64,
) -> Result<Vec<Delta>, SensitivityError> {
    check_level(level)?;
    crate::error::check_range("resamples", bootstrap.resamples as u64, 2, u64::MAX)?;
    let (n, grid) = (outputs.len(), Grid::new(outputs));
    let resample = |r: usize| {
        let mut generator = stream(bootstrap.seed, r as u64);
        let mut weights = vec![0.0; n];
        (0..n).for_each(|_| weights[generator.random_range(0..n)] += 1.0);
        weights
    };
    let resamples: Vec<Vec<f64>> = (0..bootstrap.resamples).map(resample).collect();
    let ones = vec![1.0; n];
    let corrected = |parts: &[usize], rows: &[usize]| {
        let value = grid.delta(parts, rows, &ones);
        let resampled: Vec<f64> = resamples.iter().map(|weights| grid.delta(parts, rows, weights)).collect();
        (2.0 * value - Spread::of(&resampled).mean, resampled)
    };
    let own: Vec<usize> = (0..n).collect();
    let parts: Vec<Vec<usize>> = columns.iter().map(|column| parts(column, bootstrap.seed)).collect();
    let noise_of = |parts: &[usize]| {
        let deal = |deal: usize| {
            let mut rows = own.clone();
            rows.shuffle(&mut stream(bootstrap.seed, (bootstrap.resamples + deal) as u64));
            corrected(parts, &rows).0
        };
        let mut deals: Vec<f64> = (0..DEALS).into_par_iter().map(deal).collect();
        deals.sort_unstable_by(f64::total_cmp);
        deals[LEVEL - 1]
    };
    // Inputs whose parts have the same sizes share their level.
    let mut levels: Vec<(Vec<usize>, f64)> = Vec::new();
    for parts in &parts {
        let sizes = sizes(parts);
        if !levels.iter().any(|(known, _)| *known == sizes) {
            levels.push((sizes, noise_of(parts)));
        }
    }
    let of_input = |parts: &Vec<usize>| {
        let (value, resampled) = corrected(parts, &own);
        let sizes = sizes(parts);
        let noise = levels.iter().find(|(known, _)| *known == sizes).map_or(0.0, |(_, level)| *level);
        Ok(Delta { delta: Estimate::of_resamples(value, &resampled, 0.0, n, level)?, noise })
    };
    parts.par_iter().map(of_input).collect()
}

/// Part of each row, of equal size (B3). An input of few values has a part for each.
fn parts(column: &[f64], seed: u64) -> Vec<usize> {
    let n = column.len();
    let size = n as f64;
    let count = size.powf(2.0 / (7.0 + ((1500.0 - size) / 500.0).tanh())).ceil().min(48.0) as usize;
    let order = order(column, seed, 0);
    let mut parts = vec![0; n];
    let levels = || order.chunk_by(|&i, &j| column[i] == column[j]);
    if levels().take(count + 1).count() <= count {
        for (part, rows) in levels().enumerate() {
            rows.iter().for_each(|&row| parts[row] = part);
        }
    } else {
        order.iter().enumerate().for_each(|(place, &row)| parts[row] = place * count / n);
    }
    parts
}

fn sizes(parts: &[usize]) -> Vec<usize> {
    let mut sizes = vec![0; parts.iter().max().map_or(0, |last| last + 1)];
    parts.iter().for_each(|&part| sizes[part] += 1);
    sizes
}

/// Outputs on a grid, from which densities are made.
struct Grid {
    /// Point below each output, and the share of it that falls on the next.
    places: Vec<(usize, f64)>,
}

/// Sums of outputs that share a density.
#[derive(Clone)]
struct Share {
    weight: f64,
    sum: f64,
    squares: f64,
    counts: Vec<f64>,
}

impl Share {
    fn none() -> Self {
        Self { weight: 0.0, sum: 0.0, squares: 0.0, counts: vec![0.0; GRID] }
    }

    fn add(&mut self, (place, next): (usize, f64), weight: f64) {
        let at = place as f64 + next;
        self.weight += weight;
        self.sum += weight * at;
        self.squares += weight * at * at;
        self.counts[place] += weight * (1.0 - next);
        self.counts[place + 1] += weight * next;
    }

    /// Masses of the smoothed density at the points of the grid. They add up to 1.
    fn density(&self) -> Vec<f64> {
        let mean = self.sum / self.weight;
        let variance = (self.squares / self.weight - mean * mean).max(0.0);
        let width = variance.sqrt() * (0.75 * self.weight).powf(-0.2);
        let kernel: Vec<f64> = (0..GRID)
            .map(|apart| if apart == 0 { 1.0 } else { (-0.5 * (apart as f64 / width).powi(2)).exp() })
            .collect();
        let reach = kernel.iter().take_while(|value| **value > 1e-9).count();
        let mut density = vec![0.0; GRID];
        for (at, count) in self.counts.iter().enumerate().filter(|(_, count)| **count > 0.0) {
            density[at] += count;
            for (apart, value) in kernel[..reach].iter().enumerate().skip(1) {
                let mass = count * value;
                if let Some(left) = at.checked_sub(apart) {
                    density[left] += mass;
                }
                if let Some(right) = density.get_mut(at + apart) {
                    *right += mass;
                }
            }
        }
        let total: f64 = density.iter().sum();
        density.iter_mut().for_each(|mass| *mass /= total);
        density
    }
}

impl Grid {
    /// The grid reaches one deviation beyond the outputs.
    fn new(outputs: &[f64]) -> Self {
        let margin = Spread::of(outputs).std();
        let low = outputs.iter().copied().fold(f64::INFINITY, f64::min) - margin;
        let high = outputs.iter().copied().fold(f64::NEG_INFINITY, f64::max) + margin;
        let step = (high - low) / (GRID - 1) as f64;
        let place = |y: &f64| {
            let at = (y - low) / step;
            let point = (at as usize).min(GRID - 2);
            (point, at - point as f64)
        };
        Self { places: outputs.iter().map(place).collect() }
    }

    /// δ (B1) of rows of these parts and weights, with the outputs of other rows.
    fn delta(&self, parts: &[usize], rows: &[usize], weights: &[f64]) -> f64 {
        let mut shares = vec![Share::none(); sizes(parts).len()];
        let mut all = Share::none();
        for ((&part, &row), &weight) in parts.iter().zip(rows).zip(weights) {
            shares[part].add(self.places[row], weight);
            all.add(self.places[row], weight);
        }
        let density = all.density();
        let distance = |share: &Share| -> f64 {
            let apart = share.density().into_iter().zip(&density).map(|(one, other)| (one - other).abs());
            0.5 * share.weight / all.weight * apart.sum::<f64>()
        };
        shares.iter().filter(|share| share.weight > 0.0).map(distance).sum()
    }
}
