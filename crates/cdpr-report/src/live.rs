//! What a page carries so that a robot computes in it: scripts and modules, packed, and the policy under
//! which they run.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use cdpr_robot::shown_lines;
use cdpr_statics::Load;
use cdpr_study::{Output, Study, StudyFile};
use cdpr_web::page;
use maud::{Markup, PreEscaped, html};
use serde::Serialize;
use serde_json::value::RawValue;
use sha2::{Digest, Sha256};

/// The script that unpacks, which comes before the one of the page.
pub(crate) const UNPACK: &str = concat!(include_str!("live/lzma.js"), include_str!("live/unpack.js"));

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
/// deflection as output, eight replicates and at most 2048 observations in each. A study without load gets
/// a tenth of the platform's mass. None if no sampling has one pose.
pub fn explored_study(study: &Study) -> Option<StudyFile> {
    let mut file = study.file.clone();
    let first = file.samplings.values().position(|sampling| sampling.pose.is_some())?;
    let (_, mut sampling) = file.samplings.swap_remove_index(first)?;
    sampling.observations = sampling.observations.min(OBSERVATIONS);
    file.error_models.retain(|name, _| *name == sampling.error_model);
    file.samplings.clear();
    file.samplings.insert("all".to_owned(), sampling);
    file.output = Output::Deflection;
    if file.load() == Load::none() {
        // That of a template.
        file.payload = 0.1 * study.robot.platform.mass;
    }
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
fn packed(id: &str, file: &[u8]) -> Markup {
    html! { script type="text/plain" id=(id) { (PreEscaped(base85(file))) } }
}

/// Bytes as text, five characters for four bytes, the most significant first; the last one to three bytes
/// have one character more than bytes. The digits from 0 to 84 are the characters from `(` to `|`, with `!`
/// for `<`, so that nothing in the text can end an element. It is 6 % shorter than base 64.
fn base85(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len() / 4 * 5 + 5);
    for four in bytes.chunks(4) {
        let mut padded = [0; 4];
        padded[..four.len()].copy_from_slice(four);
        let value = u32::from_be_bytes(padded);
        let digits = [85_u32.pow(4), 85_u32.pow(3), 85 * 85, 85, 1].map(|place| value / place % 85);
        let character = |digit: &u32| match char::from(b'(' + *digit as u8) {
            '<' => '!',
            other => other,
        };
        text.extend(digits[..=four.len()].iter().map(character));
    }
    text
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
    fn packed_files_are_read_back_as_the_page_reads_them() {
        // What `decoded` of unpack.js does.
        let decoded = |text: &str| -> Vec<u8> {
            let digit = |code: u8| u64::from(if code == b'!' { b'<' } else { code } - b'(');
            let groups = text.as_bytes().chunks(5).flat_map(|five| {
                let digits = five.iter().map(|code| digit(*code)).chain([84; 5]).take(5);
                let value = digits.fold(0, |value, digit| 85 * value + digit);
                u32::try_from(value).unwrap().to_be_bytes()[..five.len() - 1].to_vec()
            });
            groups.collect()
        };
        let bytes: Vec<u8> = (0..2048_u32).map(|k| ((k * k * 31) >> 3) as u8).chain([255; 7]).collect();
        for length in [0, 1, 2, 3, 4, 5, 2049, 2050, 2051, 2052, 2055] {
            let text = base85(&bytes[..length]);
            assert_eq!(decoded(&text), bytes[..length]);
            assert!(!text.contains('<') && text.len() == (5 * length).div_ceil(4), "{length}");
        }
    }

    #[test]
    fn the_scripts_do_not_end_their_elements() {
        for script in [page::WORKER, UNPACK, BOOT, crate::page::SCRIPT] {
            assert!(!script.to_lowercase().contains("</script") && !script.contains("<!--"));
        }
    }
}
