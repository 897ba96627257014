//! A whole calibration, from measurements that were read to results, in a folder where one is wanted.

use crate::error::CalibrationError;
use crate::fit::{cross_validated, fit};
use crate::fitted::{Difference, Fit, FitSettings};
use crate::results::folder::{Calibrated, begin_calibration, write_calibration};
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

/// Fits and predicts, and writes all results to a folder if one is given; `report` makes its page.
///
/// # Errors
/// Those of [`fit`], and of the folder: [`CalibrationError::Study`].
pub fn carry_out(
    campaign: &Campaign,
    out: Option<(&Path, IfExists)>,
    report: impl FnOnce(&Robot, &CalibrationSummary, &Fit) -> String,
) -> Result<Calibrated, CalibrationError> {
    let Campaign { robot, unknowns, settings, .. } = campaign;
    let rows = &campaign.measured.rows;
    if campaign.folds > Campaign::MOST_FOLDS {
        let expected = format!("0 to {}", Campaign::MOST_FOLDS);
        return Err(CalibrationError::invalid("folds", campaign.folds, expected));
    }
    let folder = out.map(|(out, if_exists)| begin_calibration(out, if_exists)).transpose()?;
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
    let (calibrated, posterior) = (found.calibrated(&context, campaign.name), found.posterior(&context));
    let made = Calibrated { fit: found, robot: calibrated, posterior, summary, seconds };
    if let Some(folder) = folder {
        let page = report(robot, &made.summary, &made.fit);
        write_calibration(&folder, &made, &page)?;
    }
    Ok(made)
}
