//! First-order Sobol' indices of a table, by the ranks of each input.
//!
//! With the outputs in ascending order of input i,
//!
//! ```text
//! S_i = 1 - θ,   θ = (Σ d_j + (d_1 + d_(n-1)) / 2) / (n V),   d_j = (y_(j+1) - y_(j))² / 2
//! V = Σ (y - ȳ)² / (n - 1)                                                               (Ra2)
//! u_j = d_j - θ ((y_(j) - ȳ)² + (y_(j+1) - ȳ)²) / 2                                      (Ra3)
//! s² = γ_0 + 2 (γ_1 - (γ_2 + γ_3 + γ_4) / 3),   s² >= γ_0 / 4                            (Ra4)
//! Var θ = max(s² / (V² (n - 8)), θ² / n)                                                 (Ra5)
//! f = min(n, 3 n*) / 8,   n* = (Σ (y - ȳ)²)² / Σ (y - ȳ)⁴                                (Ra6)
//! ```
//!
//! - (Ra2): two rows that are neighbours in x have nearly the same conditional mean, so that their difference
//!   shows what the other inputs cause. It is the estimator of F. Gamboa, P. Gremaud, T. Klein, A. Lagnoux,
//!   *Global sensitivity analysis: a novel generation of mighty estimators based on rank statistics*,
//!   Bernoulli 28 (2022), up to the two ends: they join the last row to the first, whereas here the outer
//!   differences count one and a half times, so that every row counts once. The bias is of the order 1 / n²
//!   for smooth models; the sum is that of J. von Neumann (1941), and θ is 1 in the mean without any
//!   dependence.
//! - (Ra4) leads to its variance to the first order. `γ_k` is the covariance of u at k places apart:
//!   neighbours share an output, and from two places apart on only the part is left that x itself causes. The
//!   bootstrap fails for statistics of ranks: Z. Lin, F. Han, *On the failure of the bootstrap for
//!   Chatterjee's rank correlation*, Biometrika 111 (2024).
//! - (Ra5): with σ²(x) the variance of y given x, n V² Var θ is the variance of
//!   `(y - E (y | x))² - θ (y - ȳ)²` plus `E σ⁴(x) >= (E σ²(x))² = θ² V²` (Jensen's inequality).
//!   No estimate is below that; without an effect it is the variance itself.
//! - The interval is (CI7) of [`interval`](crate::sample::interval), with (Ra5) at each θ. The 8 and
//!   Student's factor of f degrees of freedom allow for few rows: n / 8 for normal outputs and those of
//!   shorter tails. `n*` is the number of equally large deviations whose mean square scatters as that of the
//!   outputs does (Ra6). Where few rows decide the variance, as of a lognormal output, the interval may hold
//!   all from 0 to 1.
//!
//! `cargo xtask statistics given` counts how often the intervals hold the index.
//!
//! The rows must be independent of each other: those of a sequence of low discrepancy are refused
//! (`rank/rows.rs`).
//!
//! The inputs must be independent of each other: what a correlated input causes is counted for both. Rows of
//! equal values of an input are put into random order. No unit.

pub(crate) mod rows;

use crate::design::observation::Observed;
use crate::error::{SensitivityError, check_level, check_range};
use crate::given::data::GivenData;
use crate::given::rank::rows::{Patterns, order};
use crate::parallel::*;
use crate::sample::interval::{Estimate, effective};
use crate::sample::summary::Spread;

/// Least number of rows.
pub const MIN_ROWS: usize = 30;

/// Why rows of a sequence have none.
pub(crate) const OF_SEQUENCE: &str =
    "shares by ranks need independent rows, and these are of a sequence (Sobol', Halton)";

/// First-order index (Ra2) of each input with its interval at a confidence `level` in (0, 1).
///
/// # Errors
/// - [`SensitivityError::OutOfRange`] for fewer than [`MIN_ROWS`] outputs;
/// - [`SensitivityError::DependentRows`] for rows that depend on each other (`rows`);
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
    check_range("observed outputs", observed.outputs.len() as u64, MIN_ROWS as u64, u64::MAX)?;
    let columns: Vec<&[f64]> = observed.columns.iter().map(Vec::as_slice).collect();
    Patterns::new(&columns, seed).check()?;
    let of_input = |(input, column): (usize, &Vec<f64>)| {
        let sorted: Vec<f64> =
            order(column, seed, input).into_iter().map(|row| observed.outputs[row]).collect();
        of_sorted(&sorted, level)
    };
    observed.columns.par_iter().enumerate().map(of_input).collect()
}

/// The index (Ra2) and its interval, from the outputs in the order of an input.
fn of_sorted(y: &[f64], level: f64) -> Result<Estimate, SensitivityError> {
    let spread = Spread::of(y);
    let (n, variance) = (y.len(), spread.variance());
    let square = |deviation: f64| deviation * deviation;
    let differences: Vec<f64> = y.windows(2).map(|pair| 0.5 * square(pair[1] - pair[0])).collect();
    let ends = 0.5 * (differences[0] + differences[n - 2]);
    let noise = (differences.iter().sum::<f64>() + ends) / (n as f64 * variance);
    let squares: Vec<f64> = y.iter().map(|y| square(y - spread.mean)).collect();
    let between: Vec<f64> = squares.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    let [own, sum] = scatter(&differences, &between);
    let size = n as f64;
    let deviation = |noise: f64| {
        let of = |[one, both, other]: [f64; 3]| one - 2.0 * noise * both + noise * noise * other;
        // Few rows may give a difference below zero.
        let terms = of(sum).max(0.25 * of(own)) / (variance * variance);
        (terms / (size - 8.0)).max(noise * noise / size).sqrt()
    };
    let freedoms = size.min(3.0 * effective(&squares)) / 8.0;
    Estimate::of_rest(noise, deviation, freedoms.max(1.0), level)
}

/// `γ_0` and s² (Ra4) of `d - θ w` as polynomials in θ: coefficients of 1, -2 θ and θ².
fn scatter(d: &[f64], w: &[f64]) -> [[f64; 3]; 2] {
    let count = d.len() as f64;
    let centred = |values: &[f64]| -> Vec<f64> {
        let mean = values.iter().sum::<f64>() / count;
        values.iter().map(|value| value - mean).collect()
    };
    let [d, w] = [centred(d), centred(w)];
    let covariance = |one: &[f64], other: &[f64], apart: usize| {
        let products = |one: &[f64], other: &[f64]| -> f64 {
            one.iter().zip(&other[apart..]).map(|(one, other)| one * other).sum()
        };
        0.5 * (products(one, other) + products(other, one)) / count
    };
    let pairs = [[&d, &d], [&d, &w], [&w, &w]];
    let own = pairs.map(|[one, other]| covariance(one, other, 0));
    let sum = pairs.map(|[one, other]| {
        let [near, far] = [[1].as_slice(), &[2, 3, 4]]
            .map(|of| of.iter().map(|&k| covariance(one, other, k)).sum::<f64>() / of.len() as f64);
        covariance(one, other, 0) + 2.0 * (near - far)
    });
    [own, sum]
}
