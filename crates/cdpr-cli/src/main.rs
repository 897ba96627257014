//! The program `cdpr`: arguments, progress, printing. All mechanics and statistics are in the library crates.

#![allow(clippy::print_stdout, clippy::print_stderr)]

mod study;

use clap::{Parser, Subcommand};
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
}

fn main() -> ExitCode {
    let Arguments { command: Command::Study { command } } = Arguments::parse();
    let StudyCommand::Run { study, out, observations, threads } = command;
    let result = study::run(&study::Settings { study, out, observations, threads });
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
