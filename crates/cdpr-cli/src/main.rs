//! The program `cdpr`: arguments, progress, printing. All mechanics and statistics are in the library crates.

#![allow(clippy::print_stderr)]

#[macro_use]
mod output;

mod answer;
mod arguments;
mod cable;
mod endings;
mod error;
mod lists;
mod pose;
mod poses;
mod questions;
mod robot;
mod slips;
mod study;
mod wrenches;

use clap::{CommandFactory, Parser, Subcommand};
use error::ProgramError;
use output::Ending;
use pose::at_pose::RobotAtFreePose;
use std::process::ExitCode;

/// Elasto-statics of cable-driven parallel robots with sagging, elastic cables.
#[derive(Parser)]
#[command(version, propagate_version = true, after_help = output::EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Compute one cable between two points: its force, tensions, sag and energy.
    #[command(
        after_help = "Example: cdpr catenary --weight 0.9957 --stiffness 1.28e6 --length 4.3 --end 4.1,-1.7"
    )]
    Catenary(cable::catenary::Settings),
    /// Find the unstrained lengths that hold a pose.
    #[command(after_help = "Example: cdpr inverse data/robots/caroca.json --pose 0,0,1.75 --payload 50")]
    Inverse(pose::inverse::Settings),
    /// Find where the platform stands for given unstrained lengths.
    #[command(after_help = "Example: cdpr direct data/robots/caroca.json \
                      --lengths 4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44 --certify")]
    Direct(pose::direct::Settings),
    /// Compute how far a load displaces and rotates the platform.
    #[command(after_help = "Example: cdpr deflection data/robots/caroca.json --pose 0,0,1.75 --payload 50")]
    Deflection(RobotAtFreePose),
    /// Compute the Cartesian stiffness at a pose and its softest motions.
    #[command(after_help = "Example: cdpr stiffness data/robots/caroca.json --pose 0,0,1.75")]
    Stiffness(RobotAtFreePose),
    /// Find what a robot can carry at a pose, and how far its tensions stay from their limits.
    ///
    /// With the tensions distributed anew by the winches, and with the lengths kept. A set of wrenches may
    /// act beside the load; the figures are those of the wrench that leaves the least.
    #[command(after_help = "Examples:
  cdpr capacity data/robots/cogiro.json --pose 0,0,2
  cdpr capacity data/robots/caroca.json --pose 0,0,1.75 --payload 50 --wrench-box 50,50,50,10,10,10")]
    Capacity(pose::capacity::Settings),
    /// Print lengths, tensions, sag, deflection, stiffness and frequency along a path of poses.
    #[command(after_help = "Examples:
  cdpr path data/robots/caroca.json --poses data/poses/caroca.csv --payload 50 > path.csv
  cdpr path data/robots/caroca.json --poses data/poses/caroca.csv --payload 50 \
                      --uncertainty a=0.002,b=0.005,mass=0.5 --figure path.svg")]
    Path(pose::path::Settings),
    /// Map where the cables hold the platform, and how far it gives there, over a plane or a box.
    #[command(after_help = "Examples:
  cdpr workspace data/robots/caroca.json --plane z=1.75 --grid 41x41 --payload 50 --out workspace
  cdpr workspace data/robots/caroca.json --box=-3:3:25,-1.5:1.5:13,0.5:2.5:9 --payload 50 \
                      --uncertainty a=0.002,b=0.002
  cdpr workspace data/robots/cogiro.json --plane z=1.5 --capacity --distances --tilt --boundary")]
    Workspace(robot::workspace::Settings),
    /// Write a page on which a robot computes in the browser: move it, load it, see which tolerance matters.
    ///
    /// One HTML file that needs neither an installation nor a connection, with the robot and these models.
    #[command(after_help = "Examples:
  cdpr explore data/robots/cogiro.json
  cdpr explore data/studies/caroca.json --out caroca.html")]
    Explore(robot::explore::Settings),
    /// List everything that is odd about a robot file.
    #[command(after_help = "Example: cdpr check data/robots/cogiro.json")]
    Check(robot::check::Settings),
    /// Print the completions of all commands for a shell.
    #[command(
        after_help = "Example: cdpr completions bash > ~/.local/share/bash-completion/completions/cdpr"
    )]
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Find out which uncertain parameters of a robot matter.
    Study {
        #[command(subcommand)]
        command: study::Command,
    },
    /// Fit the parameters of a robot to measurements: the calibrated robot, and the accuracy that is left.
    #[command(after_help = "Examples:
  cdpr calibrate caroca --measurements measurements.csv --model tolerances.json \
                      --noise position=1e-4,rotation=1e-4,length=1e-4 --out calibration
  cdpr calibrate irma4u --measurements lengths-and-tensions.csv --parameters mass --unknown length_offset \
                      --noise length=1e-3,tension=2 --out calibration")]
    Calibrate(Box<robot::calibrate::Settings>),
    /// Plan a calibration: what measurements tell, which poses to measure, and what a campaign would read.
    Calibration {
        #[command(subcommand)]
        command: robot::calibration::Command,
    },
    /// Compute the exact derivatives of lengths and deflection with respect to every parameter of a robot.
    #[command(after_help = "Example: cdpr derivatives data/robots/caroca.json --pose 0,0,1.75 --payload 50 \
                      --format json")]
    Derivatives(pose::derivatives::Settings),
    /// Put a payload on a robot and take it off again, with the hysteresis of its cables.
    ///
    /// The hysteresis is that of a load-elongation record, of a law, or of the laws in the robot file.
    #[command(after_help = "Examples:
  cdpr hysteresis data/robots/caroca.json --record data/cables/caroca-4mm-record.csv --length 1 \
                      --pose 0,0,1.75 --payload 50
  cdpr hysteresis data/robots/caroca.json --law data/cables/caroca-4mm-law.json --pose 0,0,1.75 --payload 50
  cdpr hysteresis data/robots/caroca-law.json --pose 0,0,1.75 --payload 50")]
    Hysteresis(pose::hysteresis::Settings),
    /// Compute the mass per length of a cable from the weighing of a piece of it.
    #[command(after_help = "Example: cdpr linear-density --mass 0.203 --length 2 --mass-error 0.001 \
                      --length-error 0.001")]
    LinearDensity(cable::linear_density::Settings),
    /// Compute the natural frequencies and motions of the platform at a pose or for lengths.
    ///
    /// The robot file gives the `inertia` of the platform.
    #[command(after_help = "Example: cdpr modes data/robots/cogiro.json --pose 0,0,2")]
    Modes(pose::modes::Settings),
    /// Compute the moduli of a cable from a load-elongation record.
    ///
    /// Each modulus has its uncertainty; the energy that the loop dissipates stands below them.
    #[command(after_help = "Examples:
  cdpr modulus data/cables/caroca-4mm-record.csv --breaking-force 10290 --section 1.2566370614e-5 --length 1 \
                      --range 5-10 --range 10-30
  cdpr modulus data/cables/caroca-4mm-record.csv --published data/cables/caroca-4mm.json --length 1 \
                      --law target/law.json")]
    Modulus(cable::modulus::Settings),
    /// Write the report of a study: one HTML file with all figures that opens offline.
    #[command(after_help = "Example: cdpr report results")]
    Report(study::report::Settings),
    /// Analyse a table of inputs and outputs, wherever it comes from: which inputs matter, and how.
    ///
    /// A table is CSV, Parquet (if built with it) or a folder of results. Rows without a number in an input
    /// are left out, those without one in an output are failed observations of it; both are named.
    #[command(after_help = "Examples:
  cdpr analyse data/tables/ishigami.csv
  cdpr analyse results --table mechanical --limit 'magnitude_mm<1.4' --out analysis
  cdpr analyse measurements.csv --input 'temperature,load*' --output error_mm --format json")]
    #[command(alias = "analyze")]
    Analyse(study::analyse::Settings),
    /// Find which tolerances to tighten so that an error stays below a limit, and by how much.
    #[command(
        after_help = "Example: cdpr tolerances data/studies/caroca.json --sampling geometrical_asymmetric \
                      --limit 0.9 --costs b=3"
    )]
    Tolerances(study::tolerances::Settings),
    /// Write a robot at rest at a pose for MuJoCo, CASPR or MoorPy.
    #[command(after_help = "Examples:
  cdpr export cogiro --to mjcf --pose 0,0,2 --out cogiro.xml
  cdpr export ipanema-3 --to caspr --pose 0,0,1.3 --out IPAnema3")]
    Export(pose::export::Settings),
    /// Make a robot file of the files of another program.
    ///
    /// What the files lack is asked for by name. What is assumed, what looks like a value of a template
    /// (exit code 3) and what a robot file has no place for is listed.
    #[command(after_help = "Examples:
  cdpr import CASPR/ACROBOT --cable steel-2mm --out acrobot.json
  cdpr import EXPO2015_Lucia.wcrfx --tension-limits 10,4000 --out lucia.json
  cdpr import caroca.yaml --cable steel-4mm --out caroca.json")]
    Import(robot::import::Settings),
    /// List the robots and cables that come with the program.
    ///
    /// Every command takes the name of such a robot in place of a robot file; a file of that name goes first.
    #[command(after_help = "Examples:
  cdpr robots
  cdpr robots cogiro
  cdpr robots --cables")]
    Robots(robot::library::Settings),
    /// Measure how often the direct model finds the true pose from a wrong start.
    #[command(
        after_help = "Example: cdpr robustness --robot data/robots/cogiro.json --poses 1000 --out robustness"
    )]
    Robustness(robot::robustness::Settings),
}

fn main() -> ExitCode {
    match Arguments::try_parse_from(slips::joined(std::env::args_os())) {
        Ok(arguments) => output::exit_code(prepare().and_then(|()| run(arguments.command))),
        Err(error) => {
            let given: Vec<String> =
                std::env::args_os().skip(1).map(|argument| argument.to_string_lossy().into_owned()).collect();
            output::refused(&slips::hinted(error, &Arguments::command(), &given))
        }
    }
}

/// What holds for every command: threads are bounded, and a file that grows too large is an error of writing.
fn prepare() -> Result<(), ProgramError> {
    output::survive_file_limit()?;
    arguments::check_thread_variable(std::env::var(arguments::THREAD_VARIABLE).ok().as_deref())
}

fn run(command: Command) -> Result<Ending, ProgramError> {
    match command {
        Command::Check(settings) => return robot::check::run(&settings),
        Command::Direct(settings) => return pose::direct::run(&settings),
        Command::Inverse(settings) => return pose::inverse::run(&settings),
        Command::Deflection(settings) => return pose::deflection::run(&settings),
        Command::Stiffness(settings) => return pose::stiffness::run(&settings),
        Command::Capacity(settings) => return pose::capacity::run(&settings),
        Command::Path(settings) => return pose::path::run(&settings),
        Command::Modes(settings) => return pose::modes::run(&settings),
        Command::Derivatives(settings) => return pose::derivatives::run(&settings),
        Command::Hysteresis(settings) => return pose::hysteresis::run(&settings),
        Command::Workspace(settings) => return robot::workspace::run(&settings),
        Command::Catenary(settings) => cable::catenary::run(&settings)?,
        Command::Completions { shell } => completions(shell),
        Command::Study { command } => return study::run(command),
        Command::Calibrate(settings) => return robot::calibrate::run(&settings),
        Command::Calibration { command } => robot::calibration::run(&command)?,
        Command::LinearDensity(settings) => cable::linear_density::run(&settings)?,
        Command::Modulus(settings) => cable::modulus::run(&settings)?,
        Command::Tolerances(settings) => study::tolerances::run(&settings)?,
        Command::Report(settings) => study::report::run(&settings)?,
        Command::Explore(settings) => robot::explore::run(&settings)?,
        Command::Analyse(settings) => return study::analyse::run(&settings),
        Command::Export(settings) => pose::export::run(&settings)?,
        Command::Import(settings) => return robot::import::run(&settings),
        Command::Robots(settings) => robot::library::run(&settings)?,
        Command::Robustness(settings) => robot::robustness::run(&settings)?,
    }
    Ok(Ending::Well)
}

fn completions(shell: clap_complete::Shell) {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "cdpr", &mut script);
    println!("{}", String::from_utf8_lossy(&script));
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::builder::ValueParser;
    use clap::error::ErrorKind;

    /// Every command without commands of its own, with the words that call it.
    fn commands(command: &clap::Command, words: &[String]) -> Vec<(Vec<String>, clap::Command)> {
        let below = command.get_subcommands().filter(|inner| inner.get_name() != "help");
        let mut found: Vec<_> = below
            .flat_map(|inner| commands(inner, &[words, &[inner.get_name().to_owned()]].concat()))
            .collect();
        if found.is_empty() {
            found.push((words.to_vec(), command.clone()));
        }
        found
    }

    #[test]
    fn every_count_has_a_greatest_value() {
        let whole = Arguments::command();
        let count = ValueParser::from(arguments::count::<0, 1>).type_id();
        let mut counts = 0;
        for (words, command) in commands(&whole, &[]) {
            for argument in command.get_arguments().filter(|one| one.get_value_parser().type_id() == count) {
                counts += 1;
                let option = format!("--{}", argument.get_long().unwrap_or_default());
                let typed = ["cdpr".to_owned()].into_iter().chain(words.clone());
                let typed = typed.chain([format!("{option}=18446744073709551615")]);
                let error = whole.clone().try_get_matches_from(typed).unwrap_err();
                assert_eq!(error.kind(), ErrorKind::ValueValidation, "{words:?} {option}: {error}");
                assert!(error.to_string().contains("expected a count, "), "{words:?} {option}: {error}");
            }
        }
        assert!(counts >= 10, "{counts}");
    }
}
