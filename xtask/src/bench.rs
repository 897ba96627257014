//! `cargo xtask bench`: criterion's benchmarks and their instruction counts, next to a baseline.
//!
//! Times depend on the load of the machine: criterion compares them with those of its last run. Instruction
//! counts do not: in criterion's test mode each benchmark calls its function `in_one_call` once, and
//! callgrind counts the instructions of that call. Valgrind does not support AVX-512, so that lanes are
//! counted on AVX2.

use crate::cargo::{
    Outcome, cargo_command, done, emptied, files, machine, printed, read, read_json, root, target, text,
    text_of, write,
};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::HashMap;
use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;
use std::time::SystemTime;

/// The bench targets whose benchmarks call `in_one_call`.
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

/// Runs the benchmarks, with arguments of criterion, and compares them, or saves them.
pub(crate) fn run(save: bool, arguments: &[String]) -> Outcome {
    let run = measure(arguments)?;
    let baseline: Vec<Run> = serde_json::from_str(&read(&root().join(BASELINE))?)?;
    let worse = compare(&run, &baseline);
    if save {
        let runs = if arguments.is_empty() { vec![run] } else { merged(baseline, run) };
        write(&root().join(BASELINE), &(serde_json::to_string_pretty(&runs)? + "\n"))?;
        return write(&root().join(BOOK), &runs.iter().map(table).collect::<Vec<_>>().join("\n"));
    }
    if worse.is_empty() { Ok(()) } else { Err(format!("more instructions: {}", worse.join(", ")).into()) }
}

/// The runs of the baseline, without the benchmarks of `run`, and `run`.
fn merged(mut baseline: Vec<Run>, run: Run) -> Vec<Run> {
    for old in &mut baseline {
        old.benchmarks.retain(|old| run.benchmarks.iter().all(|new| new.name != old.name));
    }
    baseline.retain(|old| !old.benchmarks.is_empty());
    baseline.push(run);
    baseline
}

fn measure(arguments: &[String]) -> Outcome<Run> {
    let (begin, folder) = (SystemTime::now(), root().join("target/criterion"));
    let mut command = cargo_command(&["bench", "--workspace", "--bench", "*", "--"]);
    done(command.args(arguments).env("CRITERION_HOME", &folder))?;
    let mut benchmarks = medians(&folder, begin)?;
    if benchmarks.is_empty() {
        return Err("no benchmark has such a name".into());
    }
    let mut machine = machine();
    if let Some(valgrind) = valgrind() {
        let counts = counts(arguments)?;
        for benchmark in &mut benchmarks {
            benchmark.instructions = counts.get(&benchmark.name).copied();
        }
        machine += &format!(", {valgrind}");
    }
    Ok(Run { machine, benchmarks })
}

/// What criterion has written below `folder` since `begin`, in this order.
fn medians(folder: &Path, begin: SystemTime) -> Outcome<Vec<Benchmark>> {
    let mut found = Vec::new();
    for file in files(folder, &[])?.iter().filter(|file| file.ends_with("new/estimates.json")) {
        let of = read_json(&file.with_file_name("benchmark.json"))?;
        let median_ns = read_json(file)?["median"]["point_estimate"].as_f64();
        let benchmark = Benchmark {
            name: text(&of["full_id"]).to_owned(),
            elements: of["throughput"]["Elements"].as_u64().unwrap_or(1),
            median_ns: median_ns.ok_or_else(|| format!("{}: no median", file.display()))?,
            instructions: None,
        };
        found.push((file.metadata()?.modified()?, benchmark));
    }
    found.retain(|(written, _)| *written >= begin);
    found.sort_by_key(|(written, _)| *written);
    Ok(found.into_iter().map(|(_, benchmark)| benchmark).collect())
}

/// The version of valgrind; `None`, and a remark, where it is not installed.
pub(crate) fn valgrind() -> Option<String> {
    let version = printed("valgrind", &["--version"]).ok();
    if version.is_none() {
        eprintln!("no instruction counts: valgrind is not installed (apt install valgrind)");
    }
    version
}

/// A program under callgrind, which counts each call of a function on its own: `name.1` and so on in the
/// folder.
pub(crate) fn callgrind(folder: &Path, name: &str, function: &str, program: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new("valgrind");
    command.args([
        "--tool=callgrind",
        &format!("--toggle-collect={function}"),
        &format!("--dump-after={function}"),
    ]);
    command.arg(format!("--callgrind-out-file={}", folder.join(name).display())).arg(program);
    command
}

/// The instructions of one call of each benchmark by its name, by callgrind.
fn counts(arguments: &[String]) -> Outcome<HashMap<String, u64>> {
    let build = ["bench", "--workspace", "--bench", "*", "--no-run", "--quiet", "--message-format", "json"];
    let messages = text_of(&mut cargo_command(&build), &[0])?;
    let folder = target().join("callgrind");
    emptied(&folder)?;
    let mut counts = HashMap::new();
    for line in messages.lines() {
        let message: Value = serde_json::from_str(line).unwrap_or_default();
        let target = COUNTED.iter().find(|target| message["target"]["name"] == **target);
        let (Some(target), Some(executable)) = (target, message["executable"].as_str()) else { continue };
        eprintln!("counting the instructions of {target}");
        let mut command = callgrind(&folder, target, "*::in_one_call", executable);
        // The environment lies on the stack and shifts it.
        command.env_clear().env("PATH", "/usr/local/bin:/usr/bin:/bin").env("CRITERION_HOME", &folder);
        let printed = text_of(command.args(arguments), &[0])?;
        let names: Vec<&str> = printed.lines().filter_map(|line| line.strip_prefix("Testing ")).collect();
        // Each call has a numbered file.
        let parts = (1..).map(|number| read(&folder.join(format!("{target}.{number}"))));
        let parts: Vec<u64> = parts.map_while(Result::ok).filter_map(|part| total(&part)).collect();
        if parts.len() != names.len() {
            let (names, parts) = (names.len(), parts.len());
            return Err(format!("{target}: {names} benchmarks, but {parts} calls of `in_one_call`").into());
        }
        counts.extend(names.into_iter().map(str::to_owned).zip(parts));
    }
    Ok(counts)
}

/// Number of instructions in a file of callgrind.
pub(crate) fn total(file: &str) -> Option<u64> {
    file.lines().find_map(|line| line.strip_prefix("totals: ")?.trim().parse().ok())
}

/// Prints both runs, and returns the benchmarks whose counts have grown.
fn compare(now: &Run, baseline: &[Run]) -> Vec<String> {
    println!("{:<44}{:>11}{:>11}{:>14}{:>14}", "benchmark", "median", "baseline", "instructions", "baseline");
    let mut worse = Vec::new();
    for Benchmark { name, median_ns, instructions, .. } in &now.benchmarks {
        let then = baseline.iter().flat_map(|run| &run.benchmarks).find(|then| then.name == *name);
        let (count, before) = (*instructions, then.and_then(|then| then.instructions));
        let shown = |count: Option<u64>| count.map_or_else(|| "-".to_owned(), |count| count.to_string());
        let baseline = then.map_or_else(|| "-".to_owned(), |then| duration(then.median_ns));
        let (median, now, then) = (duration(*median_ns), shown(count), shown(before));
        println!("{name:<44}{median:>11}{baseline:>11}{now:>14}{then:>14}");
        if count.zip(before).is_some_and(|(count, before)| is_worse(count, before)) {
            worse.push(name.clone());
        }
    }
    println!("\n{}", now.machine);
    for run in baseline {
        println!("baseline: {}", run.machine);
    }
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
    fn a_part_of_the_benchmarks_replaces_its_own_rows() {
        let run = |machine: &str, names: &[&str]| Run {
            machine: machine.to_owned(),
            benchmarks: Vec::from_iter(names.iter().map(|name| Benchmark {
                name: (*name).to_owned(),
                elements: 1,
                median_ns: 1.0,
                instructions: None,
            })),
        };
        let runs =
            merged(vec![run("first", &["a", "b"]), run("second", &["c"])], run("third", &["b", "c", "d"]));
        let names = |run: &Run| Vec::from_iter(run.benchmarks.iter().map(|row| row.name.clone())).join(" ");
        let rows = Vec::from_iter(runs.iter().map(|run| format!("{}: {}", run.machine, names(run))));
        assert_eq!(rows, ["first: a", "third: b c d"]);
    }

    #[test]
    fn durations_have_a_unit_and_three_digits() {
        assert_eq!([0.5, 9.996, 1_234.0, 2.5e8].map(duration), ["0.50 ns", "10.0 ns", "1.23 µs", "250 ms"]);
    }
}
