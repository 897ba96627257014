//! `cdpr study report`: the report of a study, from its folder of results.

use crate::program::arguments::endings;
use crate::program::arguments::{FigureArgument, Format, Overwrite, figure, write_figures};
use crate::program::error::ProgramError;
use crate::program::output::patiently;
use cdpr_assess::read_region;
use cdpr_report::{Sheet, figures, report_with};
use cdpr_study::Results;
use serde_json::{Value, json};
use std::path::PathBuf;

/// The folder and the file.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Folder that `cdpr study run` has written.
    folder: PathBuf,
    /// Folder that `cdpr workspace --with boundary` has written for the robot: its region is drawn around the
    /// robot.
    workspace: Option<PathBuf>,
    /// File for the report; `report.html` in the folder if left out.
    #[arg(short, long, value_parser = endings::html())]
    out: Option<PathBuf>,
    /// A figure of the results instead, with the name that it has in the folder; behind its name: width=MM,
    /// untitled. It can be given several times.
    #[arg(long, value_name = "NAME.pdf", value_parser = figure, conflicts_with_all = ["out", "workspace"])]
    figure: Vec<FigureArgument>,
    #[command(flatten)]
    overwrite: Overwrite,
    /// How the path of the report is printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(super) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let Settings { folder, out, figure, overwrite, workspace, format } = settings;
    if !figure.is_empty() {
        let results = Results::read(folder)?;
        let drawn = |sheet: Sheet| {
            let all = figures(&results, sheet).into_iter();
            all.filter_map(|figure| Some((figure.name, figure.svg.ok()?))).collect()
        };
        write_figures(figure, drawn, overwrite)?;
        let figures: Vec<_> = figure.iter().map(|figure| figure.path.to_string_lossy()).collect();
        let text = |_: &Value| figures.iter().for_each(|figure| println!("figure in {figure}"));
        return Ok(format.print(&json!({ "figures": figures }), text)?);
    }
    let (results, page) = patiently("drawing the report", || -> Result<_, ProgramError> {
        let results = Results::read(folder)?;
        let region = workspace.as_deref().map(read_region).transpose()?;
        let page = report_with(&results, &figures(&results, Sheet::SCREEN), region.as_ref())?;
        Ok((results, page))
    })?;
    let path = match out {
        Some(path) => {
            overwrite.write(path, &page)?;
            path.clone()
        }
        None => results.write_report(folder, &page)?,
    };
    let path = path.to_string_lossy();
    Ok(format.print(&json!({ "report": path }), |_| println!("report in {path}"))?)
}
