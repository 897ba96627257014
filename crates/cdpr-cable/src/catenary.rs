//! A cable in equilibrium, as a plain type.
//!
//! What follows from the force at its end is in the modules of this folder.

pub(crate) mod guided;
mod mechanics;
pub(crate) mod shape;
pub(crate) mod spatial;

use crate::cable::Cable;
use crate::error::{CableError, check, check_length};
use nalgebra::Vector2;

/// A cable is slack where the tension at its lower end is at most this multiple of its own weight.
///
/// It then carries next to nothing but itself: between ends at the same height it sags by a seventh of its
/// span or more. A cable without weight is slack where it carries nothing.
pub const SLACK_BELOW_OWN_WEIGHTS: f64 = 1.0;

/// No cable without a guide whose tension rises with its chord force is longer than this many chords: the one
/// of least tension over a level span has 1.2584.
pub const LONGEST_TAUT: f64 = 1.3;

/// Whether a cable with this weight beyond its exit point [N] is slack with these tensions at its ends [N].
pub fn is_slack(weight: f64, [one, other]: [f64; 2]) -> bool {
    one.min(other) <= SLACK_BELOW_OWN_WEIGHTS * weight
}

/// A cable in equilibrium: its unstrained length and the force applied to it at the anchor point A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Catenary<'a> {
    /// The cable.
    pub cable: Cable<'a>,
    /// Unstrained length L [m].
    pub unstrained_length: f64,
    /// Force `(fx, fz)` on the cable at A, in the cable's plane [N]; `fx >= 0`.
    pub force: Vector2<f64>,
}

impl<'a> Catenary<'a> {
    /// The cable of unstrained length `unstrained_length` [m] with the force `(fx, fz)` [N] at A.
    ///
    /// # Errors
    /// [`CableError::InvalidInput`] for an invalid value, for a force that pushes towards the exit point, and
    /// for a slack cable without weight, which has no shape.
    pub fn new(cable: Cable<'a>, unstrained_length: f64, force: Vector2<f64>) -> Result<Self, CableError> {
        cable.validate()?;
        check_length(unstrained_length)?;
        check(
            "force.x",
            force.x,
            force.x >= 0.0,
            "a horizontal force away from the exit point, zero or more [N]",
        )?;
        check("force.z", force.y, true, "a finite vertical force [N]")?;
        let catenary = Self { cable, unstrained_length, force };
        check(
            "force",
            0.0,
            !catenary.is_slack_and_weightless(),
            "a force other than zero on a cable without weight [N]",
        )?;
        Ok(catenary)
    }

    /// Tension at the anchor point A [N].
    #[inline]
    pub fn anchor_tension(&self) -> f64 {
        self.force.norm()
    }

    /// Tension at the exit point B, or where the cable leaves its pulley [N].
    #[inline]
    pub fn exit_tension(&self) -> f64 {
        Vector2::new(self.force.x, self.exit_vertical_force()).norm()
    }

    /// Vertical component V0 of the cable's tension at B [N], `fz - w L` with the length beyond B.
    pub fn exit_vertical_force(&self) -> f64 {
        self.force.y - self.weight()
    }

    /// Weight of the cable beyond B [N], w L without a guide.
    #[inline]
    pub fn weight(&self) -> f64 {
        let w = self.cable.weight_per_length;
        // A slack cable without weight has no leave point.
        if w == 0.0 { 0.0 } else { w * self.free_length() }
    }

    /// Unstrained length beyond the exit point or, with a pulley, beyond the leave point [m].
    #[inline]
    pub fn free_length(&self) -> f64 {
        match &self.cable.guide {
            None => self.unstrained_length,
            Some(guide) => self.guided(guide).free,
        }
    }

    /// Length of the cable without tension and weight [m], `L (1 + ε(0))`.
    ///
    /// It differs from L where a piecewise law has kept a strain.
    #[inline]
    pub fn length_at_rest(&self) -> f64 {
        self.unstrained_length * (1.0 + self.cable.strain(0.0))
    }

    /// Whether it carries next to nothing but its own weight, see [`SLACK_BELOW_OWN_WEIGHTS`].
    pub fn is_slack(&self) -> bool {
        is_slack(self.weight(), [self.anchor_tension(), self.exit_tension()])
    }

    /// Whether this is a slack cable without weight.
    ///
    /// Such a cable carries nothing, resists nothing and has no shape: its end position and flexibility are
    /// undefined.
    #[inline]
    pub fn is_slack_and_weightless(&self) -> bool {
        self.force == Vector2::zeros() && self.cable.is_weightless(self.unstrained_length)
    }
}
