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

use crate::direct::Residual;
use crate::equations::cross;
use crate::model::{Equilibrium, Model, Span};
use cdpr_robot::{Pose, Vector2, Vector3, Vector6};
use nalgebra::{Matrix2, Matrix3, Matrix6};

/// What the iteration ended with.
pub(crate) struct Converged {
    pub(crate) equilibrium: Equilibrium,
    pub(crate) iterations: usize,
    pub(crate) residual: Residual,
}

const MAX_ITERATIONS: usize = 15;

/// A step below this, relative to the robot's size, is followed by one below rounding: Newton's method squares it.
const LAST_STEP: f64 = 1e-7;

/// Platform wrench and stiffness at a pose, from the cables' forces and stiffnesses.
pub(crate) struct Balance {
    /// Gradient of the potential: minus the open wrench on the platform [N, N m].
    pub(crate) gradient: Vector6<f64>,
    /// Its derivative with respect to (dp, dφ); symmetric where the gradient vanishes.
    pub(crate) hessian: Matrix6<f64>,
}

impl Balance {
    /// Weight and load alone.
    pub(crate) fn of_load(model: &Model, pose: &Pose) -> Self {
        let total = model.load.total(model.robot, pose);
        let weight = model.robot.weight(pose, model.load.payload).force;
        let center = pose.rotation * model.robot.platform.center_of_mass;
        let mut hessian = Matrix6::zeros();
        hessian.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-cross(&weight) * cross(&center)));
        Self { gradient: -total.to_vector(), hessian }
    }

    /// Adds a cable with end force `force` [N] and stiffness `stiffness` [N/m] at the arm `s` [m] from P.
    pub(crate) fn add_cable(&mut self, s: &Vector3<f64>, force: &Vector3<f64>, stiffness: &Matrix3<f64>) {
        let arm = cross(s);
        let ks = stiffness * arm;
        let moment = s.cross(force);
        let mut g_p = self.gradient.fixed_rows_mut::<3>(0);
        g_p += force;
        let mut g_r = self.gradient.fixed_rows_mut::<3>(3);
        g_r += moment;
        let mut pp = self.hessian.fixed_view_mut::<3, 3>(0, 0);
        pp += stiffness;
        let mut pr = self.hessian.fixed_view_mut::<3, 3>(0, 3);
        pr -= ks;
        let mut rp = self.hessian.fixed_view_mut::<3, 3>(3, 0);
        rp -= ks.transpose();
        let mut rr = self.hessian.fixed_view_mut::<3, 3>(3, 3);
        rr += cross(force) * arm - arm * ks;
    }

    /// The Hessian of the potential: symmetric, in the increment `R <- exp(dφ) R`.
    pub(crate) fn symmetric_hessian(&self) -> Matrix6<f64> {
        0.5 * (self.hessian + self.hessian.transpose())
    }
}

/// The linearised model at a state: the platform's balance with predicted forces, and what each cable adds to its prediction.
struct Linearised {
    balance: Balance,
    /// Span, predicted force `f_i + K_i c_i` and in-plane stiffness K_i of every cable.
    cables: Vec<(Span, Vector2<f64>, Matrix2<f64>)>,
}

impl Linearised {
    fn new(model: &Model, state: &Equilibrium) -> Self {
        let mut balance = Balance::of_load(model, &state.pose);
        let mut cables = Vec::with_capacity(model.cables());
        for (i, force) in state.cable_forces.iter().enumerate() {
            let span = model.span(&state.pose, i);
            let catenary = model.catenary(i, *force);
            if catenary.is_limp() {
                cables.push((span, Vector2::zeros(), Matrix2::zeros()));
                continue;
            }
            let compliance = catenary.compliance();
            let in_plane = compliance.in_plane_stiffness();
            let predicted = force + in_plane * (span.end - compliance.end);
            let s = model.robot.anchor_arm(&state.pose, i);
            balance.add_cable(&s, &span.lift(predicted), &compliance.stiffness(span.azimuth));
            cables.push((span, predicted, in_plane));
        }
        Self { balance, cables }
    }

    /// The motion (dp, dφ) that balances the linearised platform. `None` if its stiffness is singular.
    fn step(&self) -> Option<Vector6<f64>> {
        Some(-self.balance.hessian.lu().solve(&self.balance.gradient)?)
    }
}

/// Newton's method from `start`. `None` if it does not converge, or not to a stable equilibrium.
pub(crate) fn newton(model: &Model, start: Equilibrium) -> Option<Converged> {
    let (size, arm) = (model.size(), model.arm());
    let mut now = start;
    for iteration in 1..=MAX_ITERATIONS {
        let linearised = Linearised::new(model, &now);
        let step = linearised.step()?;
        let (dp, dphi): (Vector3<f64>, Vector3<f64>) =
            (step.fixed_rows::<3>(0).into(), step.fixed_rows::<3>(3).into());
        let moved = dp.norm() + arm * dphi.norm();
        // Farther than this the linearisation means nothing (a comparison that NaN fails, too).
        if !(moved < 0.3 * size && dphi.norm() < 0.7) {
            return None;
        }
        for (i, (span, predicted, in_plane)) in linearised.cables.iter().enumerate() {
            let s = model.robot.anchor_arm(&now.pose, i);
            let force = predicted + in_plane * span.project(&(dp + dphi.cross(&s)));
            if force.x < 0.0 {
                return None;
            }
            now.cable_forces[i] = force;
        }
        now.pose = now.pose.moved(dp, dphi);
        if moved <= LAST_STEP * size {
            let residual = Residual::of(model, &now);
            if residual.is_rounding(model, &now) {
                linearised.balance.symmetric_hessian().cholesky()?;
                return Some(Converged { equilibrium: now, iterations: iteration, residual });
            }
        }
    }
    None
}

/// One step (dp, dφ) from a state, for comparison with the assembled equations.
#[cfg(test)]
pub(crate) fn newton_step(model: &Model, state: &Equilibrium) -> Option<Vector6<f64>> {
    Linearised::new(model, state).step()
}
