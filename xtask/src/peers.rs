//! `cargo xtask bench-peers`: the same direct problems, inverse models and observations, by cdpr and by
//! other programs.
//!
//! `crates/cdpr-statics/examples/peer_problem.rs` writes a list of cases with the answers and times of cdpr.
//! Each program in `xtask/peers` reads it and prints as JSON `version`, `solver` and `cases`, a list of
//! `direct_us`, `direct_position`, `inverse_us`, `tensions`, `observation_us` and `displacements`; `null` for
//! what it cannot solve.

#![allow(clippy::print_stdout)]

pub(crate) mod moordyn;

use crate::cargo::{cargo, done, root};
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, ExitCode};

/// Largest accepted distance between the positions of a peer and of cdpr [mm].
const AGREEMENT_MM: f64 = 1e-6;
/// Largest accepted difference of a tension, relative to the greatest tension of cdpr.
const AGREEMENT_TENSION: f64 = 1e-6;

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

impl Peer {
    fn answer(&self) -> Result<Value, String> {
        if !self.build.is_empty() {
            output(self.build)?;
        }
        serde_json::from_str(&output(self.run)?).map_err(|error| error.to_string())
    }
}

/// Largest differences from cdpr.
#[derive(Clone, Copy, Default)]
struct Apart {
    /// Of positions and displacements [mm].
    mm: f64,
    /// Of tensions, relative to the greatest.
    tension: f64,
}

impl Apart {
    fn max(self, other: Self) -> Self {
        Self { mm: self.mm.max(other.mm), tension: self.tension.max(other.tension) }
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
const SCIPY: &str = "scipy==1.17.1";
/// The Python of an environment with SciPy, which the command makes.
const PYTHON: &str =
    if cfg!(windows) { "target/peers/scipy/Scripts/python.exe" } else { "target/peers/scipy/bin/python" };
const SCIPY_PROBE: [&str; 3] = [PYTHON, "-c", "import scipy.optimize"];
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
        packages: "pip could not install it into target/peers/scipy",
        probe: &SCIPY_PROBE,
        build: &[],
        run: &[PYTHON, "xtask/peers/direct.py", PROBLEM],
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
        packages: "apt install octave octave-optim",
        probe: &[OCTAVE, "--version"],
        build: &[],
        run: &[OCTAVE, "-q", "xtask/peers/direct.m", PROBLEM, "fsolve"],
    },
];

pub(crate) fn bench() -> ExitCode {
    match compare() {
        Ok(apart) if apart.mm <= AGREEMENT_MM && apart.tension <= AGREEMENT_TENSION => ExitCode::SUCCESS,
        Ok(Apart { mm, tension }) => {
            eprintln!(
                "error: the answers differ by {mm:.1e} mm and {tension:.1e} of a tension, more than \
                 {AGREEMENT_MM:.0e} mm or {AGREEMENT_TENSION:.0e}"
            );
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Runs all installed peers, prints a table for each case and writes the result file; returns the largest
/// differences.
fn compare() -> Result<Apart, String> {
    let folder = root().join("target/peers");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let problem = root().join(PROBLEM);
    eprintln!("cdpr: building and running");
    let path = problem.display().to_string();
    let example = ["run", "--quiet", "--release", "-p", "cdpr-statics", "--example", "peer_problem"];
    if cargo(&[&example[..], &["--", &path]].concat()) != ExitCode::SUCCESS {
        return Err("the example peer_problem of cdpr-statics has failed".to_owned());
    }
    let problem = read(&problem)?;
    let cases = problem["cases"].as_array().ok_or("the problem has no cases")?;
    install_scipy(&folder);

    let (mut answers, mut notes, mut failure) = (Vec::new(), Vec::new(), None);
    for peer in &PEERS {
        let Peer { name, packages, probe, build, run } = peer;
        if output(probe).is_err() {
            notes.push(format!("{name} is not installed: {packages}"));
            continue;
        }
        if !build.is_empty() {
            eprintln!("{name}: building");
        }
        eprintln!("{name}: {}", run.join(" "));
        match peer.answer() {
            Ok(answer) => answers.push((*name, answer)),
            Err(error) => failure = Some(format!("{name}: {error}")),
        }
    }

    let (mut results, mut all) = (Vec::new(), Apart::default());
    for (i, case) in cases.iter().enumerate() {
        let (result, apart) = table(case, &answers, i)?;
        results.push(result);
        all = all.max(apart);
    }
    notes.dedup();
    println!("\n{}", notes.join("\n"));
    // The first case is CAROCA.
    let mut result = results[0].clone();
    result["cases"] = json!(results);
    let file = root().join(RESULT);
    std::fs::write(&file, format!("{result:#}\n")).map_err(|error| format!("{}: {error}", file.display()))?;
    println!("written: {RESULT}");
    failure.map_or(Ok(all), Err)
}

/// An environment with SciPy; without it the peer is listed as not installed.
fn install_scipy(folder: &Path) {
    if output(&SCIPY_PROBE).is_ok() {
        return;
    }
    let system = if cfg!(windows) { "python" } else { "python3" };
    let made = done(Command::new(system).args(["-m", "venv"]).arg(folder.join("scipy"))).and_then(|()| {
        done(Command::new(root().join(PYTHON)).args(["-m", "pip", "install", "--quiet", SCIPY]))
    });
    if let Err(error) = made {
        eprintln!("scipy: {error}");
    }
}

/// Prints the table of a case; returns its part of the result file and the largest differences.
fn table(case: &Value, answers: &[(&str, Value)], i: usize) -> Result<(Value, Apart), String> {
    let ours = &case["cdpr"];
    println!("\n{}; tensions on a limit: {}", text(&case["name"]), case["at_limits"]);
    println!(
        "{:<8}{:<9}{:<37}{:>12}{:>9}{:>13}{:>9}{:>17}{:>9}{:>12}{:>12}",
        "program",
        "version",
        "solver",
        "direct [us]",
        "ratio",
        "inverse [us]",
        "ratio",
        "observation [us]",
        "ratio",
        "apart [mm]",
        "tensions"
    );
    let mut times = json!({});
    for question in QUESTIONS {
        times[question] =
            json!({"cdpr": rounded(&ours[question]), "ceres": null, "scipy": null, "octave": null});
    }
    let mut largest = Apart::default();
    let alone = &case["cdpr_alone"];
    let peers = answers.iter().map(|(name, answer)| (*name, answer, &answer["cases"][i]));
    for (name, program, answer) in [("cdpr", ours, ours), ("cdpr", alone, alone)].into_iter().chain(peers) {
        let apart = apart(answer, ours).map_err(|error| format!("{name}: {error}"))?;
        largest = largest.max(apart);
        let mut row = format!("{name:<8}{:<9}{:<37}", text(&program["version"]), text(&program["solver"]));
        for (question, width) in QUESTIONS.into_iter().zip([12, 13, 17]) {
            let (time, our) = (&answer[question], number(ours, question)?);
            row += &cell(time.as_f64(), width);
            row += &cell(time.as_f64().map(|time| time / our), 9);
            if name != "cdpr" && times[question][name].is_null() {
                times[question][name] = rounded(time);
            }
        }
        println!("{row}{:>12.1e}{:>12.1e}", apart.mm, apart.tension);
    }
    times["name"] = case["name"].clone();
    times["agreement_mm"] = json!(largest.mm);
    times["agreement_tension"] = json!(largest.tension);
    Ok((times, largest))
}

const QUESTIONS: [&str; 3] = ["direct_us", "inverse_us", "observation_us"];

fn cell(value: Option<f64>, width: usize) -> String {
    value.map_or_else(|| format!("{:>width$}", "-"), |value| format!("{value:>width$.1}"))
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or("?")
}

/// Largest differences of two answers; those that a program does not give do not count.
fn apart(answer: &Value, ours: &Value) -> Result<Apart, String> {
    let mut mm = distance(&answer["direct_position"], &ours["direct_position"])?;
    for (a, b) in pairs(answer, ours, "displacements")? {
        mm = mm.max(distance(a, b)?);
    }
    let (mut difference, mut greatest) = (0.0_f64, 0.0_f64);
    for (a, b) in pairs(answer, ours, "tensions")? {
        let (Some(a), Some(b)) = (a.as_f64(), b.as_f64()) else {
            return Err(format!("{a} beside {b}, expected two tensions"));
        };
        difference = difference.max((a - b).abs());
        greatest = greatest.max(b);
    }
    Ok(Apart { mm: 1e3 * mm, tension: if greatest > 0.0 { difference / greatest } else { 0.0 } })
}

/// The entries of a list of two answers, none where the first is `null`.
fn pairs<'a>(answer: &'a Value, ours: &'a Value, list: &str) -> Result<Vec<(&'a Value, &'a Value)>, String> {
    let of = |answer: &'a Value| answer[list].as_array().map_or(&[][..], Vec::as_slice);
    let (theirs, ours) = (of(answer), of(ours));
    if !answer[list].is_null() && theirs.len() != ours.len() {
        return Err(format!("{} {list}, expected {}", theirs.len(), ours.len()));
    }
    Ok(theirs.iter().zip(ours).collect())
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
fn rounded(microseconds: &Value) -> Value {
    json!(microseconds.as_f64().map(|time| (1e3 * time).round() / 1e3))
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
