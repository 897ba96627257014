//! An equilibrium: a pose with the forces of its cables.

use cdpr_robot::{Pose, Vector2};

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
}
