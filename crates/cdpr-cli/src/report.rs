//! `cdpr report`: the report of a study from its results.

use cdpr_report::{ReportError, report};
use cdpr_study::{Results, StudyError, write_text};
use std::path::{Path, PathBuf};

/// What was asked for.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Folder that `cdpr study run` has written.
    folder: PathBuf,
    /// File for the report; `report.html` in the folder if left out.
    #[arg(long)]
    out: Option<PathBuf>,
}

#[derive(Debug, thiserror::Error)]
pub(crate) enum WriteError {
    #[error(transparent)]
    Study(#[from] StudyError),
    #[error(transparent)]
    Report(#[from] ReportError),
}

pub(crate) fn run(settings: &Settings) -> Result<(), WriteError> {
    let Settings { folder, out } = settings;
    let path = out.clone().unwrap_or_else(|| folder.join("report.html"));
    write(folder, &path)?;
    println!("report in {}", path.display());
    Ok(())
}

/// Writes the report of the results in `folder`.
pub(crate) fn write(folder: &Path, path: &Path) -> Result<(), WriteError> {
    Ok(write_text(path, &report(&Results::read(folder)?)?)?)
}
