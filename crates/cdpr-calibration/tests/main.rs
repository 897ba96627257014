//! Calibrations against perturbed robots, references and each other.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod common;
mod identify;
mod recovery;
mod reference;
mod sensors;
mod speed;
mod tables;
mod wrong_models;
