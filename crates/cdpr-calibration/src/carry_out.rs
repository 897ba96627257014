//! A whole calibration, from measurements that were read to results, in a folder where one is wanted.

use crate::error::CalibrationError;
use crate::fit::{cross_validated, fit};
use crate::fitted::{Difference, Fit};
use crate::results::folder::{Calibrated, begin_calibration, write_calibration};
use crate::results::summary::{CalibrationSummary, Campaign};
use cdpr_robot::Robot;
use cdpr_study::IfExists;
use std::path::Path;
use std::time::Instant;

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
    let summary = found.summary(campaign, predicted.as_deref());
    let (calibrated, posterior) = (found.calibrated(campaign), found.posterior(campaign));
    let made = Calibrated { fit: found, robot: calibrated, posterior, summary, seconds };
    if let Some(folder) = folder {
        let page = report(robot, &made.summary, &made.fit);
        write_calibration(&folder, &made, &page)?;
    }
    Ok(made)
}
