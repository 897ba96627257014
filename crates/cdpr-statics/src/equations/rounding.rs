//! Residuals of the equations, and whether rounding explains them.

use crate::equations::assembled::{State, closure_row, residual};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Residual, rounding_of_closure};
use cdpr_robot::{Pose, Vector2};

/// Rounding error of the balance over the sum of all forces in it.
pub(crate) const FORCES: f64 = 1e-12;

impl DirectProblem<'_> {
    /// What an equilibrium, or a pose with forces that need not be one, leaves open in the `6 + 2n`
    /// equations.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless the equilibrium is finite and has one force for each cable.
    pub fn residual(&self, equilibrium: &Equilibrium) -> Result<Residual, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        Ok(Residual::of(self, equilibrium))
    }

    /// The largest coordinates of a cable's points at a pose [m], whose rounding its closure shows.
    pub(crate) fn coordinates(&self, pose: &Pose) -> f64 {
        let exits = self.robot.cables.iter().map(|cable| cable.exit_point.norm_squared());
        pose.position.norm() + exits.fold(0.0, f64::max).sqrt()
    }
}

impl Residual {
    pub(crate) fn of(problem: &DirectProblem, equilibrium: &Equilibrium) -> Self {
        let mut r = residual(problem, &State::from(equilibrium));
        let freedoms = problem.robot.freedoms();
        (0..6).filter(|k| !freedoms.contains(*k)).for_each(|k| r[k] = 0.0);
        let closure =
            (0..problem.cables()).map(|i| r.fixed_rows::<2>(closure_row(i)).norm()).fold(0.0, f64::max);
        Self { closure, force: r.fixed_rows::<3>(0).norm(), moment: r.fixed_rows::<3>(3).norm() }
    }

    /// Whether rounding explains the residual: of lengths and coordinates the closure, of tensions and load
    /// the wrench.
    pub(crate) fn is_rounding(&self, problem: &DirectProblem, equilibrium: &Equilibrium) -> bool {
        let coordinates = problem.coordinates(&equilibrium.pose);
        self.closure <= rounding_of_closure(problem.size(), coordinates)
            && self.force + self.moment / problem.characteristic_length()
                <= FORCES * forces(problem, equilibrium)
    }
}

/// The forces that a residual is compared with: of all cables, weight and load [N].
pub(crate) fn forces(problem: &DirectProblem, equilibrium: &Equilibrium) -> f64 {
    let tensions: f64 = equilibrium.cable_forces.iter().map(Vector2::norm).sum();
    let load = problem.load.total(problem.robot, &equilibrium.pose);
    tensions + load.force.norm() + load.moment.norm() / problem.characteristic_length()
}
