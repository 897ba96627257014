//! What a page carries so that a robot computes in it: scripts and modules, packed, and the policy under
//! which they run.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use cdpr_robot::shown_lines;
use cdpr_study::{Output, Study, StudyFile};
use cdpr_web::page;
use maud::{Markup, PreEscaped, html};
use serde::Serialize;
use serde_json::value::RawValue;
use sha2::{Digest, Sha256};

/// The script that unpacks, which comes before the one of the page.
pub(crate) const UNPACK: &str = include_str!("live/unpack.js");

/// The script of a page that shows the explorer alone.
pub(crate) const BOOT: &str = include_str!("live/boot.js");

/// A robot that computes, as the explorer reads it.
#[derive(Serialize)]
pub(crate) struct LiveRobot<'a> {
    /// Path of its file, as commands name it.
    pub file: &'a str,
    pub robot: &'a RawValue,
    pub study: Option<&'a StudyFile>,
}

/// What a page observes of a study: its first sampling at one pose, which is called `all` there, with the
/// deflection as output, eight replicates and at most 2048 observations in each. None if no sampling has one
/// pose.
pub fn explored_study(study: &Study) -> Option<StudyFile> {
    let mut file = study.file.clone();
    let first = file.samplings.values().position(|sampling| sampling.pose.is_some())?;
    let (_, mut sampling) = file.samplings.swap_remove_index(first)?;
    sampling.observations = sampling.observations.min(OBSERVATIONS);
    file.error_models.retain(|name, _| *name == sampling.error_model);
    file.samplings.clear();
    file.samplings.insert("all".to_owned(), sampling);
    file.output = Output::Deflection;
    file.replicates = REPLICATES;
    file.sensitivity = None;
    file.surfaces.clear();
    Some(file)
}

/// Scrambled replicates of a page, for the intervals of its effects.
const REPLICATES: usize = 8;

/// Observations of a page in each of them.
const OBSERVATIONS: usize = 2048;

/// JSON in an element that no browser runs. Without `<`, nothing in it can end the element.
pub(crate) fn data(json: &str) -> Markup {
    let inert = shown_lines(json).replace('<', "\\u003c");
    html! { script type="application/json" id="data" { (PreEscaped(inert)) } }
}

/// A packed file in an element that no browser runs.
pub(crate) fn packed(id: &str, file: &[u8]) -> Markup {
    html! { script type="text/plain" id=(id) { (PreEscaped(BASE64_STANDARD.encode(file))) } }
}

/// The explorer's script, worker, and models in the vector unit of WebAssembly.
pub(crate) fn models() -> Markup {
    html! {
        script type="text/plain" id="worker" { (PreEscaped(page::WORKER)) }
        (packed("explorer-script", page::SCRIPT))
        (packed("module", page::MODULE))
    }
}

/// A script of the page.
pub(crate) fn script(text: &str) -> Markup {
    html! { script { (PreEscaped(text)) } }
}

/// The content security policy of a page that computes: these scripts by their hashes, what they unpack, the
/// styles and pictures of the page itself, and no connection.
pub(crate) fn policy(scripts: &[&str]) -> String {
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
        for script in [page::WORKER, UNPACK, BOOT] {
            assert!(!script.to_lowercase().contains("</script") && !script.contains("<!--"));
        }
    }
}
