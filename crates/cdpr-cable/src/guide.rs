//! What leads a cable from its winch to the point where it leaves for the platform.

use crate::error::{CableError, check};
use crate::kernel::closure_of_limp;

/// A lead and a swivelling pulley with a vertical swivel axis.
///
/// The cable comes from the winch over the distance `lead`, enters the pulley at the point D on the swivel
/// axis, along the axis, lies on the wheel for an arc and leaves it along the tangent of the catenary. The
/// wheel turns about the axis into the plane of the cable. Without a pulley (`radius` zero) the cable bends
/// at D as at any exit point.
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// From below: the cable leaves over the top of the wheel.
    Upwards,
    /// From above: the cable leaves under the wheel.
    Downwards,
}

impl Entry {
    /// 1 upwards, -1 downwards.
    #[inline]
    pub fn sign(self) -> f64 {
        match self {
            Self::Upwards => 1.0,
            Self::Downwards => -1.0,
        }
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
    /// along a straight cable.
    pub fn closure_of_limp(&self, end: [f64; 2], rest: f64) -> [f64; 2] {
        let Some(Straight { leave, free, guided }) = self.straight(end) else {
            return closure_of_limp(end, rest);
        };
        let missing = (free + guided - rest).max(0.0) / free;
        [0, 1].map(|k| (end[k] - leave[k]) * missing)
    }

    /// Where a straight cable to `end = (x, z)` [m] from D leaves the wheel; `None` where `end` lies within
    /// the wheel, or where the cable would have to lean back towards the swivel axis.
    pub(crate) fn straight(&self, [x, z]: [f64; 2]) -> Option<Straight> {
        let (r, up) = (self.radius, self.entry.sign());
        if r == 0.0 {
            return Some(Straight { leave: [0.0; 2], free: x.hypot(z), guided: self.lead });
        }
        // From the centre (r, 0) the end lies at the distance e; the tangent is sqrt(e² - r²) long.
        let (from_center, height) = (x - r, up * z);
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
        (psi > 0.0).then_some(Straight {
            leave: [r * (1.0 + cos), up * r * sin],
            free,
            guided: self.lead + arc,
        })
    }
}

/// A straight cable over a guide.
pub(crate) struct Straight {
    /// Leave point from D [m].
    pub(crate) leave: [f64; 2],
    /// Length beyond it [m].
    pub(crate) free: f64,
    /// Length of lead and arc [m].
    pub(crate) guided: f64,
}
