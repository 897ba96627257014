//! Errors of figures.

/// Why there is no figure.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReportError {
    /// There is nothing to draw.
    #[error("nothing to draw: {what}")]
    Empty {
        /// What is missing.
        what: &'static str,
    },
    /// A value that has no place in the figure.
    #[error("{field} is {value}: expected {expected}")]
    Invalid {
        /// Path of the field.
        field: String,
        /// What was given.
        value: String,
        /// What is expected.
        expected: &'static str,
    },
    /// The drawing library failed.
    #[error("cannot draw: {reason}")]
    Drawing {
        /// Message of the drawing library.
        reason: String,
    },
}

impl ReportError {
    pub(crate) fn invalid(field: impl Into<String>, value: &impl ToString, expected: &'static str) -> Self {
        Self::Invalid { field: field.into(), value: value.to_string(), expected }
    }

    /// `value` if it is finite; no other value has a position on an axis.
    pub(crate) fn finite(field: &str, value: f64) -> Result<f64, Self> {
        if value.is_finite() { Ok(value) } else { Err(Self::invalid(field, &value, "a finite number")) }
    }
}
