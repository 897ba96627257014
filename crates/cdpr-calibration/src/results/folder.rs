//! The folder of results.

use crate::error::CalibrationError;
use crate::fitted::Fit;
use crate::results::summary::CalibrationSummary;
use cdpr_robot::{Pose, Robot};
use cdpr_study::{ErrorsFile, IfExists, ResultsFolder, ResultsOf, StudyError};
use std::path::Path;

/// Name of the calibrated robot in a folder of results.
pub const CALIBRATED_NAME: &str = "calibrated.json";

/// Name of what is known of its errors.
pub const POSTERIOR_NAME: &str = "posterior.json";

const SUMMARY_NAME: &str = "summary.json";

const RESIDUALS_NAME: &str = "residuals.csv";

const POSES_NAME: &str = "poses.csv";

const REPORT_NAME: &str = "report.html";

/// Columns of a pose.
const COORDINATES: [&str; 7] = ["x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"];

/// What a calibration has made.
#[derive(Clone, Debug)]
pub struct Calibrated {
    /// The fit.
    pub fit: Fit,
    /// The robot that was found, with where its values come from.
    pub robot: Robot,
    /// What is known of its errors.
    pub posterior: ErrorsFile,
    /// The summary.
    pub summary: CalibrationSummary,
    /// Time of the fit [s].
    pub seconds: f64,
}

/// Makes a folder for a calibration, or takes one of an earlier calibration: before anything is computed.
///
/// # Errors
/// As [`ResultsFolder::begin`].
pub(crate) fn begin_calibration(folder: &Path, if_exists: IfExists) -> Result<ResultsFolder, StudyError> {
    let names = [CALIBRATED_NAME, POSTERIOR_NAME, SUMMARY_NAME, RESIDUALS_NAME, POSES_NAME, REPORT_NAME];
    ResultsFolder::begin(folder, ResultsOf::Calibration, if_exists, |name| names.contains(&name))
}

/// Writes `calibrated.json`, `posterior.json`, `residuals.csv`, `poses.csv`, `report.html` and, last
/// of all, `summary.json`.
///
/// # Errors
/// As [`ResultsFolder::claim`].
pub(crate) fn write_calibration(
    folder: &ResultsFolder,
    made: &Calibrated,
    report: &str,
) -> Result<(), CalibrationError> {
    let Calibrated { fit: found, robot, posterior, summary, .. } = made;
    folder.remove(SUMMARY_NAME)?;
    folder.write(CALIBRATED_NAME, (robot.to_json() + "\n").as_bytes())?;
    folder.write_json(POSTERIOR_NAME, posterior)?;
    let header =
        ["line", "column", "unit", "before", "after", "std", "standardized_after"].map(str::to_owned);
    let rows = found.before.iter().zip(&found.after).map(|(before, after)| {
        vec![
            after.line.to_string(),
            after.quantity.to_string(),
            after.quantity.unit().to_owned(),
            before.difference.to_string(),
            after.difference.to_string(),
            after.std.to_string(),
            after.standardized().to_string(),
        ]
    });
    folder.write_csv(RESIDUALS_NAME, header.to_vec(), rows)?;
    let header = ["line"].into_iter().map(str::to_owned);
    let header = header.chain(COORDINATES.map(str::to_owned));
    let header = header.chain(COORDINATES.map(|name| format!("{name}_before")));
    let numbers = |pose: &Pose| {
        let Pose { position, .. } = pose;
        [position.as_slice(), &pose.quaternion()].concat().into_iter().map(|number| number.to_string())
    };
    let rows = found.lines.iter().zip(found.poses.iter().zip(&found.poses_before));
    let rows = rows.map(|(line, (after, before))| {
        [line.to_string()].into_iter().chain(numbers(after)).chain(numbers(before)).collect()
    });
    folder.write_csv(POSES_NAME, header.collect(), rows)?;
    folder.write(REPORT_NAME, report.as_bytes())?;
    folder.conclude(SUMMARY_NAME, summary, &[])?;
    Ok(())
}
