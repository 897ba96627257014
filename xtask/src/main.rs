//! Tasks of this repository: `cargo xtask TASK`.
//!
//! A task spawns the programs that it needs; this program links no numerics.

#![allow(clippy::print_stderr, clippy::print_stdout)]

mod attack;
mod bench;
mod cable;
mod calibration;
mod cargo;
mod dist;
mod evidence;
mod fuzz;
mod gallery;
mod led;
mod peers;
mod scaling;
mod statistics;
mod throughput;
mod web;

use cargo::{cargo, cdpr, example_command, root};
use std::path::Path;
use std::process::ExitCode;

const HELP: &str = "\
usage: cargo xtask TASK

tasks:
  caroca-study [--out DIR] [--observations N] [--threads N] [--resume]
                 runs the study of Baklouti, Caro, Courteille (CableCon 2017) and prints it with their
                 figures (data/reference/published.json). All measures of its sensitivity go to
                 DIR/sensitivity, the hysteresis of its cables to DIR/cable, the robot with pulleys and the cable behind them to DIR/led; DIR is
                 target/caroca-study. With --resume it goes on with an interrupted run;
                 otherwise it begins anew
  robustness [--poses N] [--modulus E] [--seed N] [--robot FILE] [--out DIR]
                 counts how often the direct model finds CoGiRo's true pose from a wrong start, by the
                 protocol of Mahnke and Caverly (N = 10000, E = 35e9 Pa) and on thirty poses; DIR is
                 target/robustness
  throughput [--observations N] [--threads N]
                 runs a sampling of the paper's size or larger, without tables, and prints time, memory and
                 results in one line (N = 1000000)
  throughput --all [NAME]
                 prints the time of an observation on one thread, the share of the scalar models and of
                 failures, for the robots and poses of data/benchmarks/throughput.json, or those whose names
                 contain NAME
  scaling [--observations N]
                 runs the same over 10^3, 10^4 .. N observations (1000000) on 1 and 2 threads
  bench [--strict] [--save-baseline] [ARGS]
                 runs all criterion benchmarks, or those that ARGS choose (a part of a name and other options
                 of criterion), counts their instructions where valgrind is installed, and prints both beside
                 data/benchmarks/baseline.json. It fails where a count has grown, and with --strict also
                 where a median has grown
  bench-peers    solves the direct model and an observation with cdpr, and with SciPy, Octave and Ceres
                 where these are installed, see docs/PEERS.md
  bench-moordyn  follows the same motions by cdpr and by MoorDyn, which pip installs into target/peers/moordyn,
                 prints agreement and times, and writes them to data/benchmarks/moordyn.json
  statistics TABLE [STUDIES [FUNCTION]]
                 measures how often estimators of cdpr-sensitivity are right, and keeps whole tables for
                 docs/statistics.md; TABLE is choice (of a fitted law), indices (of Sobol'), expansions,
                 given (first-order indices of tables), levels (of tests of tables), verdicts (of tables with
                 known truth), brackets (bounds by derivatives), measures (all of them, of functions with
                 FUNCTION in their names, or of FUNCTION/MEASURE) or peers (next to SALib and OpenTURNS, which pip
                 installs into target/peers/statistics; there FUNCTION is a part of the names of measures)
  calibration PART [CAMPAIGNS | FILES]
                 measures calibrations; PART is
                 recovery, troubles (outliers, biases, far starts), wrong (models), sensors, speed, scipy,
                 campaigns (beside SciPy, with the coverage of the stds: campaigns of each robot, and how many
                 of them SciPy calibrates), circle (a whole example, with copies of its
                 results) or irma4u (a user's copy of its campaigns)
  fuzz [SECONDS] runs every fuzz target of tests/fuzz for SECONDS (60), on nightly with cargo-fuzz
  attack         runs the program on bad files and arguments, with 10 s and 1 GiB for each, and fails where it
                 panics, hangs or touches a file outside of its folder of results
  evidence [CASE..]
                 runs the comparisons of data/evidence/cases.json, all or those that begin so, keeps their figures
                 there and writes the tables of docs/trust.md; --check compares the figures in the folder
                 CDPR_EVIDENCE, which a run of the tests has written, with those that are kept
  dist           makes what a release consists of in target/dist: the program, on Linux one that runs on
                 any, the wheel, the packed crates, the book, notes and checksums
  web [--check]  makes the module and the page of `cdpr explore` in crates/cdpr-web/dist, or says whether these
                 are of the sources as they are
  gallery        writes docs/robots.md, a picture and a table for each robot of the library
  schemas        writes the JSON Schemas of the file formats to docs/schemas
  help           prints this text";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let task = arguments.next();
    let rest: Vec<String> = arguments.collect();
    if rest.iter().any(|argument| argument == "--help" || argument == "-h") {
        eprintln!("{HELP}");
        return ExitCode::SUCCESS;
    }
    match task.as_deref() {
        Some("caroca-study") => caroca_study(rest),
        Some("robustness") => robustness(rest),
        Some("throughput") => throughput(&rest),
        Some("scaling") => scaling::run(&rest),
        Some("bench") => bench::run(rest),
        Some("bench-peers") => peers::bench(),
        Some("bench-moordyn") => peers::moordyn::bench(),
        Some("statistics") => statistics::run(&rest),
        Some("calibration") => calibration::run(&rest),
        Some("fuzz") => fuzz::run(&rest),
        Some("attack") => attack::run(),
        Some("dist") => dist::run(&rest),
        Some("evidence") => ended(evidence::run(&rest)),
        Some("web") => web::run(&rest),
        Some("gallery") => ended(gallery::run()),
        Some("schemas") => schemas(),
        Some("help" | "--help" | "-h") => {
            eprintln!("{HELP}");
            ExitCode::SUCCESS
        }
        Some(other) => {
            eprintln!("error: no task is called `{other}`\n\n{HELP}");
            ExitCode::FAILURE
        }
        None => {
            eprintln!("{HELP}");
            ExitCode::FAILURE
        }
    }
}

fn caroca_study(mut rest: Vec<String>) -> ExitCode {
    replaceable(&mut rest, "target/caroca-study");
    let study = |file: &str| root().join("data/studies").join(file).display().to_string();
    let (paper, measures) = (study("caroca.json"), study("caroca-sensitivity.json"));
    eprintln!("building the program (a few minutes the first time), then running {paper} and {measures}");
    let code = cdpr(&["study", "run", &paper], &rest);
    if code != ExitCode::SUCCESS {
        return code;
    }
    let mut within_out = rest.clone();
    within(&mut within_out, "--out", "sensitivity");
    let code = cdpr(&["study", "run", &measures], &within_out);
    if code != ExitCode::SUCCESS {
        return code;
    }
    let (out, settings) = without(&rest, "--out");
    let cables = || cable::run(Path::new(out), &settings);
    ended(compared(Path::new(out)).and_then(|()| cables()).and_then(|()| led::run(Path::new(out), &settings)))
}

/// Prints the published figures next to those of the study, and writes them to `published.txt`.
fn compared(out: &Path) -> Result<(), String> {
    let figures = root().join("data/reference/published.json").display().to_string();
    let mut command = example_command("published", &[&figures, &out.display().to_string()]);
    let output = command.output().map_err(|error| format!("cannot start cargo: {error}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    println!("\n{}", String::from_utf8_lossy(&output.stdout));
    let path = out.join("published.txt");
    std::fs::write(&path, output.stdout).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

fn robustness(mut rest: Vec<String>) -> ExitCode {
    replaceable(&mut rest, "target/robustness");
    default(&mut rest, "--robot", "data/robots/cogiro.json");
    eprintln!("building the example (a few minutes the first time), then looking for poses");
    let rest: Vec<&str> = rest.iter().map(String::as_str).collect();
    cargo(&[&["run", "--example", "robustness", "--"][..], &rest].concat())
}

fn throughput(rest: &[String]) -> ExitCode {
    match rest {
        [all] if all == "--all" => return throughput::run(None),
        [all, name] if all == "--all" => return throughput::run(Some(&name.to_lowercase())),
        _ => {}
    }
    let study = root().join("data/studies/caroca.json").display().to_string();
    let option = |name: &str| without(rest, name).0.to_owned();
    let observations = Some(option("--observations")).filter(|number| !number.is_empty());
    let observations = observations.unwrap_or_else(|| "1000000".to_owned());
    let threads = option("--threads");
    let mut command = vec!["run", "--example", "throughput", "--", &study, "mechanical"];
    command.push(&observations);
    if !threads.is_empty() {
        command.push(&threads);
    }
    cargo(&command)
}

/// Adds `option` with a path in the repository, unless the user gives one.
///
/// A path of the user is relative to the current folder.
fn default(arguments: &mut Vec<String>, option: &str, path: &str) {
    let given = format!("{option}=");
    if !arguments.iter().any(|argument| argument == option || argument.starts_with(&given)) {
        arguments.extend([option.to_owned(), root().join(path).display().to_string()]);
    }
}

/// Adds a folder of our own for the results if none is given. Those of another state of the code are replaced
/// there, unless they are to be continued; what is in a folder of the user's is left to the program.
fn replaceable(arguments: &mut Vec<String>, path: &str) {
    let given = arguments.len();
    default(arguments, "--out", path);
    let asked = |argument: &String| ["--resume", "--overwrite"].contains(&argument.as_str());
    if arguments.len() > given && !arguments.iter().any(asked) {
        arguments.push("--overwrite".to_owned());
    }
}

/// Turns the path of `option` into that of a folder within it.
fn within(arguments: &mut [String], option: &str, folder: &str) {
    let given = format!("{option}=");
    let mut is_path = false;
    for argument in arguments {
        if is_path || argument.starts_with(&given) {
            *argument = Path::new(argument).join(folder).display().to_string();
        }
        is_path = argument == option;
    }
}

/// Returns the value of `option`, empty if it is missing, and the other arguments.
fn without<'a>(arguments: &'a [String], option: &str) -> (&'a str, Vec<&'a str>) {
    let given = format!("{option}=");
    let (mut value, mut rest, mut is_value) = ("", Vec::new(), false);
    for argument in arguments {
        match argument.strip_prefix(&given) {
            _ if is_value => value = argument,
            Some(joined) => value = joined,
            None if argument == option => {}
            None => rest.push(argument.as_str()),
        }
        is_value = !is_value && argument == option;
    }
    (value, rest)
}

/// The exit code of a task, and its message.
fn ended(outcome: Result<(), String>) -> ExitCode {
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn schemas() -> ExitCode {
    for example in ["robot_schema", "study_schema", "events_schema"] {
        let code = cargo(&["run", "--quiet", "--example", example]);
        if code != ExitCode::SUCCESS {
            return code;
        }
    }
    ExitCode::SUCCESS
}
