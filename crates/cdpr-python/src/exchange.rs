//! Robots from and for other programs, and those that come with the package.

use crate::assess::single;
use crate::convert::{Answer, Numbers, Raised, components, guarded, run};
use crate::robot::Robot;
use cdpr_exchange::{Exported, ForeignFile, ImportOptions, Imported, NoteKind, Target};
use cdpr_robot::TensionLimits;
use cdpr_robot::library::{CABLES, LibraryFile, ROBOTS};
use cdpr_study::{InputKind, open_cable, read_text};
use pyo3::prelude::*;
use std::path::PathBuf;

/// Names of the robots and of the cables that come with the package.
#[pyfunction]
pub(crate) fn library() -> (Vec<&'static str>, Vec<&'static str>) {
    let names = |files: &[LibraryFile]| files.iter().map(|file| file.name).collect();
    (names(ROBOTS), names(CABLES))
}

/// Kind, file and line, sentence.
type Note = (&'static str, Option<(String, usize)>, String);
/// End of the file's name, text.
type NamedText = (&'static str, String);

/// A robot of the files of another program, and notes.
#[pyfunction]
pub(crate) fn import_robot(
    files: Vec<PathBuf>,
    cable: Option<PathBuf>,
    mass: Option<f64>,
    center_of_mass: Option<Numbers>,
    tension_limits: Option<Numbers>,
    cable_set: Option<String>,
) -> Answer<(Robot, Vec<Note>)> {
    let read = |path: &PathBuf| -> Answer<ForeignFile> {
        Ok(ForeignFile { name: path.display().to_string(), text: read_text(path, InputKind::Foreign)? })
    };
    let files = files.iter().map(read).collect::<Answer<Vec<_>>>()?;
    let options = ImportOptions {
        cable: cable.as_deref().map(open_cable).transpose()?,
        mass,
        center_of_mass: match center_of_mass {
            Some(point) => Some(components("center_of_mass", &point)?.into()),
            None => None,
        },
        tension_limits: match tension_limits {
            Some(limits) => {
                let [min, max] = components("tension_limits", &limits)?;
                Some(TensionLimits { min, max })
            }
            None => None,
        },
        cable_set,
    };
    let Imported { robot, notes } = guarded(|| cdpr_exchange::import(&files, &options))??;
    let kind = |kind| match kind {
        NoteKind::Assumed => "assumed",
        NoteKind::Questioned => "questioned",
        NoteKind::NoPlace => "no place for",
    };
    let notes = notes.into_iter().map(|note| (kind(note.kind), note.place, note.text)).collect();
    Ok((Robot { robot }, notes))
}

/// The files of a robot for another program by the ends of their names, and notes.
#[pyfunction]
pub(crate) fn export_robot(
    py: Python,
    robot: &Robot,
    pose: Numbers,
    to: &str,
) -> Answer<(Vec<NamedText>, Vec<String>)> {
    let Some((target, _)) = Target::NAMED.into_iter().find(|(_, name)| *name == to) else {
        let names = Target::NAMED.map(|(_, name)| name).join(", ");
        return Err(Raised::Input(format!("to is {to:?}: expected one of {names}")));
    };
    let pose = single(&pose, &robot.robot)?;
    let Exported { files, notes } = run(py, |_| cdpr_exchange::export(&robot.robot, &pose, target))??;
    Ok((files, notes))
}
