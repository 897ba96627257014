//! `cargo xtask throughput --all`: the time of an observation, for robots and poses that differ, by the
//! program as it is installed.

#![allow(clippy::print_stdout)]

use crate::cable::read;
use crate::cargo::{cargo_command, root};
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{ExitCode, Stdio};

/// The list of robots and poses.
const CASES: &str = "data/benchmarks/throughput.json";
/// The table of all robots, for the book.
const BOOK: &str = "data/benchmarks/throughput.md";

/// Where the studies are written that the program runs.
const FOLDER: &str = "target/throughput";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Cases {
    format: String,
    #[serde(rename = "about")]
    _about: String,
    cases: Vec<Case>,
}

/// A robot at some poses.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    name: String,
    /// Robot file in `data`.
    robot: String,
    /// Fields of the robot file in place of its own.
    #[serde(default)]
    changes: Map<String, Value>,
    payload: f64,
    #[serde(default)]
    free: Vec<String>,
    /// Half the width of the uniform law of each parameter or group.
    errors: BTreeMap<String, f64>,
    /// At each pose.
    observations: usize,
    poses: Vec<Value>,
}

/// The line of a pose that the example `throughput` of cdpr-study prints.
#[derive(Deserialize)]
struct Line {
    observations: usize,
    failed: usize,
    scalar: Scalar,
    us_without_analysis: f64,
}

#[derive(Deserialize)]
struct Scalar {
    count: usize,
    why: BTreeMap<String, usize>,
}

/// Runs all cases on one thread, or those whose names contain a text, and prints a table.
pub(crate) fn run(chosen: Option<&str>) -> ExitCode {
    match all(chosen) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn all(chosen: Option<&str>) -> Result<(), String> {
    let list: Cases = serde_json::from_value(read(&root().join(CASES))?).map_err(in_file(CASES))?;
    if list.format != "cdpr-throughput/1" {
        return Err(format!("{CASES}: format is `{}`, not cdpr-throughput/1", list.format));
    }
    let folder = root().join(FOLDER);
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let head = "| robot | poses | mean [us] | slowest pose [us] | scalar [%] | failed a row [%] | why scalar |\n\
                |---|---|---|---|---|---|---|";
    println!("{head}");
    let mut table = format!("{head}\n");
    let mut means = Vec::new();
    let cases = list.cases.iter().enumerate();
    for (number, case) in
        cases.filter(|(_, case)| chosen.is_none_or(|part| case.name.to_lowercase().contains(part)))
    {
        let lines = case.measured(&folder, number)?;
        let (row, mean) = row(&case.name, &lines);
        println!("{row}");
        table += &format!("{row}\n");
        means.push(mean);
    }
    if means.is_empty() {
        return Err(format!("{CASES} has no such robot"));
    }
    let count = means.len() as f64;
    let geometric = (means.iter().map(|mean| mean.ln()).sum::<f64>() / count).exp();
    let arithmetic = means.iter().sum::<f64>() / count;
    println!("\nof {count} robots: geometric mean {geometric:.2} us, arithmetic mean {arithmetic:.2} us");
    match chosen {
        None => fs::write(root().join(BOOK), table).map_err(|error| format!("{BOOK}: {error}")),
        Some(_) => Ok(()),
    }
}

/// The row of a robot, and the mean time of an observation [us].
fn row(name: &str, lines: &[Line]) -> (String, f64) {
    let sum = |of: &dyn Fn(&Line) -> usize| lines.iter().map(of).sum::<usize>();
    let times = || lines.iter().map(|line| line.us_without_analysis);
    let mean = times().sum::<f64>() / lines.len() as f64;
    let (all, failed) = (sum(&|line| line.observations), sum(&|line| line.failed));
    let scalar = sum(&|line| line.scalar.count);
    let mut why = BTreeMap::<&str, usize>::new();
    for (reason, count) in lines.iter().flat_map(|line| &line.scalar.why) {
        *why.entry(reason).or_default() += count;
    }
    let why: Vec<String> = why.iter().map(|(reason, count)| format!("{reason} {count}")).collect();
    let row = format!(
        "| {name} | {} | {mean:.2} | {:.2} | {:.2} | {:.2} | {} |",
        lines.len(),
        times().fold(0.0, f64::max),
        100.0 * scalar as f64 / (all - failed).max(1) as f64,
        100.0 * failed as f64 / all as f64,
        why.join(", "),
    );
    (row, mean)
}

impl Case {
    /// Writes the robot and its study, and observes it at every pose.
    fn measured(&self, folder: &Path, number: usize) -> Result<Vec<Line>, String> {
        let mut robot = read(&root().join("data").join(&self.robot))?;
        self.changes.iter().for_each(|(field, value)| robot[field] = value.clone());
        let law = |half: &f64| json!({ "law": { "uniform": { "min": -half, "max": half } } });
        let errors: Map<String, Value> =
            self.errors.iter().map(|(parameter, half)| (parameter.clone(), law(half))).collect();
        let robot_file = format!("{number}-robot.json");
        let study = json!({
            "format": "cdpr-study/1",
            "name": self.name,
            "robot": robot_file,
            "payload": self.payload,
            "seed": 1,
            "replicates": 0,
            "confidence": 0.95,
            "bootstrap_resamples": 1,
            "error_models": { "errors": errors },
            "samplings": { "all": {
                "title": self.name,
                "poses": { "list": self.poses },
                "free": self.free,
                "error_model": "errors",
                "observations": self.observations,
            } },
        });
        let path = folder.join(format!("{number}-study.json"));
        for (path, value) in [(folder.join(&robot_file), &robot), (path.clone(), &study)] {
            fs::write(&path, format!("{value:#}\n")).map_err(in_file(path.display()))?;
        }
        (0..self.poses.len()).map(|pose| self.line(&path, pose)).collect()
    }

    /// Observes the study at one pose.
    fn line(&self, study: &Path, pose: usize) -> Result<Line, String> {
        // With the profile of what is installed.
        let mut command = cargo_command(&["run", "--release", "--quiet", "--package", "cdpr-study"]);
        command.args(["--example", "throughput", "--", &study.display().to_string()]);
        command.args([&format!("all/{pose:04}"), &self.observations.to_string(), "1"]);
        let output = command.stderr(Stdio::inherit()).output();
        let output = output.map_err(|error| format!("cannot start cargo: {error}"))?;
        if !output.status.success() {
            return Err(format!("{}: the example `throughput` has failed ({})", self.name, output.status));
        }
        let text = String::from_utf8_lossy(&output.stdout);
        serde_json::from_str(&text).map_err(in_file(text.trim()))
    }
}

fn in_file<E: std::fmt::Display>(file: impl std::fmt::Display) -> impl FnOnce(E) -> String {
    move |error| format!("{file}: {error}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_names_robots_that_exist_and_no_robot_twice() {
        let list: Cases = serde_json::from_value(read(&root().join(CASES)).unwrap()).unwrap();
        let names: std::collections::BTreeSet<&str> = list.cases.iter().map(|case| &*case.name).collect();
        assert_eq!(names.len(), list.cases.len());
        for case in &list.cases {
            assert!(root().join("data").join(&case.robot).is_file(), "{}", case.robot);
            assert!(!case.poses.is_empty() && case.observations > 0, "{}", case.name);
        }
    }
}
