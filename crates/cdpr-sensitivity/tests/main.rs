//! Designs, laws, fits and effects against published and analytic results.

#![allow(clippy::unwrap_used, clippy::panic)]

mod common;
mod dependent_rows;
mod design;
mod effect;
mod fit;
mod given;
mod global;
mod known_tables;
mod law;
mod scrambling;
mod selection;
mod sobol;
mod summary;
mod verdict;
mod verdict_by_chance;
