//! Convex quadratic programs, as the steps of sequential quadratic programming are.

use crate::problem::TensionError;
use crate::program::{Outcome, Program};
use nalgebra::DMatrix;

/// `minimize ½ xᵀHx + cᵀx  subject to  B x <= d,  l <= x <= u`.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadraticProgram {
    /// H, symmetric and positive semidefinite, of the first unknowns; the others enter linearly.
    pub hessian: DMatrix<f64>,
    /// c, one for each unknown.
    pub gradient: Vec<f64>,
    /// Rows of B with d.
    pub inequalities: Vec<(Vec<f64>, f64)>,
    /// l and u of each unknown, which may be infinite.
    pub bounds: Vec<[f64; 2]>,
}

/// A solution of a [`QuadraticProgram`] to Clarabel's tolerances.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadraticSolution {
    /// x.
    pub values: Vec<f64>,
    /// Multiplier of each inequality, zero or more.
    pub multipliers: Vec<f64>,
}

impl QuadraticProgram {
    /// The solution.
    ///
    /// # Errors
    /// [`TensionError::Solver`] for a program without a solution, and where Clarabel does not find it.
    pub fn solve(&self) -> Result<QuadraticSolution, TensionError> {
        let program = Program {
            gradient: self.gradient.clone(),
            curvature: vec![0.0; self.gradient.len()],
            hessian: self.hessian.column_iter().map(|column| column.iter().copied().collect()).collect(),
            inequalities: self.inequalities.clone(),
            bounds: self.bounds.clone(),
            equations: Vec::new(),
        };
        match program.solve()? {
            Outcome::Solved(found) => {
                Ok(QuadraticSolution { values: found.values, multipliers: found.multipliers })
            }
            Outcome::Infeasible(_) => Err(TensionError::Solver { status: "infeasible program".to_owned() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_of_a_half_plane_is_its_foot_and_the_multiplier_its_distance() {
        // Nearest to (2, 1) with x + y <= 1, x >= 0.5: (1, 0), whose multiplier is 1; H couples the unknowns.
        let nearest = |hessian: [f64; 4], gradient: [f64; 2]| {
            let program = QuadraticProgram {
                hessian: DMatrix::from_row_slice(2, 2, &hessian),
                gradient: gradient.to_vec(),
                inequalities: vec![(vec![1.0, 1.0], 1.0)],
                bounds: vec![[0.5, f64::INFINITY], [f64::NEG_INFINITY, f64::INFINITY]],
            };
            program.solve().unwrap()
        };
        let found = nearest([1.0, 0.0, 0.0, 1.0], [-2.0, -1.0]);
        assert!((found.values[0] - 1.0).abs() < 1e-8 && found.values[1].abs() < 1e-8, "{found:?}");
        assert!((found.multipliers[0] - 1.0).abs() < 1e-8, "{found:?}");
        // ½(2x² + 2xy + 2y²) - 4x - 3y on the line y = 1 - x is x² - 2x - 2, least at x = 1, where the
        // gradient is (-2, -2).
        let found = nearest([2.0, 1.0, 1.0, 2.0], [-4.0, -3.0]);
        assert!((found.values[0] - 1.0).abs() < 1e-8 && found.values[1].abs() < 1e-8, "{found:?}");
        assert!((found.multipliers[0] - 2.0).abs() < 1e-8, "{found:?}");
    }
}
