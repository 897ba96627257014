//! `cdpr robot import`: a robot file made of the files of another program.

use crate::program::arguments::endings;
use crate::program::arguments::{self, Overwrite, components};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, print_sentence};
use crate::program::questions;
use cdpr_exchange::{ForeignFile, ImportOptions, Imported, NoteKind, import};
use cdpr_robot::{TensionLimits, counted, plausible, shown};
use cdpr_study::{InputKind, StudyError, open_cable, other_kind, read_text};
use std::path::{Path, PathBuf};

/// Files of another program, and what they lack.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Files: bodies and cables of CASPR or the folder that has them, a .wcrfx file of WireX, a model of
    /// MuJoCo, YAML of oKermorgant's cdpr or the SDF made of it, JSON of IRMA, a system of MoorPy or MoorDyn,
    /// or a table of points (CSV). FILE:SET is another cable set of CASPR than the default one.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Robot file to write; if left out, it is printed.
    #[arg(short, long, value_parser = endings::json())]
    out: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    /// Cable of all cables: a cable file (JSON, `cdpr-cable/1`) or a name in the catalogue, `steel-4mm`.
    #[arg(long)]
    cable: Option<PathBuf>,
    /// Mass of the platform [kg], instead of that in the files.
    #[arg(long, value_parser = arguments::payload, allow_hyphen_values = true)]
    mass: Option<f64>,
    /// Centre of mass in the platform frame: x,y,z [m], instead of that in the files.
    #[arg(long, value_parser = components::<3>, allow_hyphen_values = true)]
    center_of_mass: Option<[f64; 3]>,
    /// Least and greatest tension of every cable: min,max [N], instead of those in the files.
    #[arg(long, value_parser = components::<2>, allow_hyphen_values = true)]
    tension_limits: Option<[f64; 2]>,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let mut files = Vec::new();
    let mut cable_set = None;
    for path in &settings.files {
        let (path, set) = with_set(path);
        cable_set = set.or(cable_set);
        for path in of_folder(&path)? {
            let text = read_text(&path, InputKind::Foreign)?;
            if let Some(own) = other_kind(&path, &text, InputKind::Foreign) {
                return Err(own.into());
            }
            files.push(ForeignFile { name: path.display().to_string(), text });
        }
    }
    let options = ImportOptions {
        cable: settings.cable.as_deref().map(open_cable).transpose()?,
        mass: settings.mass,
        center_of_mass: settings.center_of_mass.map(Into::into),
        tension_limits: settings.tension_limits.map(|[min, max]| TensionLimits { min, max }),
        cable_set,
    };
    let Imported { robot, notes } = import(&files, &options)?;
    questions::ask(plausible::robot(&robot));
    let text = format!("{}\n", robot.to_json());
    let mut lines = Vec::new();
    for note in &notes {
        let kind = match note.kind {
            NoteKind::Assumed => "assumed",
            NoteKind::Questioned => "questioned",
            NoteKind::NoPlace => "no place for",
        };
        let place =
            note.place.as_ref().map(|(file, line)| format!("{file}, line {line}: ")).unwrap_or_default();
        lines.push(format!("{kind}: {place}{}", note.text));
    }
    match &settings.out {
        Some(out) => {
            settings.overwrite.write(out, &text)?;
            println!("{}: {}, {}", out.display(), shown(&robot.name), counted(robot.cables.len(), "cable"));
            lines.iter().for_each(|line| print_sentence(line));
        }
        None => {
            println!("{}", text.trim_end());
            lines.iter().for_each(|line| eprintln!("{line}"));
        }
    }
    let questioned = notes.iter().any(|note| note.kind == NoteKind::Questioned);
    Ok(if questioned { Ending::SomethingWrong } else { Ending::Well })
}

/// The path and the cable set in `PATH:SET`.
fn with_set(path: &Path) -> (PathBuf, Option<String>) {
    let text = path.to_string_lossy();
    match text.rsplit_once(':') {
        Some((before, set)) if !path.exists() && Path::new(before).exists() => {
            (PathBuf::from(before), Some(set.to_owned()))
        }
        _ => (path.to_owned(), None),
    }
}

/// The files of CASPR in a folder; any other path itself.
fn of_folder(path: &Path) -> Result<Vec<PathBuf>, StudyError> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let unread = |source| StudyError::Read { path: path.to_owned(), source };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(path).map_err(unread)? {
        let path = entry.map_err(unread)?.path();
        if path.extension().is_some_and(|extension| extension == "xml") {
            files.push(path);
        }
    }
    files.sort();
    if files.is_empty() {
        let expected = "a folder with the XML files of CASPR";
        return Err(StudyError::setting("FILE", path.display(), expected));
    }
    Ok(files)
}
