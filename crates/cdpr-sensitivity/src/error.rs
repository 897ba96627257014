//! What can be wrong with the data of a study: one small enum, each variant with the numbers a user needs.

use crate::law::family::Family;

/// Error of this crate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SensitivityError {
    /// A number is outside its domain.
    #[error("{field} = {value}: expected {expected}")]
    InvalidParameter {
        /// Name of the number.
        field: &'static str,
        /// Value found.
        value: f64,
        /// What was expected, in words.
        expected: &'static str,
    },
    /// An input of a design is not valid.
    #[error("input `{name}`: {source}")]
    InvalidInput {
        /// Name of the input.
        name: String,
        /// What is wrong with it.
        source: Box<SensitivityError>,
    },
    /// A count is outside its bounds.
    #[error("{field} = {value}: expected {minimum} to {maximum}")]
    OutOfRange {
        /// Name of the count.
        field: &'static str,
        /// Value found.
        value: u64,
        /// Smallest value allowed.
        minimum: u64,
        /// Largest value allowed.
        maximum: u64,
    },
    /// What a count asks for does not fit in memory.
    #[error("{field} = {value}: expected fewer, whose points fit in memory")]
    OutOfMemory {
        /// Name of the count.
        field: &'static str,
        /// Value found.
        value: u64,
    },
    /// Two lengths do not agree.
    #[error("{field}: length {value}, expected {expected}")]
    LengthMismatch {
        /// Name of the array.
        field: &'static str,
        /// Length found.
        value: usize,
        /// Length expected.
        expected: usize,
    },
    /// A value is infinite or not a number.
    #[error("{field}[{index}] = {value}: expected a finite number")]
    NotFinite {
        /// Name of the array.
        field: &'static str,
        /// Index of the value.
        index: usize,
        /// Value found.
        value: f64,
    },
    /// Equal-mass steps are asked of a law that is not uniform.
    #[error("steps `equal_mass` are defined for a uniform law only: use `nearest`")]
    EqualMassNeedsUniform,
    /// The first point of the unscrambled sequence is all zeros, where the law of this input is infinite.
    #[error(
        "input `{name}` is unbounded below: start at index 1 or scramble, point 0 of the sequence is all zeros"
    )]
    UnboundedAtZero {
        /// Name of the input.
        name: String,
    },
    /// All values of a sample are equal: no law of two parameters fits it, and no input has a share of its variance.
    #[error("all {count} values of the sample are {value}: expected at least two different ones")]
    ConstantSample {
        /// The only value.
        value: f64,
        /// How often it occurs.
        count: usize,
    },
    /// A law of positive numbers cannot fit this sample.
    #[error("{family:?} fits positive values only: the smallest one is {minimum}")]
    NotPositive {
        /// Family asked for.
        family: Family,
        /// Smallest value of the sample.
        minimum: f64,
    },
    /// The likelihood equations did not converge.
    #[error("{family:?}: no maximum of the likelihood after {iterations} iterations")]
    NotConverged {
        /// Family asked for.
        family: Family,
        /// Iterations made.
        iterations: usize,
    },
    /// One half of the range of an input holds no observation, so that it has no mean.
    #[error(
        "input `{input}`: {above} observations above the middle, {below} below: expected one at least of each"
    )]
    EmptyHalf {
        /// Name of the input.
        input: String,
        /// Observations above the middle.
        above: usize,
        /// Observations below the middle.
        below: usize,
    },
    /// Levels 0 and 1 are asked of an input whose law is infinite there.
    #[error("input `{name}` is unbounded: its levels 0 and 1 are infinite, use radial points")]
    UnboundedLevels {
        /// Name of the input.
        name: String,
    },
    /// A matrix is not one of correlations.
    #[error("correlation[{row}][{column}] = {value}: expected {expected}")]
    NotACorrelation {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// Value found; on the diagonal of a matrix that is not positive definite, the square of the pivot.
        value: f64,
        /// What was expected, in words.
        expected: &'static str,
    },
    /// The values of an input follow from those before it, so that they have no coefficients of their own.
    #[error("input `{input}`: its values are constant or a linear function of those of the inputs before it")]
    Collinear {
        /// Name of the input.
        input: String,
    },
    /// No input has this name.
    #[error("input `{name}`: no input of this name")]
    UnknownInput {
        /// Name asked for.
        name: String,
    },
    /// The designs of an interval are not independent replicates of one another.
    #[error("replicate {index}: {expected}")]
    NotAReplicate {
        /// Which replicate, from 0.
        index: usize,
        /// What was expected, in words.
        expected: &'static str,
    },
}

/// `Ok` when `valid`, else [`SensitivityError::InvalidParameter`].
pub(crate) fn require(
    valid: bool,
    field: &'static str,
    value: f64,
    expected: &'static str,
) -> Result<(), SensitivityError> {
    if valid { Ok(()) } else { Err(SensitivityError::InvalidParameter { field, value, expected }) }
}

/// `Ok` for a count within its bounds, else [`SensitivityError::OutOfRange`].
pub(crate) fn check_range(
    field: &'static str,
    value: u64,
    minimum: u64,
    maximum: u64,
) -> Result<(), SensitivityError> {
    if (minimum..=maximum).contains(&value) {
        Ok(())
    } else {
        Err(SensitivityError::OutOfRange { field, value, minimum, maximum })
    }
}

/// `Ok` for the length expected, else [`SensitivityError::LengthMismatch`].
pub(crate) fn check_length(
    field: &'static str,
    value: usize,
    expected: usize,
) -> Result<(), SensitivityError> {
    if value == expected { Ok(()) } else { Err(SensitivityError::LengthMismatch { field, value, expected }) }
}

/// `Ok` for a confidence level, else [`SensitivityError::InvalidParameter`].
pub(crate) fn check_level(level: f64) -> Result<(), SensitivityError> {
    require(level > 0.0 && level < 1.0, "level", level, "a number between 0 and 1")
}
