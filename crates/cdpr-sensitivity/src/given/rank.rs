//! First-order Sobol' indices of a table, by the ranks of each input.
//!
//! With the outputs in ascending order of input i,
//!
//! ```text
//! S_i = 1 - Σ (y_(j+1) - y_(j))² / (2 (n - 1) V),   V = Σ (y - ȳ)² / (n - 1)          (K2)
//! u_j = (y_(j+1) - y_(j))² / 2 - (1 - S) ((y_(j) - ȳ)² + (y_(j+1) - ȳ)²) / 2          (K3)
//! s² = γ_0 + 2 (γ_1 - (γ_2 + γ_3 + γ_4) / 3),   s² >= γ_0 / 4                          (K4)
//! Var S = max(s² / (V² (n - 8)), (1 - S)² / (2 n)),   with Student's factor of n / 8        (K5)
//! ```
//!
//! - (K2): two rows that are neighbours in x have nearly the same conditional mean, so that their difference
//!   shows what the other inputs cause. Up to the terms of the two ends it is the estimator of F. Gamboa, P.
//!   Gremaud, T. Klein, A. Lagnoux, *Global sensitivity analysis: a novel generation of mighty estimators
//!   based on rank statistics*, Bernoulli 28 (2022), with a bias of the order 1 / n² for smooth models; the
//!   sum is that of J. von Neumann (1941), whose mean is exactly 2 (n - 1) V without any dependence.
//! - (K4) leads to its variance to the first order. `γ_k` is the covariance of u at k places apart:
//!   neighbours share an output, and from two places apart on only the part is left that x itself causes. The
//!   bootstrap fails for statistics of ranks: Z. Lin, F. Han, *On the failure of the bootstrap for
//!   Chatterjee's rank correlation*, Biometrika 111 (2024). (K5) allows for few rows; (1 - S)² / n is the
//!   variance without an effect. `cargo xtask statistics given` counts how often the intervals hold the
//!   index.
//!
//! The inputs must be independent of each other: what a correlated input causes is counted for both. Rows of
//! equal values of an input are put into random order. No unit.

use rand::seq::SliceRandom;

use crate::design::observation::Observed;
use crate::error::{SensitivityError, check_level};
use crate::given::data::GivenData;
use crate::parallel::*;
use crate::sample::interval::Estimate;
use crate::sample::random::stream;
use crate::sample::summary::Spread;

/// Least number of rows.
pub const MIN_ROWS: usize = 30;

/// First-order index (K2) of each input with its interval at a confidence `level` in (0, 1).
///
/// # Errors
/// - [`SensitivityError::OutOfRange`] for fewer than [`MIN_ROWS`] outputs;
/// - [`SensitivityError::ConstantSample`] if all outputs are equal;
/// - [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
pub fn rank_indices(data: &GivenData, level: f64, seed: u64) -> Result<Vec<Estimate>, SensitivityError> {
    of_observed(&data.observed(MIN_ROWS)?, level, seed)
}

pub(crate) fn of_observed(
    observed: &Observed,
    level: f64,
    seed: u64,
) -> Result<Vec<Estimate>, SensitivityError> {
    check_level(level)?;
    let of_input = |(input, column): (usize, &Vec<f64>)| {
        let sorted: Vec<f64> =
            order(column, seed, input).into_iter().map(|row| observed.outputs[row]).collect();
        of_sorted(&sorted, level)
    };
    observed.columns.par_iter().enumerate().map(of_input).collect()
}

/// Rows in ascending order of values; those of equal values are in random order.
pub(crate) fn order(values: &[f64], seed: u64, input: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.shuffle(&mut stream(seed, input as u64));
    order.sort_by(|&i, &j| values[i].total_cmp(&values[j]));
    order
}

/// The index (K2) and its interval, from the outputs in the order of an input.
fn of_sorted(y: &[f64], level: f64) -> Result<Estimate, SensitivityError> {
    let spread = Spread::of(y);
    let (n, variance) = (y.len(), spread.variance());
    let square = |deviation: f64| deviation * deviation;
    let differences: f64 = y.windows(2).map(|pair| 0.5 * square(pair[1] - pair[0])).sum();
    let noise = differences / ((n - 1) as f64 * variance);
    let term = |pair: &[f64]| {
        let [low, high] = [pair[0] - spread.mean, pair[1] - spread.mean];
        0.5 * square(high - low) - 0.5 * noise * (low * low + high * high)
    };
    let mut terms: Vec<f64> = y.windows(2).map(term).collect();
    let mean = terms.iter().sum::<f64>() / terms.len() as f64;
    terms.iter_mut().for_each(|term| *term -= mean);
    let covariance = |apart: usize| {
        terms.iter().zip(&terms[apart..]).map(|(one, other)| one * other).sum::<f64>() / terms.len() as f64
    };
    let own = covariance(0);
    let far = (covariance(2) + covariance(3) + covariance(4)) / 3.0;
    // Few rows may give a difference below zero.
    let sum = (own + 2.0 * (covariance(1) - far)).max(0.25 * own) / (variance * variance);
    let size = n as f64;
    let variance = (sum / (size - 8.0)).max(0.5 * noise * noise / size);
    Estimate::of_variance(1.0 - noise, variance, size / 8.0, level)
}
