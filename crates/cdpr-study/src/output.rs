//! Result files: observations as CSV, the summary as JSON.

use crate::atomic::write_json;
use crate::comparison::{ComparisonRow, compare};
use crate::error::StudyError;
use crate::poses::{PoseRow, PosesSummary};
use crate::robustness::{Answer, Refusal, RobustnessResult, RobustnessSummary, in_degrees};
use crate::sampling::SamplingSummary;
use crate::sensitivity::SensitivitySummary;
use crate::study::{Study, Surface};
use crate::surface::{SurfaceResult, SurfaceSummary};
use crate::workspace::WorkspaceSummary;
use cdpr_robot::Pose;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Name of the summary in a folder of results.
pub(crate) const SUMMARY_NAME: &str = "summary.json";

/// Everything a study found; `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

impl Summary {
    /// Of a study whose samplings and surfaces gave these results.
    pub fn new(study: &Study, studies: IndexMap<String, StudySummary>) -> Self {
        Self {
            study: study.file.name.clone(),
            robot: study.robot.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            payload: study.file.payload,
            seed: study.file.seed,
            comparison: compare(&study.file.comparison, &studies),
            studies,
        }
    }
}

/// Results of a sampling, at one pose or several, or of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum StudySummary {
    /// Of a sampling.
    Sampling(Box<SamplingSummary>),
    /// Of a surface.
    Surface(SurfaceSummary),
    /// Of a sampling at several poses.
    Poses(PosesSummary),
}

impl StudySummary {
    /// Title.
    pub fn title(&self) -> &str {
        match self {
            Self::Sampling(sampling) => &sampling.title,
            Self::Surface(surface) => &surface.title,
            Self::Poses(poses) => &poses.title,
        }
    }

    /// Observations or points of the grid, failed ones included.
    pub fn observations(&self) -> usize {
        match self {
            Self::Sampling(sampling) => sampling.observations,
            Self::Surface(surface) => surface.observations,
            Self::Poses(poses) => poses.observations,
        }
    }

    /// Failed ones by kind.
    pub fn failed(&self) -> &BTreeMap<String, usize> {
        match self {
            Self::Sampling(sampling) => &sampling.failed,
            Self::Surface(surface) => &surface.failed,
            Self::Poses(poses) => &poses.failed,
        }
    }
}

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

/// Removes a file of an earlier run, which what is to come would no longer belong to, if there is one.
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

/// Writes `NAME_sensitivity.csv`: one row an input, with what each measure says of it; shares and indices have no unit, a method
/// that has failed leaves its cells empty.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_sensitivity(
    folder: &Path,
    name: &str,
    sensitivity: &SensitivitySummary,
) -> Result<PathBuf, StudyError> {
    write_rows(folder.join(format!("{name}_sensitivity.csv")), &sensitivity.inputs)
}

/// Writes `NAME.csv` of a sampling at several poses: one row each.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_poses(folder: &Path, name: &str, rows: &[PoseRow]) -> Result<PathBuf, StudyError> {
    write_rows(folder.join(format!("{name}.csv")), rows)
}

/// Writes `summary.json`.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_summary(folder: &Path, summary: &Summary) -> Result<PathBuf, StudyError> {
    write_json(folder.join(SUMMARY_NAME), summary)
}

/// Writes `robustness.json`.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_robustness(folder: &Path, summary: &RobustnessSummary) -> Result<PathBuf, StudyError> {
    write_json(folder.join("robustness.json"), summary)
}

/// Writes `solves.csv`: one row a solve, with the true pose, the start, the pose found (position [m], rotation vector [rad]), how
/// far it is from the true one, outcome, reason of a failure, method, iterations, residuals and wall time.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_solves(folder: &Path, results: &[RobustnessResult]) -> Result<PathBuf, StudyError> {
    let pose = |name: &str| ["x", "y", "z", "rx", "ry", "rz"].map(|axis| format!("{name}_{axis}"));
    let header = ["protocol", "draw", "start_distance_m", "start_angle_deg", "start_anchor_distance_m"];
    let header = header
        .into_iter()
        .map(str::to_owned)
        .chain(["true", "start", "found"].iter().flat_map(|name| pose(name)));
    let rest = [
        "error_m",
        "error_deg",
        "error_anchor_distance_m",
        "outcome",
        "reason",
        "method",
        "iterations",
        "closure_m",
        "force_n",
        "moment_nm",
        "us",
    ];
    let header = header.chain(rest.map(str::to_owned)).collect();
    let rows = results.iter().flat_map(|result| {
        result.solves.iter().map(|solve| {
            let offset = &result.protocol.starts[solve.start_offset];
            let mut record = vec![result.protocol.name.to_owned(), solve.draw.to_string()];
            let start = [offset.distance, in_degrees(offset.angle), solve.start_distance];
            record.extend(start.iter().map(ToString::to_string));
            record.extend(pose_cells(&solve.wanted).into_iter().chain(pose_cells(&solve.start)));
            let (answer, reason) = match &solve.answer {
                Ok(answer) => (Some(answer), solve.failure().unwrap_or_default().to_owned()),
                Err(error) => (None, format!("{}: {error}", error.kind())),
            };
            let found = answer.map(|a| pose_cells(&a.pose));
            record.extend(found.unwrap_or_default());
            let cell = |value: fn(&Answer) -> String| answer.map(value).unwrap_or_default();
            record.extend([
                cell(|a| format!("{:e}", a.distance)),
                cell(|a| format!("{:e}", a.angle.to_degrees())),
            ]);
            record.extend([
                cell(|a| format!("{:e}", a.anchor_distance)),
                solve.outcome().name().to_owned(),
                reason,
            ]);
            record.extend([cell(|a| format!("{:?}", a.method)), cell(|a| a.iterations.to_string())]);
            record.extend([
                cell(|a| format!("{:e}", a.residual.closure)),
                cell(|a| format!("{:e}", a.residual.force)),
            ]);
            record
                .extend([cell(|a| format!("{:e}", a.residual.moment)), format!("{:.1}", solve.microseconds)]);
            record
        })
    });
    write_csv(folder.join("solves.csv"), header, rows)
}

/// Writes `refused.csv`: the poses drawn that are not looked for, with the reason.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_refused(folder: &Path, results: &[RobustnessResult]) -> Result<PathBuf, StudyError> {
    let header = ["protocol", "draw", "x", "y", "z", "rx", "ry", "rz", "status", "reason"];
    let rows = results.iter().flat_map(|result| {
        result.refused.iter().map(|refused| {
            let reason = match &refused.refusal {
                Refusal::Infeasible(error) => error.to_string(),
                Refusal::Unanswered(error) => format!("from the equilibrium: {error}"),
                Refusal::Unstable => "the direct model leaves the equilibrium".to_owned(),
            };
            let mut record = vec![result.protocol.name.to_owned(), refused.draw.to_string()];
            record.extend(pose_cells(&refused.pose));
            record.extend([refused.refusal.name().to_owned(), reason]);
            record
        })
    });
    write_csv(folder.join("refused.csv"), header.map(str::to_owned).into(), rows)
}

/// Writes `workspace.csv`, one row a position, and `workspace.json`, the same with settings and extremes.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_workspace(folder: &Path, summary: &WorkspaceSummary) -> Result<PathBuf, StudyError> {
    write_rows(folder.join("workspace.csv"), &summary.rows)?;
    write_json(folder.join("workspace.json"), summary)
}

/// Position [m] and rotation vector [rad].
fn pose_cells(pose: &Pose) -> [String; 6] {
    let motion = Pose::at(0.0, 0.0, 0.0).motion_to(pose);
    <[f64; 6]>::from(motion).map(|value| value.to_string())
}

/// Writes the figure `NAME.svg`.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_figure(folder: &Path, name: &str, svg: &str) -> Result<PathBuf, StudyError> {
    let path = folder.join(format!("{name}.svg"));
    write_text(&path, svg)?;
    Ok(path)
}

/// Writes a text to a file.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_text(path: &Path, text: &str) -> Result<(), StudyError> {
    std::fs::write(path, text).map_err(|source| StudyError::Write { path: path.to_owned(), source })
}

/// A table whose columns are the fields of its rows.
fn write_rows<T: Serialize>(path: PathBuf, rows: &[T]) -> Result<PathBuf, StudyError> {
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
        Err(error) => Err(unwritten(path, error)),
    }
}
