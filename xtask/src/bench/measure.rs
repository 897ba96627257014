//! The figures of one run: times that criterion has written, and instruction counts by callgrind.
//!
//! Times depend on the load of the machine. Instruction counts do not: in criterion's test mode each
//! benchmark calls its function `counted` once, and callgrind counts the instructions of that call. Valgrind
//! does not support AVX-512, so the lanes are counted on AVX2.

use crate::cargo::{cargo_command, root};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus};
use std::time::SystemTime;

/// The bench targets whose benchmarks call `counted`.
const COUNTED: [&str; 4] = ["catenary", "tension", "statics", "observation"];

#[derive(Debug, thiserror::Error)]
pub(crate) enum BenchError {
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
    #[error("{target}: {benchmarks} benchmarks, but {counts} calls of `counted`: each has to call it once")]
    Uncounted { target: String, benchmarks: usize, counts: usize },
}

/// The figures of one run, as the baseline keeps them.
#[derive(Debug, Deserialize, Serialize)]
pub(crate) struct Run {
    pub(crate) machine: Machine,
    /// In the order in which they ran.
    pub(crate) benchmarks: Vec<Benchmark>,
}

/// The circumstances that figures depend on besides the program.
#[derive(Debug, Deserialize, Serialize)]
pub(crate) struct Machine {
    date: String,
    system: String,
    pub(crate) cpu: String,
    cores: usize,
    pub(crate) rustc: String,
    pub(crate) valgrind: Option<String>,
    /// Over the minute before the run.
    load_average: Option<f64>,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct Benchmark {
    /// `group/function/parameter`.
    pub(crate) name: String,
    /// Problems solved in one call.
    pub(crate) elements: u64,
    /// Median of one call [ns].
    pub(crate) median_ns: f64,
    /// Its 95 % interval [ns].
    pub(crate) interval_ns: [f64; 2],
    pub(crate) instructions: Option<u64>,
}

/// Runs the benchmarks that the arguments choose.
pub(crate) fn measure(arguments: &[String]) -> Result<Run, BenchError> {
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
    if folder.exists() {
        read_results(&folder, begin, &mut found)?;
    }
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

/// Adds the results that criterion has written below `folder` since `begin`, each with its time of writing.
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

/// Counts the instructions of one call of each benchmark by callgrind.
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
        // Each call has a numbered file.
        let mut parts = Vec::new();
        for part in (1..).map(|number| folder.join(format!("{target}.{number}"))) {
            if !part.exists() {
                break;
            }
            parts.extend(total(&std::fs::read_to_string(&part).map_err(broken)?));
        }
        if parts.len() != names.len() {
            let (benchmarks, counts) = (names.len(), parts.len());
            return Err(BenchError::Uncounted { target: target.to_owned(), benchmarks, counts });
        }
        counts.extend(names.into_iter().map(str::to_owned).zip(parts));
    }
    Ok(counts)
}

/// Number of instructions in a file of callgrind.
fn total(file: &str) -> Option<u64> {
    file.lines().find_map(|line| line.strip_prefix("totals: ")?.trim().parse().ok())
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

    pub(crate) fn text(&self) -> String {
        let Self { date, system, cpu, cores, rustc, valgrind, load_average } = self;
        let load = load_average.map_or_else(|| "unknown".to_owned(), |load| load.to_string());
        let valgrind = valgrind.as_deref().unwrap_or("no valgrind");
        format!("{date}, {cpu} ({system}, {cores} cores), {rustc}, {valgrind}, load average {load}")
    }
}

pub(crate) fn read<T: DeserializeOwned>(path: &Path) -> Result<T, BenchError> {
    let text =
        std::fs::read_to_string(path).map_err(|source| BenchError::File { path: path.to_owned(), source })?;
    serde_json::from_str(&text).map_err(|source| BenchError::Json { path: path.to_owned(), source })
}

/// Standard output of a command.
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

    #[test]
    fn the_total_of_a_callgrind_file_is_found() {
        assert_eq!(total("events: Ir\nsummary: 12\n\ntotals: 4321\n"), Some(4321));
        assert_eq!(total("events: Ir\n"), None);
    }
}
