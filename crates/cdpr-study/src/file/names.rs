//! Names of tables and figures in a folder of results: which are of a study, and that no two parts of it
//! write the same.

use crate::error::StudyError;
use crate::file::study_file::{SamplingSpec, StudyFile};
use crate::fs::files::remove_stale;
use std::path::Path;

/// Figures of the study as a whole.
const OF_ALL: [&str; 3] = ["robot", "anchor_points", "exit_points"];

impl SamplingSpec {
    /// Whether a table or figure has the sampling's name with this behind it.
    fn has_further(&self, rest: &str) -> bool {
        if self.poses.is_none() {
            return ["_effects", "_sensitivity"].contains(&rest);
        }
        // Each layer of a box has maps of its own.
        let map = match rest.rsplit_once("_z") {
            Some((map, layer)) if is_number(layer) => map,
            _ => rest,
        };
        ["_mean", "_std", "_dominant"].contains(&map)
    }
}

impl StudyFile {
    /// Who writes a table or figure of this name, without its ending, though itself called otherwise.
    pub(crate) fn other_writer(&self, name: &str) -> Option<String> {
        if OF_ALL.contains(&name) {
            return Some("the study as a whole".to_owned());
        }
        let mut samplings = self.samplings.iter();
        let further = |(sampling, spec): &(&String, &SamplingSpec)| {
            name.strip_prefix(sampling.as_str()).is_some_and(|rest| spec.has_further(rest))
        };
        samplings.find(further).map(|(sampling, _)| format!("samplings.{sampling}"))
    }

    fn writes(&self, name: &str) -> bool {
        self.samplings.contains_key(name)
            || self.surfaces.contains_key(name)
            || self.other_writer(name).is_some()
    }
}

/// Removes the tables and figures of a study from a folder of results.
///
/// # Errors
/// [`StudyError::Read`], [`StudyError::Write`].
pub(crate) fn remove_files(folder: &Path, study: &StudyFile) -> Result<(), StudyError> {
    remove_where(folder, &["csv", "parquet", "svg"], |name| study.writes(name))?;
    for (name, _) in study.samplings.iter().filter(|(_, spec)| spec.poses.is_some()) {
        // Tables of the observations at each pose.
        let tables = folder.join(name);
        if tables.is_dir() {
            remove_where(&tables, &["csv", "parquet"], is_number)?;
            // One that still holds something stays.
            let _ = std::fs::remove_dir(&tables);
        }
    }
    Ok(())
}

/// Removes the files right in a folder with one of these endings whose names without it are meant.
fn remove_where(folder: &Path, endings: &[&str], meant: impl Fn(&str) -> bool) -> Result<(), StudyError> {
    let read = |source| StudyError::Read { path: folder.to_owned(), source };
    for entry in std::fs::read_dir(folder).map_err(read)? {
        let path = entry.map_err(read)?.path();
        let (name, ending) = (path.file_stem(), path.extension());
        let [Some(name), Some(ending)] = [name, ending].map(|part| part.and_then(|part| part.to_str()))
        else {
            continue;
        };
        if endings.contains(&ending) && meant(name) {
            remove_stale(path)?;
        }
    }
    Ok(())
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|digit| digit.is_ascii_digit())
}
