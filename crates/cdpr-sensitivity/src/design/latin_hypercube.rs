//! Latin hypercube sampling: each input has one value in each of N cells of equal mass.
//!
//! ```text
//! u_ij = (π_j(i) + r_ij) / N,   i = 0 .. N - 1                            (1)
//! ```
//!
//! with a random permutation `π_j` of 0 .. N - 1 for each input, and r uniform on (0, 1), or 1/2 in the centred variant:
//! M. D. McKay, R. J. Beckman, W. J. Conover, *A comparison of three methods for selecting values of input variables*,
//! Technometrics 21 (1979). The variance of the mean of an additive output is of the order N^-3 instead of N^-1.
//!
//! The permutations are stored: four bytes an input and point.

use rand::seq::SliceRandom;

use crate::design::input::Input;
use crate::design::{IndependentSample, JointSample, SampleDesign, check_row};
use crate::error::{SensitivityError, check_range};
use crate::sample::random::{stream, uniform};

/// A Latin hypercube, Eq. (1).
#[derive(Debug, Clone)]
pub struct LatinHypercube {
    inputs: Vec<Input>,
    /// `π_j`, one an input.
    permutations: Vec<Vec<u32>>,
    points: usize,
    place: Place,
    seed: u64,
}

/// Place of a point in its cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Random,
    Centre,
}

impl LatinHypercube {
    /// `points` rows, each at random within its cell.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidInput`] for an input that is not valid, [`SensitivityError::OutOfRange`] for no
    /// input, no point or more than 2^32.
    pub fn new(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        Self::placed(inputs, points, seed, Place::Random)
    }

    /// `points` rows, each in the middle of its cell.
    ///
    /// # Errors
    /// As [`LatinHypercube::new`].
    pub fn centred(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        Self::placed(inputs, points, seed, Place::Centre)
    }

    fn placed(inputs: Vec<Input>, points: usize, seed: u64, place: Place) -> Result<Self, SensitivityError> {
        inputs.iter().try_for_each(Input::validate)?;
        check_range("inputs", inputs.len() as u64, 1, u64::MAX)?;
        check_range("points", points as u64, 1, 1 << 32)?;
        let permutations = permutations(inputs.len(), points, seed);
        Ok(Self { inputs, permutations, points, place, seed })
    }
}

impl SampleDesign for LatinHypercube {
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
        let permutations = permutations(self.inputs.len(), self.points, seed);
        Self { permutations, seed, ..self.clone() }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        let mut generator = stream(self.seed, index as u64);
        for (u, permutation) in point.iter_mut().zip(&self.permutations) {
            let within = match self.place {
                Place::Random => uniform(&mut generator),
                Place::Centre => 0.5,
            };
            *u = (f64::from(permutation[index]) + within) / self.points as f64;
        }
        Ok(())
    }
}

impl JointSample for LatinHypercube {}
impl IndependentSample for LatinHypercube {}

/// A permutation of the cells for each input.
fn permutations(inputs: usize, points: usize, seed: u64) -> Vec<Vec<u32>> {
    let permutation = |input| {
        let mut cells: Vec<u32> = (0..points).map(|cell| cell as u32).collect();
        // The rows take streams from 0 on, the permutations those from the last one down.
        cells.shuffle(&mut stream(seed, u64::MAX - input as u64));
        cells
    };
    (0..inputs).map(permutation).collect()
}
