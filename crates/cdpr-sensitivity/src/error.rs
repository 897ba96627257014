//! Errors of this crate: one small enum, whose variants carry the numbers that a user needs.

use crate::family::Family;

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
    #[error(
        "{field} = {value}: expected {}",
        if *maximum == u64::MAX { format!("at least {minimum}") } else { format!("{minimum} to {maximum}") }
    )]
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
    /// The points that a count asks for do not fit in memory.
    #[error("{field} = {value}: their points do not fit in memory, ask for fewer")]
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
    /// The squares of such values overflow, or vanish.
    #[error(
        "{field}[{index}] = {value:e} is the largest: expected values from 1e-150 to 1e150 in size; \
         choose another unit"
    )]
    Scale {
        /// Name of the array.
        field: &'static str,
        /// Index of the largest value.
        index: usize,
        /// The largest value in size.
        value: f64,
    },
    /// Steps of equal mass are combined with a law that is not uniform.
    #[error("steps `equal_mass` are defined for a uniform law only: use `nearest`")]
    EqualMassNeedsUniform,
    /// The first point of the unscrambled sequence is all zeros, where the law of this input is infinite.
    #[error(
        "input `{name}` is unbounded below, which point 0 of a sequence, all zeros, cannot draw: start at \
         index 1 or scramble"
    )]
    UnboundedAtZero {
        /// Name of the input.
        name: String,
    },
    /// The rows of a table depend on each other, as those of a sequence of low discrepancy do.
    #[error(
        "the rows depend on each other: {pattern}, most in columns {} and {}: expected random rows or a \
         Latin hypercube; rows of a sequence have estimators by design",
        input + 1, other + 1
    )]
    DependentRows {
        /// Index of an input.
        input: usize,
        /// Index of another one.
        other: usize,
        /// What shows it.
        pattern: RowPattern,
    },
    /// All values of a sample are equal. No law of two parameters fits such a sample, and its variance has no
    /// shares.
    #[error("all {count} values of the sample are {value}: expected at least two different values")]
    ConstantSample {
        /// The value that all have.
        value: f64,
        /// Number of values.
        count: usize,
    },
    /// The values of a sample repeat as those of no continuous law do.
    #[error(
        "{times} of {count} values are {value}, of {levels} different ones: no continuous law has such values"
    )]
    Discrete {
        /// The value that most have.
        value: f64,
        /// Number of values that are equal to it.
        times: usize,
        /// Number of values.
        count: usize,
        /// Number of different values.
        levels: usize,
    },
    /// A law of positive numbers cannot fit this sample.
    #[error("the {family} law fits positive values only, but the smallest value is {minimum}")]
    NotPositive {
        /// Family asked for.
        family: Family,
        /// Smallest value of the sample.
        minimum: f64,
    },
    /// The likelihood equations did not converge.
    #[error("the {family} law: no maximum of the likelihood was found in {iterations} steps")]
    NotConverged {
        /// Family asked for.
        family: Family,
        /// Iterations made.
        iterations: usize,
    },
    /// Bounds from derivatives and the law of an input, whose values have another variance.
    #[error(
        "input `{input}` has steps that change its variance: bounds from derivatives need one that changes \
         continuously"
    )]
    Stepped {
        /// Name of the input.
        input: String,
    },
    /// Observations failed, so that the inputs of the others no longer have their laws.
    #[error("{failed} of {count} observations failed: bounds from derivatives need all of them")]
    Failed {
        /// Observations that failed.
        failed: usize,
        /// All observations.
        count: usize,
    },
    /// Upper bounds of total shares that cannot be true.
    #[error(
        "the upper bounds of all total shares add up to {sum:.3e}, less than 1: the output jumps, or its \
         changes are rounding"
    )]
    Jumps {
        /// Their sum.
        sum: f64,
    },
    /// The eigenvalues of a matrix of mean products of slopes were not found. Slopes whose squares overflow
    /// have none.
    #[error("no eigenvalues of a matrix of {rows} rows were found: expected slopes whose squares are finite")]
    NoEigenvalues {
        /// Rows of the matrix.
        rows: usize,
    },
    /// One half of the range of an input holds no observation, so that its mean does not exist.
    #[error(
        "input `{input}`: {above} observations above the middle, {below} below: expected at least one each"
    )]
    EmptyHalf {
        /// Name of the input.
        input: String,
        /// Observations above the middle.
        above: usize,
        /// Observations below the middle.
        below: usize,
    },
    /// A matrix is not a correlation matrix.
    #[error("correlation[{row}][{column}] = {value}: expected {expected}")]
    NotACorrelation {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// Value found. For a matrix that is not positive definite, this is the square of the failing pivot.
        value: f64,
        /// What was expected, in words.
        expected: &'static str,
    },
    /// The values of an input follow linearly from those of the inputs before it, so that it has no
    /// coefficient.
    #[error("input `{input}`: its values are constant, or a linear function of the inputs before it")]
    Collinear {
        /// Name of the input.
        input: String,
    },
    /// No input has this name.
    #[error("input `{name}`: no input has this name")]
    UnknownInput {
        /// Name asked for.
        name: String,
    },
    /// A group of inputs does not fit the design.
    #[error("group `{name}`: expected {expected}")]
    WrongGroup {
        /// Name of the group.
        name: String,
        /// What was expected, in words.
        expected: &'static str,
    },
    /// The designs behind an interval are not independent replicates of each other.
    #[error("replicate {index}: expected {expected}")]
    NotAReplicate {
        /// Index of the replicate, from 0.
        index: usize,
        /// What was expected, in words.
        expected: &'static str,
    },
}

/// Returns [`SensitivityError::InvalidParameter`] unless `valid`.
pub(crate) fn require(
    valid: bool,
    field: &'static str,
    value: f64,
    expected: &'static str,
) -> Result<(), SensitivityError> {
    if valid { Ok(()) } else { Err(SensitivityError::InvalidParameter { field, value, expected }) }
}

/// Returns [`SensitivityError::OutOfRange`] for a count outside its bounds.
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

/// Returns [`SensitivityError::LengthMismatch`] for an unexpected length.
pub(crate) fn check_length(
    field: &'static str,
    value: usize,
    expected: usize,
) -> Result<(), SensitivityError> {
    if value == expected { Ok(()) } else { Err(SensitivityError::LengthMismatch { field, value, expected }) }
}

/// Returns [`SensitivityError::NotFinite`] for a value that is infinite or NaN.
pub(crate) fn check_finite(field: &'static str, index: usize, value: f64) -> Result<(), SensitivityError> {
    if value.is_finite() { Ok(()) } else { Err(SensitivityError::NotFinite { field, index, value }) }
}

/// Returns [`SensitivityError::InvalidParameter`] unless `level` is a confidence level, in (0, 1).
pub(crate) fn check_level(level: f64) -> Result<(), SensitivityError> {
    require(level > 0.0 && level < 1.0, "level", level, "a number between 0 and 1")
}

/// Checks that values are finite, and that the computer holds their squares.
pub(crate) fn check_values(
    field: &'static str,
    values: impl Iterator<Item = (usize, f64)>,
) -> Result<(), SensitivityError> {
    let mut largest = (0, 0.0_f64);
    for (index, value) in values {
        check_finite(field, index, value)?;
        if value.abs() > largest.1.abs() {
            largest = (index, value);
        }
    }
    let (index, value) = largest;
    let held = value == 0.0 || (1e-150..=1e150).contains(&value.abs());
    if held { Ok(()) } else { Err(SensitivityError::Scale { field, index, value }) }
}

/// How rows depend on each other.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RowPattern {
    /// Neighbours in the one input are ordered in the other.
    #[error("neighbours in one are ordered in another (z = {z:.1})")]
    Neighbours {
        /// How many standard deviations their product differs from that of independent rows.
        z: f64,
    },
    /// Rows have values of several inputs in common.
    #[error(
        "rows have inputs of others, as in designs of Saltelli (SALib), {:.0} % of two that share one",
        100.0 * share
    )]
    Shared {
        /// Share of further inputs that rows with the same value of one have in common.
        share: f64,
    },
    /// The rows fill the plane of the two inputs more evenly than independent ones.
    #[error("they fill a plane of two more evenly than by chance (z = {z:.1})")]
    Even {
        /// How many standard deviations the evenness differs from that of independent rows.
        z: f64,
    },
}
