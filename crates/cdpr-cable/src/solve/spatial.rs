//! A cable over a pulley with a tilted axis between fixed ends, as a function of its chord force.
//!
//! The equations are those of [`crate::SpatialCable`] in space. With the flexibility A = dA/dF of (C22) and
//! `F_L = -A⁻¹ dA/dL` the force between held ends changes with the length. Its change with the chord force
//! `σ = fx c/h` of (C16) is
//!
//! ```text
//! F' = F_L h/(c fx_L),      L' = h/(c fx_L),      fx_L = e_h·F_L                                  (C27)
//! ```
//!
//! Second derivatives are (C27) differentiated by dual numbers.

mod end_force;

use crate::cable::{Cable, Numbers};
use crate::catenary::spatial::{SpatialCable, horizontal, response, solve};
use crate::error::{CableError, SMALLEST, check, check_length};
use crate::solve::chord_force::{ByChordForce, at_least_tension};
use crate::solve::held::HeldCable;
use cdpr_number::{Dual, Real};
pub use end_force::spatial_end_force;
use end_force::{check_end, flat, lifted, straightened};
use nalgebra::Vector3;

/// A cable over a pulley with a tilted axis between held ends, with the derivatives by its chord force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldSpatialCable<'a> {
    /// The equilibrium.
    pub cable: SpatialCable<'a>,
    /// Position of A from D [m].
    pub end: Vector3<f64>,
    /// Chord force σ [N], (C16) with the horizontal part of the force at A.
    pub chord_force: f64,
    /// dF/dσ, (C27).
    pub force_slope: Vector3<f64>,
    /// dL/dσ [m/N], always negative.
    pub length_slope: f64,
}

impl<'a> HeldSpatialCable<'a> {
    /// The cable to A at `end` [m] from D with the chord force `chord_force` [N].
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
        // A cable that hangs deep is far from what its vertical plane without the wheel says: paid out in
        // steps it is found from a taut one.
        let taut = 4.0 * cable.weight_per_length * end.norm();
        if chord_force >= taut {
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

    /// The cable started from one that leaves the wheel where a straight cable does.
    fn near_straight(cable: &Cable<'a>, end: Vector3<f64>, chord_force: f64) -> Result<Self, CableError> {
        let (straight, plain, beyond) = straightened(cable, end)?;
        let (in_plane, azimuth) = flat(beyond);
        let fx = chord_force / per_horizontal(end);
        let plain_chord_force = fx * in_plane.norm() / in_plane.x.max(1e-20 * in_plane.norm());
        let free = HeldCable::at_chord_force(&plain, in_plane, plain_chord_force)?.catenary;
        let led = straight.guided / (1.0 + cable.strain(free.exit_tension()));
        let start = SpatialCable {
            cable: *cable,
            unstrained_length: free.unstrained_length + led,
            force: lifted(free.force, azimuth),
        };
        Self::close(start, end, chord_force)
    }

    /// The same cable with another chord force [N], started from this one.
    ///
    /// # Errors
    /// As [`HeldSpatialCable::at_chord_force`].
    pub fn with_chord_force(&self, chord_force: f64) -> Result<Self, CableError> {
        if (chord_force - self.chord_force).abs() <= 0.5 * self.chord_force
            && let Ok(held) = self.stepped(chord_force)
        {
            return Ok(held);
        }
        Self::at_chord_force(&self.cable.cable, self.end, chord_force)
    }

    /// The same cable with a chord force [N] nearby.
    fn stepped(&self, chord_force: f64) -> Result<Self, CableError> {
        let step = chord_force - self.chord_force;
        let length = self.cable.unstrained_length + step * self.length_slope;
        check_length(length)?;
        let force = self.cable.force + step * self.force_slope;
        Self::close(SpatialCable { force, unstrained_length: length, ..self.cable }, self.end, chord_force)
    }

    /// The same cable with the tension `tension` [N] at A, on its taut branch.
    ///
    /// # Errors
    /// As [`crate::length_for_tension`].
    pub fn with_tension(&self, tension: f64) -> Result<Self, CableError> {
        check("tension", tension, tension >= SMALLEST, "a tension from 1e-30 to 1e30 [N]")?;
        // t(σ) is convex: above its minimum Newton's method comes from the greater side after one step.
        let mut now = *self;
        let (mut low, mut high) = (0.0, f64::INFINITY);
        for _ in 0..100 {
            let (t, slope) = (now.tension(), now.tension_slope());
            if slope > 0.0 && (t - tension).abs() <= 1e-14 * tension {
                return Ok(now);
            }
            *(if slope > 0.0 && t > tension { &mut high } else { &mut low }) = now.chord_force;
            let mut next = now.chord_force + (tension - t) / slope;
            if !(slope > 0.0 && next > low && next < high) {
                next = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * now.chord_force };
            }
            if (next - now.chord_force).abs() <= 1e-15 * now.chord_force {
                break;
            }
            now = now.with_chord_force(next)?;
        }
        if now.tension_slope() > 0.0 && (now.tension() - tension).abs() <= 1e-11 * tension {
            return Ok(now);
        }
        let least = Self::at_least_tension(&self.cable.cable, self.end)?.tension();
        Err(CableError::TensionTooSmall { tension, least })
    }

    /// The cable of least tension at A over the span to `end` [m] from D.
    ///
    /// # Errors
    /// As [`HeldCable::at_least_tension`].
    pub fn at_least_tension(cable: &Cable<'a>, end: Vector3<f64>) -> Result<Self, CableError> {
        let (_, _, beyond) = straightened(cable, end)?;
        let chord = beyond.norm() / per_horizontal(beyond) * per_horizontal(end);
        at_least_tension(cable, chord, |sigma| Self::at_chord_force(cable, end, sigma))
    }

    /// The derivatives of a cable whose end is at `end` [m] from D.
    pub fn of(cable: SpatialCable<'a>, end: Vector3<f64>) -> Self {
        let (fx, _) = horizontal(&cable.force.into());
        Self::at(cable, end, fx * per_horizontal(end))
    }

    /// Tension t at A [N].
    pub fn tension(&self) -> f64 {
        self.cable.anchor_tension()
    }

    /// dt/dσ: positive on the taut branch, zero at the least tension.
    pub fn tension_slope(&self) -> f64 {
        self.cable.force.dot(&self.force_slope) / self.tension()
    }

    /// d²F/dσ² [1/N].
    pub fn force_curvature(&self) -> Vector3<f64> {
        let along = |value: f64, slope: f64| Dual { value, slopes: [slope] };
        let force = [0, 1, 2].map(|k| along(self.cable.force[k], self.force_slope[k]));
        let plain = self.cable.numbers();
        let length = along(plain.length, self.length_slope);
        let per_length = self.force_per_length(&Numbers { length, ..plain.map(Dual::<f64, 1>::of) }, &force);
        let (_, [c, s]) = horizontal(&force);
        let fx = c * per_length[0] + s * per_length[1];
        let share = 1.0 / per_horizontal(self.end);
        Vector3::from(per_length.map(|slope| (slope * share / fx).slopes[0]))
    }

    /// d²t/dσ² [1/N], from the second derivative of the force.
    pub fn tension_curvature(&self, force_curvature: &Vector3<f64>) -> f64 {
        let (f, slope) = (self.cable.force, self.tension_slope());
        (f.dot(force_curvature) + self.force_slope.norm_squared() - slope * slope) / self.tension()
    }

    /// F_L between held ends.
    fn force_per_length<T: Real>(&self, numbers: &Numbers<T>, force: &[T; 3]) -> [T; 3] {
        let found = response(&self.cable.cable, numbers, force);
        solve(&found.flexibility, &found.end_per_length).map(|slope| -slope)
    }

    fn at(cable: SpatialCable<'a>, end: Vector3<f64>, chord_force: f64) -> Self {
        let zero = Vector3::zeros();
        let held = Self { cable, end, chord_force, force_slope: zero, length_slope: 0.0 };
        let per_length = Vector3::from(held.force_per_length(&cable.numbers(), &cable.force.into()));
        let (_, [c, s]) = horizontal(&cable.force.into());
        let length_slope = 1.0 / (per_horizontal(end) * (c * per_length.x + s * per_length.y));
        Self { force_slope: per_length * length_slope, length_slope, ..held }
    }

    /// Newton's method for force and length at a chord force.
    fn close(start: SpatialCable<'a>, end: Vector3<f64>, chord_force: f64) -> Result<Self, CableError> {
        const MAX_ITERATIONS: usize = 50;
        let fx = chord_force / per_horizontal(end);
        let mut now = start;
        let mut before = f64::INFINITY;
        for iteration in 1..=MAX_ITERATIONS {
            let response = now.response();
            let residual = end - response.end;
            let failed = CableError::NotConverged { iterations: iteration, residual: residual.norm() };
            let inverse = response.flexibility.try_inverse().ok_or_else(|| failed.clone())?;
            let (closing, per_length) = (inverse * residual, -inverse * response.end_per_length);
            let (own, [c, s]) = horizontal(&now.force.into());
            let forwards = |v: &Vector3<f64>| c * v.x + s * v.y;
            let length = (fx - own - forwards(&closing)) / forwards(&per_length);
            let force = closing + per_length * length;
            if !(length.is_finite() && force.norm().is_finite()) {
                return Err(failed);
            }
            let bounded = (now.unstrained_length + length)
                .clamp(0.5 * now.unstrained_length, 2.0 * now.unstrained_length);
            now = SpatialCable { force: now.force + force, unstrained_length: bounded, ..now };
            // The azimuth of a long step is that of the tangent: the horizontal part is known.
            let (reached, _) = horizontal(&now.force.into());
            if reached > 0.0 {
                now.force.x *= fx / reached;
                now.force.y *= fx / reached;
            }
            let forces = now.force.norm() + now.cable.weight_per_length * now.unstrained_length;
            let small = |limit: f64| force.norm() <= limit * forces && length.abs() <= limit * end.norm();
            if small(1e-8) || (small(1e-6) && residual.norm() >= 0.5 * before) {
                return Ok(Self::at(now, end, chord_force));
            }
            before = residual.norm();
        }
        Err(CableError::NotConverged { iterations: MAX_ITERATIONS, residual: before })
    }
}

impl ByChordForce for HeldSpatialCable<'_> {
    fn chord_force(&self) -> f64 {
        self.chord_force
    }

    fn tension_slopes(&self) -> [f64; 2] {
        [self.tension_slope(), self.tension_curvature(&self.force_curvature())]
    }

    fn to(&self, chord_force: f64) -> Result<Self, CableError> {
        self.with_chord_force(chord_force)
    }
}

/// c/h of a span.
fn per_horizontal(end: Vector3<f64>) -> f64 {
    end.norm() / end.x.hypot(end.y).max(1e-20 * end.norm())
}
