//! The folder of a study's results, complete by itself: beside tables, figures and `summary.json` it holds the study as it was run
//! (`study.json`), the robot (`robot.json`) and how long it took (`timings.json`, apart from the summary, which is the same from run
//! to run).

use crate::atomic::{write_atomic, write_json};
use crate::error::StudyError;
use crate::study::Study;
use indexmap::IndexMap;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Name of the study file in a folder of results.
pub const STUDY_NAME: &str = "study.json";

/// Name of the robot file in a folder of results.
pub const ROBOT_NAME: &str = "robot.json";

/// Wall times of a run; `timings.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Timings {
    /// Threads.
    pub threads: usize,
    /// Seconds by name of sampling or surface.
    pub seconds: IndexMap<String, f64>,
    /// Seconds by sampling and method of its measures of sensitivity.
    #[serde(skip_serializing_if = "IndexMap::is_empty")]
    pub sensitivity: IndexMap<String, IndexMap<String, f64>>,
    /// Seconds of all.
    pub all: f64,
}

/// Writes the study and its robot into a folder of results: [`Study::open`] reads them there.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_study(folder: &Path, study: &Study) -> Result<(), StudyError> {
    write_atomic(folder.join(ROBOT_NAME), (study.robot.to_json() + "\n").as_bytes())?;
    let mut file = study.file.clone();
    file.robot = ROBOT_NAME.to_owned();
    write_json(folder.join(STUDY_NAME), &file)?;
    Ok(())
}

/// Writes `timings.json`.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_timings(folder: &Path, timings: &Timings) -> Result<PathBuf, StudyError> {
    write_json(folder.join("timings.json"), timings)
}
