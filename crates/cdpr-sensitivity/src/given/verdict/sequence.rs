//! Which inputs are coordinates of a sequence of low discrepancy, such as that of Sobol'.
//!
//! Such inputs are independent of each other by construction, but their rows are not: the points of two
//! coordinates make a pattern. A test that takes rows as random finds the pattern, most clearly in pairs of
//! inputs, in neighbours and in distances from the middle.
//!
//! - **In their order.** Eight rows in turn have a value in each eighth of a coordinate. Random rows do so in
//!   0.2 % of all cases, and a coordinate that is mixed with another one by a correlation of 0.1 in a quarter
//!   of them. Half of all eights are asked for. Ranks count, whatever the laws are.
//! - **In another order.** Neighbours in one coordinate lie far apart in others, z (Ra7) of
//!   [`rank`](crate::given::rank). So they do on a circle, whose points leave most of the square empty: the
//!   cells of a square of ranks are filled as evenly as by random points, but for a correlation.

use crate::given::data::Kind;
use crate::given::rank::{LARGEST_Z, farthest};
use crate::measure::regression::ranks;
use crate::parallel::*;

/// Rows that fill the parts of a coordinate.
const BLOCK: usize = 8;

/// Which inputs are coordinates of a sequence: two at least, or none.
///
/// `rows` has the columns of all rows in their order, `drawn` those of the rows that the tests take.
pub(crate) fn coordinates(rows: &[&[f64]], drawn: &[Vec<f64>], kinds: &[Kind], seed: u64) -> Vec<bool> {
    let mut found: Vec<bool> = rows.par_iter().map(|column| fills(column) && !repeats(column)).collect();
    for (input, (z, other)) in farthest(drawn, seed).into_iter().enumerate() {
        if z > LARGEST_Z && fill_a_square(&drawn[input], &drawn[other]) {
            (found[input], found[other]) = (true, true);
        }
    }
    found.iter_mut().zip(kinds).for_each(|(is, kind)| *is &= *kind == Kind::Numbers);
    let count = found.iter().filter(|is| **is).count();
    if count > 1 { found } else { vec![false; kinds.len()] }
}

/// Whether two columns fill the cells of a square of ranks, up to a correlation: chi-square over the rows is
/// at most that of random points and ρ²/(1 - ρ²), which is more than a normal copula has in so few cells.
fn fill_a_square(one: &[f64], other: &[f64]) -> bool {
    let [one, other] = [one, other].map(ranks);
    let n = one.len() as f64;
    let product = |(a, b): (&f64, &f64)| ((a - 0.5) / n - 0.5) * ((b - 0.5) / n - 0.5);
    let correlation = 12.0 * one.iter().zip(&other).map(product).sum::<f64>() / n;
    let allowed = correlation.powi(2) / (1.0 - correlation.powi(2)).max(1e-9);
    [4_usize, 8].into_iter().all(|side| {
        let cell = |rank: f64| (((rank - 0.5) / n * side as f64) as usize).min(side - 1);
        let mut counts = vec![0.0; side * side];
        one.iter().zip(&other).for_each(|(a, b)| counts[cell(*a) * side + cell(*b)] += 1.0);
        let expected = n / counts.len() as f64;
        let square: f64 = counts.iter().map(|count: &f64| (count - expected).powi(2) / expected).sum();
        let freedoms = ((side - 1) * (side - 1)) as f64;
        square <= freedoms + 5.0 * (2.0 * freedoms).sqrt() + n * allowed
    })
}

/// Whether each row has the value of that eight rows before, as in a design whose levels take turns.
fn repeats(column: &[f64]) -> bool {
    column.windows(BLOCK + 1).all(|rows| rows[0] == rows[BLOCK])
}

/// Whether eight rows in turn have a value in each eighth, in half of all eights from a first row on.
fn fills(column: &[f64]) -> bool {
    let n = column.len() as f64;
    let eighth = |rank: f64| ((rank - 0.5) / n * BLOCK as f64) as usize;
    let eighths: Vec<usize> = ranks(column).into_iter().map(eighth).collect();
    (0..BLOCK).any(|start| {
        let full = |block: &[usize]| (0..BLOCK).all(|eighth| block.contains(&eighth));
        let blocks = eighths.get(start..).unwrap_or_default().chunks_exact(BLOCK);
        let (all, filled) = (blocks.len(), blocks.filter(|block| full(block)).count());
        filled >= 2 && 2 * filled >= all
    })
}
