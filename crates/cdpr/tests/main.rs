//! The program as a user meets it.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod all_inputs;
mod analyse;
mod asked;
mod bad_input;
mod book;
mod calibrate;
mod calibration;
mod changed_folder;
mod commands;
mod common;
mod derivatives;
mod design;
#[path = "../../cdpr-statics/tests/equilibria.rs"]
mod equilibria;
mod explore;
#[cfg(debug_assertions)]
mod faults;
mod figures;
mod first_answers;
mod folder;
mod forty_mistakes;
mod grammar;
mod hysteresis;
mod lengths;
mod library;
mod models;
mod modes;
mod modulus;
mod moves;
mod natural_mistakes;
mod odd_numbers;
mod other_kinds;
mod ours;
mod path;
mod poses;
mod questions;
mod response;
mod safety;
mod shell;
mod simulate;
mod small;
mod strangers;
mod study_blocks;
mod study_poses;
mod study_refused;
mod study_run;
mod study_together;
mod tensions;
#[cfg(target_os = "linux")]
mod terminal;
mod tolerances;
#[cfg(unix)]
mod transcripts;
mod twins;
mod verdict;
mod workspace;
