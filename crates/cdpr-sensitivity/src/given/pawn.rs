//! How much an input moves the distribution function of the output.
//!
//! The rows are cut into parts of equal size by the values of input i. With F the distribution function of
//! all outputs and `F_m` that of part m,
//!
//! ```text
//! KS_m = max_y |F(y) - F_m(y)|,   PAWN_i = median of KS_m,   largest_i = max KS_m     (Pa1)
//! ```
//!
//! F. Pianosi, T. Wagener, *Distribution-based sensitivity analysis from a generic input-output sample*,
//! Environ. Model. Softw. 108 (2018). It lies between 0 and 1 and has no unit. It is not 0 without an effect:
//! a part of few rows has a distribution function of its own. The level that 95 of 100 inputs without an
//! effect stay below is therefore estimated by random parts of the same sizes.

use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

use crate::error::SensitivityError;
use crate::given::data::GivenData;
use crate::given::rank::rows::order;
use crate::parallel::*;
use crate::sample::random::stream;

/// PAWN index of one input.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Pawn {
    /// Median of the distances (Pa1).
    pub median: f64,
    /// Largest distance (Pa1).
    pub largest: f64,
    /// Median that an input without an effect stays below in 95 of 100 tables.
    pub noise: f64,
}

/// Least number of rows.
pub const MIN_ROWS: usize = 20;
/// Usual number of parts, and least number of rows of each.
const PARTS: usize = 10;
const MIN_PART: usize = 10;
/// Number of random divisions behind the level of the noise, and the place of that level among them.
const DIVISIONS: usize = 199;
const LEVEL: usize = 190;

/// Indices of all inputs.
///
/// # Errors
/// [`SensitivityError::OutOfRange`] for fewer than [`MIN_ROWS`] outputs,
/// [`SensitivityError::ConstantSample`] if all outputs are equal.
pub fn pawn(data: &GivenData, seed: u64) -> Result<Vec<Pawn>, SensitivityError> {
    let observed = data.observed(MIN_ROWS)?;
    Ok(of_columns(&observed.columns, &observed.outputs, seed))
}

pub(crate) fn of_columns(columns: &[Vec<f64>], outputs: &[f64], seed: u64) -> Vec<Pawn> {
    let outputs = Outputs::new(outputs);
    let parts: Vec<Vec<Vec<usize>>> = columns.par_iter().map(|column| parts(column, seed)).collect();
    let sizes: Vec<Vec<usize>> = parts.iter().map(|parts| parts.iter().map(Vec::len).collect()).collect();
    // Most inputs share their sizes.
    let mut levels: Vec<(&Vec<usize>, f64)> = Vec::new();
    for sizes in &sizes {
        if !levels.iter().any(|(known, _)| *known == sizes) {
            levels.push((sizes, noise(&outputs, sizes, seed)));
        }
    }
    let of_input = |(parts, sizes): (Vec<Vec<usize>>, &Vec<usize>)| {
        let (median, largest) = distances(&outputs, parts.iter().map(Vec::as_slice));
        let noise = levels.iter().find(|(known, _)| *known == sizes).map_or(0.0, |(_, level)| *level);
        Pawn { median, largest, noise }
    };
    parts.into_iter().zip(&sizes).map(of_input).collect()
}

/// Rows of each part of equal size. An input of few values has a part for each.
fn parts(column: &[f64], seed: u64) -> Vec<Vec<usize>> {
    let order = order(column, seed, 0);
    let n = order.len();
    let count = PARTS.min(n / MIN_PART).max(2);
    let levels: Vec<Vec<usize>> =
        order.chunk_by(|&i, &j| column[i] == column[j]).take(count + 1).map(<[usize]>::to_vec).collect();
    if levels.len() <= count {
        return levels;
    }
    (0..count).map(|part| order[part * n / count..(part + 1) * n / count].to_vec()).collect()
}

/// The distribution function of all outputs at that of each row, and just below.
struct Outputs {
    at: Vec<f64>,
    below: Vec<f64>,
}

impl Outputs {
    fn new(outputs: &[f64]) -> Self {
        let mut sorted = outputs.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let n = sorted.len() as f64;
        let share = |count: usize| count as f64 / n;
        Self {
            at: outputs.iter().map(|y| share(sorted.partition_point(|other| other <= y))).collect(),
            below: outputs.iter().map(|y| share(sorted.partition_point(|other| other < y))).collect(),
        }
    }

    /// KS (Pa1) of some rows.
    fn distance(&self, rows: &[usize]) -> f64 {
        let mut places: Vec<(f64, f64)> = rows.iter().map(|&row| (self.at[row], self.below[row])).collect();
        places.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
        let n = places.len() as f64;
        let (mut before, mut distance) = (0, 0.0_f64);
        for equal in places.chunk_by(|one, other| one.0 == other.0) {
            let (at, below) = equal[0];
            let after = before + equal.len();
            distance = distance.max((after as f64 / n - at).abs()).max((below - before as f64 / n).abs());
            before = after;
        }
        distance
    }
}

/// Median and largest distance of parts.
fn distances<'a>(outputs: &Outputs, parts: impl Iterator<Item = &'a [usize]>) -> (f64, f64) {
    let mut distances: Vec<f64> = parts.map(|rows| outputs.distance(rows)).collect();
    distances.sort_unstable_by(f64::total_cmp);
    let n = distances.len();
    (0.5 * (distances[(n - 1) / 2] + distances[n / 2]), distances[n - 1])
}

/// Level of the median for random parts of these sizes.
fn noise(outputs: &Outputs, sizes: &[usize], seed: u64) -> f64 {
    let median = |division: usize| {
        let mut rows: Vec<usize> = (0..outputs.at.len()).collect();
        rows.shuffle(&mut stream(seed, 1 + division as u64));
        let mut first = 0;
        let parts = sizes.iter().map(|size| {
            first += size;
            &rows[first - size..first]
        });
        distances(outputs, parts).0
    };
    let mut medians: Vec<f64> = (0..DIVISIONS).into_par_iter().map(median).collect();
    medians.sort_unstable_by(f64::total_cmp);
    medians[LEVEL - 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_is_that_of_kolmogorov_and_smirnov_with_ties() {
        let y = [1.0, 1.0, 2.0, 3.0, 3.0, 3.0, 4.0, 9.0];
        let outputs = Outputs::new(&y);
        let rows = [2, 3, 4];
        let share = |of: &dyn Fn(f64) -> bool, rows: &[usize]| {
            rows.iter().filter(|&&row| of(y[row])).count() as f64 / rows.len() as f64
        };
        let all: Vec<usize> = (0..y.len()).collect();
        let at = |t: f64| (share(&|y| y <= t, &all) - share(&|y| y <= t, &rows)).abs();
        let greatest =
            [0.0, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 9.0].map(at).into_iter().fold(0.0, f64::max);
        assert_eq!(outputs.distance(&rows), greatest);
    }
}
