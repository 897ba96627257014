//! Force and moment on the platform.

use nalgebra::{Vector3, Vector6};

/// Force and moment on the platform, in the base frame, the moment about P.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force [N].
    pub force: Vector3<f64>,
    /// Moment about P [N m].
    pub moment: Vector3<f64>,
}

impl Wrench {
    /// The zero wrench.
    #[inline]
    pub fn none() -> Self {
        Self { force: Vector3::zeros(), moment: Vector3::zeros() }
    }

    /// The wrench [F; s x F] about P of a force F [N] at a point with the lever s [m] from P.
    #[inline]
    pub fn of_force_at(lever: &Vector3<f64>, force: Vector3<f64>) -> Self {
        Self { force, moment: lever.cross(&force) }
    }

    /// (force, moment) as one vector [N, N m].
    pub fn to_vector(&self) -> Vector6<f64> {
        Vector6::new(self.force.x, self.force.y, self.force.z, self.moment.x, self.moment.y, self.moment.z)
    }

    /// The wrench of (force, moment) as one vector [N, N m].
    pub fn from_vector(v: &Vector6<f64>) -> Self {
        Self { force: Vector3::new(v[0], v[1], v[2]), moment: Vector3::new(v[3], v[4], v[5]) }
    }
}

impl std::ops::Add for Wrench {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { force: self.force + other.force, moment: self.moment + other.moment }
    }
}
