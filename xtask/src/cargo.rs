//! Cargo and the program, in this workspace.

use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// The folder of the workspace.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// Builds and runs the program.
///
/// Cargo chooses it among all default members, so that its dependencies have the features that tests need.
pub(crate) fn cdpr(command: &[&str], rest: &[String]) -> Result<(), String> {
    let rest: Vec<&str> = rest.iter().map(String::as_str).collect();
    cargo(&[&["run", "--bin", "cdpr", "--"], command, &rest].concat())
}

/// Returns the same command, without the messages of cargo, for the caller to start.
pub(crate) fn cdpr_command(command: &[&str]) -> Command {
    cargo_command(&[&["run", "--quiet", "--bin", "cdpr", "--"], command].concat())
}

/// An example with its arguments, without the messages of cargo, for the caller to start.
///
/// As in [`cdpr`], no package is named: everything would be compiled again with the features of that package
/// alone.
pub(crate) fn example_command(example: &str, arguments: &[&str]) -> Command {
    cargo_command(&[&["run", "--quiet", "--example", example, "--"], arguments].concat())
}

/// Runs cargo with a subcommand and its arguments, and fails where it does.
pub(crate) fn cargo(arguments: &[&str]) -> Result<(), String> {
    match cargo_command(arguments).status() {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(format!("`cargo {}` has failed", arguments.join(" "))),
        Err(error) => Err(format!("cannot start cargo: {error}")),
    }
}

/// Cargo with a subcommand and its arguments, in this workspace.
pub(crate) fn cargo_command(arguments: &[&str]) -> Command {
    let (subcommand, rest) = arguments.split_at(1);
    let mut command = Command::new(std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()));
    command.args(subcommand).arg("--manifest-path").arg(root().join("Cargo.toml")).args(rest);
    command
}

/// Runs a command, and fails where it does.
pub(crate) fn done(command: &mut Command) -> Result<(), Box<dyn std::error::Error>> {
    let program = command.get_program().display().to_string();
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{program}` has failed with {status}").into()),
        Err(error) => Err(format!("`{program}` cannot be started ({error}): install it").into()),
    }
}

/// What a command answers as JSON, with one of these exit codes.
pub(crate) fn answer(arguments: &[&str], codes: &[i32]) -> Result<Value, String> {
    parsed(&output(&[arguments, &["--format", "json"]].concat(), codes)?)
}

/// Standard output of the program where it ends with one of these exit codes.
pub(crate) fn output(arguments: &[&str], codes: &[i32]) -> Result<String, String> {
    text_of(&mut cdpr_command(arguments), codes)
}

/// Standard output of a program that succeeds, without the white space around it.
pub(crate) fn printed(program: &str, arguments: &[&str]) -> Result<String, String> {
    text_of(Command::new(program).args(arguments), &[0]).map(|text| text.trim().to_owned())
}

/// Standard output of a command that ends with one of these exit codes.
pub(crate) fn text_of(command: &mut Command, codes: &[i32]) -> Result<String, String> {
    let program = command.get_program().display().to_string();
    let output = command.output().map_err(|error| format!("cannot start {program}: {error}"))?;
    if !output.status.code().is_some_and(|code| codes.contains(&code)) {
        return Err(format!("{program}: {}", String::from_utf8_lossy(&output.stderr)));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// A file as text.
pub(crate) fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}

/// A file as JSON.
pub(crate) fn read_json(path: &Path) -> Result<Value, String> {
    parsed(&read(path)?).map_err(|error| format!("{}: {error}", path.display()))
}

/// A text as JSON.
pub(crate) fn parsed(text: &str) -> Result<Value, String> {
    serde_json::from_str(text).map_err(|error| error.to_string())
}

/// Writes a file.
pub(crate) fn write(path: &Path, text: &str) -> Result<(), String> {
    std::fs::write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

/// A number of JSON; NaN where the value is not a number.
pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}
