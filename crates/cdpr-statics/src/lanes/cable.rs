//! One cable in each lane: where it runs and how it answers.

use crate::equations::{LinearizedCable, Span, between};
use crate::lanes::algebra::{Lanes2, Lanes3, three};
use crate::lanes::simd::{Lanes, Mask, Simd, WithSimd};
use cdpr_cable::kernel::{
    LaneEnd, LaneSegment, Response, lane_end, lane_law_end, lane_law_response, lane_law_strain, lane_response,
};

/// A cable of every robot, or several cables of one.
#[derive(Clone)]
pub(crate) struct LaneCable<'a, S: Simd> {
    /// Segments of the elastic law, the same in all lanes; none of a linear cable.
    pub(crate) law: &'a [LaneSegment],
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

impl<S: Simd> LaneCable<'_, S> {
    #[inline(always)]
    pub(crate) fn end(&self) -> LaneEnd<Lanes<S>> {
        let Self { law, weight_per_length, axial_flexibility, length, force, .. } = *self;
        match law {
            [] => lane_end(weight_per_length, axial_flexibility, length, force),
            law => {
                length.apart(LawEnd(LawCable { law, weight_per_length, axial_flexibility, length, force }))
            }
        }
    }

    /// Strain at a tension [N].
    #[inline(always)]
    pub(crate) fn strain(&self, tension: Lanes<S>) -> Lanes<S> {
        match self.law {
            [] => tension * self.axial_flexibility,
            law => lane_law_strain(law, self.axial_flexibility, tension),
        }
    }

    /// The span of the cable with the platform at `position`.
    #[inline(always)]
    pub(crate) fn span(&self, position: &Lanes3<S>) -> Span<Lanes<S>> {
        // Eq. (1)
        Span::oblique(between(position, &self.anchor_arm, &self.exit_point))
    }

    #[inline(always)]
    pub(crate) fn response(&self) -> Response<Lanes<S>> {
        let Self { law, weight_per_length, axial_flexibility, length, force, .. } = *self;
        match law {
            [] => lane_response(weight_per_length, axial_flexibility, length, force),
            law => length.apart(LawResponse(LawCable {
                law,
                weight_per_length,
                axial_flexibility,
                length,
                force,
            })),
        }
    }
}

/// A cable with a law. It is evaluated in functions of their own: most robots have linear cables, and their
/// code is faster without it.
struct LawCable<'a, S: Simd> {
    law: &'a [LaneSegment],
    weight_per_length: Lanes<S>,
    axial_flexibility: Lanes<S>,
    length: Lanes<S>,
    force: Lanes2<S>,
}

struct LawResponse<'a, S: Simd>(LawCable<'a, S>);

struct LawEnd<'a, S: Simd>(LawCable<'a, S>);

impl<S: Simd> WithSimd for LawResponse<'_, S> {
    type Output = Response<Lanes<S>>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Self::Output {
        let LawCable { law, weight_per_length, axial_flexibility, length, force } = self.0;
        lane_law_response(law, weight_per_length, axial_flexibility, length, force)
    }
}

impl<S: Simd> WithSimd for LawEnd<'_, S> {
    type Output = LaneEnd<Lanes<S>>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Self::Output {
        let LawCable { law, weight_per_length, axial_flexibility, length, force } = self.0;
        lane_law_end(law, weight_per_length, axial_flexibility, length, force)
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
