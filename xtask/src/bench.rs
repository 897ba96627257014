//! `cargo xtask bench`: medians of all criterion benchmarks, their instruction counts, and what became slower since the baseline.
//!
//! Times depend on what else the machine does. Instruction counts do not: callgrind counts, in criterion's test mode, what a benchmark's
//! one call of its function `counted` executes. Valgrind knows no AVX-512, so the lanes are counted on AVX2.

#![allow(clippy::print_stdout)]

use crate::{cargo_command, root};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, ExitStatus};
use std::time::SystemTime;

/// A median is slower where the 95 % intervals are apart and it is worse by more than this.
const TIME_NOISE: f64 = 0.10;

/// A count is worse where it grew by more than this.
const COUNT_NOISE: f64 = 0.01;

/// The bench targets whose benchmarks call `counted`.
const COUNTED: [&str; 4] = ["catenary", "tension", "statics", "observation"];

const BASELINE: &str = "data/benchmarks/baseline.json";

#[derive(Debug, thiserror::Error)]
enum BenchError {
    #[error("cannot start {program}: {source}")]
    Start { program: &'static str, source: io::Error },
    #[error("{program} has failed ({status})\n{complaint}")]
    Failed { program: &'static str, status: ExitStatus, complaint: String },
    #[error("{}: {source}", path.display())]
    File { path: PathBuf, source: io::Error },
    #[error("{}: {source}", path.display())]
    Json { path: PathBuf, source: serde_json::Error },
    #[error("no benchmark has run: arguments are those of criterion, such as a part of a name")]
    NothingRun,
    #[error(
        "{target}: {benchmarks} benchmarks, but {counts} calls of `counted`: each benchmark has to call it once"
    )]
    Uncounted { target: String, benchmarks: usize, counts: usize },
}

/// The figures of one run, as the baseline keeps them.
#[derive(Debug, Deserialize, Serialize)]
struct Run {
    machine: Machine,
    /// In the order in which they ran.
    benchmarks: Vec<Benchmark>,
}

/// What figures depend on besides the program.
#[derive(Debug, Deserialize, Serialize)]
struct Machine {
    date: String,
    system: String,
    cpu: String,
    cores: usize,
    rustc: String,
    valgrind: Option<String>,
    /// Over the minute before the run.
    load_average: Option<f64>,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
struct Benchmark {
    /// `group/function/parameter`.
    name: String,
    /// Problems solved in one call.
    elements: u64,
    /// Median of one call [ns].
    median_ns: f64,
    /// Its 95 % interval [ns].
    interval_ns: [f64; 2],
    instructions: Option<u64>,
}

/// A figure beside that of the baseline.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Change {
    /// New over old.
    ratio: f64,
    beyond_noise: bool,
}

impl Change {
    fn of_time(now: &Benchmark, then: &Benchmark) -> Self {
        let ratio = now.median_ns / then.median_ns;
        let apart = now.interval_ns[0] > then.interval_ns[1] || now.interval_ns[1] < then.interval_ns[0];
        Self { ratio, beyond_noise: apart && (ratio - 1.0).abs() > TIME_NOISE }
    }

    fn of_count(now: u64, then: u64) -> Self {
        let ratio = now as f64 / then as f64;
        Self { ratio, beyond_noise: (ratio - 1.0).abs() > COUNT_NOISE }
    }

    fn is_worse(self) -> bool {
        self.beyond_noise && self.ratio > 1.0
    }

    /// In percent; in brackets where it is noise.
    fn text(self) -> String {
        let percent = format!("{:+.1} %", 100.0 * (self.ratio - 1.0));
        if self.beyond_noise { percent } else { format!("({percent})") }
    }
}

/// A benchmark, its counterpart in the baseline and what changed.
struct Row<'a> {
    now: &'a Benchmark,
    then: Option<&'a Benchmark>,
    time: Option<Change>,
    count: Option<Change>,
}

impl<'a> Row<'a> {
    fn new(now: &'a Benchmark, baseline: &'a [Benchmark]) -> Self {
        let then = baseline.iter().find(|then| then.name == now.name);
        let counts = now.instructions.zip(then.and_then(|then| then.instructions));
        Self {
            now,
            then,
            time: then.map(|then| Change::of_time(now, then)),
            count: counts.map(|(now, then)| Change::of_count(now, then)),
        }
    }

    fn print(&self) {
        let Self { now, then, time, count } = self;
        let or_dash = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
        let change = |change: &Option<Change>| or_dash(change.map(Change::text));
        println!(
            "{:<40}{:>11}{:>23}{:>11}{:>11}{:>11}{:>14}{:>11}",
            now.name,
            duration(now.median_ns),
            now.interval_ns.map(duration).join(" .. "),
            or_dash((now.elements > 1).then(|| duration(now.median_ns / now.elements as f64))),
            or_dash(then.map(|then| duration(then.median_ns))),
            change(time),
            or_dash(now.instructions.map(|count| count.to_string())),
            change(count),
        );
    }
}

/// Whether a slower median, beside a larger count, is a failure.
#[derive(Clone, Copy, PartialEq)]
enum Times {
    Told,
    Strict,
}

/// Options of its own, then those of criterion.
pub(crate) fn run(mut rest: Vec<String>) -> ExitCode {
    let mut take = |option: &str| {
        let before = rest.len();
        rest.retain(|argument| argument != option);
        rest.len() < before
    };
    let save = take("--save-baseline");
    let times = if take("--strict") { Times::Strict } else { Times::Told };
    let outcome = measure(&rest).and_then(|now| {
        let code = compare(&now, times)?;
        if save { write_baseline(&now).map(|()| ExitCode::SUCCESS) } else { Ok(code) }
    });
    outcome.unwrap_or_else(|error| {
        eprintln!("error: {error}");
        ExitCode::FAILURE
    })
}

/// Runs all benchmarks that the arguments choose.
fn measure(arguments: &[String]) -> Result<Run, BenchError> {
    let machine = Machine::this();
    let begin = SystemTime::now();
    let folder = root().join("target/criterion");
    let mut command = cargo_command(&["bench", "--workspace", "--bench", "*", "--"]);
    let command = command.args(arguments).env("CRITERION_HOME", &folder);
    let status = command.status().map_err(|source| BenchError::Start { program: "cargo", source })?;
    if !status.success() {
        return Err(BenchError::Failed { program: "cargo bench", status, complaint: String::new() });
    }
    let mut found = Vec::new();
    read_results(&folder, begin, &mut found)?;
    if found.is_empty() {
        return Err(BenchError::NothingRun);
    }
    found.sort_by_key(|(written, _)| *written);
    let mut benchmarks: Vec<Benchmark> = found.into_iter().map(|(_, benchmark)| benchmark).collect();
    if machine.valgrind.is_some() {
        for (name, count) in count_instructions(arguments)? {
            let counted = benchmarks.iter_mut().find(|benchmark| benchmark.name == name);
            counted.into_iter().for_each(|benchmark| benchmark.instructions = Some(count));
        }
    } else {
        eprintln!("no instruction counts: valgrind is not installed (apt install valgrind)");
    }
    Ok(Run { machine, benchmarks })
}

/// Prints the table and what is beyond the noise.
fn compare(now: &Run, times: Times) -> Result<ExitCode, BenchError> {
    let path = root().join(BASELINE);
    let baseline: Option<Run> = if path.exists() { Some(read(&path)?) } else { None };
    let then = baseline.as_ref().map_or(&[][..], |run| &run.benchmarks);
    println!(
        "\n{:<40}{:>11}{:>23}{:>11}{:>11}{:>11}{:>14}{:>11}",
        "benchmark", "median", "95 % interval", "each", "baseline", "change", "instructions", "change"
    );
    let rows: Vec<Row> = now.benchmarks.iter().map(|benchmark| Row::new(benchmark, then)).collect();
    rows.iter().for_each(Row::print);
    println!("\n{}", now.machine.text());
    match &baseline {
        Some(run) => println!("baseline: {}", run.machine.text()),
        None => println!("baseline: none, write one with `cargo xtask bench --save-baseline`"),
    }
    let worse = |change: fn(&Row) -> Option<Change>| {
        let worse = |row: &&Row| change(row).is_some_and(Change::is_worse);
        rows.iter().filter(worse).map(|row| row.now.name.as_str()).collect::<Vec<_>>()
    };
    let (slower, more) = (worse(|row| row.time), worse(|row| row.count));
    for (what, names) in [("slower", &slower), ("more instructions", &more)] {
        if !names.is_empty() {
            println!("{what}: {}", names.join(", "));
        }
    }
    let fails = !more.is_empty() || times == Times::Strict && !slower.is_empty();
    Ok(if fails { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

fn write_baseline(run: &Run) -> Result<(), BenchError> {
    let path = root().join(BASELINE);
    let text = serde_json::to_string_pretty(run)
        .map_err(|source| BenchError::Json { path: path.clone(), source })?;
    let written = path.parent().map_or(Ok(()), std::fs::create_dir_all).and_then(|()| {
        std::fs::write(&path, text + "\n") // The file ends with a line.
    });
    written.map_err(|source| BenchError::File { path, source })?;
    println!("written: {BASELINE}");
    Ok(())
}

/// Adds what criterion has written below `folder` since `begin`, each with its time of writing.
fn read_results(
    folder: &Path,
    begin: SystemTime,
    found: &mut Vec<(SystemTime, Benchmark)>,
) -> Result<(), BenchError> {
    #[derive(Deserialize)]
    struct Identity {
        full_id: String,
        throughput: Option<Throughput>,
    }
    #[derive(Deserialize)]
    enum Throughput {
        Elements(u64),
    }
    #[derive(Deserialize)]
    struct Estimates {
        median: Estimate,
    }
    #[derive(Deserialize)]
    struct Estimate {
        point_estimate: f64,
        confidence_interval: Interval,
    }
    #[derive(Deserialize)]
    struct Interval {
        lower_bound: f64,
        upper_bound: f64,
    }

    let broken = |source| BenchError::File { path: folder.to_owned(), source };
    for entry in std::fs::read_dir(folder).map_err(broken)? {
        let path = entry.map_err(broken)?.path();
        if !path.is_dir() {
            continue;
        }
        if !path.ends_with("new") {
            read_results(&path, begin, found)?;
            continue;
        }
        let estimates = path.join("estimates.json");
        let written = estimates.metadata().and_then(|data| data.modified()).map_err(broken)?;
        if written < begin {
            continue;
        }
        let Identity { full_id: name, throughput } = read(&path.join("benchmark.json"))?;
        let Estimates { median } = read(&estimates)?;
        let Interval { lower_bound, upper_bound } = median.confidence_interval;
        let benchmark = Benchmark {
            name,
            elements: throughput.map_or(1, |Throughput::Elements(count)| count),
            median_ns: median.point_estimate,
            interval_ns: [lower_bound, upper_bound],
            instructions: None,
        };
        found.push((written, benchmark));
    }
    Ok(())
}

/// Benchmarks and the instructions of one call, by callgrind.
fn count_instructions(arguments: &[String]) -> Result<Vec<(String, u64)>, BenchError> {
    let build = ["bench", "--workspace", "--bench", "*", "--no-run", "--quiet", "--message-format", "json"];
    let messages = output("cargo", &mut cargo_command(&build))?;
    let executables = messages.lines().filter_map(|line| {
        let message: Value = serde_json::from_str(line).ok()?;
        let target = COUNTED.into_iter().find(|target| message["target"]["name"] == *target)?;
        Some((target, message["executable"].as_str()?.to_owned()))
    });
    let folder = root().join("target/callgrind");
    let broken = |source| BenchError::File { path: folder.clone(), source };
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(broken)?;
    }
    std::fs::create_dir_all(&folder).map_err(broken)?;
    let mut counts = Vec::new();
    for (target, executable) in executables {
        eprintln!("counting the instructions of {target}");
        let mut command = Command::new("valgrind");
        command.args(["--tool=callgrind", "--toggle-collect=*::counted", "--dump-after=*::counted"]);
        command.arg(format!("--callgrind-out-file={}", folder.join(target).display()));
        // The environment lies on the stack and shifts it.
        command.env_clear().env("PATH", "/usr/local/bin:/usr/bin:/bin").env("CRITERION_HOME", &folder);
        let printed = output("valgrind", command.arg(executable).args(arguments))?;
        let names: Vec<&str> = printed.lines().filter_map(|line| line.strip_prefix("Testing ")).collect();
        // One numbered file a call.
        let mut parts = Vec::new();
        for part in (1..).map(|number| folder.join(format!("{target}.{number}"))) {
            if !part.exists() {
                break;
            }
            parts.push(total(&std::fs::read_to_string(&part).map_err(broken)?));
        }
        if parts.len() != names.len() {
            let (benchmarks, counts) = (names.len(), parts.len());
            return Err(BenchError::Uncounted { target: target.to_owned(), benchmarks, counts });
        }
        counts.extend(names.into_iter().map(str::to_owned).zip(parts));
    }
    Ok(counts)
}

/// All instructions of a file of callgrind.
fn total(file: &str) -> u64 {
    file.lines().find_map(|line| line.strip_prefix("totals: ")?.trim().parse().ok()).unwrap_or(0)
}

impl Machine {
    fn this() -> Self {
        let printed = |program, arguments: &[&str]| {
            output(program, Command::new(program).args(arguments)).ok().map(|text| text.trim().to_owned())
        };
        let known = |text: Option<String>| text.unwrap_or_else(|| "unknown".to_owned());
        let cpu = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let model = cpu.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
        let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
        Self {
            date: known(printed("date", &["-u", "+%F"])),
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            cpu: known(model.map(|(_, model)| model.to_owned())),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            rustc: known(printed("rustc", &["--version"])),
            valgrind: printed("valgrind", &["--version"]),
            load_average: load.split(' ').next().and_then(|load| load.parse().ok()),
        }
    }

    fn text(&self) -> String {
        let Self { date, system, cpu, cores, rustc, valgrind, load_average } = self;
        let load = load_average.map_or_else(|| "unknown".to_owned(), |load| load.to_string());
        let valgrind = valgrind.as_deref().unwrap_or("no valgrind");
        format!("{date}, {cpu} ({system}, {cores} cores), {rustc}, {valgrind}, load average {load}")
    }
}

/// With three digits and a unit.
fn duration(ns: f64) -> String {
    let units = [(1e9, "s"), (1e6, "ms"), (1e3, "µs"), (1.0, "ns")];
    let (size, unit) = units.into_iter().find(|(size, _)| ns >= *size).unwrap_or((1.0, "ns"));
    let value = ns / size;
    let digits = if value < 10.0 { 2 } else { usize::from(value < 100.0) };
    format!("{value:.digits$} {unit}")
}

fn read<T: DeserializeOwned>(path: &Path) -> Result<T, BenchError> {
    let text =
        std::fs::read_to_string(path).map_err(|source| BenchError::File { path: path.to_owned(), source })?;
    serde_json::from_str(&text).map_err(|source| BenchError::Json { path: path.to_owned(), source })
}

/// What a command prints.
fn output(program: &'static str, command: &mut Command) -> Result<String, BenchError> {
    let output = command.output().map_err(|source| BenchError::Start { program, source })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let complaint = String::from_utf8_lossy(&output.stderr).trim().to_owned();
    Err(BenchError::Failed { program, status: output.status, complaint })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn benchmark(median_ns: f64, half_width: f64) -> Benchmark {
        Benchmark {
            name: "direct/near".to_owned(),
            elements: 1,
            median_ns,
            interval_ns: [median_ns - half_width, median_ns + half_width],
            instructions: None,
        }
    }

    #[test]
    fn a_median_is_slower_beyond_both_the_intervals_and_the_threshold() {
        let then = benchmark(100.0, 2.0);
        let worse = |now| Change::of_time(&now, &then).is_worse();
        assert!(worse(benchmark(115.0, 2.0)));
        assert!(!worse(benchmark(109.0, 2.0)), "below the threshold");
        assert!(!worse(benchmark(115.0, 20.0)), "intervals that overlap");
    }

    #[test]
    fn a_faster_median_is_beyond_the_noise_but_not_worse() {
        let change = Change::of_time(&benchmark(80.0, 2.0), &benchmark(100.0, 2.0));
        assert!(change.beyond_noise && !change.is_worse());
        assert_eq!(change.text(), "-20.0 %");
    }

    #[test]
    fn a_count_is_worse_beyond_a_percent() {
        assert!(Change::of_count(10_150, 10_000).is_worse());
        assert!(!Change::of_count(10_050, 10_000).is_worse());
        assert!(!Change::of_count(9_000, 10_000).is_worse());
        assert_eq!(Change::of_count(10_050, 10_000).text(), "(+0.5 %)");
    }

    #[test]
    fn a_benchmark_is_compared_with_its_namesake_alone() {
        let baseline = [benchmark(100.0, 1.0)];
        let now = Benchmark { instructions: Some(7), ..benchmark(150.0, 1.0) };
        let row = Row::new(&now, &baseline);
        assert_eq!(row.time, Some(Change { ratio: 1.5, beyond_noise: true }));
        assert_eq!(row.count, None, "the baseline has no count");
        let other = Benchmark { name: "direct/far".to_owned(), ..now.clone() };
        assert!(Row::new(&other, &baseline).then.is_none());
    }

    #[test]
    fn the_total_of_a_callgrind_file_is_found() {
        assert_eq!(total("events: Ir\nsummary: 12\n\ntotals: 4321\n"), 4321);
    }

    #[test]
    fn durations_have_three_digits_and_a_unit() {
        assert_eq!([0.5, 12.34, 1_234.0, 2.5e8].map(duration), ["0.50 ns", "12.3 ns", "1.23 µs", "250 ms"]);
    }
}
