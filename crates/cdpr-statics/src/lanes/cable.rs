//! One taut cable in lanes: where it runs, how it answers, and what it is linearised.

use crate::lanes::algebra::{Space, three};
use crate::lanes::simd::{Lanes, Mask, Simd};
use cdpr_cable::kernel::{Field, Response, TautEnd, taut_end, taut_response};

/// A vector in a cable's vertical plane: along the azimuth, upwards.
pub(crate) type Plane<S> = [Lanes<S>; 2];

/// A cable of every robot, or several cables of one.
pub(crate) struct Cable<S: Simd> {
    /// Weight per length [N/m].
    pub(crate) weight: Lanes<S>,
    /// 1/EA [1/N].
    pub(crate) stretch: Lanes<S>,
    /// Exit point [m].
    pub(crate) exit: Space<S>,
    /// s = R a [m].
    pub(crate) arm: Space<S>,
    /// Unstrained length [m].
    pub(crate) length: Lanes<S>,
    /// Force at A [N].
    pub(crate) force: Plane<S>,
}

impl<S: Simd> Cable<S> {
    #[inline(always)]
    pub(crate) fn end(&self) -> TautEnd<Lanes<S>> {
        taut_end(self.weight, self.stretch, self.length, self.force)
    }

    #[inline(always)]
    pub(crate) fn response(&self) -> Response<Lanes<S>> {
        taut_response(self.weight, self.stretch, self.length, self.force)
    }
}

/// From exit to anchor point.
pub(crate) struct Span<S: Simd> {
    pub(crate) azimuth: Plane<S>,
    /// (h, z) [m].
    pub(crate) end: Plane<S>,
}

impl<S: Simd> Span<S> {
    #[inline(always)]
    pub(crate) fn new(position: &Space<S>, cable: &Cable<S>) -> Self {
        let r = three(|k| position[k] + cable.arm[k] - cable.exit[k]);
        let h = (r[0] * r[0] + r[1] * r[1]).sqrt();
        let inverse = h.recip();
        Self { azimuth: [r[0] * inverse, r[1] * inverse], end: [h, r[2]] }
    }

    /// What is left from the end of a cable to its anchor point.
    #[inline(always)]
    pub(crate) fn miss(&self, end: Plane<S>) -> Plane<S> {
        [self.end[0] - end[0], self.end[1] - end[1]]
    }
}

/// A cable linearised about a force that need not fit its ends: `df = K (c + d(h, z))`, as in `direct/newton.rs`.
#[derive(Clone, Copy)]
pub(crate) struct Linear<S: Simd> {
    pub(crate) azimuth: Plane<S>,
    /// f + K c.
    pub(crate) predicted: Plane<S>,
    /// K: xx, xz, zz.
    pub(crate) stiffness: [Lanes<S>; 3],
    /// Stiffness across the cable's plane.
    pub(crate) lateral: Lanes<S>,
}

impl<S: Simd> Linear<S> {
    /// About `force`, to which the cable answers with `response`.
    #[inline(always)]
    pub(crate) fn new(span: &Span<S>, force: Plane<S>, response: &Response<Lanes<S>>) -> Self {
        let [xx, xz, zz] = response.flexibility;
        let inverse = response.determinant.recip();
        let mut linear = Self {
            azimuth: span.azimuth,
            predicted: force,
            stiffness: [zz * inverse, -xz * inverse, xx * inverse],
            lateral: response.lateral_flexibility.recip(),
        };
        linear.predict(force, &span.miss(response.end));
        linear
    }

    /// The force that brings the end of a cable with force f, missed by c, to its anchor point: f + K c.
    #[inline(always)]
    pub(crate) fn predict(&mut self, [x, z]: Plane<S>, miss: &Plane<S>) {
        let [xx, xz, zz] = self.stiffness;
        self.predicted = [x + xx * miss[0] + xz * miss[1], z + xz * miss[0] + zz * miss[1]];
    }

    /// Takes over another one in the lanes that are `going`.
    #[inline(always)]
    pub(crate) fn replace(&mut self, other: &Self, going: Mask<S>) {
        for k in 0..2 {
            self.azimuth[k] = going.select(other.azimuth[k], self.azimuth[k]);
            self.predicted[k] = going.select(other.predicted[k], self.predicted[k]);
        }
        self.stiffness = three(|k| going.select(other.stiffness[k], self.stiffness[k]));
        self.lateral = going.select(other.lateral, self.lateral);
    }

    /// A force in the cable's plane, in space.
    #[inline(always)]
    pub(crate) fn lift(&self, [x, z]: Plane<S>) -> Space<S> {
        [x * self.azimuth[0], x * self.azimuth[1], z]
    }
}
