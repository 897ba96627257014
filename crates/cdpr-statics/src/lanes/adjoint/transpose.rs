//! The transposed equations of equilibrium, where cables over guides have a skew stiffness.
//!
//! By (L17) the stiffness of the platform exceeds its symmetric part by one term a cable,
//!
//! ```text
//! H = H_s + sum [Z; s x Z] [1, -s x],       Z = k_a (e_z e_hᵀ - e_h e_zᵀ)
//! ```
//!
//! The adjoint solves `Hᵀ y = b`. The factors of H_s are at hand, and
//!
//! ```text
//! y <- H_s⁻¹ ( b + sum [Z; s x Z] (y_p + y_r x s) )                                                (L18)
//! ```
//!
//! converges by the ratio of both parts, which is 1e-8 to 1e-6 for most robots.

use crate::equations::vector::{cross, dot};
use crate::lanes::adjoint::answer::Answer;
use crate::lanes::algebra::{Lanes6, add, halves, replace, six, three};
use crate::lanes::newton::{LinearizedPlatform, Robots};
use crate::lanes::simd::{Lanes, Mask, Simd, WithSimd};

/// A change of the twist below this part of it ends (L18).
const LAST_CHANGE: f64 = 1e-13;

const MAX_ITERATIONS: usize = 10;

/// Improves the twist y of `H_s y = right` to that of `Hᵀ y = right`, (L18); `arm` [m] makes rotations
/// comparable with translations. Returns the lanes in which it converged.
#[cold]
#[inline(never)]
pub(super) fn transpose<S: Simd>(
    robots: &Robots<'_, S>,
    platform: &LinearizedPlatform<S>,
    answers: &[Answer<Lanes<S>>],
    right: &Lanes6<S>,
    twist: &mut Lanes6<S>,
    arm: f64,
) -> Mask<S> {
    right[0].apart(Transpose { robots, platform, answers, right, twist, arm })
}

struct Transpose<'a, 'b, S: Simd> {
    robots: &'a Robots<'b, S>,
    platform: &'a LinearizedPlatform<S>,
    answers: &'a [Answer<Lanes<S>>],
    right: &'a Lanes6<S>,
    twist: &'a mut Lanes6<S>,
    arm: f64,
}

impl<S: Simd> WithSimd for Transpose<'_, '_, S> {
    type Output = Mask<S>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Mask<S> {
        let Self { robots, platform, answers, right, twist, arm } = self;
        let mut going = right[0].less_or_equal(right[0]);
        for _ in 0..MAX_ITERATIONS {
            let (moved, turned) = halves(twist);
            let mut right = *right;
            for ((cable, linearized), answer) in robots.cables.iter().zip(&platform.cables).zip(answers) {
                if let Some(skew) = answer.skew_stiffness() {
                    let swung = cross(&turned, &cable.anchor_arm);
                    let [h, z] = linearized.plane.project(three!(|k| moved[k] + swung[k]));
                    add(&mut right, &cable.anchor_arm, &linearized.plane.lift([-(skew * z), skew * h]));
                }
            }
            let better = platform.moved(&right);
            let change = square(&six!(|k| better[k] - twist[k]), arm);
            replace(twist, &better, going);
            going = going & !change.less_or_equal(square(twist, arm) * (LAST_CHANGE * LAST_CHANGE));
            if !going.any() {
                break;
            }
        }
        !going
    }
}

/// The square of a twist as a length [m²].
#[inline(always)]
fn square<S: Simd>(twist: &Lanes6<S>, arm: f64) -> Lanes<S> {
    let (moved, turned) = halves(twist);
    dot(&moved, &moved) + dot(&turned, &turned) * (arm * arm)
}
