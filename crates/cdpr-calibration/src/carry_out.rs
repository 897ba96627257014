//! A whole calibration, from measurements that were read to a folder of results.

use crate::error::CalibrationError;
use crate::fit::{cross_validated, fit};
use crate::fitted::{Difference, Fit, FitSettings};
use crate::results::folder::{begin_calibration, write_calibration};
use crate::results::summary::{CalibrationSummary, Context};
use crate::table::Measurements;
use crate::unknowns::Unknowns;
use cdpr_robot::Robot;
use cdpr_study::{ErrorModel, IfExists};
use std::path::Path;
use std::time::Instant;

/// What a calibration takes.
#[derive(Clone, Copy, Debug)]
pub struct Campaign<'a> {
    /// The robot before.
    pub robot: &'a Robot,
    /// The tolerances, if they are known.
    pub prior: Option<&'a ErrorModel>,
    /// What is sought.
    pub unknowns: &'a Unknowns,
    /// What was measured.
    pub measured: &'a Measurements,
    /// Name of the file of measurements, for the provenance of the robot.
    pub name: &'a str,
    /// How the fit is made.
    pub settings: FitSettings,
    /// Parts that are predicted by robots calibrated without them; below 2 none, at most one a row.
    pub folds: usize,
}

impl Campaign<'_> {
    /// Parts at most.
    pub const MOST_FOLDS: usize = 10_000;
}

/// What a calibration has made.
#[derive(Clone, Debug)]
pub struct Calibrated {
    /// The fit.
    pub fit: Fit,
    /// The summary, as it was written.
    pub summary: CalibrationSummary,
    /// Time of the fit [s].
    pub seconds: f64,
}

/// Fits, predicts and writes all results to the folder `out`; `report` makes the page.
///
/// # Errors
/// Those of [`fit`], [`begin_calibration`] and [`write_calibration`].
pub fn carry_out(
    campaign: &Campaign,
    out: &Path,
    if_exists: IfExists,
    report: impl FnOnce(&Robot, &CalibrationSummary, &Fit) -> String,
) -> Result<Calibrated, CalibrationError> {
    let Campaign { robot, unknowns, settings, .. } = campaign;
    let rows = &campaign.measured.rows;
    if campaign.folds > Campaign::MOST_FOLDS {
        let expected = format!("0 to {}", Campaign::MOST_FOLDS);
        return Err(CalibrationError::invalid("folds", campaign.folds, expected));
    }
    let folder = begin_calibration(out, if_exists)?;
    let clock = Instant::now();
    let found = fit(robot, rows, unknowns, settings)?;
    let seconds = clock.elapsed().as_secs_f64();
    let folds = campaign.folds.min(rows.len());
    let predicted: Option<Vec<Difference>> =
        if folds < 2 { None } else { cross_validated(robot, rows, unknowns, settings, folds).ok() };
    let context = Context {
        nominal: robot,
        prior: campaign.prior,
        noise_is_stated: campaign.measured.noise_is_stated,
        predicted: predicted.as_deref(),
        rows: rows.len(),
    };
    let summary = found.summary(&context, rows);
    let page = report(robot, &summary, &found);
    write_calibration(&folder, &found, &summary, &context, campaign.name, Some(&page))?;
    Ok(Calibrated { fit: found, summary, seconds })
}
