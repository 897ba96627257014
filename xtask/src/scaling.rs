//! `cargo xtask scaling`: time and memory of `cdpr study throughput` over the number of observations and of threads.

#![allow(clippy::print_stdout)]

use crate::{cargo_command, root};
use serde_json::{Value, json};
use std::process::{ExitCode, Stdio};

const RESULT: &str = "target/scaling.json";

/// From here on a study has all the blocks under way, and all the observations it keeps, that it will ever have.
const STEADY: u64 = 100_000;

/// Largest accepted peak memory beside that of [`STEADY`] observations.
const GROWTH: f64 = 1.1;

/// Runs 10^3, 10^4 .. observations up to `rest`, on one and on two threads.
pub(crate) fn run(rest: &[String]) -> ExitCode {
    let most = match rest {
        [] => Some(1_000_000),
        [option, number] if option == "--observations" => number.parse().ok().filter(|most| *most >= 1000),
        _ => None,
    };
    let Some(most) = most else {
        eprintln!(
            "error: `cargo xtask scaling` is followed by nothing or by `--observations N`, N from 1000 on"
        );
        return ExitCode::FAILURE;
    };
    match measure(most) {
        Ok(None) => ExitCode::SUCCESS,
        Ok(Some(growth)) => {
            eprintln!("error: memory grows with observations, {growth:.2} times from {STEADY} on");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints the table and writes the result file; how much memory grows, if it does.
fn measure(most: u64) -> Result<Option<f64>, String> {
    println!(
        "{:>12}{:>9}{:>12}{:>26}{:>20}",
        "observations", "threads", "wall [s]", "us per observation, core", "peak memory [MiB]"
    );
    let mut runs = Vec::new();
    let mut growth: f64 = 0.0;
    for threads in [1, 2] {
        let mut steady = None;
        for observations in (3..).map(|power| 10_u64.pow(power)).take_while(|count| *count <= most) {
            let run = throughput(observations, threads)?;
            let number =
                |field: &str| run[field].as_f64().ok_or_else(|| format!("no number `{field}` in {run}"));
            let (wall, each) = (number("wall_s")?, number("us_per_observation_core")?);
            // `null` where the system does not say.
            let memory = run["peak_memory_mib"].as_f64();
            let shown = memory.map_or_else(|| "-".to_owned(), |mib| format!("{mib:.1}"));
            println!("{observations:>12}{threads:>9}{wall:>12.3}{each:>26.2}{shown:>20}");
            if observations == STEADY {
                steady = memory;
            }
            growth = growth.max(memory.zip(steady).map_or(0.0, |(memory, steady)| memory / steady));
            runs.push(run);
        }
    }
    let file = root().join(RESULT);
    std::fs::write(&file, format!("{:#}\n", json!(runs)))
        .map_err(|error| format!("{}: {error}", file.display()))?;
    println!("\nwritten: {RESULT}");
    Ok((growth > GROWTH).then_some(growth))
}

/// The line that `cargo xtask throughput` prints.
fn throughput(observations: u64, threads: u64) -> Result<Value, String> {
    let study = root().join("data/studies/caroca.json").display().to_string();
    let run = ["run", "--quiet", "--release", "--package", "cdpr-cli", "--"];
    let mut command = cargo_command(&run);
    command.args(["study", "throughput", &study, "--sampling", "mechanical"]);
    command.args(["--observations", &observations.to_string(), "--threads", &threads.to_string()]);
    let output =
        command.stderr(Stdio::inherit()).output().map_err(|error| format!("cannot start cargo: {error}"))?;
    if !output.status.success() {
        return Err(format!("`cdpr study throughput` has failed ({})", output.status));
    }
    let line = String::from_utf8_lossy(&output.stdout);
    serde_json::from_str(&line).map_err(|error| format!("`{}`: {error}", line.trim()))
}
