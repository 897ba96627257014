//! Tests of this crate.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

mod common;
mod paths;
mod reference;
mod samples;
