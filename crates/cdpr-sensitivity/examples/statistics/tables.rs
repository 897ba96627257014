//! δ and PAWN that count as true, from 2^20 rows, and R² of HSIC from 2^16.
//!
//! With `p_mb` the share of the rows of part m of an input whose output is in part b of all outputs, and `p_b`
//! that of all rows,
//!
//! ```text
//! δ = Σ_m 1/M Σ_b sign(p_mb - p_b) (p'_mb - p'_b) / 2,   M = 64 parts of each               (X1)
//! HSIC = [tr K L + Σ K Σ L / ((n-1) (n-2)) - 2 Σ K L / (n-2)] / (n (n-3))                   (X2)
//! ```
//!
//! - (X1) takes the sign from one of two sequences and the size from the other, and the same exchanged: the
//!   sum of absolute values would be above 0 for an input without an effect, this is not.
//! - (X2) with K and L without their diagonals has no bias: L. Song et al., *Feature selection via dependence
//!   maximization*, J. Mach. Learn. Res. 13 (2012). It is the mean over groups of 256 rows.
//! - PAWN is that of the ten parts of `given::pawn`.

use cdpr_sensitivity::{RandomDesign, SampleDesign, SensitivityError, SobolDesign, observe};
use serde::{Deserialize, Serialize};

use crate::functions::Function;

const ROWS: usize = 1 << 20;
/// Rows of HSIC, whose time is that of 256 kernels for each.
const ROWS_OF_HSIC: usize = 1 << 16;
const PARTS: usize = 64;
const PARTS_OF_PAWN: usize = 10;
const GROUP: usize = 256;

/// Values of all inputs.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct OfTables {
    pub(crate) delta: Vec<f64>,
    pub(crate) pawn: Vec<f64>,
    pub(crate) r_squared: Vec<f64>,
}

impl OfTables {
    pub(crate) fn of(function: &Function) -> Result<Self, SensitivityError> {
        // Two independent sequences: the errors of two halves of one would cancel each other.
        let half = |seed| SobolDesign::scrambled(function.inputs.clone(), ROWS / 2, seed);
        let (mut columns, mut outputs) = table(&half(u64::MAX)?, function)?;
        let (further, of_further) = table(&half(u64::MAX - 1)?, function)?;
        columns.iter_mut().zip(&further).for_each(|(column, further)| column.extend(further));
        outputs.extend(of_further);
        let places = places(&outputs);
        let (delta, pawn) = columns.iter().map(|column| delta_and_pawn(column, &places)).unzip();
        let design = RandomDesign::new(function.inputs.clone(), ROWS_OF_HSIC, u64::MAX)?;
        let (columns, outputs) = table(&design, function)?;
        let kernels = Kernels::new(&outputs);
        let of_outputs = kernels.dependence(&kernels);
        let of_column = |column: &Vec<f64>| {
            let of = Kernels::new(column);
            of.dependence(&kernels) / (of.dependence(&of) * of_outputs).sqrt()
        };
        Ok(Self { delta, pawn, r_squared: columns.iter().map(of_column).collect() })
    }
}

/// Columns of the inputs, and outputs, of the rows that have one.
fn table<D: SampleDesign + Sync>(
    design: &D,
    function: &Function,
) -> Result<(Vec<Vec<f64>>, Vec<f64>), SensitivityError> {
    let outputs = observe(design, function.model)?;
    let mut columns = vec![Vec::new(); function.inputs.len()];
    let mut row = vec![0.0; columns.len()];
    for (index, output) in outputs.iter().enumerate() {
        if output.is_some() {
            design.row(index, &mut row)?;
            columns.iter_mut().zip(&row).for_each(|(column, x)| column.push(*x));
        }
    }
    Ok((columns, outputs.into_iter().flatten().collect()))
}

/// The share of all values up to each one, from above 0 to 1.
fn places(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let place = |value: &f64| sorted.partition_point(|other| other <= value) as f64 / sorted.len() as f64;
    values.iter().map(place).collect()
}

/// The part of a place among `count`.
fn part(place: f64, count: usize) -> usize {
    ((place * count as f64).ceil() as usize).clamp(1, count) - 1
}

/// δ (X1), and the median of the largest distances between distribution functions, on a grid of the outputs.
fn delta_and_pawn(column: &[f64], outputs: &[f64]) -> (f64, f64) {
    const GRID: usize = 4096;
    let mut cells = [[[0.0; PARTS]; PARTS]; 2];
    let mut fine = vec![vec![0.0; GRID]; PARTS_OF_PAWN];
    for (row, (x, y)) in places(column).into_iter().zip(outputs).enumerate() {
        cells[usize::from(2 * row >= outputs.len())][part(x, PARTS)][part(*y, PARTS)] += 1.0;
        fine[part(x, PARTS_OF_PAWN)][part(*y, GRID)] += 1.0;
    }
    let differences = cells.map(|half| {
        let rows: f64 = half.iter().flatten().sum();
        let all: [f64; PARTS] = std::array::from_fn(|b| half.iter().map(|of| of[b]).sum::<f64>() / rows);
        half.map(|of| {
            let rows: f64 = of.iter().sum();
            std::array::from_fn::<f64, PARTS, _>(|b| of[b] / rows - all[b])
        })
    });
    let [one, other] = &differences;
    let product = |(one, other): (&f64, &f64)| {
        let sign = |x: f64| if x == 0.0 { 0.0 } else { x.signum() };
        0.5 * (sign(*one) * other + sign(*other) * one)
    };
    let sum: f64 = one.iter().flatten().zip(other.iter().flatten()).map(product).sum();
    (0.5 * sum / PARTS as f64, median_distance(&fine))
}

/// The median over parts of the largest distance between the distribution function of a part and of all.
fn median_distance(parts: &[Vec<f64>]) -> f64 {
    let all: Vec<f64> = (0..parts[0].len()).map(|b| parts.iter().map(|of| of[b]).sum()).collect();
    let rows: f64 = all.iter().sum();
    let distance = |of: &Vec<f64>| {
        let own: f64 = of.iter().sum();
        let mut reached = 0.0;
        of.iter().zip(&all).fold(0.0_f64, |most, (own_b, all_b)| {
            reached += own_b / own - all_b / rows;
            most.max(f64::abs(reached))
        })
    };
    let mut distances: Vec<f64> = parts.iter().map(distance).collect();
    distances.sort_unstable_by(f64::total_cmp);
    let middle = distances.len() / 2;
    0.5 * (distances[middle - 1] + distances[middle])
}

/// Values in groups, for Gaussian kernels.
struct Kernels<'a> {
    values: &'a [f64],
    exponent: f64,
}

impl<'a> Kernels<'a> {
    fn new(values: &'a [f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / n;
        Self { values, exponent: -0.5 / variance }
    }

    /// HSIC (X2).
    fn dependence(&self, other: &Self) -> f64 {
        let groups = self.values.chunks_exact(GROUP).zip(other.values.chunks_exact(GROUP));
        let count = groups.len() as f64;
        let of_group = |(one, two): (&[f64], &[f64])| {
            let (mut both, mut all, mut sums) = (0.0, [0.0; 2], 0.0);
            for i in 0..GROUP {
                let mut rows = [0.0; 2];
                for j in (0..GROUP).filter(|j| *j != i) {
                    let k = (self.exponent * (one[i] - one[j]).powi(2)).exp();
                    let l = (other.exponent * (two[i] - two[j]).powi(2)).exp();
                    both += k * l;
                    rows = [rows[0] + k, rows[1] + l];
                }
                all = [all[0] + rows[0], all[1] + rows[1]];
                sums += rows[0] * rows[1];
            }
            let n = GROUP as f64;
            (both + all[0] * all[1] / ((n - 1.0) * (n - 2.0)) - 2.0 * sums / (n - 2.0)) / (n * (n - 3.0))
        };
        groups.map(of_group).sum::<f64>() / count
    }
}
