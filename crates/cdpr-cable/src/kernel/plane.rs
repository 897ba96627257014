//! One cable between its points in its vertical plane: its stiffness, and its closure where it has no shape.

use super::response::Response;
use cdpr_number::{Number, Real};
use nalgebra::{Matrix2, Vector2};

impl<T: Number> Response<T> {
    /// In-plane stiffness `K = d(fx, fz)/d(x, z)`, its elements xx, xz = zx and zz [N/m].
    #[inline(always)]
    pub fn in_plane_stiffness(&self) -> [T; 3] {
        in_plane_stiffness(self.flexibility, self.determinant)
    }
}

impl Response<f64> {
    /// In-plane flexibility C [m/N] as a matrix.
    #[inline]
    pub fn flexibility_matrix(&self) -> Matrix2<f64> {
        let [xx, xz, zz] = self.flexibility;
        Matrix2::new(xx, xz, xz, zz)
    }

    /// In-plane stiffness [N/m] as a matrix.
    #[inline]
    pub fn stiffness_matrix(&self) -> Matrix2<f64> {
        let [xx, xz, zz] = self.in_plane_stiffness();
        Matrix2::new(xx, xz, xz, zz)
    }

    /// Derivative of the force at A with respect to the unstrained length between fixed ends [N/m].
    #[inline]
    pub fn force_per_length(&self) -> Vector2<f64> {
        -self.stiffness_matrix() * Vector2::from(self.end_per_length)
    }
}

/// The elements xx, xz = zx and zz of `K = C⁻¹` from those of the in-plane flexibility C and its determinant.
///
/// The determinant is an argument because equation (C8) gives it without cancellation.
#[inline(always)]
pub fn in_plane_stiffness<T: Number>([xx, xz, zz]: [T; 3], determinant: T) -> [T; 3] {
    let inverse = determinant.recip();
    [zz * inverse, -xz * inverse, xx * inverse]
}

/// Stiffness `dF/dr` of the end force in space [N/m], `z` up: a symmetric matrix.
///
/// The cable has the elements xx, xz = zx and zz of its in-plane stiffness, the stiffness `lateral` across
/// its plane, and the horizontal unit vector `azimuth` from B towards A.
#[inline(always)]
pub fn stiffness_in_space<T: Number>(in_plane: [T; 3], lateral: T, azimuth: [T; 2]) -> [[T; 3]; 3] {
    let ([h, hz, z], [c, s]) = (in_plane, azimuth);
    let (hc, hs, across) = (h * c, h * s, lateral * s);
    let (xy, xz, yz) = (hc * s - across * c, hz * c, hz * s);
    [[hc * c + across * s, xy, xz], [xy, hs * s + lateral * c * c, yz], [xz, yz, z]]
}

/// Closure residual of a slack cable without weight, from `end = (x, z)` [m] of its anchor point.
///
/// Such a cable has no shape: it spans any distance up to its length at rest `rest`, `L (1 + ε(0))` [m]
/// ([`crate::Catenary::length_at_rest`]). For a longer one the residual is what it is too short, along the
/// chord.
pub fn closure_of_slack<T: Real>([x, z]: [T; 2], rest: T) -> [T; 2] {
    let chord = (x * x + z * z).sqrt();
    let share = if chord.value() > rest.value() { T::of(1.0) - rest / chord } else { T::of(0.0) };
    [x * share, z * share]
}
