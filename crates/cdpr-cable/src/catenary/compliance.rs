//! The flexibility of a cable at its end, and the stiffness that is its inverse.

use crate::kernel::{Response, in_plane_stiffness, stiffness_in_space};
use nalgebra::{Matrix2, Matrix3, Vector2};

/// End position of a cable with its derivatives with respect to force and length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compliance {
    /// End position `(x, z)` [m], (C1)-(C2).
    pub end: Vector2<f64>,
    /// In-plane flexibility `d(x, z)/d(fx, fz)` [m/N], (C3)-(C5).
    pub flexibility: Matrix2<f64>,
    /// Determinant of the in-plane flexibility [m²/N²], (C8).
    ///
    /// The difference of the products of its elements loses the digits of taut, stiff cables.
    pub determinant: f64,
    /// Stiffness `fx/x` across the cable's plane [N/m]; regular for a vertical cable, where `fx = x = 0`.
    pub lateral_stiffness: f64,
    /// Derivative of the end position with respect to the length at constant force at A [m/m], (C9).
    ///
    /// It is the unit tangent at B times `1 + T0/EA`, because cable that is paid out enters there.
    pub end_per_length: Vector2<f64>,
}

impl Compliance {
    /// In-plane stiffness `d(fx, fz)/d(x, z)` [N/m].
    #[inline]
    pub fn in_plane_stiffness(&self) -> Matrix2<f64> {
        let c = &self.flexibility;
        let [xx, xz, zz] = in_plane_stiffness([c.m11, c.m12, c.m22], self.determinant);
        Matrix2::new(xx, xz, xz, zz)
    }

    /// Derivative of the force at A with respect to the unstrained length with both ends held [N/m].
    #[inline]
    pub fn force_per_length(&self) -> Vector2<f64> {
        -self.in_plane_stiffness() * self.end_per_length
    }

    /// Stiffness `dF/dr` [N/m] of the end force in three dimensions: see [`crate::Catenary::stiffness`].
    #[inline]
    pub fn stiffness(&self, azimuth: Vector2<f64>) -> Matrix3<f64> {
        let k = self.in_plane_stiffness();
        stiffness_in_space([k.m11, k.m12, k.m22], self.lateral_stiffness, azimuth.into()).into()
    }
}

impl From<Response<f64>> for Compliance {
    fn from(response: Response<f64>) -> Self {
        let Response {
            end: [x, z],
            flexibility: [xx, xz, zz],
            determinant,
            lateral_flexibility,
            end_per_length,
            ..
        } = response;
        Self {
            end: Vector2::new(x, z),
            flexibility: Matrix2::new(xx, xz, xz, zz),
            determinant,
            lateral_stiffness: 1.0 / lateral_flexibility,
            end_per_length: end_per_length.into(),
        }
    }
}
