//! `cargo xtask scaling`: time and memory of the example `throughput` over the number of observations and of
//! threads.

#![allow(clippy::print_stdout)]

use crate::cargo::{example_command, root};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::process::{ExitCode, Stdio};

const RESULT: &str = "target/scaling.json";

/// Number of observations from which on a larger study needs no more memory.
const STEADY: u64 = 100_000;

/// Largest accepted ratio of peak memory to that of [`STEADY`] observations.
const GROWTH: f64 = 1.1;

/// The line that the example `throughput` of cdpr-study prints.
#[derive(Debug, Deserialize, Serialize)]
struct Run {
    sampling: String,
    observations: u64,
    failed: u64,
    scalar: Value,
    threads: u64,
    wall_s: f64,
    us_per_observation_core: f64,
    us_without_analysis: f64,
    /// `None` where the system does not say.
    peak_memory_mib: Option<f64>,
    magnitude_mm: Value,
}

/// Runs 10^3, 10^4 .. observations up to the number in `rest`, on one and on two threads.
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
        Ok(runs) => match runs.iter().filter_map(|runs| growth(runs)).reduce(f64::max) {
            Some(growth) if growth > GROWTH => {
                eprintln!("error: memory grows with observations: {growth:.2} times that of {STEADY}");
                ExitCode::FAILURE
            }
            _ => ExitCode::SUCCESS,
        },
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints the table and writes the result file: the runs of each number of threads.
fn measure(most: u64) -> Result<Vec<Vec<Run>>, String> {
    println!(
        "{:>12}{:>9}{:>11}{:>17}{:>23}{:>19}",
        "observations",
        "threads",
        "wall [s]",
        "each, core [us]",
        "each added, core [us]",
        "peak memory [MiB]"
    );
    let mut all = Vec::new();
    for threads in [1, 2] {
        let mut runs: Vec<Run> = Vec::new();
        for observations in
            (3..).map_while(|power| 10_u64.checked_pow(power)).take_while(|count| *count <= most)
        {
            let run = throughput(observations, threads)?;
            print(&run, runs.last());
            runs.push(run);
        }
        all.push(runs);
    }
    let file = root().join(RESULT);
    serde_json::to_string_pretty(&all)
        .map_err(std::io::Error::from)
        .and_then(|text| std::fs::write(&file, text + "\n"))
        .map_err(|error| format!("{}: {error}", file.display()))?;
    println!("\nwritten: {RESULT}");
    Ok(all)
}

/// Prints a line of the table.
///
/// The time of each added observation is the difference to the run `before`: it does not contain the fits of
/// laws, which take the same time for any larger number.
fn print(run: &Run, before: Option<&Run>) {
    let Run { observations, threads, wall_s, us_per_observation_core, peak_memory_mib, .. } = run;
    let added = before.map(|before| {
        1e6 * (wall_s - before.wall_s) * *threads as f64 / (observations - before.observations) as f64
    });
    let added = added.map_or_else(|| "-".to_owned(), |us| format!("{us:.2}"));
    let memory = peak_memory_mib.map_or_else(|| "-".to_owned(), |mib| format!("{mib:.1}"));
    println!(
        "{observations:>12}{threads:>9}{wall_s:>11.3}{us_per_observation_core:>17.2}{added:>23}{memory:>19}"
    );
}

/// Largest peak memory of more than [`STEADY`] observations, relative to that of [`STEADY`] observations.
fn growth(runs: &[Run]) -> Option<f64> {
    let mut memories =
        runs.iter().filter(|run| run.observations >= STEADY).filter_map(|run| run.peak_memory_mib);
    let steady = memories.next()?;
    memories.map(|memory| memory / steady).reduce(f64::max)
}

fn throughput(observations: u64, threads: u64) -> Result<Run, String> {
    let study = root().join("data/studies/caroca.json").display().to_string();
    let [observations, threads] = [observations, threads].map(|count| count.to_string());
    let arguments = [study.as_str(), "mechanical", &observations, &threads];
    let mut command = example_command("throughput", &arguments);
    let output =
        command.stderr(Stdio::inherit()).output().map_err(|error| format!("cannot start cargo: {error}"))?;
    if !output.status.success() {
        return Err(format!("the example `throughput` has failed ({})", output.status));
    }
    let line = String::from_utf8_lossy(&output.stdout);
    serde_json::from_str(&line).map_err(|error| format!("`{}`: {error}", line.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(observations: u64, mib: f64) -> Run {
        Run {
            sampling: "mechanical".to_owned(),
            observations,
            failed: 0,
            scalar: Value::Null,
            threads: 1,
            wall_s: 1.0,
            us_per_observation_core: 1.0,
            us_without_analysis: 1.0,
            peak_memory_mib: Some(mib),
            magnitude_mm: Value::Null,
        }
    }

    #[test]
    fn growth_is_the_ratio_of_peak_memory_beyond_the_steady_state() {
        assert_eq!(growth(&[run(1_000, 1.0), run(STEADY, 4.0), run(10 * STEADY, 5.0)]), Some(1.25));
        assert_eq!(growth(&[run(1_000, 1.0), run(STEADY, 4.0)]), None);
    }
}
