//! Saltelli's design: blocks of points that differ in one input each.
//!
//! With a and b the first and last k coordinates of a point of Sobol's sequence in 2 k dimensions, one block
//! holds
//!
//! ```text
//! a,   ab_1 .. ab_k,   [ba_1 .. ba_k,]   b                                             (Sa1)
//! ab_i = a with the i-th coordinate of b,   ba_i = b with the i-th coordinate of a     (Sa2)
//! ```
//!
//! A. Saltelli, P. Annoni, I. Azzini, F. Campolongo, M. Ratto, S. Tarantola, *Variance based sensitivity
//! analysis of model output. Design and estimator for the total sensitivity index*, Comput. Phys. Commun. 181
//! (2010). The order of the rows is that of SALib. The estimator is [`crate::sobol_indices()`].
//!
//! With groups ([`SaltelliDesign::grouped`]) the coordinates of a whole group are exchanged at once, and a
//! block has a row for each group in place of each input: M. J. W. Jansen (1999), SALib's `groups`.
//!
//! A scrambled design takes every other block from one scrambled sequence, from which the indices are
//! estimated. The blocks between them come in rotation from [`SaltelliDesign::REPLICATES`] other scramblings.
//! The differences between these show the error of the indices, which a single sequence does not. The first
//! half of the blocks consists of the first half of each scrambling.
//!
//! The points (a, b) are stored, 16 bytes per input and block, because each of them serves k + 2 rows or
//! more.

use rand::Rng;
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

use crate::design::group::{Group, Overlap, check_groups};
use crate::design::input::Input;
use crate::design::sobol::Sobol;
use crate::design::{Layout, SampleDesign, check_origin, check_points, check_row, check_rows, to_values};
use crate::error::{SensitivityError, check_range};
use crate::parallel::*;
use crate::sample::random::stream;

/// Order of the indices that the blocks can estimate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// First-order and total indices: k + 2 points per block.
    First,
    /// Also indices of pairs of inputs: 2 k + 2 points per block.
    Second,
}

/// Blocks of points (Sa1). N = 2^m blocks from index 0 keep the balance of the sequence.
#[derive(Debug, Clone)]
pub struct SaltelliDesign {
    layout: Layout,
    plain: Sobol,
    /// Sequences of (a, b): the plain one, or that of the estimate and the replicates.
    sequences: Vec<Sobol>,
    first_index: u32,
    /// Points (a, b) of all blocks.
    pairs: Vec<f64>,
    order: Order,
    /// What is exchanged in the rows of a block: each input by itself, unless there are groups.
    groups: Vec<Group>,
}

impl SaltelliDesign {
    /// Number of independent scramblings beside that of the estimate.
    pub const REPLICATES: usize = 8;

    /// Makes `blocks` blocks from the plain sequence, starting at `first_index`.
    ///
    /// # Errors
    /// - [`SensitivityError::InvalidInput`] for an invalid input;
    /// - [`SensitivityError::OutOfRange`] for no input or more than half of [`Sobol::MAX_DIMENSIONS`], no
    ///   block, or points of the sequence beyond 2^32;
    /// - [`SensitivityError::OutOfMemory`] for more points than fit in memory;
    /// - [`SensitivityError::UnboundedAtZero`] if point 0 is among them and the law of an input has no lower
    ///   end.
    pub fn new(
        inputs: Vec<Input>,
        first_index: u32,
        blocks: usize,
        order: Order,
    ) -> Result<Self, SensitivityError> {
        check_origin(&inputs, first_index)?;
        Self::over(inputs, first_index, blocks, order, None)
    }

    /// Makes `blocks` blocks: half of them from one scrambled sequence, the others from
    /// [`SaltelliDesign::REPLICATES`] replicates of it.
    ///
    /// # Errors
    /// As [`SaltelliDesign::new`], but point 0 is allowed: scrambled, it is not zero.
    pub fn scrambled(
        inputs: Vec<Input>,
        blocks: usize,
        order: Order,
        seed: u64,
    ) -> Result<Self, SensitivityError> {
        Self::over(inputs, 0, blocks, order, Some(seed))
    }

    fn over(
        inputs: Vec<Input>,
        first_index: u32,
        blocks: usize,
        order: Order,
        seed: Option<u64>,
    ) -> Result<Self, SensitivityError> {
        let points = blocks.saturating_mul(block_points(order, inputs.len()));
        let layout = Layout::new(inputs, points, seed)?;
        check_points(first_index, blocks)?;
        let inputs = layout.inputs.len();
        let plain = radial_sequence(inputs)?;
        let sequences = seed.map_or_else(|| vec![plain.clone()], |seed| scramblings(&plain, seed));
        let pairs = extended(room(blocks, 2 * inputs)?, &sequences, first_index, blocks);
        let groups = Group::singles(&layout.inputs);
        Ok(Self { layout, plain, sequences, first_index, pairs, order, groups })
    }

    /// Returns this design with the same points (a, b), in whose blocks groups of inputs are exchanged. The
    /// indices are then those of groups: the first-order index is the share of the variance that the inputs
    /// of the group cause alone or with each other, the total index that in which any of them takes part.
    ///
    /// For [`Order::First`] an input may be in several groups, or in none.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for no group; [`SensitivityError::WrongGroup`] for one without
    /// inputs, with an input twice or one that does not exist, and for [`Order::Second`] for groups with a
    /// common input.
    pub fn grouped(self, groups: Vec<Group>) -> Result<Self, SensitivityError> {
        let overlap = if self.order == Order::First { Overlap::Allowed } else { Overlap::Disjoint };
        check_groups(&groups, self.inputs(), overlap)?;
        let points = self.blocks() * block_points(self.order, groups.len());
        Ok(Self { layout: Layout { points, ..self.layout }, groups, ..self })
    }

    /// What is exchanged in the rows of a block, and what the indices are of: each input by itself, unless
    /// there are groups.
    #[must_use]
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// Returns this design with another number of blocks. The blocks that both have are the same.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for no block, or points of the sequence beyond 2^32;
    /// [`SensitivityError::OutOfMemory`] for more points than fit in memory.
    pub fn resized(&self, blocks: usize) -> Result<Self, SensitivityError> {
        check_points(self.first_index, blocks)?;
        let size = 2 * self.inputs().len();
        let known = &self.pairs[..self.pairs.len().min(size * blocks)];
        let mut pairs = room(blocks, size)?;
        pairs.extend_from_slice(known);
        let pairs = extended(pairs, &self.sequences, self.first_index, blocks);
        let layout = Layout { points: blocks * self.block_points(), ..self.layout.clone() };
        Ok(Self { layout, pairs, ..self.clone() })
    }

    /// Index of the first point in the sequence. It is 0 for scrambled sequences.
    #[must_use]
    pub fn first_index(&self) -> u32 {
        self.first_index
    }

    /// Whether the design has replicates beside the sequence of the estimate.
    #[must_use]
    pub fn is_scrambled(&self) -> bool {
        self.sequences.len() > 1
    }

    /// Replicate to which a block belongs. The blocks of the estimate have `None`.
    pub(crate) fn replicate_of(&self, block: usize) -> Option<usize> {
        place(self.sequences.len(), block).0.checked_sub(1)
    }

    /// Number of blocks N.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.points() / self.block_points()
    }

    /// Order of the indices that the blocks can estimate.
    #[must_use]
    pub fn order(&self) -> Order {
        self.order
    }

    /// Number of points of one block.
    #[must_use]
    pub fn block_points(&self) -> usize {
        block_points(self.order, self.groups.len())
    }

    /// Point (a, b) of a block.
    fn pair(&self, block: usize) -> &[f64] {
        let size = 2 * self.inputs().len();
        &self.pairs[size * block..][..size]
    }

    /// Writes row `within` of the block of (a, b), Eq. (Sa1).
    fn write(&self, pair: &[f64], within: usize, row: &mut [f64]) {
        let (a, b) = pair.split_at(row.len());
        let groups = self.groups.len();
        let (from, exchanged, other) = if within <= groups {
            (a, within.checked_sub(1), b)
        } else if within + 1 < self.block_points() {
            (b, Some(within - groups - 1), a)
        } else {
            (b, None, a)
        };
        row.copy_from_slice(from);
        if let Some(group) = exchanged {
            self.groups[group].inputs.iter().for_each(|&input| row[input] = other[input]);
        }
    }
}

impl SampleDesign for SaltelliDesign {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn replicate(&self, seed: u64) -> Self {
        let sequences = scramblings(&self.plain, seed);
        let pairs = extended(Vec::new(), &sequences, self.first_index, self.blocks());
        Self { layout: self.layout.reseeded(seed), sequences, pairs, ..self.clone() }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        let (block, within) = (index / self.block_points(), index % self.block_points());
        self.write(self.pair(block), within, point);
        Ok(())
    }

    /// The values of a block are those of its a and b.
    fn rows(&self, first: usize, rows: &mut [f64]) -> Result<(), SensitivityError> {
        check_rows(self, first, rows)?;
        let (size, k) = (self.block_points(), self.inputs().len());
        let (mut pair, mut known) = (vec![0.0; 2 * k], None);
        for (index, row) in (first..).zip(rows.chunks_exact_mut(k)) {
            if known.replace(index / size) != Some(index / size) {
                pair.copy_from_slice(self.pair(index / size));
                to_values(self.inputs(), &mut pair);
            }
            self.write(&pair, index % size, row);
        }
        Ok(())
    }
}

/// Number of points of one block for this many groups.
fn block_points(order: Order, groups: usize) -> usize {
    match order {
        Order::First => groups + 2,
        Order::Second => 2 * groups + 2,
    }
}

/// Plain sequence of the points (a, b).
pub(crate) fn radial_sequence(inputs: usize) -> Result<Sobol, SensitivityError> {
    check_range("inputs", inputs as u64, 1, Sobol::MAX_DIMENSIONS as u64 / 2)?;
    Sobol::new(2 * inputs)
}

/// Independent scramblings of a sequence, each with the inputs on random dimensions of a and of b.
fn scramblings(plain: &Sobol, seed: u64) -> Vec<Sobol> {
    let k = plain.dimensions() / 2;
    let scrambling = |number: u64| {
        let mut generator = stream(seed, number);
        let key = generator.next_u64();
        let mut order: Vec<usize> = (0..2 * k).collect();
        let (a, b) = order.split_at_mut(k);
        a.shuffle(&mut generator);
        b.shuffle(&mut generator);
        plain.reordered(&order).rescrambled(key)
    };
    (0..=SaltelliDesign::REPLICATES as u64).map(scrambling).collect()
}

/// Sequence from which a block is taken, and the index in it.
fn place(sequences: usize, block: usize) -> (usize, usize) {
    match (sequences - 1, block / 2) {
        (0, _) => (0, block),
        (_, half) if block.is_multiple_of(2) => (0, half),
        (replicates, half) => (1 + half % replicates, half / replicates),
    }
}

/// Reserves memory for the points of this many blocks.
fn room(blocks: usize, size: usize) -> Result<Vec<f64>, SensitivityError> {
    let mut points = Vec::new();
    let fits = blocks.checked_mul(size).is_some_and(|values| points.try_reserve_exact(values).is_ok());
    if fits {
        Ok(points)
    } else {
        Err(SensitivityError::OutOfMemory { field: "blocks", value: blocks as u64 })
    }
}

/// Extends known points (a, b) of the first blocks to all blocks.
fn extended(mut points: Vec<f64>, sequences: &[Sobol], first_index: u32, blocks: usize) -> Vec<f64> {
    let (size, known) = (sequences[0].dimensions(), points.len());
    let first = known / size;
    points.resize(blocks * size, 0.0);
    points[known..].par_chunks_mut(size).enumerate().for_each(|(offset, point)| {
        let (sequence, index) = place(sequences.len(), first + offset);
        // `check_points` has ensured that the index is below 2^32.
        let written = sequences[sequence].point(first_index + index as u32, point);
        debug_assert!(written.is_ok(), "a point has the dimensions of its sequence");
    });
    points
}
