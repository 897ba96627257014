//! Whether an equilibrium with a load is the one that the unloaded platform becomes: the questions of
//! `direct/near.rs` in lanes. What they leave open is followed by the scalar models.

use crate::direct::{KEPT, MAX_CORRECTION, SAME_POSE};
use crate::equations::vector::dot;
use crate::lanes::algebra::{SymmetricFactors, halves};
use crate::lanes::load::PlatformLoad;
use crate::lanes::newton::{LinearizedPlatform, Robots, Scale, Steps};
use crate::lanes::simd::{Mask, Simd};
use cdpr_cable::kernel::Field;

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
        let Steps { first, ref others } = platform.steps;
        let (p, r) = halves(others);
        let (corrected, first) = ((dot(&p, &p) + dot(&r, &r)).sqrt(), first.sqrt());
        let near = corrected.less_or_equal(first * MAX_CORRECTION + SAME_POSE * scale.size);
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
        let kept = corrected.less_or_equal(first) & SymmetricFactors::new(stiffness).positive;
        found & (near | kept)
    }
}
