//! The report: one HTML file with the study, its results and all figures, which needs no other file.
//!
//! Static figures are the SVG files of this crate, byte for byte. The script of the explorer, which is
//! packed, draws the robot in space from data that the page holds as JSON, and lets the reader move it. maud
//! escapes everything that comes from files. A content security policy allows the scripts of the page by
//! their hashes, and forbids every connection.

mod analysis;
mod calibration;
mod elements;
mod glance;
mod plot;
mod poses;
mod results;
mod robot;
mod run;
mod setup;

pub use analysis::analysis_report;
pub use calibration::calibration_report;

use crate::draw::figures;
use crate::drawing::sheet::Sheet;
use crate::error::ReportError;
use crate::live::{LiveRobot, explored_study};
use crate::page::elements::{Document, Live, Section};
use crate::scene::Scene;
use cdpr_assess::FoundRegion;
use cdpr_study::{Figure, ROBOT_NAME, Results, robot_hash};
use serde::Serialize;

pub(crate) const SCRIPT: &str = include_str!("page/page.js");

/// Data that the script of the page draws.
#[derive(Serialize)]
struct Data<'a> {
    robot: Option<&'a Scene>,
    region: Option<robot::RegionInSpace>,
    live: LiveRobot<'a>,
}

/// Writes the report of a study as the text of an HTML file.
///
/// The page gives the reason in the place of a figure that cannot be drawn.
///
/// # Errors
/// [`ReportError::Drawing`] if the data of the page cannot be written as JSON.
pub fn report(results: &Results) -> Result<String, ReportError> {
    report_with(results, &figures(results, Sheet::SCREEN), None)
}

/// Writes the report of a study with figures that [`crate::draw()`] has drawn already, and with the region of
/// a workspace of its robot.
///
/// # Errors
/// As [`report`]; [`ReportError::Invalid`] for the region of another robot.
pub fn report_with(
    results: &Results,
    figures: &[Figure],
    region: Option<&FoundRegion>,
) -> Result<String, ReportError> {
    let hash = robot_hash(&results.study.robot);
    if let Some(region) = region.filter(|region| region.robot_hash != hash) {
        let found = format!("{} (hash {})", region.robot, region.robot_hash);
        let expected = "the robot of the study, with the same values";
        return Err(ReportError::invalid("the robot of the workspace", &found, expected));
    }
    let scene = Scene::new(&results.study);
    let unreadable = |error: serde_json::Error| ReportError::Drawing { reason: error.to_string() };
    let study = explored_study(&results.study);
    let data = Data {
        robot: scene.as_ref().ok(),
        region: region.map(robot::RegionInSpace::new),
        live: LiveRobot {
            file: ROBOT_NAME,
            robot: serde_json::from_str(&results.robot_json).map_err(unreadable)?,
            study: study.as_ref(),
        },
    };
    let json = serde_json::to_string(&data).map_err(unreadable)?;
    let sections: Vec<Section> = [
        Some(robot::section(&results.study, &scene, region)),
        Some(setup::section(results)),
        results::distributions(results, figures),
        results::surfaces(results, figures),
        poses::section(results, figures),
        results::points(results, figures),
        results::effects(results, figures),
        results::measures(results, figures),
        Some(run::observations(results)),
        Some(run::again(results)),
    ]
    .into_iter()
    .flatten()
    .collect();
    let dialog = robot::live(&results.study.robot);
    let document = Document {
        title: &results.summary.study,
        version: &results.summary.version,
        header: glance::header(results),
        sections,
        live: Some(Live { dialog, json: &json, script: SCRIPT }),
    };
    Ok(document.write())
}
