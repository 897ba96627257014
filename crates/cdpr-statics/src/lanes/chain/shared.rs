//! What all robots of a batch share.

use crate::local::cable::Shape;
use crate::local::platform::Scale;
use crate::out_of_limits::allowed;
use cdpr_robot::{CableEnd, Robot, TensionLimits};

/// A change of tensions that are still to be offset below this, relative to the longest cable or the sum of
/// tensions, is the last one: their error then changes no position by more than 1e-12 m.
pub(crate) const LAST_DISTRIBUTION: f64 = 1e-9;

/// The square of such a change over the change before it, which is what slowly converging steps leave: an
/// upper bound.
pub(crate) const LAST_REMAINDER: f64 = 1e-11;

/// Part of its own force by which the steps after the last one may change a cable: its length then changes by
/// that part of its strain and its sag.
pub(crate) const LAST_SHARE: f64 = 5e-10;

/// Iterations for the tensions, whose limits may change on the way.
pub(crate) const MAX_DISTRIBUTIONS: usize = 20;

/// The tensions that a cable may have, and the one that is preferred.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Choice {
    /// r [N].
    pub(crate) reference: f64,
    /// Least and greatest tension allowed [N].
    pub(crate) limits: TensionLimits,
    /// Where the greatest tension is limited.
    pub(crate) max_at: CableEnd,
    /// The lesser one of the greatest tension and the breaking force [N].
    pub(crate) bearable: f64,
    /// The shape that the nominal robot gives it.
    pub(crate) shape: Shape<f64>,
}

impl Choice {
    /// What cable `i` of a robot may have.
    pub(crate) fn new(robot: &Robot, i: usize, reference: f64, shape: Shape<f64>) -> Self {
        let limits = allowed(robot, i);
        Self { reference, limits, max_at: robot.max_at(i), bearable: limits.max, shape }
    }
}

/// What all robots of a batch share.
#[derive(Clone, Debug)]
pub(crate) struct Shared {
    /// For each cable.
    pub(crate) choices: Vec<Choice>,
    /// Sum of the tensions that changes are compared with [N].
    pub(crate) tension: f64,
    /// Sum of the forces that their balance is compared with [N].
    pub(crate) forces: f64,
    /// Lengths that positions are compared with.
    pub(crate) scale: Scale,
    /// Whether a cable may come near the least tension of its span.
    pub(crate) may_be_slack: bool,
    /// Height of the ground where free coordinates are found [m]; -∞ without one, +∞ where lanes cannot tell
    /// because the base may be tilted.
    pub(crate) ground: f64,
}

impl Shared {
    /// The ground of a robot in lanes.
    pub(crate) fn ground(robot: &Robot) -> f64 {
        match robot.ground_z {
            None => f64::NEG_INFINITY,
            Some(_) if robot.gravity.is_vector() => f64::INFINITY,
            Some(height) => height,
        }
    }
}
