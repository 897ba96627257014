//! Which inputs are coordinates of a sequence of low discrepancy, such as that of Sobol'.
//!
//! Such inputs are independent of each other by construction, but their rows are not: the points of two
//! coordinates make a pattern. A test that takes rows as random finds the pattern, most clearly in pairs of
//! inputs, in neighbours and in distances from the middle.
//!
//! - **In their order.** Eight rows in turn have a value in each eighth of a coordinate. Random rows do so in
//!   0.2 % of all cases, and a coordinate that is mixed with another one by a correlation of 0.1 in a quarter
//!   of them. Half of all eights are asked for. Ranks count, whatever the laws are.
//! - **In another order**, and where rows are missing: the pattern of neighbours and of the plane of two
//!   inputs ([`rows`](crate::given::rank::rows)).

use crate::given::data::Kind;
use crate::given::rank::rows::Patterns;
use crate::measure::regression::ranks;
use crate::parallel::*;

/// Rows that fill the parts of a coordinate.
const BLOCK: usize = 8;
/// First rows that are searched for patterns.
const MOST: usize = 10_000;

/// Which inputs are coordinates of a sequence: two at least, or none.
///
/// `rows` has the columns of all rows in their order, `drawn` those of the rows that the tests take.
pub(crate) fn coordinates(rows: &[&[f64]], drawn: &[Vec<f64>], kinds: &[Kind], seed: u64) -> Vec<bool> {
    let mut found: Vec<bool> = rows.par_iter().map(|column| fills(column) && !repeats(column)).collect();
    let first = rows.iter().map(|column| &column[..column.len().min(MOST)]).collect();
    for columns in [first, drawn.iter().map(Vec::as_slice).collect::<Vec<_>>()] {
        let coordinates = Patterns::new(&columns, seed).coordinates();
        found.iter_mut().zip(coordinates).for_each(|(is, too)| *is |= too);
    }
    found.iter_mut().zip(kinds).for_each(|(is, kind)| *is &= *kind == Kind::Numbers);
    let count = found.iter().filter(|is| **is).count();
    if count > 1 { found } else { vec![false; kinds.len()] }
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
