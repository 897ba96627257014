//! Residuals of the equations, and whether they are rounding.

use crate::equations::assembled::{State, residual};
use crate::model::Model;
use crate::state::{Equilibrium, Residual, rounding_of_closure};
use cdpr_robot::Vector2;

impl Residual {
    pub(crate) fn of(model: &Model, equilibrium: &Equilibrium) -> Self {
        let r = residual(model, &State::from(equilibrium));
        let closure = (0..model.cables()).map(|i| r.fixed_rows::<2>(6 + 2 * i).norm()).fold(0.0, f64::max);
        Self { closure, force: r.fixed_rows::<3>(0).norm(), moment: r.fixed_rows::<3>(3).norm() }
    }

    /// Whether what is open is explained by rounding: the closure by that of lengths and coordinates, the wrench by that of
    /// the tensions and the load.
    pub(crate) fn is_rounding(&self, model: &Model, equilibrium: &Equilibrium) -> bool {
        let tensions: f64 = equilibrium.cable_forces.iter().map(Vector2::norm).sum();
        let load = model.load.total(model.robot, &equilibrium.pose);
        let forces = tensions + load.force.norm() + load.moment.norm() / model.arm();
        let far = |i: usize| equilibrium.pose.position.norm() + model.robot.cables[i].exit_point.norm();
        let coordinates = (0..model.cables()).map(far).fold(0.0, f64::max);
        self.closure <= rounding_of_closure(model.size(), coordinates)
            && self.force + self.moment / model.arm() <= 1e-12 * forces
    }
}
