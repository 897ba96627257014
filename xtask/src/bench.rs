//! `cargo xtask bench`: criterion's benchmarks and their instruction counts, next to a baseline.
//!
//! Times depend on the load of the machine: criterion compares them with those of its last run. Instruction
//! counts do not: in criterion's test mode each benchmark calls its function `counted` once, and callgrind
//! counts the instructions of that call. Valgrind does not support AVX-512, so that lanes are counted on AVX2.

use crate::cargo::{cargo_command, parsed, printed, read, root, write};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::SystemTime;

/// The bench targets whose benchmarks call `counted`.
const COUNTED: [&str; 4] = ["catenary", "tension", "statics", "observation"];
/// A count is worse if it grew by more than this.
const NOISE: f64 = 0.01;

const BASELINE: &str = "data/benchmarks/baseline.json";
/// The same as a table of the book.
const BOOK: &str = "data/benchmarks/baseline.md";

/// The figures of one run.
#[derive(Deserialize, Serialize)]
struct Run {
    machine: String,
    benchmarks: Vec<Benchmark>,
}

#[derive(Deserialize, Serialize)]
struct Benchmark {
    /// `group/function/parameter`.
    name: String,
    /// Problems solved in one call.
    elements: u64,
    /// Median of one call [ns].
    median_ns: f64,
    instructions: Option<u64>,
}

/// Runs the benchmarks and compares them; `rest` has `--save` or arguments of criterion.
pub(crate) fn run(rest: &[String]) -> Result<(), String> {
    let saves = rest == ["--save"];
    let run = measure(if saves { &[] } else { rest })?;
    let worse = compare(&run, &serde_json::from_str(&read(&root().join(BASELINE))?).map_err(text)?);
    if saves {
        write(&root().join(BASELINE), &(serde_json::to_string_pretty(&run).map_err(text)? + "\n"))?;
        return write(&root().join(BOOK), &table(&run));
    }
    if worse.is_empty() { Ok(()) } else { Err(format!("more instructions: {}", worse.join(", "))) }
}

fn text(error: impl std::fmt::Display) -> String {
    error.to_string()
}

fn measure(arguments: &[String]) -> Result<Run, String> {
    let (begin, folder) = (SystemTime::now(), root().join("target/criterion"));
    let mut command = cargo_command(&["bench", "--workspace", "--bench", "*", "--"]);
    let status = command.args(arguments).env("CRITERION_HOME", &folder).status().map_err(text)?;
    let mut found = Vec::new();
    if !status.success() || !folder.exists() {
        return Err("`cargo bench` has failed, or no benchmark has such a name".to_owned());
    }
    medians(&folder, begin, &mut found)?;
    found.sort_by_key(|(written, _)| *written);
    let mut benchmarks: Vec<Benchmark> = found.into_iter().map(|(_, benchmark)| benchmark).collect();
    if printed("valgrind", &["--version"]).is_ok() {
        for (name, count) in counts(arguments)? {
            let counted = benchmarks.iter_mut().find(|benchmark| benchmark.name == name);
            counted.into_iter().for_each(|benchmark| benchmark.instructions = Some(count));
        }
    } else {
        eprintln!("no instruction counts: valgrind is not installed (apt install valgrind)");
    }
    Ok(Run { machine: machine(), benchmarks })
}

/// Adds what criterion has written below `folder` since `begin`, each with its time of writing.
fn medians(folder: &Path, begin: SystemTime, found: &mut Vec<(SystemTime, Benchmark)>) -> Result<(), String> {
    for entry in fs::read_dir(folder).map_err(text)? {
        let path = entry.map_err(text)?.path();
        if path.is_dir() && !path.ends_with("new") {
            medians(&path, begin, found)?;
        }
        let estimates = path.join("estimates.json");
        let Ok(written) = estimates.metadata().and_then(|data| data.modified()) else { continue };
        if path.ends_with("new") && written >= begin {
            let of = parsed(&read(&path.join("benchmark.json"))?)?;
            let median_ns = parsed(&read(&estimates)?)?["median"]["point_estimate"].as_f64();
            let benchmark = Benchmark {
                name: of["full_id"].as_str().unwrap_or_default().to_owned(),
                elements: of["throughput"]["Elements"].as_u64().unwrap_or(1),
                median_ns: median_ns.ok_or_else(|| format!("{}: no median", estimates.display()))?,
                instructions: None,
            };
            found.push((written, benchmark));
        }
    }
    Ok(())
}

/// The instructions of one call of each benchmark, by callgrind.
fn counts(arguments: &[String]) -> Result<Vec<(String, u64)>, String> {
    let build = ["bench", "--workspace", "--bench", "*", "--no-run", "--quiet", "--message-format", "json"];
    let messages = cargo_command(&build).output().map_err(text)?.stdout;
    let folder = root().join("target/callgrind");
    // It may not be there.
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).map_err(text)?;
    let mut counts = Vec::new();
    for line in String::from_utf8_lossy(&messages).lines() {
        let message: Value = serde_json::from_str(line).unwrap_or_default();
        let target = COUNTED.iter().find(|target| message["target"]["name"] == **target);
        let (Some(target), Some(executable)) = (target, message["executable"].as_str()) else { continue };
        eprintln!("counting the instructions of {target}");
        let mut command = Command::new("valgrind");
        command.args(["--tool=callgrind", "--toggle-collect=*::counted", "--dump-after=*::counted"]);
        command.arg(format!("--callgrind-out-file={}", folder.join(target).display()));
        // The environment lies on the stack and shifts it.
        command.env_clear().env("PATH", "/usr/local/bin:/usr/bin:/bin").env("CRITERION_HOME", &folder);
        let printed = command.arg(executable).args(arguments).output().map_err(text)?.stdout;
        let printed = String::from_utf8_lossy(&printed).into_owned();
        let names: Vec<&str> = printed.lines().filter_map(|line| line.strip_prefix("Testing ")).collect();
        // Each call has a numbered file.
        let parts = (1..).map(|number| read(&folder.join(format!("{target}.{number}"))));
        let parts: Vec<u64> = parts.map_while(Result::ok).filter_map(|part| total(&part)).collect();
        if parts.len() != names.len() {
            let (names, parts) = (names.len(), parts.len());
            return Err(format!("{target}: {names} benchmarks, but {parts} calls of `counted`"));
        }
        counts.extend(names.into_iter().map(str::to_owned).zip(parts));
    }
    Ok(counts)
}

/// Number of instructions in a file of callgrind.
pub(crate) fn total(file: &str) -> Option<u64> {
    file.lines().find_map(|line| line.strip_prefix("totals: ")?.trim().parse().ok())
}

/// The circumstances that figures depend on besides the program.
fn machine() -> String {
    let known = |program, arguments: &[&str]| printed(program, arguments).unwrap_or_else(|error| error);
    let cpu = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let cpu = cpu.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    [
        known("date", &["-u", "+%F"]),
        cpu.map_or(std::env::consts::ARCH, |(_, name)| name).to_owned(),
        known("rustc", &["--version"]),
        known("valgrind", &["--version"]),
    ]
    .join(", ")
}

/// Prints both runs, and returns the benchmarks whose counts have grown.
fn compare(now: &Run, baseline: &Run) -> Vec<String> {
    println!("{:<44}{:>11}{:>11}{:>14}{:>14}", "benchmark", "median", "baseline", "instructions", "baseline");
    let mut worse = Vec::new();
    for Benchmark { name, median_ns, instructions, .. } in &now.benchmarks {
        let then = baseline.benchmarks.iter().find(|then| then.name == *name);
        let (count, before) = (*instructions, then.and_then(|then| then.instructions));
        let shown = |count: Option<u64>| count.map_or_else(|| "-".to_owned(), |count| count.to_string());
        let median = then.map_or_else(|| "-".to_owned(), |then| duration(then.median_ns));
        println!(
            "{name:<44}{:>11}{median:>11}{:>14}{:>14}",
            duration(*median_ns),
            shown(count),
            shown(before)
        );
        if count.zip(before).is_some_and(|(count, before)| is_worse(count, before)) {
            worse.push(name.clone());
        }
    }
    println!("\n{}\nbaseline: {}", now.machine, baseline.machine);
    worse
}

fn is_worse(count: u64, before: u64) -> bool {
    count as f64 > (1.0 + NOISE) * before as f64
}

/// The figures as the book has them.
fn table(run: &Run) -> String {
    let mut table =
        format!("{}\n\n| benchmark | median | each | instructions |\n|---|---|---|---|\n", run.machine);
    for Benchmark { name, elements, median_ns, instructions } in &run.benchmarks {
        let each = if *elements > 1 { duration(median_ns / *elements as f64) } else { String::new() };
        let count = instructions.map_or_else(String::new, |count| count.to_string());
        table += &format!("| `{name}` | {} | {each} | {count} |\n", duration(*median_ns));
    }
    table
}

/// Duration with a unit and three digits, from 1 ns on.
fn duration(ns: f64) -> String {
    let units = [(1e9, "s"), (1e6, "ms"), (1e3, "µs"), (1.0, "ns")];
    let (size, unit) = units.into_iter().find(|(size, _)| ns >= *size).unwrap_or((1.0, "ns"));
    let value = ns / size;
    // 9.996 is printed as 10.0.
    let digits = if value < 9.995 { 2 } else { usize::from(value < 99.95) };
    format!("{value:.digits$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_count_is_worse_beyond_a_percent() {
        assert!(is_worse(10_150, 10_000));
        assert!(!is_worse(10_050, 10_000) && !is_worse(9_000, 10_000));
        assert_eq!(total("events: Ir\nsummary: 12\n\ntotals: 4321\n"), Some(4321));
    }

    #[test]
    fn durations_have_a_unit_and_three_digits() {
        assert_eq!([0.5, 9.996, 1_234.0, 2.5e8].map(duration), ["0.50 ns", "10.0 ns", "1.23 µs", "250 ms"]);
    }
}
