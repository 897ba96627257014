//! Tasks of this repository: `cargo xtask TASK`.
//!
//! A task spawns the programs that it needs; this program links no numerics.

#![allow(clippy::print_stderr, clippy::print_stdout)]

mod bench;
mod c_library;
mod cable;
mod cargo;
mod dist;
mod evidence;
mod gallery;
mod latency;
mod led;
mod release;
mod web;

use cargo::{cargo, cdpr, done, example_command, root, text_of, write};
use std::path::Path;
use std::process::{Command, ExitCode};

const HELP: &str = "\
usage: cargo xtask TASK

tasks:
  caroca-study [--out DIR] [--observations N] [--threads N] [--resume]
                 runs the study of Baklouti, Caro, Courteille (CableCon 2017) and prints it with their
                 figures (data/reference/published.json). All measures of its sensitivity go to
                 DIR/sensitivity, the hysteresis of its cables to DIR/cable, the robot with pulleys and the cable behind them to DIR/led; DIR is
                 target/caroca-study. With --resume it goes on with an interrupted run;
                 otherwise it begins again
  robustness [--poses N] [--modulus E] [--seed N] [--robot FILE] [--out DIR]
                 counts how often the direct model finds CoGiRo's true pose from a wrong start, by the
                 protocol of Mahnke and Caverly (N = 10000, E = 35e9 Pa) and on thirty poses; DIR is
                 target/robustness
  throughput [--all [NAME] | OBSERVATIONS [THREADS]]
                 runs a sampling of the paper's study, without tables, and prints time, memory and results in
                 one line (1000000 observations, all threads); with --all a table of the robots and poses of
                 data/benchmarks/throughput.json, on one thread
  bench [--save | ARGS]
                 runs all criterion benchmarks, or those that ARGS choose (a part of a name and other options
                 of criterion), counts their instructions where valgrind is installed, and prints both next to
                 data/benchmarks/baseline.json. It fails where a count has grown by more than 1 %; with --save
                 it writes the baseline
  latency [STEPS [ROBOT..]]
                 follows random smooth courses of the robots of the library (1000000 steps of a tracker each), and
                 writes times, iterations and their causes: data/benchmarks/latency.json, a table and a figure
  statistics TABLE [STUDIES [FUNCTION]]
                 measures how often estimators of cdpr-sensitivity are right; without TABLE it lists the
                 tables, which docs/statistics.md keeps
  ci [STEP..]    what a change has to pass: .ci/run
  attack         runs the program on bad files and arguments: cargo test --test attack
  evidence [CASE..]
                 runs the comparisons of data/evidence/cases.json, all or those that begin so, keeps their figures
                 there and writes the tables of docs/trust.md; --check compares the figures in the folder
                 CDPR_EVIDENCE, which a run of the tests has written, with those that are kept
  dist           makes what a release consists of in target/dist: the program, on Linux one that runs on
                 any, the wheel, the packed crates, the book, notes and checksums
  release [--repository URL] [--authors \"NAME <MAIL>, ..\"] [--version X.Y.Z]
                 sets these wherever files name them: manifests, CITATION.cff, recipe, book, README, paper
                 and, with a version, the heading of CHANGELOG.md
  c --prefix FOLDER
                 builds libcdpr and installs it into FOLDER: header, libraries, pkg-config, CMake, MATLAB, see
                 docs/c.md
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
    let outcome = match task.as_deref() {
        Some("caroca-study") => caroca_study(rest),
        Some("robustness") => robustness(rest),
        Some("throughput") => throughput(&rest),
        Some("latency") => latency::run(&rest),
        Some("statistics") => statistics(&rest),
        Some("bench") => bench::run(&rest),
        Some("ci") => {
            done(Command::new(root().join(".ci/run")).args(&rest)).map_err(|error| error.to_string())
        }
        Some("attack") => cargo(&["test", "--test", "attack"]),
        Some("dist") => dist::run(&rest),
        Some("release") => release::run(&rest).map_err(|error| error.to_string()),
        Some("evidence") => evidence::run(&rest),
        Some("c") => c_library::run(&rest),
        Some("web") => web::run(&rest).map_err(|error| error.to_string()),
        Some("gallery") => gallery::run(),
        Some("schemas") => schemas(),
        Some(other) if other != "help" => Err(format!("no task is called `{other}`\n\n{HELP}")),
        _ => {
            eprintln!("{HELP}");
            return if task.is_some() { ExitCode::SUCCESS } else { ExitCode::FAILURE };
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn caroca_study(mut rest: Vec<String>) -> Result<(), String> {
    replaceable(&mut rest, "target/caroca-study");
    let study = |file: &str| root().join("data/studies").join(file).display().to_string();
    let (paper, measures) = (study("caroca.json"), study("caroca-sensitivity.json"));
    eprintln!("building the program (a few minutes the first time), then running {paper} and {measures}");
    cdpr(&["study", "run", &paper], &rest)?;
    let mut within_out = rest.clone();
    within(&mut within_out, "--out", "sensitivity");
    cdpr(&["study", "run", &measures], &within_out)?;
    let (out, settings) = without(&rest, "--out");
    compared(Path::new(out))?;
    cable::run(Path::new(out), &settings)?;
    led::run(Path::new(out), &settings)
}

/// Prints the published figures next to those of the study, and writes them to `published.txt`.
fn compared(out: &Path) -> Result<(), String> {
    let figures = root().join("data/reference/published.json").display().to_string();
    let text = text_of(&mut example_command("published", &[&figures, &out.display().to_string()]), &[0])?;
    println!("\n{text}");
    write(&out.join("published.txt"), &text)
}

fn robustness(mut rest: Vec<String>) -> Result<(), String> {
    replaceable(&mut rest, "target/robustness");
    default(&mut rest, "--robot", "data/robots/cogiro.json");
    eprintln!("building the example (a few minutes the first time), then looking for poses");
    let rest: Vec<&str> = rest.iter().map(String::as_str).collect();
    cargo(&[&["run", "--example", "robustness", "--"][..], &rest].concat())
}

fn throughput(rest: &[String]) -> Result<(), String> {
    let data = |file: &str| root().join("data").join(file).display().to_string();
    let rest: Vec<&str> = rest.iter().map(String::as_str).collect();
    let (list, study) = (data("benchmarks/throughput.json"), data("studies/caroca.json"));
    // With the profile of what is installed.
    let example = ["run", "--release", "--quiet", "--package", "cdpr-study", "--example", "throughput", "--"];
    match &rest[..] {
        ["--all", name @ ..] => cargo(&[&example[..], &[&list], name].concat()),
        numbers => cargo(&[&example[..], &[&study, "mechanical"], numbers].concat()),
    }
}

fn statistics(rest: &[String]) -> Result<(), String> {
    let rest: Vec<&str> = rest.iter().map(String::as_str).collect();
    let example = ["run", "--release", "--quiet", "-p", "cdpr-sensitivity", "--example", "statistics", "--"];
    cargo(&[&example[..], &rest].concat())
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

fn schemas() -> Result<(), String> {
    let examples = ["robot_schema", "study_schema", "events_schema", "design_schema"];
    examples.iter().try_for_each(|example| cargo(&["run", "--quiet", "--example", example]))
}
