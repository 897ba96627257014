//! A folder of results read back, for reports and comparisons.

use crate::analysis::keys::To;
use crate::analysis::part::StudySummary;
use crate::analysis::poses::{PoseRow, PosesSummary};
use crate::analysis::summary::Summary;
use crate::analysis::surface::{SurfaceResult, SurfaceSummary};
use crate::error::StudyError;
use crate::fs::input::read_text;
use crate::fs::lock::{Access, hold_still};
use crate::fs::manifest::{Manifest, ResultsOf, check_tables, read};
use crate::fs::owned::ResultsFolder;
use crate::fs::single::{IfExists, write_file};
use crate::kind::InputKind;
use crate::model::study::Study;
use crate::names::{REPORT_NAME, STUDY_NAME, SUMMARY_NAME, TIMINGS_NAME};
use crate::results::write::Timings;
use crate::store::folder::check_hash;
use cdpr_robot::from_json;
use indexmap::IndexMap;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The content of a folder of results, except the observations.
#[derive(Clone, Debug)]
pub struct Results {
    /// The study with its robot, from `study.json`.
    pub study: Study,
    /// The text of `study.json`.
    pub study_json: String,
    /// The text of the robot file that it names.
    pub robot_json: String,
    /// `summary.json`.
    pub summary: Summary,
    /// The tables of the surfaces by name; a point that failed has the kind of its failure.
    pub surfaces: IndexMap<String, SurfaceResult<String>>,
    /// The tables of the samplings at several poses by name.
    pub poses: IndexMap<String, Vec<PoseRow>>,
    /// `timings.json`, if there is such a file.
    pub timings: Option<Timings>,
}

impl Results {
    /// Reads the folder that a run of a study has written.
    ///
    /// # Errors
    /// [`StudyError`] naming the missing or invalid file, with field and reason; [`StudyError::FolderBusy`]
    /// where a process writes into the folder, [`StudyError::Mixed`] for files of different studies,
    /// [`StudyError::Changed`] for a file that was changed since.
    pub fn read(folder: &Path) -> Result<Self, StudyError> {
        let _lock = hold_still(folder)?;
        let list = Manifest::read(folder)?;
        let listed = |name: &str| read(folder, list.as_ref(), name);
        let path = folder.join(STUDY_NAME);
        let study = Study::open(&path)?;
        let robot_json = listed(&study.file.robot)?;
        let hash = study.hash()?;
        check_hash(folder, list.as_ref(), &hash)?;
        let study_json = listed(STUDY_NAME)?;
        let path = folder.join(SUMMARY_NAME);
        if !path.exists() {
            return Err(StudyError::NotAnalysed { folder: folder.to_owned() });
        }
        let summary = read_summary(&path)?;
        if !summary.hash.is_empty() && summary.hash != hash {
            return Err(StudyError::Mixed { path, found: summary.hash, expected: hash });
        }
        listed(SUMMARY_NAME)?;
        list.iter().try_for_each(|list| check_tables(folder, list))?;
        let (mut surfaces, mut poses) = (IndexMap::new(), IndexMap::new());
        for (name, found) in &summary.studies {
            let table = format!("{name}.csv");
            let path = folder.join(&table);
            match found {
                StudySummary::Surface(surface) => {
                    surfaces.insert(name.clone(), read_surface(&path, &listed(&table)?, surface)?);
                }
                StudySummary::Poses(summary) => {
                    poses.insert(name.clone(), read_poses(&path, &listed(&table)?, summary)?);
                }
                StudySummary::Sampling(_) => (),
            }
        }
        // Times differ from run to run: they have no digest.
        let timings = match read_json(&folder.join(TIMINGS_NAME)) {
            Err(StudyError::Read { source, .. }) if source.kind() == std::io::ErrorKind::NotFound => None,
            timings => Some(timings?),
        };
        Ok(Self { study, study_json, robot_json, summary, surfaces, poses, timings })
    }

    /// Writes a report of these results, which were read from this folder, into it.
    ///
    /// # Errors
    /// [`StudyError::NoResults`] for another file in its place, [`StudyError::Changed`] for a report that was
    /// changed since it was written, [`StudyError::FolderBusy`] where a process
    /// writes into the folder, [`StudyError::NotAnalysed`] where one has done so since the results were read,
    /// [`StudyError::Write`].
    pub fn write_report(&self, folder: &Path, page: &str) -> Result<PathBuf, StudyError> {
        if Manifest::read(folder)?.is_none() {
            // Of an earlier version.
            let path = folder.join(REPORT_NAME);
            write_file(&path, page, IfExists::Refuse)?;
            return Ok(path);
        }
        let owned = ResultsFolder::take(folder, ResultsOf::Study, Access::Alone, |name| name == REPORT_NAME)?;
        let path = folder.join(SUMMARY_NAME);
        if !path.exists() || read_summary(&path)? != self.summary {
            return Err(StudyError::NotAnalysed { folder: folder.to_owned() });
        }
        owned.remove_unfinished()?;
        let path = owned.write(REPORT_NAME, page.as_bytes())?;
        owned.list_written()?;
        Ok(path)
    }
}

fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, StudyError> {
    from_json(&read_text(path, InputKind::Results)?)
        .map_err(|source| StudyError::Format { path: path.to_owned(), source })
}

/// Reads `summary.json`, whose names depend on the output.
fn read_summary(path: &Path) -> Result<Summary, StudyError> {
    let mut summary: Value = read_json(path)?;
    if !summary.get_mut("studies").is_some_and(|studies| To::Memory.studies(studies)) {
        return read_json(path);
    }
    // Lines are as in the file.
    from_json(&format!("{summary:#}")).map_err(|source| StudyError::Format { path: path.to_owned(), source })
}

/// Reads the table of a sampling at several poses.
fn read_poses(path: &Path, text: &str, summary: &PosesSummary) -> Result<Vec<PoseRow>, StudyError> {
    let text = To::Memory.table(summary.output, text);
    let rows = csv::Reader::from_reader(text.as_bytes()).into_deserialize().enumerate();
    let row = |(k, row): (usize, Result<PoseRow, csv::Error>)| {
        row.map_err(|error| {
            StudyError::invalid(path, &format!("row {}", k + 1), error, "a pose and its results")
        })
    };
    let rows: Vec<_> = rows.map(row).collect::<Result<_, _>>()?;
    if rows.len() != summary.poses {
        return Err(StudyError::invalid(path, "rows", rows.len(), &format!("{}, one a pose", summary.poses)));
    }
    Ok(rows)
}

/// Reads the table that `write_surface` has written: the second parameter runs faster.
fn read_surface(
    path: &Path,
    text: &str,
    summary: &SurfaceSummary,
) -> Result<SurfaceResult<String>, StudyError> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut points = Vec::new();
    let expected = format!("two parameters, {} and status", summary.output.name());
    for (k, record) in reader.deserialize::<(f64, f64, Option<f64>, String)>().enumerate() {
        let (x, y, value, status) =
            record.map_err(|error| StudyError::invalid(path, &format!("row {}", k + 1), error, &expected))?;
        points.push((x, y, value.ok_or(status)));
    }
    let columns = points.iter().take_while(|point| point.0 == points[0].0).count();
    let whole = columns > 0 && points.len() % columns == 0 && points.len() == summary.observations;
    let same = |k: usize| points[k].0 == points[k - k % columns].0 && points[k].1 == points[k % columns].1;
    if !(whole && (0..points.len()).all(same)) {
        let expected =
            format!("a grid of {} points, the second parameter running faster", summary.observations);
        return Err(StudyError::invalid(path, "rows", points.len(), &expected));
    }
    Ok(SurfaceResult {
        x: points.iter().step_by(columns).map(|point| point.0).collect(),
        y: points[..columns].iter().map(|point| point.1).collect(),
        values: points.into_iter().map(|(.., value)| value).collect(),
    })
}
