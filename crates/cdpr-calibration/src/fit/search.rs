//! Damped Gauss-Newton steps for the unknowns of all rows, those of single rows at their best.
//!
//! With the errors of its lengths where they suit the row best, a row depends on the unknowns of all rows
//! alone (variable projection, Golub and Pereyra 1973; the Schur complement is its slope). The floor of a
//! narrow valley, which stiff cables make of lengths and tensions, is followed so, in place of bouncing
//! between its walls.

use crate::error::CalibrationError;
use crate::fit::mixing::Mixing;
use crate::fit::problem::Problem;
use crate::fit::rows::{Look, RowStep, Way, eliminated};
use crate::model::compare::Compared;
use crate::model::{RowAt, RowState, Shared, State};
use crate::sensor_error::SensorError;
use crate::solve::{Decomposed, Eliminated, reduce, triangle};
use cdpr_robot::{Rotation3, Vector3};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// The search is done where the minimum is as near as this, in standard deviations: the square is what a
/// step would take from chi-square.
pub(super) const NEAR: f64 = 1e-6;

/// Distance at which it is seen where a start leads, in standard deviations: [`Found::leads_to`].
pub(super) const SEEN: f64 = 1e-2;

/// Distance below which the steps converge quadratically.
const QUADRATIC: f64 = 1e-3;

/// Rounding of the sum of squares, relative to one more than it.
const ROUNDING_OF_COST: f64 = 1e-6;

/// Damping of the first step that did not improve, relative to the square of the greatest singular value.
const LEAST_DAMPING: f64 = 1e-10;

/// Damping beyond which no step is left.
const MOST_DAMPING: f64 = 1e4;

/// All rows linearized at a state.
pub(crate) struct Linearized {
    /// Triangular factor of [A ρ] in scales, without priors.
    data: DMatrix<f64>,
    rows: Vec<Eliminated>,
    /// [`Compared::motion`] of each row.
    motions: Vec<DMatrix<f64>>,
    pub(super) cost: f64,
}

impl Linearized {
    /// The same rows with the unknowns from `first` on as one, which moves them all alike.
    pub(super) fn with_last_together(&self, first: usize) -> Self {
        let count = self.data.ncols() - 1;
        let mut data = self.data.columns(0, first + 2).into_owned();
        data.set_column(first, &self.data.columns(first, count - first).column_sum());
        data.set_column(first + 1, &self.data.column(count));
        Self { data, rows: Vec::new(), motions: Vec::new(), cost: self.cost }
    }
}

/// Where a search has ended.
pub(super) struct Found {
    pub(super) state: State,
    pub(super) at: Linearized,
    pub(super) steps: usize,
    /// Distance to the minimum by the last linearization, in standard deviations.
    pub(super) distance: f64,
}

impl Found {
    /// The least chi-square by the last linearization, where that is near enough to tell.
    pub(super) fn leads_to(&self) -> f64 {
        if self.distance <= SEEN { self.at.cost - self.distance * self.distance } else { self.at.cost }
    }
}

/// Which priors count.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Priors {
    All,
    /// Those of unknowns that move points out of the plane of a planar robot alone.
    OutOfPlane,
    None,
}

/// Times that rows are begun again at most.
const MOST_LOOKS: usize = 10;

impl Problem<'_> {
    /// At most `most` steps, until the minimum is as near as `near`, in standard deviations, and none of the
    /// rows fits better with another equilibrium.
    pub(super) fn search(&self, start: State, near: f64, most: usize) -> Result<Found, CalibrationError> {
        let mut found = self.descend(self.settled(start)?, near, most)?;
        for _ in 0..MOST_LOOKS {
            let Some(better) = self.look_again(&found.state, Look::Bad)? else { break };
            let before = found.steps;
            found = self.descend(self.settled(better)?, near, most.saturating_sub(before))?;
            found.steps += before;
        }
        Ok(found)
    }

    /// The start with each row at the equilibrium, of those that are looked at, that fits it best.
    pub(super) fn with_best_rows(&self, start: State) -> Result<State, CalibrationError> {
        let (settled, _) = self.settled(start)?;
        Ok(self.look_again(&settled, Look::All)?.unwrap_or(settled))
    }

    fn descend(&self, start: (State, Linearized), near: f64, most: usize) -> Result<Found, CalibrationError> {
        let (mut state, mut at) = start;
        let mut damping: f64 = 0.0;
        let mut steps = 0;
        let mut mixing = Mixing::new(state.shared.x.len());
        let mut before = f64::INFINITY;
        loop {
            let decomposed = self.decomposed(&at, &state.shared, Priors::All);
            // What the rows' own unknowns alone would gain counts, too: a row that is stuck is no minimum.
            let own: f64 = at.rows.iter().map(Eliminated::gain).sum();
            let distance = (decomposed.distance().powi(2) + own).sqrt();
            // Near the minimum rounding of the cost hides what a step gains.
            let is_near = distance < QUADRATIC;
            if distance < near || steps >= most || (is_near && distance > 0.9 * before) {
                return Ok(Found { state, at, steps, distance });
            }
            before = if is_near { distance } else { f64::INFINITY };
            let allowed = if is_near { at.cost + ROUNDING_OF_COST * (1.0 + at.cost) } else { at.cost };
            let greatest = decomposed.values.max().powi(2);
            let mut accepted = false;
            if let Some(step) = mixing.step(&decomposed)
                && let Some((next, linearized)) = self.stepped(&state, &at, &step)
                && linearized.cost <= allowed
            {
                (state, at) = (next, linearized);
                mixing.moved(&step);
                accepted = true;
            }
            while !accepted && damping < MOST_DAMPING {
                let step = decomposed.step(damping * greatest);
                if let Some((next, linearized)) = self.stepped(&state, &at, &step)
                    && linearized.cost <= allowed
                {
                    (state, at) = (next, linearized);
                    damping = if damping > LEAST_DAMPING { 0.1 * damping } else { 0.0 };
                    mixing.moved(&step);
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

    /// The state with the unknowns of each row at their best, linearized.
    pub(super) fn settled(&self, mut state: State) -> Result<(State, Linearized), CalibrationError> {
        let robot = self.model.deviating(&state.shared.x)?;
        let settled: Vec<(RowState, Compared)> = (self.rows, state.rows)
            .into_par_iter()
            .map(|(row, from)| {
                let here = RowAt { row, shared: &state.shared, robot: &robot };
                let compared = self.model.compare(&here, &from).map_err(CalibrationError::row(row.line))?;
                Ok(self.at_their_best(&here, from, compared))
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
        let moved = DVector::from_iterator(x.len(), x.iter().zip(&from.shared.x).map(|(to, from)| to - from));
        let shared = Shared { x, frame, origin: from.shared.origin };
        let settled: Option<Vec<(RowState, Compared)>> = (0..self.rows.len())
            .into_par_iter()
            .map(|k| {
                let (row, before) = (&self.rows[k], &from.rows[k]);
                let own = at.rows[k].own(step);
                let here = RowAt { row, shared: &shared, robot: &robot };
                let tries = [1.0, 0.1, 0.0].into_iter().flat_map(|share| Way::ALL.map(|way| (share, way)));
                let (state, compared) = tries.into_iter().find_map(|(share, way)| {
                    let own = own.iter().map(|of| share * of).collect();
                    let step = RowStep { unknowns: &moved, own, motion: &at.motions[k] };
                    self.moved(&here, before, &step, way)
                })?;
                Some(self.at_their_best(&here, state, compared))
            })
            .collect();
        let (rows, compared) = settled?.into_iter().unzip();
        let linearized = self.linearized(&shared, compared);
        Some((State { shared, rows }, linearized))
    }

    /// All rows linearized at a state as they are measured: the second derivatives at kinks, which a search
    /// follows, are no measurements.
    pub(super) fn measured_at(&self, state: &State) -> Result<Linearized, CalibrationError> {
        let robot = self.model.deviating(&state.shared.x)?;
        let mut compared = self.compared(state, &robot)?;
        compared.iter_mut().for_each(|of| of.bends = of.bends.rows(0, 0).into_owned());
        Ok(self.linearized(&state.shared, compared))
    }

    pub(super) fn linearized(&self, shared: &Shared, compared: Vec<Compared>) -> Linearized {
        let cost = self.cost(&compared, shared);
        let count = self.model.unknowns.all.len();
        let row_of = |mut of: Compared| {
            let own = of.per_own.ncols();
            let mut row = DMatrix::zeros(of.std.len(), count + 1);
            for r in 0..of.std.len() {
                let weight = self.settings.loss.weight(of.residuals[r]).sqrt();
                for (j, unknown) in self.model.unknowns.all.iter().enumerate() {
                    row[(r, j)] = weight * of.per_unknown[(r, j)] * unknown.scale;
                }
                row[(r, count)] = weight * of.residuals[r];
                of.per_own.row_mut(r).iter_mut().for_each(|slope| *slope *= weight);
            }
            let [scaled, bends] = [&of.motion, &of.bends].map(|slopes| {
                let mut scaled = slopes.clone();
                for (j, unknown) in self.model.unknowns.all.iter().enumerate().filter(|_| own > 0) {
                    scaled.column_mut(j).iter_mut().for_each(|slope| *slope *= unknown.scale);
                }
                scaled
            });
            (eliminated(row, &of.per_own, &scaled, &of.between, &bends), of.motion)
        };
        let (rows, motions): (Vec<_>, Vec<_>) = compared.into_par_iter().map(row_of).unzip();
        Linearized { data: reduce(&rows, count + 1), rows, motions, cost }
    }

    /// The problem in scales: data, priors and, with all of these, zero columns for unknowns at their bounds.
    pub(super) fn decomposed(&self, at: &Linearized, shared: &Shared, which: Priors) -> Decomposed {
        let x = &shared.x;
        let count = x.len();
        let mut whole = at.data.clone();
        if which != Priors::None {
            let mut priors: Vec<_> = self.priors(shared);
            if which == Priors::OutOfPlane {
                let out_of_plane = self.model.unknowns.out_of_plane(self.model.robot);
                priors.retain(|(j, ..)| out_of_plane[*j]);
            }
            let mut rows = DMatrix::zeros(priors.len(), count + 1);
            for (r, (j, residual, slope)) in priors.into_iter().enumerate() {
                rows[(r, j)] = slope;
                rows[(r, count)] = residual;
            }
            whole = triangle(whole, &rows);
        }
        let mut matrix = whole.columns(0, count).into_owned();
        let right = whole.column(count).into_owned();
        let mut fixed = Vec::new();
        if which == Priors::All {
            let gradient = matrix.tr_mul(&right);
            for (j, unknown) in self.model.unknowns.all.iter().enumerate() {
                let [least, most] = unknown.bounds;
                if (x[j] <= least && gradient[j] > 0.0) || (x[j] >= most && gradient[j] < 0.0) {
                    matrix.column_mut(j).fill(0.0);
                    fixed.push(j);
                }
            }
        }
        Decomposed::new(matrix, &right).with_fixed(fixed)
    }
}
