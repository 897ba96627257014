//! A campaign to be fitted: its residuals and their cost.

use crate::campaign::Row;
use crate::error::CalibrationError;
use crate::fitted::{Difference, FitSettings};
use crate::model::compare::Compared;
use crate::model::{Model, State};
use crate::unknowns::SensorError;
use cdpr_robot::{Pose, Robot, Vector3};
use rayon::prelude::*;

/// Residuals of all rows, and their poses.
pub(super) type Seen = (Vec<Difference>, Vec<Pose>);

/// A campaign to be fitted.
pub(crate) struct Problem<'a> {
    pub(crate) model: Model<'a>,
    pub(crate) rows: &'a [Row],
    pub(super) settings: FitSettings,
}

impl Problem<'_> {
    pub(super) fn check(&self) -> Result<(), CalibrationError> {
        let lengths = |row: &Row| if row.lengths.is_some() { row.length_std.len() } else { 0 };
        let measured = |row: &Row| {
            let noisy = row.length_std.iter().any(|std| *std > 0.0);
            row.readings.len() + if noisy { lengths(row) } else { 0 }
        };
        let own = |row: &Row| {
            let noisy = row.length_std.iter().any(|std| *std > 0.0);
            if noisy || row.lengths.is_none() { self.model.robot.cables.len() } else { 0 }
        };
        let measurements: usize = self.rows.iter().map(measured).sum();
        let nuisances: usize = self.rows.iter().map(own).sum();
        let free = self.model.unknowns.all.iter().filter(|unknown| unknown.prior.is_none()).count();
        if measurements < free + nuisances || measurements == 0 {
            return Err(CalibrationError::TooFew { measurements, unknowns: free + nuisances, nuisances });
        }
        Ok(())
    }

    pub(super) fn compared(&self, state: &State, robot: &Robot) -> Result<Vec<Compared>, CalibrationError> {
        (0..self.rows.len())
            .into_par_iter()
            .map(|k| {
                let row = &self.rows[k];
                self.model
                    .compare(row, &state.shared, &state.rows[k], robot)
                    .map_err(CalibrationError::row(row.line))
            })
            .collect()
    }

    pub(super) fn differences(&self, compared: &[Compared]) -> Vec<Difference> {
        let of = |(row, of): (usize, &Compared)| {
            let line = self.rows[row].line;
            (0..of.std.len())
                .map(|r| Difference {
                    row,
                    line,
                    quantity: of.quantities[r],
                    difference: of.standardized[r] * of.std[r],
                    std: of.std[r],
                })
                .collect::<Vec<_>>()
        };
        compared.iter().enumerate().flat_map(of).collect()
    }

    /// Residual and square of the prior of each unknown.
    pub(super) fn priors(&self, x: &[f64]) -> impl Iterator<Item = (usize, f64, f64)> {
        let of = move |(j, unknown): (usize, &crate::unknowns::Unknown)| {
            let [mean, std] = unknown.prior?;
            Some((j, (x[j] - mean) / std, unknown.scale / std))
        };
        self.model.unknowns.all.iter().enumerate().filter_map(of).collect::<Vec<_>>().into_iter()
    }

    pub(super) fn row_cost(&self, of: &Compared) -> f64 {
        of.residuals.iter().map(|r| self.settings.loss.loss(*r)).sum()
    }

    pub(super) fn cost(&self, compared: &[Compared], x: &[f64]) -> f64 {
        compared.iter().map(|of| self.row_cost(of)).sum::<f64>()
            + self.priors(x).map(|(_, r, _)| r * r).sum::<f64>()
    }

    pub(super) fn translation(&self, state: &State) -> Vector3<f64> {
        self.model.unknowns.sensor(SensorError::Frame).map_or_else(Vector3::zeros, |first| {
            Vector3::new(state.shared.x[first], state.shared.x[first + 1], state.shared.x[first + 2])
        })
    }
}
