//! A campaign to be fitted: its residuals and their cost.

use crate::campaign::Row;
use crate::error::CalibrationError;
use crate::fitted::{Difference, FitSettings};
use crate::model::compare::Compared;
use crate::model::{Model, RowAt, Shared, State};
use crate::sensor_error::SensorError;
use cdpr_robot::{Pose, Robot, UnitQuaternion, Vector3};
use rayon::prelude::*;

/// A sum of squares this many of its standard deviations above its mean is not of noise.
const UNLIKELY: f64 = 5.0;

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
        let cables = self.model.robot.cables.len();
        let noisy = |row: &Row| row.length_std.iter().any(|std| *std > 0.0);
        let own = |row: &Row| if noisy(row) || row.lengths.is_none() { cables } else { 0 };
        let lengths = |row: &Row| if row.lengths.is_some() && noisy(row) { row.length_std.len() } else { 0 };
        let measured = |row: &Row| row.readings.len() + lengths(row);
        let measurements: usize = self.rows.iter().map(measured).sum();
        let nuisances: usize = self.rows.iter().map(own).sum();
        let free = self.model.unknowns.all.iter().filter(|unknown| unknown.prior.is_none()).count();
        if self.rows.iter().all(|row| measured(row) <= own(row)) {
            let most = |of: &dyn Fn(&Row) -> usize| self.rows.iter().map(of).max().unwrap_or(0);
            return Err(CalibrationError::NoSurplus { measured: most(&measured), unknown: most(&own) });
        }
        if measurements < free + nuisances {
            return Err(CalibrationError::TooFew { measurements, unknowns: free + nuisances, nuisances });
        }
        Ok(())
    }

    pub(super) fn compared(&self, state: &State, robot: &Robot) -> Result<Vec<Compared>, CalibrationError> {
        (0..self.rows.len())
            .into_par_iter()
            .map(|k| {
                let row = &self.rows[k];
                let at = RowAt { row, shared: &state.shared, robot };
                self.model.compare(&at, &state.rows[k]).map_err(CalibrationError::row(row.line))
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

    /// Residual of the prior of each unknown that has one, with its derivative in scales.
    pub(super) fn priors(&self, shared: &Shared) -> Vec<(usize, f64, f64)> {
        let turn = UnitQuaternion::from_rotation_matrix(&shared.frame).scaled_axis();
        let frame = self.model.unknowns.sensor(SensorError::Frame);
        let value = |j: usize| match frame.and_then(|first| j.checked_sub(first)) {
            Some(k @ 0..3) => shared.origin[k] + shared.x[j],
            Some(k @ 3..6) => turn[k - 3],
            _ => shared.x[j],
        };
        let of = |(j, unknown): (usize, &crate::unknowns::Unknown)| {
            let [mean, std] = unknown.prior?;
            Some((j, (value(j) - mean) / std, unknown.scale / std))
        };
        self.model.unknowns.all.iter().enumerate().filter_map(of).collect()
    }

    pub(super) fn row_cost(&self, of: &Compared) -> f64 {
        of.residuals.iter().map(|r| self.settings.loss.loss(*r)).sum()
    }

    pub(super) fn cost(&self, compared: &[Compared], shared: &Shared) -> f64 {
        compared.iter().map(|of| self.row_cost(of)).sum::<f64>()
            + self.priors(shared).iter().map(|(_, r, _)| r * r).sum::<f64>()
    }

    /// Whether a sum of squares is greater than noise makes it.
    pub(super) fn is_unlikely(&self, sum: f64) -> bool {
        let cables = self.model.robot.cables.len();
        let surplus = |row: &Row| match row.lengths {
            Some(_) => row.readings.len(),
            None => row.readings.len().saturating_sub(cables),
        };
        let degrees = self.rows.iter().map(surplus).sum::<usize>() as f64;
        sum > degrees + UNLIKELY * (2.0 * degrees).sqrt()
    }

    pub(super) fn translation(&self, state: &State) -> Vector3<f64> {
        self.model.unknowns.sensor(SensorError::Frame).map_or_else(Vector3::zeros, |first| {
            Vector3::new(state.shared.x[first], state.shared.x[first + 1], state.shared.x[first + 2])
        })
    }
}
