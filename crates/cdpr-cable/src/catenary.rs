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
//! and its determinant, every term of which is positive,
//!
//! ```text
//! det C = L² [ (1/EA) (1/EA + xx + zz) + 2 q² ψ g/(T T0) ],                                (8)
//! ```
//!
//! with `xx` and `zz` the other terms of the brackets of (5) and (3) (the determinant of the inextensible cable is
//! `4 sinh²h (h/tanh h - 1)/(w² cosh u cosh u0)` with `tanh h = q`).
//!
//! For `fz V0 < 0` (the cable dips below both ends) `T T0 + fz V0` is formed as
//! `fx² (fx² + fz² + V0²)/(T T0 - fz V0)`, so that nothing cancels for a cable that hangs folded (`fx -> 0`).
//!
//! The complementary energy, whose gradient is (1)-(2), is the integral of `T + T²/2EA` over the unstrained length:
//!
//! ```text
//! U* = (L/2) [ (fz + V0)²/(2s) + s/2 + 2 fx² φ/s ] + (L/2EA) [ fx² + (fz² + fz V0 + V0²)/3 ]   (6)
//! ```
//!
//! and the potential energy `V = f·r - U*`, with `m = (fz + V0)/2`, `d = w L/2` and `A = fx² + m²` freed of what cancels:
//!
//! ```text
//! V = (L/s) [ fx² q² ψ + 2 m d - d²/2 - d² (2A + d² - 4m²)/(2 (T T0 + A)) ]
//!   + (L/2EA) [ fx² + m² + 2 m d - d²/3 ]                                                      (7)
//! ```

use crate::error::{CableError, SMALLEST, check};
use crate::real::Real;
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
    /// Checks that the weight is zero or from 1e-30 N/m to 1e30 N/m, the stiffness from 1e-30 N to 1e30 N.
    ///
    /// # Errors
    /// [`CableError::InvalidInput`] names the field.
    pub fn validate(&self) -> Result<(), CableError> {
        let Self { weight_per_length: w, axial_stiffness: ea } = *self;
        check(
            "weight_per_length",
            w,
            w == 0.0 || w >= SMALLEST,
            "a weight per length, zero or from 1e-30 to 1e30 [N/m]",
        )?;
        check("axial_stiffness", ea, ea >= SMALLEST, "an axial stiffness from 1e-30 to 1e30 [N]")
    }
}

impl Cable {
    /// Whether the weight of this length vanishes beside the stiffness, and its square below the smallest number.
    pub(crate) fn is_weightless(&self, unstrained_length: f64) -> bool {
        self.weight_per_length * unstrained_length <= 1e-100 * self.axial_stiffness
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
    /// Determinant of the flexibility [m²/N²], equation (8): the difference of its products loses the digits of taut, stiff cables.
    pub determinant: f64,
    /// Out-of-plane stiffness `fx/x` [N/m]; regular for a vertical cable, where `fx = x = 0`.
    pub lateral_stiffness: f64,
    /// Derivative of the end position with respect to the unstrained length at constant force at A [m/m]: the unit tangent
    /// at B times `1 + T0/EA`, since the new piece of cable enters there.
    pub end_per_length: Vector2<f64>,
}

impl Catenary {
    /// Position `(x, z)` of A relative to B [m], equations (1)-(2).
    pub fn end_position(&self) -> Vector2<f64> {
        self.terms().end_position().into()
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

    /// Potential energy V [J], equation (7): elastic energy plus the work done against gravity, zero for a massless cable at
    /// rest with its weight at the height of B. As a function of the end position its gradient is the force at A.
    pub fn potential_energy(&self) -> f64 {
        self.terms().potential_energy()
    }

    /// Whether this is a slack cable without weight: it carries nothing, resists nothing and has no shape, so that end
    /// position and flexibility mean nothing.
    pub fn is_limp(&self) -> bool {
        self.force == Vector2::zeros() && self.cable.is_weightless(self.unstrained_length)
    }

    fn terms(&self) -> Terms<f64> {
        Terms::of(self)
    }
}

impl Compliance {
    /// In-plane stiffness `d(fx, fz)/d(x, z)` [N/m].
    pub fn in_plane_stiffness(&self) -> Matrix2<f64> {
        let c = &self.flexibility;
        Matrix2::new(c.m22, -c.m12, -c.m21, c.m11) / self.determinant
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

/// End position, flexibility and lateral flexibility of a catenary, over any kind of number.
#[derive(Clone, Copy, Debug)]
pub struct Response<T> {
    /// End position (x, z) [m], equations (1)-(2).
    pub end: [T; 2],
    /// Flexibility dx/dfx, dx/dfz = dz/dfx, dz/dfz [m/N], equations (3)-(5).
    pub flexibility: [T; 3],
    /// Determinant of the flexibility [m²/N²], equation (8).
    pub determinant: T,
    /// x/fx [m/N]: lateral flexibility.
    pub lateral: T,
}

/// The response of a cable with weight per length `w` [N/m], axial stiffness `ea` [N] and unstrained length `length` [m] to
/// the force `[fx, fz]` [N] at A. Where `fx` is below 1e-25 of the other forces, `fx²` is raised by 1e-60 of their squares, which keeps
/// a vertical folded cable regular.
pub fn response<T: Real>(w: T, ea: T, length: T, [fx, fz]: [T; 2]) -> Response<T> {
    Terms::new(w, ea, length, fx, fz).response()
}

/// The quantities that equations (1)-(7) share.
struct Terms<T> {
    fx: T,
    fz: T,
    v0: T,
    length: T,
    ea: T,
    weight: T,
    fx2: T,
    /// T, tension at A.
    t: T,
    /// T0, tension at B.
    t0: T,
    /// s = T + T0.
    s: T,
}

impl Terms<f64> {
    fn of(catenary: &Catenary) -> Self {
        let Catenary { cable, unstrained_length, force } = *catenary;
        Self::new(cable.weight_per_length, cable.axial_stiffness, unstrained_length, force.x, force.y)
    }

    fn compliance(&self) -> Compliance {
        let Response { end: [x, z], flexibility: [xx, xz, zz], determinant, lateral } = self.response();
        Compliance {
            end: Vector2::new(x, z),
            flexibility: Matrix2::new(xx, xz, xz, zz),
            determinant,
            lateral_stiffness: 1.0 / lateral,
            end_per_length: Vector2::new(self.fx, self.v0) * (1.0 / self.t0 + 1.0 / self.ea),
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

    fn potential_energy(&self) -> f64 {
        let Self { fx, fz, v0, length, weight, ea, fx2, t, t0, s } = *self;
        let (q2, psi) = self.sag_terms();
        let (d, m) = (0.5 * weight, 0.5 * (fz + v0));
        let a = fx2 + m * m;
        let rest = d * d * (2.0 * a + d * d - 4.0 * m * m) / (t * t0 + a);
        let gravity = length * (fx * fx * q2 * psi + 2.0 * m * d - 0.5 * (d * d + rest)) / s;
        let elastic = 0.5 * length * (fx * fx + m * m + 2.0 * m * d - d * d / 3.0) / ea;
        gravity + elastic
    }
}

impl<T: Real> Terms<T> {
    fn new(w: T, ea: T, length: T, fx: T, fz: T) -> Self {
        let weight = w * length;
        let others = fz.value().abs() + weight.value();
        let mut fx2 = fx * fx;
        if fx.value() <= (1e-25 * others).max(1e-150) {
            fx2 = fx2 + (1e-60 * others * others + f64::MIN_POSITIVE);
        }
        let v0 = fz - weight;
        let t = (fx2 + fz * fz).sqrt();
        let t0 = (fx2 + v0 * v0).sqrt();
        Self { fx, fz, v0, length, ea, weight, fx2, t, t0, s: t + t0 }
    }

    /// m = (fx² + fz² + V0²)/(T T0 - fz V0), with which D = fx² (1 + m) without cancellation where fz V0 < 0.
    fn fold(&self) -> T {
        (self.fx2 + self.fz * self.fz + self.v0 * self.v0) / (self.t * self.t0 - self.fz * self.v0)
    }

    /// D = fx² + T T0 + fz V0.
    fn d(&self) -> T {
        let p = self.fz * self.v0;
        if p.value() >= 0.0 { self.fx2 + self.t * self.t0 + p } else { self.fx2 * (self.fold() + 1.0) }
    }

    /// (q², ψ(q²)).
    fn sag_terms(&self) -> (T, T) {
        let q = self.weight / self.s;
        let q2 = q * q;
        let psi = if q2.upper() < SERIES_LIMIT {
            sag_series(q2)
        } else {
            // atanh q = ln((1 + q)/sqrt(1 - q²)), with 1 - q² = 2D/s²
            let atanh = ((q + 1.0) * self.s / (self.d() * 2.0).sqrt()).ln();
            (atanh / q + -1.0) / q2
        };
        (q2, psi)
    }

    fn end_position(&self) -> [T; 2] {
        let (q2, psi) = self.sag_terms();
        [self.fx * self.lateral(q2 * psi + 1.0), self.height()]
    }

    /// x/fx = L [1/EA + 2φ/s], equation (1).
    fn lateral(&self, phi: T) -> T {
        self.length * (T::of(1.0) / self.ea + phi * 2.0 / self.s)
    }

    /// z, equation (2).
    fn height(&self) -> T {
        let Self { fz, v0, length, ea, weight, s, .. } = *self;
        length * ((fz + weight * -0.5) / ea + (fz + v0) / s)
    }

    fn response(&self) -> Response<T> {
        let Self { fx, fz, v0, length, ea, fx2, t, t0, s, .. } = *self;
        let (q2, psi) = self.sag_terms();
        let lateral = self.lateral(q2 * psi + 1.0);
        let tt0 = t * t0;
        let p = fz * v0;
        let squares = fz * fz + v0 * v0;
        let (g, n_over_d) = if p.value() >= 0.0 {
            let d = fx2 + tt0 + p;
            (fx2 / d, (fx2 * squares + p * 2.0 * (p + tt0)) / d)
        } else {
            let m = self.fold();
            let g = T::of(1.0) / (m + 1.0);
            (g, g * (squares + p * 2.0 * m))
        };
        let stretch = T::of(1.0) / ea;
        let sag_zz = s * g / tt0;
        let sag_xx = q2 * psi * 2.0 / s + n_over_d / (s * tt0);
        let xz = -fx * length * (fz + v0) / (tt0 * s);
        let determinant = (stretch + sag_xx + sag_zz) * stretch + q2 * psi * 2.0 * g / tt0;
        Response {
            end: [fx * lateral, self.height()],
            flexibility: [length * (stretch + sag_xx), xz, length * (stretch + sag_zz)],
            determinant: length * determinant * length,
            lateral,
        }
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
fn sag_series<T: Real>(q2: T) -> T {
    // A taut cable has q² below 1e-3: six terms leave 1e-18.
    let terms = if q2.upper() < 1e-3 { &SERIES[..6] } else { &SERIES[..] };
    let sum = terms.iter().rev().fold(T::of(0.0), |sum, term| sum * q2 + *term);
    // The rest, below q²ⁿ/((2n + 3)(1 - q²)) = 3e-19, and the rounding of the coefficients, at most 6e-17 in all.
    sum.within(1e-16)
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
    fn a_straight_spring_is_as_stiff_across_as_its_tension_makes_it() {
        let spring = catenary(Cable { weight_per_length: 0.0, axial_stiffness: 1e6 }, 10.0, 1e-11, 1e-11);
        // EA/L along and T/L across the direction (1, 1).
        let k = spring.in_plane_stiffness();
        assert_relative_eq!(k, Matrix2::new(5e4, 5e4, 5e4, 5e4), max_relative = 1e-12);
    }

    #[test]
    fn a_stiff_taut_cable_keeps_the_digits_of_its_energy() {
        // f·r and U* are 1e5 J each; 40-digit arithmetic gives their difference.
        let cable = Cable { weight_per_length: 1e-3, axial_stiffness: 1e9 };
        let taut = catenary(cable, 100.0, 800.0, 600.0);
        assert_relative_eq!(taut.potential_energy(), 3.0497866520994881, max_relative = 1e-14);
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
            let products = f.m11 * f.m22 + f.m12 * f.m21;
            prop_assert!((c.compliance().determinant - f.determinant()).abs() < 1e-14 * products);
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
