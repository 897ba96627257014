//! Independent random points.

use crate::design::input::Input;
use crate::design::{IndependentSample, JointSample, SampleDesign, check_row};
use crate::error::{SensitivityError, check_range};
use crate::sample::random::{stream, uniform};

/// Independent random points. Row i is stream i of the generator `ChaCha8` (D. J. Bernstein, 2008): an input added
/// at the end leaves the other columns as they were.
#[derive(Debug, Clone)]
pub struct RandomDesign {
    inputs: Vec<Input>,
    points: usize,
    seed: u64,
}

impl RandomDesign {
    /// `points` independent rows.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidInput`] for an input that is not valid, [`SensitivityError::OutOfRange`] for no
    /// input or no point.
    pub fn new(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        inputs.iter().try_for_each(Input::validate)?;
        check_range("inputs", inputs.len() as u64, 1, u64::MAX)?;
        check_range("points", points as u64, 1, u64::MAX)?;
        Ok(Self { inputs, points, seed })
    }
}

impl SampleDesign for RandomDesign {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn points(&self) -> usize {
        self.points
    }

    fn seed(&self) -> Option<u64> {
        Some(self.seed)
    }

    fn replicate(&self, seed: u64) -> Self {
        Self { seed, ..self.clone() }
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
