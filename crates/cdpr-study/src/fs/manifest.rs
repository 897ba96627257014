//! `cdpr-results.json`, the list of the files in a folder that runs have written. A name is in it before its
//! file is created; only files that it names are ever replaced or removed. When all files of a run are
//! written, the list has the digest of each, by which a file that was changed later is noticed.

use crate::error::StudyError;
use crate::fs::atomic::write_atomic;
use crate::fs::disk;
use crate::fs::input::{open, read_bytes, read_text, text_of};
use crate::kind::InputKind;
use crate::names::{BLOCKS_NAME, LOCK_NAME, MANIFEST_NAME};
use cdpr_robot::from_json;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Name and version of the format.
const MANIFEST_FORMAT: &str = "cdpr-results/1";

/// Endings of the files that runs write.
const ENDINGS: [&str; 6] = ["csv", "parquet", "svg", "stl", "json", "html"];

/// What the results in a folder are of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ResultsOf {
    /// A study.
    Study,
    /// A workspace.
    Workspace,
    /// The robustness of the direct model.
    Robustness,
    /// A calibration.
    Calibration,
    /// The analysis of a table.
    Analysis,
    /// Figures alone.
    Figures,
}

impl ResultsOf {
    /// The word for it in messages.
    pub fn word(self) -> &'static str {
        match self {
            Self::Study => "a study",
            Self::Workspace => "a workspace",
            Self::Robustness => "the robustness of the direct model",
            Self::Calibration => "a calibration",
            Self::Analysis => "the analysis of a table",
            Self::Figures => "figures",
        }
    }
}

/// The list of a folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Manifest {
    format: String,
    pub(crate) of: ResultsOf,
    /// Hash of the study ([`crate::Study::hash`]).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) study: Option<String>,
    /// The files by their names, relative to the folder, each with the [`digest`] of its content; `None` for
    /// one that is being written, or that holds no results.
    pub(crate) files: BTreeMap<String, Option<String>>,
}

/// The BLAKE3 hash of a content, in hexadecimal digits, as `b3sum` prints it.
pub(crate) fn digest(content: &[u8]) -> String {
    blake3::hash(content).to_string()
}

impl Manifest {
    pub(crate) fn new(of: ResultsOf) -> Self {
        Self { format: MANIFEST_FORMAT.to_owned(), of, study: None, files: BTreeMap::new() }
    }

    /// The list of a folder, if it has one.
    ///
    /// # Errors
    /// [`StudyError::Read`], [`StudyError::Format`]; [`StudyError::Link`] for a link in its place,
    /// [`StudyError::Invalid`] for names that no run has given.
    pub(crate) fn read(folder: &Path) -> Result<Option<Self>, StudyError> {
        let path = folder.join(MANIFEST_NAME);
        if folder.is_file() {
            return Err(StudyError::NoFolder { path: folder.to_owned() });
        }
        if !is_plain_file(&path)? {
            return Ok(None);
        }
        let manifest: Self = from_json(&read_text(&path, InputKind::Results)?)
            .map_err(|source| StudyError::Format { path: path.clone(), source })?;
        let invalid =
            |field: &str, value: &str, expected: &str| StudyError::invalid(&path, field, value, expected);
        if manifest.format != MANIFEST_FORMAT {
            return Err(invalid("format", &manifest.format, MANIFEST_FORMAT));
        }
        match manifest.files.keys().find(|name| !is_name_of_results(name)) {
            Some(name) => Err(invalid("files", name, "names of tables, figures and reports in this folder")),
            None => Ok(Some(manifest)),
        }
    }

    /// Writes the list into a folder.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn write(&self, folder: &Path) -> Result<(), StudyError> {
        let path = folder.join(MANIFEST_NAME);
        match serde_json::to_string_pretty(self) {
            Ok(text) => write_atomic(path, (text + "\n").as_bytes()).map(|_| ()),
            Err(error) => Err(StudyError::Write { path, source: error.into() }),
        }
    }

    /// The digest of a file's content, if the list has one.
    fn digest_of(&self, name: &str) -> Option<&str> {
        self.files.get(name)?.as_deref()
    }

    /// Checks that a file of the folder is what the list says, if the list has its digest.
    ///
    /// # Errors
    /// [`StudyError::Changed`]; [`StudyError::Read`], also for a file that does not exist.
    pub(crate) fn check(&self, folder: &Path, name: &str) -> Result<(), StudyError> {
        let Some(expected) = self.digest_of(name) else { return Ok(()) };
        let path = folder.join(name);
        let mut hasher = blake3::Hasher::new();
        match hasher.update_reader(open(&path, InputKind::Results)?) {
            Ok(hasher) if hasher.finalize().to_string() == expected => Ok(()),
            Ok(_) => Err(StudyError::Changed { path }),
            Err(source) => Err(StudyError::Read { path, source }),
        }
    }
}

/// Checks that no table of a folder was changed since its run, also one that is not read again. A removed
/// table does not count as changed.
///
/// # Errors
/// [`StudyError::Changed`]; [`StudyError::Read`], [`StudyError::NotRegular`].
pub(crate) fn check_tables(folder: &Path, list: &Manifest) -> Result<(), StudyError> {
    let tables = list.files.keys().filter(|name| name.ends_with(".csv") || name.ends_with(".parquet"));
    for name in tables {
        match list.check(folder, name) {
            Err(StudyError::Read { source, .. }) if source.kind() == ErrorKind::NotFound => (),
            checked => checked?,
        }
    }
    Ok(())
}

/// Checks that a file is not one that a run has written and somebody has changed since.
///
/// # Errors
/// [`StudyError::Changed`] and those of the list of its folder.
pub(crate) fn check_unchanged(path: &Path) -> Result<(), StudyError> {
    // A table may stand in the folder itself or in one below it.
    for folder in path.ancestors().skip(1).take(2) {
        let Some(name) = path.strip_prefix(folder).ok().and_then(Path::to_str) else { continue };
        if let Some(list) = Manifest::read(folder)? {
            list.check(folder, name)?;
        }
    }
    Ok(())
}

/// The content of a file in a folder of results.
///
/// # Errors
/// [`StudyError::Read`], [`StudyError::TooLarge`]; [`StudyError::Changed`] for a file that was changed after
/// the run that wrote it.
pub fn read_result(folder: &Path, name: &str) -> Result<Vec<u8>, StudyError> {
    let path = folder.join(name);
    let bytes = read_bytes(&path, InputKind::Results)?;
    match Manifest::read(folder)?.as_ref().and_then(|list| list.digest_of(name)) {
        Some(expected) if digest(&bytes) != expected => Err(StudyError::Changed { path }),
        _ => Ok(bytes),
    }
}

/// The text of a file in a folder of results.
///
/// # Errors
/// As [`read_text`]; [`StudyError::Changed`] for a text that is not the one in the folder's list.
pub(crate) fn read(folder: &Path, list: Option<&Manifest>, name: &str) -> Result<String, StudyError> {
    let path = folder.join(name);
    let bytes = read_bytes(&path, InputKind::Results)?;
    match list.and_then(|list| list.digest_of(name)) {
        Some(expected) if digest(&bytes) != expected => Err(StudyError::Changed { path }),
        _ => text_of(&path, bytes),
    }
}

/// The files of a folder that are not, or no longer, what its list says.
///
/// # Errors
/// [`StudyError::Read`] and those of the list.
pub(crate) fn changed_files(folder: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let mut changed = Vec::new();
    let Some(list) = Manifest::read(folder)? else { return Ok(changed) };
    for name in list.files.keys() {
        match list.check(folder, name) {
            Ok(()) => (),
            Err(StudyError::NotRegular { path, .. } | StudyError::Changed { path }) => changed.push(path),
            Err(StudyError::Read { path, source }) if source.kind() == ErrorKind::NotFound => {
                changed.push(path);
            }
            Err(error) => return Err(error),
        }
    }
    Ok(changed)
}

/// Whether a run may give a file this name: plain words with a known ending, in the folder itself or in one
/// folder below it, never among the blocks.
fn is_name_of_results(name: &str) -> bool {
    let is_word = |text: &str| {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        !text.is_empty() && text.chars().all(plain)
    };
    let (folder, file) = match name.split_once('/') {
        Some((folder, file)) => (Some(folder), file),
        None => (None, name),
    };
    folder.is_none_or(|folder| is_word(folder) && folder != BLOCKS_NAME)
        && file.rsplit_once('.').is_some_and(|(stem, ending)| is_word(stem) && ENDINGS.contains(&ending))
        && ![MANIFEST_NAME, LOCK_NAME].contains(&file)
}

/// Whether there is a file of this name, and no link in its place.
///
/// # Errors
/// [`StudyError::Link`] for a link, a folder, or anything else that no run makes; [`StudyError::Read`].
pub(crate) fn is_plain_file(path: &Path) -> Result<bool, StudyError> {
    is_plain(path, std::fs::Metadata::is_file)
}

/// Whether there is a folder of this name, and no link in its place.
///
/// # Errors
/// As [`is_plain_file`].
pub(crate) fn is_plain_folder(path: &Path) -> Result<bool, StudyError> {
    is_plain(path, std::fs::Metadata::is_dir)
}

fn is_plain(path: &Path, wanted: impl Fn(&std::fs::Metadata) -> bool) -> Result<bool, StudyError> {
    match std::fs::symlink_metadata(path) {
        Ok(found) if wanted(&found) => Ok(true),
        Ok(_) => Err(StudyError::Link { path: path.to_owned() }),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(source) => Err(StudyError::Read { path: path.to_owned(), source }),
    }
}

/// The entries of a folder with their types, of links those of the link; none if there is no such folder.
///
/// # Errors
/// [`StudyError::Read`].
pub(crate) fn entries(folder: &Path) -> Result<Vec<(PathBuf, std::fs::FileType)>, StudyError> {
    let read = |source| StudyError::Read { path: folder.to_owned(), source };
    let listed = match std::fs::read_dir(folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        listed => listed.map_err(read)?,
    };
    let mut entries = Vec::new();
    for entry in listed {
        let entry = entry.map_err(read)?;
        match entry.file_type() {
            // Another process has removed it meanwhile.
            Err(error) if error.kind() == ErrorKind::NotFound => (),
            kind => entries.push((entry.path(), kind.map_err(read)?)),
        }
    }
    entries.sort_by(|one, other| one.0.cmp(&other.0));
    Ok(entries)
}

/// Makes a folder, or takes one that is no link.
///
/// # Errors
/// [`StudyError::Link`], [`StudyError::Write`].
pub(crate) fn make_plain_folder(path: &Path) -> Result<(), StudyError> {
    if !is_plain_folder(path)? {
        disk::make_folder(path).map_err(|source| StudyError::Write { path: path.to_owned(), source })?;
        is_plain_folder(path)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_plain_names_of_files_in_the_folder_itself_or_right_below_it_are_of_results() {
        for name in ["mechanical.csv", "plane/0000.csv", "summary.json", "report.html", "a-b_2.parquet"] {
            assert!(is_name_of_results(name), "{name}");
        }
        for name in [
            "",
            ".csv",
            "..",
            "../victim.csv",
            "../victim/2024.csv",
            "/etc/passwd.csv",
            "/0000.csv",
            "a/../b.csv",
            "a/b/c.csv",
            "./a.csv",
            "a\\b.csv",
            "C:a.csv",
            "notes.txt",
            "mechanical",
            "mechanical.csv.bak",
            "blocks/0000.csv",
            "cdpr-results.json",
            "cdpr-results.lock",
            "plane/cdpr-results.json",
            "a\0.csv",
            "a\n.csv",
        ] {
            assert!(!is_name_of_results(name), "{name:?}");
        }
    }
}
