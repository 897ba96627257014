//! One cable between its points in its vertical plane: its stiffness, and its closure where it has no shape.

use super::field::{Field, Real};
use super::response::Response;

impl<T: Field> Response<T> {
    /// In-plane stiffness `K = d(fx, fz)/d(x, z)`, its elements xx, xz = zx and zz [N/m].
    #[inline(always)]
    pub fn in_plane_stiffness(&self) -> [T; 3] {
        in_plane_stiffness(self.flexibility, self.determinant)
    }
}

/// The elements xx, xz = zx and zz of `K = C⁻¹` from those of the in-plane flexibility C and its determinant.
///
/// The determinant is an argument because equation (C8) gives it without cancellation.
#[inline(always)]
pub fn in_plane_stiffness<T: Field>([xx, xz, zz]: [T; 3], determinant: T) -> [T; 3] {
    let inverse = determinant.recip();
    [zz * inverse, -xz * inverse, xx * inverse]
}

/// Closure residual of a slack cable without weight whose anchor point lies at `end = (x, z)` [m] from its
/// exit point.
///
/// Such a cable has no shape: it closes any distance up to its length at rest `L (1 + ε(0))` [m], the
/// argument `rest` ([`crate::Catenary::length_at_rest`]). What it is too short for a longer one stays open
/// along the chord.
pub fn closure_of_limp<T: Real>([x, z]: [T; 2], rest: T) -> [T; 2] {
    let chord = (x * x + z * z).sqrt();
    let open = if chord.value() > rest.value() { T::of(1.0) - rest / chord } else { T::of(0.0) };
    [x * open, z * open]
}
