//! What can be wrong with a robot.

use crate::json::JsonError;

/// Why a robot, its file or its parameters were refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RobotError {
    /// The text is not a robot file.
    #[error(transparent)]
    Format(#[from] JsonError),
    /// A value that no such robot can have.
    #[error("{field} is {value}: expected {expected}")]
    Invalid {
        /// Path of the field, such as `cables[2].exit_point[0]`.
        field: String,
        /// The value given.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// A parameter name that this robot does not have.
    #[error("no parameter is named `{name}`: expected one of {expected}")]
    UnknownParameter {
        /// The name given.
        name: String,
        /// The names there are.
        expected: String,
    },
    /// A perturbation of another length than the parameter vector.
    #[error("{given} deviations for {parameters} parameters")]
    DeviationCount {
        /// Deviations given.
        given: usize,
        /// Parameters of the robot.
        parameters: usize,
    },
}

impl RobotError {
    pub(crate) fn invalid(
        field: impl Into<String>,
        value: impl ToString,
        expected: impl Into<String>,
    ) -> Self {
        Self::Invalid { field: field.into(), value: value.to_string(), expected: expected.into() }
    }
}
