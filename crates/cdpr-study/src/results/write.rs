//! Result files: observations as CSV, the summary as JSON.

use crate::analysis::keys::To;
use crate::analysis::summary::Summary;
use crate::analysis::surface::SurfaceResult;
use crate::error::StudyError;
use crate::file::output::Output;
use crate::fs::finite::FiniteCells;
use crate::fs::owned::ResultsFolder;
use crate::model::study::Surface;
use crate::names::{REPORT_NAME, ROBOT_NAME, STUDY_NAME, SUMMARY_NAME, TIMINGS_NAME};
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Writes `NAME.csv`: one row a grid point, with the values of both parameters (in SI units), output and
/// status.
///
/// # Errors
/// As [`ResultsFolder::claim`].
pub fn write_surface(
    folder: &ResultsFolder,
    surface: &Surface,
    result: &SurfaceResult,
) -> Result<PathBuf, StudyError> {
    let header = vec![
        surface.x.parameter.to_string(),
        surface.y.parameter.to_string(),
        surface.output.name().to_owned(),
        "status".to_owned(),
    ];
    let columns = result.y.len();
    let rows = result.values.iter().enumerate().map(|(k, value)| {
        let (value, status) = match value {
            Ok(value) => (value.to_string(), "ok"),
            Err(error) => (String::new(), error.kind()),
        };
        vec![result.x[k / columns].to_string(), result.y[k % columns].to_string(), value, status.to_owned()]
    });
    folder.write_csv(&format!("{}.csv", surface.name), header, rows)
}

/// Writes a table whose header has the names of an output.
///
/// # Errors
/// As [`ResultsFolder::claim`].
pub(crate) fn write_named<T: Serialize>(
    folder: &ResultsFolder,
    name: &str,
    output: Output,
    rows: &[T],
) -> Result<PathBuf, StudyError> {
    let unwritten = |source| StudyError::Write { path: folder.path().join(name), source };
    let mut table = csv::Writer::from_writer(FiniteCells::new(Vec::new()));
    rows.iter().try_for_each(|row| table.serialize(row)).map_err(|error| unwritten(error.into()))?;
    let cells = table.into_inner().map_err(|error| unwritten(error.into_error()))?;
    let text = cells.into_inner().map_err(unwritten)?;
    let text = String::from_utf8(text).map_err(|error| unwritten(std::io::Error::other(error)))?;
    folder.write(name, To::File.table(output, &text).as_bytes())
}

/// Writes `summary.json`, after all else that belongs to it ([`ResultsFolder::conclude`]).
///
/// # Errors
/// As [`ResultsFolder::conclude`].
pub fn write_summary(folder: &ResultsFolder, summary: &Summary) -> Result<PathBuf, StudyError> {
    folder.conclude(SUMMARY_NAME, summary, &[ROBOT_NAME, STUDY_NAME, TIMINGS_NAME, REPORT_NAME])
}

/// Writes the figure `NAME.svg`.
///
/// # Errors
/// As [`ResultsFolder::claim`].
pub fn write_figure(folder: &ResultsFolder, name: &str, svg: &str) -> Result<PathBuf, StudyError> {
    folder.write(&format!("{name}.svg"), svg.as_bytes())
}

/// Wall times of a run; `timings.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Timings {
    /// Threads.
    pub threads: usize,
    /// Seconds by name of sampling or surface.
    pub seconds: IndexMap<String, f64>,
    /// Seconds by sampling and method of its measures of sensitivity.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub sensitivity: IndexMap<String, IndexMap<String, f64>>,
    /// Seconds of all.
    pub all: f64,
}

/// Writes `timings.json`.
///
/// # Errors
/// As [`ResultsFolder::claim`].
pub fn write_timings(folder: &ResultsFolder, timings: &Timings) -> Result<PathBuf, StudyError> {
    folder.write_json(TIMINGS_NAME, timings)
}
