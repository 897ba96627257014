//! Properties that hold for every input, one function for each fuzz target, and mutations of inputs.
//!
//! `tests/fuzz/run [SECONDS]` runs all targets. One alone, from the root of the repository:
//!
//! ```text
//! cargo +nightly fuzz run --fuzz-dir tests/fuzz --features link end_force -- -max_total_time=600 -timeout=10
//! cargo +nightly fuzz run --fuzz-dir tests/fuzz --features link robot_file tests/fuzz/corpus/robot_file data/robots \
//!     -- -dict=tests/fuzz/json.dict
//! ```
//!
//! The file formats start from the files of `data/`; mutations of numbers ([`mutate::numbers`]) draw from the
//! cases of `data/reference/catenary.json`.

pub mod cable;
pub mod file;
pub mod mutate;
