//! The elastic catenary for a given force at its end.
//!
//! A cable of unstrained length `L`, weight `w` per unstrained length and axial stiffness `EA` carries the
//! force `(fx, fz)` at A. With the vertical force at B, the two end tensions and their sum
//!
//! ```text
//! V0 = fz - w L,   T = sqrt(fx² + fz²),   T0 = sqrt(fx² + V0²),   s = T + T0,   q = w L / s
//! ```
//!
//! the end A lies at
//!
//! ```text
//! x = fx L [ 1/EA + (2/s) φ(q²) ],        φ(q²) = atanh(q)/q = 1 + q² ψ(q²)             (C1)
//! z = L [ (fz - wL/2)/EA + (fz + V0)/s ]                                                (C2)
//! ```
//!
//! These are Eq. (2a) and (2b) of Baklouti, Caro, Courteille (CableCon 2017) and (1.32)-(1.33) of Irvine,
//! *Cable Structures* (1981), written without differences: with `sinh u = fz/fx` at A and `sinh u0 = V0/fx`
//! at B, `tanh((u - u0)/2) = q`. The usual form subtracts two inverse hyperbolic sines and two square roots
//! and loses most of its digits for taut, stiff or light cables. This one is exact to rounding for all of
//! them, and `w = 0` is a straight spring. (The paper prints Eq. (2b) with `fx L/ES` as its first term, which
//! has to be `fz L/ES`.)
//!
//! The flexibility `C = d(x, z)/d(fx, fz)` is symmetric and positive definite. It follows from
//! `D = fx² + T T0 + fz V0 = s² (1 - q²)/2` and `g = fx²/D`:
//!
//! ```text
//! dz/dfz = L [ 1/EA + s g/(T T0) ]                                                      (C3)
//! dx/dfz = -fx L (fz + V0) / (T T0 s)                                                   (C4)
//! dx/dfx = L [ 1/EA + 2 q² ψ/s + N/(s T T0 D) ],                                        (C5)
//!          N = fx² (fz² + V0²) + 2 fz V0 (fz V0 + T T0)
//! ```
//!
//! The complementary energy has (C1)-(C2) for its gradient. It is the integral of `T + T²/2EA` over the
//! unstrained length:
//!
//! ```text
//! U* = (L/2) [ (fz + V0)²/(2s) + s/2 + 2 fx² φ/s ] + (L/2EA) [ fx² + (fz² + fz V0 + V0²)/3 ]   (C6)
//! ```
//!
//! The potential energy is `V = f·r - U*`. With `m = (fz + V0)/2`, `d = w L/2` and `A = fx² + m²` it is,
//! freed of what cancels,
//!
//! ```text
//! V = (L/s) [ fx² q² ψ + 2 m d - d²/2 - d² (2A + d² - 4m²)/(2 (T T0 + A)) ]
//!   + (L/2EA) [ fx² + m² + 2 m d - d²/3 ]                                               (C7)
//! ```
//!
//! The determinant of the flexibility is a sum of positive terms,
//!
//! ```text
//! det C = L² [ (1/EA) (1/EA + xx + zz) + 2 q² ψ g/(T T0) ],                             (C8)
//! ```
//!
//! with `xx` and `zz` the terms of the brackets of (C5) and (C3) besides 1/EA. (The determinant of the
//! inextensible cable is `4 sinh²h (h/tanh h - 1)/(w² cosh u cosh u0)` with `tanh h = q`.)
//!
//! Cable paid out at B enters along the tangent there, with the strain that it has there:
//!
//! ```text
//! d(x, z)/dL = (fx, V0) (1/T0 + 1/EA)                                                   (C9)
//! ```
//!
//! Where `fz V0 < 0` (the cable dips below both ends) `T T0 + fz V0` is computed as
//! `fx² (fx² + fz² + V0²)/(T T0 - fz V0)`, so that nothing cancels for a cable that hangs folded
//! (`fx -> 0`). A taut cable, `q² <= 0.02`, does not need the choice: there
//! `-fz V0 <= (w L/2)² = q² s²/4`, a fiftieth of `T T0`.

use super::series::{TAUT, psi_by_halves, psi_of_taut};
use cdpr_number::{Lanewise, Number, Real};

/// End position of a cable for a force at its end, with its derivatives, over any kind of number.
#[derive(Clone, Copy, Debug)]
pub struct Response<T> {
    /// End position (x, z) [m], (C1) and (C2).
    pub end: [T; 2],
    /// In-plane flexibility C: dx/dfx, dx/dfz = dz/dfx, dz/dfz [m/N], (C3)-(C5).
    pub flexibility: [T; 3],
    /// Determinant of the in-plane flexibility [m²/N²], (C8).
    pub determinant: T,
    /// Flexibility x/fx across the cable's plane [m/N].
    pub lateral_flexibility: T,
    /// Derivative of the end position with respect to the length at constant force [m/m], (C9).
    pub end_per_length: [T; 2],
    /// Tension T at A [N].
    pub tension: T,
    /// 1/T [1/N].
    pub tension_inv: T,
    /// Direction (fx, fz)/T of the force at A.
    pub direction: [T; 2],
    /// Slackness q², from 0 for a straight cable to 1 for one that hangs folded.
    pub slackness: T,
}

/// The response of a linear cable to the force `[fx, fz]` [N] at A.
///
/// The cable has the weight per length `w` [N/m], the axial flexibility 1/EA [1/N] and the unstrained length
/// `length` [m]. Where `fx` is below 1e-25 of the other forces, `fx²` is raised by 1e-60 of their squares,
/// which keeps a vertical folded cable regular.
pub fn response<T: Real>(w: T, axial_flexibility: T, length: T, [fx, fz]: [T; 2]) -> Response<T> {
    Terms::new(w, axial_flexibility, length, fx, fz).response(None)
}

/// End position, tension and slackness of a cable.
#[derive(Clone, Copy, Debug)]
pub struct LaneEnd<T> {
    /// End position (x, z) [m], (C1) and (C2).
    pub end: [T; 2],
    /// Tension T at A [N].
    pub tension: T,
    /// Slackness q².
    pub slackness: T,
}

/// An inextensible part times α.
#[inline(always)]
fn stretched<T: Number>(part: T, alpha: Option<T>) -> T {
    match alpha {
        None => part,
        Some(alpha) => part * alpha,
    }
}

/// The quantities that equations (C1)-(C9) share.
pub(crate) struct Terms<T> {
    pub(super) fx: T,
    pub(super) fz: T,
    pub(super) v0: T,
    pub(super) length: T,
    /// 1/EA.
    axial_flexibility: T,
    weight: T,
    pub(super) fx2: T,
    /// T, tension at A.
    pub(super) t: T,
    /// T0, tension at B.
    pub(super) t0: T,
    /// 1/s = 1/(T + T0).
    s_inv: T,
}

impl Terms<f64> {
    pub(crate) fn complementary_energy(&self) -> f64 {
        let Self { fx, fz, v0, length, axial_flexibility, t, t0, .. } = *self;
        let Sag { q2, psi, .. } = self.sag();
        let (s, phi) = (t + t0, 1.0 + q2 * psi);
        let inextensible = (fz + v0) * (fz + v0) / (2.0 * s) + 0.5 * s + 2.0 * fx * fx * phi / s;
        let elastic = (fx * fx + (fz * fz + fz * v0 + v0 * v0) / 3.0) * axial_flexibility;
        0.5 * length * (inextensible + elastic)
    }

    pub(crate) fn potential_energy(&self) -> f64 {
        let Self { fx, fz, v0, length, weight, axial_flexibility, fx2, t, t0, s_inv } = *self;
        let Sag { q2, psi, .. } = self.sag();
        let (d, m) = (0.5 * weight, 0.5 * (fz + v0));
        let a = fx2 + m * m;
        let rest = d * d * (2.0 * a + d * d - 4.0 * m * m) / (t * t0 + a);
        let gravity = length * (fx * fx * q2 * psi + 2.0 * m * d - 0.5 * (d * d + rest)) * s_inv;
        let elastic = 0.5 * length * axial_flexibility * (fx * fx + m * m + 2.0 * m * d - d * d / 3.0);
        gravity + elastic
    }
}

impl Response<f64> {
    /// The same response in another kind of number.
    pub fn map<T: Copy>(self, of: impl Fn(f64) -> T) -> Response<T> {
        Response {
            end: self.end.map(&of),
            flexibility: self.flexibility.map(&of),
            determinant: of(self.determinant),
            lateral_flexibility: of(self.lateral_flexibility),
            end_per_length: self.end_per_length.map(&of),
            tension: of(self.tension),
            tension_inv: of(self.tension_inv),
            direction: self.direction.map(&of),
            slackness: of(self.slackness),
        }
    }
}

impl<T: Lanewise> Response<T> {
    /// One of two responses to the same force for each cable.
    #[inline(always)]
    pub(super) fn select(mask: T::Mask, chosen: &Self, otherwise: &Self) -> Self {
        let mut one = *otherwise;
        for k in 0..2 {
            one.end[k] = T::select(mask, chosen.end[k], otherwise.end[k]);
            one.end_per_length[k] = T::select(mask, chosen.end_per_length[k], otherwise.end_per_length[k]);
        }
        for k in 0..3 {
            one.flexibility[k] = T::select(mask, chosen.flexibility[k], otherwise.flexibility[k]);
        }
        one.determinant = T::select(mask, chosen.determinant, otherwise.determinant);
        one.lateral_flexibility = T::select(mask, chosen.lateral_flexibility, otherwise.lateral_flexibility);
        one
    }
}

impl<T: Number> Terms<T> {
    #[inline(always)]
    pub(super) fn with_square(w: T, axial_flexibility: T, length: T, fx: T, fz: T, fx2: T) -> Self {
        let weight = w * length;
        let v0 = fz - weight;
        let t = (fx2 + fz * fz).sqrt();
        let t0 = (fx2 + v0 * v0).sqrt();
        Self { fx, fz, v0, length, axial_flexibility, weight, fx2, t, t0, s_inv: (t + t0).recip() }
    }

    /// The same of a cable with another axial flexibility.
    #[inline(always)]
    pub(super) fn with_flexibility(&self, axial_flexibility: T) -> Self {
        Self { axial_flexibility, ..*self }
    }

    /// q².
    #[inline(always)]
    pub(super) fn slackness(&self) -> T {
        let q = self.weight * self.s_inv;
        q * q
    }

    /// x/fx = L [1/EA + 2φ/s], (C1).
    #[inline(always)]
    fn lateral_flexibility(&self, phi: T) -> T {
        // Eq. (2a) is fx times this.
        self.length * (self.axial_flexibility + phi * 2.0 * self.s_inv)
    }

    /// z, (C2).
    #[inline(always)]
    fn height(&self, alpha: Option<T>) -> T {
        let Self { fz, v0, length, weight, axial_flexibility, s_inv, .. } = *self;
        // Eq. (2b), with fz L/ES as its first term.
        length * ((fz + weight * -0.5) * axial_flexibility + stretched((fz + v0) * s_inv, alpha))
    }

    /// fz² + V0².
    #[inline(always)]
    fn squares(&self) -> T {
        self.fz * self.fz + self.v0 * self.v0
    }

    /// g = fx²/D and N/D of a cable for which nothing cancels in D.
    #[inline(always)]
    fn shape_of_the_taut(&self) -> [T; 2] {
        let p = self.fz * self.v0;
        let tt0 = self.t * self.t0;
        let d_inv = (self.fx2 + tt0 + p).recip();
        [self.fx2 * d_inv, (self.fx2 * self.squares() + p * 2.0 * (p + tt0)) * d_inv]
    }
}

/// What the sag of a cable makes of its response.
struct Sag<T> {
    /// q².
    q2: T,
    /// ψ(q²).
    psi: T,
    /// g = fx²/D and N/D.
    shape: [T; 2],
}

impl<T: Lanewise> Terms<T> {
    /// The sag of any cable.
    #[inline(always)]
    fn sag(&self) -> Sag<T> {
        let q2 = self.slackness();
        let taut = q2.at_most(TAUT);
        let (mut psi, mut shape) = (psi_of_taut(q2), self.shape_of_the_taut());
        if !T::all(taut) {
            let Sag { psi: slack_psi, shape: [g, n_over_d], .. } = self.sag_of_the_slack(q2, shape);
            psi = T::select(taut, psi, slack_psi);
            shape = [T::select(taut, shape[0], g), T::select(taut, shape[1], n_over_d)];
        }
        Sag { q2, psi, shape }
    }

    /// The sag of cables that need not be taut, with the shape that they have unless they dip.
    ///
    /// With m = (fx² + fz² + V0²)/(T T0 - fz V0), D = fx² (1 + m) does not cancel where fz V0 < 0.
    #[inline(always)]
    fn sag_of_the_slack(&self, q2: T, [g, n_over_d]: [T; 2]) -> Sag<T> {
        let Self { fx2, fz, v0, t, t0, s_inv, .. } = *self;
        let (p, tt0) = (fz * v0, t * t0);
        let dips = p.at_most(0.0);
        let m = (fx2 + self.squares()) / (tt0 - p);
        let d = T::select(dips, fx2 * (m + 1.0), fx2 + tt0 + p);
        // sqrt(1 - q²)
        let cosine = (d * 2.0).sqrt() * s_inv;
        let folded_g = (m + 1.0).recip();
        let folded_n = folded_g * (self.squares() + p * 2.0 * m);
        let shape = [T::select(dips, folded_g, g), T::select(dips, folded_n, n_over_d)];
        Sag { q2, psi: psi_by_halves(q2, cosine), shape }
    }

    #[inline(always)]
    pub(crate) fn end_position(&self) -> [T; 2] {
        let Sag { q2, psi, .. } = self.sag();
        [self.fx * self.lateral_flexibility(q2 * psi + 1.0), self.height(None)]
    }

    /// (C1)-(C5), (C8) and (C9), with the inextensible part times `alpha`, (C13); 1 without it.
    #[inline(always)]
    pub(crate) fn response(&self, alpha: Option<T>) -> Response<T> {
        let Sag { q2, psi, shape: [g, n_over_d] } = self.sag();
        let Self { fx, fz, v0, length, axial_flexibility, t, t0, s_inv, .. } = *self;
        let tt0_inv = (t * t0).recip();
        let sag = q2 * psi * 2.0;
        let sag_zz = stretched((t + t0) * g * tt0_inv, alpha);
        let sag_xx = stretched((sag + n_over_d * tt0_inv) * s_inv, alpha);
        let lateral_flexibility = self.lateral_flexibility(stretched(q2 * psi + 1.0, alpha));
        let bent = stretched(stretched(sag * g * tt0_inv, alpha), alpha);
        let determinant = (axial_flexibility + sag_xx + sag_zz) * axial_flexibility + bent;
        let entering = stretched(t * tt0_inv, alpha) + axial_flexibility;
        let tension_inv = t0 * tt0_inv;
        Response {
            // Eq. (2a), Eq. (2b)
            end: [fx * lateral_flexibility, self.height(alpha)],
            flexibility: [
                length * (axial_flexibility + sag_xx),
                stretched(-fx * length * (fz + v0) * (tt0_inv * s_inv), alpha),
                length * (axial_flexibility + sag_zz),
            ],
            determinant: length * determinant * length,
            lateral_flexibility,
            end_per_length: [fx * entering, v0 * entering],
            tension: t,
            tension_inv,
            direction: [fx * tension_inv, fz * tension_inv],
            slackness: q2,
        }
    }
}

impl<T: Real> Terms<T> {
    pub(crate) fn new(w: T, axial_flexibility: T, length: T, fx: T, fz: T) -> Self {
        let others = fz.value().abs() + (w * length).value();
        let mut fx2 = fx * fx;
        if fx.value() <= (1e-25 * others).max(1e-150) {
            fx2 = fx2 + (1e-60 * others * others + f64::MIN_POSITIVE);
        }
        Self::with_square(w, axial_flexibility, length, fx, fz, fx2)
    }
}
