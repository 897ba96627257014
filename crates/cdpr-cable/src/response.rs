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
//!
//! At constant force and length the end moves with what the cable is made of. From `dT0/dw = -L V0/T0` follows
//! `d atanh(q)/dw = L/2T0`, and with it, freed of `1/w`,
//!
//! ```text
//! dx/dw = (fx L²/s²) [ (fz + V0)/T0 - 2 q ψ ]
//! dz/dw = -(L²/s²) (fx² + T T0 - fz V0)/T0 - L²/2EA                                        (9)
//! d(x, z)/dEA = -(L/EA²) (fx, fz - wL/2)                                                  (10)
//! ```

use crate::catenary::{Catenary, Compliance};
use crate::real::Real;
use nalgebra::{Matrix2, Vector2};

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
pub(crate) struct Terms<T> {
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
    pub(crate) fn of(catenary: &Catenary) -> Self {
        let Catenary { cable, unstrained_length, force } = *catenary;
        Self::new(cable.weight_per_length, cable.axial_stiffness, unstrained_length, force.x, force.y)
    }

    pub(crate) fn compliance(&self) -> Compliance {
        let Response { end: [x, z], flexibility: [xx, xz, zz], determinant, lateral } = self.response();
        Compliance {
            end: Vector2::new(x, z),
            flexibility: Matrix2::new(xx, xz, xz, zz),
            determinant,
            lateral_stiffness: 1.0 / lateral,
            end_per_length: Vector2::new(self.fx, self.v0) * (1.0 / self.t0 + 1.0 / self.ea),
        }
    }

    pub(crate) fn complementary_energy(&self) -> f64 {
        let Self { fx, fz, v0, length, ea, s, .. } = *self;
        let (q2, psi) = self.sag_terms();
        let phi = 1.0 + q2 * psi;
        let inextensible = (fz + v0) * (fz + v0) / (2.0 * s) + 0.5 * s + 2.0 * fx * fx * phi / s;
        let elastic = (fx * fx + (fz * fz + fz * v0 + v0 * v0) / 3.0) / ea;
        0.5 * length * (inextensible + elastic)
    }

    pub(crate) fn potential_energy(&self) -> f64 {
        let Self { fx, fz, v0, length, weight, ea, fx2, t, t0, s } = *self;
        let (q2, psi) = self.sag_terms();
        let (d, m) = (0.5 * weight, 0.5 * (fz + v0));
        let a = fx2 + m * m;
        let rest = d * d * (2.0 * a + d * d - 4.0 * m * m) / (t * t0 + a);
        let gravity = length * (fx * fx * q2 * psi + 2.0 * m * d - 0.5 * (d * d + rest)) / s;
        let elastic = 0.5 * length * (fx * fx + m * m + 2.0 * m * d - d * d / 3.0) / ea;
        gravity + elastic
    }

    /// d(x, z)/dw, equation (9).
    pub(crate) fn end_per_weight(&self) -> Vector2<f64> {
        let Self { fx, fz, v0, length, ea, weight, fx2, t, t0, s } = *self;
        let (_, psi) = self.sag_terms();
        let (tt0, p) = (t * t0, fz * v0);
        let difference = if p <= 0.0 { tt0 - p } else { fx2 * (fx2 + fz * fz + v0 * v0) / (tt0 + p) };
        let share = length * length / (s * s);
        Vector2::new(
            share * fx * ((fz + v0) / t0 - 2.0 * psi * weight / s),
            -share * (fx2 + difference) / t0 - 0.5 * length * length / ea,
        )
    }

    /// d(x, z)/dEA, equation (10).
    pub(crate) fn end_per_stiffness(&self) -> Vector2<f64> {
        let Self { fx, fz, length, ea, weight, .. } = *self;
        Vector2::new(fx, fz - 0.5 * weight) * (-length / (ea * ea))
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

    pub(crate) fn end_position(&self) -> [T; 2] {
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

    #[test]
    fn series_and_logarithm_meet_without_a_jump() {
        for q2 in [SERIES_LIMIT * (1.0 - 1e-12), SERIES_LIMIT] {
            let q = f64::sqrt(q2);
            assert_relative_eq!(sag_series(q2), (q.atanh() / q - 1.0) / q2, max_relative = 1e-14);
        }
        assert_relative_eq!(sag_series(1e-3 - 1e-18), sag_series(1e-3), max_relative = 1e-15);
    }
}
