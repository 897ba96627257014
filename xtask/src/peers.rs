//! `cargo xtask bench-peers`: the same direct problem and observations, solved by cdpr and by other programs.
//!
//! `crates/cdpr-statics/examples/peer_problem.rs` writes the problem with the answers and times of cdpr. Each
//! program in `xtask/peers` reads it and prints `version`, `solver`, `direct_us`, `direct_position`,
//! `observation_us` and `displacements` as JSON.

#![allow(clippy::print_stdout)]

use crate::cargo::{cargo, root};
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, ExitCode};

/// Largest accepted distance between the positions of a peer and of cdpr [mm].
const AGREEMENT_MM: f64 = 1e-6;

/// A way to solve the problem outside of cdpr.
struct Peer {
    /// Name of the program in the result file.
    name: &'static str,
    /// Packages to install.
    packages: &'static str,
    /// Command that succeeds if these are installed.
    probe: &'static [&'static str],
    /// Command that builds the program, empty if there is nothing to build.
    build: &'static [&'static str],
    run: &'static [&'static str],
}

/// The answer of a peer.
struct Answer {
    direct_us: f64,
    observation_us: f64,
    difference_mm: f64,
    /// Its line in the table.
    row: String,
}

impl Peer {
    fn answer(&self, ours: &Value) -> Result<Answer, String> {
        if !self.build.is_empty() {
            output(self.build)?;
        }
        let answer: Value = serde_json::from_str(&output(self.run)?).map_err(|error| error.to_string())?;
        let difference_mm = difference_mm(&answer, ours)?;
        Ok(Answer {
            direct_us: number(&answer, "direct_us")?,
            observation_us: number(&answer, "observation_us")?,
            difference_mm,
            row: row(self.name, &answer, ours, Some(difference_mm))?,
        })
    }
}

const CERES_BUILD: [&str; 10] = [
    "g++",
    "-std=c++17",
    "-O3",
    "-DNDEBUG",
    "-I/usr/include/eigen3",
    "xtask/peers/ceres.cpp",
    "-o",
    CERES,
    "-lceres",
    "-lglog",
];
const CERES: &str = "target/peers/ceres";
const CERES_PROBE: [&str; 9] = [
    "g++",
    "-fsyntax-only",
    "-std=c++17",
    "-I/usr/include/eigen3",
    "-xc++",
    "-includeceres/ceres.h",
    "-includenlohmann/json.hpp",
    "-includeeigen3/Eigen/Core",
    "/dev/null",
];
const CERES_PACKAGES: &str = "apt install g++ libceres-dev nlohmann-json3-dev";
const SCIPY_PROBE: [&str; 3] = ["python3", "-c", "import scipy.optimize"];
const OCTAVE: &str = "octave-cli";
const PROBLEM: &str = "target/peers/problem.json";
const RESULT: &str = "target/bench-peers.json";

/// All peers; of several with one name, the result file holds the first that is installed.
const PEERS: [Peer; 5] = [
    Peer {
        name: "ceres",
        packages: CERES_PACKAGES,
        probe: &CERES_PROBE,
        build: &CERES_BUILD,
        run: &[CERES, PROBLEM, "tiny"],
    },
    Peer {
        name: "ceres",
        packages: CERES_PACKAGES,
        probe: &CERES_PROBE,
        // The peer before has built it.
        build: &[],
        run: &[CERES, PROBLEM],
    },
    Peer {
        name: "scipy",
        packages: "apt install python3-scipy, or pip install scipy",
        probe: &SCIPY_PROBE,
        build: &[],
        run: &["python3", "xtask/peers/direct.py", PROBLEM],
    },
    Peer {
        name: "octave",
        packages: "apt install octave octave-optim",
        probe: &[OCTAVE, "-q", "--eval", "pkg load optim"],
        build: &[],
        run: &[OCTAVE, "-q", "xtask/peers/direct.m", PROBLEM, "lsqnonlin"],
    },
    Peer {
        name: "octave",
        packages: "apt install octave",
        probe: &[OCTAVE, "--version"],
        build: &[],
        run: &[OCTAVE, "-q", "xtask/peers/direct.m", PROBLEM, "fsolve"],
    },
];

pub(crate) fn bench() -> ExitCode {
    match compare() {
        Ok(agreement) if agreement <= AGREEMENT_MM => ExitCode::SUCCESS,
        Ok(agreement) => {
            eprintln!("error: the answers differ by {agreement:.1e} mm, more than {AGREEMENT_MM:.0e} mm");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Runs all installed peers, prints the table and writes the result file; returns the largest difference
/// [mm].
fn compare() -> Result<f64, String> {
    let folder = root().join("target/peers");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let problem = root().join(PROBLEM);
    eprintln!("cdpr: building and running");
    let path = problem.display().to_string();
    let example = ["run", "--quiet", "--example", "peer_problem"];
    if cargo(&[&example[..], &["--", &path]].concat()) != ExitCode::SUCCESS {
        return Err("the example peer_problem of cdpr-statics has failed".to_owned());
    }
    let mut problem = read(&problem)?;
    let (ours, alone) = (problem["cdpr"].take(), problem["cdpr_alone"].take());

    let mut direct =
        json!({"cdpr": rounded(number(&ours, "direct_us")?), "ceres": null, "scipy": null, "octave": null});
    let mut observation = direct.clone();
    observation["cdpr"] = rounded(number(&ours, "observation_us")?);
    let apart = difference_mm(&alone, &ours)?;
    let mut rows = vec![row("cdpr", &ours, &ours, None)?, row("cdpr", &alone, &ours, Some(apart))?];
    let mut agreement = apart;
    let mut failure = None;
    for peer in &PEERS {
        let Peer { name, packages, probe, build, run } = peer;
        if output(probe).is_err() {
            let missing = format!("{name:<8}not installed");
            if !rows.iter().any(|row| row.starts_with(&missing)) {
                rows.push(format!("{missing}: {packages}"));
            }
            continue;
        }
        if !build.is_empty() {
            eprintln!("{name}: building");
        }
        eprintln!("{name}: {}", run.join(" "));
        let answer = match peer.answer(&ours) {
            Ok(answer) => answer,
            Err(error) => {
                rows.push(format!("{name:<8}failed"));
                failure = Some(format!("{name}: {error}"));
                continue;
            }
        };
        agreement = agreement.max(answer.difference_mm);
        rows.push(answer.row);
        if direct[*name].is_null() {
            direct[*name] = rounded(answer.direct_us);
            observation[*name] = rounded(answer.observation_us);
        }
    }
    println!(
        "\n{:<8}{:<9}{:<39}{:>12}{:>9}{:>18}{:>9}{:>12}",
        "program", "version", "solver", "direct [us]", "ratio", "observation [us]", "ratio", "apart [mm]"
    );
    println!("{}", rows.join("\n"));
    let result = json!({"direct_us": direct, "observation_us": observation, "agreement_mm": agreement});
    let file = root().join(RESULT);
    std::fs::write(&file, format!("{result:#}\n")).map_err(|error| format!("{}: {error}", file.display()))?;
    println!("\nwritten: {RESULT}");
    failure.map_or(Ok(agreement), Err)
}

/// A line of the table: the times of `answer`, also as multiples of `ours`.
fn row(name: &str, answer: &Value, ours: &Value, difference: Option<f64>) -> Result<String, String> {
    let (direct, observation) = (number(answer, "direct_us")?, number(answer, "observation_us")?);
    Ok(format!(
        "{name:<8}{:<9}{:<39}{direct:>12.1}{:>9.1}{observation:>18.1}{:>9.1}{:>12}",
        answer["version"].as_str().unwrap_or("?"),
        answer["solver"].as_str().unwrap_or("?"),
        direct / number(ours, "direct_us")?,
        observation / number(ours, "observation_us")?,
        difference.map_or_else(|| "-".to_owned(), |mm| format!("{mm:.1e}")),
    ))
}

/// Largest distance between the positions and displacements [m] of two answers [mm].
fn difference_mm(answer: &Value, ours: &Value) -> Result<f64, String> {
    let mut largest = distance(&answer["direct_position"], &ours["direct_position"])?;
    let list = |answer: &Value| answer["displacements"].as_array().cloned().unwrap_or_default();
    let (theirs, ours) = (list(answer), list(ours));
    if theirs.len() != ours.len() {
        return Err(format!("{} displacements for {} observations", theirs.len(), ours.len()));
    }
    for (a, b) in theirs.iter().zip(&ours) {
        largest = largest.max(distance(a, b)?);
    }
    Ok(1e3 * largest)
}

fn distance(a: &Value, b: &Value) -> Result<f64, String> {
    let mut squares = 0.0;
    for k in 0..3 {
        let (Some(a), Some(b)) = (a[k].as_f64(), b[k].as_f64()) else {
            return Err(format!("{a} beside {b}, expected two points"));
        };
        squares += (a - b) * (a - b);
    }
    Ok(squares.sqrt())
}

fn number(answer: &Value, field: &str) -> Result<f64, String> {
    answer[field].as_f64().ok_or_else(|| format!("no number `{field}` in {answer}"))
}

/// Time rounded to a nanosecond.
fn rounded(microseconds: f64) -> Value {
    json!((1e3 * microseconds).round() / 1e3)
}

fn read(path: &Path) -> Result<Value, String> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))
}

/// Standard output of a command that runs in the repository on one thread.
fn output(command: &[&str]) -> Result<String, String> {
    let (program, arguments) = command.split_first().ok_or("no command")?;
    // A path with a folder is relative to the repository; the system looks up a plain name.
    let program = if program.contains('/') { root().join(program) } else { program.into() };
    let mut command = Command::new(&program);
    command.args(arguments).current_dir(root());
    for variable in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"] {
        command.env(variable, "1");
    }
    let output = command.output().map_err(|error| format!("cannot start {}: {error}", program.display()))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let complaint = String::from_utf8_lossy(&output.stderr);
    Err(format!("{} has failed: {}", program.display(), complaint.trim()))
}
