//! A cable with a law of two pieces, for any eight doubles.

#![no_main]

use cdpr_fuzz::{cable, mutate};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

/// Weight per length, EA, length, end, tension of the kink, stiffness of both pieces over EA.
const CASES: [[f64; 8]; 3] = [
    [0.9957, 1.284e6, 4.44, 4.1, -1.7, 514.5, 0.71, 0.81],
    [0.9957, 1.284e6, 4.5, 4.1, -1.7, 10.0, 0.5, 2.0],
    [20.0, 1e5, 6.0, 5.0, 1.0, 50.0, 3.0, 1.0],
];

fuzz_target!(|numbers: [f64; 8]| cable::law(numbers));

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    mutate::numbers(data, size, max_size, seed, &CASES)
});
