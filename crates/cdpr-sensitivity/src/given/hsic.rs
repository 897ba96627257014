//! Dependence of an output, or of an event, on each input: the Hilbert-Schmidt independence criterion.
//!
//! With Gaussian kernels `K_ij = exp(-(x_i - x_j)² / (2 s²))` of the inputs and L of the output, s the
//! deviation of the values, and C = I - 1 1ᵀ / n,
//!
//! ```text
//! HSIC(x, y) = tr(A B) / n²,   A = C K C,   B = C L C                                (Hs1)
//! R² = HSIC(x, y) / √(HSIC(x, x) HSIC(y, y))                                         (Hs2)
//! m = tr A tr B / (n - 1),   v = Var tr(A P B Pᵀ) over all permutations P            (Hs3)
//! p = P(Γ >= tr(A B)),   Γ a gamma variable of the mean m and the variance v         (Hs4)
//! ```
//!
//! - (Hs1) is 0 for infinitely many rows if and only if input and output are independent, whatever the form
//!   of the dependence: A. Gretton, O. Bousquet, A. Smola, B. Schölkopf, *Measuring statistical dependence
//!   with Hilbert-Schmidt norms* (2005).
//! - (Hs2), from 0 to 1 without a unit: S. Da Veiga, *Global sensitivity analysis with dependence measures*,
//!   J. Stat. Comput. Simul. 85 (2015). It is biased upwards by about m / tr of the two: judge by p.
//! - (Hs3) are the exact moments of the statistic if the outputs are dealt to the rows at random: F.
//!   Kazi-Aoual, S. Hitier, R. Sabatier, J.-D. Lebreton, *Refined approximations to permutation tests for
//!   multivariate inference*, Comput. Stat. Data Anal. 20 (1995). With
//!   T = tr A, T2 = tr A², S2 = Σ A_ii² (and the same of B, with a star),
//!
//! ```text
//! v = 2 ((n-1) T2 - T²) ((n-1) T2* - T*²) / ((n-1)² (n+1) (n-2))                     (Hs5)
//!   + Q Q* / ((n+1) n (n-1) (n-2) (n-3)),   Q = n (n+1) S2 - (n-1) (T² + 2 T2)
//! ```
//!
//! - (Hs4): A. Gretton et al., *A kernel statistical test of independence* (2008). It holds at usual levels;
//!   p below 1e-4 is an indication of its size only.
//! - An input of words has the kernel K = 1 for two rows of the same word, 0 otherwise.
//! - An event has the kernel L = 1 for two rows in which it happens or in neither, 0 otherwise. The rows in
//!   which a limit fails give the target measure, and the rows among these alone the conditional one: A.
//!   Marrel, V. Chabridon, *Statistical developments for target and conditional sensitivity analysis*,
//!   Reliab. Eng. Syst. Saf. 214 (2021), with weights of 0 and 1.
//!
//! Inputs may depend on each other: then an input without an effect of its own depends on the output, too.

use rand::seq::index::sample;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Gamma};

use crate::error::{SensitivityError, check_length, check_range};
use crate::given::data::{GivenData, Kind};
use crate::parallel::*;
use crate::sample::random::stream;
use crate::sample::summary::{Spread, check_varies};

/// Dependence on one input.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Dependence {
    /// R² (Hs2), from 0 to 1. A constant input has 0.
    pub r_squared: f64,
    /// p (Hs4): probability of a statistic of this size without any dependence.
    pub p_value: f64,
}

/// At how many rows dependences are computed: time and memory grow with the square.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rows {
    /// Largest number of rows. If there are more, so many are drawn at random.
    pub most: usize,
    /// Seed of the draw.
    pub seed: u64,
}

/// Least number of rows.
pub const MIN_ROWS: usize = 6;
/// Largest number of rows at which dependences are computed: two matrices of 200 MB.
pub const MOST_ROWS: usize = 5000;

/// Dependence of the output on each input.
///
/// # Errors
/// [`SensitivityError::OutOfRange`] for fewer than [`MIN_ROWS`] rows, [`SensitivityError::ConstantSample`] if
/// all outputs are equal.
pub fn dependence(data: &GivenData, rows: Rows) -> Result<Vec<Dependence>, SensitivityError> {
    let observed = data.observed(MIN_ROWS)?;
    let kinds: Vec<Kind> = (0..data.names().len()).map(|input| data.kind(input)).collect();
    of_output(&observed.columns, &kinds, &observed.outputs, rows)
}

/// The same of columns of inputs, and of outputs that are not all equal.
pub(crate) fn of_output(
    columns: &[Vec<f64>],
    kinds: &[Kind],
    outputs: &[f64],
    rows: Rows,
) -> Result<Vec<Dependence>, SensitivityError> {
    let chosen = rows.of(outputs.len())?;
    let output = Kernel::new(select(outputs, &chosen), Kind::Numbers);
    check_varies(outputs)?;
    Ok(of_gram(columns, kinds, &chosen, &Centred::new(&output.gram(), chosen.len())))
}

/// Dependence of an event, which happens in some of the rows, on each input of numbers.
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless each column has a value for each row;
/// - [`SensitivityError::OutOfRange`] for fewer than [`MIN_ROWS`] rows, for an event in no row or in all.
pub fn dependence_of_event(
    columns: &[Vec<f64>],
    happens: &[bool],
    rows: Rows,
) -> Result<Vec<Dependence>, SensitivityError> {
    of_event(columns, &vec![Kind::Numbers; columns.len()], happens, rows)
}

/// The same of inputs of numbers and of levels.
pub(crate) fn of_event(
    columns: &[Vec<f64>],
    kinds: &[Kind],
    happens: &[bool],
    rows: Rows,
) -> Result<Vec<Dependence>, SensitivityError> {
    columns.iter().try_for_each(|column| check_length("column", column.len(), happens.len()))?;
    let count = |chosen: &[usize]| chosen.iter().filter(|&&row| happens[row]).count();
    let chosen = rows.of_event(happens)?;
    check_range("rows of the event", count(&chosen) as u64, 1, chosen.len() as u64 - 1)?;
    let event = Kernel::new(chosen.iter().map(|&row| f64::from(happens[row])).collect(), Kind::Levels);
    Ok(of_gram(columns, kinds, &chosen, &Centred::new(&event.gram(), chosen.len())))
}

impl Rows {
    fn of(&self, n: usize) -> Result<Vec<usize>, SensitivityError> {
        check_range("dependence_rows", self.most as u64, MIN_ROWS as u64, MOST_ROWS as u64)?;
        check_range("observed outputs", n as u64, MIN_ROWS as u64, u64::MAX)?;
        let mut chosen = sample(&mut stream(self.seed, 0), n, n.min(self.most)).into_vec();
        chosen.sort_unstable();
        Ok(chosen)
    }

    /// A rare event keeps up to half of the rows, so that a draw does not lose it. The test holds for any
    /// choice of rows by the event.
    fn of_event(&self, happens: &[bool]) -> Result<Vec<usize>, SensitivityError> {
        check_range("dependence_rows", self.most as u64, MIN_ROWS as u64, MOST_ROWS as u64)?;
        check_range("rows", happens.len() as u64, MIN_ROWS as u64, u64::MAX)?;
        if happens.len() <= self.most {
            return Ok((0..happens.len()).collect());
        }
        let rows =
            |wanted: bool| (0..happens.len()).filter(|&row| happens[row] == wanted).collect::<Vec<_>>();
        let (within, without) = (rows(true), rows(false));
        let half = self.most / 2;
        let least = within.len().min(without.len());
        let share = (self.most * within.len()).div_ceil(happens.len());
        let taken = if within.len() == least {
            share.max(least.min(half))
        } else {
            share.min(self.most - least.min(half))
        };
        let draw = |rows: &[usize], count: usize, part: u64| -> Vec<usize> {
            let count = count.min(rows.len());
            sample(&mut stream(self.seed, part), rows.len(), count).iter().map(|k| rows[k]).collect()
        };
        let mut chosen = draw(&within, taken, 1);
        chosen.extend(draw(&without, self.most - taken.min(self.most), 2));
        chosen.sort_unstable();
        Ok(chosen)
    }
}

fn select(values: &[f64], rows: &[usize]) -> Vec<f64> {
    rows.iter().map(|&row| values[row]).collect()
}

/// Kernel of two rows: Gaussian for numbers, 1 or 0 for the same level and another one.
struct Kernel {
    values: Vec<f64>,
    /// -1 / (2 s²) for numbers; 0 for constant values, whose kernel is 1.
    factor: Option<f64>,
}

impl Kernel {
    fn new(values: Vec<f64>, kind: Kind) -> Self {
        let variance = Spread::of(&values).variance();
        let exponent = if variance > 0.0 { -0.5 / variance } else { 0.0 };
        Self { factor: (kind == Kind::Numbers).then_some(exponent), values }
    }

    fn of(&self, i: usize, j: usize) -> f64 {
        let [one, other] = [self.values[i], self.values[j]];
        match self.factor {
            Some(factor) => (factor * (one - other) * (one - other)).exp(),
            None => f64::from(one == other),
        }
    }

    /// Each pair of rows, row by row.
    fn gram(&self) -> Vec<f64> {
        let n = self.values.len();
        (0..n * n).map(|k| self.of(k / n, k % n)).collect()
    }
}

/// A centred matrix B and its invariants.
struct Centred {
    entries: Vec<f64>,
    invariants: Invariants,
}

/// T, T2 and S2 of (Hs5).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Invariants {
    pub(crate) trace: f64,
    pub(crate) square: f64,
    pub(crate) diagonal: f64,
}

impl Centred {
    fn new(gram: &[f64], n: usize) -> Self {
        let size = n as f64;
        let means: Vec<f64> = gram.chunks_exact(n).map(|row| row.iter().sum::<f64>() / size).collect();
        let mean = means.iter().sum::<f64>() / size;
        let entry = |(k, value): (usize, &f64)| value - means[k / n] - means[k % n] + mean;
        let entries: Vec<f64> = gram.iter().enumerate().map(entry).collect();
        let on_diagonal = || entries.iter().step_by(n + 1);
        let invariants = Invariants {
            trace: on_diagonal().sum(),
            square: entries.iter().map(|b| b * b).sum(),
            diagonal: on_diagonal().map(|b| b * b).sum(),
        };
        Self { entries, invariants }
    }
}

/// Dependences on all inputs of what has the centred matrix B.
fn of_gram(columns: &[Vec<f64>], kinds: &[Kind], rows: &[usize], output: &Centred) -> Vec<Dependence> {
    let of_column =
        |(column, &kind): (&Vec<f64>, &Kind)| of_input(&Kernel::new(select(column, rows), kind), output);
    columns.par_iter().zip(kinds).map(of_column).collect()
}

/// Dependence on the values of one input. A is not stored: its products and invariants follow from sums over
/// the pairs of rows.
fn of_input(input: &Kernel, output: &Centred) -> Dependence {
    let (n, size) = (input.values.len(), input.values.len() as f64);
    if check_varies(&input.values).is_err() {
        return Dependence { r_squared: 0.0, p_value: 1.0 };
    }
    let (mut sums, mut squares, mut product) = (vec![1.0; n], size, output.invariants.trace);
    for i in 0..n {
        let (row, mut sum) = (&output.entries[i * n..i * n + i], 0.0);
        for j in 0..i {
            let kernel = input.of(i, j);
            sums[j] += kernel;
            sum += kernel;
            squares += 2.0 * kernel * kernel;
            product += 2.0 * kernel * row[j];
        }
        sums[i] += sum;
    }
    let total: f64 = sums.iter().sum();
    let mean = total / (size * size);
    let invariants = Invariants {
        trace: size - total / size,
        square: squares - 2.0 / size * sums.iter().map(|sum| sum * sum).sum::<f64>()
            + mean * mean * size * size,
        diagonal: sums.iter().map(|sum| (1.0 - 2.0 * sum / size + mean).powi(2)).sum(),
    };
    let scale = (invariants.square * output.invariants.square).sqrt();
    Dependence {
        r_squared: (product / scale).clamp(0.0, 1.0),
        p_value: p_value(product, moments(invariants, output.invariants, size)),
    }
}

/// Mean (Hs3) and variance (Hs5) over all permutations.
pub(crate) fn moments(a: Invariants, b: Invariants, n: f64) -> (f64, f64) {
    let spread = |m: Invariants| (n - 1.0) * m.square - m.trace * m.trace;
    let q = |m: Invariants| n * (n + 1.0) * m.diagonal - (n - 1.0) * (m.trace * m.trace + 2.0 * m.square);
    let mean = a.trace * b.trace / (n - 1.0);
    let variance = 2.0 * spread(a) * spread(b) / ((n - 1.0).powi(2) * (n + 1.0) * (n - 2.0))
        + q(a) * q(b) / ((n + 1.0) * n * (n - 1.0) * (n - 2.0) * (n - 3.0));
    (mean, variance)
}

/// (Hs4).
fn p_value(statistic: f64, (mean, variance): (f64, f64)) -> f64 {
    match Gamma::new(mean * mean / variance, mean / variance) {
        Ok(gamma) => gamma.sf(statistic),
        // Without a variance, no permutation differs from another.
        Err(_) => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All permutations of 0..n.
    fn permutations(n: usize) -> Vec<Vec<usize>> {
        let Some(last) = n.checked_sub(1) else { return vec![vec![]] };
        let insert = |rest: Vec<usize>| (0..n).map(move |at| [&rest[..at], &[last], &rest[at..]].concat());
        permutations(last).into_iter().flat_map(insert).collect()
    }

    #[test]
    fn the_moments_are_those_over_all_permutations() {
        let x = [0.1, 0.7, -0.4, 2.0, 1.1, 0.3, -1.5];
        let y = [1.0, 0.2, 0.9, 4.0, -0.3, 0.0, 0.5];
        let n = x.len();
        let kernel = |values: &[f64]| Kernel::new(values.to_vec(), Kind::Numbers);
        let (a, b) = (Centred::new(&kernel(&x).gram(), n), Centred::new(&kernel(&y).gram(), n));
        let statistic = |p: &Vec<usize>| -> f64 {
            (0..n * n).map(|k| a.entries[k] * b.entries[p[k / n] * n + p[k % n]]).sum()
        };
        let all: Vec<f64> = permutations(n).iter().map(statistic).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let variance = all.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / all.len() as f64;
        let found = moments(a.invariants, b.invariants, n as f64);
        assert!((found.0 / mean - 1.0).abs() < 1e-10, "{found:?} {mean}");
        assert!((found.1 / variance - 1.0).abs() < 1e-10, "{found:?} {variance}");

        // The sums over pairs give the same statistic: R² of (Hs1), (Hs2) by the matrices.
        let identity: Vec<usize> = (0..n).collect();
        let scale = (a.invariants.square * b.invariants.square).sqrt();
        let by_pairs = of_input(&kernel(&x), &b);
        assert!((by_pairs.r_squared - statistic(&identity) / scale).abs() < 1e-12);
        let p = p_value(statistic(&identity), found);
        assert!((by_pairs.p_value - p).abs() < 1e-9, "{by_pairs:?} {p}");
    }

    #[test]
    fn a_draw_keeps_rare_events() {
        let happens: Vec<bool> = (0..10_000).map(|row| row % 500 == 0).collect();
        for (happens, kept) in [(happens.clone(), true), (happens.iter().map(|h| !h).collect(), false)] {
            let chosen = Rows { most: 100, seed: 1 }.of_event(&happens).unwrap();
            assert_eq!(chosen.len(), 100);
            assert_eq!(chosen.iter().filter(|&&row| happens[row] == kept).count(), 20);
        }
    }
}
