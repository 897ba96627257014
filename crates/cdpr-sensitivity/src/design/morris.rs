//! Designs for screening: blocks of points, in each of which every input is moved once.
//!
//! *Trajectories*: the first point lies on a grid of p levels 0, 1/(p - 1), .. 1 (p even). From there each
//! input is moved once, in random order, by p / (2 (p - 1)): M. D. Morris, *Factorial sampling plans for
//! preliminary computational experiments*, Technometrics 33 (1991). The levels 0 and 1 of an unbounded law
//! are infinite: such an input has the middles 1/(2 p), 3/(2 p), .. of p equal parts and moves by 1/2. An
//! effect is per probability in either case, so that all inputs remain comparable.
//!
//! *Radial blocks*: from a point of Sobol's sequence each input is moved alone, to its value in another
//! point: F. Campolongo, A. Saltelli, J. Cariboni, *From screening to quantitative sensitivity analysis*,
//! Comput. Phys. Commun. 182 (2011). The sequence is scrambled here, so that the two
//! coordinates do not coincide.

use rand::RngExt;
use rand::seq::SliceRandom;

use crate::design::input::Input;
use crate::design::saltelli::radial_sequence;
use crate::design::sobol::Sobol;
use crate::design::{Layout, SampleDesign, check_row, check_rows, to_values};
use crate::error::{SensitivityError, check_range, require};
use crate::sample::random::stream;

/// Blocks of k + 1 points, in each of which every one of the k inputs is moved once.
#[derive(Debug, Clone)]
pub struct MorrisDesign {
    layout: Layout,
    plan: Plan,
}

#[derive(Debug, Clone)]
enum Plan {
    Trajectories { levels: u32, seed: u64 },
    Radial(Sobol),
}

impl MorrisDesign {
    /// Makes independent random trajectories on a grid of `levels` levels.
    ///
    /// # Errors
    /// - [`SensitivityError::InvalidInput`] for an invalid input;
    /// - [`SensitivityError::OutOfRange`] for no input or fewer than two trajectories;
    /// - [`SensitivityError::InvalidParameter`] for a number of levels that is odd or zero.
    pub fn trajectories(
        inputs: Vec<Input>,
        trajectories: usize,
        levels: u32,
        seed: u64,
    ) -> Result<Self, SensitivityError> {
        check_range("trajectories", trajectories as u64, 2, u64::MAX)?;
        let layout = layout(inputs, trajectories, seed)?;
        let even = levels > 0 && levels.is_multiple_of(2);
        require(even, "levels", f64::from(levels), "an even number from 2 on")?;
        Ok(Self { layout, plan: Plan::Trajectories { levels, seed } })
    }

    /// Makes radial blocks on points of the scrambled Sobol' sequence.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidInput`] for an invalid input, [`SensitivityError::OutOfRange`] for no input
    /// or more than half of [`Sobol::MAX_DIMENSIONS`], or fewer than two blocks.
    pub fn radial(inputs: Vec<Input>, blocks: usize, seed: u64) -> Result<Self, SensitivityError> {
        check_range("blocks", blocks as u64, 2, 1 << 32)?;
        let layout = layout(inputs, blocks, seed)?;
        let sequence = radial_sequence(layout.inputs.len())?.rescrambled(seed);
        Ok(Self { layout, plan: Plan::Radial(sequence) })
    }

    /// Number of levels of trajectories, `None` for radial blocks.
    #[must_use]
    pub fn levels(&self) -> Option<u32> {
        match self.plan {
            Plan::Trajectories { levels, .. } => Some(levels),
            Plan::Radial(_) => None,
        }
    }

    /// Number of trajectories or radial blocks.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.points() / (self.inputs().len() + 1)
    }

    /// Row of a block with which its row `row` is compared. The first row is not compared.
    pub(crate) fn reference(&self, row: usize) -> usize {
        match self.plan {
            Plan::Trajectories { .. } => row - 1,
            Plan::Radial(_) => 0,
        }
    }
}

impl SampleDesign for MorrisDesign {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn replicate(&self, seed: u64) -> Self {
        let plan = match &self.plan {
            Plan::Trajectories { levels, .. } => Plan::Trajectories { levels: *levels, seed },
            Plan::Radial(sequence) => Plan::Radial(sequence.rescrambled(seed)),
        };
        Self { plan, layout: self.layout.reseeded(seed) }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        let mut block = Block::new(point.len());
        self.draw(index / (point.len() + 1), &mut block)?;
        block.write(index % (point.len() + 1), point);
        Ok(())
    }

    fn unit_points(&self, first: usize, points: &mut [f64]) -> Result<(), SensitivityError> {
        self.fill(first, points, |_| ())
    }

    fn rows(&self, first: usize, rows: &mut [f64]) -> Result<(), SensitivityError> {
        self.fill(first, rows, |ends| to_values(self.inputs(), ends))
    }
}

impl MorrisDesign {
    /// Writes consecutive rows of blocks, each of which is drawn once and whose ends are then `mapped`.
    fn fill(
        &self,
        first: usize,
        rows: &mut [f64],
        mapped: impl Fn(&mut [f64]),
    ) -> Result<(), SensitivityError> {
        check_rows(self, first, rows)?;
        let k = self.inputs().len();
        let (mut block, mut known) = (Block::new(k), None);
        for (index, row) in (first..).zip(rows.chunks_exact_mut(k)) {
            let number = index / (k + 1);
            if known.replace(number) != Some(number) {
                self.draw(number, &mut block)?;
                mapped(&mut block.ends);
            }
            block.write(index % (k + 1), row);
        }
        Ok(())
    }

    /// Draws a block of points of the unit cube.
    fn draw(&self, number: usize, block: &mut Block) -> Result<(), SensitivityError> {
        let (from, to) = block.ends.split_at_mut(block.row_of_move.len());
        match &self.plan {
            Plan::Trajectories { levels, seed } => {
                let mut generator = stream(*seed, number as u64);
                let half = levels / 2;
                for ((from, to), input) in from.iter_mut().zip(to).zip(self.inputs()) {
                    let low = generator.random_range(0..half);
                    let [low, high] = [low, low + half].map(|level| match input.law.support().is_bounded() {
                        true => f64::from(level) / f64::from(levels - 1),
                        false => (f64::from(level) + 0.5) / f64::from(*levels),
                    });
                    (*from, *to) = if generator.random_bool(0.5) { (low, high) } else { (high, low) };
                }
                let mut order: Vec<usize> = (0..self.inputs().len()).collect();
                order.shuffle(&mut generator);
                for (moved, &input) in order.iter().enumerate() {
                    block.row_of_move[input] = moved + 1;
                }
                block.stays = true;
                Ok(())
            }
            Plan::Radial(sequence) => {
                block.row_of_move.iter_mut().zip(1..).for_each(|(row, number)| *row = number);
                block.stays = false;
                sequence.point(number as u32, &mut block.ends)
            }
        }
    }
}

/// The rows of a block: in each but the first, one input moves.
struct Block {
    /// Where the inputs come from, and where they go.
    ends: Vec<f64>,
    /// The row in which each input moves.
    row_of_move: Vec<usize>,
    /// Whether an input that has moved stays there in the rows below.
    stays: bool,
}

impl Block {
    fn new(inputs: usize) -> Self {
        Self { ends: vec![0.0; 2 * inputs], row_of_move: vec![0; inputs], stays: false }
    }

    fn write(&self, number: usize, row: &mut [f64]) {
        let (from, to) = self.ends.split_at(row.len());
        for (input, value) in row.iter_mut().enumerate() {
            let moves = self.row_of_move[input];
            let moved = number == moves || (self.stays && number > moves);
            *value = if moved { to[input] } else { from[input] };
        }
    }
}

/// Layout of blocks that have one row more than there are inputs.
fn layout(inputs: Vec<Input>, blocks: usize, seed: u64) -> Result<Layout, SensitivityError> {
    let points = blocks.saturating_mul(inputs.len() + 1);
    Layout::new(inputs, points, Some(seed))
}
