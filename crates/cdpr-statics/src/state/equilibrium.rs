//! An equilibrium: a pose with the forces of its cables.

use cdpr_cable::Catenary;
use cdpr_robot::{Pose, Robot, Vector2};

/// A pose with the force on every cable at its anchor point.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// Pose of the platform.
    pub pose: Pose,
    /// Force `(fx, fz)` on each cable at A, in the cable's vertical plane [N]. The platform receives the
    /// opposite, F_i.
    pub cable_forces: Vec<Vector2<f64>>,
}

impl Equilibrium {
    /// Tension of every cable at the platform [N].
    pub fn tensions(&self) -> Vec<f64> {
        self.cable_forces.iter().map(Vector2::norm).collect()
    }

    /// Tension of every cable at its exit point [N], for the robot and unstrained lengths [m] that it is an
    /// equilibrium of.
    pub fn exit_tensions(&self, robot: &Robot, lengths: &[f64]) -> Vec<f64> {
        let each = self.cable_forces.iter().zip(lengths).enumerate();
        each.map(|(i, (force, length))| {
            Catenary { cable: robot.cable(i), unstrained_length: *length, force: *force }.exit_tension()
        })
        .collect()
    }
}
