//! The program `cdpr`: arguments, progress, printing. All mechanics and statistics are in the library crates.

#![allow(clippy::print_stdout, clippy::print_stderr)]

mod arguments;
mod calibration;
mod derivatives;
mod hysteresis;
mod linear_density;
mod modulus;
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
        command: StudyCommand,
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
    /// Put a payload on a robot and take it off again, on cables with the hysteresis of a load-elongation record.
    #[command(
        after_help = "Example: cdpr hysteresis data/robots/caroca.json --record data/cables/caroca-4mm-record.csv --length 1 --pose 0,0,1.75 --payload 50"
    )]
    Hysteresis(hysteresis::Settings),
    /// Mass per length of a cable from the weighing of a piece of it.
    #[command(
        after_help = "Example: cdpr linear-density --mass 0.203 --length 2 --mass-error 0.001 --length-error 0.001"
    )]
    LinearDensity(linear_density::Settings),
    /// Moduli of a cable from a load-elongation record, with their uncertainty, and the energy that the loop dissipates.
    #[command(
        after_help = "Example: cdpr modulus data/cables/caroca-4mm-record.csv --breaking-force 10290 --section 1.2566370614e-5 --length 1 --range 5-10 --range 10-30"
    )]
    Modulus(modulus::Settings),
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

#[derive(Subcommand)]
enum StudyCommand {
    /// Run a study file and write observations, figures and a summary.
    #[command(after_help = "Example: cdpr study run data/studies/caroca.json --out results")]
    Run {
        /// Study file (JSON, `cdpr-study/1`).
        study: PathBuf,
        /// Folder for the results; made if missing.
        #[arg(long, default_value = "results")]
        out: PathBuf,
        /// Observations of each sampling, in place of the file's.
        #[arg(long)]
        observations: Option<usize>,
        /// Threads; all cores if left out. The numbers do not depend on it.
        #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
        threads: Option<u16>,
    },
    /// Run one sampling of a study without writing anything; print how long it took, its memory and its results as JSON.
    #[command(
        after_help = "Example: cdpr study throughput data/studies/caroca.json --sampling mechanical --observations 1000000"
    )]
    Throughput {
        /// Study file (JSON, `cdpr-study/1`).
        study: PathBuf,
        /// Name of the sampling.
        #[arg(long)]
        sampling: String,
        /// Observations, in place of the file's.
        #[arg(long, default_value_t = 1_000_000)]
        observations: usize,
        /// Threads; all cores if left out. The numbers do not depend on it.
        #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
        threads: Option<u16>,
    },
}

fn main() -> ExitCode {
    let result: Result<(), Box<dyn Error>> = match Arguments::parse().command {
        Command::Study { command: StudyCommand::Run { study, out, observations, threads } } => {
            study::run(&study::Settings { study, out, observations, threads }).map_err(Into::into)
        }
        Command::Study { command: StudyCommand::Throughput { study, sampling, observations, threads } } => {
            throughput::run(&study, &sampling, observations, threads).map_err(Into::into)
        }
        Command::Calibration(settings) => calibration::run(&settings),
        Command::Derivatives(settings) => derivatives::run(&settings),
        Command::Hysteresis(settings) => hysteresis::run(&settings),
        Command::LinearDensity(settings) => linear_density::run(&settings),
        Command::Modulus(settings) => modulus::run(&settings),
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
