//! Whether an equilibrium is the one that another becomes: cheap conditions, of which either is enough.
//!
//! A branch that ends loses the stiffness of one motion, which the pose then follows like a square root. An
//! equilibrium beyond such an end is neither near what the linearization predicts, nor as stiff as the first
//! one and within reach of it. Where neither is true, the change is made in smaller steps.

use crate::direct::newton::Converged;
use crate::direct::stability::Stability;
use crate::local::branch::{KEPT, MAX_CORRECTION, SAME_POSE};
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_robot::Vector6;

/// Whether the iteration ended near what its first step predicted.
pub(super) fn is_near_prediction(problem: &DirectProblem, from: &Equilibrium, found: &Converged) -> bool {
    let motion = motion(problem, from, &found.equilibrium);
    let most = MAX_CORRECTION * found.first_step.norm() + SAME_POSE * problem.size();
    (motion - found.first_step).norm() <= most
}

/// Whether the iteration ended within twice the prediction, where every motion keeps enough of its stiffness.
pub(super) fn keeps_stiffness(
    problem: &DirectProblem,
    (from, stiffness): (&Equilibrium, &Stability),
    found: &Converged,
) -> bool {
    let motion = motion(problem, from, &found.equilibrium);
    (motion - found.first_step).norm() <= found.first_step.norm() && found.stability.exceeds(KEPT, stiffness)
}

/// (dp, ℓ dφ) from one equilibrium to another [m].
pub(super) fn motion(problem: &DirectProblem, from: &Equilibrium, to: &Equilibrium) -> Vector6<f64> {
    let mut motion = from.pose.motion_to(&to.pose);
    motion.fixed_rows_mut::<3>(3).scale_mut(problem.characteristic_length());
    motion
}
