//! Folders and files: read and written, with the path in every error.

use crate::error::StudyError;
use crate::fs::disk;
use crate::fs::input::{other_kind, read_text};
use crate::kind::InputKind;
use cdpr_robot::library::{CABLES, LibraryFile, ROBOTS, named, near};
use cdpr_robot::{CatalogueCable, Robot, RobotError};
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

/// Reads and checks a robot file, or the robot of the library that has this name where no file has it.
///
/// # Errors
/// As [`read_text`]; [`StudyError::NoSuchName`] for a name that neither a file nor the library has;
/// [`StudyError::OtherKind`] for a study or a law; [`StudyError::Robot`] naming file, field, value and what
/// is expected.
pub fn open_robot(path: &Path) -> Result<Robot, StudyError> {
    read_robot(path, Robot::from_json)
}

/// Reads and checks a robot without questioning its units, for an inspection.
///
/// # Errors
/// As [`open_robot`].
pub fn open_robot_in_any_unit(path: &Path) -> Result<Robot, StudyError> {
    read_robot(path, Robot::from_json_in_any_unit)
}

/// The robot that a file in `folder` names by a path from there, or by its name in the library.
///
/// # Errors
/// As [`open_robot`].
pub(crate) fn open_robot_from(folder: &Path, name: &str) -> Result<Robot, StudyError> {
    let path = folder.join(name);
    match plain_name(Path::new(name)).map(|name| (name, named(ROBOTS, name))) {
        Some((_, Some(file))) if has_no_file(&path) => {
            read_from(&path, Some(file.text), InputKind::Robot, Robot::from_json)
        }
        Some((name, None)) if !path.exists() => Err(no_such_name(name, ROBOTS, InputKind::Robot)),
        _ => open_robot(&path),
    }
}

/// Reads a cable file, or the cable of the catalogue that has this name where no file has it.
///
/// # Errors
/// As [`open_robot`].
pub fn open_cable(path: &Path) -> Result<CatalogueCable, StudyError> {
    read_named(path, InputKind::Cable, CatalogueCable::from_json)
}

/// The file of a library that is called by a path: one without folders, where no file has that path.
pub(crate) fn named_file(library: &[LibraryFile], path: &Path) -> Option<LibraryFile> {
    named(library, plain_name(path)?).filter(|_| has_no_file(path))
}

/// Whether no file has this path. Results may be in a folder of the robot's name.
fn has_no_file(path: &Path) -> bool {
    !path.exists() || path.is_dir()
}

/// A path that could be a name in a library: without folders and extension.
fn plain_name(path: &Path) -> Option<&str> {
    let is_name = |name: &&str| !name.contains(['/', '\\']) && !name.ends_with(".json") && *name != "-";
    path.to_str().filter(is_name)
}

fn read_robot(path: &Path, read: fn(&str) -> Result<Robot, RobotError>) -> Result<Robot, StudyError> {
    read_named(path, InputKind::Robot, read)
}

fn read_named<T>(
    path: &Path,
    kind: InputKind,
    read: fn(&str) -> Result<T, RobotError>,
) -> Result<T, StudyError> {
    let library = if kind == InputKind::Cable { CABLES } else { ROBOTS };
    let file = named_file(library, path);
    match plain_name(path) {
        Some(name) if file.is_none() && !path.exists() => Err(no_such_name(name, library, kind)),
        _ => read_from(path, file.map(|file| file.text), kind, read),
    }
}

fn no_such_name(name: &str, library: &[LibraryFile], kind: InputKind) -> StudyError {
    let is_cable = kind == InputKind::Robot && named(CABLES, name).is_some();
    let mut near = near(library, name);
    near.extend(is_cable.then_some("the cable of that name"));
    StudyError::NoSuchName { name: name.to_owned(), kind, near: near.join(", ") }
}

/// Reads the text of a library, or else that of the file.
fn read_from<T>(
    path: &Path,
    text: Option<&'static str>,
    kind: InputKind,
    read: fn(&str) -> Result<T, RobotError>,
) -> Result<T, StudyError> {
    let text = text.map_or_else(|| read_text(path, kind), |text| Ok(text.to_owned()))?;
    read(&text).map_err(|source| {
        let other = other_kind(path, &text, kind);
        other.unwrap_or_else(|| StudyError::Robot { path: path.to_owned(), source })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_is_called_by_its_name_and_a_file_of_that_name_goes_first() {
        assert_eq!(open_robot(Path::new("cogiro")).unwrap().name, "CoGiRo");
        assert_eq!(open_cable(Path::new("steel-4mm")).unwrap().properties.diameter, Some(0.004));
        let folder = tempfile::tempdir().unwrap();
        let named = |name: &str| open_robot_from(folder.path(), name).unwrap().name;
        let error = open_robot_from(folder.path(), "cogira").unwrap_err().to_string();
        assert!(error.ends_with("near are cogiro"), "{error}");
        assert_eq!(named("cogiro"), "CoGiRo");
        std::fs::create_dir(folder.path().join("cogiro")).unwrap();
        assert_eq!(named("cogiro"), "CoGiRo");
        std::fs::remove_dir(folder.path().join("cogiro")).unwrap();
        let grab = named_file(ROBOTS, Path::new("grab")).unwrap().text;
        std::fs::write(folder.path().join("cogiro"), grab).unwrap();
        assert_eq!(named("cogiro"), "GRAB, 4 cables");
    }

    #[test]
    fn a_name_that_nothing_has_comes_back_with_those_that_are_near() {
        let message = |name: &str| open_robot(Path::new(name)).unwrap_err().to_string();
        assert_eq!(
            message("expo2015"),
            "no file and no robot of the library is called `expo2015`: near are expo2015-lucia, \
             expo2015-roberto, the cable of that name"
        );
        assert!(message("steel-2mm").ends_with("near are the cable of that name"));
        assert!(message("cogiro.json").starts_with("cannot read cogiro.json"));
        assert!(message("robots/cogiro").starts_with("cannot read robots/cogiro"));
        let error = open_cable(Path::new("steel")).unwrap_err().to_string();
        assert!(error.contains("no cable of the library is called `steel`: near are steel-"), "{error}");
    }
}
