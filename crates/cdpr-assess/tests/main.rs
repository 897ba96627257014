//! Assessments of a robot: workspace, tolerances, robustness of the direct model.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod capacity;
mod cuts;
mod design;
mod design_cables;
mod design_exhaustive;
mod design_front;
mod design_goals;
mod design_known;
mod design_position;
mod free_workspaces;
mod inspection;
mod maps;
mod partial_factors;
mod refused_workspaces;
mod robustness;
mod safety;
mod shaken_workspaces;
mod tolerance;
mod vibration;
mod winds;
mod workspace;
