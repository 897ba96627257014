//! Newton's steps on the cables that are at no limit, with the exact Hessian.

use super::{ELASTICITY, Point};
use crate::dense::Indefinite;
use cdpr_robot::Vector6;
use nalgebra::{DMatrix, DVector};

impl Point<'_> {
    /// Newton's step on the free cables with the exact Hessian; `None` unless it leads to a minimum and stays
    /// within the limits.
    pub(super) fn exact_step(&self, hessian: &[f64], elasticity: f64) -> Option<(Vec<f64>, Vector6<f64>)> {
        let fixed: Vec<_> = self.cables.iter().map(|cable| cable.at_limit().map(|_| 0.0)).collect();
        let (step, multipliers) = self.newton_step(hessian, &fixed, elasticity)?;
        let mut each = self.cables.iter().zip(&step).zip(&fixed);
        let within = each.all(|((cable, d), fixed)| fixed.is_some() || cable.passed(*d).is_none());
        within.then_some((step, multipliers))
    }

    /// The same with the balance kept exactly, which needs cables that can pull in all directions.
    pub(super) fn inelastic_step(&self, hessian: &[f64]) -> Option<(Vec<f64>, Vector6<f64>)> {
        let free = self.cables.iter().filter(|cable| cable.at_limit().is_none()).count();
        let balanced = (0..6).filter(|row| !self.is_constrained(*row)).count();
        let (step, multipliers) = self.exact_step(hessian, 0.0).filter(|_| free >= balanced)?;
        let small = step.iter().zip(&self.cables).all(|(d, cable)| d.abs() <= 1e-3 * cable.fixed.chord_force);
        small.then_some((step, multipliers))
    }

    /// Whether a row of the balance is of a constrained motion: no cable takes part in it.
    fn is_constrained(&self, row: usize) -> bool {
        self.rows.iter().all(|of_cable| of_cable.slope[row] == 0.0)
    }

    /// Newton's step and the new multipliers, with the steps of some cables given: the others are free.
    /// `None` unless it leads to a minimum over the free cables.
    pub(crate) fn newton_step(
        &self,
        hessian: &[f64],
        fixed: &[Option<f64>],
        elasticity: f64,
    ) -> Option<(Vec<f64>, Vector6<f64>)> {
        let mut step: Vec<f64> = fixed.iter().map(|fixed| fixed.unwrap_or(0.0)).collect();
        let residual =
            self.rows.iter().zip(&step).fold(self.residual(), |sum, (row, d)| sum + row.slope * *d);
        let free: Vec<usize> = (0..fixed.len()).filter(|i| fixed[*i].is_none()).collect();
        let k = free.len();
        let mut kkt = DMatrix::zeros(k + 6, k + 6);
        let mut right = DVector::zeros(k + 6);
        for (column, &i) in free.iter().enumerate() {
            kkt[(column, column)] = hessian[i];
            right[column] = -self.rows[i].gradient();
            for row in 0..6 {
                kkt[(k + row, column)] = self.rows[i].slope[row];
            }
        }
        for row in 0..6 {
            let elasticity = if self.is_constrained(row) { ELASTICITY } else { elasticity };
            kkt[(k + row, k + row)] = -elasticity;
            right[k + row] = -residual[row] - elasticity * self.multipliers[row];
        }
        // The reduced Hessian is positive where the matrix has as many positive eigenvalues as free cables.
        let factors = Indefinite::new(&kkt);
        if free.iter().any(|i| hessian[*i] <= 0.0) && factors.eigenvalues_by_sign().0 != k {
            return None;
        }
        let solution = factors.solve(&right)?;
        for (row, &i) in free.iter().enumerate() {
            step[i] = solution[row];
        }
        Some((step, solution.fixed_rows::<6>(k).into()))
    }
}
