//! What must hold for every input, one function a fuzz target; and how inputs are varied.
//!
//! `cargo xtask fuzz [SECONDS]` runs all targets. One alone, from the root of the repository:
//!
//! ```text
//! cargo +nightly fuzz run --fuzz-dir tests/fuzz end_force -- -max_total_time=600 -timeout=10
//! cargo +nightly fuzz run --fuzz-dir tests/fuzz robot_file tests/fuzz/corpus/robot_file data/robots --
//! -dict=tests/fuzz/json.dict
//! ```
//!
//! The files of `data/` are the first corpus of the file formats; the cases of `data/reference/catenary.json`
//! come in by the mutation of numbers, see [`mutate::numbers`].

pub mod cable;
pub mod file;
pub mod mutate;
