//! The explorer: one HTML file with a robot that computes where it is opened.

use crate::error::ReportError;
use crate::live::{BOOT, LiveRobot, UNPACK, data, models, policy, script};
use cdpr_robot::shown;
use cdpr_study::StudyFile;
use cdpr_web::page;
use maud::{DOCTYPE, PreEscaped, html};

/// What is explored.
#[derive(Clone, Debug)]
pub struct Explored<'a> {
    /// Name of the robot.
    pub name: &'a str,
    /// Path of its file, as commands name it.
    pub file: &'a str,
    /// Text of the robot file.
    pub robot: &'a str,
    /// The study whose load, pose and tolerances come first, from [`crate::explored_study`].
    pub study: Option<StudyFile>,
}

/// The text of the HTML file of a robot that is explored.
///
/// # Errors
/// [`ReportError::Drawing`] for a robot or a study that is no JSON.
pub fn explorer(explored: &Explored, version: &str) -> Result<String, ReportError> {
    let Explored { name, file, robot, study } = explored;
    let unreadable = |error: serde_json::Error| ReportError::Drawing { reason: error.to_string() };
    let robot = serde_json::from_str(robot).map_err(unreadable)?;
    let robot = LiveRobot { file, robot, study: study.as_ref() };
    let json = serde_json::to_string(&robot).map_err(unreadable)?;
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="generator" content={ "cdpr explorer " (version) };
                meta http-equiv="Content-Security-Policy" content=(policy(&[UNPACK, BOOT]));
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (shown(name)) " \u{2013} cdpr explorer" }
                style { (PreEscaped(page::STYLE)) }
            }
            body {
                div id="explorer" {
                    noscript { p { "This page computes in the browser: it needs JavaScript and WebAssembly." } }
                }
                (data(&json))
                (models())
                (script(UNPACK))
                (script(BOOT))
            }
        }
    };
    Ok(markup.into_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_names_its_maker_and_holds_the_robot() {
        let robot = r#"{"name": "</script><script>alert(1)</script>"}"#;
        let explored = Explored { name: "</title>", file: "robot.json", robot, study: None };
        let page = explorer(&explored, "1.2.3").unwrap();
        assert!(
            page.contains("<meta name=\"generator\" content=\"cdpr explorer 1.2.3\">")
                && !page.contains("</title> ")
                && !page.contains("alert(1)</script>")
        );
    }
}
