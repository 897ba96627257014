//! Robots of other programs, imported and exported.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod bounds;
mod broken;
mod export;
mod firmware;
mod fixtures;
mod import;
mod meaning;
mod mujoco;
mod round_trip;
mod simulators;
mod table;
mod texts;
