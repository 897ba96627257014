//! Calibrations against perturbed robots, references and each other.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod common;
mod fold;
mod frame;
mod identify;
mod loads;
mod minimum;
mod planar;
mod pulleys;
mod recovery;
mod reference;
mod refused;
mod sensors;
mod speed;
mod tables;
mod winches;
mod wrong_models;
