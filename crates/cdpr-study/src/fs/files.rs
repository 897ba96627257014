//! Folders and files: read and written, with the path in every error.

use crate::error::StudyError;
use crate::fs::disk;
use crate::fs::input::{other_kind, read_text};
use crate::kind::InputKind;
use cdpr_robot::{Robot, RobotError};
use std::path::Path;

/// Makes the folder for results and checks that files can be written in it: before anything is computed.
///
/// # Errors
/// [`StudyError::Write`].
pub(crate) fn check_folder(folder: &Path) -> Result<(), StudyError> {
    let write = |source| StudyError::Write { path: folder.to_owned(), source };
    disk::make_folders(folder).map_err(write)?;
    // A name of its own: other machines may be looking, too.
    disk::probe(folder).map_err(write)
}

/// Reads and checks a robot file.
///
/// # Errors
/// As [`read_text`]; [`StudyError::OtherKind`] for a study or a law; [`StudyError::Robot`] naming file,
/// field, value and what is expected.
pub fn open_robot(path: &Path) -> Result<Robot, StudyError> {
    opened(path, Robot::from_json)
}

/// Reads and checks a robot file without questioning its units, for an inspection.
///
/// # Errors
/// As [`open_robot`].
pub fn open_robot_in_any_unit(path: &Path) -> Result<Robot, StudyError> {
    opened(path, Robot::from_json_in_any_unit)
}

fn opened(path: &Path, read: fn(&str) -> Result<Robot, RobotError>) -> Result<Robot, StudyError> {
    let text = read_text(path, InputKind::Robot)?;
    read(&text).map_err(|source| {
        let other = other_kind(path, &text, InputKind::Robot);
        other.unwrap_or_else(|| StudyError::Robot { path: path.to_owned(), source })
    })
}
