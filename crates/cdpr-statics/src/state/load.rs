//! Loads on the platform.

use cdpr_robot::{Pose, Robot, Wrench};

/// Load on the platform besides its own weight and the cables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Mass added at the platform's centre of mass [kg].
    pub payload: f64,
    /// Wrench of constant components in the base frame, about P [N, N m].
    pub wrench: Wrench,
}

impl Load {
    /// No load: the platform carries its own weight only.
    pub fn none() -> Self {
        Self { payload: 0.0, wrench: Wrench::none() }
    }

    /// A mass [kg] added at the platform's centre of mass.
    pub fn payload(mass: f64) -> Self {
        Self { payload: mass, ..Self::none() }
    }

    /// Force and moment [N, N m].
    pub fn wrench(wrench: Wrench) -> Self {
        Self { wrench, ..Self::none() }
    }

    /// The load at a share of the way to another one.
    pub(crate) fn between(&self, other: &Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| if share == 1.0 { b } else { a + share * (b - a) };
        let wrench = self.wrench.to_vector().zip_map(&other.wrench.to_vector(), mix);
        Self { payload: mix(self.payload, other.payload), wrench: Wrench::from_vector(&wrench) }
    }

    /// Wrench w_ex of weight and load about P [N, N m].
    pub(crate) fn total(&self, robot: &Robot, pose: &Pose) -> Wrench {
        robot.weight(pose, self.payload) + self.wrench
    }
}
