//! `cargo xtask statistics`: how often the estimators of cdpr-sensitivity are right; with `peers` beside
//! those of SALib and OpenTURNS.
//!
//! The tables are those of `crates/cdpr-sensitivity/examples/statistics`. Its rows of all measures, and the
//! values that count as true, are in `target/statistics`; `xtask/peers/statistics.py` reads the latter and
//! prints rows of the same form. It runs in an environment of its own, `target/peers/statistics`.

#![allow(clippy::print_stdout)]

use crate::cargo::{cargo_command, done, root};
use serde_json::Value;
use std::error::Error;
use std::path::PathBuf;
use std::process::{Command, ExitCode, Stdio};

/// What pip installs, of these versions.
const PACKAGES: [&str; 2] = ["SALib==1.6.0", "openturns==1.27"];
/// The measures that the others have as well.
const MEASURES: [&str; 9] = [
    "Sobol' S, 256",
    "Sobol' T, 256",
    "S by ranks",
    "Morris mu*",
    "expansion S",
    "expansion T",
    "delta, 256",
    "PAWN",
    "HSIC R2",
];

pub(crate) fn run(arguments: &[String]) -> ExitCode {
    let of_peers = arguments.first().is_some_and(|table| table == "peers");
    match if of_peers { peers(&arguments[1..]) } else { example(arguments) } {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Runs a table, and keeps it where it is whole: of all functions, with a number of studies.
fn example(arguments: &[String]) -> Result<(), Box<dyn Error>> {
    let example = ["run", "--release", "-p", "cdpr-sensitivity", "--example", "statistics", "--"];
    let mut command = cargo_command(&example);
    command.args(arguments).current_dir(root()).stderr(Stdio::inherit());
    let output = command.output()?;
    let text = String::from_utf8_lossy(&output.stdout);
    print!("{text}");
    if !output.status.success() {
        return Err(format!("the example has failed with {}", output.status).into());
    }
    match arguments {
        [table, _] => keep(table, &text),
        _ => Ok(()),
    }
}

/// Keeps a table for the book.
fn keep(table: &str, text: &str) -> Result<(), Box<dyn Error>> {
    Ok(std::fs::write(root().join("data/evidence/statistics").join(format!("{table}.md")), text)?)
}

/// Runs our studies and those of the others, one after the other on one thread, and prints a table. The
/// second argument is a part of the names of measures.
fn peers(arguments: &[String]) -> Result<(), Box<dyn Error>> {
    let studies = arguments.first().map_or("100", String::as_str);
    let part = arguments.get(1).map_or("", String::as_str);
    let python = environment("statistics", &PACKAGES)?;
    let example = ["run", "--release", "-p", "cdpr-sensitivity", "--example", "statistics", "--", "measures"];
    let mut ours = cargo_command(&example);
    ours.arg(studies).arg(format!("/{part}")).current_dir(root()).env("RAYON_NUM_THREADS", "1");
    done(&mut ours)?;
    let folder = root().join("target/statistics");
    let ours = std::fs::read_to_string(folder.join("measures.json"))?;
    let mut rows: Vec<Value> = serde_json::from_str(&ours)?;
    let mut command = Command::new(python);
    command
        .arg(root().join("xtask/peers/statistics.py"))
        .arg(folder.join("exact.json"))
        .arg(studies)
        .arg(part);
    for variable in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"] {
        command.env(variable, "1");
    }
    let output = command.stderr(Stdio::inherit()).output()?;
    if !output.status.success() {
        return Err("xtask/peers/statistics.py has failed".into());
    }
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        // SALib prints notices of its own.
        rows.extend(serde_json::from_str::<Value>(line));
    }
    let tables = tables(&rows);
    print!("{tables}");
    if part.is_empty() { keep("peers", &tables) } else { Ok(()) }
}

/// The Python of an environment in `target/peers` with these packages.
pub(crate) fn environment(name: &str, packages: &[&str]) -> Result<PathBuf, Box<dyn Error>> {
    let folder = root().join("target/peers").join(name);
    let place = if cfg!(windows) { "Scripts" } else { "bin" };
    let python = folder.join(place).join(format!("python{}", std::env::consts::EXE_SUFFIX));
    if !python.exists() {
        let system = if cfg!(windows) { "python" } else { "python3" };
        done(Command::new(system).args(["-m", "venv"]).arg(&folder))?;
    }
    done(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(packages))?;
    Ok(python)
}

/// A table for each measure, with a row for each function and a column for each program.
fn tables(rows: &[Value]) -> String {
    let mut tables = String::new();
    for measure in MEASURES {
        let rows: Vec<&Value> = rows.iter().filter(|row| row["measure"] == measure).collect();
        if rows.is_empty() {
            continue;
        }
        let of = |field: &str| {
            let mut values: Vec<&str> = Vec::new();
            for row in &rows {
                let value = text(row, field);
                if !values.contains(&value) {
                    values.push(value);
                }
            }
            values
        };
        let (functions, programs) = (of("function"), of("program"));
        tables += &format!("\n### {measure}\n\n| function | {} |\n", programs.join(" | "));
        tables += &format!("|---|{}\n", "---|".repeat(programs.len()));
        for function in functions {
            let of_program = |program: &&str| {
                rows.iter()
                    .find(|row| text(row, "function") == function && text(row, "program") == *program)
                    .map_or_else(|| "-".to_owned(), |row| cell(row))
            };
            let cells: Vec<String> = programs.iter().map(of_program).collect();
            tables += &format!("| {function} | {} |\n", cells.join(" | "));
        }
    }
    tables
}

/// Error, mean and least share of the intervals that hold, CPU time and number of studies of a row.
fn cell(row: &Value) -> String {
    if let Some(why) = row["why"].as_str() {
        return why.to_owned();
    }
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let held = row["held"]
        .as_array()
        .map_or_else(|| "-".to_owned(), |held| format!("{:.0} / {:.0}", number(&held[0]), number(&held[1])));
    format!("{:.4}; {held}; {:.2}; {}", number(&row["error"]), number(&row["ms"]), row["studies"])
}

fn text<'a>(row: &'a Value, field: &str) -> &'a str {
    row[field].as_str().unwrap_or_default()
}
