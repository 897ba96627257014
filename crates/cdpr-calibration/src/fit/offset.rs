//! Whether a constant error of each length explains what a fit leaves.
//!
//! At the minimum an offset o_i of the length of each cable, (R1), joins the unknowns, with the value 0. The
//! step of all of them by the linearization takes Δ from chi-square. If the model is right, Δ has the law χ²
//! with a degree of freedom for each cable (score test, Rao 1948).

use crate::fit::problem::Problem;
use crate::fit::search::Priors;
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
        let offsets = (unknowns.all.len()..more.all.len()).map(|j| step[j] * more.all[j].scale).collect();
        Some(LengthOffsets { gain: decomposed.distance().powi(2), offsets })
    }
}
