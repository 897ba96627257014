//! The wheel of a pulley with a tilted swivel axis, (C19).

use cdpr_number::Lanewise;

/// What a tilted axis adds to the way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Swung<T> {
    pub(super) wheel: Wheel<T>,
    /// μ [m/N], and δ of (C22) [1/m].
    pub(super) mu: T,
    pub(super) delta: T,
    /// n - δ q.
    pub(super) coupled: [T; 3],
    /// -γ q_y.
    pub(super) coupled_across: T,
    /// q_y/β [m/N].
    pub(super) free_across: T,
}

/// A wheel about a tilted axis, in the axes of the cable's plane: forwards, across and upwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wheel<T> {
    pub(super) cos: T,
    pub(super) sin: T,
    /// 1 + cos ψ.
    pub(super) one_plus_cos: T,
    pub(super) u: [T; 3],
    pub(super) n: [T; 3],
    pub(super) m: [T; 3],
    /// B_y [m].
    pub(super) leave_across: T,
}

impl<T: Lanewise> Wheel<T> {
    /// (C19) of a pulley of this radius [m].
    #[inline(always)]
    pub(super) fn new(radius: T, [kx, ky, kz]: [T; 3], [tx, tz]: [T; 2]) -> Self {
        let cos = -(tx * kx + tz * kz);
        let normal = [ky * tz, kz * tx - kx * tz, -(ky * tx)];
        let sin = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
        // A cable that goes straight on has no wheel's plane: without a pulley that adds nothing.
        let straight = T::select(radius.at_most(0.0), sin, sin * 0.0 + 1.0).at_most(0.0);
        let sin_inv = T::select(straight, sin * 0.0, sin.recip());
        let [nx, ny, nz] = [normal[0] * sin_inv, normal[1] * sin_inv, normal[2] * sin_inv];
        let u = [ny * kz - nz * ky, nz * kx - nx * kz, nx * ky - ny * kx];
        let m = [cos * u[0] + sin * kx, cos * u[1] + sin * ky, cos * u[2] + sin * kz];
        let one_plus_cos = T::select(cos.at_most(0.0), sin * sin / (-cos + 1.0), cos + 1.0);
        Self { cos, sin, one_plus_cos, u, n: [nx, ny, nz], m, leave_across: sin * 0.0 }
    }

    /// B [m].
    #[inline(always)]
    pub(super) fn leave(&self, radius: T, [kx, ky, kz]: [T; 3]) -> [T; 3] {
        let Self { sin, one_plus_cos, u: [ux, uy, uz], .. } = *self;
        [
            radius * (one_plus_cos * ux + sin * kx),
            radius * (one_plus_cos * uy + sin * ky),
            radius * (one_plus_cos * uz + sin * kz),
        ]
    }

    /// μ of (C22) [m/N]: sin ψ/(1 - cos ψ) is (1 + cos ψ)/sin ψ where the cable turns back.
    #[inline(always)]
    pub(super) fn mu(&self, radius: T, tension_inv: T) -> T {
        let Self { cos, sin, .. } = *self;
        let backwards = sin / (-cos + 1.0);
        let forwards = (cos + 1.0) / sin;
        let per_radius = T::select(cos.at_most(0.0), backwards, forwards);
        T::select(radius.at_most(0.0), sin * 0.0, radius * per_radius * tension_inv)
    }
}
