//! δ and PAWN that count as true, from 2^26 rows, and R² of HSIC from 2^16.
//!
//! With `p_mb` the share of the rows whose input is in part m and whose output is in part b, and `q_mb` the
//! product of the shares of the two parts,
//!
//! ```text
//! δ = max_M Σ_mb sign(p_mb - q_mb) (p'_mb - q'_mb) / 2,   M = 32, 64, … 512 parts of each    (Ta1)
//! HSIC = [tr K L + Σ K Σ L / ((n-1) (n-2)) - 2 Σ K L / (n-2)] / (n (n-3))                    (Ta2)
//! ```
//!
//! - (Ta1) takes the sign from one half of the rows and the size from the other, and the same exchanged: the
//!   sum of absolute values would be above 0 for an input without an effect, this is not. A sum over parts is
//!   at most δ, and too small where few rows tell the sign; the largest is the nearest. What is missing is
//!   below 0.003, most where a density has a jump.
//! - (Ta2) with K and L without their diagonals has no bias: L. Song et al., *Feature selection via
//!   dependence maximization*, J. Mach. Learn. Res. 13 (2012). It is the mean over groups of 256 rows.
//! - PAWN is that of the ten parts of `given::pawn`.

use cdpr_sensitivity::{RandomDesign, SampleDesign, SensitivityError, SobolDesign, observe};
use serde::{Deserialize, Serialize};

use crate::functions::Function;

/// Number of sequences and rows of each, of δ and PAWN.
const SEQUENCES: u64 = 256;
const ROWS: usize = 1 << 18;
/// Rows of HSIC, whose time is that of 256 kernels for each.
const ROWS_OF_HSIC: usize = 1 << 16;
/// Parts of δ, a power of two, and the least number that they are joined to.
const PARTS: usize = 512;
const LEAST_PARTS: usize = 32;
/// Parts of an input, and of the output, of PAWN.
const PARTS_OF_PAWN: usize = 10;
const GRID: usize = 4096;
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
        let sequence = |seed| table(&SobolDesign::scrambled(function.inputs.clone(), ROWS, seed)?, function);
        let edges = edges(sequence(u64::MAX)?.1);
        let mut cells: Vec<Cells> = function.inputs.iter().map(|_| Cells::none()).collect();
        for seed in 0..SEQUENCES {
            let (columns, outputs) = sequence(u64::MAX - 1 - seed)?;
            let places: Vec<usize> = outputs.iter().map(|y| edges.partition_point(|edge| edge < y)).collect();
            for ((column, input), cells) in columns.iter().zip(&function.inputs).zip(&mut cells) {
                cells.add(column.iter().map(|&x| input.law.cdf(x)), &places, seed % 2 == 0);
            }
        }
        let delta = cells.iter().map(Cells::delta).collect();
        let pawn = cells.iter().map(|cells| median_distance(&cells.of_pawn)).collect();
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

/// Ends of parts of equal size of the outputs, in ascending order.
fn edges(mut outputs: Vec<f64>) -> Vec<f64> {
    outputs.sort_unstable_by(f64::total_cmp);
    (1..GRID).map(|edge| outputs[edge * outputs.len() / GRID]).collect()
}

/// Numbers of rows in each part of an input and of the output.
struct Cells {
    /// Of the two halves of the rows.
    halves: [Vec<f64>; 2],
    of_pawn: Vec<Vec<f64>>,
}

impl Cells {
    fn none() -> Self {
        let half = || vec![0.0; PARTS * PARTS];
        Self { halves: [half(), half()], of_pawn: vec![vec![0.0; GRID]; PARTS_OF_PAWN] }
    }

    /// Adds rows: the probability of an input's values up to each one, and the parts of the outputs.
    fn add(&mut self, probabilities: impl Iterator<Item = f64>, outputs: &[usize], first: bool) {
        let part = |p: f64, count: usize| ((p * count as f64) as usize).min(count - 1);
        for (p, &output) in probabilities.zip(outputs) {
            let cell = part(p, PARTS) * PARTS + output * PARTS / GRID;
            self.halves[usize::from(first)][cell] += 1.0;
            self.of_pawn[part(p, PARTS_OF_PAWN)][output] += 1.0;
        }
    }

    /// δ (Ta1).
    fn delta(&self) -> f64 {
        let mut halves = self.halves.clone();
        let (mut count, mut most) = (PARTS, 0.0_f64);
        while count >= LEAST_PARTS {
            let [one, other] = halves.each_ref().map(|half| excess(half, count));
            let product = |(one, other): (&f64, &f64)| {
                let sign = |x: f64| if x == 0.0 { 0.0 } else { x.signum() };
                0.5 * (sign(*one) * other + sign(*other) * one)
            };
            most = most.max(0.5 * one.iter().zip(&other).map(product).sum::<f64>());
            halves = halves.map(|half| joined(&half, count));
            count /= 2;
        }
        most
    }
}

/// `p_mb - q_mb` of counts in `count` parts of each.
fn excess(cells: &[f64], count: usize) -> Vec<f64> {
    let all: f64 = cells.iter().sum();
    let inputs: Vec<f64> = cells.chunks(count).map(|of| of.iter().sum::<f64>() / all).collect();
    let outputs: Vec<f64> =
        (0..count).map(|b| cells.iter().skip(b).step_by(count).sum::<f64>() / all).collect();
    let cell = |(at, rows): (usize, &f64)| rows / all - inputs[at / count] * outputs[at % count];
    cells.iter().enumerate().map(cell).collect()
}

/// Counts in half as many parts of each.
fn joined(cells: &[f64], count: usize) -> Vec<f64> {
    let half = count / 2;
    let cell = |at: usize| {
        let corner = 2 * (at / half) * count + 2 * (at % half);
        cells[corner] + cells[corner + 1] + cells[corner + count] + cells[corner + count + 1]
    };
    (0..half * half).map(cell).collect()
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

    /// HSIC (Ta2).
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
