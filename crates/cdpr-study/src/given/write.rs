//! The files of an analysis.

use crate::error::StudyError;
use crate::fs::manifest::ResultsOf;
use crate::fs::owned::ResultsFolder;
use crate::fs::single::IfExists;
use crate::given::analyse::TableAnalysis;
use crate::names::REPORT_NAME;
use std::path::Path;

/// The whole analysis.
const ANALYSIS_NAME: &str = "analysis.json";

/// Makes a folder for an analysis, or takes one of an earlier analysis: before anything is computed.
///
/// # Errors
/// As [`ResultsFolder::begin`].
pub fn begin_analysis(folder: &Path, if_exists: IfExists) -> Result<ResultsFolder, StudyError> {
    let names = [ANALYSIS_NAME, REPORT_NAME];
    ResultsFolder::begin(folder, ResultsOf::Analysis, if_exists, |name| names.contains(&name))
}

/// Writes `report.html` and, last of all, `analysis.json`.
///
/// # Errors
/// As [`ResultsFolder::conclude`].
pub fn write_analysis(folder: &ResultsFolder, found: &TableAnalysis, page: &str) -> Result<(), StudyError> {
    folder.write(REPORT_NAME, page.as_bytes())?;
    folder.conclude(ANALYSIS_NAME, found, &[REPORT_NAME]).map(|_| ())
}
