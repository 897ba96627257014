//! Why there is no answer.

use cdpr_statics::StaticsError;
use cdpr_study::StudyError;
use serde::Serialize;

/// A failure: its kind, as in tables of results, and the reason with its numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Failure {
    pub(crate) kind: String,
    pub(crate) reason: String,
}

impl Failure {
    /// A text that cannot be read as a question.
    pub(crate) fn question(error: &serde_json::Error) -> Self {
        Self { kind: "invalid_question".to_owned(), reason: error.to_string() }
    }

    /// A field with a value that is not as expected.
    pub(crate) fn invalid(field: &str, value: impl ToString, expected: &str) -> Self {
        StaticsError::Invalid {
            field: field.to_owned(),
            value: value.to_string(),
            expected: expected.to_owned(),
        }
        .into()
    }
}

impl From<StaticsError> for Failure {
    fn from(error: StaticsError) -> Self {
        Self { kind: error.kind().to_owned(), reason: error.to_string() }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        Self { kind: "invalid_study".to_owned(), reason: error.to_string() }
    }
}
