//! Latin hypercube sampling: each input has one value in each of N cells of equal probability.
//!
//! ```text
//! u_ij = (π_j(i) + r_ij) / N,   i = 0 .. N - 1                           (Lh1)
//! ```
//!
//! Each input has a random permutation `π_j` of 0 .. N - 1, and r is uniform on (0, 1), or 1/2 in the centred
//! variant: M. D. McKay, R. J. Beckman, W. J. Conover, *A comparison of three methods for selecting values of
//! input variables*, Technometrics 21 (1979). The variance of the mean of an additive output is of order N^-3
//! instead of N^-1.
//!
//! The permutations are stored: they take four bytes per input and point.

use rand::seq::SliceRandom;

use crate::design::input::Input;
use crate::design::{IndependentSample, JointSample, Layout, SampleDesign, check_points, check_row};
use crate::error::SensitivityError;
use crate::sample::random::{stream, uniform};

/// Latin hypercube, Eq. (Lh1).
#[derive(Debug, Clone)]
pub struct LatinHypercube {
    layout: Layout,
    /// `π_j`, one per input.
    permutations: Vec<Vec<u32>>,
    within: Within,
    seed: u64,
}

/// Position of a point within its cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Within {
    Random,
    Centre,
}

impl LatinHypercube {
    /// Makes a design whose points lie at random within their cells.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidInput`] for an invalid input, [`SensitivityError::OutOfRange`] for no
    /// input, no point or more than 2^32 points.
    pub fn new(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        Self::placed(inputs, points, seed, Within::Random)
    }

    /// Makes a design whose points lie in the middle of their cells.
    ///
    /// # Errors
    /// As [`LatinHypercube::new`].
    pub fn centred(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        Self::placed(inputs, points, seed, Within::Centre)
    }

    fn placed(
        inputs: Vec<Input>,
        points: usize,
        seed: u64,
        within: Within,
    ) -> Result<Self, SensitivityError> {
        let layout = Layout::new(inputs, points, Some(seed))?;
        check_points(0, points)?;
        Ok(Self { permutations: permutations(&layout, seed), layout, within, seed })
    }
}

impl SampleDesign for LatinHypercube {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn replicate(&self, seed: u64) -> Self {
        let (layout, within) = (self.layout.reseeded(seed), self.within);
        Self { permutations: permutations(&layout, seed), layout, within, seed }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        let mut generator = stream(self.seed, index as u64);
        for (u, permutation) in point.iter_mut().zip(&self.permutations) {
            let within = match self.within {
                Within::Random => uniform(&mut generator),
                Within::Centre => 0.5,
            };
            *u = (f64::from(permutation[index]) + within) / self.points() as f64;
        }
        Ok(())
    }
}

impl JointSample for LatinHypercube {}
impl IndependentSample for LatinHypercube {}

/// Permutations of the cells, one per input.
fn permutations(layout: &Layout, seed: u64) -> Vec<Vec<u32>> {
    let permutation = |input| {
        let mut cells: Vec<u32> = (0..layout.points).map(|cell| cell as u32).collect();
        // The rows use the streams from 0 upwards, the permutations those from the last one downwards.
        cells.shuffle(&mut stream(seed, u64::MAX - input as u64));
        cells
    };
    (0..layout.inputs.len()).map(permutation).collect()
}
