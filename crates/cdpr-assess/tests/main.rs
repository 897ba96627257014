//! Assessments of a robot: workspace, tolerances, robustness of the direct model.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod capacity;
mod inspection;
mod maps;
mod robustness;
mod tolerance;
mod workspace;
