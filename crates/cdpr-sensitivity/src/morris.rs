//! Screening by elementary effects.
//!
//! An elementary effect is the change of the output between two points that differ in input i alone, over the probability
//! that lies between its two values:
//!
//! ```text
//! e_i = (y(x') - y(x)) / (F_i(x'_i) - F_i(x_i))                           (1)
//! μ_i = mean(e_i),   μ*_i = mean(|e_i|),   σ_i² = Σ (e_i - μ_i)² / (n - 1)              (2)
//! ```
//!
//! μ* ranks the inputs; σ tells of curvature and interactions. In a linear model of uniform inputs, e = b (max - min).
//!
//! *Trajectories*: from a random point on a grid of p levels 0, 1/(p - 1), .. 1 (p even) each input is moved once, in
//! random order, by p / (2 (p - 1)): M. D. Morris, *Factorial sampling plans for preliminary computational experiments*,
//! Technometrics 33 (1991). *Radial*: from a point of Sobol's sequence each input is moved alone, to its value in another
//! one: F. Campolongo, A. Saltelli, J. Cariboni, *From screening to quantitative sensitivity analysis*, Comput. Phys.
//! Commun. 182 (2011), here with Owen's scrambling, under which the two coordinates do not coincide. μ*: F. Campolongo,
//! J. Cariboni, A. Saltelli, *An effective screening design for sensitivity analysis of large models* (2007).
//!
//! Two values that steps have made one have no elementary effect.

use rand::RngExt;
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

use crate::design::{SampleDesign, check_row, stream};
use crate::error::{SensitivityError, check_level, check_range, require};
use crate::input::Input;
use crate::interval::Estimate;
use crate::observation::check_outputs;
use crate::saltelli::radial_sequence;
use crate::sobol::Sobol;
use crate::summary::mean_and_squares;

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

/// Elementary effects of one input, in the unit of the output.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct MorrisEffect {
    /// Name of the input.
    pub input: String,
    /// Elementary effects found.
    pub effects: usize,
    /// Elementary effects lost to a failed observation.
    pub failed: usize,
    /// μ (2).
    pub mean: f64,
    /// μ* (2), with Student's interval over the blocks.
    pub mean_absolute: Estimate,
    /// σ (2).
    pub std: f64,
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
    /// or more than half of [`crate::sobol::MAX_DIMENSIONS`], or fewer than two blocks.
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
    fn reference(&self, place: usize) -> usize {
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

/// Elementary effects (1) of all inputs and their moments (2), from one output a row, `None` where it has failed, with the
/// interval of μ* at a confidence `level` in (0, 1).
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless there is one output a row;
/// - [`SensitivityError::NotFinite`] for a value that is not finite;
/// - [`SensitivityError::InvalidInput`] with [`SensitivityError::OutOfRange`] for an input with fewer than two
///   elementary effects;
/// - [`SensitivityError::InvalidParameter`] for the level.
pub fn morris_effects(
    design: &MorrisDesign,
    outputs: &[Option<f64>],
    level: f64,
) -> Result<Vec<MorrisEffect>, SensitivityError> {
    check_level(level)?;
    check_outputs(design, outputs)?;
    let inputs = design.inputs();
    let mut found = vec![(Vec::new(), 0); inputs.len()];
    let mut rows = vec![vec![0.0; inputs.len()]; inputs.len() + 1];
    for (block, outputs) in outputs.chunks(rows.len()).enumerate() {
        for (place, row) in rows.iter_mut().enumerate() {
            design.row(block * (inputs.len() + 1) + place, row)?;
        }
        for place in 1..rows.len() {
            let reference = design.reference(place);
            let (from, to) = (&rows[reference], &rows[place]);
            // None if steps have made the two values one.
            let Some(input) = (0..inputs.len()).find(|&input| from[input] != to[input]) else {
                continue;
            };
            let law = &inputs[input].law;
            match (outputs[reference], outputs[place]) {
                (Some(before), Some(after)) => {
                    found[input].0.push((after - before) / (law.cdf(to[input]) - law.cdf(from[input])));
                }
                _ => found[input].1 += 1,
            }
        }
    }
    let summary = |(input, (effects, failed)): (&Input, (Vec<f64>, usize))| {
        check_range("elementary effects", effects.len() as u64, 2, u64::MAX).map_err(|source| {
            SensitivityError::InvalidInput { name: input.name.clone(), source: Box::new(source) }
        })?;
        let (mean, squares) = mean_and_squares(&effects);
        let absolute: Vec<f64> = effects.iter().map(|effect| effect.abs()).collect();
        Ok(MorrisEffect {
            input: input.name.clone(),
            effects: effects.len(),
            failed,
            mean,
            mean_absolute: Estimate::of_mean(&absolute, level)?,
            std: (squares / (effects.len() as f64 - 1.0)).sqrt(),
        })
    };
    inputs.iter().zip(found).map(summary).collect()
}
