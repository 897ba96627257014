//! End force of a cable over a lead and a pulley for any seven doubles.

#![no_main]

use cdpr_fuzz::{cable, mutate};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use std::sync::LazyLock;

static CASES: LazyLock<Vec<[f64; 7]>> = LazyLock::new(|| {
    let free = mutate::references(["weight_per_length", "axial_stiffness", "unstrained_length", "x", "z"]);
    free.into_iter().map(|[w, ea, length, x, z]| [w, ea, length, x, z, 0.3 * length, 0.02 * length]).collect()
});

fuzz_target!(|numbers: [f64; 7]| cable::pulley(numbers));

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    mutate::numbers(data, size, max_size, seed, &CASES)
});
