//! Whether an equilibrium with a load is the one that the unloaded platform becomes: the questions of
//! `direct/near.rs` in lanes. What they leave open is followed by the scalar models.

use crate::local::load::PlatformLoad;
use crate::local::platform::{LinearizedPlatform, Robots, Scale, Steps};
use cdpr_number::Number;
use cdpr_number::dense::SymmetricFactors;
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::vector::dot;

/// Largest correction of a prediction, relative to it.
pub(crate) const MAX_CORRECTION: f64 = 0.2;

/// Distance of poses, relative to the robot's size, that a correction may have in addition.
pub(crate) const SAME_POSE: f64 = 1e-7;

/// Share of the stiffness of every motion that is left where a branch does not end.
pub(crate) const KEPT: f64 = 0.5;

impl<S: Simd> Steps<S> {
    /// Lengths of the prediction and of its correction [m].
    #[inline(always)]
    fn lengths(&self) -> [Lanes<S>; 2] {
        [dot(&self.first, &self.first).sqrt(), dot(&self.others, &self.others).sqrt()]
    }

    /// The lanes in which a search ended near what its first step predicted.
    #[inline(always)]
    pub(crate) fn end_near_prediction(&self, scale: &Scale) -> Mask<S> {
        let [first, corrected] = self.lengths();
        corrected.less_or_equal(first * MAX_CORRECTION + SAME_POSE * scale.size)
    }
}

impl<S: Simd> Robots<'_, S> {
    /// The lanes of `found` in which the search with the load ended near its prediction, or where every
    /// motion keeps enough of the stiffness that it has `unloaded`.
    #[inline(always)]
    pub(crate) fn on_branch(
        &self,
        load: &PlatformLoad<S>,
        platform: &LinearizedPlatform<S>,
        unloaded: &SymmetricFactors<S>,
        scale: &Scale,
        found: Mask<S>,
    ) -> Mask<S> {
        let near = platform.steps.end_near_prediction(scale);
        let open = found & !near;
        if !open.any() {
            return found;
        }
        let (_, mut stiffness) = self.balance(load, platform);
        for (row, of_unloaded) in stiffness.iter_mut().zip(&unloaded.product()) {
            for (element, unloaded) in row.iter_mut().zip(of_unloaded) {
                *element -= *unloaded * KEPT;
            }
        }
        let [first, corrected] = platform.steps.lengths();
        let kept = corrected.less_or_equal(first) & SymmetricFactors::new(stiffness).positive;
        found & (near | kept)
    }
}
