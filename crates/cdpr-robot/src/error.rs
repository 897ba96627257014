//! Why a robot, its file or its parameters are refused.

use crate::json::{JsonError, numbered, place_of};
use cdpr_cable::shortened;

/// Why a robot, its file or its parameters were refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RobotError {
    /// The text is not a robot file.
    #[error(transparent)]
    Format(#[from] JsonError),
    /// A value is invalid.
    #[error("{} is {value}: expected {expected}", numbered(field))]
    Invalid {
        /// Path of the field, such as `cables[2].exit_point[0]`.
        field: String,
        /// The value given.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// A value of a robot file is invalid: the same with line and column.
    #[error("{source} (line {line}, column {column})")]
    At {
        /// Line in the file, from 1.
        line: usize,
        /// Column in that line.
        column: usize,
        /// What is wrong there.
        source: Box<RobotError>,
    },
    /// The robot has no parameter of this name.
    #[error("no parameter is named `{name}`: expected one of {expected}")]
    UnknownParameter {
        /// The name given.
        name: String,
        /// The names that exist.
        expected: String,
    },
    /// The deviations of a robot are not one for each of its parameters.
    #[error("{given} deviations for a robot with {parameters} parameters: expected one for each of them")]
    DeviationCount {
        /// Deviations given for a robot.
        given: usize,
        /// Parameters of the robot.
        parameters: usize,
    },
    /// A table of deviations ends within a row.
    #[error("{given} deviations in all: expected whole rows of {parameters}, one for each parameter")]
    DeviationRows {
        /// Deviations given, of all rows together.
        given: usize,
        /// Parameters of the robot.
        parameters: usize,
    },
    /// A table of deviations is one for robots with other parameters.
    #[error("column {} of the deviations is {given}: expected {expected}, as the robot has it", index + 1)]
    OtherParameter {
        /// Index of the first column that differs, from 0.
        index: usize,
        /// Parameter that the table has there.
        given: String,
        /// Parameter that the robot has there.
        expected: String,
    },
}

impl RobotError {
    pub(crate) fn invalid(
        field: impl Into<String>,
        value: impl ToString,
        expected: impl Into<String>,
    ) -> Self {
        Self::Invalid { field: field.into(), value: shortened(&value.to_string()), expected: expected.into() }
    }

    /// Adds line and column of the field, if the text contains it.
    pub(crate) fn placed(self, text: &str) -> Self {
        let position = match &self {
            Self::Invalid { field, .. } => place_of(text, field),
            _ => None,
        };
        match position {
            Some((line, column)) => Self::At { line, column, source: Box::new(self) },
            None => self,
        }
    }
}
