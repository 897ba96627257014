//! Cables without guide, or the parts of cables beyond their guides, one in each lane.

use cdpr_cable::kernel::{LaneEnd, Material, Response};
use cdpr_number::dense::Lanes2;
use cdpr_number::lanes::{Lanes, Simd, WithSimd};

/// A cable without guide, or the part of one beyond its guide.
#[derive(Clone, Copy)]
pub(crate) struct FreeCable<'a, S: Simd> {
    pub(crate) material: Material<'a, Lanes<S>>,
    /// Unstrained length [m].
    pub(crate) length: Lanes<S>,
    /// Force at A [N].
    pub(crate) force: Lanes2<S>,
}

impl<S: Simd> FreeCable<'_, S> {
    /// The position of its end. Cables with a law are evaluated in functions of their own: most robots have
    /// linear cables, and their code is faster without it.
    #[inline(always)]
    pub(crate) fn end(&self) -> LaneEnd<Lanes<S>> {
        match self.material.law {
            [] => self.material.end(self.length, self.force),
            _ => self.length.apart(LawEnd(*self)),
        }
    }

    /// How its end responds to forces.
    #[inline(always)]
    pub(crate) fn response(&self) -> Response<Lanes<S>> {
        match self.material.law {
            [] => self.material.response(self.length, self.force),
            _ => self.length.apart(LawResponse(*self)),
        }
    }
}

/// A cable with a law.
struct LawResponse<'a, S: Simd>(FreeCable<'a, S>);

struct LawEnd<'a, S: Simd>(FreeCable<'a, S>);

impl<S: Simd> WithSimd for LawResponse<'_, S> {
    type Output = Response<Lanes<S>>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Self::Output {
        let FreeCable { material, length, force } = self.0;
        material.response(length, force)
    }
}

impl<S: Simd> WithSimd for LawEnd<'_, S> {
    type Output = LaneEnd<Lanes<S>>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Self::Output {
        let FreeCable { material, length, force } = self.0;
        material.end(length, force)
    }
}
