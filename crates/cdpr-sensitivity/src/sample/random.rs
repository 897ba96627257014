//! Streams of random numbers, and how many samples a bootstrap draws from them.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The samples of the bootstrap, Eq. (3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bootstrap {
    /// Number R of samples drawn, at least 1. The smallest p-value possible is 1 / (R + 1).
    pub resamples: usize,
    /// Seed: same seed, same p-values, whatever the number of threads.
    pub seed: u64,
}

/// Stream `number` of the generator of a seed.
pub(crate) fn stream(seed: u64, number: u64) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(number);
    generator
}

/// The middle of a cell of 2^-52: neither 0 nor 1.
pub(crate) fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    ((generator.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}
