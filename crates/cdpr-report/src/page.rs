//! The report: one HTML file with the study, its results and all figures, which needs no other file.
//!
//! Static figures are the SVG files of this crate, byte for byte. plotly.js (`vendor/plotly`) draws the robot
//! and the surfaces in space from data that the page holds as JSON. maud escapes everything that comes from
//! files. The data stands in a `script` element of a type that no browser runs, and contains no `<`. A
//! content security policy allows the two scripts by their hashes, and forbids all other scripts and every
//! connection.

mod analysis;
mod calibration;
mod comparison;
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
use crate::page::elements::{STYLE, Section, inert};
use crate::scene::Scene;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use cdpr_assess::FoundRegion;
use cdpr_robot::{shown, shown_lines};
use cdpr_study::{Figure, Results};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde::Serialize;
use sha2::{Digest, Sha256};

const SCRIPT: &str = include_str!("page/page.js");
const PLOTLY: &str = include_str!("../vendor/plotly/plotly-gl3d.min.js");

/// Data that the script of the page draws.
#[derive(Serialize)]
struct Data<'a> {
    robot: Option<&'a Scene>,
    surfaces: Vec<results::SpaceSurface>,
    region: Option<robot::RegionInSpace>,
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
    let name = &results.study.robot.name;
    if let Some(region) = region.filter(|region| region.robot != *name) {
        let expected = "the robot of the study";
        return Err(ReportError::invalid("the robot of the workspace", &region.robot, expected));
    }
    let scene = Scene::new(&results.study);
    let data = Data {
        robot: scene.as_ref().ok(),
        surfaces: results::in_space(results),
        region: region.map(robot::RegionInSpace::new),
    };
    let json =
        serde_json::to_string(&data).map_err(|error| ReportError::Drawing { reason: error.to_string() })?;
    let sections: Vec<Section> = [
        Some(robot::section(&results.study.robot, &scene, region)),
        Some(setup::section(results)),
        results::distributions(results, figures),
        results::surfaces(results, figures),
        poses::section(results, figures),
        results::points(results, figures),
        results::effects(results, figures),
        results::measures(results, figures),
        comparison::section(&results.summary),
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
                meta http-equiv="Content-Security-Policy" content=(policy());
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="generator" content={ "cdpr " (results.summary.version) };
                title { (shown(title)) }
                style { (PreEscaped(STYLE)) }
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
                                ". Interactive figures by plotly.js 4.1.1 (MIT licence)."
                        }
                    }
                }
                // No browser runs this type. Without `<`, nothing in the data can end the element.
                script type="application/json" id="data" { (PreEscaped(shown_lines(json).replace('<', "\\u003c"))) }
                script { (PreEscaped(PLOTLY)) }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    }
}

/// Content security policy: scripts by their hashes, styles and images of the page itself, and no connection.
fn policy() -> String {
    let hash = |script: &str| BASE64_STANDARD.encode(Sha256::digest(script));
    format!(
        "default-src 'none'; script-src 'sha256-{}' 'sha256-{}'; style-src 'unsafe-inline'; img-src data: \
            blob:; \
         base-uri 'none'; form-action 'none'",
        hash(PLOTLY),
        hash(SCRIPT)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
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
    fn the_scripts_do_not_end_their_elements() {
        for script in [PLOTLY, SCRIPT] {
            assert!(!script.to_lowercase().contains("</script") && !script.contains("<!--"));
        }
    }
}
