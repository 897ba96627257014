//! The report: one HTML file with the study, its results and all figures, which needs no other file.
//!
//! Static figures are the SVG files of this crate, byte for byte. plotly.js (`vendor/plotly`) draws the robot
//! and the surfaces in space from data that the page holds as JSON, and the explorer lets the reader move the
//! robot; both are packed. maud escapes everything that comes from files. A content security policy allows
//! the scripts of the page by their hashes, and forbids every connection.

mod analysis;
mod calibration;
mod elements;
mod glance;
mod poses;
mod results;
mod robot;
mod run;
mod setup;

pub use analysis::analysis_report;
pub use calibration::calibration_report;

use crate::draw::figures;
use crate::error::ReportError;
use crate::live::{LiveRobot, UNPACK, data, explored_study, models, packed, policy, script};
use crate::page::elements::{STYLE, Section, inert};
use crate::scene::Scene;
use cdpr_assess::FoundRegion;
use cdpr_robot::shown;
use cdpr_study::{Figure, ROBOT_NAME, Results, robot_hash};
use cdpr_web::page as explorer;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde::Serialize;

const SCRIPT: &str = include_str!("page/page.js");
const PLOTLY: &[u8] = include_bytes!("../vendor/plotly/plotly-gl3d.min.js.gz");

/// Data that the script of the page draws.
#[derive(Serialize)]
struct Data<'a> {
    robot: Option<&'a Scene>,
    surfaces: Vec<results::SpaceSurface>,
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
    report_with(results, &figures(results), None)
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
        surfaces: results::in_space(results),
        region: region.map(robot::RegionInSpace::new),
        live: LiveRobot {
            file: ROBOT_NAME,
            robot: serde_json::from_str(&results.robot_json).map_err(unreadable)?,
            study: study.as_ref(),
        },
    };
    let json = serde_json::to_string(&data).map_err(unreadable)?;
    let sections: Vec<Section> = [
        Some(robot::section(&results.study.robot, &scene, region)),
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
    Ok(page(results, &sections, &json).into_string())
}

/// The page with its contents, sections and scripts.
fn page(results: &Results, sections: &[Section], json: &str) -> Markup {
    let title = &results.summary.study;
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(policy(&[UNPACK, SCRIPT]));
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="generator" content={ "cdpr " (results.summary.version) };
                title { (shown(title)) }
                style { (PreEscaped(STYLE)) (PreEscaped(explorer::STYLE)) }
            }
            body {
                a.skip href="#content" { "Skip to the content" }
                div.page {
                    nav aria-label="Contents" {
                        ol {
                            li { a href="#content" { "At a glance" } }
                            @for section in sections { li { a href={ "#" (section.id) } { (section.title) } }
                                }
                        }
                    }
                    main id="content" {
                        (inert(&glance::header(results)))
                        @for section in sections {
                            section id=(section.id) {
                                h2 { (section.title) }
                                (inert(&section.body))
                            }
                        }
                        footer {
                            "Written by cdpr " (results.summary.version)
                                ". Interactive figures by plotly.js 4.1.1, the live robot by three.js (MIT "
                                "licences)."
                        }
                    }
                }
                (inert(&robot::live(&results.study.robot)))
                (data(json))
                (packed("plotly", PLOTLY))
                (models())
                (script(UNPACK))
                (script(SCRIPT))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sha2::{Digest, Sha256};
    use std::fmt::Write;

    #[test]
    fn plotly_is_the_file_whose_checksum_its_notice_names() {
        let mut sum = String::new();
        for byte in Sha256::digest(PLOTLY) {
            write!(sum, "{byte:02x}").unwrap();
        }
        assert!(include_str!("../vendor/plotly/README.md").contains(&sum), "{sum}");
    }

    #[test]
    fn the_script_does_not_end_its_element() {
        assert!(!SCRIPT.to_lowercase().contains("</script") && !SCRIPT.contains("<!--"));
    }
}
