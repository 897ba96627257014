//! Halton's sequence, plain or with scrambled digits. Any point is computed directly from its index.
//!
//! With `p_j` the j-th prime and `d_0`, `d_1`, .. the digits of the index i in this base,
//!
//! ```text
//! u_ij = Σ_k d_k p_j^-(k+1)                                              (Ht1)
//! u_ij = Σ_k ((a_jk d_k + c_jk) mod p_j) p_j^-(k+1)                      (Ht2)
//! ```
//!
//! (Ht1): J. H. Halton, *On the efficiency of certain quasi-random sequences of points in evaluating
//! multi-dimensional integrals*, Numer. Math. 2 (1960). Its points in two large neighbouring bases are
//! correlated until the index has passed the product of the bases.
//!
//! (Ht2) scrambles each digit by random `a_jk` in 1 .. p - 1 and `c_jk` in 0 .. p - 1, which removes that
//! correlation and makes each point uniform. It is the diagonal form of the random linear scrambling of J.
//! Matoušek, *On the L2-discrepancy for anchored boxes*, J. Complexity 14 (1998). Both use as many digits as
//! a double holds.

use rand::RngExt;

use crate::design::input::Input;
use crate::design::sobol::Sobol;
use crate::design::{
    IndependentSample, JointSample, Layout, SampleDesign, check_origin, check_points, check_row,
};
use crate::error::{SensitivityError, check_range};
use crate::sample::random::stream;

/// Consecutive points of Halton's sequence, plain or scrambled.
#[derive(Debug, Clone)]
pub struct Halton {
    layout: Layout,
    axes: Vec<Axis>,
    first_index: u32,
}

/// One dimension: its base, and the maps (a, c) of its digits, the most significant digit of u first.
#[derive(Debug, Clone)]
struct Axis {
    base: u64,
    maps: Vec<(u64, u64)>,
}

impl Halton {
    /// Makes a design of the points `first_index` to `first_index + points - 1` of (Ht1). Point 0 is all
    /// zeros.
    ///
    /// # Errors
    /// - [`SensitivityError::InvalidInput`] for an invalid input;
    /// - [`SensitivityError::OutOfRange`] for no input or more than [`Sobol::MAX_DIMENSIONS`], no point, or
    ///   points beyond 2^32;
    /// - [`SensitivityError::UnboundedAtZero`] if point 0 is among them and the law of an input has no lower
    ///   end.
    pub fn new(inputs: Vec<Input>, first_index: u32, points: usize) -> Result<Self, SensitivityError> {
        check_origin(&inputs, first_index)?;
        Self::over(inputs, first_index, points, None)
    }

    /// Makes a design of the first points of the scrambled sequence (Ht2).
    ///
    /// # Errors
    /// As [`Halton::new`], but point 0 is allowed: scrambled, it is not zero.
    pub fn scrambled(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        Self::over(inputs, 0, points, Some(seed))
    }

    fn over(
        inputs: Vec<Input>,
        first_index: u32,
        points: usize,
        seed: Option<u64>,
    ) -> Result<Self, SensitivityError> {
        let layout = Layout::new(inputs, points, seed)?;
        check_range("inputs", layout.inputs.len() as u64, 1, Sobol::MAX_DIMENSIONS as u64)?;
        check_points(first_index, points)?;
        Ok(Self { axes: axes(layout.inputs.len(), seed), layout, first_index })
    }
}

impl SampleDesign for Halton {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn replicate(&self, seed: u64) -> Self {
        let axes = axes(self.inputs().len(), Some(seed));
        Self { axes, layout: self.layout.reseeded(seed), first_index: self.first_index }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        // A scrambled point is the middle of the cell of its last digit: neither 0 nor 1.
        let within = if self.seed().is_some() { 0.5 } else { 0.0 };
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

/// Base and digit maps of each dimension. There are as many digits as fit in 52 bits.
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

/// The first primes.
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
