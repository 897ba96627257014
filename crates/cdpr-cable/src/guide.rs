//! What leads a cable from its winch to the point where it leaves for the platform.

use crate::error::{CableError, check};
use nalgebra::Vector3;

/// A lead and a swivelling pulley.
///
/// The cable comes from the winch over the distance `lead`, enters the pulley at the point D on the swivel
/// axis, along the axis, lies on the wheel for an arc and leaves it along the tangent of the catenary. The
/// wheel turns about the axis until its plane contains that tangent. Without a pulley (`radius` zero) the
/// cable bends at D as at any exit point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guide {
    /// Stretched length between winch and D [m].
    pub lead: f64,
    /// Radius of the pulley to the middle of the cable [m].
    pub radius: f64,
    /// How the cable enters at D.
    pub entry: Entry,
}

/// The direction in which a cable travels where it enters its pulley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// From below: the cable leaves over the top of the wheel.
    Upwards,
    /// From above: the cable leaves under the wheel.
    Downwards,
    /// Along this unit vector.
    ///
    /// Of a cable in its vertical plane, such as that of a [`crate::Catenary`], its components are those
    /// forwards from D, across the plane to the left and upwards; of a [`crate::SpatialCable`] those along
    /// x, y and z, upwards.
    Along([f64; 3]),
}

impl Entry {
    /// The direction as a unit vector, upwards its last component.
    #[inline]
    pub fn axis(self) -> [f64; 3] {
        match self {
            Self::Upwards => [0.0, 0.0, 1.0],
            Self::Downwards => [0.0, 0.0, -1.0],
            Self::Along(axis) => axis,
        }
    }

    /// Whether the direction is not vertical, so that the plane of the wheel need not be that of the cable.
    #[inline]
    pub fn is_tilted(self) -> bool {
        matches!(self, Self::Along(_))
    }
}

impl Guide {
    /// Checks that lead and radius are zero or more.
    ///
    /// # Errors
    /// [`CableError::InvalidInput`] names the field.
    pub fn validate(&self) -> Result<(), CableError> {
        check(
            "lead",
            self.lead,
            self.lead >= 0.0,
            "a length between winch and exit point, zero or more [m]",
        )?;
        check("pulley.radius", self.radius, self.radius >= 0.0, "a radius, zero or more [m]")
    }

    /// Closure residual [m] of a slack cable without weight, as [`crate::kernel::closure_of_limp`] has it,
    /// along a straight cable to `end` [m]: forwards, across and upwards, or in space.
    pub fn closure_of_limp(&self, end: Vector3<f64>, rest: f64) -> Vector3<f64> {
        let Some(Straight { leave, free, guided }) = self.straight(end) else {
            return end * (1.0 - rest / end.norm()).max(0.0);
        };
        let missing = (free + guided - rest).max(0.0);
        let direction = if free > 0.0 { (end - leave) / free } else { Vector3::x() };
        direction * missing
    }

    /// Where a straight cable to `end` [m] from D leaves the wheel; `None` where `end` lies within the wheel,
    /// or where the cable would have to lean back towards the swivel axis.
    pub fn straight(&self, end: Vector3<f64>) -> Option<Straight> {
        let r = self.radius;
        if r == 0.0 {
            return Some(Straight { leave: Vector3::zeros(), free: end.norm(), guided: self.lead });
        }
        // Away from the swivel axis, and along it.
        let axis = Vector3::from(self.entry.axis());
        let height = end.dot(&axis);
        let away = end - height * axis;
        let x = away.norm();
        // From the centre, r away, the end lies at the distance e; the tangent is sqrt(e² - r²) long.
        let from_center = x - r;
        let free = from_center.mul_add(from_center, height * height - r * r);
        if free <= 0.0 {
            return None;
        }
        let free = free.sqrt();
        // With n the unit vector from the centre to the leave point and τ = (sin, -cos) along the cable,
        // the end is at r n + free τ from the centre.
        let psi = (height * r + from_center * free).atan2(from_center * r - height * free);
        let (sin, cos) = psi.sin_cos();
        let arc = r * (std::f64::consts::PI - psi);
        let outwards = if x > 0.0 { away / x } else { Vector3::x() };
        (psi > 0.0).then_some(Straight {
            leave: r * (1.0 + cos) * outwards + r * sin * axis,
            free,
            guided: self.lead + arc,
        })
    }
}

/// A point (x, z) of a cable's plane [m], forwards, across and upwards.
pub(crate) fn in_plane([x, z]: [f64; 2]) -> Vector3<f64> {
    Vector3::new(x, 0.0, z)
}

/// A straight cable over a guide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Straight {
    /// Leave point from D [m].
    pub leave: Vector3<f64>,
    /// Length beyond it [m].
    pub free: f64,
    /// Length of lead and arc [m].
    pub guided: f64,
}
