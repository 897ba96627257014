//! The models against references, differences, invariants and each other.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod any_lanes;
mod any_robot;
mod assembled;
mod branch;
mod common;
mod derivative_invariants;
mod derivatives;
mod drawn;
mod elastic_law;
mod end_forces;
mod equilibria;
mod few_cables;
mod few_roots;
mod free_coordinates;
mod grab;
mod gravity;
mod greatest;
mod hysteresis;
mod inverse;
mod models;
mod modes;
mod norms;
mod observation_free;
mod observation_motions;
mod observation_slopes;
mod observer;
mod one_sided;
mod paths;
mod pulleys;
mod reference;
mod search;
mod softest;
mod strain;
mod subproblem;
mod tangent;
mod tensions;
mod tilted_axes;
mod tracker;
mod vector_units;
mod wanted;
