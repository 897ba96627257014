//! Errors of calibrations.

use cdpr_robot::{JsonError, RobotError, shortened};
use cdpr_sensitivity::SensitivityError;
use cdpr_statics::StaticsError;
use cdpr_study::{StudyError, TableError};

/// Why a calibration could not be made.
#[derive(Debug, thiserror::Error)]
pub enum CalibrationError {
    /// The models have no answer.
    #[error(transparent)]
    Statics(#[from] StaticsError),
    /// A file could not be read or written.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The robot is invalid.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// An invalid law of a deviation.
    #[error(transparent)]
    Law(#[from] SensitivityError),
    /// The text is not JSON of this form.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// The text is no table, or a cell of it no number.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A row of the measurements to which the robot has no answer.
    #[error("line {line}: {source}")]
    Row {
        /// Its line in the file, or its number.
        line: usize,
        /// The reason.
        source: Box<StaticsError>,
    },
    /// A row without what it takes to find its pose and lengths.
    #[error("line {line}: {reason}")]
    Incomplete {
        /// Its line in the file, or its number.
        line: usize,
        /// What is missing.
        reason: String,
    },
    /// A cell of the table of measurements.
    #[error("line {line}, column {column}: {}: expected {expected}", shortened(value))]
    Cell {
        /// Line in the file.
        line: usize,
        /// Name of the column.
        column: String,
        /// What stands there.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// A column of the table of measurements.
    #[error("column {column}: expected {expected}")]
    Column {
        /// Its name.
        column: String,
        /// What would be right.
        expected: String,
    },
    /// Fewer measurements than unknowns without prior.
    #[error(
        "{measurements} measurements for {unknowns} unknowns, {nuisances} of them lengths of single rows: \
         expected as many at least; measure more poses, give the unknowns a prior, or seek fewer"
    )]
    TooFew {
        /// Numbers measured.
        measurements: usize,
        /// Unknowns without prior, those of single rows included.
        unknowns: usize,
        /// Unknowns of single rows.
        nuisances: usize,
    },
    /// No row measures more than it has unknowns of its own.
    #[error(
        "each row measures {measured} numbers at most, exact lengths left out, for {unknown} unknown lengths \
         of its own: more poses of this kind cannot help; expected tensions or the pose in each row, too"
    )]
    NoSurplus {
        /// Numbers measured in a row.
        measured: usize,
        /// Unknown lengths of a row.
        unknown: usize,
    },
    /// An invalid setting.
    #[error("{field} is {value}: expected {expected}")]
    Invalid {
        /// The setting.
        field: String,
        /// What was given.
        value: String,
        /// What would be right.
        expected: String,
    },
}

impl CalibrationError {
    pub(crate) fn invalid(
        field: impl Into<String>,
        value: impl ToString,
        expected: impl Into<String>,
    ) -> Self {
        Self::Invalid { field: field.into(), value: shortened(&value.to_string()), expected: expected.into() }
    }

    pub(crate) fn row(line: usize) -> impl Fn(StaticsError) -> Self {
        move |source| Self::Row { line, source: Box::new(source) }
    }

    /// Name of the kind of failure, for counting, as [`StaticsError::kind`].
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Statics(source) => source.kind(),
            Self::Row { source, .. } => source.kind(),
            Self::Invalid { .. } => "invalid_input",
            _ => "measurements",
        }
    }
}
