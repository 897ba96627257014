//! What the program answers, for the tasks that use it.

use crate::cargo::cdpr_command;
use serde_json::Value;
use std::path::Path;

/// What a command answers as JSON, with one of these exit codes.
pub(crate) fn answer(arguments: &[&str], codes: &[i32]) -> Result<Value, String> {
    parsed(&output(&[arguments, &["--format", "json"]].concat(), codes)?)
}

/// Standard output of a command that ends with one of these exit codes.
pub(crate) fn output(arguments: &[&str], codes: &[i32]) -> Result<String, String> {
    let output = cdpr_command(arguments).output().map_err(|error| format!("cannot start cargo: {error}"))?;
    if !output.status.code().is_some_and(|code| codes.contains(&code)) {
        return Err(format!("cdpr {}: {}", arguments.join(" "), String::from_utf8_lossy(&output.stderr)));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
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
