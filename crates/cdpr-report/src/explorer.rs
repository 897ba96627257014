//! The explorer: one HTML file with a robot that computes where it is opened.
//!
//! It holds the WebAssembly module of `cdpr-web`, packed, and its page. A content security policy allows its
//! scripts by their hashes, the module, workers from within the page, and no connection.

use crate::error::ReportError;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use cdpr_robot::{shown, shown_lines};
use cdpr_study::{Output, Study, StudyFile};
use cdpr_web::page;
use maud::{DOCTYPE, PreEscaped, html};
use serde::Serialize;
use serde_json::value::RawValue;
use sha2::{Digest, Sha256};

const BOOT: &str = include_str!("explorer/boot.js");

/// The marker of the files that [`explorer`] writes, by which they are known as ours.
pub const EXPLORER_MARK: &str = "<meta name=\"generator\" content=\"cdpr explorer ";

/// What is explored.
#[derive(Clone, Debug)]
pub struct Explored<'a> {
    /// Name of the robot.
    pub name: &'a str,
    /// Path of its file, as commands name it.
    pub file: &'a str,
    /// Text of the robot file.
    pub robot: &'a str,
    /// The study whose load, pose and tolerances come first, from [`explored_study`].
    pub study: Option<StudyFile>,
}

/// What the script of the page reads.
#[derive(Serialize)]
struct Data<'a> {
    file: &'a str,
    robot: &'a RawValue,
    study: Option<&'a StudyFile>,
}

/// The text of the HTML file of a robot that is explored.
///
/// # Errors
/// [`ReportError::Drawing`] for a robot or a study that is no JSON.
pub fn explorer(explored: &Explored, version: &str) -> Result<String, ReportError> {
    let Explored { name, file, robot, study } = explored;
    let unreadable = |error: serde_json::Error| ReportError::Drawing { reason: error.to_string() };
    let robot = serde_json::from_str(robot).map_err(unreadable)?;
    let data = Data { file, robot, study: study.as_ref() };
    let data = serde_json::to_string(&data).map_err(unreadable)?;
    let packed = |module: &[u8]| PreEscaped(BASE64_STANDARD.encode(module));
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                // The text of `EXPLORER_MARK`.
                meta name="generator" content={ "cdpr explorer " (version) };
                meta http-equiv="Content-Security-Policy" content=(policy(&[page::SCRIPT, BOOT]));
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (shown(name)) " \u{2013} cdpr explorer" }
                style { (PreEscaped(page::STYLE)) }
            }
            body {
                div id="explorer" {
                    noscript { p { "This page computes in the browser: it needs JavaScript and WebAssembly." } }
                }
                // No browser runs these types. Without `<`, nothing in them can end the element.
                script type="application/json" id="data" { (PreEscaped(inert(&data))) }
                script type="text/plain" id="worker" { (PreEscaped(page::WORKER)) }
                script type="text/plain" id="module" { (packed(page::MODULE)) }
                script type="text/plain" id="module-scalar" { (packed(page::SCALAR_MODULE)) }
                script { (PreEscaped(page::SCRIPT)) }
                script { (PreEscaped(BOOT)) }
            }
        }
    };
    Ok(markup.into_string())
}

/// What a page observes of a study: its first sampling at one pose, which is called `all` there, with the
/// deflection as output, eight replicates and at most 2048 observations in each.
pub fn explored_study(study: &Study) -> StudyFile {
    let mut file = study.file.clone();
    file.samplings.retain(|_, sampling| sampling.pose.is_some());
    file.samplings.truncate(1);
    let first = file.samplings.pop().map(|(_, sampling)| sampling);
    if let Some(mut sampling) = first {
        sampling.observations = sampling.observations.min(OBSERVATIONS);
        file.error_models.retain(|name, _| *name == sampling.error_model);
        file.samplings.insert("all".to_owned(), sampling);
    }
    file.output = Output::Deflection;
    file.replicates = REPLICATES;
    file.sensitivity = None;
    file.surfaces.clear();
    file.comparison.clear();
    file
}

/// Scrambled replicates of a page, for the intervals of its effects.
const REPLICATES: usize = 8;

/// Observations of a page in each of them.
const OBSERVATIONS: usize = 2048;

/// JSON that cannot end its element.
fn inert(json: &str) -> String {
    shown_lines(json).replace('<', "\\u003c")
}

/// The content security policy of a page with these scripts that computes.
fn policy(scripts: &[&str]) -> String {
    let hashes =
        scripts.iter().map(|script| format!("'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(script))));
    format!(
        "default-src 'none'; script-src {} 'wasm-unsafe-eval' blob:; worker-src blob:; \
         style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'",
        hashes.collect::<Vec<_>>().join(" ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scripts_do_not_end_their_elements() {
        for script in [page::SCRIPT, page::WORKER, BOOT] {
            assert!(!script.to_lowercase().contains("</script") && !script.contains("<!--"));
        }
    }

    #[test]
    fn the_file_bears_its_mark_and_holds_the_robot() {
        let robot = r#"{"name": "</script><script>alert(1)</script>"}"#;
        let explored = Explored { name: "</title>", file: "robot.json", robot, study: None };
        let page = explorer(&explored, "1.2.3").unwrap();
        assert!(
            page.contains(EXPLORER_MARK)
                && !page.contains("</title> ")
                && !page.contains("alert(1)</script>")
        );
    }
}
