//! Errors of figures and reports.

use cdpr_robot::shortened;

/// Reason why a figure or a report cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReportError {
    /// The results hold nothing to draw.
    #[error("nothing to draw: {what}")]
    Empty {
        /// What is missing.
        what: &'static str,
    },
    /// A value cannot be drawn.
    #[error("{field} is {value}: expected {expected}")]
    Invalid {
        /// Path of the field.
        field: String,
        /// Value found.
        value: String,
        /// What was expected, in words.
        expected: &'static str,
    },
    /// The drawing library failed.
    #[error("cannot draw: {reason}")]
    Drawing {
        /// Its message.
        reason: String,
    },
}

impl ReportError {
    pub(crate) fn invalid(field: impl Into<String>, value: &impl ToString, expected: &'static str) -> Self {
        Self::Invalid { field: field.into(), value: shortened(&value.to_string()), expected }
    }

    /// Returns `value` if it is finite. No other value can be drawn.
    pub(crate) fn finite(field: &str, value: f64) -> Result<f64, Self> {
        if value.is_finite() { Ok(value) } else { Err(Self::invalid(field, &value, "a finite number")) }
    }
}
