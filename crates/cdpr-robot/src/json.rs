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

impl JsonError {
    fn new(field: String, error: &serde_json::Error) -> Self {
        // serde_json ends its message with the place, which is given apart.
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or_default().to_owned();
        Self { field, line: error.line(), column: error.column(), message }
    }
}

/// Reads a value from JSON text, all of it.
///
/// # Errors
/// [`JsonError`] with field, line and column.
pub fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, JsonError> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let field = error.path().to_string();
        JsonError::new(field, &error.into_inner())
    })?;
    // What follows the value is looked at, too: half a file may have been pasted behind another.
    deserializer.end().map_err(|error| JsonError::new(".".to_owned(), &error))?;
    Ok(value)
}
