//! Study files, up to what is ready to run.

#![no_main]

use cdpr_fuzz::{file, mutate};
use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};

fuzz_target!(|text: &str| file::study(text));

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let by_number =
        if seed.is_multiple_of(2) { mutate::number_in_text(data, size, max_size, seed) } else { None };
    by_number.unwrap_or_else(|| fuzzer_mutate(data, size, max_size))
});
