//! Result files of assessments: tables as CSV, summaries as JSON.

use crate::robustness::{Answer, Refusal, RobustnessResult, RobustnessSummary, in_degrees};
use crate::workspace::WorkspaceSummary;
use cdpr_robot::Pose;
use cdpr_study::{StudyError, write_csv, write_json, write_rows};
use std::path::{Path, PathBuf};

/// Writes `robustness.json`.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_robustness(folder: &Path, summary: &RobustnessSummary) -> Result<PathBuf, StudyError> {
    write_json(folder.join("robustness.json"), summary)
}

/// Writes `solves.csv`: one row for each solve, with the true pose, the start, the pose found (position [m],
/// rotation vector [rad]), how
/// far it is from the true one, outcome, reason of a failure, method, iterations, residuals and wall time.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_solves(folder: &Path, results: &[RobustnessResult]) -> Result<PathBuf, StudyError> {
    let pose = |name: &str| Pose::COORDINATES.map(|axis| format!("{name}_{axis}"));
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

/// Writes `refused.csv`: the rejected poses with the reason.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_refused(folder: &Path, results: &[RobustnessResult]) -> Result<PathBuf, StudyError> {
    let header = ["protocol", "draw"].into_iter().chain(Pose::COORDINATES).chain(["status", "reason"]);
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
    write_csv(folder.join("refused.csv"), header.map(str::to_owned).collect(), rows)
}

/// Writes `workspace.csv`, one row for each position, and `workspace.json`, the same with settings and
/// extremes.
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
