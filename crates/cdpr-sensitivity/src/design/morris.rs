//! Blocks of points for screening: in each of them every input is moved once.
//!
//! *Trajectories*: from a random point on a grid of p levels 0, 1/(p - 1), .. 1 (p even) each input is moved once, in
//! random order, by p / (2 (p - 1)): M. D. Morris, *Factorial sampling plans for preliminary computational experiments*,
//! Technometrics 33 (1991). *Radial*: from a point of Sobol's sequence each input is moved alone, to its value in another
//! one: F. Campolongo, A. Saltelli, J. Cariboni, *From screening to quantitative sensitivity analysis*, Comput. Phys.
//! Commun. 182 (2011), here with Owen's scrambling, under which the two coordinates do not coincide.

use rand::RngExt;
use rand::seq::SliceRandom;

use crate::design::input::Input;
use crate::design::saltelli::radial_sequence;
use crate::design::sobol::Sobol;
use crate::design::{SampleDesign, check_row};
use crate::error::{SensitivityError, check_range, require};
use crate::sample::random::stream;

/// Blocks of k + 1 points, in each of which every input is moved once.
#[derive(Debug, Clone)]
pub struct MorrisDesign {
    inputs: Vec<Input>,
    blocks: usize,
    plan: Plan,
}

#[derive(Debug, Clone)]
enum Plan {
    Trajectories { levels: u32, seed: u64 },
    Radial(Sobol),
}

impl MorrisDesign {
    /// Independent random trajectories on a grid of `levels` levels.
    ///
    /// # Errors
    /// - [`SensitivityError::InvalidInput`] for an input that is not valid;
    /// - [`SensitivityError::OutOfRange`] for no input or fewer than two trajectories;
    /// - [`SensitivityError::InvalidParameter`] for a number of levels that is odd or zero;
    /// - [`SensitivityError::UnboundedLevels`] for an input whose law is infinite at level 0 or 1.
    pub fn trajectories(
        inputs: Vec<Input>,
        trajectories: usize,
        levels: u32,
        seed: u64,
    ) -> Result<Self, SensitivityError> {
        inputs.iter().try_for_each(Input::validate)?;
        check_range("inputs", inputs.len() as u64, 1, u64::MAX)?;
        check_range("trajectories", trajectories as u64, 2, u64::MAX)?;
        let even = levels > 0 && levels.is_multiple_of(2);
        require(even, "levels", f64::from(levels), "an even number from 2 on")?;
        let unbounded = |input: &&Input| {
            let (low, high) = input.law.support();
            !(high - low).is_finite()
        };
        if let Some(input) = inputs.iter().find(unbounded) {
            return Err(SensitivityError::UnboundedLevels { name: input.name.clone() });
        }
        Ok(Self { inputs, blocks: trajectories, plan: Plan::Trajectories { levels, seed } })
    }

    /// Radial blocks on points of the scrambled Sobol sequence.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidInput`] for an input that is not valid, [`SensitivityError::OutOfRange`] for no input
    /// or more than half of [`crate::design::sobol::MAX_DIMENSIONS`], or fewer than two blocks.
    pub fn radial(inputs: Vec<Input>, blocks: usize, seed: u64) -> Result<Self, SensitivityError> {
        inputs.iter().try_for_each(Input::validate)?;
        check_range("blocks", blocks as u64, 2, 1 << 32)?;
        let sequence = radial_sequence(inputs.len())?.rescrambled(seed);
        Ok(Self { inputs, blocks, plan: Plan::Radial(sequence) })
    }

    /// Number of trajectories or radial blocks.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.blocks
    }

    /// The row within its block that this row, not the first one, is compared with.
    pub(crate) fn reference(&self, place: usize) -> usize {
        match self.plan {
            Plan::Trajectories { .. } => place - 1,
            Plan::Radial(_) => 0,
        }
    }
}

impl SampleDesign for MorrisDesign {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn points(&self) -> usize {
        self.blocks * (self.inputs.len() + 1)
    }

    fn seed(&self) -> Option<u64> {
        match &self.plan {
            Plan::Trajectories { seed, .. } => Some(*seed),
            Plan::Radial(sequence) => sequence.seed(),
        }
    }

    fn replicate(&self, seed: u64) -> Self {
        let plan = match &self.plan {
            Plan::Trajectories { levels, .. } => Plan::Trajectories { levels: *levels, seed },
            Plan::Radial(sequence) => Plan::Radial(sequence.rescrambled(seed)),
        };
        Self { plan, ..self.clone() }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        let k = self.inputs.len();
        let (block, place) = (index / (k + 1), index % (k + 1));
        match &self.plan {
            Plan::Trajectories { levels, seed } => {
                let mut generator = stream(*seed, block as u64);
                let half = levels / 2;
                let mut ends = || {
                    let low = generator.random_range(0..half);
                    if generator.random_bool(0.5) { [low, low + half] } else { [low + half, low] }
                };
                let ends: Vec<[u32; 2]> = (0..k).map(|_| ends()).collect();
                let mut order: Vec<usize> = (0..k).collect();
                order.shuffle(&mut generator);
                for (moved, &input) in order.iter().enumerate() {
                    let level = ends[input][usize::from(moved < place)];
                    point[input] = f64::from(level) / f64::from(levels - 1);
                }
            }
            Plan::Radial(sequence) => {
                let mut both = vec![0.0; 2 * k];
                sequence.point(block as u32, &mut both)?;
                let (from, to) = both.split_at(k);
                point.copy_from_slice(from);
                if let Some(input) = place.checked_sub(1) {
                    point[input] = to[input];
                }
            }
        }
        Ok(())
    }
}
