//! Newton's method on the `6 + 2n` equations, with the cables eliminated.
//!
//! Linearised at forces f_i that need not yet fit the pose, cable i gives
//!
//! ```text
//! df_i = K_i (c_i + d(h_i, z_i)),      c_i = (h_i, z_i) - (x, z)(f_i, L_i),      K_i = C_i⁻¹
//! ```
//!
//! Put into the balance of the platform this leaves six equations for (dp, dφ) whose matrix is the stiffness of the
//! platform with every f_i replaced by its prediction `f_i + K_i c_i`:
//!
//! ```text
//! H_pp = sum K3_i                    H_pr = -sum K3_i [s_i]
//! H_rp = sum [s_i] K3_i              H_rr = sum( -[s_i] K3_i [s_i] + [F_i][s_i] ) - [F_w][R c]
//! ```
//!
//! K3 is the cable's stiffness in space. One evaluation of each catenary and one 6 x 6 solve an iteration.

use crate::direct::stability::Stability;
use crate::equations::{Balance, Span};
use crate::model::Model;
use crate::state::{Equilibrium, Residual};
use cdpr_cable::end_force;
use cdpr_robot::{Vector2, Vector3, Vector6};
use nalgebra::Matrix2;

/// What the iteration ended with: an equilibrium, stable or not.
pub(crate) struct Converged {
    pub(crate) equilibrium: Equilibrium,
    pub(crate) iterations: usize,
    pub(crate) residual: Residual,
    pub(crate) stability: Stability,
    /// The first step (dp, ρ dφ): what the linearisation at the start predicts [m].
    pub(crate) first_step: Vector6<f64>,
}

const MAX_ITERATIONS: usize = 15;

/// A step below this, relative to the robot's size, is followed by one below rounding: Newton's method squares it.
const LAST_STEP: f64 = 1e-7;

/// A cable in the linearised model.
struct Linear {
    span: Span,
    /// s_i = R a_i [m].
    arm: Vector3<f64>,
    /// Predicted force `f_i + K_i c_i` [N].
    predicted: Vector2<f64>,
    /// K_i [N/m].
    in_plane: Matrix2<f64>,
}

/// The linearised model at a state: the platform's balance with predicted forces, what each cable adds to its prediction, and
/// what the state itself leaves open.
struct Linearised {
    balance: Balance,
    cables: Vec<Linear>,
    residual: Residual,
}

impl Linearised {
    fn new(model: &Model, state: &Equilibrium) -> Self {
        let mut balance = Balance::of_load(model, &state.pose);
        let mut open = balance.gradient;
        let mut closure: f64 = 0.0;
        let mut cables = Vec::with_capacity(model.cables());
        for (i, force) in state.cable_forces.iter().enumerate() {
            let arm = model.robot.anchor_arm(&state.pose, i);
            let span = model.span_at(&state.pose, i, &arm);
            let catenary = model.catenary(i, *force);
            if catenary.is_limp() {
                closure = closure.max(span.end.norm() - model.lengths[i]);
                cables.push(Linear { span, arm, predicted: Vector2::zeros(), in_plane: Matrix2::zeros() });
                continue;
            }
            let compliance = catenary.compliance();
            let in_plane = compliance.in_plane_stiffness();
            let miss = span.end - compliance.end;
            closure = closure.max(miss.norm());
            let actual = span.lift(*force);
            let moment = arm.cross(&actual);
            open += Vector6::new(actual.x, actual.y, actual.z, moment.x, moment.y, moment.z);
            let predicted = force + in_plane * miss;
            balance.add_cable(&arm, &span.lift(predicted), &compliance.stiffness(span.azimuth));
            cables.push(Linear { span, arm, predicted, in_plane });
        }
        let (force, moment) = (open.fixed_rows::<3>(0).norm(), open.fixed_rows::<3>(3).norm());
        Self { balance, cables, residual: Residual { closure, force, moment } }
    }

    /// The motion (dp, dφ) that balances the linearised platform. `None` if its stiffness is singular.
    fn step(&self) -> Option<Vector6<f64>> {
        Some(-self.balance.hessian.lu().solve(&self.balance.gradient)?)
    }
}

/// Newton's method from `start`. `None` if it does not converge.
pub(crate) fn newton(model: &Model, start: Equilibrium) -> Option<Converged> {
    let (size, arm) = (model.size(), model.arm());
    let mut now = start;
    let mut first_step = None;
    let mut last = false;
    for iteration in 0..=MAX_ITERATIONS {
        tighten(model, &mut now)?;
        let linearised = Linearised::new(model, &now);
        if last && linearised.residual.is_rounding(model, &now) {
            return Some(Converged {
                equilibrium: now,
                iterations: iteration,
                residual: linearised.residual,
                stability: Stability::new(&linearised.balance.symmetric_hessian(), arm),
                first_step: first_step.unwrap_or_else(Vector6::zeros),
            });
        }
        let step = linearised.step()?;
        let (dp, dphi): (Vector3<f64>, Vector3<f64>) =
            (step.fixed_rows::<3>(0).into(), step.fixed_rows::<3>(3).into());
        let moved = dp.norm() + arm * dphi.norm();
        // Farther than this the linearisation means nothing (a comparison that NaN fails, too).
        if !(moved < 0.3 * size && dphi.norm() < 0.7) {
            return None;
        }
        let pose = now.pose.moved(dp, dphi);
        for (i, (force, cable)) in now.cable_forces.iter_mut().zip(&linearised.cables).enumerate() {
            *force = cable.predicted + cable.in_plane * cable.span.project(&(dp + dphi.cross(&cable.arm)));
            if force.x < 0.0 {
                // The cable passed the vertical: in its new plane the same force points forwards.
                let pull = cable.span.lift(*force);
                force.x = model.span(&pose, i).project(&pull).x;
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

/// Gives slack cables without weight whose points have come too far apart the force of their stretch.
fn tighten(model: &Model, state: &mut Equilibrium) -> Option<()> {
    for (i, force) in state.cable_forces.iter_mut().enumerate() {
        if model.catenary(i, *force).is_limp() {
            let end = model.span(&state.pose, i).end;
            *force = end_force(&model.cable(i), model.lengths[i], end).ok()?.catenary.force;
        }
    }
    Some(())
}

/// One step (dp, dφ) from a state, for comparison with the assembled equations.
#[cfg(test)]
pub(crate) fn newton_step(model: &Model, state: &Equilibrium) -> Option<Vector6<f64>> {
    Linearised::new(model, state).step()
}
