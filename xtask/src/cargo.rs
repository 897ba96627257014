//! Cargo and the program, in this workspace.

use serde_json::Value;
use sha2::{Digest, Sha256};
use std::error::Error;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What a task returns: nothing, or why it has failed.
pub(crate) type Outcome<T = ()> = Result<T, Box<dyn Error>>;

/// The folder of the workspace.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// The folder of what cargo builds.
pub(crate) fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

/// Builds the program and runs a study into a folder, with further options of `cdpr study run`.
///
/// Cargo chooses the program among all default members, so that its dependencies have the features that tests
/// need.
pub(crate) fn study(file: &Path, out: &Path, options: &[String]) -> Outcome {
    let mut run = cargo_command(&["run", "--bin", "cdpr", "--", "study", "run"]);
    done(run.arg(file).arg("--out").arg(out).args(options))
}

/// The program with its arguments, without the messages of cargo, for the caller to start.
pub(crate) fn cdpr_command(command: &[&str]) -> Command {
    cargo_command(&[&["run", "--quiet", "--bin", "cdpr", "--"], command].concat())
}

/// An example in the profile of what is installed, with its arguments.
pub(crate) fn release_example(package: &str, example: &str, arguments: &[String]) -> Command {
    let run = ["run", "--release", "--quiet", "--package", package, "--example", example, "--"];
    let mut command = cargo_command(&run);
    command.args(arguments);
    command
}

/// Cargo with a subcommand and its arguments, in this workspace.
pub(crate) fn cargo_command(arguments: &[&str]) -> Command {
    let (subcommand, rest) = arguments.split_at(1);
    let mut command = Command::new(std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()));
    command.args(subcommand).arg("--manifest-path").arg(root().join("Cargo.toml")).args(rest);
    command
}

/// Runs a command, and fails where it does.
pub(crate) fn done(command: &mut Command) -> Outcome {
    let program = command.get_program().display().to_string();
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{program}` has failed with {status}").into()),
        Err(error) => Err(format!("`{program}` cannot be started ({error}): install it").into()),
    }
}

/// What a command of the program answers as JSON, with one of these exit codes.
pub(crate) fn answer(arguments: &[&str], codes: &[i32]) -> Outcome<Value> {
    let text = text_of(cdpr_command(arguments).args(["--format", "json"]), codes)?;
    Ok(serde_json::from_str(&text)?)
}

/// Standard output of a program that succeeds, without the white space around it.
pub(crate) fn printed(program: impl AsRef<OsStr>, arguments: &[&str]) -> Outcome<String> {
    Ok(text_of(Command::new(program).args(arguments), &[0])?.trim().to_owned())
}

/// Standard output of a command that ends with one of these exit codes.
pub(crate) fn text_of(command: &mut Command, codes: &[i32]) -> Outcome<String> {
    let program = command.get_program().display().to_string();
    let output = command.output().map_err(|error| format!("cannot start {program}: {error}"))?;
    if !output.status.code().is_some_and(|code| codes.contains(&code)) {
        return Err(format!("{program}: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// The date, the processor, the compiler and the commit: what figures depend on.
pub(crate) fn machine() -> String {
    let known = |program: &str, arguments: &[&str]| {
        printed(program, arguments).unwrap_or_else(|error| error.to_string())
    };
    let cpu = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let cpu = cpu.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let cpu = cpu.map_or(std::env::consts::ARCH, |(_, name)| name);
    let cores = std::thread::available_parallelism().map_or(0, usize::from);
    let [date, compiler] = [known("date", &["-u", "+%F"]), known("rustc", &["--version"])];
    let commit = known("git", &["-C", &root().to_string_lossy(), "describe", "--always", "--dirty"]);
    format!("{date}, {cpu}, {cores} cores, {compiler}, commit {commit}")
}

/// Processes that wanted to run during the last minute.
pub(crate) fn load() -> String {
    let file = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    file.split(' ').next().filter(|load| !load.is_empty()).unwrap_or("unknown").to_owned()
}

/// An error with the path that it is about.
fn at<T>(path: &Path, result: std::io::Result<T>) -> Outcome<T> {
    result.map_err(|error| format!("{}: {error}", path.display()).into())
}

/// A file as text.
pub(crate) fn read(path: &Path) -> Outcome<String> {
    at(path, fs::read_to_string(path))
}

/// A file as JSON.
pub(crate) fn read_json(path: &Path) -> Outcome<Value> {
    serde_json::from_str(&read(path)?).map_err(|error| format!("{}: {error}", path.display()).into())
}

/// Writes a file, and makes its folder.
pub(crate) fn write(path: &Path, text: &str) -> Outcome {
    path.parent().map_or(Ok(()), made)?;
    at(path, fs::write(path, text))
}

/// Makes a folder, and those that it is in.
pub(crate) fn made(folder: &Path) -> Outcome {
    at(folder, fs::create_dir_all(folder))
}

/// Makes a folder with nothing in it.
pub(crate) fn emptied(folder: &Path) -> Outcome {
    if folder.exists() {
        at(folder, fs::remove_dir_all(folder))?;
    }
    made(folder)
}

/// All files in a folder and in the folders in it, sorted; without those folders that have one of these
/// names. A file is itself.
pub(crate) fn files(path: &Path, without: &[&str]) -> Outcome<Vec<PathBuf>> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let mut found = Vec::new();
    for entry in at(path, fs::read_dir(path))? {
        let entry = entry?;
        if !without.iter().any(|name| entry.file_name() == *name) {
            found.extend(files(&entry.path(), without)?);
        }
    }
    found.sort();
    Ok(found)
}

/// The checksum SHA-256 in hexadecimal digits.
pub(crate) fn checksum(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A number of JSON; NaN where the value is not a number.
pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// A text of JSON; empty where the value is not a text.
pub(crate) fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}
