//! `cdpr report`: the report of a study, from its folder of results.

use crate::arguments::Format;
use crate::error::ProgramError;
use crate::output::patiently;
use cdpr_report::report;
use cdpr_study::{REPORT_NAME, Results, write_text};
use serde::Serialize;
use std::path::PathBuf;

/// The folder and the file.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Folder that `cdpr study run` has written.
    folder: PathBuf,
    /// File for the report; `report.html` in the folder if left out.
    #[arg(long)]
    out: Option<PathBuf>,
    /// How the path of the report is printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Written {
    report: String,
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let Settings { folder, out, format } = settings;
    let path = out.clone().unwrap_or_else(|| folder.join(REPORT_NAME));
    let text = patiently("drawing the report", || -> Result<String, ProgramError> {
        Ok(report(&Results::read(folder)?)?)
    })?;
    write_text(&path, &text)?;
    let text = |written: &Written| println!("report in {}", written.report);
    Ok(format.print(&Written { report: path.to_string_lossy().into_owned() }, text)?)
}
