//! Borgonovo's δ: how much an input moves the density of the output.
//!
//! With f the density of all outputs, P the law of an input x and the output y together, and Q that of the
//! two if they were independent,
//!
//! ```text
//! δ = E ∫ |f(y) - f(y | x)| dy / 2 = max_A P(A) - Q(A)                                 (De1)
//! A_w = {(x, y): density of P > density of Q}, by Gaussian sums of widths w            (De2)
//! estimate = max_w mean_k D_k(A_w),   A_w of all rows but those of fold k              (De3)
//! D_k(A) = n_k / (n_k - 1) · (P_k(A) - Q_k(A))                                         (De4)
//! at least = (D_2(A_1) + D_1(A_2)) / 2 - t (s_2 + s_1) / 2,   A_1, A_2 of the halves   (De5)
//! s_k² = variance of 1_A(x_i, y_i) - Q_k(A | x_i) - Q_k(A | y_i), over n_k             (De6)
//! ```
//!
//! - (De1): E. Borgonovo, *A new uncertainty importance measure*, Reliab. Eng. Syst. Saf. 92 (2007). It lies
//!   between 0 (independent) and 1, has no unit, and stays the same where x or y is replaced by a monotonic
//!   function of it: it is computed from ranks. The second form is Scheffé's theorem (1947): δ is the
//!   distance in total variation of P and Q, and the set where P is denser is the best.
//! - (De4), with `P_k` the shares of the rows of fold k and `Q_k` the products of the shares of their values
//!   of x and y, has the mean P(A) - Q(A) for any set that other rows have given. It is at most δ, and
//!   misses δ by the square of what the borders of A are off.
//! - (De3): a few widths for x and as many for y, and five folds. The best of them is too large for an input
//!   without an effect (the level that 95 of 100 such inputs stay below is the largest of 19 estimates from
//!   outputs that are dealt to the rows at random) and too small for a strong one.
//! - (De5): the widths of `A_1` are chosen by folds within the first half, and it is measured by the second.
//!   Nothing that it is measured by has a part in its choice, so that the bound holds for any law. (De6) is
//!   the variance of a U statistic to the first order: W. Hoeffding (1948). The two deviations add up:
//!   without an effect, what the two halves happen to have in common raises both differences. t is Student's
//!   factor.
//! - There is no such upper bound: beside any law there are others with a larger δ, in waves of x too short
//!   for the rows to tell. D. L. Donoho, *One-sided inference about functionals of a density*, Ann. Stat. 16
//!   (1988). What else was tried, and how often it held, is in docs/statistics.md.

use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

use crate::error::{SensitivityError, check_level};
use crate::given::data::GivenData;
use crate::measure::regression::ranks;
use crate::parallel::*;
use crate::sample::interval::Estimate;
use crate::sample::random::stream;
use crate::sample::summary::Spread;

/// δ of one input. It has no two-sided interval: no table bounds it from above without assumptions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Delta {
    /// Estimate (De3). With few rows it is too small for a strong input, and too large for a weak one.
    pub delta: f64,
    /// Lower bound of δ (De5). The share of tables whose bound is above δ is half of 1 - level at most.
    pub at_least: f64,
    /// Estimate that an input without an effect stays below in 95 of 100 tables.
    pub noise: f64,
}

/// Least number of rows.
pub const MIN_ROWS: usize = 20;
/// Cells of the ranks of the input, and of those of the output.
const GRID: usize = 64;
/// Widths of the Gaussian sums, as shares of the ranks.
const WIDTHS: [f64; 6] = [1.0 / 2.0, 1.0 / 4.0, 1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0];
const FOLDS: usize = 5;
/// Number of deals behind the level of the noise, which is the largest: one more value without an effect is
/// above them in one of twenty tables.
const DEALS: usize = 19;

/// δ of all inputs, with lower bounds at a confidence `level` in (0, 1).
///
/// # Errors
/// - [`SensitivityError::OutOfRange`] for fewer than [`MIN_ROWS`] outputs;
/// - [`SensitivityError::ConstantSample`] if all outputs are equal;
/// - [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
pub fn delta(data: &GivenData, level: f64, seed: u64) -> Result<Vec<Delta>, SensitivityError> {
    let observed = data.observed(MIN_ROWS)?;
    of_columns(&observed.columns, &observed.outputs, level, seed)
}

pub(crate) fn of_columns(
    columns: &[Vec<f64>],
    outputs: &[f64],
    level: f64,
    seed: u64,
) -> Result<Vec<Delta>, SensitivityError> {
    check_level(level)?;
    let smoothers = WIDTHS.map(Smoother::new);
    let outputs = cells(outputs);
    // Folds and halves are of rows in random order.
    let mut order: Vec<usize> = (0..outputs.len()).collect();
    order.shuffle(&mut stream(seed, 0));
    let columns: Vec<Vec<usize>> = columns.par_iter().map(|column| cells(column)).collect();
    let noise_of = |column: &Vec<usize>| {
        let deal = |deal: usize| {
            let mut dealt = outputs.clone();
            dealt.shuffle(&mut stream(seed, 1 + deal as u64));
            best(&smoothers, &folds(column, &dealt, &order)).0
        };
        let deals: Vec<f64> = (0..DEALS).into_par_iter().map(deal).collect();
        deals.into_iter().fold(0.0, f64::max)
    };
    // Inputs with as many values in each cell share their level: all without equal values do.
    let sizes: Vec<Vec<f64>> =
        columns.iter().map(|column| Table::of(column, column, &order).inputs()).collect();
    let mut levels: Vec<(&Vec<f64>, f64)> = Vec::new();
    for (column, sizes) in columns.iter().zip(&sizes) {
        if !levels.iter().any(|(known, _)| *known == sizes) {
            levels.push((sizes, noise_of(column)));
        }
    }
    let of_input = |(column, sizes): (&Vec<usize>, &Vec<f64>)| {
        let (value, _) = best(&smoothers, &folds(column, &outputs, &order));
        let at_least = at_least(&smoothers, column, &outputs, &order, level)?;
        let noise = levels.iter().find(|(known, _)| *known == sizes).map_or(0.0, |(_, level)| *level);
        Ok(Delta { delta: value, at_least: at_least.min(value), noise })
    };
    columns.par_iter().zip(&sizes).map(of_input).collect()
}

/// Lower bound (De5), at least 0.
fn at_least(
    smoothers: &[Smoother],
    column: &[usize],
    outputs: &[usize],
    order: &[usize],
    level: f64,
) -> Result<f64, SensitivityError> {
    let (first, second) = order.split_at(order.len() / 2);
    let (mut mean, mut deviation) = (0.0, 0.0);
    for (one, other) in [(first, second), (second, first)] {
        let (_, widths) = best(smoothers, &folds(column, outputs, one));
        let set = Table::of(column, outputs, one).set(smoothers, widths);
        let measured = Table::of(column, outputs, other);
        mean += 0.5 * inside(&measured.excess(), &set);
        let (by_inputs, by_outputs) = (measured.inputs(), measured.outputs());
        // Q(A | x) and Q(A | y) of each cell of x and of y.
        let weighed = |shares: &[f64], cell: &dyn Fn(usize) -> usize| -> f64 {
            let held = shares.iter().enumerate().map(|(at, share)| if set[cell(at)] { *share } else { 0.0 });
            held.sum::<f64>() / measured.rows
        };
        let of_x: Vec<f64> = (0..GRID).map(|x| weighed(&by_outputs, &|y| x * GRID + y)).collect();
        let of_y: Vec<f64> = (0..GRID).map(|y| weighed(&by_inputs, &|x| x * GRID + y)).collect();
        let term = |&row: &usize| {
            let (x, y) = (column[row], outputs[row]);
            f64::from(set[x * GRID + y]) - of_x[x] - of_y[y]
        };
        let terms: Vec<f64> = other.iter().map(term).collect();
        deviation += 0.5 * Spread::of(&terms).standard_error();
    }
    let freedoms = first.len() as f64 - 1.0;
    Ok(Estimate::of_variance(mean, deviation * deviation, freedoms, level)?.low.max(0.0))
}

/// Cell of each value's rank. Equal values share the middle of their ranks.
fn cells(values: &[f64]) -> Vec<usize> {
    let n = values.len() as f64;
    let cell = |rank: f64| (((rank - 0.5) / n * GRID as f64) as usize).min(GRID - 1);
    ranks(values).into_iter().map(cell).collect()
}

/// The table of each fold of these rows.
fn folds(column: &[usize], outputs: &[usize], rows: &[usize]) -> [Table; FOLDS] {
    std::array::from_fn(|fold| {
        let rows: Vec<usize> = rows.iter().copied().skip(fold).step_by(FOLDS).collect();
        Table::of(column, outputs, &rows)
    })
}

/// The estimate (De3) and its widths.
fn best(smoothers: &[Smoother], folds: &[Table; FOLDS]) -> (f64, [usize; 2]) {
    let all = folds.iter().fold(Table::none(), |sum, fold| sum.with(fold, 1.0));
    let mut sums = [[0.0; WIDTHS.len()]; WIDTHS.len()];
    for fold in folds {
        let excess = fold.excess();
        all.clone().with(fold, -1.0).each_set([smoothers; 2], |[x, y], set| {
            sums[x][y] += inside(&excess, set) / FOLDS as f64;
        });
    }
    let mut best = (0.0, [0, 0]);
    for (x, sums) in sums.iter().enumerate() {
        for (y, &sum) in sums.iter().enumerate() {
            if sum > best.0 {
                best = (sum, [x, y]);
            }
        }
    }
    best
}

/// Numbers of rows in the cells of x and y, those of one x side by side.
#[derive(Clone)]
struct Table {
    rows: f64,
    counts: Vec<f64>,
}

impl Table {
    fn none() -> Self {
        Self { rows: 0.0, counts: vec![0.0; GRID * GRID] }
    }

    fn of(column: &[usize], outputs: &[usize], rows: &[usize]) -> Self {
        let mut table = Self { rows: rows.len() as f64, ..Self::none() };
        rows.iter().for_each(|&row| table.counts[column[row] * GRID + outputs[row]] += 1.0);
        table
    }

    /// The sum with another table, taken so many times.
    fn with(mut self, other: &Self, times: f64) -> Self {
        self.rows += times * other.rows;
        self.counts.iter_mut().zip(&other.counts).for_each(|(count, more)| *count += times * more);
        self
    }

    /// Numbers of rows by cells of x.
    fn inputs(&self) -> Vec<f64> {
        self.counts.chunks(GRID).map(|of| of.iter().sum()).collect()
    }

    /// Numbers of rows by cells of y.
    fn outputs(&self) -> Vec<f64> {
        let mut sums = vec![0.0; GRID];
        for of_x in self.counts.chunks(GRID) {
            sums.iter_mut().zip(of_x).for_each(|(sum, count)| *sum += count);
        }
        sums
    }

    /// What each cell adds to D (De4).
    fn excess(&self) -> Vec<f64> {
        let (n, inputs, outputs) = (self.rows, self.inputs(), self.outputs());
        let cell = |(cell, count): (usize, &f64)| {
            (count - inputs[cell / GRID] * outputs[cell % GRID] / n) / (n - 1.0)
        };
        self.counts.iter().enumerate().map(cell).collect()
    }

    /// The set (De2) of these widths.
    fn set(&self, smoothers: &[Smoother], [x, y]: [usize; 2]) -> Vec<bool> {
        let mut of_widths = Vec::new();
        self.each_set([&smoothers[x..=x], &smoothers[y..=y]], |_, set| of_widths = set.to_vec());
        of_widths
    }

    /// Calls with the numbers of the widths of x and y, and with the cells of the set (De2).
    fn each_set(&self, [of_x, of_y]: [&[Smoother]; 2], mut call: impl FnMut([usize; 2], &[bool])) {
        /// A density is larger from this factor on: rounding makes none.
        const LARGER: f64 = 1.0 + 1e-9;
        let (inputs, outputs) = (self.inputs(), self.outputs());
        let inputs: Vec<Vec<f64>> = of_x.iter().map(|smoother| smoother.along_rows(&inputs)).collect();
        let mut set = vec![false; GRID * GRID];
        for (y, smoother) in of_y.iter().enumerate() {
            let smooth = smoother.along_rows(&self.counts);
            let outputs: Vec<f64> =
                smoother.along_rows(&outputs).iter().map(|output| LARGER * output / self.rows).collect();
            for (x, (smoother, inputs)) in of_x.iter().zip(&inputs).enumerate() {
                let smooth = smoother.along_columns(&smooth);
                for ((set, smooth), input) in set.chunks_mut(GRID).zip(smooth.chunks(GRID)).zip(inputs) {
                    for ((held, smooth), output) in set.iter_mut().zip(smooth).zip(&outputs) {
                        *held = *smooth > input * output;
                    }
                }
                call([x, y], &set);
            }
        }
    }
}

/// Sum of what the cells of a set add.
fn inside(excess: &[f64], set: &[bool]) -> f64 {
    // By cells of y first: sums that do not wait for each other are faster.
    let mut sums = [0.0; GRID];
    for (excess, set) in excess.chunks(GRID).zip(set.chunks(GRID)) {
        for ((sum, excess), held) in sums.iter_mut().zip(excess).zip(set) {
            *sum += if *held { *excess } else { 0.0 };
        }
    }
    sums.iter().sum()
}

/// Weights of a Gaussian sum, reflected at both ends of the ranks.
struct Smoother {
    /// For each cell the first cell that it gives weight to, and the weights from there on. They add up to 1.
    weights: Vec<(usize, Vec<f64>)>,
    /// The same weights by the cell that receives them: the first cell that gives any, and from there on.
    received: Vec<(usize, Vec<f64>)>,
}

impl Smoother {
    fn new(width: f64) -> Self {
        /// Least weight that counts, and number of reflections.
        const LEAST: f64 = 1e-3;
        const IMAGES: i32 = 2;
        let middle = |cell: usize| (cell as f64 + 0.5) / GRID as f64;
        let of_cell = |from: usize| {
            let weight = |to: usize| -> f64 {
                let images = (-IMAGES..=IMAGES).flat_map(|image| {
                    let shift = 2.0 * f64::from(image);
                    [shift + middle(from), shift - middle(from)]
                });
                images.map(|image| (-0.5 * ((middle(to) - image) / width).powi(2)).exp()).sum()
            };
            let weights: Vec<f64> = (0..GRID).map(weight).collect();
            let counts = |weight: &f64| *weight > LEAST;
            let first = weights.iter().position(counts).unwrap_or(0);
            let last = weights.iter().rposition(counts).unwrap_or(GRID - 1);
            let weights = &weights[first..=last];
            let sum: f64 = weights.iter().sum();
            (first, weights.iter().map(|weight| weight / sum).collect())
        };
        let weights: Vec<(usize, Vec<f64>)> = (0..GRID).map(of_cell).collect();
        let from = |to: usize| {
            let given = |(first, weights): &(usize, Vec<f64>)| weights.get(to.checked_sub(*first)?).copied();
            let first = weights.iter().position(|of| given(of).is_some()).unwrap_or(0);
            (first, weights[first..].iter().map_while(given).collect())
        };
        let received = (0..GRID).map(from).collect();
        Self { weights, received }
    }

    /// Smooths each row of cells by itself.
    fn along_rows(&self, values: &[f64]) -> Vec<f64> {
        let mut smooth = vec![0.0; values.len()];
        for (row, smooth) in values.chunks(GRID).zip(smooth.chunks_mut(GRID)) {
            for (value, (first, weights)) in row.iter().zip(&self.weights).filter(|(value, _)| **value > 0.0)
            {
                smooth[*first..].iter_mut().zip(weights).for_each(|(sum, weight)| *sum += value * weight);
            }
        }
        smooth
    }

    /// Smooths from one row of cells to the others.
    fn along_columns(&self, values: &[f64]) -> Vec<f64> {
        /// Sums that are kept in registers.
        const TOGETHER: usize = 16;
        let mut smooth = vec![0.0; values.len()];
        for (smooth, (first, weights)) in smooth.chunks_mut(GRID).zip(&self.received) {
            for (block, smooth) in smooth.chunks_mut(TOGETHER).enumerate() {
                let mut sums = [0.0; TOGETHER];
                for (row, weight) in values.chunks(GRID).skip(*first).zip(weights) {
                    let row = &row[block * TOGETHER..][..TOGETHER];
                    sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += weight * value);
                }
                smooth.copy_from_slice(&sums);
            }
        }
        smooth
    }
}
