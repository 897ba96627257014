//! Tensions of straight cables, from which the inverse model and the maxima are searched.
//!
//! In directions along the chords the balance is linear. The tensions nearest to the reference have a closed
//! form without regard to limits. With limits Clarabel finds them, the greatest payload and the greatest
//! margin, or a direction along which no tensions within the limits balance the wrench. Sagging cables need
//! not keep it: `feasible` checks whether they do.

use super::problem::InverseProblem;
use cdpr_robot::{Matrix6xX, Vector3, Vector6};
use cdpr_tension::{Distribution, Objective, Problem, TensionError, distribute};
use nalgebra::{DMatrix, DVector};

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

/// Wrench matrix and wrench of straight cables, for the motions that the platform has.
struct Straight {
    matrix: DMatrix<f64>,
    wrench: DVector<f64>,
}

impl InverseProblem<'_> {
    /// The tensions of straight cables nearest to the reference in closed form, each moved into its limits;
    /// `None` where the cables do not pull in all directions.
    pub(super) fn closed_form(&self) -> Option<Vec<f64>> {
        let nearest = self.straight_problem(&self.balance()).closed_form(&self.reference)?;
        Some(self.within_limits(nearest.as_slice()))
    }

    /// The tensions of straight cables that an objective chooses, or those nearest to a balance.
    pub(super) fn straight(&self, objective: Objective) -> StraightStart {
        let balance = self.balance();
        match distribute(&self.straight_problem(&balance), objective) {
            Ok(Distribution { tensions, value, .. }) => {
                StraightStart { tensions, value: Some(value), residue: 0.0, certificate: None }
            }
            Err(TensionError::Infeasible { tensions, residual, certificate, .. }) => {
                let mut direction = Vector6::zeros();
                let components = self.robot.freedoms().components();
                components.iter().zip(&certificate).for_each(|(k, y)| direction[*k] = *y);
                let residue = residual / (balance.wrench.norm() + tensions.iter().sum::<f64>());
                StraightStart { tensions, value: None, residue, certificate: Some(direction) }
            }
            // A start is not a solution: without one from Clarabel the search begins at the reference.
            Err(_) => {
                let tensions = self.within_limits(&self.reference);
                StraightStart { tensions, value: None, residue: 0.0, certificate: None }
            }
        }
    }

    fn balance(&self) -> Straight {
        let matrix = self.straight_matrix().select_rows(&self.robot.freedoms().components());
        Straight { matrix, wrench: self.components_of(&self.external) }
    }

    fn straight_problem<'b>(&'b self, straight: &'b Straight) -> Problem<'b> {
        Problem { wrench_matrix: &straight.matrix, wrench: &straight.wrench, limits: &self.limits }
    }

    /// The components of a wrench along the motions that the platform has.
    pub(super) fn components_of(&self, wrench: &Vector6<f64>) -> DVector<f64> {
        let components = self.robot.freedoms().components();
        DVector::from_iterator(components.len(), components.iter().map(|k| wrench[*k]))
    }

    fn within_limits(&self, tensions: &[f64]) -> Vec<f64> {
        let each = tensions.iter().zip(&self.limits);
        each.map(|(t, limits)| t.max(limits.min).min(limits.max)).collect()
    }

    /// Wrench matrix of cables along their chords, moments divided by the characteristic length.
    pub(super) fn straight_matrix(&self) -> Matrix6xX<f64> {
        let (robot, pose) = (self.robot, self.pose);
        let pulls: Vec<Vector3<f64>> = (0..self.cables()).map(|i| -robot.span(pose, i).normalize()).collect();
        let mut matrix = robot.wrench_matrix(pose, &pulls);
        matrix.fixed_rows_mut::<3>(3).unscale_mut(self.characteristic_length);
        matrix
    }
}
