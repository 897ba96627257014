//! Cables without guide, or the parts of cables beyond their guides, one in each lane.

use cdpr_cable::kernel::{LaneEnd, Material, Response};
use cdpr_number::apart;
use cdpr_number::lanes::{Lanes, Simd};

/// A cable without guide, or the part of one beyond its guide.
#[derive(Clone, Copy)]
pub(crate) struct FreeCable<'a, T> {
    pub(crate) material: Material<'a, T>,
    /// Unstrained length [m].
    pub(crate) length: T,
    /// Force at A [N].
    pub(crate) force: [T; 2],
}

impl<S: Simd> FreeCable<'_, Lanes<S>> {
    /// The position of its end. Cables with a law are evaluated in functions of their own: most robots have
    /// linear cables, and their code is faster without it.
    #[inline(always)]
    pub(crate) fn end(&self) -> LaneEnd<Lanes<S>> {
        match self.material.law {
            [] => self.material.end(self.length, self.force),
            _ => law_end(*self),
        }
    }

    /// How its end responds to forces.
    #[inline(always)]
    pub(crate) fn response(&self) -> Response<Lanes<S>> {
        match self.material.law {
            [] => self.material.response(self.length, self.force),
            _ => law_response(*self),
        }
    }
}

apart! {
    #[inline(always)]
    on(cable.length) fn law_end<'a, S: Simd>(cable: FreeCable<'a, Lanes<S>>) -> LaneEnd<Lanes<S>> {
        cable.material.end(cable.length, cable.force)
    }

    #[inline(always)]
    on(cable.length) fn law_response<'a, S: Simd>(cable: FreeCable<'a, Lanes<S>>) -> Response<Lanes<S>> {
        cable.material.response(cable.length, cable.force)
    }
}
