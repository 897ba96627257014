//! `cdpr explore`: a robot that computes in the browser, as one HTML file.

use crate::program::arguments::endings;
use crate::program::arguments::{Format, Overwrite, With, named_after, with};
use crate::program::error::ProgramError;
use crate::program::output::patiently;
use crate::program::questions;
use cdpr_report::{Explored, explored_study, explorer};
use cdpr_robot::Robot;
use cdpr_study::{InputKind, ROBOT_NAME, Results, Study, StudyError};
use serde_json::json;
use std::path::{Path, PathBuf};

/// What is explored, and the file.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Robot, a file or a name of `cdpr robot list`, study file, or folder of results.
    #[arg(value_name = "ROBOT|STUDY|RESULTS", default_value = "caroca")]
    input: PathBuf,
    /// File for the page; NAME-explorer.html in the current folder if left out.
    #[arg(short, long, value_name = "FILE", value_parser = endings::html())]
    out: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    /// open: the page in the browser.
    #[arg(long, value_name = "NAME", value_parser = with)]
    with: Option<With>,
    /// How the path of the page is printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// A robot, its file, and the study of it that comes first.
struct Input {
    robot: Robot,
    file: PathBuf,
    study: Option<Study>,
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let Settings { input, out, overwrite, with, format } = settings;
    let opens =
        with.as_ref().map_or(Ok(false), |with| with.check(&["open"]).and_then(|()| with.has("open")))?;
    let Input { robot, file, study } = patiently("reading the robot", || read(input))?;
    let explored = Explored {
        name: &robot.name,
        file: &file.to_string_lossy(),
        robot: &robot.to_json(),
        study: study.as_ref().and_then(explored_study),
    };
    let page = explorer(&explored, env!("CARGO_PKG_VERSION"))?;
    let path = out.clone().unwrap_or_else(|| named_after(input, "explorer.html"));
    overwrite.write(&path, &page)?;
    if opens {
        open::that(&path)
            .map_err(|error| ProgramError::Browser { path: path.clone(), reason: error.to_string() })?;
    }
    let path = path.to_string_lossy();
    Ok(format.print(&json!({ "explorer": path }), |_| println!("explorer in {path}"))?)
}

fn read(path: &Path) -> Result<Input, ProgramError> {
    let of_study = |study: Study, file| Input { robot: study.robot.clone(), file, study: Some(study) };
    if path.is_dir() {
        return Ok(of_study(Results::read(path)?.study, path.join(ROBOT_NAME)));
    }
    match questions::open_robot(path) {
        Ok(robot) => Ok(Input { robot, file: path.to_owned(), study: None }),
        Err(ProgramError::Study(StudyError::OtherKind { found: InputKind::Study, .. })) => {
            let study = questions::open_study(path)?;
            let named = Path::new(&study.file.robot);
            // Next to the study, or else of the library.
            let sibling = path.with_file_name("").join(named);
            let file = if sibling.exists() {
                sibling
            } else {
                PathBuf::from(named.file_stem().unwrap_or(named.as_os_str()))
            };
            Ok(of_study(study, file))
        }
        Err(error) => Err(error),
    }
}
