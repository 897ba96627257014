//! `cdpr report`: the report of a study from its results.

use crate::arguments::Format;
use cdpr_report::{ReportError, report};
use cdpr_study::{Results, StudyError, write_text};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// What was asked for.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Folder that `cdpr study run` has written.
    folder: PathBuf,
    /// File for the report; `report.html` in the folder if left out.
    #[arg(long)]
    out: Option<PathBuf>,
    /// How the place of the report is printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Written {
    report: PathBuf,
}

#[derive(Debug, thiserror::Error)]
pub(crate) enum WriteError {
    #[error(transparent)]
    Study(#[from] StudyError),
    #[error(transparent)]
    Report(#[from] ReportError),
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
}

pub(crate) fn run(settings: &Settings) -> Result<(), WriteError> {
    let Settings { folder, out, format } = settings;
    let path = out.clone().unwrap_or_else(|| folder.join("report.html"));
    write(folder, &path)?;
    let text = |written: &Written| println!("report in {}", written.report.display());
    Ok(format.print(&Written { report: path }, text)?)
}

/// Writes the report of the results in `folder`.
pub(crate) fn write(folder: &Path, path: &Path) -> Result<(), WriteError> {
    Ok(write_text(path, &report(&Results::read(folder)?)?)?)
}
