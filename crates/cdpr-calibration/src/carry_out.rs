//! A whole calibration, from measurements that were read to results, in a folder where one is wanted.

use crate::campaign::Row;
use crate::error::CalibrationError;
use crate::fit::{cross_validated, fit};
use crate::fitted::{Difference, Fit, FitSettings};
use crate::results::folder::{Calibrated, begin_calibration, write_calibration};
use crate::results::summary::{CalibrationSummary, Campaign};
use cdpr_robot::Robot;
use cdpr_study::IfExists;
use std::borrow::Cow;
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
    if campaign.folds > Campaign::MOST_FOLDS {
        let expected = format!("0 to {}", Campaign::MOST_FOLDS);
        return Err(CalibrationError::invalid("folds", campaign.folds, expected));
    }
    let folder = out.map(|(out, if_exists)| begin_calibration(out, if_exists)).transpose()?;
    let clock = Instant::now();
    let name_columns = |error| campaign.measured.name_columns(error);
    let (rows, factor) = with_noise(campaign).map_err(name_columns)?;
    let rows = &rows[..];
    let found = fit(robot, rows, unknowns, settings).map_err(name_columns)?;
    let seconds = clock.elapsed().as_secs_f64();
    let folds = campaign.folds.min(rows.len());
    let predicted: Option<Vec<Difference>> =
        if folds < 2 { None } else { cross_validated(robot, rows, unknowns, settings, folds).ok() };
    let mut summary = found.summary(campaign, predicted.as_deref());
    summary.noise_scale *= factor;
    let (calibrated, posterior) = (found.calibrated(campaign), found.posterior(campaign));
    let made = Calibrated { fit: found, robot: calibrated, posterior, summary, seconds };
    if let Some(folder) = folder {
        let page = report(robot, &made.summary, &made.fit);
        write_calibration(&folder, &made, &page)?;
    }
    Ok(made)
}

/// Times that noise is estimated at most.
const ROUNDS: usize = 6;

/// Change of the noise by which it agrees with the residuals.
const AGREES: f64 = 0.02;

/// The rows with their noise. Where none is stated, it is what the residuals show, by one factor for all
/// sensors: otherwise priors would count for nothing next to measurements that are nearly exact, and
/// everything would be identifiable.
fn with_noise<'a>(campaign: &Campaign<'a>) -> Result<(Cow<'a, [Row]>, f64), CalibrationError> {
    let Campaign { robot, unknowns, settings, measured, .. } = *campaign;
    let (mut rows, mut factor) = (Cow::Borrowed(&measured.rows[..]), 1.0);
    if measured.noise_is_stated {
        return Ok((rows, factor));
    }
    let settings = FitSettings { starts: 1, ..settings };
    for _ in 0..ROUNDS {
        let found = fit(robot, &rows, unknowns, &settings)?;
        let scale = found.noise_scale(false).max(LEAST);
        if (scale - 1.0).abs() < AGREES {
            break;
        }
        factor *= scale;
        let readings = rows.to_mut().iter_mut().flat_map(|row| &mut row.readings);
        readings.for_each(|reading| reading.std *= scale);
    }
    Ok((rows, factor))
}

/// The least factor of the noise at a time: residuals of simulated measurements may be zero.
const LEAST: f64 = 1e-2;
