//! Names of files that are written: a folder that does not exist, and an ending that says another format than
//! the file has, are refused before anything is computed.

use clap::builder::{PathBufValueParser, TypedValueParser};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// A format that is written.
struct Written {
    /// What the file is, for people.
    is: &'static str,
    /// Its endings, the usual one first.
    endings: &'static [&'static str],
}

const HTML: Written = Written { is: "the page is HTML", endings: &["html", "htm", "xhtml"] };
const JSON: Written = Written { is: "the file is JSON", endings: &["json"] };
const ANSWER: Written =
    Written { is: "the answer is text, JSON or CSV", endings: &["txt", "json", "csv", "dat", "md"] };
const CSV: Written = Written { is: "the table is CSV", endings: &["csv", "txt"] };

/// Endings of formats that no file of another format has.
const KNOWN: [&str; 24] = [
    "csv", "dat", "gz", "htm", "html", "jpeg", "jpg", "json", "md", "mat", "npy", "parquet", "pdf", "png",
    "sdf", "svg", "tex", "tsv", "txt", "wcrfx", "xhtml", "xlsx", "xml", "yaml",
];

/// A page.
pub(crate) fn html() -> impl TypedValueParser<Value = PathBuf> {
    of(HTML)
}

/// A robot, a study or a law.
pub(crate) fn json() -> impl TypedValueParser<Value = PathBuf> {
    of(JSON)
}

/// A table.
pub(crate) fn csv() -> impl TypedValueParser<Value = PathBuf> {
    of(CSV)
}

/// An answer in any format.
pub(crate) fn any() -> impl TypedValueParser<Value = PathBuf> {
    of(ANSWER)
}

fn of(written: Written) -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(move |path| {
        let fits = fits(&path, written.endings);
        if fits { check_place(&path).map(|()| path) } else { Err(refusal(written.is, written.endings)) }
    })
}

/// Refuses a file in a folder that does not exist, and a folder.
pub(crate) fn check_place(path: &Path) -> Result<(), String> {
    if path.is_dir() {
        return Err("a folder: expected the name of a file".to_owned());
    }
    match path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        Some(folder) if !folder.is_dir() => {
            Err(format!("there is no folder {}: make it, or name another one", folder.display()))
        }
        _ => Ok(()),
    }
}

/// A file of another program, which has one of these endings; without any, several files whose names begin
/// so.
pub(crate) fn check_foreign(path: &Path, is: &str, endings: &[&str]) -> Result<(), String> {
    if fits(path, endings) {
        return Ok(());
    }
    Err(format!("--out {}: {}", path.display(), refusal(is, endings)))
}

fn refusal(is: &str, endings: &[&str]) -> String {
    let expected =
        endings.first().map_or("without an ending".to_owned(), |usual| format!("that ends in .{usual}"));
    format!("{is}: expected a name {expected}")
}

/// Whether the ending of a name is one of these, or none that is known.
fn fits(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().and_then(OsStr::to_str).map(str::to_ascii_lowercase);
    ending.is_none_or(|ending| endings.contains(&ending.as_str()) || !KNOWN.contains(&ending.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ending_of_another_format_does_not_fit_and_an_unknown_one_does() {
        for (name, html, json) in [
            ("page.html", true, false),
            ("page.HTML", true, false),
            ("robot.json", false, true),
            ("a.folder/page", true, true),
            ("robot.v2", true, true),
            ("page.pdf", false, false),
            (".json", true, true),
        ] {
            let path = Path::new(name);
            assert_eq!((fits(path, HTML.endings), fits(path, JSON.endings)), (html, json), "{name}");
            assert_eq!(fits(path, ANSWER.endings), json, "{name}");
        }
    }
}
