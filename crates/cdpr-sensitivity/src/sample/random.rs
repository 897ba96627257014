//! Streams of random numbers, and the number and seed of bootstrap samples.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// How many samples a bootstrap draws, and from which seed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bootstrap {
    /// Number R of samples, at least 1. The smallest possible p-value of a fit is 1 / (R + 1).
    pub resamples: usize,
    /// Seed. The same seed gives the same results on any number of threads.
    pub seed: u64,
}

/// A seed for the part `number` of a computation with a seed: the parts of all seeds are independent.
pub fn derived_seed(seed: u64, number: u64) -> u64 {
    stream(seed, number).next_u64()
}

/// Stream `number` of the generator with a seed.
pub(crate) fn stream(seed: u64, number: u64) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(number);
    generator
}

/// Draws the middle of one of the 2^52 cells of the unit interval: it is neither 0 nor 1.
pub(crate) fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    ((generator.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}
