//! A cable of a robot between its two points, both fixed, as a function of its chord force.

use crate::equations::spanned::{end, to_base};
use cdpr_cable::{Cable, CableError, HeldCable, LONGEST_TAUT};
use cdpr_robot::{Matrix3, Pose, Robot, Vector3};

/// Factor on the least tension that a span demands: at the least tension itself a cable's length does not
/// follow from its tension.
pub(crate) const ABOVE_LEAST: f64 = 1.001;

/// No span demands a tension above this, relative to the weight of a cable as long as the chord.
pub(crate) const ABOVE_ANY_LEAST: f64 = 1.3;

/// Bounds of the force of a cable without a guide on the platform, `σ along + V sag` with V from zero to the
/// cable's weight: with W that weight and x its centre of gravity as a share of the horizontal distance from
/// the exit point, moments about the exit point give V = x W.
pub(crate) struct Bounds {
    pub(crate) along: [f64; 3],
    pub(crate) sag: [f64; 3],
    /// Of the longest cable [N].
    pub(crate) weight: f64,
}

/// The two points of a cable at a pose, in the level frame.
#[derive(Clone, Copy)]
pub(crate) struct Ends<'a> {
    pub(crate) cable: Cable<'a>,
    /// From the exit point to the anchor point [m].
    pub(crate) end: Vector3<f64>,
    level: Option<&'a Matrix3<f64>>,
}

impl<'a> Ends<'a> {
    pub(crate) fn of(robot: &'a Robot, pose: &Pose, i: usize) -> Self {
        Self { cable: robot.cable(i), end: end(robot, pose, i), level: robot.gravity.level() }
    }

    /// The cable with the chord force `chord_force` [N].
    pub(crate) fn at_chord_force(&self, chord_force: f64) -> Result<HeldCable<'a>, CableError> {
        HeldCable::at_chord_force(&self.cable, self.end, chord_force)
    }

    /// The cable of least tension at A.
    pub(crate) fn at_least_tension(&self) -> Result<HeldCable<'a>, CableError> {
        HeldCable::at_least_tension(&self.cable, self.end)
    }

    /// The cable with the tension `tension` [N] at A.
    pub(crate) fn at_tension(&self, tension: f64) -> Result<HeldCable<'a>, CableError> {
        HeldCable::at_tension(&self.cable, self.end, tension)
    }

    /// A tension [N] above which no cable over this span comes near its least one.
    pub(crate) fn floor(&self) -> f64 {
        let longest = self.cable.straight_length_in_space(self.end);
        ABOVE_ANY_LEAST * ABOVE_LEAST * self.cable.weight_per_length * longest
    }

    /// `tension` [N], or [`ABOVE_LEAST`] times the least tension that the span demands, if that is more.
    pub(crate) fn least_allowed(&self, tension: f64) -> Result<f64, CableError> {
        if self.floor() <= tension {
            return Ok(tension);
        }
        Ok(tension.max(ABOVE_LEAST * self.at_least_tension()?.tension()))
    }

    /// Bounds of the force on the platform; `None` for a cable with a guide.
    pub(crate) fn bounds(&self) -> Option<Bounds> {
        if self.cable.guide.is_some() {
            return None;
        }
        Some(Bounds {
            along: self.chord_pull(),
            sag: self.on_platform([0.0, 0.0, 1.0]),
            weight: LONGEST_TAUT * self.cable.weight_per_length * self.end.norm(),
        })
    }

    /// The force on the platform of a straight cable from the exit point, of one newton.
    pub(crate) fn chord_pull(&self) -> [f64; 3] {
        self.on_platform((self.end / self.end.norm()).into())
    }

    /// F_i [N], the force on the platform.
    #[inline]
    pub(crate) fn force(&self, held: &HeldCable) -> [f64; 3] {
        self.on_platform(held.force().into())
    }

    /// dF_i/dσ.
    #[inline]
    pub(crate) fn force_slope(&self, held: &HeldCable) -> [f64; 3] {
        self.on_platform(held.force_slope.into())
    }

    /// dF_i/dr_i at the same chord force [N/m].
    pub(crate) fn force_per_end(&self, held: &HeldCable) -> Matrix3<f64> {
        let slopes = -held.force_per_end();
        self.level.map_or(slopes, |level| level.transpose() * slopes * level)
    }

    /// d²F_i/dσ² [1/N] and d²t/dσ² [1/N].
    pub(crate) fn curvatures(&self, held: &HeldCable) -> ([f64; 3], f64) {
        let force = held.force_curvature();
        (self.on_platform(force.into()), held.tension_curvature(&force))
    }

    fn on_platform(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        to_base(self.level, [-x, -y, -z])
    }
}
