//! Studies, their files and their protocols.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod correlated_inputs;
mod error_model;
mod kept;
mod memory;
mod operating_point;
mod output;
mod record;
mod sensitivity;
mod sensitivity_settings;
mod shared_folder;
mod tables;
mod vibration;
mod weather;
