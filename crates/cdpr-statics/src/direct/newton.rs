//! Newton's method on the `6 + 2n` equations, with the cables eliminated.
//!
//! Linearised at forces f_i that need not yet fit the pose, cable i gives `df_i = K_i (c_i + d(h_i, z_i))`,
//! (S2) of `equations/cable.rs`.
//!
//! Put into the balance of the platform this leaves six equations for (dp, dφ), whose matrix is the stiffness
//! (S5) of the platform with every f_i replaced by its prediction `f_i + K_i c_i`. An iteration evaluates
//! each catenary once and solves one 6 x 6 system.
//!
//! Fewer cables than free motions may leave motions that nothing resists, and held motions have no equation.
//! Such a robot takes steps by the singular values of the matrix: motions without resistance and force are
//! left out, so that they stay where they started.

use crate::direct::stability::Stability;
use crate::equations::{
    Balance, LinearizedCable, SpannedCable, SpannedStiffness, Turned, forces, per_length,
};
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Residual};
use cdpr_robot::{Vector2, Vector3, Vector6};

/// An equilibrium to which the iteration converged, stable or not.
pub(crate) struct Converged {
    pub(crate) equilibrium: Equilibrium,
    pub(crate) iterations: usize,
    pub(crate) residual: Residual,
    pub(crate) stability: Stability,
    /// The first step (dp, ℓ dφ), which the linearisation at the start predicts [m].
    pub(crate) first_step: Vector6<f64>,
}

const MAX_ITERATIONS: usize = 15;

/// A step below this, relative to the robot's size, is followed by one below rounding, because Newton's
/// method squares it.
const LAST_STEP: f64 = 1e-7;

/// Resistance below this share of the greatest one, and force below this share of all forces, are rounding.
const NEARLY_ZERO: f64 = 1e-10;
const ROUNDED_FORCE: f64 = 1e-13;

/// The linearised model at a state: the platform's balance with predicted forces, the cables, and the
/// residual of the state itself.
struct Linearised<'a> {
    balance: Balance,
    /// s_i [m] and the linearised cable in the plane of its span; one that resists nothing is slack.
    cables: Vec<([f64; 3], LinearizedCable<f64>)>,
    /// Those of a tilted base or over tilted axes, which take the place of the others.
    turned: Vec<Option<Box<Turned<'a>>>>,
    residual: Residual,
}

impl<'a> Linearised<'a> {
    fn new(problem: &DirectProblem<'a>, state: &Equilibrium) -> Self {
        let balance = Balance::of_load(problem, &state.pose);
        let mut unbalanced = balance.gradient;
        let cables = Vec::with_capacity(problem.cables());
        let residual = Residual { closure: 0.0, force: 0.0, moment: 0.0 };
        let mut linearised = Self { balance, cables, turned: Vec::new(), residual };
        for (i, force) in state.cable_forces.iter().enumerate() {
            let (robot, catenary) = (problem.robot, problem.catenary(i, *force));
            // The compiler writes the usual cable out without the questions that the others ask.
            match SpannedCable::plain(robot, &state.pose, i, &catenary) {
                Some(cable) => linearised.add(&cable, &mut unbalanced),
                None => {
                    let cable = SpannedCable::of(robot, &state.pose, i, &catenary);
                    linearised.add_other(&cable, &mut unbalanced);
                }
            }
        }
        let freedoms = problem.robot.freedoms();
        if !freedoms.are_all() {
            linearised.balance.hold(freedoms);
            unbalanced = freedoms.of_vector(&unbalanced);
        }
        linearised.residual.force = unbalanced.fixed_rows::<3>(0).norm();
        linearised.residual.moment = unbalanced.fixed_rows::<3>(3).norm();
        linearised
    }

    /// Adds the next cable; `unbalanced` is the wrench at the state itself, against its sign.
    #[inline(always)]
    fn add(&mut self, cable: &SpannedCable<'a, f64>, unbalanced: &mut Vector6<f64>) {
        self.residual.closure = self.residual.closure.max(Vector2::from(cable.misclosure()).norm());
        let (plane, arm) = (cable.span.plane, cable.anchor_arm);
        let limp =
            LinearizedCable { plane, predicted: [0.0; 2], stiffness: [0.0; 3], lateral_stiffness: 0.0 };
        let Some(linearized) = cable.linearized() else {
            self.cables.push((arm, limp));
            return;
        };
        *unbalanced -= Vector6::from(cable.wrench());
        self.balance.add_cable(&arm, &linearized.predicted(), linearized.stiffness());
        match linearized {
            SpannedStiffness::Level(linearized) => self.cables.push((arm, linearized)),
            SpannedStiffness::Turned(other) => {
                self.turned.resize_with(self.cables.len(), || None);
                self.turned.push(Some(other));
                self.cables.push((arm, limp));
            }
        }
    }

    #[cold]
    fn add_other(&mut self, cable: &SpannedCable<'a, f64>, unbalanced: &mut Vector6<f64>) {
        self.add(cable, unbalanced);
    }

    /// The motion (dp, dφ) that balances the linearised platform. `None` if its stiffness is singular.
    fn step(&self) -> Option<Vector6<f64>> {
        Some(-self.balance.hessian.lu().solve(&self.balance.gradient)?)
    }

    /// The motion that balances the linearised platform without that along which neither stiffness nor force
    /// is more than rounding; `None` where this is the whole motion.
    fn pinned_step(&self, problem: &DirectProblem, state: &Equilibrium) -> Option<Vector6<f64>> {
        let scale = per_length(problem.characteristic_length());
        let stiffness = self.balance.hessian.component_mul(&(scale * scale.transpose()));
        let gradient = self.balance.gradient.component_mul(&scale);
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

/// Newton's method from `start`. `None` if it does not converge.
pub(crate) fn newton(problem: &DirectProblem, start: Equilibrium) -> Option<Converged> {
    let robot = problem.robot;
    if robot.freedoms().are_all() && robot.is_fully_actuated() {
        return iterate(problem, start, MAX_ITERATIONS, |linearised, _| linearised.step());
    }
    pinned_newton(problem, start)
}

/// Newton's method for a robot with motions that nothing resists, or that are held.
pub(crate) fn pinned_newton(problem: &DirectProblem, start: Equilibrium) -> Option<Converged> {
    iterate(problem, start, 2 * MAX_ITERATIONS, |linearised, now| linearised.pinned_step(problem, now))
}

#[inline(always)]
fn iterate(
    problem: &DirectProblem,
    start: Equilibrium,
    most: usize,
    step: impl Fn(&Linearised, &Equilibrium) -> Option<Vector6<f64>>,
) -> Option<Converged> {
    let (size, arm) = (problem.size(), problem.characteristic_length());
    let mut now = start;
    let mut first_step = None;
    let mut last = false;
    for iteration in 0..=most {
        tighten(problem, &mut now)?;
        let linearised = Linearised::new(problem, &now);
        if last && linearised.residual.is_rounding(problem, &now) {
            let stability = Stability::new(problem, &now, &linearised.balance.symmetric_hessian());
            return Some(Converged {
                equilibrium: now,
                iterations: iteration,
                residual: linearised.residual,
                stability,
                first_step: first_step.unwrap_or_else(Vector6::zeros),
            });
        }
        let step = step(&linearised, &now)?;
        let (dp, dphi): (Vector3<f64>, Vector3<f64>) =
            (step.fixed_rows::<3>(0).into(), step.fixed_rows::<3>(3).into());
        let moved = dp.norm() + arm * dphi.norm();
        // The linearisation is invalid farther away. The comparison is false for NaN, too.
        if !(moved < 0.3 * size && dphi.norm() < 0.7) {
            return None;
        }
        let pose = now.pose.moved(dp, dphi);
        for (i, (force, (arm, cable))) in now.cable_forces.iter_mut().zip(&linearised.cables).enumerate() {
            let displacement = (dp + dphi.cross(&Vector3::from(*arm))).into();
            let turned = linearised.turned.get(i).and_then(Option::as_ref);
            *force = match turned {
                None => cable.force_after(displacement).into(),
                Some(cable) => cable.force_after(displacement).into(),
            };
            if force.x < 0.0 {
                // The cable passed the vertical: in its new plane the same force points forwards.
                let plane = turned.map_or(&cable.plane, |cable| &cable.plane);
                let in_space = plane.lift((*force).into());
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
        if *force == Vector2::zeros() && problem.catenary(i, *force).is_limp() {
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
        Linearised::new(self, from).step()
    }
}
