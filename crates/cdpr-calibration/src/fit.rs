//! The fit: damped Gauss-Newton for all unknowns, with those of single rows eliminated.
//!
//! The sum over all residuals ρ of `loss(ρ)` and of the squares of `(x - mean)/std` of the priors is made
//! least. The loss is ρ², or grows less for great residuals: it is then minimised by squares with the weight
//! `loss'(ρ)/2ρ`. Every unknown is counted in its scale ([`crate::Unknown::scale`]): what the data tell less
//! exactly than one scale, they do not tell, and it keeps its value.

mod conclude;
mod problem;
mod search;
mod start;

use crate::campaign::Row;
use crate::error::CalibrationError;
use crate::fit::problem::Problem;
use crate::fitted::{Difference, Fit, FitSettings};
use crate::model::{Model, Shared, State};
use crate::plausible::{check_columns, check_signs};
use crate::unknowns::{SensorError, Unknowns};
use cdpr_robot::{Robot, Vector3};

/// Fits the unknowns of a robot to rows of measurements.
///
/// # Errors
/// [`CalibrationError::TooFew`] for fewer measurements than unknowns; [`CalibrationError::Row`] and
/// [`CalibrationError::Incomplete`] for a row that the nominal robot cannot answer to.
pub fn fit(
    robot: &Robot,
    rows: &[Row],
    unknowns: &Unknowns,
    settings: &FitSettings,
) -> Result<Fit, CalibrationError> {
    let problem = Problem { model: Model::new(robot, unknowns), rows, settings: *settings };
    problem.check()?;
    if unknowns.sensor(SensorError::LengthOffset).is_none() {
        check_signs(rows)?;
    }
    let moved =
        [SensorError::LengthOffset, SensorError::DrumScale, SensorError::Frame, SensorError::FrameScale];
    if moved.iter().all(|error| unknowns.sensor(*error).is_none()) {
        check_columns(robot, rows)?;
    }
    let (start, first) = problem.begin()?;
    let without = |gone: &[usize]| {
        let mut kept = unknowns.clone();
        kept.remove(gone);
        fit(robot, rows, &kept, settings)
    };
    if settings.only_identifiable {
        let gone = problem.unidentifiable_inputs(&problem.settled(start.clone())?.1);
        if !gone.is_empty() {
            return without(&gone);
        }
    }
    let mut best = problem.search(start, settings.max_steps)?;
    let mut ends = vec![best.at.cost];
    for number in 1..settings.starts.max(1) {
        let Some(start) = problem.start(number) else { continue };
        let Ok(found) = problem.search(start, settings.max_steps) else { continue };
        ends.push(found.at.cost);
        if found.at.cost < best.at.cost {
            best = found;
        }
    }
    if settings.only_identifiable {
        // At the minimum the data may tell less than where the search began.
        let gone = problem.unidentifiable_inputs(&best.at);
        if !gone.is_empty() {
            return without(&gone);
        }
    }
    let same = ends.iter().filter(|cost| **cost <= best.at.cost * (1.0 + 1e-6) + 1e-6).count();
    problem.conclude(best, first, same)
}

/// Errors of prediction: the rows are split into `folds` parts, every folds-th row into one, and each part is
/// compared with the robot that the others calibrate. The errors of sensors are those of the others, too, and
/// lengths count as they were read.
///
/// # Errors
/// As [`fit`].
pub fn cross_validated(
    robot: &Robot,
    rows: &[Row],
    unknowns: &Unknowns,
    settings: &FitSettings,
    folds: usize,
) -> Result<Vec<Difference>, CalibrationError> {
    let settings = FitSettings { starts: 1, ..*settings };
    let fold = |part: usize| -> Result<Vec<Difference>, CalibrationError> {
        let of = |inside: bool| rows.iter().enumerate().filter(move |(k, _)| (k % folds == part) == inside);
        let others: Vec<Row> = of(false).map(|(_, row)| row.clone()).collect();
        let known = fit(robot, &others, unknowns, &settings)?;
        let exact = |(_, row): (usize, &Row)| {
            let mut row = row.clone();
            row.length_std.iter_mut().for_each(|std| *std = 0.0);
            row
        };
        let left: Vec<Row> = of(true).map(exact).collect();
        let problem = Problem { model: Model::new(robot, &known.unknowns), rows: &left, settings };
        let x: Vec<f64> = known.estimates.iter().map(|estimate| estimate.value).collect();
        let states = left.iter().map(|row| problem.model.begin(row, &x)).collect::<Result<_, _>>()?;
        let shared = Shared { x, frame: known.frame, origin: Vector3::zeros() };
        let mut state = State { shared, rows: states };
        state.shared.origin = known.origin - problem.translation(&state);
        let compared = problem.compared(&state, &known.robot)?;
        Ok(problem.differences(&compared))
    };
    Ok((0..folds).map(fold).collect::<Result<Vec<_>, _>>()?.concat())
}
