//! JSON text to data, with the place of what is wrong.

use serde::de::DeserializeOwned;

/// Where a JSON text is not what was expected: a missing, misspelt or mistyped field, or no JSON at all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}, column {column}: {field}: {message}")]
pub struct JsonError {
    /// Path of the field, such as `cables[2].exit_point`; `.` for the whole text.
    pub field: String,
    /// Line in the text, from 1.
    pub line: usize,
    /// Column in that line.
    pub column: usize,
    /// What was found and what was expected.
    pub message: String,
}

/// Reads a value from JSON text.
///
/// # Errors
/// [`JsonError`] with field, line and column.
pub fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, JsonError> {
    let deserializer = &mut serde_json::Deserializer::from_str(text);
    serde_path_to_error::deserialize(deserializer).map_err(|error| {
        let field = error.path().to_string();
        let inner = error.into_inner();
        // serde_json ends its message with the place, which is given apart.
        let message = inner.to_string();
        let message = message.split(" at line ").next().unwrap_or_default().to_owned();
        JsonError { field, line: inner.line(), column: inner.column(), message }
    })
}
