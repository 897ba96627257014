//! Newton's method on the `6 + 2n` equations, with the cables eliminated.
//!
//! Linearized at forces f_i that need not yet fit the pose, cable i gives `df_i = K_i (c_i + d(h_i, z_i))`,
//! (S2) of `equations/cable.rs`.
//!
//! Put into the balance of the platform with the predicted forces `f_i + K_i c_i` this leaves six equations
//! for (dp, dφ), whose matrix is the stiffness (S5) with the forces f_i as they are. An iteration evaluates
//! each catenary once and solves one 6 x 6 system.
//!
//! Fewer cables than free motions may leave motions that nothing resists, and constrained motions have no
//! equation. Such a robot takes steps by the singular values of the matrix: motions without resistance and
//! force are left out, so that they stay where they started.

use crate::direct::stability::Stability;
use crate::equations::{Balance, LinearizedInSpace, SpannedCable, forces, per_length};
use crate::local::one_robot::{Solved, solve};
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Residual};
use cdpr_robot::{Vector2, Vector3, Vector6};
use nalgebra::Matrix6;

/// An equilibrium to which the iteration converged, stable or not.
pub(crate) struct Converged {
    pub(crate) equilibrium: Equilibrium,
    pub(crate) iterations: usize,
    pub(crate) residual: Residual,
    pub(crate) stability: Stability,
    /// The first step (dp, ℓ dφ), which the linearization at the start predicts [m].
    pub(crate) first_step: Vector6<f64>,
}

const MAX_ITERATIONS: usize = 15;

/// A step below this, relative to the robot's size, is followed by one below rounding, because Newton's
/// method squares it.
const LAST_STEP: f64 = 1e-7;

/// Resistance below this share of the greatest one, and force below this share of all forces, are rounding.
const NEARLY_ZERO: f64 = 1e-10;
const ROUNDED_FORCE: f64 = 1e-13;

/// The linearized model at a state: the platform's balance with predicted forces, the cables, and the
/// residual of the state itself.
struct Linearized<'a> {
    /// Gradient and stiffness along the motions that are free.
    gradient: Vector6<f64>,
    hessian: Matrix6<f64>,
    symmetric_hessian: Matrix6<f64>,
    /// s_i [m] and each cable; none that resists nothing.
    cables: Vec<([f64; 3], Option<LinearizedInSpace<'a>>)>,
    residual: Residual,
}

impl<'a> Linearized<'a> {
    fn new(problem: &DirectProblem<'a>, state: &Equilibrium) -> Self {
        let (freedoms, mut balance) = (problem.robot.freedoms(), Balance::of_load(problem, &state.pose));
        let (mut unbalanced, mut closure) = (balance.gradient, 0.0);
        let mut cables = Vec::with_capacity(problem.cables());
        for (i, force) in state.cable_forces.iter().enumerate() {
            let cable = SpannedCable::of(problem.robot, &state.pose, i, &problem.catenary(i, *force));
            closure = f64::max(closure, Vector2::from(cable.misclosure()).norm());
            let linearized = cable.linearized();
            if let Some(linearized) = &linearized {
                unbalanced -= Vector6::from(cable.wrench());
                let stiffness = linearized.stiffness().into();
                let forces = [&cable.force_on_platform(), &linearized.predicted()];
                balance.add_predicted(&cable.anchor_arm, forces, &stiffness);
            }
            cables.push((cable.anchor_arm, linearized));
        }
        let unbalanced = freedoms.of_vector(&unbalanced);
        let [force, moment] = [0, 3].map(|row| unbalanced.fixed_rows::<3>(row).norm());
        Self {
            gradient: balance.free_gradient(freedoms),
            hessian: balance.hessian(freedoms),
            symmetric_hessian: balance.symmetric_hessian(freedoms),
            cables,
            residual: Residual { closure, force, moment },
        }
    }

    /// The motion (dp, dφ) that balances the linearized platform. `None` if its stiffness is singular.
    fn step(&self) -> Option<Vector6<f64>> {
        Some(-self.hessian.lu().solve(&self.gradient)?)
    }

    /// The motion that balances the linearized platform without that along which neither stiffness nor force
    /// is more than rounding; `None` where this is the whole motion.
    fn pinned_step(&self, problem: &DirectProblem, state: &Equilibrium) -> Option<Vector6<f64>> {
        let scale = per_length(problem.characteristic_length());
        let stiffness = self.hessian.component_mul(&(scale * scale.transpose()));
        let gradient = self.gradient.component_mul(&scale);
        if !stiffness.iter().chain(gradient.iter()).all(|entry| entry.is_finite()) {
            return None;
        }
        let svd = stiffness.svd(true, true);
        let (left, right) = (svd.u?, svd.v_t?);
        let greatest = svd.singular_values.max();
        if greatest == 0.0 {
            return None;
        }
        let rounding = ROUNDED_FORCE * forces(problem, state);
        // Far from the equilibrium the slope hides a resistance below this.
        let hidden = gradient.norm() / problem.size();
        let mut step = Vector6::zeros();
        for (k, stiffness) in svd.singular_values.iter().enumerate() {
            let force = left.column(k).dot(&gradient);
            let neutral = *stiffness <= NEARLY_ZERO * greatest && force.abs() <= rounding;
            if !neutral && *stiffness > hidden {
                step -= right.row(k).transpose() * (force / stiffness);
            }
        }
        Some(problem.robot.freedoms().of_vector(&step.component_mul(&scale)))
    }
}

/// Newton's method from `start`, in the lanes where it converges there. `None` if it does not converge.
pub(crate) fn newton(problem: &DirectProblem, mut start: Equilibrium) -> Option<Converged> {
    let robot = problem.robot;
    if let Some(Solved { iterations, residual, first_step, stiffness }) = solve(problem, &mut start) {
        let stability = Stability::new(problem, &start, &stiffness);
        return Some(Converged { equilibrium: start, iterations, residual, stability, first_step });
    }
    if robot.freedoms().are_all() && robot.is_fully_actuated() {
        return iterate(problem, start, MAX_ITERATIONS, |linearized, _| linearized.step());
    }
    pinned_newton(problem, start)
}

/// Newton's method for a robot with motions that nothing resists, or that are constrained.
pub(crate) fn pinned_newton(problem: &DirectProblem, start: Equilibrium) -> Option<Converged> {
    iterate(problem, start, 2 * MAX_ITERATIONS, |linearized, now| linearized.pinned_step(problem, now))
}

#[inline(always)]
fn iterate(
    problem: &DirectProblem,
    start: Equilibrium,
    most: usize,
    step: impl Fn(&Linearized, &Equilibrium) -> Option<Vector6<f64>>,
) -> Option<Converged> {
    let (size, arm) = (problem.size(), problem.characteristic_length());
    let mut now = start;
    let mut first_step = None;
    let mut last = false;
    for iteration in 0..=most {
        tighten(problem, &mut now)?;
        let linearized = Linearized::new(problem, &now);
        if last && linearized.residual.is_rounding(problem, &now) {
            let stability = Stability::new(problem, &now, &linearized.symmetric_hessian);
            return Some(Converged {
                equilibrium: now,
                iterations: iteration,
                residual: linearized.residual,
                stability,
                first_step: first_step.unwrap_or_else(Vector6::zeros),
            });
        }
        let step = step(&linearized, &now)?;
        let (dp, dphi): (Vector3<f64>, Vector3<f64>) =
            (step.fixed_rows::<3>(0).into(), step.fixed_rows::<3>(3).into());
        let moved = dp.norm() + arm * dphi.norm();
        // The linearization is invalid farther away. The comparison is false for NaN, too.
        if !(moved < 0.3 * size && dphi.norm() < 0.7) {
            return None;
        }
        let pose = now.pose.moved(dp, dphi);
        for (i, (force, (arm, cable))) in now.cable_forces.iter_mut().zip(&linearized.cables).enumerate() {
            let Some(cable) = cable else { continue };
            *force = cable.force_after((dp + dphi.cross(&Vector3::from(*arm))).into()).into();
            if force.x < 0.0 {
                // The cable passed the vertical: in its new plane the same force points forwards.
                let in_space = cable.plane.lift((*force).into());
                [force.x, _] = problem.span(&pose, i).plane.project(in_space);
                if force.x < -1e-12 * force.y.abs() {
                    return None;
                }
                force.x = force.x.max(0.0);
            }
        }
        now.pose = pose;
        first_step
            .get_or_insert_with(|| Vector6::new(dp.x, dp.y, dp.z, arm * dphi.x, arm * dphi.y, arm * dphi.z));
        last = moved <= LAST_STEP * size;
    }
    None
}

/// Gives slack cables without weight whose points have come too far apart the force that strains them.
fn tighten(problem: &DirectProblem, state: &mut Equilibrium) -> Option<()> {
    for (i, force) in state.cable_forces.iter_mut().enumerate() {
        if *force == Vector2::zeros() && problem.catenary(i, *force).is_slack_and_weightless() {
            *force = problem.force_at(&state.pose, i, None).ok()?;
        }
    }
    Some(())
}

impl DirectProblem<'_> {
    /// The first step (dp, dφ) [m, rad] of Newton's method with the cables eliminated, for comparison with
    /// that of the assembled equations; `None` where the stiffness is singular.
    #[doc(hidden)]
    pub fn newton_step(&self, from: &Equilibrium) -> Option<Vector6<f64>> {
        Linearized::new(self, from).step()
    }
}
