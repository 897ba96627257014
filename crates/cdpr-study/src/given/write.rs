//! The files of an analysis.

use crate::error::StudyError;
use crate::fs::manifest::ResultsOf;
use crate::fs::owned::ResultsFolder;
use crate::given::analyse::TableAnalysis;
use crate::names::REPORT_NAME;
use std::path::Path;

/// The whole analysis.
const ANALYSIS_NAME: &str = "analysis.json";

/// Writes `analysis.json` and `report.html` into a folder, which is made if missing.
///
/// # Errors
/// As [`ResultsFolder::begin`] and [`ResultsFolder::conclude`].
pub fn write_analysis(folder: &Path, found: &TableAnalysis, page: &str) -> Result<(), StudyError> {
    let names = [ANALYSIS_NAME, REPORT_NAME];
    let folder = ResultsFolder::begin(folder, ResultsOf::Analysis, |name| names.contains(&name))?;
    folder.write(REPORT_NAME, page.as_bytes())?;
    folder.conclude(ANALYSIS_NAME, found, &[REPORT_NAME]).map(|_| ())
}
