//! The fit: damped Gauss-Newton for all unknowns, with those of single rows eliminated.
//!
//! The sum over all residuals ρ of `loss(ρ)` and of the squares of `(x - mean)/std` of the priors is made
//! least. The loss is ρ², or grows less for great residuals: it is then minimized by squares with the weight
//! `loss'(ρ)/2ρ`. Every unknown is counted in its scale ([`crate::Unknown::scale`]): what the data tell less
//! exactly than one scale, they do not tell, and it keeps its value.

mod conclude;
mod frame;
pub(crate) mod friction;
mod mixing;
mod offset;
mod problem;
mod rows;
mod search;
mod start;

use crate::campaign::{Row, STD_EXPECTED, is_std};
use crate::error::CalibrationError;
use crate::fit::problem::Problem;
use crate::fit::search::{Found, NEAR, Priors, SEEN};
use crate::fit::start::SOFT;
use crate::fitted::{Difference, Fit, FitSettings};
use crate::model::held::without_held;
use crate::model::{Model, Shared, State};
use crate::plausible::{check_columns, check_signs};
use crate::sensor_error::{SensorError, check_each_once};
use crate::unknowns::{Unknown, Unknowns};
use cdpr_robot::{Robot, Vector3};

/// Fits the unknowns of a robot to rows of measurements. What the platform cannot change counts as not
/// measured: coordinates out of the plane of a planar robot, and the rotation of a point mass.
///
/// # Errors
/// [`CalibrationError::NoSurplus`] and [`CalibrationError::TooFew`] for fewer measurements than unknowns;
/// [`CalibrationError::Row`] and [`CalibrationError::Incomplete`] for a row that the nominal robot cannot
/// answer to; [`CalibrationError::Invalid`] for numbers that are not finite, standard deviations and counts
/// out of bounds; [`CalibrationError::Column`] for columns that belong elsewhere.
pub fn fit(
    robot: &Robot,
    rows: &[Row],
    unknowns: &Unknowns,
    settings: &FitSettings,
) -> Result<Fit, CalibrationError> {
    check(rows, unknowns, settings)?;
    let kept = without_held(robot, unknowns, rows);
    let problem = Problem { model: Model::new(robot, unknowns, rows), rows: &kept, settings: *settings };
    problem.check()?;
    if unknowns.sensor(SensorError::LengthOffset).is_none() {
        check_signs(rows)?;
    }
    let moved =
        [SensorError::LengthOffset, SensorError::DrumScale, SensorError::Frame, SensorError::FrameScale];
    if moved.iter().all(|error| unknowns.sensor(*error).is_none()) {
        let constant = check_columns(robot, rows, |row| problem.model.measured_pose(row))?;
        problem.check_frame(rows, constant)?;
    }
    let (start, first) = problem.begin()?;
    let without = |gone: &[usize]| {
        let mut kept = unknowns.clone();
        kept.remove(gone);
        fit(robot, rows, &kept, settings)
    };
    if settings.only_identifiable {
        let (settled, _) = problem.settled(start.clone())?;
        let gone = problem.unidentifiable_inputs(&start.shared, &problem.measured_at(&settled)?);
        if !gone.is_empty() {
            return without(&gone);
        }
    }
    let (best, starts) = problem.best_of_starts(start)?;
    if settings.only_identifiable {
        // At the minimum the data may tell less than where the search began.
        let gone = problem.unidentifiable_inputs(&best.state.shared, &problem.measured_at(&best.state)?);
        if !gone.is_empty() {
            return without(&gone);
        }
    }
    problem.conclude(best, first, starts)
}

impl Problem<'_> {
    /// The least minimum that the starts lead to, with how many were made and how many of them led there.
    /// Where its chi-square is unlikely, lengths with greater errors may lead to a lower one: starts that
    /// agree may all have the wrong cables slack.
    fn best_of_starts(&self, start: State) -> Result<(Found, [usize; 2]), CalibrationError> {
        let (best, starts) = self.agreed(start)?;
        if self.settings.starts == 1 || !self.is_unlikely(best.leads_to()) {
            return Ok((best, starts));
        }
        let begun = self.softened(&SOFT).and_then(|start| self.with_best_rows(start).ok());
        let seen = begun.and_then(|start| self.search(start, SEEN, self.settings.max_steps).ok());
        let lower = seen.filter(|seen| seen.leads_to() < best.leads_to());
        let other = lower.and_then(|seen| self.agreed(seen.state).ok());
        Ok(other.filter(|(other, _)| other.leads_to() < best.leads_to()).unwrap_or((best, starts)))
    }

    /// The least minimum that starts lead to, with how many were made and how many of them led there. Those
    /// after the first are followed as far as it takes to see where they lead, and their rows begun again
    /// only where they fit badly there; more are made while none agrees.
    fn agreed(&self, start: State) -> Result<(Found, [usize; 2]), CalibrationError> {
        let wanted = self.settings.starts;
        let most = self.settings.max_steps;
        let mut best = self.search(self.with_best_rows(start)?, NEAR, most)?;
        let mut ends = vec![best.at.cost];
        let from = best.state.shared.x.clone();
        let told = self.decomposed(&best.at, &best.state.shared, Priors::All);
        let agreeing = |ends: &[f64], best: f64| ends.iter().filter(|cost| is_same(**cost, best)).count();
        for number in 1..2 * wanted {
            if wanted == 1 || (number >= wanted && agreeing(&ends, best.at.cost) > 1) {
                break;
            }
            let start = self.start(number, &from, &told);
            // A start that takes far longer than the first would show little.
            let few = most.min(2 * best.steps + FEW_STEPS);
            let found = start.and_then(|start| self.search(start, SEEN, few).ok());
            // A start from which nothing is found agrees with none.
            ends.push(found.as_ref().map_or(f64::INFINITY, Found::leads_to));
            if let Some(found) = found.filter(|found| found.leads_to() < best.at.cost) {
                let lower = !is_same(best.at.cost, found.leads_to());
                if lower || best.distance > found.distance {
                    let before = found.steps;
                    let mut again = self.search(found.state, NEAR, most)?;
                    again.steps += before;
                    if again.at.cost < best.at.cost || again.distance < best.distance {
                        best = again;
                    }
                }
            }
        }
        let same = agreeing(&ends, best.at.cost);
        Ok((best, [ends.len(), same]))
    }
}

/// Steps that a further start may take beyond twice those of the best.
const FEW_STEPS: usize = 10;

/// Whether two searches ended at one chi-square.
fn is_same(cost: f64, best: f64) -> bool {
    cost <= best + 1e-3 + 1e-9 * best
}

/// Refuses settings, rows and priors that no fit has numbers for.
fn check(rows: &[Row], unknowns: &Unknowns, settings: &FitSettings) -> Result<(), CalibrationError> {
    if !(1..=FitSettings::MOST_STARTS).contains(&settings.starts) {
        let expected = format!("1 to {}", FitSettings::MOST_STARTS);
        return Err(CalibrationError::invalid("starts", settings.starts, expected));
    }
    rows.iter().try_for_each(Row::check)?;
    check_each_once(unknowns.sensors.iter().map(|(error, _)| *error))?;
    for Unknown { name, prior, .. } in &unknowns.all {
        if let Some([mean, std]) = prior.filter(|[mean, std]| !mean.is_finite() || !is_std(*std)) {
            let given = format!("{mean} ± {std}");
            return Err(CalibrationError::invalid(format!("prior of {name}"), given, STD_EXPECTED));
        }
    }
    Ok(())
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
    if !(2..=rows.len()).contains(&folds) {
        let expected = format!("2 to {}, one row each", rows.len());
        return Err(CalibrationError::invalid("folds", folds, expected));
    }
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
        let left = without_held(robot, &known.unknowns, &left);
        let problem = Problem { model: Model::new(robot, &known.unknowns, rows), rows: &left, settings };
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
