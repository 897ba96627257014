//! Active subspaces: the directions of all inputs along which the output varies, from exact gradients.
//!
//! With `g_i = s_i ∂f/∂x_i`, where `s_i` is the standard deviation of input i,
//!
//! ```text
//! C = E g gᵀ = W Λ Wᵀ,   λ_1 >= λ_2 >= ..                                 (AS1)
//! E (f - E (f | W_mᵀ x / s))² <= Σ_(j > m) λ_j   for normal inputs           (AS2)
//! ```
//!
//! P. G. Constantine, *Active subspaces* (2015), Eq. (3.2) and theorem 4.4, with Poincaré's constant 1 of the
//! standard normal law. `λ_j` is the mean square of the slope in direction j: the m first directions suffice
//! if the others have a small sum. For other laws (AS2) holds with another constant, and the eigenvalues
//! rank.
//!
//! The intervals are the quantiles of a bootstrap of the gradients: P. Constantine, D. Gleich, *Computing
//! active subspaces with Monte Carlo* (2015). The directions have no unit, the eigenvalues the square of that
//! of the output. Steps count in the deviation of an input.

use rand::RngExt;
use serde::{Deserialize, Serialize};

use crate::design::IndependentSample;
use crate::design::input::Input;
use crate::error::{SensitivityError, check_level, check_range, require};
use crate::measure::dgsm::{Slopes, checked};
use crate::measure::linear_algebra::symmetric_eigen;
use crate::parallel::*;
use crate::sample::interval::Estimate;
use crate::sample::random::{Bootstrap, stream};

/// Eigenvalues and directions (AS1).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct ActiveSubspace {
    /// Number of observations that gave slopes.
    pub observed: usize,
    /// Eigenvalues in descending order, in the square of the unit of the output.
    pub eigenvalues: Vec<Estimate>,
    /// The unit direction of each, with one component per input in standard deviations.
    pub directions: Vec<Vec<f64>>,
    /// Sums of the squared components of each input over the directions, weighted by eigenvalue and divided
    /// by the sum of all: activity scores, which add up to 1.
    pub activity: Vec<f64>,
    /// Eigenvalues of each resample.
    #[serde(skip)]
    resampled: Vec<Vec<f64>>,
}

impl ActiveSubspace {
    /// Number of directions whose eigenvalues have this share of the sum of all, in (0, 1), with its least
    /// and greatest number over the middle part `level` of the resamples.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidParameter`] for a share or a level outside (0, 1).
    pub fn needed(&self, share: f64, level: f64) -> Result<[usize; 3], SensitivityError> {
        require(share > 0.0 && share < 1.0, "share", share, "a number between 0 and 1")?;
        check_level(level)?;
        let found = count(self.eigenvalues.iter().map(|of| of.value), share);
        let of_resample = |values: &Vec<f64>| count(values.iter().copied(), share);
        let mut resampled: Vec<usize> = self.resampled.iter().map(of_resample).collect();
        resampled.sort_unstable();
        let [low, high] = ends(resampled.len(), level);
        let [low, high] = [low, high].map(|rank| resampled.get(rank).copied().unwrap_or(found));
        Ok([found, low.min(found), high.max(found)])
    }
}

/// Finds the directions from the output and gradient at each row of a design, `None` for a failed
/// observation. The intervals have the confidence `level` in (0, 1).
///
/// # Errors
/// As [`crate::dgsm`], [`SensitivityError::OutOfRange`] for fewer than two resamples, and
/// [`SensitivityError::NoEigenvalues`] for slopes whose squares are not finite.
pub fn active_subspace<D: IndependentSample>(
    design: &D,
    slopes: &[Option<Slopes>],
    bootstrap: Bootstrap,
    level: f64,
) -> Result<ActiveSubspace, SensitivityError> {
    check_level(level)?;
    check_range("resamples", bootstrap.resamples as u64, 2, u64::MAX)?;
    checked(design, slopes)?;
    let stds: Vec<f64> = design.inputs().iter().map(Input::std).collect();
    let scaled = |of: &Slopes| of.gradient.iter().zip(&stds).map(|(slope, std)| slope * std).collect();
    let gradients: Vec<Vec<f64>> = slopes.iter().flatten().map(scaled).collect();
    let n = gradients.len();
    check_range("observed outputs", n as u64, 2, u64::MAX)?;
    let all: Vec<usize> = (0..n).collect();
    let (values, directions) = eigen_of(&gradients, &all)?;
    let resample = |resample: usize| {
        let mut generator = stream(bootstrap.seed, resample as u64);
        let rows: Vec<usize> = (0..n).map(|_| generator.random_range(0..n)).collect();
        Ok(eigen_of(&gradients, &rows)?.0)
    };
    let resampled: Vec<Vec<f64>> =
        (0..bootstrap.resamples).into_par_iter().map(resample).collect::<Result<_, SensitivityError>>()?;
    let [low, high] = ends(bootstrap.resamples, level);
    let estimate = |(j, &value): (usize, &f64)| {
        let mut of: Vec<f64> = resampled.iter().map(|values| values[j]).collect();
        of.sort_by(f64::total_cmp);
        Estimate { value, low: of[low].min(value), high: of[high].max(value) }
    };
    let sum: f64 = values.iter().sum();
    let score = |i: usize| {
        let of: f64 = values.iter().zip(&directions).map(|(value, w)| value * w[i] * w[i]).sum();
        if sum > 0.0 { of / sum } else { 0.0 }
    };
    Ok(ActiveSubspace {
        observed: n,
        eigenvalues: values.iter().enumerate().map(estimate).collect(),
        activity: (0..stds.len()).map(score).collect(),
        directions,
        resampled,
    })
}

/// Number of values, from the first on, that have this share of the sum of all.
fn count(values: impl Iterator<Item = f64> + Clone, share: f64) -> usize {
    let all: f64 = values.clone().sum();
    let mut sum = 0.0;
    let before = values.take_while(|value| {
        let is_before = sum < share * all;
        sum += value;
        is_before
    });
    before.count()
}

/// Eigenvalues and eigenvectors of the mean of g gᵀ over some rows.
fn eigen_of(gradients: &[Vec<f64>], rows: &[usize]) -> Result<(Vec<f64>, Vec<Vec<f64>>), SensitivityError> {
    symmetric_eigen(&mean_products(gradients, rows)).map_err(|rows| SensitivityError::NoEigenvalues { rows })
}

/// Mean of g gᵀ over some rows.
fn mean_products(gradients: &[Vec<f64>], rows: &[usize]) -> Vec<Vec<f64>> {
    let k = gradients[0].len();
    let mut sums = vec![vec![0.0; k]; k];
    for gradient in rows.iter().map(|&row| &gradients[row]) {
        for (i, line) in sums.iter_mut().enumerate() {
            line[..=i].iter_mut().zip(gradient).for_each(|(sum, g)| *sum += gradient[i] * g);
        }
    }
    let count = rows.len() as f64;
    let mean = |i: usize, j: usize| sums[i.max(j)][i.min(j)] / count;
    (0..k).map(|i| (0..k).map(|j| mean(i, j)).collect()).collect()
}

/// Ranks of the ends of the middle part `level` of n values.
fn ends(n: usize, level: f64) -> [usize; 2] {
    let tail = 0.5 * (1.0 - level);
    let rank = |q: f64| ((q * n as f64) as usize).min(n.saturating_sub(1));
    [rank(tail), rank(1.0 - tail)]
}
