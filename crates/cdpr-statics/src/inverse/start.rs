//! Tensions of straight cables, from which the inverse model and the maxima are searched.
//!
//! In directions along the chords the balance is linear: `cdpr_tension` finds the tensions nearest to the
//! reference, the greatest payload and the greatest margin there, or a direction along which no tensions
//! within the limits balance the wrench. Sagging cables need not keep it: `feasible` checks whether they do.

use super::question::Question;
use cdpr_robot::{Matrix6xX, TensionLimits, Vector3, Vector6};
use cdpr_tension::{Distribution, Objective, Problem, TensionError, distribute};
use nalgebra::DVector;

/// Where a search begins.
pub(super) struct StraightStart {
    /// Tensions within the limits [N].
    pub(super) tensions: Vec<f64>,
    /// The objective, of tensions that balance the wrench.
    pub(super) value: Option<f64>,
    /// |W t + w|, relative to wrench and tensions.
    pub(super) residue: f64,
    /// The unit wrench, its moment divided by a length, along which straight cables cannot balance the
    /// wrench.
    pub(super) certificate: Option<Vector6<f64>>,
}

/// What a search begins with.
pub(super) enum Goal<'a> {
    /// The tensions nearest to the reference.
    Nearest,
    /// The greatest multiple of a wrench, its moment divided by a length.
    Wrench(&'a Vector6<f64>),
    /// The greatest distance from limits.
    Margin(&'a [TensionLimits]),
    /// The least 1-norm.
    LeastSum,
    /// The least infinity-norm.
    LeastGreatest,
}

impl Question<'_> {
    /// The tensions of straight cables that meet a goal, or those nearest to a balance.
    pub(super) fn straight(&self, goal: &Goal) -> StraightStart {
        let components = self.robot.freedoms().components();
        let wrench_matrix = self.straight_matrix().select_rows(&components);
        let pick = |wrench: &Vector6<f64>| {
            DVector::from_iterator(components.len(), components.iter().map(|k| wrench[*k]))
        };
        let wrench = pick(&self.external);
        let direction;
        let objective = match goal {
            Goal::Nearest => Objective::Nearest(&self.reference),
            Goal::Wrench(along) => {
                direction = pick(along);
                Objective::GreatestWrench(&direction)
            }
            Goal::Margin(limits) => Objective::GreatestMargin(limits),
            Goal::LeastSum => Objective::LeastSum,
            Goal::LeastGreatest => Objective::LeastGreatest,
        };
        let problem = Problem { wrench_matrix: &wrench_matrix, wrench: &wrench, limits: &self.limits };
        match distribute(&problem, objective) {
            Ok(Distribution { tensions, value, .. }) => {
                StraightStart { tensions, value: Some(value), residue: 0.0, certificate: None }
            }
            Err(TensionError::Infeasible { tensions, residual, certificate, .. }) => {
                let mut direction = Vector6::zeros();
                components.iter().zip(&certificate).for_each(|(k, y)| direction[*k] = *y);
                let residue = residual / (wrench.norm() + tensions.iter().sum::<f64>());
                StraightStart { tensions, value: None, residue, certificate: Some(direction) }
            }
            // A start is no answer: without one from Clarabel the search begins at the reference.
            Err(_) => {
                let each = self.reference.iter().zip(&self.limits);
                let tensions = each.map(|(t, limits)| t.max(limits.min).min(limits.max)).collect();
                StraightStart { tensions, value: None, residue: 0.0, certificate: None }
            }
        }
    }

    /// Wrench matrix of cables along their chords, moments divided by the characteristic length.
    pub(super) fn straight_matrix(&self) -> Matrix6xX<f64> {
        let (robot, pose) = (self.robot, self.pose);
        let pulls: Vec<Vector3<f64>> = (0..self.cables()).map(|i| -robot.span(pose, i).normalize()).collect();
        let mut matrix = robot.wrench_matrix(pose, &pulls);
        matrix.fixed_rows_mut::<3>(3).unscale_mut(self.arm);
        matrix
    }
}
