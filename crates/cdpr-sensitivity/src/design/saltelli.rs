//! The design of Saltelli: blocks of points that differ in one input each.
//!
//! With a and b the first and last k coordinates of a point of Sobol's sequence in 2 k dimensions, one block holds
//!
//! ```text
//! a,   ab_1 .. ab_k,   [ba_1 .. ba_k,]   b                                (1)
//! ab_i = a with the i-th coordinate of b,   ba_i = b with the i-th coordinate of a      (2)
//! ```
//!
//! A. Saltelli, P. Annoni, I. Azzini, F. Campolongo, M. Ratto, S. Tarantola, *Variance based sensitivity analysis of
//! model output. Design and estimator for the total sensitivity index*, Comput. Phys. Commun. 181 (2010); the order of
//! the rows is that of SALib. [`crate::sobol_indices()`] is its estimator.
//!
//! A scrambled design takes its blocks by turns from [`REPLICATES`] independent scramblings of the sequence. What differs
//! between them is the error of the indices, which no single sequence shows; and the first half of the blocks is the first
//! half of each.
//!
//! The points (a, b) are stored, 16 bytes an input and block: each serves k + 2 rows or more.

use rand::Rng;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::design::input::Input;
use crate::design::sobol::{MAX_DIMENSIONS, Sobol};
use crate::design::{SampleDesign, check_origin, check_points, check_row};
use crate::error::{SensitivityError, check_range};
use crate::sample::random::stream;

/// Which indices the blocks are for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// First-order and total indices: k + 2 points a block.
    First,
    /// Those of pairs of inputs as well: 2 k + 2 points a block.
    Second,
}

/// Number of independent scramblings of a scrambled [`SaltelliDesign`].
pub const REPLICATES: usize = 8;

/// Blocks (1). N = 2^m blocks from index 0 keep the balance of the sequence.
#[derive(Debug, Clone)]
pub struct SaltelliDesign {
    inputs: Vec<Input>,
    /// Sequences of (a, b), taken by turns: the plain one, or scrambled ones.
    sequences: Vec<Sobol>,
    first_index: u32,
    /// (a, b) of all blocks.
    points: Vec<f64>,
    order: Order,
    seed: Option<u64>,
}

impl SaltelliDesign {
    /// `blocks` blocks over the plain sequence from `first_index` on.
    ///
    /// # Errors
    /// - [`SensitivityError::InvalidInput`] for an input that is not valid;
    /// - [`SensitivityError::OutOfRange`] for no input or more than half of [`MAX_DIMENSIONS`], no block, or points of
    ///   the sequence beyond 2^32;
    /// - [`SensitivityError::OutOfMemory`] for more points than fit in memory;
    /// - [`SensitivityError::UnboundedAtZero`] if point 0 is among them and the law of an input has no lower end.
    pub fn new(
        inputs: Vec<Input>,
        first_index: u32,
        blocks: usize,
        order: Order,
    ) -> Result<Self, SensitivityError> {
        check_origin(&inputs, first_index)?;
        Self::over(inputs, first_index, blocks, order, None)
    }

    /// `blocks` blocks over the first points of [`REPLICATES`] scrambled sequences, by turns.
    ///
    /// # Errors
    /// As [`SaltelliDesign::new`], but point 0 may be among the points: it is not zero.
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
        inputs.iter().try_for_each(Input::validate)?;
        check_points(first_index, blocks)?;
        let plain = radial_sequence(inputs.len())?;
        let sequences = seed.map_or_else(|| vec![plain.clone()], |seed| scramblings(&plain, seed));
        let points = extended(room(blocks, 2 * inputs.len())?, &sequences, first_index, blocks);
        Ok(Self { inputs, sequences, first_index, points, order, seed })
    }

    /// This design with another number of blocks: those that both have are the same.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for no block, or points of the sequence beyond 2^32; [`SensitivityError::OutOfMemory`].
    pub fn resized(&self, blocks: usize) -> Result<Self, SensitivityError> {
        check_points(self.first_index, blocks)?;
        let known = &self.points[..self.points.len().min(2 * self.inputs.len() * blocks)];
        let mut points = room(blocks, 2 * self.inputs.len())?;
        points.extend_from_slice(known);
        let points = extended(points, &self.sequences, self.first_index, blocks);
        Ok(Self { points, ..self.clone() })
    }

    /// Index in the sequence of the first point; 0 of scrambled ones.
    #[must_use]
    pub fn first_index(&self) -> u32 {
        self.first_index
    }

    /// Number of sequences that the blocks are taken from by turns.
    #[must_use]
    pub fn sequences(&self) -> usize {
        self.sequences.len()
    }

    /// Number of blocks N.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.points.len() / (2 * self.inputs.len())
    }

    /// Which indices the blocks are for.
    #[must_use]
    pub fn order(&self) -> Order {
        self.order
    }

    /// Points of one block.
    #[must_use]
    pub fn block_points(&self) -> usize {
        match self.order {
            Order::First => self.inputs.len() + 2,
            Order::Second => 2 * self.inputs.len() + 2,
        }
    }
}

impl SampleDesign for SaltelliDesign {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn points(&self) -> usize {
        self.blocks() * self.block_points()
    }

    fn seed(&self) -> Option<u64> {
        self.seed
    }

    fn replicate(&self, seed: u64) -> Self {
        let sequences = scramblings(&self.sequences[0], seed);
        let points = extended(Vec::new(), &sequences, self.first_index, self.blocks());
        Self { sequences, points, seed: Some(seed), ..self.clone() }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        let k = self.inputs.len();
        let (block, place) = (index / self.block_points(), index % self.block_points());
        let (a, b) = self.points[2 * k * block..2 * k * (block + 1)].split_at(k);
        let (from, exchanged, other) = if place <= k {
            (a, place.checked_sub(1), b)
        } else if place + 1 < self.block_points() {
            (b, Some(place - k - 1), a)
        } else {
            (b, None, a)
        };
        point.copy_from_slice(from);
        if let Some(i) = exchanged {
            point[i] = other[i];
        }
        Ok(())
    }
}

/// The sequence of the points (a, b).
pub(crate) fn radial_sequence(inputs: usize) -> Result<Sobol, SensitivityError> {
    check_range("inputs", inputs as u64, 1, MAX_DIMENSIONS as u64 / 2)?;
    Sobol::new(2 * inputs)
}

fn scramblings(sequence: &Sobol, seed: u64) -> Vec<Sobol> {
    (0..REPLICATES as u64).map(|turn| sequence.rescrambled(stream(seed, turn).next_u64())).collect()
}

/// Room for the points of so many blocks.
fn room(blocks: usize, size: usize) -> Result<Vec<f64>, SensitivityError> {
    let mut points = Vec::new();
    let fits = blocks.checked_mul(size).is_some_and(|values| points.try_reserve_exact(values).is_ok());
    if fits {
        Ok(points)
    } else {
        Err(SensitivityError::OutOfMemory { field: "blocks", value: blocks as u64 })
    }
}

/// The points (a, b) of all blocks, of which the first ones are known.
fn extended(mut points: Vec<f64>, sequences: &[Sobol], first_index: u32, blocks: usize) -> Vec<f64> {
    let (size, turns, known) = (sequences[0].dimensions(), sequences.len(), points.len());
    let first = known / size;
    points.resize(blocks * size, 0.0);
    points[known..].par_chunks_mut(size).enumerate().for_each(|(place, point)| {
        let block = first + place;
        // Below 2^32: `check_points` has seen to it.
        let written = sequences[block % turns].point(first_index + (block / turns) as u32, point);
        debug_assert!(written.is_ok(), "a point has the dimensions of its sequence");
    });
    points
}
