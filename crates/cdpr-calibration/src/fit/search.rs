//! Damped Gauss-Newton steps for the unknowns of all rows, those of single rows at their best.
//!
//! With the errors of its lengths where they suit the row best, a row depends on the unknowns of all rows
//! alone (variable projection, Golub and Pereyra 1973; the Schur complement is its slope). The floor of a
//! narrow valley, which stiff cables make of lengths and tensions, is followed so, in place of bouncing
//! between its walls.

use crate::campaign::Row;
use crate::error::CalibrationError;
use crate::fit::problem::Problem;
use crate::model::compare::Compared;
use crate::model::{RowState, Shared, State};
use crate::solve::{Decomposed, Eliminated, reduce, triangle};
use crate::unknowns::SensorError;
use cdpr_robot::{Robot, Rotation3, Vector3};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// A step is done where the minimum is as near as this, in standard deviations.
const NEAR: f64 = 1e-8;

/// Distance at which rounding may stop the search.
pub(super) const NEAR_ENOUGH: f64 = 1e-4;

/// Distance below which the steps converge quadratically.
const QUADRATIC: f64 = 1e-3;

/// Rounding of the sum of squares, relative to one more than it.
const ROUNDING_OF_COST: f64 = 1e-6;

/// Damping of the first step that did not improve, relative to the square of the greatest singular value.
const LEAST_DAMPING: f64 = 1e-10;

/// Damping beyond which no step is left.
const MOST_DAMPING: f64 = 1e4;

/// All rows linearised at a state.
pub(super) struct Linearized {
    /// Triangular factor of [A ρ] in scales, without priors.
    data: DMatrix<f64>,
    rows: Vec<Eliminated>,
    pub(super) cost: f64,
}

/// Where a search has ended.
pub(super) struct Found {
    pub(super) state: State,
    pub(super) at: Linearized,
    pub(super) steps: usize,
    /// Distance to the minimum by the last linearisation, in standard deviations.
    pub(super) distance: f64,
}

/// A row's own unknowns are at their best where a step would gain less than this share of its cost.
const OWN_GAIN: f64 = 1e-3;

/// Rows whose cost exceeds its expectation by so many of its standard deviations are begun anew.
const BAD: f64 = 4.0;

/// Share of a row's cost below which another equilibrium is taken.
const WORTHWHILE: f64 = 0.9;

/// Times that bad rows are begun anew at most.
const MOST_LOOKS: usize = 10;

/// Steps of the unknowns of a row at most.
const MOST_OWN_STEPS: usize = 20;

/// Shares of a step of the unknowns of a row that are tried.
const SHARES: [f64; 6] = [1.0, 0.5, 0.25, 0.1, 0.03, 0.01];

impl Problem<'_> {
    /// Steps until the minimum is near, and none of the rows fits better with another equilibrium.
    pub(super) fn search(&self, start: State, most: usize) -> Result<Found, CalibrationError> {
        let mut found = self.descend(self.settled(start)?, most)?;
        for _ in 0..MOST_LOOKS {
            let Some(better) = self.look_again(&found.state)? else { break };
            let before = found.steps;
            found = self.descend(better, most.saturating_sub(before))?;
            found.steps += before;
        }
        Ok(found)
    }

    /// The state with rows that fit badly begun anew, if any of them fits better then: at an equilibrium with
    /// other slack cables a row may be trapped.
    fn look_again(&self, from: &State) -> Result<Option<(State, Linearized)>, CalibrationError> {
        let robot = self.model.deviating(&from.shared.x)?;
        let better: Vec<Option<RowState>> = (self.rows, &from.rows)
            .into_par_iter()
            .map(|(row, state)| {
                let at = |state: RowState| {
                    let compared = self.model.compare(row, &from.shared, &state, &robot).ok()?;
                    Some(self.at_their_best(row, &from.shared, &robot, state, compared))
                };
                let now = self.row_cost(&at(state.clone())?.1);
                let numbers = row.readings.len() as f64;
                if now < numbers + BAD * (2.0 * numbers).sqrt() {
                    return None;
                }
                let (again, compared) = at(self.model.begin(row, &from.shared.x).ok()?)?;
                (self.row_cost(&compared) < WORTHWHILE * now).then_some(again)
            })
            .collect();
        if better.iter().all(Option::is_none) {
            return Ok(None);
        }
        let mut state = from.clone();
        for (row, better) in state.rows.iter_mut().zip(better) {
            if let Some(better) = better {
                *row = better;
            }
        }
        self.settled(state).map(Some)
    }

    fn descend(&self, start: (State, Linearized), most: usize) -> Result<Found, CalibrationError> {
        let (mut state, mut at) = start;
        let mut damping: f64 = 0.0;
        let mut steps = 0;
        let mut before = f64::INFINITY;
        loop {
            let decomposed = self.decomposed(&at, &state.shared.x, true);
            let distance = decomposed.distance();
            // Near the minimum rounding of the cost hides what a step gains.
            let is_near = distance < QUADRATIC;
            if distance < NEAR || steps >= most || (is_near && distance > 0.9 * before) {
                return Ok(Found { state, at, steps, distance });
            }
            before = if is_near { distance } else { f64::INFINITY };
            let allowed = if is_near { at.cost + ROUNDING_OF_COST * (1.0 + at.cost) } else { at.cost };
            let greatest = decomposed.values.max().powi(2);
            let mut accepted = false;
            while damping < MOST_DAMPING {
                let step = decomposed.step(damping * greatest);
                if let Some((next, linearized)) = self.stepped(&state, &at, &step)
                    && linearized.cost <= allowed
                {
                    (state, at) = (next, linearized);
                    damping = if damping > LEAST_DAMPING { 0.1 * damping } else { 0.0 };
                    accepted = true;
                    break;
                }
                damping = (10.0 * damping).max(LEAST_DAMPING);
            }
            steps += 1;
            if !accepted {
                return Ok(Found { state, at, steps, distance });
            }
        }
    }

    /// The state with the unknowns of each row at their best, linearised.
    pub(super) fn settled(&self, mut state: State) -> Result<(State, Linearized), CalibrationError> {
        let robot = self.model.deviating(&state.shared.x)?;
        let settled: Vec<(RowState, Compared)> = (self.rows, state.rows)
            .into_par_iter()
            .map(|(row, from)| {
                let compared = self.model.compare(row, &state.shared, &from, &robot);
                let compared = compared.map_err(CalibrationError::row(row.line))?;
                Ok(self.at_their_best(row, &state.shared, &robot, from, compared))
            })
            .collect::<Result<_, CalibrationError>>()?;
        let (rows, compared) = settled.into_iter().unzip();
        state.rows = rows;
        let at = self.linearized(&state.shared, compared);
        Ok((state, at))
    }

    /// The state after a step in scales.
    fn stepped(&self, from: &State, at: &Linearized, step: &DVector<f64>) -> Option<(State, Linearized)> {
        let mut x = from.shared.x.clone();
        for (j, unknown) in self.model.unknowns.all.iter().enumerate() {
            x[j] = (x[j] + step[j] * unknown.scale).clamp(unknown.bounds[0], unknown.bounds[1]);
        }
        let mut frame = from.shared.frame;
        if let Some(first) = self.model.unknowns.sensor(SensorError::Frame) {
            let turn: Vec<f64> =
                (first + 3..first + 6).map(|j| step[j] * self.model.unknowns.all[j].scale).collect();
            frame = Rotation3::new(Vector3::new(turn[0], turn[1], turn[2])) * frame;
            // The rotation stands in the frame.
            (first + 3..first + 6).for_each(|j| x[j] = 0.0);
        }
        let robot = self.model.deviating(&x).ok()?;
        let shared = Shared { x, frame, origin: from.shared.origin };
        let settled: Option<Vec<(RowState, Compared)>> = (0..self.rows.len())
            .into_par_iter()
            .map(|k| {
                let (row, before) = (&self.rows[k], &from.rows[k]);
                let own = at.rows[k].own(step);
                let share = |share: f64| {
                    let errors = before.own().iter().zip(&own).map(|(e, d)| e + share * d).collect();
                    let state = self.model.follow(row, before, &robot, &shared.x, errors).ok()?;
                    let compared = self.model.compare(row, &shared, &state, &robot).ok()?;
                    Some((state, compared))
                };
                let (state, compared) = share(1.0).or_else(|| share(0.1)).or_else(|| share(0.0))?;
                Some(self.at_their_best(row, &shared, &robot, state, compared))
            })
            .collect();
        let (rows, compared) = settled?.into_iter().unzip();
        let linearized = self.linearized(&shared, compared);
        Some((State { shared, rows }, linearized))
    }

    /// A row with its own unknowns where they suit it best, near those given.
    fn at_their_best(
        &self,
        row: &Row,
        shared: &Shared,
        robot: &Robot,
        mut state: RowState,
        mut compared: Compared,
    ) -> (RowState, Compared) {
        if state.own().is_empty() {
            return (state, compared);
        }
        for _ in 0..MOST_OWN_STEPS {
            let cost = self.row_cost(&compared);
            let (mut slopes, mut residuals) = (compared.per_own.clone(), compared.residuals.clone());
            for r in 0..residuals.len() {
                let weight = self.settings.loss.weight(residuals[r]).sqrt();
                residuals[r] *= weight;
                slopes.row_mut(r).iter_mut().for_each(|slope| *slope *= weight);
            }
            let count = residuals.len();
            let all = Eliminated::new(DMatrix::from_column_slice(count, 1, residuals.as_slice()), &slopes);
            if all.gain() <= OWN_GAIN * (1.0 + cost) {
                break;
            }
            let step = all.own(&DVector::zeros(0));
            let tried = SHARES.iter().find_map(|share| {
                let errors = state.own().iter().zip(&step).map(|(e, d)| e + share * d).collect();
                let next = self.model.follow(row, &state, robot, &shared.x, errors).ok()?;
                let compared = self.model.compare(row, shared, &next, robot).ok()?;
                (self.row_cost(&compared) < cost).then_some((next, compared))
            });
            let Some(tried) = tried else { break };
            (state, compared) = tried;
        }
        (state, compared)
    }

    fn linearized(&self, shared: &Shared, compared: Vec<Compared>) -> Linearized {
        let cost = self.cost(&compared, &shared.x);
        let count = self.model.unknowns.all.len();
        let eliminated = |mut of: Compared| {
            let mut row = DMatrix::zeros(of.std.len(), count + 1);
            for r in 0..of.std.len() {
                let weight = self.settings.loss.weight(of.residuals[r]).sqrt();
                for (j, unknown) in self.model.unknowns.all.iter().enumerate() {
                    row[(r, j)] = weight * of.per_unknown[(r, j)] * unknown.scale;
                }
                row[(r, count)] = weight * of.residuals[r];
                of.per_own.row_mut(r).iter_mut().for_each(|slope| *slope *= weight);
            }
            Eliminated::new(row, &of.per_own)
        };
        let rows: Vec<_> = compared.into_par_iter().map(eliminated).collect();
        Linearized { data: reduce(&rows, count + 1), rows, cost }
    }

    /// The whole problem in scales: data, priors, and zero columns for unknowns at their bounds.
    pub(super) fn decomposed(&self, at: &Linearized, x: &[f64], with_priors: bool) -> Decomposed {
        let count = x.len();
        let mut whole = at.data.clone();
        if with_priors {
            let priors: Vec<_> = self.priors(x).collect();
            let mut rows = DMatrix::zeros(priors.len(), count + 1);
            for (r, (j, residual, slope)) in priors.into_iter().enumerate() {
                rows[(r, j)] = slope;
                rows[(r, count)] = residual;
            }
            whole = triangle(whole, &rows);
        }
        let mut matrix = whole.columns(0, count).into_owned();
        let right = whole.column(count).into_owned();
        if with_priors {
            let gradient = matrix.tr_mul(&right);
            for (j, unknown) in self.model.unknowns.all.iter().enumerate() {
                let [least, most] = unknown.bounds;
                if (x[j] <= least && gradient[j] > 0.0) || (x[j] >= most && gradient[j] < 0.0) {
                    matrix.column_mut(j).fill(0.0);
                }
            }
        }
        Decomposed::new(matrix, &right)
    }
}
