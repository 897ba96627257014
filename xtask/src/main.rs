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
mod runs;
mod web;

use cargo::{Outcome, cargo_command, done, load, machine, release_example, root, study, text_of, write};
use clap::{Args, Parser};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Tasks of this repository. `cargo xtask TASK --help` says what a task writes and takes.
#[derive(Parser)]
#[command(bin_name = "cargo xtask", subcommand_value_name = "TASK", subcommand_help_heading = "Tasks")]
enum Task {
    /// Run the study of Baklouti, Caro, Courteille (CableCon 2017) and print it with their figures
    ///
    /// The published figures are in data/reference/published.json. All measures of the study's sensitivity go
    /// to DIR/sensitivity, the hysteresis of its cables to DIR/cable, the robot with pulleys and the cable
    /// behind them to DIR/led, all places of its pulleys to DIR/reconfiguration.txt. It begins again unless
    /// it resumes.
    CarocaStudy(Study),
    /// Count how often the direct model finds CoGiRo's true pose from a wrong start
    ///
    /// [--poses N] [--modulus E] [--seed N] [--robot FILE] [--free NAMES] [--out DIR]: by the protocol of
    /// Mahnke and Caverly (N = 10000, E = 35e9 Pa) and on thirty poses; DIR is target/robustness.
    Robustness(Rest),
    /// Run a sampling of the paper's study, without tables, and print time, memory and results in a line
    ///
    /// [OBSERVATIONS [THREADS]]: 1000000 observations on all threads.
    Throughput {
        /// The robots and poses of data/benchmarks/throughput.json, on one thread: writes throughput.md next
        /// to it; with a part of a name those robots, without writing
        #[arg(long)]
        all: bool,
        #[command(flatten)]
        rest: Rest,
    },
    /// Run all criterion benchmarks, and print times and instructions next to the baseline
    ///
    /// Arguments go to criterion: a part of a name, and other options. Instructions are counted where
    /// valgrind is installed; it fails where a count is by 1 % larger than in data/benchmarks/baseline.json.
    Bench {
        /// Write the baseline
        #[arg(long)]
        save: bool,
        #[command(flatten)]
        rest: Rest,
    },
    /// Follow random smooth courses of the robots of the library, and write times and iterations
    ///
    /// [STEPS [ROBOT..]]: 1000000 steps of a tracker each; to data/benchmarks/latency.json, a table and a
    /// figure.
    Latency(Rest),
    /// Measure how often estimators of cdpr-sensitivity are right
    ///
    /// TABLE [STUDIES [FUNCTION]]; without TABLE it lists the tables, which docs/statistics.md shows.
    Statistics {
        /// Keep the table in data/evidence/statistics, with date, machine and commit in runs.json
        #[arg(long)]
        keep: bool,
        #[command(flatten)]
        rest: Rest,
    },
    /// Run what a change has to pass, or steps of it: .ci/run
    Ci(Rest),
    /// Run the program on bad files and arguments: cargo test --test attack
    Attack,
    /// Run the comparisons of data/evidence/cases.json, all or those that begin so
    ///
    /// It keeps their figures there and writes the tables of docs/trust.md.
    Evidence {
        /// Compare the figures in the folder CDPR_EVIDENCE, which tests have written, with those that are
        /// kept
        #[arg(long)]
        check: bool,
        /// Beginnings of their names
        cases: Vec<String>,
    },
    /// Make what a release consists of in target/dist
    ///
    /// The program, on Linux one that runs on any, the wheel, the packed crates, the book, notes and
    /// checksums.
    Dist,
    /// Set repository, authors and version wherever files name them
    ///
    /// In manifests, CITATION.cff, recipe, book, README, paper and, with a version, the heading of
    /// CHANGELOG.md.
    Release(release::Values),
    /// Build libcdpr and install it: header, libraries, pkg-config, CMake, MATLAB, see docs/c.md
    C {
        /// Where to
        #[arg(long, value_name = "FOLDER")]
        prefix: PathBuf,
    },
    /// Make the module and the page of `cdpr explore` in crates/cdpr-web/dist
    Web {
        /// Say whether these are of the sources as they are
        #[arg(long)]
        check: bool,
    },
    /// Write docs/robots.md, a picture and a table for each robot of the library
    Gallery,
    /// Write the JSON Schemas of the file formats to docs/schemas, and docs/fields.md
    Schemas,
}

/// Arguments of another program.
#[derive(Args)]
struct Rest {
    /// What the program takes that the task runs
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "ARGUMENTS")]
    rest: Vec<String>,
}

#[derive(Args)]
struct Study {
    /// Folder of the results [default: target/caroca-study]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Keep its texts in data/evidence, with date, machine and commit in runs.json
    #[arg(long)]
    keep: bool,
    /// Observations of each part
    #[arg(long, value_name = "N")]
    observations: Option<String>,
    /// Threads [default: all]
    #[arg(long, value_name = "N")]
    threads: Option<String>,
    /// Go on with an interrupted run
    #[arg(long)]
    resume: bool,
    #[command(flatten)]
    rest: Rest,
}

fn main() -> ExitCode {
    let outcome = match Task::parse() {
        Task::CarocaStudy(settings) => caroca_study(settings),
        Task::Robustness(rest) => robustness(&rest.rest),
        Task::Throughput { all, rest } => throughput(all, rest.rest),
        Task::Latency(rest) => latency::run(&rest.rest),
        Task::Statistics { keep, rest } => statistics(keep, &rest.rest),
        Task::Bench { save, rest } => bench::run(save, &rest.rest),
        Task::Ci(rest) => done(Command::new(root().join(".ci/run")).args(rest.rest)),
        Task::Attack => done(&mut cargo_command(&["test", "--test", "attack"])),
        Task::Dist => dist::run(),
        Task::Release(values) => release::run(&values),
        Task::Evidence { check, cases } => evidence::run(check, &cases),
        Task::C { prefix } => c_library::run(&prefix),
        Task::Web { check } => web::run(check),
        Task::Gallery => gallery::run(),
        Task::Schemas => schemas(),
    };
    outcome.map_or_else(
        |error| {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        },
        |()| ExitCode::SUCCESS,
    )
}

fn caroca_study(settings: Study) -> Outcome {
    let mut options = settings.rest.rest;
    // Results of another state of the code are replaced in our folder; a folder of the user's is left to the
    // program.
    if settings.resume {
        options.push("--resume".to_owned());
    } else if settings.out.is_none() && !options.iter().any(|option| option == "--overwrite") {
        options.push("--overwrite".to_owned());
    }
    options.extend(settings.observations.map(|number| format!("--observations={number}")));
    options.extend(settings.threads.map(|number| format!("--threads={number}")));
    let out = settings.out.unwrap_or_else(|| root().join("target/caroca-study"));
    let studies = root().join("data/studies");
    eprintln!(
        "building the program (a few minutes the first time), then running the studies of {}",
        studies.display()
    );
    study(&studies.join("caroca.json"), &out, &options)?;
    study(&studies.join("caroca-sensitivity.json"), &out.join("sensitivity"), &options)?;
    example("published", &[&root().join("data/reference/published.json"), &out], &out)?;
    cable::run(&out, &options)?;
    led::run(&out, &options)?;
    eprintln!("evaluating all configurations of the pulleys, a minute on two threads");
    let study = root().join("data/studies/caroca.json");
    example("reconfiguration", &[&study], &out)?;
    if !settings.keep {
        return Ok(());
    }
    let names = ["published", "led", "reconfiguration"];
    for file in names.map(|name| format!("{name}.txt")) {
        write(&root().join("data/evidence").join(&file), &cargo::read(&out.join(&file))?)?;
    }
    runs::note(names.into_iter())
}

fn statistics(keep: bool, rest: &[String]) -> Outcome {
    let mut example = release_example("cdpr-sensitivity", "statistics", rest);
    let Some(table) = rest.first().filter(|_| keep) else { return done(&mut example) };
    let text = text_of(&mut example, &[0])?;
    println!("{text}");
    let name = format!("statistics/{table}");
    let shown = format!("```text\n{}\n```\n", text.trim_end());
    write(&root().join(format!("data/evidence/{name}.md")), &shown)?;
    runs::note([name.as_str()].into_iter())
}

/// Prints what an example of `cdpr-study` says of these files, and writes it to a text of its name in `out`.
///
/// As for the program, cargo chooses the example among all default members: with the features of one package
/// alone everything would be compiled again.
fn example(name: &str, files: &[&Path], out: &Path) -> Outcome {
    let mut run = cargo_command(&["run", "--quiet", "--example", name, "--"]);
    let text = text_of(run.args(files), &[0])?;
    println!("\n{text}");
    write(&out.join(format!("{name}.txt")), &text)
}

fn robustness(rest: &[String]) -> Outcome {
    eprintln!("building the example (a few minutes the first time), then looking for poses");
    let mut run = cargo_command(&["run", "--example", "robustness", "--"]);
    if !rest.iter().any(|argument| argument == "--out") {
        run.arg("--out").arg(root().join("target/robustness")).arg("--overwrite");
    }
    done(run.args(rest))
}

fn throughput(all: bool, rest: Vec<String>) -> Outcome {
    let data = |file: &str| root().join("data").join(file).display().to_string();
    let mut arguments = match all {
        true => vec![data("benchmarks/throughput.json")],
        false => vec![data("studies/caroca.json"), "mechanical".to_owned()],
    };
    let whole = all && rest.is_empty();
    arguments.extend(rest);
    let mut example = release_example("cdpr-study", "throughput", &arguments);
    if !whole {
        return done(&mut example);
    }
    let before = load();
    let rows = text_of(&mut example, &[0])?;
    let table = format!("{}, load average {before} before and {} after\n\n{rows}", machine(), load());
    println!("{table}");
    write(&root().join("data/benchmarks/throughput.md"), &table)
}

fn schemas() -> Outcome {
    let examples = ["robot_schema", "study_schema", "events_schema", "design_schema"];
    examples
        .iter()
        .try_for_each(|example| done(&mut cargo_command(&["run", "--quiet", "--example", example])))?;
    // The page of their fields.
    let mut page =
        cargo_command(&["test", "--quiet", "--package", "cdpr-tests", "--test", "integration", "fields::"]);
    done(page.env("INSTA_UPDATE", "always"))
}
