//! `cargo xtask fuzz`: runs every fuzz target for some time and counts its executions.

use crate::cargo::root;
use std::io::{BufRead, BufReader};
use std::process::{Command, ExitCode, Stdio};

/// A fuzz target with the folder of `data` that it reads besides its own corpus, and its arguments.
struct Target {
    name: &'static str,
    seeds: Option<&'static str>,
    arguments: &'static [&'static str],
}

const JSON: &[&str] = &["-dict=json.dict", "-max_len=16384"];

const TARGETS: [Target; 8] = [
    Target { name: "robot_file", seeds: Some("robots"), arguments: JSON },
    Target { name: "study_file", seeds: Some("studies"), arguments: JSON },
    Target { name: "end_force", seeds: None, arguments: &[] },
    Target { name: "length_for_tension", seeds: None, arguments: &[] },
    Target { name: "catenary", seeds: None, arguments: &[] },
    Target { name: "law", seeds: None, arguments: &[] },
    Target { name: "pulley", seeds: None, arguments: &[] },
    Target { name: "record", seeds: Some("cables"), arguments: &["-max_len=16384"] },
];

/// Runs every target, the failed ones too, and prints a table.
pub(crate) fn run(rest: &[String]) -> ExitCode {
    let seconds = match rest {
        [] => Some(60),
        [seconds] => seconds.parse::<u32>().ok().filter(|seconds| *seconds > 0),
        _ => None,
    };
    let Some(seconds) = seconds else {
        eprintln!(
            "error: `cargo xtask fuzz` is followed by nothing or by a whole number of seconds for each target"
        );
        return ExitCode::FAILURE;
    };
    for (tool, arguments, install) in [
        ("the nightly toolchain", ["+nightly", "--version"].as_slice(), "rustup toolchain install nightly"),
        ("cargo-fuzz", &["+nightly", "fuzz", "--version"], "cargo install cargo-fuzz --locked"),
    ] {
        let there =
            Command::new("cargo").args(arguments).output().is_ok_and(|output| output.status.success());
        if !there {
            eprintln!("error: {tool} is missing; install it with\n\n    {install}\n");
            return ExitCode::FAILURE;
        }
    }
    let outcomes: Vec<_> = TARGETS.iter().map(|target| (target.name, target.run(seconds))).collect();
    eprintln!("\n{:<20}{:>14}", "target", "executions");
    for (name, Outcome { executions, failed }) in &outcomes {
        let executions = executions.as_deref().unwrap_or("unknown");
        eprintln!("{name:<20}{executions:>14}{}", if *failed { "   FAILED, see above" } else { "" });
    }
    if outcomes.iter().any(|(_, outcome)| outcome.failed) { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

struct Outcome {
    /// Number of executions that libFuzzer reports, if it ran to its end.
    executions: Option<String>,
    failed: bool,
}

impl Target {
    fn run(&self, seconds: u32) -> Outcome {
        let folder = root().join("tests/fuzz");
        let corpus = folder.join("corpus").join(self.name);
        if let Err(error) = std::fs::create_dir_all(&corpus) {
            eprintln!("error: cannot make {}: {error}", corpus.display());
            return Outcome { executions: None, failed: true };
        }
        let mut command = Command::new("cargo");
        // libFuzzer adds to the first folder and only reads the others.
        command.args(["+nightly", "fuzz", "run", "--fuzz-dir", ".", self.name]).arg(corpus);
        command.args(self.seeds.map(|seeds| root().join("data").join(seeds)));
        command.args(["--", &format!("-max_total_time={seconds}"), "-print_final_stats=1"]);
        command.args(["-rss_limit_mb=4096", "-timeout=10"]).args(self.arguments);
        let child = command.current_dir(folder).stderr(Stdio::piped()).spawn();
        let mut child = match child {
            Ok(child) => child,
            Err(error) => {
                eprintln!("error: cannot start cargo: {error}");
                return Outcome { executions: None, failed: true };
            }
        };
        let mut executions = None;
        for line in child.stderr.take().into_iter().flat_map(|stderr| BufReader::new(stderr).split(b'\n')) {
            let Ok(line) = line else { break };
            let line = String::from_utf8_lossy(&line);
            if let Some(count) = line.strip_prefix("stat::number_of_executed_units:") {
                executions = Some(count.trim().to_owned());
            }
            eprintln!("{line}");
        }
        let failed = !child.wait().is_ok_and(|status| status.success());
        Outcome { executions, failed }
    }
}
