//! What can go wrong with a study.

use cdpr_cable::RecordError;
use cdpr_robot::{JsonError, RobotError};
use cdpr_sensitivity::SensitivityError;
use cdpr_statics::StaticsError;
use std::path::PathBuf;

/// Why a study could not be read, run or written. A failed observation is none of these: it is a result.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A file could not be read.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file could not be written, or a folder not made.
    #[error("cannot write {path}: {source}")]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The text is no study file.
    #[error("{path}: {source}")]
    Format {
        /// The file.
        path: PathBuf,
        /// Place and reason.
        source: JsonError,
    },
    /// The robot file is none.
    #[error("{path}: {source}")]
    Robot {
        /// The file.
        path: PathBuf,
        /// Place and reason.
        source: RobotError,
    },
    /// The text is no load-elongation record.
    #[error("{path}: {source}")]
    Record {
        /// The file.
        path: PathBuf,
        /// Line and reason.
        source: RecordError,
    },
    /// A value that no study can have.
    #[error("{path}: {field} is {value}: expected {expected}")]
    Invalid {
        /// The file.
        path: PathBuf,
        /// Path of the field.
        field: String,
        /// What was given.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// The nominal robot cannot hold the study's pose or bear its load.
    #[error("{path}: {field} is {value}: expected a pose that the nominal robot can hold: {source}")]
    Nominal {
        /// The file.
        path: PathBuf,
        /// Path of the field.
        field: String,
        /// The position [m].
        value: String,
        /// The reason.
        source: Box<StaticsError>,
    },
    /// A law, its steps or a design that is none.
    #[error("{path}: {field}: {source}")]
    Statistics {
        /// The file.
        path: PathBuf,
        /// Path of the field.
        field: String,
        /// The reason.
        source: SensitivityError,
    },
    /// A setting that no test of robustness can have.
    #[error("{field} is {value}: expected {expected}")]
    Setting {
        /// The setting.
        field: String,
        /// What was given.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// A limit that no tightening of tolerances reaches.
    #[error("limit is {limit_mm} mm: expected one that tolerances reach, but {reason} ({reached_mm:.6} mm)")]
    Unreachable {
        /// The limit [mm].
        limit_mm: f64,
        /// Why it is out of reach.
        reason: &'static str,
        /// The error that is reached [mm].
        reached_mm: f64,
    },
    /// A quantile of an error that too many robots do not have.
    #[error("no equilibrium at the wanted pose for {what}: expected tolerances under which robots hold it{}", because(source.as_deref()))]
    Unobservable {
        /// The robots.
        what: String,
        /// The reason, of a single robot.
        source: Option<Box<StaticsError>>,
    },
    /// The robot holds hardly any pose of a region.
    #[error(
        "poses is {wanted}: expected at most as many as the robot holds, but of {drawn} poses drawn {found} are held in a stable \
         equilibrium, {infeasible} are infeasible and {unstable} unstable"
    )]
    TooFewPoses {
        /// Poses asked for.
        wanted: usize,
        /// Poses collected.
        found: usize,
        /// Poses drawn.
        drawn: usize,
        /// Those that the inverse model has no answer for.
        infeasible: usize,
        /// Those whose equilibrium the direct model does not stay at.
        unstable: usize,
    },
}

fn because(source: Option<&StaticsError>) -> String {
    source.map_or_else(String::new, |source| format!(": {source}"))
}

impl StudyError {
    pub(crate) fn setting(
        field: impl Into<String>,
        value: impl ToString,
        expected: impl Into<String>,
    ) -> Self {
        Self::Setting { field: field.into(), value: value.to_string(), expected: expected.into() }
    }
}
