//! The program `cdpr`: arguments, progress, printing. All mechanics and statistics are in the library crates.

#![allow(clippy::print_stderr)]

#[macro_use]
mod output;

mod answer;
mod arguments;
mod cable;
mod calibrate;
mod error;
mod help;
mod lists;
mod pose;
mod questions;
mod robot;
mod said;
mod slips;
mod study;
mod wrenches;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use error::ProgramError;
use output::Ending;
use pose::at_pose::RobotAtFreePose;
use said::Said;
use std::ffi::OsString;
use std::process::ExitCode;
use std::time::Instant;

/// Elasto-statics of cable-driven parallel robots with sagging, elastic cables.
#[derive(Parser)]
#[command(name = "cdpr", version = env!("CDPR_VERSION"), propagate_version = true)]
#[command(after_help = output::EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Print no progress and no notes.
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say what is read and how long it takes, too.
    #[arg(short, long, global = true)]
    verbose: bool,
}

impl Arguments {
    fn said(&self) -> Said {
        match (self.quiet, self.verbose) {
            (true, _) => Said::Less,
            (false, true) => Said::More,
            (false, false) => Said::Usual,
        }
    }
}

#[derive(Subcommand)]
enum Command {
    /// Find the unstrained lengths that hold a pose.
    #[command(after_help = "Example: cdpr inverse data/robots/caroca.json --pose 0,0,1.75 --payload 50")]
    Inverse(pose::inverse::Settings),
    /// Find where the platform rests for given lengths.
    #[command(after_help = "Example: cdpr direct data/robots/caroca.json \
                      --lengths 4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44 --with certificate")]
    Direct(pose::direct::Settings),
    /// Compute how far a load displaces the platform.
    #[command(after_help = "Example: cdpr deflection data/robots/caroca.json --pose 0,0,1.75 --payload 50")]
    Deflection(pose::deflection::Settings),
    /// Compute the Cartesian stiffness and its softest motions.
    #[command(after_help = "Example: cdpr stiffness data/robots/caroca.json --pose 0,0,1.75")]
    Stiffness(RobotAtFreePose),
    /// Compute the natural frequencies of platform and cables.
    ///
    /// At a pose or for lengths. Each motion has the shares of platform and cables in its energy, and a count
    /// proves that none is missing. Without `inertia` in the robot file that of a ball is assumed.
    #[command(after_help = "Examples:
  cdpr modes cogiro --pose 0,0,2
  cdpr modes cogiro --pose 0,0,2 --below 6 --format json
  cdpr modes cogiro --pose 0,0,2 --massless")]
    Modes(pose::modes::Settings),
    /// Follow the motion of platform and cables after events.
    ///
    /// From rest, at a pose or for lengths: a payload that is dropped, a cable that parts, a force, a
    /// platform that is released, a winch that takes cable in. Cables have their mass, their sag and their
    /// elasticity, and may go slack. The series of samples goes to --out, a CSV file, or is printed with
    /// --format csv.
    #[command(after_help = "Example: cdpr simulate cogiro --pose 0,0,2 --payload 50 \
                      --events data/events/payload-dropped.json --until 2 --damping 2e-4 --out series.csv")]
    Simulate(Box<pose::simulate::Settings>),
    /// Shake the platform: its amplitude over the frequency.
    ///
    /// By a force at a point of the platform, and by each winch, with the mass and the damping of the cables.
    /// Without `inertia` in the robot file that of a ball is assumed.
    #[command(after_help = "Examples:
  cdpr response cogiro --pose 0,0,2 --below 20
  cdpr response cogiro --pose 0,0,2 --below 20 --with drag=0.5 --format csv > response.csv
  cdpr response cogiro --pose 0,0,2 --below 20 --with damping=1e-3 --marker 0,0,0.5 --figure response.svg")]
    Response(pose::response::Settings),
    /// Find what a robot can carry at a pose.
    ///
    /// And how far its tensions are from their limits: with the tensions distributed again by the winches,
    /// and with the lengths kept. A set of wrenches may act on top of the load; the figures are those of the
    /// wrench that leaves the least.
    #[command(after_help = "Examples:
  cdpr capacity data/robots/cogiro.json --pose 0,0,2
  cdpr capacity data/robots/caroca.json --pose 0,0,1.75 --payload 50 \
                      --wrench=-50:50,-50:50,-50:50,-10:10,-10:10,-10:10")]
    Capacity(pose::capacity::Settings),
    /// Find what becomes of the platform when a cable breaks.
    ///
    /// Each cable alone, while the winches stand still: where the platform comes to rest, how far it moves
    /// and turns, and whether the other cables bear that. The exit code is 3 where one does not, where the
    /// platform comes below the ground, and where no rest is found.
    #[command(after_help = "Examples:
  cdpr safety cogiro --pose 0,0,2 --payload 100
  cdpr safety cogiro --pose 0,0,2 --with pairs
  cdpr safety caroca --pose 0,0,1.75 --with permanent=1.35,variable=1.5,accidental=1,resistance=2
  cdpr safety data/robots/caroca.json --poses data/poses/caroca.csv > safety.csv")]
    Safety(pose::safety::Settings),
    /// Compute exact derivatives by every parameter.
    ///
    /// Derivatives of lengths, deflection, lowest stiffness and frequency of the platform.
    #[command(after_help = "Example: cdpr derivatives data/robots/caroca.json --pose 0,0,1.75 --payload 50 \
                      --format json")]
    Derivatives(pose::derivatives::Settings),
    /// Put a payload on and take it off, with hysteresis.
    ///
    /// The hysteresis is that of a load-elongation record, of a law, or of the laws in the robot file.
    #[command(after_help = "Examples:
  cdpr hysteresis data/robots/caroca.json --law data/cables/caroca-4mm-record.csv --length 1 \
                      --pose 0,0,1.75 --payload 50
  cdpr hysteresis data/robots/caroca.json --law data/cables/caroca-4mm-law.json --pose 0,0,1.75 --payload 50
  cdpr hysteresis data/robots/caroca-law.json --pose 0,0,1.75 --payload 50")]
    Hysteresis(pose::hysteresis::Settings),
    /// Follow a path: lengths, tensions, deflection, stiffness.
    ///
    /// Also sag and natural frequencies, a row for each pose.
    #[command(after_help = "Examples:
  cdpr path data/robots/caroca.json --poses data/poses/caroca.csv --payload 50 > path.csv
  cdpr path data/robots/caroca.json --poses data/poses/caroca.csv --payload 50 \
                      --uncertainty a=0.002,b=0.005,mass=0.5 --figure path.svg")]
    Path(pose::path::Settings),
    /// Map where the cables hold the platform.
    ///
    /// And how far it is displaced there, over a plane or a box.
    #[command(after_help = "Examples:
  cdpr workspace data/robots/caroca.json --region z=1.75 --payload 50 --out workspace
  cdpr workspace data/robots/caroca.json --region=-3:3:25,-1.5:1.5:13,0.5:2.5:9 --payload 50 \
                      --uncertainty a=0.002,b=0.002
  cdpr workspace data/robots/cogiro.json --region z=1.5 --with capacity,distances,tilt,boundary")]
    Workspace(robot::workspace::Settings),
    /// Find where the exits, the anchors or a mass are best.
    ///
    /// For poses and a load: what may change, within bounds or in steps, and what is to be as good as
    /// possible, are in a file (JSON, `cdpr-design/1`). The search has exact derivatives and several starts;
    /// of steps every combination is evaluated. The exit code is 3 where no robot was found that holds all
    /// poses.
    #[command(after_help = "Examples:
  cdpr design caroca data/designs/caroca-pulleys.json
  cdpr design cogiro data/designs/cogiro-exits.json --out better.json")]
    Design(robot::design::Settings),
    /// Write a page on which the robot computes in a browser.
    ///
    /// Move it, load it, see which tolerance matters. One HTML file that needs neither an installation nor a
    /// connection, with the robot and these models.
    #[command(after_help = "Examples:
  cdpr explore data/robots/cogiro.json
  cdpr explore data/studies/caroca.json --out caroca.html")]
    Explore(robot::explore::Settings),
    /// Find which inputs of a table matter, and how.
    ///
    /// A table of inputs and outputs, wherever it comes from: CSV, Parquet (if built with it) or a folder of
    /// results. Rows without a number in an input are left out, those without one in an output are failed
    /// observations of it; both are named.
    #[command(after_help = "Examples:
  cdpr analyse data/tables/ishigami.csv
  cdpr analyse results/mechanical.csv --limit 'magnitude_mm<1.4' --out analysis
  cdpr analyse measurements.csv --input 'temperature,load*' --output error_mm --format json")]
    #[command(alias = "analyze")]
    Analyse(study::analyse::Settings),
    /// Robots and their files.
    Robot {
        #[command(subcommand)]
        command: robot::Command,
    },
    /// Studies: which uncertain parameters matter.
    Study {
        #[command(subcommand)]
        command: study::Command,
    },
    /// Calibration: from the poses to measure to the calibrated robot.
    Calibrate {
        #[command(subcommand)]
        command: calibrate::Command,
    },
    /// A cable alone.
    Cable {
        #[command(subcommand)]
        command: cable::Command,
    },
    /// Print the completions for a shell.
    #[command(
        after_help = "Example: cdpr completions bash > ~/.local/share/bash-completion/completions/cdpr"
    )]
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print a manual page, or write all of them.
    #[command(after_help = "Examples:
  cdpr man study run | man -l -
  cdpr man --out ~/.local/share/man/man1")]
    Man(help::Settings),
}

/// The program's arguments.
fn command() -> clap::Command {
    help::grouped(Arguments::command())
}

/// Runs the program with these arguments, the first of which is its name, and returns its exit code: 0, 1 for
/// an error, 2 for wrong arguments, 3 for an answer with a reservation. It prints, handles signals and bounds
/// its threads: call it once in a process, as its whole work.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let typed: Vec<OsString> = arguments.into_iter().collect();
    let program = command();
    let found = program.clone().try_get_matches_from(slips::joined(typed.iter().cloned()));
    let parsed = found.and_then(|found| Ok((Arguments::from_arg_matches(&found)?, found)));
    match parsed {
        Ok((arguments, found)) => {
            said::say(arguments.said());
            let clock = Instant::now();
            let ending = arguments::check_together(&program, &found)
                .and_then(|()| prepare())
                .and_then(|()| carry_out(arguments.command));
            said::detail(format_args!("{:.3} s", clock.elapsed().as_secs_f64()));
            output::exit_code(ending)
        }
        Err(error) => {
            let given: Vec<String> =
                typed.iter().skip(1).map(|argument| argument.to_string_lossy().into_owned()).collect();
            output::refused(&slips::hinted(error, &program, &given))
        }
    }
}

/// What holds for every command: threads are bounded, and a file that grows too large is an error of writing.
fn prepare() -> Result<(), ProgramError> {
    output::survive_file_limit()?;
    arguments::check_thread_variable(std::env::var(arguments::THREAD_VARIABLE).ok().as_deref())
}

fn carry_out(command: Command) -> Result<Ending, ProgramError> {
    match command {
        Command::Inverse(settings) => return pose::inverse::run(&settings),
        Command::Direct(settings) => return pose::direct::run(&settings),
        Command::Deflection(settings) => return pose::deflection::run(&settings),
        Command::Stiffness(settings) => return pose::stiffness::run(&settings),
        Command::Modes(settings) => return pose::modes::run(&settings),
        Command::Simulate(settings) => return pose::simulate::run(&settings),
        Command::Response(settings) => return pose::response::run(&settings),
        Command::Capacity(settings) => return pose::capacity::run(&settings),
        Command::Safety(settings) => return pose::safety::run(&settings),
        Command::Derivatives(settings) => return pose::derivatives::run(&settings),
        Command::Hysteresis(settings) => return pose::hysteresis::run(&settings),
        Command::Path(settings) => return pose::path::run(&settings),
        Command::Workspace(settings) => return robot::workspace::run(&settings),
        Command::Design(settings) => return robot::design::run(&settings),
        Command::Explore(settings) => robot::explore::run(&settings)?,
        Command::Analyse(settings) => return study::analyse::run(&settings),
        Command::Robot { command } => return robot::run(&command),
        Command::Study { command } => return study::run(command),
        Command::Calibrate { command } => return calibrate::run(&command),
        Command::Cable { command } => cable::run(&command)?,
        Command::Completions { shell } => completions(shell),
        Command::Man(settings) => help::man(&settings, self::command())?,
    }
    Ok(Ending::Well)
}

fn completions(shell: clap_complete::Shell) {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut command(), "cdpr", &mut script);
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
    fn at_most_65_options_have_long_names_and_each_has_one_meaning() {
        let mut found: std::collections::BTreeMap<String, (Vec<String>, Vec<_>)> = Default::default();
        let mut whole = command();
        whole.build();
        for (words, command) in commands(&whole, &[]) {
            for argument in command.get_arguments() {
                let Some(name) = argument.get_long().filter(|name| !["help", "version"].contains(name))
                else {
                    continue;
                };
                let (commands, kinds) = found.entry(name.to_owned()).or_default();
                commands.push(words.join(" "));
                let kind = (argument.get_value_parser().type_id(), argument.get_action().takes_values());
                if !kinds.contains(&kind) {
                    kinds.push(kind);
                }
            }
        }
        for (name, (commands, kinds)) in &found {
            println!("--{name}: {}", commands.join(", "));
            assert_eq!(kinds.len(), 1, "--{name} has values of several kinds: {commands:?}");
        }
        println!("{} names", found.len());
        assert!(found.len() <= 65, "{}", found.len());
    }

    #[test]
    fn every_count_has_a_greatest_value() {
        let whole = command();
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
        // Those of `--with` have the same parser and are tested with it.
        assert!(counts >= 5, "{counts}");
    }
}
