//! A cable between held ends, as a function of its chord force.
//!
//! With both ends held one number describes the cable. The tension t at A is a poor one: it has a minimum
//! over the length, where every derivative with respect to t is infinite. The chord force
//!
//! ```text
//! σ = fx c/h,      c the chord, h its horizontal part                                            (C16)
//! ```
//!
//! is the part of the force at A along the chord when the rest is vertical (Irvine 1981, section 2.5). It is
//! the tension of a straight cable, differs little from that of a taut one, and falls steadily while cable is
//! paid out, through the least tension and beyond. How force and length follow from σ is in `closed`.

mod closed;

use crate::cable::Cable;
use crate::catenary::Catenary;
use crate::catenary::spatial::{SpatialCable, flat, lifted};
use crate::error::{CableError, SMALLEST, check, check_length};
use crate::solve::spatial::check_end;
use nalgebra::Vector3;

/// A cable between held ends, with the derivatives of its force with respect to the chord force σ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldCable<'a> {
    /// The equilibrium in the vertical plane that the cable hangs in. The axis of a tilted pulley has the
    /// components along x, y and z.
    pub catenary: Catenary<'a>,
    /// Horizontal direction of that plane.
    pub azimuth: [f64; 2],
    /// Position of A from the exit point [m].
    pub end: Vector3<f64>,
    /// Chord force σ [N], (C16).
    pub chord_force: f64,
    /// dF/dσ, (C38).
    pub force_slope: Vector3<f64>,
    /// dL/dσ [m/N], always negative.
    pub length_slope: f64,
    /// Unstrained length beyond its guide [m].
    free_length: f64,
    /// Its derivative by σ [m/N].
    free_slope: f64,
}

/// A cable below this chord force, relative to its weight per length times the chord, is nearly vertical and
/// folded, or has passed its least tension. Its tension at A is within 1e-10 of its weight of that at any
/// lower chord force, which rounding of the vertical force at B would hide.
const FOLDED: f64 = 1.0 / 24.0;

/// Share of the chord that stands for the horizontal distance of a vertical cable: far below rounding.
const VERTICAL: f64 = 1e-20;

/// c/h of a span.
fn per_horizontal(end: Vector3<f64>) -> f64 {
    let (h, _) = flat(end);
    end.norm() / h.x.max(VERTICAL * end.norm())
}

impl<'a> HeldCable<'a> {
    /// The cable to A at `end` [m] from its exit point with the chord force `chord_force` [N].
    ///
    /// # Errors
    /// [`CableError::InvalidInput`] for an invalid value; [`CableError::NotConverged`] with the residual.
    pub fn at_chord_force(
        cable: &Cable<'a>,
        end: Vector3<f64>,
        chord_force: f64,
    ) -> Result<Self, CableError> {
        cable.validate()?;
        check_end(end)?;
        check("chord_force", chord_force, chord_force >= SMALLEST, "a chord force from 1e-30 to 1e30 [N]")?;
        let failed = match Self::near_straight(cable, end, chord_force) {
            Ok(held) => return Ok(held),
            Err(error) => error,
        };
        // A cable over a tilted axis that hangs deep is far from what its vertical plane without the wheel
        // says: paid out in steps it is found from a taut one.
        let taut = 4.0 * cable.weight_per_length * end.norm();
        if chord_force >= taut || !cable.leaves_its_plane() {
            return Err(failed);
        }
        let mut held = Self::near_straight(cable, end, taut)?;
        let mut share: f64 = 0.7;
        while held.chord_force > chord_force {
            match held.stepped((share * held.chord_force).max(chord_force)) {
                Ok(next) => held = next,
                Err(_) if share < 0.99 => share = share.sqrt(),
                Err(error) => return Err(error),
            }
        }
        Ok(held)
    }

    /// The cable started from one that leaves its guide where a straight cable does.
    fn near_straight(cable: &Cable<'a>, end: Vector3<f64>, chord_force: f64) -> Result<Self, CableError> {
        if cable.guide.is_none() {
            return Self::close(cable, end, chord_force, Self::inextensible(cable, end, chord_force));
        }
        let (_, plain, beyond) = cable.straightened(end)?;
        let plain_chord_force = chord_force / per_horizontal(end) * per_horizontal(beyond);
        let free = Self::near_straight(&plain, beyond, plain_chord_force)?;
        Self::close(cable, end, chord_force, (free.force(), free.free_length))
    }

    /// The same cable with another chord force [N], started from this one.
    ///
    /// # Errors
    /// As [`HeldCable::at_chord_force`].
    pub fn with_chord_force(&self, chord_force: f64) -> Result<Self, CableError> {
        if (chord_force - self.chord_force).abs() <= 0.5 * self.chord_force
            && let Ok(held) = self.stepped(chord_force)
        {
            return Ok(held);
        }
        Self::at_chord_force(&self.catenary.cable, self.end, chord_force)
    }

    /// The same cable with a chord force [N] nearby.
    fn stepped(&self, chord_force: f64) -> Result<Self, CableError> {
        let step = chord_force - self.chord_force;
        let length = self.free_length + step * self.free_slope;
        check_length(length)?;
        let force = self.force() + step * self.force_slope;
        Self::close(&self.catenary.cable, self.end, chord_force, (force, length))
    }

    /// The derivatives of a cable whose end is at `end` [m] from its exit point.
    pub fn of(SpatialCable { cable, unstrained_length, force }: SpatialCable<'a>, end: Vector3<f64>) -> Self {
        let (flat_force, mut azimuth) = flat(force);
        let mut chord_force = flat_force.x * per_horizontal(end);
        let catenary = Catenary { cable: cable.turned(azimuth), unstrained_length, force: flat_force };
        if !cable.leaves_its_plane() {
            chord_force = end.norm() / catenary.response().lateral_flexibility;
            azimuth = flat(end).1;
        }
        Self::at(&cable, (end, chord_force), azimuth, [force.z, catenary.free_length()])
    }

    /// The cable with the tension `tension` [N] at A, on its taut branch.
    ///
    /// # Errors
    /// [`CableError::InvalidInput`] for an invalid value; [`CableError::TensionTooSmall`], with the least
    /// tension, where the weight of the cable alone demands more.
    pub fn at_tension(cable: &Cable<'a>, end: Vector3<f64>, tension: f64) -> Result<Self, CableError> {
        Ok(Self::counted(cable, end, tension)?.0)
    }

    /// The same, and the steps that it took.
    pub(crate) fn counted(
        cable: &Cable<'a>,
        end: Vector3<f64>,
        tension: f64,
    ) -> Result<(Self, usize), CableError> {
        check("tension", tension, tension >= SMALLEST, "a tension from 1e-30 to 1e30 [N]")?;
        cable.validate()?;
        check_end(end)?;
        Self::at_chord_force(cable, end, tension.max(10.0 * Self::folded(cable, end)?))?.solved_for(tension)
    }

    /// The same cable with the tension `tension` [N] at A, on its taut branch.
    ///
    /// # Errors
    /// As [`HeldCable::at_tension`].
    pub fn with_tension(&self, tension: f64) -> Result<Self, CableError> {
        Ok(self.solved_for(tension)?.0)
    }

    fn solved_for(&self, tension: f64) -> Result<(Self, usize), CableError> {
        const MAX_STEPS: usize = 100;
        check("tension", tension, tension >= SMALLEST, "a tension from 1e-30 to 1e30 [N]")?;
        // t(σ) is convex: above its minimum Newton's method comes from the greater side after one step.
        let mut now = *self;
        let folded = Self::folded(&self.catenary.cable, self.end)?;
        let (mut low, mut high) = (folded, f64::INFINITY);
        for steps in 0..MAX_STEPS {
            let (t, slope) = (now.tension(), now.tension_slope());
            if slope > 0.0 && (t - tension).abs() <= 1e-14 * tension {
                return Ok((now, steps));
            }
            *(if slope > 0.0 && t > tension { &mut high } else { &mut low }) = now.chord_force;
            let mut next = now.chord_force + (tension - t) / slope;
            if !(slope > 0.0 && next > low && next < high) {
                next = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * now.chord_force };
            }
            if (next - now.chord_force).abs() <= 1e-15 * now.chord_force || next <= 1.001 * folded {
                break;
            }
            now = now.with_chord_force(next)?;
        }
        if now.tension_slope() > 0.0 && (now.tension() - tension).abs() <= 1e-11 * tension {
            return Ok((now, MAX_STEPS));
        }
        let least = Self::at_least_tension(&self.catenary.cable, self.end)?.tension();
        Err(CableError::TensionTooSmall { tension, least })
    }

    /// The least chord force that tells a cable from others [N], see [`FOLDED`].
    fn folded(cable: &Cable<'a>, end: Vector3<f64>) -> Result<f64, CableError> {
        // Over a guide the chord from the leave point has another horizontal part, but the same fx.
        let mut chord = end.norm();
        if cable.guide.is_some() {
            let (_, _, beyond) = cable.straightened(end)?;
            chord = beyond.norm() / per_horizontal(beyond) * per_horizontal(end);
        }
        Ok(FOLDED * cable.weight_per_length * chord)
    }

    /// The cable of least tension at A over the span to `end` [m].
    ///
    /// # Errors
    /// As [`HeldCable::at_chord_force`], and for a cable without weight, which may be slack.
    pub fn at_least_tension(cable: &Cable<'a>, end: Vector3<f64>) -> Result<Self, CableError> {
        let w = cable.weight_per_length;
        check("weight_per_length", w, w >= SMALLEST, "a weight per length from 1e-30 to 1e30 [N/m]")?;
        let folded = Self::folded(cable, end)?;
        // The least tension of a level cable, w h/2 coth u with u tanh u = 1.
        let mut now = Self::at_chord_force(cable, end, 10.0 * folded)?;
        let (mut low, mut high) = (folded, f64::INFINITY);
        for _ in 0..100 {
            let (sigma, slope) = (now.chord_force, now.tension_slope());
            *(if slope > 0.0 { &mut high } else { &mut low }) = sigma;
            // Newton's method for dt/d(ln σ) = 0, within a factor of e and the bounds.
            let curvature = slope + sigma * now.tension_curvature(&now.force_curvature());
            let step = if curvature > 0.0 { -slope / curvature } else { -slope.signum() };
            let mut next = sigma * step.clamp(-1.0, 1.0).exp();
            if next <= low || next >= high {
                next = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * sigma };
            }
            if next <= 1.001 * folded {
                return Ok(now);
            }
            now = now.with_chord_force(next)?;
            // The step squares this one.
            if (next - sigma).abs() <= 1e-8 * sigma {
                return Ok(now);
            }
        }
        Ok(now)
    }

    /// The same cable with its force in space.
    pub fn in_space(&self) -> SpatialCable<'a> {
        let Catenary { cable, unstrained_length, .. } = self.catenary;
        SpatialCable { cable, unstrained_length, force: self.force() }
    }

    /// Force on the cable at A [N].
    pub fn force(&self) -> Vector3<f64> {
        lifted(self.catenary.force, self.azimuth)
    }

    /// Tension t at A [N].
    pub fn tension(&self) -> f64 {
        self.catenary.anchor_tension()
    }

    /// dt/dσ: positive on the taut branch, zero at the least tension.
    pub fn tension_slope(&self) -> f64 {
        self.force().dot(&self.force_slope) / self.tension()
    }

    /// d²t/dσ² [1/N], from the second derivative of the force.
    pub fn tension_curvature(&self, force_curvature: &Vector3<f64>) -> f64 {
        let (f, slope) = (self.force(), self.tension_slope());
        (f.dot(force_curvature) + self.force_slope.norm_squared() - slope * slope) / self.tension()
    }

    /// w c/2σ: half the angle, as a hyperbolic one, that the cable's direction turns through.
    pub fn slackness(&self) -> f64 {
        0.5 * self.catenary.cable.weight_per_length * self.end.norm() / self.chord_force
    }
}
