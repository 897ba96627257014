//! The elastic catenary for a given force at its end.
//!
//! A cable of unstrained length `L`, weight `w` per unstrained length and axial stiffness `EA` carries the force
//! `(fx, fz)` at A. With the vertical force at B, the two end tensions and their sum
//!
//! ```text
//! V0 = fz - w L,   T = sqrt(fx² + fz²),   T0 = sqrt(fx² + V0²),   s = T + T0,   q = w L / s
//! ```
//!
//! the end A lies at
//!
//! ```text
//! x = fx L [ 1/EA + (2/s) φ(q²) ],            φ(q²) = atanh(q)/q = 1 + q² ψ(q²)            (1)
//! z = L [ (fz - wL/2)/EA + (fz + V0)/s ]                                                   (2)
//! ```
//!
//! This is the model of Irvine, *Cable Structures* (1981), eq. (1.32)-(1.33), word for word: with `sinh u = fz/fx` at
//! A and `sinh u0 = V0/fx` at B, `tanh((u - u0)/2) = q`. The usual form subtracts two inverse hyperbolic sines and two
//! square roots and loses most of its digits for taut, stiff or light cables; this one is exact to rounding for all of
//! them, and `w = 0` is a straight spring.
//!
//! The flexibility `d(x, z)/d(fx, fz)`, symmetric and positive definite, follows from
//! `D = fx² + T T0 + fz V0 = s² (1 - q²)/2` and `g = fx²/D`:
//!
//! ```text
//! dz/dfz = L [ 1/EA + s g/(T T0) ]                                                         (3)
//! dx/dfz = -fx L (fz + V0) / (T T0 s)                                                      (4)
//! dx/dfx = L [ 1/EA + 2 q² ψ/s + N/(s T T0 D) ],                                           (5)
//!          N = fx² (fz² + V0²) + 2 fz V0 (fz V0 + T T0)
//! ```
//!
//! For `fz V0 < 0` (the cable dips below both ends) `T T0 + fz V0` is formed as
//! `fx² (fx² + fz² + V0²)/(T T0 - fz V0)`, so that nothing cancels for a cable that hangs folded (`fx -> 0`).
//!
//! The complementary energy, whose gradient is (1)-(2), is the integral of `T + T²/2EA` over the unstrained length:
//!
//! ```text
//! U* = (L/2) [ (fz + V0)²/(2s) + s/2 + 2 fx² φ/s ] + (L/2EA) [ fx² + (fz² + fz V0 + V0²)/3 ]   (6)
//! ```

use crate::error::{CableError, check};
use nalgebra::{Matrix2, Matrix3, Vector2};

/// What a cable is made of, per metre of unstrained length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cable {
    /// Weight per unstrained length w = rho g [N/m]; zero makes the cable a straight spring.
    pub weight_per_length: f64,
    /// Axial stiffness EA [N].
    pub axial_stiffness: f64,
}

impl Cable {
    /// Checks that the weight is finite and not negative, the stiffness finite and positive.
    ///
    /// # Errors
    /// [`CableError::InvalidInput`] names the field.
    pub fn validate(&self) -> Result<(), CableError> {
        let Self { weight_per_length: w, axial_stiffness: ea } = *self;
        check("weight_per_length", w, w >= 0.0, "a finite weight per length, zero or more [N/m]")?;
        check("axial_stiffness", ea, ea > 0.0, "a finite, positive axial stiffness [N]")
    }
}

/// A cable in equilibrium: its unstrained length and the force applied to it at the anchor point A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Catenary {
    /// The cable.
    pub cable: Cable,
    /// Unstrained length L [m].
    pub unstrained_length: f64,
    /// Force `(fx, fz)` on the cable at A, in the cable's plane [N]; `fx >= 0`.
    pub force: Vector2<f64>,
}

/// How the end A answers to forces, with the position it answers from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compliance {
    /// End position `(x, z)` [m], equations (1)-(2).
    pub end: Vector2<f64>,
    /// In-plane flexibility `d(x, z)/d(fx, fz)` [m/N], equations (3)-(5).
    pub flexibility: Matrix2<f64>,
    /// Out-of-plane stiffness `fx/x` [N/m]; regular for a vertical cable, where `fx = x = 0`.
    pub lateral_stiffness: f64,
    /// Derivative of the end position with respect to the unstrained length at constant force at A [m/m]: the unit tangent
    /// at B times `1 + T0/EA`, since the new piece of cable enters there.
    pub end_per_length: Vector2<f64>,
}

impl Catenary {
    /// Position `(x, z)` of A relative to B [m], equations (1)-(2).
    pub fn end_position(&self) -> Vector2<f64> {
        self.terms().end_position()
    }

    /// End position, in-plane flexibility and lateral stiffness at once.
    pub fn compliance(&self) -> Compliance {
        self.terms().compliance()
    }

    /// In-plane stiffness `d(fx, fz)/d(x, z)` [N/m], the inverse of the flexibility. Zero for a slack cable without weight.
    pub fn in_plane_stiffness(&self) -> Matrix2<f64> {
        if self.is_limp() { Matrix2::zeros() } else { self.compliance().in_plane_stiffness() }
    }

    /// Stiffness `dF/dr` [N/m] of the end force in three dimensions, `z` up. `azimuth` is the horizontal unit vector
    /// from B towards A (any unit vector if A is right above or below B).
    pub fn stiffness(&self, azimuth: Vector2<f64>) -> Matrix3<f64> {
        if self.is_limp() { Matrix3::zeros() } else { self.compliance().stiffness(azimuth) }
    }

    /// Tension at the anchor point A [N].
    pub fn anchor_tension(&self) -> f64 {
        self.force.norm()
    }

    /// Tension at the exit point B [N].
    pub fn exit_tension(&self) -> f64 {
        Vector2::new(self.force.x, self.exit_vertical_force()).norm()
    }

    /// Vertical component V0 of the cable's tension at B [N], `fz - w L`.
    pub fn exit_vertical_force(&self) -> f64 {
        self.force.y - self.weight()
    }

    /// Weight of the whole cable w L [N].
    pub fn weight(&self) -> f64 {
        self.cable.weight_per_length * self.unstrained_length
    }

    /// Complementary energy U*(f) [J], equation (6): strictly convex, its gradient is the end position.
    pub fn complementary_energy(&self) -> f64 {
        self.terms().complementary_energy()
    }

    /// Potential energy [J]: elastic energy plus the work done against gravity, zero for a massless cable at rest with
    /// its weight at the height of B. As a function of the end position its gradient is the force at A.
    pub fn potential_energy(&self) -> f64 {
        let terms = self.terms();
        self.force.dot(&terms.end_position()) - terms.complementary_energy()
    }

    /// Whether this is a slack cable without weight: it carries nothing, resists nothing and has no shape, so that end
    /// position and flexibility mean nothing.
    pub fn is_limp(&self) -> bool {
        self.force == Vector2::zeros() && self.cable.weight_per_length == 0.0
    }

    fn terms(&self) -> Terms {
        Terms::new(self)
    }
}

impl Compliance {
    /// In-plane stiffness `d(fx, fz)/d(x, z)` [N/m].
    pub fn in_plane_stiffness(&self) -> Matrix2<f64> {
        let c = &self.flexibility;
        let determinant = c.m11 * c.m22 - c.m12 * c.m21;
        Matrix2::new(c.m22, -c.m12, -c.m21, c.m11) / determinant
    }

    /// Derivative of the force at A with respect to the unstrained length with both ends held [N/m].
    pub fn force_per_length(&self) -> Vector2<f64> {
        -self.in_plane_stiffness() * self.end_per_length
    }

    /// Stiffness `dF/dr` [N/m] in three dimensions, see [`Catenary::stiffness`].
    pub fn stiffness(&self, azimuth: Vector2<f64>) -> Matrix3<f64> {
        let k = self.in_plane_stiffness();
        let lateral = self.lateral_stiffness;
        let (c, s) = (azimuth.x, azimuth.y);
        Matrix3::new(
            c * c * k.m11 + s * s * lateral,
            c * s * (k.m11 - lateral),
            c * k.m12,
            c * s * (k.m11 - lateral),
            s * s * k.m11 + c * c * lateral,
            s * k.m12,
            c * k.m21,
            s * k.m21,
            k.m22,
        )
    }
}

/// The quantities that equations (1)-(6) share.
struct Terms {
    fx: f64,
    fz: f64,
    v0: f64,
    length: f64,
    ea: f64,
    weight: f64,
    /// fx², kept away from zero by 1e-60 of the squared forces, so that a folded cable stays regular.
    fx2: f64,
    /// T, tension at A.
    t: f64,
    /// T0, tension at B.
    t0: f64,
    /// s = T + T0.
    s: f64,
}

impl Terms {
    fn new(catenary: &Catenary) -> Self {
        let Catenary { cable, unstrained_length: length, force } = *catenary;
        let weight = cable.weight_per_length * length;
        let (fx, fz) = (force.x, force.y);
        let v0 = fz - weight;
        let floor = 1e-30 * (fz.abs() + weight);
        let fx2 = fx * fx + floor * floor + f64::MIN_POSITIVE;
        let t = (fx2 + fz * fz).sqrt();
        let t0 = (fx2 + v0 * v0).sqrt();
        Self { fx, fz, v0, length, ea: cable.axial_stiffness, weight, fx2, t, t0, s: t + t0 }
    }

    /// m = (fx² + fz² + V0²)/(T T0 - fz V0), with which D = fx² (1 + m) without cancellation where fz V0 < 0.
    fn fold(&self) -> f64 {
        (self.fx2 + self.fz * self.fz + self.v0 * self.v0) / (self.t * self.t0 - self.fz * self.v0)
    }

    /// D = fx² + T T0 + fz V0.
    fn d(&self) -> f64 {
        let p = self.fz * self.v0;
        if p >= 0.0 { self.fx2 + self.t * self.t0 + p } else { self.fx2 * (1.0 + self.fold()) }
    }

    /// (q², ψ(q²)).
    fn sag_terms(&self) -> (f64, f64) {
        let q = self.weight / self.s;
        let q2 = q * q;
        let psi = if q2 < SERIES_LIMIT {
            sag_series(q2)
        } else {
            // atanh q = ln((1 + q)/sqrt(1 - q²)), with 1 - q² = 2D/s²
            let atanh = ((1.0 + q) * self.s / (2.0 * self.d()).sqrt()).ln();
            (atanh / q - 1.0) / q2
        };
        (q2, psi)
    }

    fn end_position(&self) -> Vector2<f64> {
        let (q2, psi) = self.sag_terms();
        self.end_position_with(1.0 + q2 * psi)
    }

    fn end_position_with(&self, phi: f64) -> Vector2<f64> {
        let x = self.fx * self.length * (1.0 / self.ea + 2.0 * phi / self.s);
        let z = self.length * ((self.fz - 0.5 * self.weight) / self.ea + (self.fz + self.v0) / self.s);
        Vector2::new(x, z)
    }

    fn compliance(&self) -> Compliance {
        let Self { fx, fz, v0, length, ea, fx2, t, t0, s, .. } = *self;
        let (q2, psi) = self.sag_terms();
        let phi = 1.0 + q2 * psi;
        let tt0 = t * t0;
        let p = fz * v0;
        let squares = fz * fz + v0 * v0;
        let (g, n_over_d) = if p >= 0.0 {
            let d = fx2 + tt0 + p;
            (fx2 / d, (fx2 * squares + 2.0 * p * (p + tt0)) / d)
        } else {
            let m = self.fold();
            let g = 1.0 / (1.0 + m);
            (g, g * (squares + 2.0 * p * m))
        };
        let zz = length * (1.0 / ea + s * g / tt0);
        let xz = -fx * length * (fz + v0) / (tt0 * s);
        let xx = length * (1.0 / ea + 2.0 * q2 * psi / s + n_over_d / (s * tt0));
        Compliance {
            end: self.end_position_with(phi),
            flexibility: Matrix2::new(xx, xz, xz, zz),
            lateral_stiffness: 1.0 / (length * (1.0 / ea + 2.0 * phi / s)),
            end_per_length: Vector2::new(fx, v0) * (1.0 / t0 + 1.0 / ea),
        }
    }

    fn complementary_energy(&self) -> f64 {
        let Self { fx, fz, v0, length, ea, s, .. } = *self;
        let (q2, psi) = self.sag_terms();
        let phi = 1.0 + q2 * psi;
        let inextensible = (fz + v0) * (fz + v0) / (2.0 * s) + 0.5 * s + 2.0 * fx * fx * phi / s;
        let elastic = (fx * fx + (fz * fz + fz * v0 + v0 * v0) / 3.0) / ea;
        0.5 * length * (inextensible + elastic)
    }
}

/// Above this q² the logarithm is used; both ways agree to rounding there.
const SERIES_LIMIT: f64 = 0.1;

/// 1/3, 1/5, 1/7, ...: the coefficients of ψ(q²).
const SERIES: [f64; 17] = {
    let mut series = [0.0; 17];
    let mut k = 0;
    while k < series.len() {
        series[k] = 1.0 / (2 * k + 3) as f64;
        k += 1;
    }
    series
};

/// ψ(q²) = (atanh(q)/q - 1)/q² = 1/3 + q²/5 + q⁴/7 + ... for q² < 0.1, to rounding.
fn sag_series(q2: f64) -> f64 {
    // A taut cable has q² below 1e-3: six terms leave 1e-18.
    let terms = if q2 < 1e-3 { &SERIES[..6] } else { &SERIES[..] };
    terms.iter().rev().fold(0.0, |sum, term| sum * q2 + term)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    const CABLE: Cable = Cable { weight_per_length: 0.995_715, axial_stiffness: 1.284_283e6 };

    fn catenary(cable: Cable, length: f64, fx: f64, fz: f64) -> Catenary {
        Catenary { cable, unstrained_length: length, force: Vector2::new(fx, fz) }
    }

    #[test]
    fn a_weightless_cable_is_a_spring() {
        let cable = Cable { weight_per_length: 0.0, axial_stiffness: 1e4 };
        let spring = catenary(cable, 2.0, 30.0, 40.0);
        let expected = Vector2::new(0.6, 0.8) * 2.0 * (1.0 + 50.0 / 1e4);
        assert_relative_eq!(spring.end_position(), expected, max_relative = 1e-15);
        assert_relative_eq!(spring.potential_energy(), 0.5 * 50.0 * 50.0 * 2.0 / 1e4, max_relative = 1e-10);
    }

    #[test]
    fn the_textbook_form_agrees_where_it_does_not_cancel() {
        let (w, ea, length, fx, fz) = (20.0, 1e5, 6.0, 50.0, 90.0);
        let v0: f64 = fz - w * length;
        let x = fx * length / ea + fx / w * ((fz / fx).asinh() - (v0 / fx).asinh());
        let z = (fz - w * length / 2.0) * length / ea + (fz.hypot(fx) - v0.hypot(fx)) / w;
        let end =
            catenary(Cable { weight_per_length: w, axial_stiffness: ea }, length, fx, fz).end_position();
        assert_relative_eq!(end, Vector2::new(x, z), max_relative = 1e-14);
    }

    #[test]
    fn series_and_logarithm_meet_without_a_jump() {
        for q2 in [SERIES_LIMIT * (1.0 - 1e-12), SERIES_LIMIT] {
            let q = f64::sqrt(q2);
            assert_relative_eq!(sag_series(q2), (q.atanh() / q - 1.0) / q2, max_relative = 1e-14);
        }
        assert_relative_eq!(sag_series(1e-3 - 1e-18), sag_series(1e-3), max_relative = 1e-15);
    }

    #[test]
    fn a_vertical_folded_cable_is_regular() {
        let folded = catenary(CABLE, 5.0, 0.0, 3.0);
        let compliance = folded.compliance();
        assert_eq!(compliance.end.x, 0.0);
        assert!(compliance.flexibility.iter().all(|c| c.is_finite()));
        assert!(compliance.lateral_stiffness >= 0.0);
        assert!(folded.stiffness(Vector2::x()).iter().all(|k| k.is_finite()));
    }

    #[test]
    fn a_limp_cable_has_no_stiffness() {
        let limp = catenary(Cable { weight_per_length: 0.0, axial_stiffness: 1e4 }, 2.0, 0.0, 0.0);
        assert_eq!(limp.stiffness(Vector2::x()), Matrix3::zeros());
    }

    /// Cables from taut to folded: weights, stiffnesses, lengths and forces over many decades.
    fn any_catenary() -> impl Strategy<Value = Catenary> {
        (-2.0..2.0f64, 4.0..8.0f64, -0.3..2.0f64, -2.0..3.0f64, -3.0..3.0f64).prop_map(
            |(w, ea, l, fx, fz)| {
                let cable = Cable { weight_per_length: 10f64.powf(w), axial_stiffness: 10f64.powf(ea) };
                let length = 10f64.powf(l);
                let weight = cable.weight_per_length * length;
                catenary(cable, length, weight * 10f64.powf(fx), weight * fz.sinh())
            },
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn the_gradient_of_the_complementary_energy_is_the_end_position(c in any_catenary()) {
            let step = 1e-5 * (c.anchor_tension() + c.weight());
            let slope = |d: Vector2<f64>| {
                let at = |h: f64| Catenary { force: c.force + d * h, ..c }.complementary_energy();
                (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step)
            };
            prop_assume!(c.force.x > 100.0 * step);
            let end = c.end_position();
            let scale = end.norm() + c.unstrained_length;
            prop_assert!((slope(Vector2::x()) - end.x).abs() < 1e-8 * scale);
            prop_assert!((slope(Vector2::y()) - end.y).abs() < 1e-8 * scale);
        }

        #[test]
        fn the_flexibility_is_the_derivative_of_the_end_position(c in any_catenary()) {
            let step = 1e-4 * c.force.x;
            let flexibility = c.compliance().flexibility;
            for (j, direction) in [Vector2::x(), Vector2::y()].into_iter().enumerate() {
                let at = |h: f64| Catenary { force: c.force + direction * h, ..c }.end_position();
                let slope = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
                let rounding = 20.0 * f64::EPSILON * c.end_position().norm().max(c.unstrained_length) / step;
                let error = (slope - flexibility.column(j)).norm();
                prop_assert!(error < 1e-7 * flexibility.norm() + rounding, "{error:e} of {:e}", flexibility.norm());
            }
        }

        #[test]
        fn the_flexibility_is_positive_definite(c in any_catenary()) {
            let f = c.compliance().flexibility;
            prop_assert!(f.m11 > 0.0 && f.m22 > 0.0 && f.determinant() > 0.0);
        }

        #[test]
        fn the_lateral_stiffness_is_the_horizontal_force_over_the_distance(c in any_catenary()) {
            let compliance = c.compliance();
            prop_assert!((compliance.lateral_stiffness * compliance.end.x / c.force.x - 1.0).abs() < 1e-13);
        }

        #[test]
        fn paying_out_cable_between_held_ends_changes_the_force_as_its_derivative_says(c in any_catenary()) {
            let end = c.end_position();
            prop_assume!(end.x > 1e-3 * end.norm() && c.exit_tension() > 1e-2 * c.weight());
            let step = 1e-5 * c.anchor_tension().min(c.weight()) / c.compliance().force_per_length().norm();
            let at = |h: f64| crate::end_force(&c.cable, c.unstrained_length + h, end).unwrap().catenary.force;
            let slope = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
            // The force itself is known to the rounding of the end position times the stiffness.
            let rounding = 1e-14 * c.in_plane_stiffness().norm() * (end.norm() + c.unstrained_length) / step;
            prop_assert!((slope - c.compliance().force_per_length()).norm() < 1e-4 * slope.norm() + rounding);
        }

        #[test]
        fn a_little_more_cable_at_b_moves_a_along_the_tangent_at_b(c in any_catenary()) {
            let step = 1e-4 * c.unstrained_length;
            let at = |h: f64| Catenary { unstrained_length: c.unstrained_length + h, ..c }.end_position();
            let slope = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
            prop_assume!(c.exit_tension() > 1e-2 * c.weight());
            prop_assert!((slope - c.compliance().end_per_length).norm() < 1e-6);
        }
    }
}
