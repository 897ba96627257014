//! A cable between two held ends, as a function of its chord force.
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
//! paid out, through the least tension and beyond. Force and length follow from σ by
//!
//! ```text
//! x/fx = c/σ,      z = z(f, L),      fx = σ h/c                                                  (C17)
//! ```
//!
//! with x/fx of (C1), which is regular for a vertical cable. With the flexibility C and `e = (fx, V0) k`,
//! `k = 1/T0 + 1/EA` of (C9), the derivatives at held ends are
//!
//! ```text
//! fx' = h/c,      fz' = (V0 Cxx/σ - Cxz fx')/m,      L' = -det C/(σ k m),      m = Czz - V0 Cxz/fx   (C18)
//! ```
//!
//! Second derivatives are (C18) differentiated by dual numbers.

mod in_plane;

use crate::cable::{Cable, Numbers};
use crate::catenary::Catenary;
use crate::error::{CableError, SMALLEST, check};
use crate::guide::Straight;
use crate::solve::chord_force::{ByChordForce, at_least_tension};
use crate::solve::end_force::{check_end, straightened};
use cdpr_number::{Dual, Real};
use in_plane::{ClosureMatrix, InPlane, VERTICAL};
use nalgebra::Vector2;

/// A cable between held ends, with the derivatives of its force with respect to the chord force σ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldCable<'a> {
    /// The equilibrium.
    pub catenary: Catenary<'a>,
    /// End position (x, z) [m].
    pub end: Vector2<f64>,
    /// Chord force σ [N], (C16).
    pub chord_force: f64,
    /// df/dσ, (C18).
    pub force_slope: Vector2<f64>,
    /// dL/dσ [m/N], always negative.
    pub length_slope: f64,
}

impl<'a> HeldCable<'a> {
    /// The cable from the origin to `end = (x, z)` [m], `x >= 0`, with the chord force `chord_force` [N].
    ///
    /// # Errors
    /// [`CableError::InvalidInput`] for an invalid value; [`CableError::NotConverged`] with the residual.
    pub fn at_chord_force(
        cable: &Cable<'a>,
        end: Vector2<f64>,
        chord_force: f64,
    ) -> Result<Self, CableError> {
        cable.validate()?;
        check_end(end)?;
        check("end", end.norm(), end.norm() >= SMALLEST, "an end position away from the exit point [m]")?;
        check("chord_force", chord_force, chord_force >= SMALLEST, "a chord force from 1e-30 to 1e30 [N]")?;
        if let Some(guide) = &cable.guide {
            let (Straight { guided, .. }, plain, beyond) = straightened(cable, guide, end)?;
            let horizontal = chord_force * end.x / end.norm();
            let plain_chord_force = horizontal * beyond.norm() / beyond.x.max(VERTICAL * beyond.norm());
            let free = Self::at_chord_force(&plain, beyond, plain_chord_force)?.catenary;
            let led = guided / (1.0 + cable.strain(free.exit_tension()));
            return Self::close(cable, end, chord_force, [free.force.y, free.unstrained_length + led]);
        }
        // The inextensible catenary with this horizontal force.
        let chord = end.norm();
        let u = 0.5 * cable.weight_per_length * chord / chord_force;
        let (sinh_ratio, u_coth) = if u < 1e-4 { (1.0, 1.0) } else { (u.sinh() / u, u / u.tanh()) };
        let length = end.y.hypot(end.x * sinh_ratio) / (1.0 + cable.strain(chord_force));
        let fz = chord_force / chord * end.y * u_coth + 0.5 * cable.weight_per_length * length;
        Self::close(cable, end, chord_force, [fz, length])
    }

    /// The same cable with another chord force [N], started from this one.
    ///
    /// # Errors
    /// As [`HeldCable::at_chord_force`].
    pub fn with_chord_force(&self, chord_force: f64) -> Result<Self, CableError> {
        let step = chord_force - self.chord_force;
        let fz = self.catenary.force.y + step * self.force_slope.y;
        let length = self.catenary.unstrained_length + step * self.length_slope;
        if step.abs() <= 0.5 * self.chord_force
            && length > 0.0
            && let Ok(held) = Self::close(&self.catenary.cable, self.end, chord_force, [fz, length])
        {
            return Ok(held);
        }
        Self::at_chord_force(&self.catenary.cable, self.end, chord_force)
    }

    /// The derivatives of a cable whose end is at `end` [m].
    pub fn of(catenary: Catenary<'a>, end: Vector2<f64>) -> Self {
        let chord_force = end.norm() / catenary.response().lateral_flexibility;
        Self::at(catenary, end, chord_force)
    }

    /// The cable of least tension at A over the span to `end` [m].
    ///
    /// # Errors
    /// As [`HeldCable::at_chord_force`], and for a cable without weight, which may be slack.
    pub fn at_least_tension(cable: &Cable<'a>, end: Vector2<f64>) -> Result<Self, CableError> {
        let mut chord = end.norm();
        if let Some(guide) = &cable.guide {
            let (_, _, beyond) = straightened(cable, guide, end)?;
            chord *= beyond.x.max(VERTICAL * beyond.norm()) / end.x.max(VERTICAL * chord);
        }
        at_least_tension(cable, chord, |sigma| Self::at_chord_force(cable, end, sigma))
    }

    /// Tension t at A [N].
    pub fn tension(&self) -> f64 {
        self.catenary.anchor_tension()
    }

    /// dt/dσ: positive on the taut branch, zero at the least tension.
    pub fn tension_slope(&self) -> f64 {
        self.catenary.force.dot(&self.force_slope) / self.tension()
    }

    /// d²f/dσ² [1/N].
    pub fn force_curvature(&self) -> Vector2<f64> {
        let cable = self.in_plane();
        let along = |value, slope| Dual { value, slopes: [slope] };
        let cable = InPlane::<Dual<f64, 1>> {
            end: cable.end.map(Dual::of),
            numbers: Numbers {
                length: along(cable.numbers.length, self.length_slope),
                ..cable.numbers.map(Dual::of)
            },
            chord_force: along(cable.chord_force, 1.0),
            fz: along(cable.fz, self.force_slope.y),
        };
        let [_, fz_slope, _] = cable.slopes(&cable.response(&self.catenary));
        Vector2::new(0.0, fz_slope.slopes[0])
    }

    /// d²t/dσ² [1/N], from the second derivative of the force.
    pub fn tension_curvature(&self, force_curvature: &Vector2<f64>) -> f64 {
        let (f, slope) = (self.catenary.force, self.tension_slope());
        (f.dot(force_curvature) + self.force_slope.norm_squared() - slope * slope) / self.tension()
    }

    fn in_plane(&self) -> InPlane<f64> {
        let Catenary { cable, unstrained_length, force } = self.catenary;
        InPlane {
            end: self.end.into(),
            numbers: cable.numbers(unstrained_length),
            chord_force: self.chord_force,
            fz: force.y,
        }
    }

    fn at(catenary: Catenary<'a>, end: Vector2<f64>, chord_force: f64) -> Self {
        let force_slope = Vector2::zeros();
        let held = Self { catenary, end, chord_force, force_slope, length_slope: 0.0 };
        let in_plane = held.in_plane();
        let [fx, fz, length_slope] = in_plane.slopes(&in_plane.whole_response(&catenary));
        Self { force_slope: Vector2::new(fx, fz), length_slope, ..held }
    }

    /// Newton's method on (C17) for fz and L.
    fn close(
        cable: &Cable<'a>,
        end: Vector2<f64>,
        chord_force: f64,
        [mut fz, mut length]: [f64; 2],
    ) -> Result<Self, CableError> {
        const MAX_ITERATIONS: usize = 50;
        let chord = end.norm();
        let fx = chord_force * end.x.max(VERTICAL * chord) / chord;
        let mut residual = f64::INFINITY;
        for iteration in 1..=MAX_ITERATIONS {
            let catenary = Catenary { cable: *cable, unstrained_length: length, force: Vector2::new(fx, fz) };
            let in_plane = InPlane { end: end.into(), numbers: cable.numbers(length), chord_force, fz };
            let response = in_plane.whole_response(&catenary);
            let misclosure = in_plane.misclosure(&response.0);
            let before = residual;
            residual = (misclosure[0] * fx).hypot(misclosure[1]);
            let [dfz, dlength] = ClosureMatrix::of(&in_plane, &response).solve(misclosure);
            if !(dfz.is_finite() && dlength.is_finite()) {
                return Err(CableError::NotConverged { iterations: iteration, residual });
            }
            let free = response.1.map_or(length, |on_guide| on_guide.free);
            let (v0, led) = (fz - cable.weight_per_length * free, length - free);
            length = (length + dlength).clamp(0.5 * length, 2.0 * length);
            // Where the cable is nearly vertical at an end, the force there changes its sign only in small
            // steps: x/fx depends on its logarithm.
            let kept = |from: f64, to: f64| {
                if fx < 0.1 * from.abs() && to / from < 0.1 { 0.1 * from } else { to }
            };
            let weight = cable.weight_per_length * (length - led);
            fz = weight + kept(v0, kept(fz, fz + dfz) - weight);
            let forces = catenary.force.norm() + cable.weight_per_length * free;
            let small = |limit: f64| dfz.abs() <= limit * forces && dlength.abs() <= limit * chord;
            // The next step squares this one, or nothing but rounding is left.
            if small(1e-8) || (small(1e-6) && residual >= 0.5 * before) {
                let catenary =
                    Catenary { unstrained_length: length, force: Vector2::new(fx, fz), ..catenary };
                return Ok(Self::at(catenary, end, chord_force));
            }
        }
        Err(CableError::NotConverged { iterations: MAX_ITERATIONS, residual })
    }
}

impl ByChordForce for HeldCable<'_> {
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
