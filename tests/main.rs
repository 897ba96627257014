//! Tests across crates.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod book;
mod builds;
mod caroca_study;
mod data_files;
mod fields;
mod layers;
mod manifests;
mod names;
