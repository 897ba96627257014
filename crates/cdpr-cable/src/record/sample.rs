//! Samples of a load-elongation test, and why samples or a question about them are refused.

/// Whether a cable is being loaded or unloaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The force grows.
    Loading,
    /// The force falls.
    Unloading,
}

impl Phase {
    /// `loading` or `unloading`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Loading => "loading",
            Self::Unloading => "unloading",
        }
    }
}

/// One sample of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Line of the file that it comes from, for messages.
    pub line: usize,
    /// Force [N].
    pub force: f64,
    /// Elongation [m].
    pub elongation: f64,
    /// Phase of the test.
    pub phase: Phase,
}

impl Sample {
    pub(super) fn invalid(&self, field: &'static str, value: impl ToString, expected: &str) -> RecordError {
        RecordError::Invalid {
            line: self.line,
            field,
            value: value.to_string(),
            expected: expected.to_owned(),
        }
    }
}

/// Why a record, or a question about it, was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RecordError {
    /// A value of the record is invalid.
    #[error("line {line}: {field} is {value}: expected {expected}")]
    Invalid {
        /// Line of the file.
        line: usize,
        /// Column of the file, or what follows from it.
        field: &'static str,
        /// What was given.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// A phase has too few samples.
    #[error(
        "the record ends at line {line} with {found} samples of phase {}: expected 2 at least",
        phase.name()
    )]
    TooShort {
        /// Last line of the record.
        line: usize,
        /// The phase.
        phase: Phase,
        /// Its samples.
        found: usize,
    },
    /// A setting of the analysis is invalid.
    #[error("{field} is {value}: expected {expected}")]
    Setting {
        /// The setting.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What would be right.
        expected: &'static str,
    },
    /// A range of load is not within the record.
    #[error(
        "the range {low} to {high} % of the breaking force is not in the record: \
         while {} it runs from {least:.3} to {greatest:.3} %",
        phase.name()
    )]
    OutOfRange {
        /// Lower end of the range [%].
        low: f64,
        /// Upper end [%].
        high: f64,
        /// The phase.
        phase: Phase,
        /// Least load of the record in this phase [%].
        least: f64,
        /// Greatest load [%].
        greatest: f64,
    },
}
