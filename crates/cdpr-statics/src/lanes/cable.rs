//! One cable in each lane: where it runs and how it answers.

use crate::equations::{LinearizedCable, Span, between};
use crate::lanes::algebra::{Lanes2, Lanes3, three};
use crate::lanes::simd::{Lanes, Mask, Simd};
use cdpr_cable::kernel::{LaneEnd, Response, lane_end, lane_response};

/// A cable of every robot, or several cables of one.
pub(crate) struct LaneCable<S: Simd> {
    /// Weight per length [N/m].
    pub(crate) weight_per_length: Lanes<S>,
    /// 1/EA [1/N].
    pub(crate) axial_flexibility: Lanes<S>,
    /// Exit point [m].
    pub(crate) exit_point: Lanes3<S>,
    /// s = R a [m].
    pub(crate) anchor_arm: Lanes3<S>,
    /// Unstrained length [m].
    pub(crate) length: Lanes<S>,
    /// Force at A [N].
    pub(crate) force: Lanes2<S>,
}

impl<S: Simd> LaneCable<S> {
    #[inline(always)]
    pub(crate) fn end(&self) -> LaneEnd<Lanes<S>> {
        lane_end(self.weight_per_length, self.axial_flexibility, self.length, self.force)
    }

    /// The span of the cable with the platform at `position`.
    #[inline(always)]
    pub(crate) fn span(&self, position: &Lanes3<S>) -> Span<Lanes<S>> {
        // Eq. (1)
        Span::oblique(between(position, &self.anchor_arm, &self.exit_point))
    }

    #[inline(always)]
    pub(crate) fn response(&self) -> Response<Lanes<S>> {
        lane_response(self.weight_per_length, self.axial_flexibility, self.length, self.force)
    }
}

impl<S: Simd> LinearizedCable<Lanes<S>> {
    /// Takes over another one in the lanes that are `going`.
    #[inline(always)]
    pub(crate) fn replace(&mut self, other: &Self, going: Mask<S>) {
        for k in 0..2 {
            self.plane.azimuth[k] = going.select(other.plane.azimuth[k], self.plane.azimuth[k]);
            self.predicted[k] = going.select(other.predicted[k], self.predicted[k]);
        }
        self.stiffness = three(|k| going.select(other.stiffness[k], self.stiffness[k]));
        self.lateral_stiffness = going.select(other.lateral_stiffness, self.lateral_stiffness);
    }
}
