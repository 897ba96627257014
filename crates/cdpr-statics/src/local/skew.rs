//! Equilibria whose stiffness H is not symmetric: under a moment, and of cables over guides.
//!
//! Lanes factor the symmetric part H_s. A moment M of constant components has no potential, and by (L17) a
//! cable over a guide has a skew stiffness k_a, so that at an equilibrium
//!
//! ```text
//! H = H_s - [0 0; 0 [M]/2] + sum [Z; s x Z] [1, -s x],       Z = k_a (e_z e_hᵀ - e_h e_zᵀ)
//! ```
//!
//! `Hᵀ y = b`, which the adjoint solves, and `H x = b` under a moment alone, a step of Newton's method, have
//! the solutions of
//!
//! ```text
//! y <- H_s⁻¹ ( b - [0; M x y_r/2] + sum [Z; s x Z] (y_p + y_r x s) ),
//! x <- H_s⁻¹ ( b + [0; M x x_r/2] )                                                                (L18)
//! ```
//!
//! These iterations converge by the ratio of both parts, which is 1e-8 to 1e-6 for guides of most robots.

use crate::equations::CablePlane;
use crate::local::freedoms::constrain;
use cdpr_number::dense::{Lanes3, Lanes6, SymmetricFactors, add, halves, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::vector::{cross, dot};
use cdpr_number::{apart, six, three};
use cdpr_robot::Freedoms;

/// A change of the solution below this part of it ends (L18).
const LAST_CHANGE: f64 = 1e-13;

const MAX_ITERATIONS: usize = 10;

/// What the symmetric part of a system lacks.
pub(crate) struct Skew<S: Simd> {
    pub(crate) freedoms: Freedoms,
    /// M, or -M of the transposed system [N m].
    pub(crate) moment: Option<Lanes3<S>>,
    /// Cables over guides; of the transposed system only.
    pub(crate) guided: Vec<SkewCable<S>>,
}

/// The skew stiffness of one cable.
pub(crate) struct SkewCable<S: Simd> {
    /// s [m].
    pub(crate) arm: Lanes3<S>,
    pub(crate) plane: CablePlane<Lanes<S>>,
    /// k_a [N/m].
    pub(crate) stiffness: Lanes<S>,
}

impl<S: Simd> Skew<S> {
    #[inline(always)]
    fn add_to(&self, right: &mut Lanes6<S>, solution: &Lanes6<S>) {
        let (moved, turned) = halves(solution);
        if let Some(moment) = &self.moment {
            let twisted = cross(moment, &turned);
            for k in 0..3 {
                right[3 + k] += twisted[k] * 0.5;
            }
        }
        for SkewCable { arm, plane, stiffness } in &self.guided {
            let swung = cross(&turned, arm);
            let [h, z] = plane.project(three!(|k| moved[k] + swung[k]));
            add(right, arm, &plane.lift([-(*stiffness * z), *stiffness * h]));
        }
        *right = constrain(self.freedoms, *right);
    }
}

apart! {
    /// Improves the solution of the symmetric part to that of the whole system, (L18); `arm` [m] makes
    /// rotations comparable with translations. Returns the lanes in which it converged.
    #[cold]
    #[inline(never)]
    on(right[0]) pub(crate) fn refine<'a, S: Simd>(
        skew: &'a Skew<S>,
        symmetric: &'a SymmetricFactors<S>,
        right: &'a Lanes6<S>,
        solution: &'a mut Lanes6<S>,
        arm: f64,
    ) -> Mask<S> {
        let mut active = right[0].less_or_equal(right[0]);
        for _ in 0..MAX_ITERATIONS {
            let mut right = *right;
            skew.add_to(&mut right, solution);
            let better = symmetric.solve(&right);
            let change = square(&six!(|k| better[k] - solution[k]), arm);
            replace(solution, &better, active);
            active = active & !change.less_or_equal(square(solution, arm) * (LAST_CHANGE * LAST_CHANGE));
            if !active.any() {
                break;
            }
        }
        !active
    }
}

/// The square of a twist as a length [m²].
#[inline(always)]
fn square<S: Simd>(twist: &Lanes6<S>, arm: f64) -> Lanes<S> {
    let (moved, turned) = halves(twist);
    dot(&moved, &moved) + dot(&turned, &turned) * (arm * arm)
}
