//! Whether rows are independent of each other, from the inputs alone.
//!
//! Neighbours in one input of a sequence of low discrepancy are ordered in others by its construction,
//! which makes indices by ranks wrong by up to 0.7. With `s` the standardized ranks of input j in ascending
//! order of input i, and m windows of four rows,
//!
//! ```text
//! z_ij = √(m / 1.5) mean(s_k s_(k+1) - (s_k s_(k+2) + s_k s_(k+3)) / 2)               (Rw1)
//! Z = Σ z_ij²,   χ² of as many degrees of freedom as there are z_ij                   (Rw2)
//! c_ij = (Σ (N - e)² / e - 49) / √98,   N rows in a cell of 8 x 8 of ranks, e = n / 64  (Rw3)
//! ```
//!
//! - (Rw1), (Rw2): independent rows have no z beyond chance, whether the inputs depend on each other or
//!   not: a mean of j that changes slowly with i is the same one, two and three places apart. Of 256 rows
//!   of Sobol's sequence with 40 % deleted, 6 inputs, Z has p < 1e-9; of 3000 tables of random rows and of
//!   Latin hypercubes none has p < 1e-4.
//! - (Rw3): rows that fill the plane of two inputs more evenly than chance have c below zero, those of
//!   inputs that depend on each other above. Coordinates of sequences that are rounded are found by this
//!   alone.
//! - **Shared values**: in designs of Saltelli a row has all inputs but one of another row, and shuffled it
//!   still has. Of rows next to each other in input i that have the same value of it, let K of T be the
//!   values of others that they share, too, and F those that they share by chance:
//!
//! ```text
//! K > 0.1 T,   K > F + 5 √F,   mean (s - s')² > 1 of values that they do not share     (Rw4)
//! ```
//!
//! for every input of which a quarter of the rows has a value of another row, three inputs at least. By the
//! last one inputs that are rounded and depend on each other have no shared values.
//!
//! Rows depend on each other if (Rw4) is met, if Z, or the largest z of all, has p < 1e-5, or if the mean c
//! is below 0.6 of the least one possible. Latin hypercubes that are optimized have c, but no z: they pass.
//!
//! An input is a *coordinate* if, moreover, the sum of its c that are below zero is 2 deviations below that
//! of random rows. The points of two inputs on a circle leave most of the square empty: such inputs are not
//! coordinates.
//!
//! Columns of levels, with at most 16 different values or less than one in eight rows, have designs of
//! their own and are left out.

use rand::seq::SliceRandom;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::error::{RowPattern, SensitivityError};
use crate::measure::regression::{ranks, standardized};
use crate::parallel::*;
use crate::sample::random::stream;

/// Largest probability that independent rows are taken for dependent ones, by each of two tests.
const FALSE_PATTERNS: f64 = 1e-5;
/// Neighbours that are looked at, and other inputs on each side.
const MOST: usize = 2048;
const OTHERS: usize = 64;
/// Least number of rows.
const LEAST: usize = 30;
/// Cells along a side of the square of ranks.
const SIDE: usize = 8;
/// Mean and deviation of the lesser of 0 and a standard normal number.
const BELOW: [f64; 2] = [-0.398_942, 0.583_820];

/// What the rows of columns have in common.
pub(crate) struct Patterns {
    pairs: Vec<Pair>,
    columns: usize,
    /// The pattern of all rows and the two columns that show it most.
    found: Option<(RowPattern, [usize; 2])>,
}

/// Two columns.
struct Pair {
    of: [usize; 2],
    /// (Rw1) of neighbours in the one and in the other.
    z: [f64; 2],
    /// (Rw3).
    cells: f64,
}

/// A column of numbers.
struct Ranked {
    column: usize,
    order: Vec<usize>,
    /// Standardized ranks, and the part of the column that each row is in.
    scores: Vec<f64>,
    parts: Vec<usize>,
}

impl Patterns {
    pub(crate) fn new(columns: &[&[f64]], seed: u64) -> Self {
        let ranked: Vec<Ranked> = (columns.par_iter().enumerate())
            .map(|(column, values)| Ranked::new(column, values, seed))
            .collect::<Vec<_>>()
            .into_iter()
            .flatten()
            .collect();
        let couples: Vec<[usize; 2]> = (0..ranked.len())
            .flat_map(|one| (one + 1..ranked.len()).take(OTHERS).map(move |other| [one, other]))
            .collect();
        let pair = |&[one, other]: &[usize; 2]| Pair::new(&ranked[one], &ranked[other]);
        let pairs: Vec<Pair> = couples.par_iter().map(pair).collect();
        let rows = columns.first().map_or(0, |column| column.len());
        let found = shared(&ranked, columns).or_else(|| neighbours(&pairs)).or_else(|| even(&pairs, rows));
        Self { pairs, columns: columns.len(), found }
    }

    /// # Errors
    /// [`SensitivityError::DependentRows`] for rows that depend on each other.
    pub(crate) fn check(&self) -> Result<(), SensitivityError> {
        match self.found {
            Some((pattern, [input, other])) => Err(SensitivityError::DependentRows { input, other, pattern }),
            None => Ok(()),
        }
    }

    /// Which columns are coordinates of a sequence.
    pub(crate) fn coordinates(&self) -> Vec<bool> {
        let mut sums = vec![(0.0_f64, 0.0_f64); self.columns];
        for Pair { of, cells, .. } in &self.pairs {
            of.iter().for_each(|&i| sums[i] = (sums[i].0 + 1.0, sums[i].1 + cells.min(0.0) - BELOW[0]));
        }
        let is_even = |(count, sum): (f64, f64)| count > 0.0 && sum < -2.0 * BELOW[1] * count.sqrt();
        sums.into_iter().map(|of| self.found.is_some() && is_even(of)).collect()
    }
}

/// Rows in ascending order of values; those of equal values are in random order.
pub(crate) fn order(values: &[f64], seed: u64, input: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.shuffle(&mut stream(seed, input as u64));
    order.sort_by(|&i, &j| values[i].total_cmp(&values[j]));
    order
}

/// By (Rw4).
fn shared(ranked: &[Ranked], columns: &[&[f64]]) -> Option<(RowPattern, [usize; 2])> {
    let rows = columns.first()?.len();
    let tied: Vec<(&Ranked, Vec<[usize; 2]>)> = ranked
        .iter()
        .map(|of| (of, of.ties(columns[of.column])))
        .filter(|(_, ties)| 4 * ties.len() >= rows)
        .collect();
    let [(first, _), (second, _), _, ..] = &tied[..] else { return None };
    let share = |(of, ties): &(&Ranked, Vec<[usize; 2]>)| {
        let (mut pairs, mut equal, mut chance, mut apart) = (0.0, 0.0, 0.0, 0.0);
        for (other, _) in tied.iter().filter(|(other, _)| other.column != of.column) {
            let values = columns[other.column];
            pairs += ties.len() as f64;
            chance += ties.len() as f64 * other.chance(values);
            for &[a, b] in ties {
                let is_equal = values[a] == values[b];
                equal += f64::from(u8::from(is_equal));
                apart += (other.scores[a] - other.scores[b]).powi(2);
            }
        }
        let holds = equal > 0.1 * pairs && equal > chance + 5.0 * chance.sqrt() && apart > pairs - equal;
        holds.then_some(equal / pairs)
    };
    let shares = tied.iter().map(share).collect::<Option<Vec<f64>>>()?;
    let share = shares.iter().sum::<f64>() / shares.len() as f64;
    Some((RowPattern::Shared { share }, [first.column, second.column]))
}

/// By (Rw2), or by the largest (Rw1).
fn neighbours(pairs: &[Pair]) -> Option<(RowPattern, [usize; 2])> {
    let all = pairs
        .iter()
        .flat_map(|Pair { of: [one, other], z, .. }| [(z[0], [*one, *other]), (z[1], [*other, *one])]);
    let (z, of) = all.max_by(|one, other| one.0.abs().total_cmp(&other.0.abs()))?;
    let count = 2.0 * pairs.len() as f64;
    let p = |freedoms: f64, square: f64| ChiSquared::new(freedoms).map_or(1.0, |law| law.sf(square));
    let sum: f64 = pairs.iter().flat_map(|pair| pair.z).map(|z| z * z).sum();
    let p = p(count, sum).min(count * p(1.0, z * z));
    (p < FALSE_PATTERNS).then_some((RowPattern::Neighbours { z }, of))
}

/// By (Rw3).
fn even(pairs: &[Pair], rows: usize) -> Option<(RowPattern, [usize; 2])> {
    let most = pairs.iter().min_by(|one, other| one.cells.total_cmp(&other.cells))?;
    let count = pairs.len() as f64;
    let mean = pairs.iter().map(|pair| pair.cells).sum::<f64>() / count;
    let cells = SIDE * SIDE;
    let least = of_counts((0..cells).map(|cell| rows / cells + usize::from(cell < rows % cells)), rows);
    (mean < 0.6 * least && mean * count.sqrt() < -4.0)
        .then_some((RowPattern::Even { z: most.cells }, most.of))
}

/// (Rw3) of the numbers of rows in the cells.
fn of_counts(counts: impl Iterator<Item = usize>, rows: usize) -> f64 {
    let expected = rows as f64 / (SIDE * SIDE) as f64;
    let square: f64 = counts.map(|count| (count as f64 - expected).powi(2) / expected).sum();
    let freedoms = ((SIDE - 1) * (SIDE - 1)) as f64;
    (square - freedoms) / (2.0 * freedoms).sqrt()
}

impl Ranked {
    /// `None` for a column of few rows or of levels.
    fn new(column: usize, values: &[f64], seed: u64) -> Option<Self> {
        let n = values.len();
        let order = order(values, seed, column);
        let different = 1 + order.windows(2).filter(|pair| values[pair[0]] != values[pair[1]]).count();
        if n < LEAST || different <= 2 * SIDE || 8 * different < n {
            return None;
        }
        let mut parts = vec![0; n];
        order.iter().enumerate().for_each(|(place, &row)| parts[row] = place * SIDE / n);
        Some(Self { column, scores: standardized(ranks(values))?, order, parts })
    }

    /// Rows next to each other that have the same value.
    fn ties(&self, values: &[f64]) -> Vec<[usize; 2]> {
        let pairs = self.order.windows(2).map(|pair| [pair[0], pair[1]]);
        pairs.filter(|&[a, b]| values[a] == values[b]).collect()
    }

    /// Probability that two rows at random have the same value.
    fn chance(&self, values: &[f64]) -> f64 {
        let runs = self.order.chunk_by(|&a, &b| values[a] == values[b]);
        runs.map(|run| (run.len() as f64 / values.len() as f64).powi(2)).sum()
    }

    /// (Rw1) of another column.
    fn z(&self, other: &Self) -> f64 {
        let step = self.order.len() / MOST + 1;
        let contrast = |rows: &[usize]| {
            let [first, next, two, three] = [0, 1, 2, 3].map(|place| other.scores[rows[place]]);
            first * (next - 0.5 * (two + three))
        };
        let (sum, count) = (self.order.windows(4).step_by(step))
            .fold((0.0, 0.0), |(sum, count), rows| (sum + contrast(rows), count + 1.0));
        sum / f64::sqrt(1.5 * count)
    }
}

impl Pair {
    fn new(one: &Ranked, other: &Ranked) -> Self {
        let mut counts = [0_usize; SIDE * SIDE];
        one.parts.iter().zip(&other.parts).for_each(|(a, b)| counts[a * SIDE + b] += 1);
        let cells = of_counts(counts.into_iter(), one.parts.len());
        Self { of: [one.column, other.column], z: [one.z(other), other.z(one)], cells }
    }
}
