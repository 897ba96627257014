//! Folders and files: read and written, with the path in every error.

use crate::error::StudyError;
use crate::fs::input::{other_kind, read_text};
use crate::kind::InputKind;
use cdpr_robot::Robot;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Makes the folder for results and checks that files can be written in it: before anything is computed.
///
/// # Errors
/// [`StudyError::Write`].
pub fn check_folder(folder: &Path) -> Result<(), StudyError> {
    let write = |source| StudyError::Write { path: folder.to_owned(), source };
    std::fs::create_dir_all(folder).map_err(write)?;
    // A name of its own: other machines may be looking, too.
    tempfile::tempfile_in(folder).map_err(write).map(|_| ())
}

/// Removes a file of an earlier run, if it exists, because it would not belong to the new results.
///
/// # Errors
/// [`StudyError::Write`].
pub(crate) fn remove_stale(path: PathBuf) -> Result<(), StudyError> {
    match std::fs::remove_file(&path) {
        Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
            Err(StudyError::Write { path, source })
        }
        _ => Ok(()),
    }
}

pub(crate) fn unwritten(path: PathBuf, error: csv::Error) -> StudyError {
    StudyError::Write { path, source: error.into() }
}

/// Writes a table as CSV whose columns are the fields of its rows.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_rows<T: Serialize>(path: PathBuf, rows: &[T]) -> Result<PathBuf, StudyError> {
    let write = || -> Result<(), csv::Error> {
        let mut writer = csv::Writer::from_path(&path)?;
        rows.iter().try_for_each(|row| writer.serialize(row))?;
        Ok(writer.flush()?)
    };
    match write() {
        Ok(()) => Ok(path),
        Err(error) => Err(unwritten(path, error)),
    }
}

/// Writes a table as CSV from its header and its rows of text.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_csv(
    path: PathBuf,
    header: Vec<String>,
    rows: impl Iterator<Item = Vec<String>>,
) -> Result<PathBuf, StudyError> {
    let write = || -> Result<(), csv::Error> {
        let mut writer = csv::Writer::from_path(&path)?;
        writer.write_record(header)?;
        for row in rows {
            writer.write_record(row)?;
        }
        writer.flush()?;
        Ok(())
    };
    match write() {
        Ok(()) => Ok(path),
        Err(error) => Err(unwritten(path, error)),
    }
}

/// Writes a text to a file.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_text(path: &Path, text: &str) -> Result<(), StudyError> {
    std::fs::write(path, text).map_err(|source| StudyError::Write { path: path.to_owned(), source })
}

/// The text of a file in a folder of results.
pub(crate) fn read(path: &Path) -> Result<String, StudyError> {
    read_text(path, InputKind::Results)
}

/// Reads and checks a robot file.
///
/// # Errors
/// As [`read_text`]; [`StudyError::OtherKind`] for a study or a law; [`StudyError::Robot`] naming file, field,
/// value and what is expected.
pub fn open_robot(path: &Path) -> Result<Robot, StudyError> {
    let text = read_text(path, InputKind::Robot)?;
    Robot::from_json(&text).map_err(|source| {
        let other = other_kind(path, &text, InputKind::Robot);
        other.unwrap_or_else(|| StudyError::Robot { path: path.to_owned(), source })
    })
}
