//! Halton's sequence, any point directly, plain or with scrambled digits.
//!
//! With `p_j` the j-th prime and `d_0`, `d_1`, .. the digits of the index i in this base,
//!
//! ```text
//! u_ij = Σ_k d_k p_j^-(k+1)                                               (1)
//! u_ij = Σ_k ((a_jk d_k + c_jk) mod p_j) p_j^-(k+1)                       (2)
//! ```
//!
//! (1): J. H. Halton, *On the efficiency of certain quasi-random sequences of points in evaluating multi-dimensional
//! integrals*, Numer. Math. 2 (1960). Its points in two large neighbouring bases are correlated until the index has
//! passed their product; (2), random `a_jk` in 1 .. p - 1 and `c_jk` in 0 .. p - 1 for each digit, breaks that and makes
//! each point uniform: the diagonal form of the random linear scrambling of J. Matoušek, *On the L2-discrepancy for
//! anchored boxes*, J. Complexity 14 (1998). Both are taken to the digits that a double holds.

use rand::RngExt;

use crate::design::input::Input;
use crate::design::sobol::MAX_DIMENSIONS;
use crate::design::{IndependentSample, JointSample, SampleDesign, check_origin, check_points, check_row};
use crate::error::{SensitivityError, check_range};
use crate::sample::random::stream;

/// Consecutive points of Halton's sequence, plain or scrambled.
#[derive(Debug, Clone)]
pub struct Halton {
    inputs: Vec<Input>,
    axes: Vec<Axis>,
    first_index: u32,
    points: usize,
    seed: Option<u64>,
}

/// One dimension: its base, and the maps (a, c) of its digits, most significant digit of u first.
#[derive(Debug, Clone)]
struct Axis {
    base: u64,
    maps: Vec<(u64, u64)>,
}

impl Halton {
    /// Points `first_index` to `first_index + points - 1` of the plain sequence (1). Point 0 is all zeros.
    ///
    /// # Errors
    /// - [`SensitivityError::InvalidInput`] for an input that is not valid;
    /// - [`SensitivityError::OutOfRange`] for no input or more than [`MAX_DIMENSIONS`], no point, or points beyond 2^32;
    /// - [`SensitivityError::UnboundedAtZero`] if point 0 is among them and the law of an input has no lower end.
    pub fn new(inputs: Vec<Input>, first_index: u32, points: usize) -> Result<Self, SensitivityError> {
        check_origin(&inputs, first_index)?;
        Self::over(inputs, first_index, points, None)
    }

    /// The first points of the scrambled sequence (2).
    ///
    /// # Errors
    /// As [`Halton::new`], but point 0 may be among the points: it is not zero.
    pub fn scrambled(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        Self::over(inputs, 0, points, Some(seed))
    }

    fn over(
        inputs: Vec<Input>,
        first_index: u32,
        points: usize,
        seed: Option<u64>,
    ) -> Result<Self, SensitivityError> {
        inputs.iter().try_for_each(Input::validate)?;
        check_range("inputs", inputs.len() as u64, 1, MAX_DIMENSIONS as u64)?;
        check_points(first_index, points)?;
        let axes = axes(inputs.len(), seed);
        Ok(Self { inputs, axes, first_index, points, seed })
    }
}

impl SampleDesign for Halton {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn points(&self) -> usize {
        self.points
    }

    fn seed(&self) -> Option<u64> {
        self.seed
    }

    fn replicate(&self, seed: u64) -> Self {
        Self { axes: axes(self.inputs.len(), Some(seed)), seed: Some(seed), ..self.clone() }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        // The middle of the cell of the last digit, neither 0 nor 1, if scrambled.
        let within = if self.seed.is_some() { 0.5 } else { 0.0 };
        for (u, axis) in point.iter_mut().zip(&self.axes) {
            let (mut rest, mut numerator, mut cells) = (u64::from(self.first_index) + index as u64, 0, 1);
            for (a, c) in &axis.maps {
                numerator = numerator * axis.base + (a * (rest % axis.base) + c) % axis.base;
                rest /= axis.base;
                cells *= axis.base;
            }
            *u = (numerator as f64 + within) / cells as f64;
        }
        Ok(())
    }
}

impl JointSample for Halton {}
impl IndependentSample for Halton {}

/// Base and digit maps of each dimension: as many digits as fit in 52 bits.
fn axes(dimensions: usize, seed: Option<u64>) -> Vec<Axis> {
    let axis = |(j, base): (usize, u64)| {
        let digits = (1_u64 << 52).ilog(base);
        let maps = match seed {
            None => vec![(1, 0); digits as usize],
            Some(seed) => {
                let mut generator = stream(seed, j as u64);
                let mut map = || (generator.random_range(1..base), generator.random_range(0..base));
                (0..digits).map(|_| map()).collect()
            }
        };
        Axis { base, maps }
    };
    primes(dimensions).into_iter().enumerate().map(axis).collect()
}

fn primes(count: usize) -> Vec<u64> {
    let mut primes: Vec<u64> = Vec::with_capacity(count);
    let mut n = 2;
    while primes.len() < count {
        if primes.iter().take_while(|&&p| p * p <= n).all(|&p| !n.is_multiple_of(p)) {
            primes.push(n);
        }
        n += 1;
    }
    primes
}
