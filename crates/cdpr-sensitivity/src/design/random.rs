//! Design of independent random points.

use crate::design::input::Input;
use crate::design::{IndependentSample, JointSample, Layout, SampleDesign, check_row};
use crate::error::SensitivityError;
use crate::sample::random::{stream, uniform};

/// Independent random points.
///
/// Row i is stream i of the generator `ChaCha8` (D. J. Bernstein, *ChaCha, a variant of Salsa20*, 2008). An
/// input that is added at the end leaves the other columns unchanged.
#[derive(Debug, Clone)]
pub struct RandomDesign {
    layout: Layout,
    seed: u64,
}

impl RandomDesign {
    /// Makes a design of `points` independent rows.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidInput`] for an invalid input, [`SensitivityError::OutOfRange`] for no input
    /// or no point.
    pub fn new(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        Ok(Self { layout: Layout::new(inputs, points, Some(seed))?, seed })
    }
}

impl SampleDesign for RandomDesign {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn replicate(&self, seed: u64) -> Self {
        Self { layout: self.layout.reseeded(seed), seed }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        let mut generator = stream(self.seed, index as u64);
        point.fill_with(|| uniform(&mut generator));
        Ok(())
    }
}

impl JointSample for RandomDesign {}
impl IndependentSample for RandomDesign {}
