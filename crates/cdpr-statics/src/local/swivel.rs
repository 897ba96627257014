//! What a tilted axis adds to a linearized cable: forces across its plane.

use crate::equations::{CablePlane, LinearizedCable, Span};
use cdpr_cable::kernel::GuidedInSpace;
use cdpr_number::Number;
use cdpr_number::dense::{Lanes2, Lanes3, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::three;

/// What a tilted axis adds to the linearized cable: forces across its plane.
#[derive(Clone, Copy)]
pub(crate) struct Swivel<S: Simd> {
    /// Predicted force across the plane [N].
    pub(crate) predicted: Lanes<S>,
    /// Stiffness between the direction across the plane and those along e_h and e_z [N/m].
    pub(crate) stiffness: Lanes2<S>,
    /// dLf per force across the plane [m/N].
    pub(crate) free_per_force: Lanes<S>,
}

impl<S: Simd> Swivel<S> {
    /// That of a vertical axis: nothing.
    #[inline(always)]
    pub(crate) fn none(zero: Lanes<S>) -> Self {
        Self { predicted: zero, stiffness: [zero; 2], free_per_force: zero }
    }

    #[inline(always)]
    pub(crate) fn replace(&mut self, other: &Self, active: Mask<S>) {
        self.predicted.replace(other.predicted, active);
        replace(&mut self.stiffness, &other.stiffness, active);
        self.free_per_force.replace(other.free_per_force, active);
    }

    /// Adds its part of the force on the cable and of the stiffness in space.
    #[inline(always)]
    pub(crate) fn add_to(
        &self,
        plane: &CablePlane<Lanes<S>>,
        force: &mut Lanes3<S>,
        stiffness: &mut [Lanes3<S>; 3],
    ) {
        let ([c, s], [along, upwards]) = (plane.azimuth, self.stiffness);
        force[0] -= self.predicted * s;
        force[1] += self.predicted * c;
        // along (e_h e_lᵀ + e_l e_hᵀ) + upwards (e_z e_lᵀ + e_l e_zᵀ)
        let (double, mixed) = (along * c * s * 2.0, along * (c * c - s * s));
        let [x, y] = [-(upwards * s), upwards * c];
        stiffness[0][0] -= double;
        stiffness[1][1] += double;
        stiffness[0][1] += mixed;
        stiffness[1][0] += mixed;
        stiffness[0][2] += x;
        stiffness[2][0] += x;
        stiffness[1][2] += y;
        stiffness[2][1] += y;
    }

    /// The force after a displacement of A in space [m].
    #[inline(always)]
    pub(crate) fn force_after(&self, cable: &LinearizedCable<Lanes<S>>, r: Lanes3<S>) -> SwivelledForce<S> {
        let ([along, upwards], beyond) = (self.stiffness, cable.plane.across(r));
        let [h, z] = cable.plane.project(r);
        let [fx, fz] = cable.force_after(r);
        let across = self.predicted + along * h + cable.lateral_stiffness * beyond + upwards * z;
        SwivelledForce {
            in_plane: [fx + along * beyond, fz + upwards * beyond],
            across,
            free_length: self.free_per_force * across,
        }
    }

    /// Adds to the prediction of a cable what its misclosure across the plane [m] adds, and assigns the force
    /// across the plane by its whole misclosure `miss` [m] in the lanes that are `active`. Returns that
    /// force.
    #[inline(always)]
    pub(crate) fn close(
        &mut self,
        cable: &mut LinearizedCable<Lanes<S>>,
        [h, z]: Lanes2<S>,
        across: Lanes<S>,
        active: Mask<S>,
    ) -> Lanes3<S> {
        let [along, upwards] = self.stiffness;
        cable.predicted[0] += along * across;
        cable.predicted[1] += upwards * across;
        let predicted = along * h + cable.lateral_stiffness * across + upwards * z;
        self.predicted.replace(predicted, active);
        let [x, y] = cable.plane.azimuth;
        [-(predicted * y), predicted * x, across.all(0.0)]
    }
}

/// The force on a cable over a tilted axis, in the plane that it had and across that.
#[derive(Clone, Copy)]
pub(crate) struct SwivelledForce<S: Simd> {
    /// Along e_h and upwards [N].
    pub(crate) in_plane: Lanes2<S>,
    /// Across, to the left [N].
    pub(crate) across: Lanes<S>,
    /// What the force across adds to the length beyond the leave point [m].
    pub(crate) free_length: Lanes<S>,
}

/// A cable over a tilted axis, linearized by the symmetric part of its flexibility.
#[inline(always)]
pub(crate) fn in_space<S: Simd>(
    span: &Span<Lanes<S>>,
    across: Lanes<S>,
    [fx, fz]: Lanes2<S>,
    missing: Lanes<S>,
    space: &GuidedInSpace<Lanes<S>>,
) -> (LinearizedCable<Lanes<S>>, Swivel<S>) {
    let GuidedInSpace { end, flexibility: c, end_per_length, .. } = space;
    let [hh, ll, zz] = [c[0][0], c[1][1], c[2][2]];
    let [hl, hz, lz] = [(c[0][1] + c[1][0]) * 0.5, (c[0][2] + c[2][0]) * 0.5, (c[1][2] + c[2][1]) * 0.5];
    let [of_hh, of_hl, of_hz] = [ll * zz - lz * lz, hz * lz - hl * zz, hl * lz - ll * hz];
    let inverse = (hh * of_hh + hl * of_hl + hz * of_hz).recip();
    let stiffness = [of_hh * inverse, of_hz * inverse, (hh * ll - hl * hl) * inverse];
    let lateral_stiffness = (hh * zz - hz * hz) * inverse;
    let [along, upwards] = [of_hl * inverse, (hl * hz - hh * lz) * inverse];
    let miss = three!(|k| -(end[k] + end_per_length[k] * missing));
    let [h, l, z] = [span.end[0] + miss[0], across + miss[1], span.end[1] + miss[2]];
    let [xx, xz, zz] = stiffness;
    let predicted = [fx + xx * h + along * l + xz * z, fz + xz * h + upwards * l + zz * z];
    let cable = LinearizedCable { plane: span.plane, predicted, stiffness, lateral_stiffness };
    let predicted = along * h + lateral_stiffness * l + upwards * z;
    let swivel = Swivel { predicted, stiffness: [along, upwards], free_per_force: space.free_per_force[1] };
    (cable, swivel)
}
