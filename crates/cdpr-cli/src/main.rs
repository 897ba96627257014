//! The program `cdpr`: arguments, progress, printing. All mechanics and statistics are in the library crates.

#![allow(clippy::print_stdout, clippy::print_stderr)]

mod arguments;
mod calibration;
mod derivatives;
mod robustness;
mod sensitivity;
mod study;
mod throughput;
mod tolerances;

use clap::{Parser, Subcommand};
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

/// Elasto-statics of cable-driven parallel robots with sagging, elastic cables.
#[derive(Parser)]
#[command(version, propagate_version = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Study which uncertain parameters of a robot matter.
    Study {
        #[command(subcommand)]
        command: study::Command,
    },
    /// Tell which combinations of a robot's parameters measurements identify, and which poses tell most.
    #[command(after_help = "Example: cdpr calibration data/robots/caroca.json --grid=-2:2:5,-1:1:3,1:2.5:3 \
                      --uncertainty a=0.002,b=0.002,youngs_modulus=5e9 --noise position=1e-4,rotation=1e-4")]
    Calibration(calibration::Settings),
    /// Derivatives of lengths and deflection with respect to every parameter of a robot, exact.
    #[command(
        after_help = "Example: cdpr derivatives data/robots/caroca.json --pose 0,0,1.75 --payload 50 --format json"
    )]
    Derivatives(derivatives::Settings),
    /// Tell which tolerances of a study's error model to tighten, and by how much, so that an error stays below a limit.
    #[command(
        after_help = "Example: cdpr tolerances data/studies/caroca.json --sampling geometrical_asymmetric --limit 2.9 --costs b=3"
    )]
    Tolerances(tolerances::Settings),
    /// Measure how often the direct model finds the true pose from a wrong start.
    #[command(
        after_help = "Example: cdpr robustness --robot data/robots/cogiro.json --poses 1000 --out robustness"
    )]
    Robustness {
        /// Robot file (JSON, `cdpr-robot/1`); the protocols are made for CoGiRo.
        #[arg(long)]
        robot: PathBuf,
        /// Poses of the protocol of Mahnke and Caverly.
        #[arg(long, default_value_t = 10_000)]
        poses: usize,
        /// Its Young's modulus of all cables [Pa]; the thirty poses keep the robot's.
        #[arg(long, default_value_t = 35e9, allow_negative_numbers = true)]
        modulus: f64,
        /// Seed of poses and starts. The same seed gives the same numbers, but for the times.
        #[arg(long, default_value_t = 2017)]
        seed: u64,
        /// Folder for the results; made if missing.
        #[arg(long, default_value = "robustness")]
        out: PathBuf,
    },
}

fn main() -> ExitCode {
    let result: Result<(), Box<dyn Error>> = match Arguments::parse().command {
        Command::Study { command } => study::run(command).map_err(Into::into),
        Command::Calibration(settings) => calibration::run(&settings),
        Command::Derivatives(settings) => derivatives::run(&settings),
        Command::Tolerances(settings) => tolerances::run(&settings),
        Command::Robustness { robot, poses, modulus, seed, out } => {
            let settings = robustness::Settings { robot, poses, modulus, seed, out };
            robustness::run(&settings).map_err(Into::into)
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
