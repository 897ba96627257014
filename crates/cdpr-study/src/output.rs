//! Result files: observations as CSV, the summary as JSON.

use crate::comparison::ComparisonRow;
use crate::error::StudyError;
use crate::observation::Observations;
use crate::sampling::SamplingSummary;
use crate::study::{Sampling, Surface};
use crate::surface::{SurfaceResult, SurfaceSummary};
use cdpr_sensitivity::SampleDesign;
use indexmap::IndexMap;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Everything a study found; `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Name of the study.
    pub study: String,
    /// Name of the robot.
    pub robot: String,
    /// Version of the program.
    pub version: String,
    /// Mass added [kg].
    pub payload: f64,
    /// Seed.
    pub seed: u64,
    /// Results by name.
    pub studies: IndexMap<String, StudySummary>,
    /// Published figures beside the computed ones.
    pub comparison: Vec<ComparisonRow>,
}

/// Results of a sampling or a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum StudySummary {
    /// Of a sampling.
    Sampling(Box<SamplingSummary>),
    /// Of a surface.
    Surface(SurfaceSummary),
}

/// Makes the folder for results and checks that files can be written in it: before anything is computed.
///
/// # Errors
/// [`StudyError::Write`].
pub fn check_folder(folder: &Path) -> Result<(), StudyError> {
    let write = |source| StudyError::Write { path: folder.to_owned(), source };
    std::fs::create_dir_all(folder).map_err(write)?;
    let probe = folder.join(".writable");
    std::fs::write(&probe, b"").map_err(write)?;
    std::fs::remove_file(&probe).map_err(write)
}

/// Removes the summary of an earlier run, which the tables to come would no longer belong to.
///
/// # Errors
/// [`StudyError::Write`].
pub fn remove_summary(folder: &Path) -> Result<(), StudyError> {
    let path = folder.join("summary.json");
    match std::fs::remove_file(&path) {
        Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
            Err(StudyError::Write { path, source })
        }
        _ => Ok(()),
    }
}

/// Writes `NAME.csv`: one row an observation, with the deviation of each parameter from its nominal value (`d_mass`, ... in
/// SI units), dp, RMS, status and reason.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_observations(
    folder: &Path,
    sampling: &Sampling,
    observations: &Observations,
) -> Result<PathBuf, StudyError> {
    let inputs = sampling.design.inputs();
    let header = ["index".to_owned()]
        .into_iter()
        .chain(inputs.iter().map(|input| format!("d_{}", input.name)))
        .chain(["dx_mm", "dy_mm", "dz_mm", "rms_mm", "status", "reason"].map(str::to_owned));
    let mut row = vec![0.0; inputs.len()];
    let rows = observations.outcomes.iter().enumerate().map(|(index, outcome)| {
        // The index is below the number of points and the row as long as the inputs.
        let drawn = sampling.design.row(index, &mut row);
        debug_assert_eq!(drawn, Ok(()));
        let mut record = vec![index.to_string()];
        record.extend(row.iter().map(ToString::to_string));
        match outcome {
            Ok(observation) => {
                record.extend(observation.displacement.iter().map(|d| (1e3 * d).to_string()));
                record.extend([observation.rms_mm().to_string(), "ok".to_owned(), String::new()]);
            }
            Err(error) => {
                record.extend(std::iter::repeat_n(String::new(), 4));
                record.extend([error.kind().to_owned(), error.to_string()]);
            }
        }
        record
    });
    write_csv(folder.join(format!("{}.csv", sampling.name)), header.collect(), rows)
}

/// Writes `NAME.csv`: one row a grid point, with the values of both parameters (in SI units), RMS and status.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_surface(
    folder: &Path,
    surface: &Surface,
    result: &SurfaceResult,
) -> Result<PathBuf, StudyError> {
    let header =
        vec![surface.x.0.to_string(), surface.y.0.to_string(), "rms_mm".to_owned(), "status".to_owned()];
    let columns = result.y.len();
    let rows = result.rms_mm.iter().enumerate().map(|(k, rms)| {
        let (value, status) = match rms {
            Ok(rms) => (rms.to_string(), "ok"),
            Err(error) => (String::new(), error.kind()),
        };
        vec![result.x[k / columns].to_string(), result.y[k % columns].to_string(), value, status.to_owned()]
    });
    write_csv(folder.join(format!("{}.csv", surface.name)), header, rows)
}

/// Writes `summary.json`.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_summary(folder: &Path, summary: &Summary) -> Result<PathBuf, StudyError> {
    let path = folder.join("summary.json");
    let text = serde_json::to_string_pretty(summary)
        .map_err(|error| StudyError::Write { path: path.clone(), source: error.into() })?;
    std::fs::write(&path, text + "\n").map_err(|source| StudyError::Write { path: path.clone(), source })?;
    Ok(path)
}

/// Writes the figure `NAME.svg`.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_figure(folder: &Path, name: &str, svg: &str) -> Result<PathBuf, StudyError> {
    let path = folder.join(format!("{name}.svg"));
    std::fs::write(&path, svg).map_err(|source| StudyError::Write { path: path.clone(), source })?;
    Ok(path)
}

fn write_csv(
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
        Err(error) => Err(StudyError::Write { path, source: error.into() }),
    }
}
