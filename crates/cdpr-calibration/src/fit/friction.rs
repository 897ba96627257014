//! The friction of pulleys from a table of tensions at the winches.

mod history;

use crate::error::CalibrationError;
use crate::fit::friction::history::{History, State};
use crate::table::Measurements;
use cdpr_robot::{Coordinate, Pose, Robot};
use cdpr_statics::hysteresis::{Estimate, FrictionFit, PulleyFriction, fit_friction_model};
use serde::Serialize;

pub use history::WinchResidual;

/// The friction of the pulleys of a robot, from measurements.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PulleyCalibration {
    /// Coefficient μ of the cables on the wheels; `None` where it is not identified by itself.
    pub friction: Option<EstimatedValue>,
    /// Coefficient c of the bearings; `None` where it is not identified by itself.
    pub bearing: Option<EstimatedValue>,
    /// Unit vector of the sum of both that is identified best.
    pub combination: [f64; 2],
    /// This sum. Where it alone is identified, its standard deviation has a part for how the coefficients may
    /// share it.
    pub combined: EstimatedValue,
    /// Standard deviation of a tension at a winch, from the residuals [N].
    pub noise_n: f64,
    /// Root mean square of the residuals without friction, and with it [N].
    pub rms_n: [f64; 2],
    /// Coefficients μ and c of the modelled tensions: the smallest where only a sum is identified.
    pub modelled_with: [f64; 2],
    /// The cables that are compared.
    pub cables: Vec<PulleyOfCable>,
    /// The readings that are compared.
    pub readings: Vec<WinchResidual>,
}

/// A number with its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EstimatedValue {
    /// The number.
    pub value: f64,
    /// Its standard deviation.
    pub std: f64,
}

/// The readings of one cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PulleyOfCable {
    /// Number of the cable, from 1.
    pub cable: usize,
    /// Least and greatest wrap [°].
    pub wrap_deg: [f64; 2],
    /// Readings that are compared.
    pub readings: usize,
    /// Those of them at which the wheel slips.
    pub slipping: usize,
    /// Root mean square of the residuals [N].
    pub rms_n: f64,
}

impl From<Estimate> for EstimatedValue {
    fn from(of: Estimate) -> Self {
        Self { value: of.value, std: of.deviation }
    }
}

/// Finds the friction of pulleys from tensions at winches.
///
/// `pose` is where the platform rests under the load of the first row, unless the rows have positions;
/// `free` names the coordinates of a robot with few cables that it finds itself.
///
/// # Errors
/// [`CalibrationError::Column`] for a table without tensions at winches of cables with pulleys, or without
/// tensions at the platform where the model does not know them; [`CalibrationError::Incomplete`] for a row
/// without one of them or without a position; [`CalibrationError::Invalid`] for one load only, a pose that is
/// missing or given twice, and displacements without noise; [`CalibrationError::Statics`] for readings that
/// no friction fits or wheels that all stick; [`CalibrationError::Row`] for a row to which the robot has no
/// answer.
pub fn calibrate_pulleys(
    robot: &Robot,
    measured: &Measurements,
    pose: Option<&Pose>,
    free: &[Coordinate],
) -> Result<PulleyCalibration, CalibrationError> {
    let history = History::new(robot, measured, pose, free)?;
    let none = PulleyFriction::default();
    let (mut fit, friction) = fit_friction_model(|friction| history.residuals(friction))?;
    if fit.coefficients.is_none() {
        fit.combined.deviation = fit.combined.deviation.hypot(undecided(&history, &fit));
    }
    Ok(concluded(&history, &fit, friction, &history.states(none)?, &history.states(friction)?))
}

/// Standard deviation of the sum that is identified, as the readings leave open how both coefficients share
/// it: to second order they depend on the product of both. It is that of an even law as wide as the greatest
/// difference of the sums with all friction on the wheels and with all in the bearings. A coefficient alone
/// that fits nothing is left out.
fn undecided(history: &History, fit: &FrictionFit) -> f64 {
    let of_one = |largest: [f64; 2]| {
        let of = |share: f64| PulleyFriction { friction: share * largest[0], bearing: share * largest[1] };
        // The model depends on one coefficient: the other one is no part of it.
        let (_, found) = fit_friction_model(|friction| history.residuals(of(friction.friction))).ok()?;
        let found = of(found.friction);
        let sum = fit.combination[0] * found.friction + fit.combination[1] * found.bearing;
        Some((sum - fit.combined.value).abs())
    };
    [[1.0, 0.0], [0.0, 0.5]].into_iter().filter_map(of_one).fold(0.0, f64::max) / 3.0_f64.sqrt()
}

/// The answer, with states without and with friction.
fn concluded(
    history: &History,
    fit: &FrictionFit,
    friction: PulleyFriction,
    without: &[State],
    with: &[State],
) -> PulleyCalibration {
    let readings = history.readings(with);
    let rms = |of: &[WinchResidual]| {
        let squares: f64 = of.iter().map(|of| (of.measured_n - of.modelled_n).powi(2)).sum();
        (squares / of.len().max(1) as f64).sqrt()
    };
    let cable = |&i: &usize| {
        let own: Vec<_> = readings.iter().filter(|of| of.cable == i + 1).copied().collect();
        let wraps = || with.iter().map(|state| state.wheels[i].wrap.to_degrees());
        PulleyOfCable {
            cable: i + 1,
            wrap_deg: [wraps().fold(f64::INFINITY, f64::min), wraps().fold(0.0, f64::max)],
            readings: own.len(),
            slipping: own.iter().filter(|of| of.slip != 0).count(),
            rms_n: rms(&own),
        }
    };
    let coefficient = |k: usize| fit.coefficients.map(|both| both[k].into());
    PulleyCalibration {
        friction: coefficient(0),
        bearing: coefficient(1),
        combination: fit.combination,
        combined: fit.combined.into(),
        noise_n: fit.noise,
        rms_n: [rms(&history.readings(without)), rms(&readings)],
        modelled_with: [friction.friction, friction.bearing],
        cables: history.cables.iter().map(cable).collect(),
        readings,
    }
}
