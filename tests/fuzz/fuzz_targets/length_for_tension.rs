//! Length of a cable for a tension, for any five doubles.

#![no_main]

use cdpr_fuzz::{cable, mutate};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use std::sync::LazyLock;

static CASES: LazyLock<Vec<[f64; 5]>> =
    LazyLock::new(|| mutate::references(["weight_per_length", "axial_stiffness", "x", "z", "force_x"]));

fuzz_target!(|numbers: [f64; 5]| cable::length_for_tension(numbers));

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    mutate::numbers(data, size, max_size, seed, &CASES)
});
