//! Tests of this crate.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

mod controlled;
mod derivatives;
mod drawn;
mod energy;
mod forced;
mod moves;
mod pulleys;
mod reference;
mod response;
mod robots;
mod shaken_derivatives;
mod simulated;
mod transients;
mod winches;
