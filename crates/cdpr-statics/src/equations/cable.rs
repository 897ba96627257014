//! One cable in space, over any kind of number: doubles, intervals, the lanes of a vector unit.
//!
//! From the exit point B_i to the anchor point A_i leads
//!
//! ```text
//! r_i = p + s_i - b_i,      s_i = R a_i                                                        Eq. (1)
//! ```
//!
//! The cable hangs in the vertical plane of r_i, which has the directions `e_h` of the horizontal part of r_i
//! and `e_z` upwards; `e_l = e_z x e_h` points across it. (h, z) are the components of r_i in the plane. The
//! force (fx, fz) on the cable at A, whose end is at (x, z) by Eq. (2a) and (2b), acts on the platform as
//!
//! ```text
//! F_i = -(fx e_h + fz e_z)      with the wrench      [F_i; s_i x F_i]                              (S1)
//! ```
//!
//! Linearized about a force f that need not yet fit the two points, the cable responds to a displacement of A
//! with
//!
//! ```text
//! df = K (c + d(h, z)),      c = (h, z) - (x, z)(f, L),      K = C⁻¹                               (S2)
//! dF_i = -K3 dr_i,           K3 = [e_h e_z] K [e_h e_z]ᵀ + k_l e_l e_lᵀ,      k_l = fx/x           (S3)
//! ```
//!
//! with the flexibility C of `cdpr_cable` and the lateral stiffness k_l.

use cdpr_number::{Number, Real};

use cdpr_cable::kernel::{Response, stiffness_in_space};

/// The vertical plane of a cable.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CablePlane<T> {
    /// Horizontal direction e_h from B towards A.
    pub(crate) azimuth: [T; 2],
}

impl<T: Number> CablePlane<T> {
    /// A vector (along e_h, along e_z) of the plane in the base frame.
    #[inline(always)]
    pub(crate) fn lift(&self, [x, z]: [T; 2]) -> [T; 3] {
        [x * self.azimuth[0], x * self.azimuth[1], z]
    }

    /// The components of a vector of the base frame in the plane.
    #[inline(always)]
    pub(crate) fn project(&self, [x, y, z]: [T; 3]) -> [T; 2] {
        [self.azimuth[0] * x + self.azimuth[1] * y, z]
    }

    /// The component of a vector of the base frame across the plane, along e_l.
    #[inline(always)]
    pub(crate) fn across(&self, [x, y, _]: [T; 3]) -> T {
        self.azimuth[0] * y - self.azimuth[1] * x
    }

    /// A vector in the base frame from its components in the plane and across it.
    #[inline(always)]
    pub(crate) fn in_space(&self, along: [T; 2], across: T) -> [T; 3] {
        let [x, y, z] = self.lift(along);
        [x - self.azimuth[1] * across, y + self.azimuth[0] * across, z]
    }

    /// Force F_i on the platform [N] of a cable with the force (fx, fz) at A, equation (S1).
    #[inline(always)]
    pub(crate) fn force_on_platform(&self, [x, z]: [T; 2]) -> [T; 3] {
        self.lift([-x, -z])
    }
}

/// The vector r_i from the exit point to the anchor point, in the cable's plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span<T> {
    pub(crate) plane: CablePlane<T>,
    /// Horizontal distance h and height z of A from B [m].
    pub(crate) end: [T; 2],
}

impl<T: Number> Span<T> {
    /// The span of r_i, which must not be vertical: numbers that cannot choose have no azimuth then.
    #[inline(always)]
    pub(crate) fn oblique([x, y, z]: [T; 3]) -> Self {
        let h = (x * x + y * y).sqrt();
        let inverse = h.recip();
        Self { plane: CablePlane { azimuth: [x * inverse, y * inverse] }, end: [h, z] }
    }

    /// The same vector in another vertical plane, and its component across that [m].
    #[inline(always)]
    pub(crate) fn seen_in(&self, plane: CablePlane<T>) -> (Self, T) {
        let r = self.plane.lift(self.end);
        (Self { plane, end: plane.project(r) }, plane.across(r))
    }

    /// Distance of the two points [m].
    #[inline(always)]
    pub(crate) fn chord(&self) -> T {
        (self.end[0] * self.end[0] + self.end[1] * self.end[1]).sqrt()
    }

    /// Misclosure c [m] of a cable whose end is at (x, z), equation (S2).
    #[inline(always)]
    pub(crate) fn misclosure(&self, end: [T; 2]) -> [T; 2] {
        [self.end[0] - end[0], self.end[1] - end[1]]
    }
}

impl<T: Real> Span<T> {
    /// The span of r_i. Where A is right above or below B the azimuth is the x axis.
    #[inline(always)]
    pub(crate) fn new(r: [T; 3]) -> Self {
        let span = Self::oblique(r);
        let vertical = CablePlane { azimuth: [T::of(1.0), T::of(0.0)] };
        if span.end[0].value() > 0.0 { span } else { Self { plane: vertical, ..span } }
    }
}

/// r_i, Eq. (1), of the exit point b and the arm s of the anchor point.
#[inline(always)]
pub(crate) fn between<T: Number>(p: &[T; 3], s: &[T; 3], b: &[T; 3]) -> [T; 3] {
    // Eq. (1)
    [p[0] + s[0] - b[0], p[1] + s[1] - b[1], p[2] + s[2] - b[2]]
}

/// A cable linearized about a force that need not fit its two points, equations (S2) and (S3).
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinearizedCable<T> {
    pub(crate) plane: CablePlane<T>,
    /// Predicted force f + K c [N].
    pub(crate) predicted: [T; 2],
    /// Stiffness in the plane K: xx, xz, zz [N/m].
    pub(crate) stiffness: [T; 3],
    /// Stiffness k_l across the plane [N/m].
    pub(crate) lateral_stiffness: T,
}

impl<T: Number> LinearizedCable<T> {
    /// Linearizes about `force`, to which the cable responds with `response`.
    #[inline(always)]
    pub(crate) fn new(span: &Span<T>, force: [T; 2], response: &Response<T>) -> Self {
        let linearized = Self {
            plane: span.plane,
            predicted: force,
            stiffness: response.in_plane_stiffness(),
            lateral_stiffness: response.lateral_flexibility.recip(),
        };
        let predicted = linearized.after(force, span.misclosure(response.end));
        Self { predicted, ..linearized }
    }

    /// The force [N] that a displacement of A in the plane [m] makes of `force`: f + K d.
    #[inline(always)]
    pub(crate) fn after(&self, [x, z]: [T; 2], [dx, dz]: [T; 2]) -> [T; 2] {
        let [xx, xz, zz] = self.stiffness;
        [x + xx * dx + xz * dz, z + xz * dx + zz * dz]
    }

    /// The force [N] after a displacement of A in space [m], equation (S2).
    #[inline(always)]
    pub(crate) fn force_after(&self, displacement: [T; 3]) -> [T; 2] {
        self.after(self.predicted, self.plane.project(displacement))
    }

    /// Stiffness K3 in space [N/m], equation (S3): a symmetric matrix.
    #[inline(always)]
    pub(crate) fn stiffness_in_space(&self) -> [[T; 3]; 3] {
        stiffness_in_space(self.stiffness, self.lateral_stiffness, self.plane.azimuth)
    }
}
