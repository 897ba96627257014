//! Figures and reports of small studies.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod common;
mod cycle;
mod figures;
mod finite;
mod heat_map;
mod report;
mod reread;
mod robustness_figures;
