//! Whether a constant error of each length explains what a fit leaves.
//!
//! At the minimum an offset o_i of the length of each cable, (R1), joins the unknowns, with the value 0. The
//! step of all of them by the linearization takes Δ from chi-square. If the model is right, Δ has the law χ²
//! with a degree of freedom for each cable (score test, Rao 1948). One offset o of all lengths, whose
//! derivatives are the sums of those by o_i, has one degree of freedom.

use crate::fit::problem::Problem;
use crate::fit::search::{Linearized, Priors};
use crate::fitted::{LengthOffsets, RobustLoss};
use crate::model::{Model, State};
use crate::sensor_error::SensorError;

impl Problem<'_> {
    /// What offsets of the lengths would take from chi-square at a minimum, if they are not sought.
    pub(super) fn length_offsets(&self, state: &State) -> Option<LengthOffsets> {
        let Model { robot: nominal, unknowns, .. } = self.model;
        let is_sought = unknowns.sensor(SensorError::LengthOffset).is_some();
        let is_read = self.rows.iter().any(|row| row.lengths.is_some());
        if is_sought || !is_read || self.settings.loss != RobustLoss::Squares {
            return None;
        }
        let mut more = unknowns.clone();
        more.add(nominal, SensorError::LengthOffset, None, unknowns.marker_count);
        let problem = Problem { model: self.model.seeking(&more), ..*self };
        let mut state = state.clone();
        state.shared.x.resize(more.all.len(), 0.0);
        let at = problem.measured_at(&state).ok()?;
        let decomposed = problem.decomposed(&at, &state.shared, Priors::All);
        let step = decomposed.step(0.0);
        let first = unknowns.all.len();
        let offsets = (first..more.all.len()).map(|j| step[j] * more.all[j].scale).collect();
        let common = problem.common_offset(&at, &state, first);
        Some(LengthOffsets { gain: decomposed.distance().powi(2), offsets, common })
    }

    /// What one offset of all lengths would take from chi-square, and that offset [m]; `first` is the index
    /// of the first of those of single cables, the last unknowns.
    fn common_offset(&self, at: &Linearized, state: &State, first: usize) -> (f64, f64) {
        let mut unknowns = self.model.unknowns.clone();
        unknowns.all.truncate(first + 1);
        let problem = Problem { model: self.model.seeking(&unknowns), ..*self };
        let mut shared = state.shared.clone();
        shared.x.truncate(first + 1);
        let decomposed = problem.decomposed(&at.with_last_together(first), &shared, Priors::All);
        (decomposed.distance().powi(2), decomposed.step(0.0)[first] * unknowns.all[first].scale)
    }
}
