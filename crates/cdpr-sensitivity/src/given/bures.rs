//! How much the law of a vector changes when an input is fixed: the index of Wasserstein and Bures.
//!
//! With m and Σ the mean and covariance of an output y of several components in a common unit, and `m_x`,
//! `Σ_x` those of y where input i has the value x,
//!
//! ```text
//! W² = |m - m_x|² + tr(Σ + Σ_x - 2 (Σ^½ Σ_x Σ^½)^½)                                   (BW1)
//! ι_i = E W² / (2 tr Σ) = 1 - E tr (Σ^½ Σ_x Σ^½)^½ / tr Σ                              (BW2)
//! of which by the means:  E |m - m_x|² / (2 tr Σ) = (1 - E tr Σ_x / tr Σ) / 2          (BW3)
//! Σ_x ≈ (C_yy - c_xy c_xyᵀ / c_xx) / (n - 2)   of the n rows of a part                  (BW4)
//! ```
//!
//! - (BW1) is the squared distance by optimal transport of two normal laws of these moments, and at most that
//!   of any two laws with them: M. Gelbrich, *On a formula for the L2 Wasserstein metric between measures on
//!   Euclidean and Hilbert spaces*, Math. Nachr. 147 (1990).
//! - (BW2): E. Borgonovo, A. Figalli, E. Plischke, G. Savaré, *Global sensitivity analysis via optimal
//!   transport*, Manage. Sci. (2024), section 5. The law of total variance, `Σ = E Σ_x + Cov m_x`, gives the
//!   second form. ι is 0 if neither the mean nor the covariance depends on the input, 1 if the input alone
//!   decides the output. (BW3) is half of the generalized first-order Sobol' index
//!   ([`crate::vector_sobol_indices`]); the rest is what the input changes in the spread of the vector.
//! - (BW4): the rows are cut into parts of equal size in the order of the input. The covariance within a part
//!   is that of the residuals of a line, with C and c sums of products of deviations: what the input itself
//!   causes within its part would count as spread of the others, and a root makes much of little.
//! - A root of an estimate is too small in the mean. A jackknife over 20 groups of rows takes this bias of
//!   the order 1/n away and gives the interval: B. Efron, C. Stein, *The jackknife estimate of variance*,
//!   Ann. Stat. 9 (1981). It is of Student's form, for independent rows. Those of a sequence are refused
//!   ([`rank`](crate::given::rank)): the correction would be wrong for them.
//!
//! Correlated inputs count each for what they tell of the output. No unit.

use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

use crate::error::{SensitivityError, check_finite, check_length, check_level, check_range};
use crate::given::rank::rows::{Patterns, order};
use crate::measure::linear_algebra::symmetric_eigen;
use crate::parallel::*;
use crate::sample::interval::Estimate;
use crate::sample::random::stream;
use crate::sample::summary::Spread;

/// Largest number of components, up to 32: the time grows with its cube, and with the number of inputs.
fn most_components(inputs: usize) -> u64 {
    /// Some seconds.
    const AFFORDABLE: u64 = 1 << 20;
    (1..=32_u64).rev().find(|m| m.pow(3) * inputs as u64 <= AFFORDABLE).unwrap_or(1)
}

/// Index of one input.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct WassersteinBures {
    /// ι (BW2), from 0 to 1 but for its error.
    pub index: Estimate,
    /// Part of it by the means (BW3), at most 1/2.
    pub means: Estimate,
}

/// Least number of rows.
pub const MIN_ROWS: usize = 64;
/// Groups of the jackknife, and least and largest number of parts and of rows in a part.
const GROUPS: usize = 20;
const PART: usize = 32;
const MOST_PARTS: usize = 50;

/// Estimates the indices of all inputs from their columns of values, and one output of several components per
/// row, `None` for a failed observation, with intervals of the confidence `level` in (0, 1).
///
/// The seed deals the rows to the groups of the jackknife.
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless all columns have a value for each output, and all outputs as
///   many components, at least one;
/// - [`SensitivityError::NotFinite`] for a value or a component that is not finite;
/// - [`SensitivityError::OutOfRange`] for fewer than [`MIN_ROWS`] outputs, for more components than can be
///   computed in some seconds (32 of up to 32 inputs);
/// - [`SensitivityError::DependentRows`] for rows of a sequence;
/// - [`SensitivityError::ConstantSample`] if all outputs are equal;
/// - [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
pub fn wasserstein_bures(
    columns: &[Vec<f64>],
    outputs: &[Option<Vec<f64>>],
    level: f64,
    seed: u64,
) -> Result<Vec<WassersteinBures>, SensitivityError> {
    check_level(level)?;
    let kept: Vec<usize> = (0..outputs.len()).filter(|&row| outputs[row].is_some()).collect();
    let vectors: Vec<&Vec<f64>> = outputs.iter().flatten().collect();
    check_range("observed outputs", kept.len() as u64, MIN_ROWS as u64, u64::MAX)?;
    check_range("components", vectors[0].len() as u64, 1, most_components(columns.len()))?;
    for (row, vector) in kept.iter().zip(&vectors) {
        check_length("components", vector.len(), vectors[0].len())?;
        vector.iter().try_for_each(|&value| check_finite("outputs", *row, value))?;
    }
    for column in columns {
        check_length("column", column.len(), outputs.len())?;
        column.iter().enumerate().try_for_each(|(row, &value)| check_finite("row", row, value))?;
    }
    let select = |column: &Vec<f64>| -> Vec<f64> { kept.iter().map(|&row| column[row]).collect() };
    let columns: Vec<Vec<f64>> = columns.iter().map(select).collect();
    Patterns::new(&columns.iter().map(Vec::as_slice).collect::<Vec<_>>(), seed).check()?;
    let mut groups: Vec<usize> = (0..kept.len()).map(|place| place % GROUPS).collect();
    groups.shuffle(&mut stream(seed, 0));
    let mut whole = vec![Moments::new(vectors[0].len()); GROUPS];
    for (vector, &group) in vectors.iter().zip(&groups) {
        whole[group].add(0.0, vector);
    }
    let roots: Vec<Root> = (0..=GROUPS)
        .map(|left| Root::new(&without(&whole, left), vectors[0][0]))
        .collect::<Result<_, _>>()?;
    let of_input = |(input, values): (usize, &Vec<f64>)| {
        let order = order(values, seed, 1 + input);
        let parts = (order.len() / PART).clamp(2, MOST_PARTS);
        let size = order.len();
        let of_part = |part: usize| {
            let mut moments = vec![Moments::new(vectors[0].len()); GROUPS];
            for &row in &order[part * size / parts..(part + 1) * size / parts] {
                moments[groups[row]].add(values[row], vectors[row]);
            }
            moments
        };
        let parts: Vec<Vec<Moments>> = (0..parts).map(of_part).collect();
        let without_group = |left: usize| roots[left].indices(parts.iter().map(|part| without(part, left)));
        let all = without_group(GROUPS)?;
        let left = (0..GROUPS).map(without_group).collect::<Result<Vec<_>, _>>()?;
        let estimate = |kind: usize| {
            let spread = Spread::of(&left.iter().map(|of| of[kind]).collect::<Vec<f64>>());
            let count = GROUPS as f64;
            let value = count * all[kind] - (count - 1.0) * spread.mean;
            Estimate::of_variance(value, (count - 1.0) / count * spread.squares, count - 1.0, level)
        };
        Ok(WassersteinBures { index: estimate(0)?, means: estimate(1)? })
    };
    columns.par_iter().enumerate().map(of_input).collect()
}

/// Moments of all groups of rows but one; of all for a number beyond the last.
fn without(groups: &[Moments], left: usize) -> Moments {
    let mut sum = Moments::new(groups[0].y.len());
    groups.iter().enumerate().filter(|(group, _)| *group != left).for_each(|(_, other)| sum.merge(other));
    sum
}

/// Number of rows, mean of an input and of the components, and sums of products of their deviations.
#[derive(Clone)]
struct Moments {
    count: f64,
    x: f64,
    y: Vec<f64>,
    xx: f64,
    xy: Vec<f64>,
    yy: Vec<Vec<f64>>,
}

impl Moments {
    fn new(components: usize) -> Self {
        let zeros = vec![0.0; components];
        let yy = vec![zeros.clone(); components];
        Self { count: 0.0, x: 0.0, y: zeros.clone(), xx: 0.0, xy: zeros, yy }
    }

    fn add(&mut self, x: f64, y: &[f64]) {
        self.merge(&Self { count: 1.0, x, y: y.to_vec(), ..Self::new(y.len()) });
    }

    /// T. F. Chan, G. H. Golub, R. J. LeVeque, *Algorithms for computing the sample variance* (1983).
    fn merge(&mut self, other: &Self) {
        if other.count == 0.0 {
            return;
        }
        let count = self.count + other.count;
        let (weight, share) = (self.count * other.count / count, other.count / count);
        let dx = other.x - self.x;
        let dy: Vec<f64> = other.y.iter().zip(&self.y).map(|(other, own)| other - own).collect();
        self.count = count;
        self.x += share * dx;
        self.xx += other.xx + weight * dx * dx;
        for i in 0..dy.len() {
            self.y[i] += share * dy[i];
            self.xy[i] += other.xy[i] + weight * dx * dy[i];
            for (j, dy_j) in dy.iter().enumerate() {
                self.yy[i][j] += other.yy[i][j] + weight * dy[i] * dy_j;
            }
        }
    }

    /// Covariance of the components.
    fn covariance(&self) -> Vec<Vec<f64>> {
        self.yy.iter().map(|row| row.iter().map(|sum| sum / (self.count - 1.0)).collect()).collect()
    }

    /// Covariance of the components given the input (BW4).
    fn conditional(&self) -> Vec<Vec<f64>> {
        if self.xx == 0.0 {
            return self.covariance();
        }
        let entry =
            |i: usize, j: usize| (self.yy[i][j] - self.xy[i] * self.xy[j] / self.xx) / (self.count - 2.0);
        let size = self.y.len();
        (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
    }
}

/// The covariance of all rows: F with Σ = F Fᵀ, and its trace.
struct Root {
    factor: Vec<Vec<f64>>,
    trace: f64,
}

impl Root {
    fn new(all: &Moments, value: f64) -> Result<Self, SensitivityError> {
        let (eigenvalues, vectors) = eigen(&all.covariance())?;
        let trace: f64 = eigenvalues.iter().sum();
        if trace == 0.0 {
            return Err(SensitivityError::ConstantSample { value, count: all.count as usize });
        }
        let scaled = |(value, vector): (&f64, &Vec<f64>)| -> Vec<f64> {
            vector.iter().map(|x| x * value.sqrt()).collect()
        };
        Ok(Self { factor: eigenvalues.iter().zip(&vectors).map(scaled).collect(), trace })
    }

    /// ι (BW2) and its part (BW3) from the moments of the parts.
    fn indices(&self, parts: impl Iterator<Item = Moments>) -> Result<[f64; 2], SensitivityError> {
        let [mut rows, mut roots, mut traces] = [0.0; 3];
        for part in parts {
            let covariance = part.conditional();
            // The eigenvalues of Fᵀ Σ_x F are those of Σ^½ Σ_x Σ^½.
            let product = |one: &Vec<f64>, other: &Vec<f64>| -> f64 {
                let of_row = |(x, row): (&f64, &Vec<f64>)| {
                    x * row.iter().zip(other).map(|(entry, y)| entry * y).sum::<f64>()
                };
                one.iter().zip(&covariance).map(of_row).sum()
            };
            let middle: Vec<Vec<f64>> = self
                .factor
                .iter()
                .map(|one| self.factor.iter().map(|other| product(one, other)).collect())
                .collect();
            rows += part.count;
            roots += part.count * eigen(&middle)?.0.iter().map(|value| value.sqrt()).sum::<f64>();
            traces += part.count * covariance.iter().enumerate().map(|(i, row)| row[i]).sum::<f64>();
        }
        Ok([1.0 - roots / rows / self.trace, 0.5 * (1.0 - traces / rows / self.trace)])
    }
}

/// Eigenvalues of a covariance, none below zero, and its eigenvectors.
fn eigen(matrix: &[Vec<f64>]) -> Result<(Vec<f64>, Vec<Vec<f64>>), SensitivityError> {
    let (values, vectors) =
        symmetric_eigen(matrix).map_err(|rows| SensitivityError::NoEigenvalues { rows })?;
    Ok((values.into_iter().map(|value| value.max(0.0)).collect(), vectors))
}
