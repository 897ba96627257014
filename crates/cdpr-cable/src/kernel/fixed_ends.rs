//! A cable between fixed ends at a given horizontal force, over any kind of number.
//!
//! Unknowns are the force dl across the plane, the vertical force fz and the unstrained length. With C the
//! flexibility in the axes of the cable's plane (forwards, across to the left, upwards), e = dA/dL and c the
//! misclosure
//!
//! ```text
//! C (0, dl, dz) + e dL = c,      C (1, l', z') + e L' = 0                                         (C38)
//! ```
//!
//! give the changes that close the cable at the same horizontal force, and the derivatives by that force. The
//! misclosure changes as A moves, so that the same matrix gives the response to the motion of the ends.
//! [`GuidedInSpace::free_per_force`] leads from the whole length to that beyond the leave point.

use super::guide::GuidedInSpace;
use super::response::Response;
use cdpr_number::vector::{cross, dot};
use cdpr_number::{Number, three};

/// A cable between fixed ends; each vector has the force across the plane [N], the vertical force [N] and the
/// unstrained length [m].
#[derive(Clone, Copy, Debug)]
pub struct AtFixedEnds<T> {
    /// The changes that close the cable.
    pub closing: [T; 3],
    /// Derivatives by the horizontal force.
    pub per_force: [T; 3],
    /// The rows of the derivatives by the motion of A forwards, across and upwards.
    pub per_end: [[T; 3]; 3],
}

impl<T: Number> AtFixedEnds<T> {
    /// A cable without guide, whose response misses its end by `miss` [m]; `lateral` is its stiffness fx/h
    /// across the plane [N/m].
    #[inline(always)]
    pub fn in_plane(response: &Response<T>, miss: [T; 2], lateral: T) -> Self {
        let ([xx, xz, zz], [ex, ez]) = (response.flexibility, response.end_per_length);
        let inverse = (ex * zz - ez * xz).recip();
        let zero = inverse.constant(0.0);
        let [dz, longer] = [(ex * miss[1] - ez * miss[0]) * inverse, (zz * miss[0] - xz * miss[1]) * inverse];
        Self {
            closing: [zero, dz, longer],
            per_force: [zero, (ez * xx - ex * xz) * inverse, -(response.determinant * inverse)],
            per_end: [
                [zero, lateral, zero],
                [-(ez * inverse), zero, ex * inverse],
                [zz * inverse, zero, -(xz * inverse)],
            ],
        }
    }

    /// A cable over a guide, that is `open` [m] forwards, across and upwards. Its length is that beyond the
    /// leave point, which changes by `free_per_length` for each change of the whole one.
    #[inline(always)]
    pub fn in_space(space: &GuidedInSpace<T>, free_per_length: T, open: [T; 3]) -> Self {
        let GuidedInSpace { flexibility: c, end_per_length, free_per_force: q, .. } = space;
        let [across, upwards] = [three!(|k| c[k][1]), three!(|k| c[k][2])];
        // The rows of the inverse of [C e_l, C e_z, dA/dL].
        let [first, second, third] =
            [cross(&upwards, end_per_length), cross(end_per_length, &across), cross(&across, &upwards)];
        let inverse = dot(&across, &first).recip();
        let [across, upwards, whole] =
            [three!(|k| first[k] * inverse), three!(|k| second[k] * inverse), three!(|k| third[k] * inverse)];
        let free = three!(|k| whole[k] * free_per_length + q[1] * across[k] + q[2] * upwards[k]);
        let forwards = three!(|k| -c[k][0]);
        Self {
            closing: [dot(&across, &open), dot(&upwards, &open), dot(&free, &open)],
            per_force: [dot(&across, &forwards), dot(&upwards, &forwards), dot(&free, &forwards) + q[0]],
            per_end: [across, upwards, free],
        }
    }
}
