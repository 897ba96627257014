//! The balance of the platform and its stiffness, cable by cable.
//!
//! The left-hand side of the paper's Eq. (3) is the unbalanced wrench on the platform, with w_ex for weight
//! and load; its opposite is the gradient of the potential:
//!
//! ```text
//! G = W t + w_ex = sum [F_i; s_i x F_i] + w_ex                                                     (S4)
//! ```
//!
//! The derivative of -G with respect to (dp, dφ) is the stiffness, with F_w the weight at its lever R c,
//!
//! ```text
//! H_pp = sum K3_i                    H_pr = -sum K3_i [s_i]
//! H_rp = sum [s_i] K3_i              H_rr = -sum( [s_i] K3_i [s_i] + [F_i][s_i] ) - [F_w][R c]      (S5)
//! ```

use crate::equations::vector::wrench;
use crate::problem::DirectProblem;
use cdpr_robot::{Matrix3, Pose, Vector3, Vector6};
use nalgebra::Matrix6;

/// Platform wrench and stiffness at a pose, from the cables' forces and stiffnesses.
pub(crate) struct Balance {
    /// -G [N, N m], equation (S4): the gradient of the potential.
    pub(crate) gradient: Vector6<f64>,
    /// H, equation (S5); symmetric where the gradient vanishes.
    pub(crate) hessian: Matrix6<f64>,
}

impl Balance {
    /// Weight and load alone.
    pub(crate) fn of_load(problem: &DirectProblem, pose: &Pose) -> Self {
        let total = problem.load.total(problem.robot, pose);
        let weight = problem.robot.weight(pose, problem.load.payload).force;
        let center = pose.rotation * problem.robot.platform.center_of_mass;
        let mut hessian = Matrix6::zeros();
        hessian.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-weight.cross_matrix() * center.cross_matrix()));
        Self { gradient: -total.to_vector(), hessian }
    }

    /// Adds a cable with the force F [N] on the platform and the stiffness K3 [N/m] at the arm s [m] from P.
    #[inline(always)]
    pub(crate) fn add_cable(&mut self, s: &[f64; 3], force: &[f64; 3], stiffness: [[f64; 3]; 3]) {
        // Eq. (3) with the opposite sign: -w_i t_i.
        self.gradient -= Vector6::from(wrench(s, force));
        let (arm, stiffness) = (Vector3::from(*s).cross_matrix(), Matrix3::from(stiffness));
        let ks = stiffness * arm;
        let mut pp = self.hessian.fixed_view_mut::<3, 3>(0, 0);
        pp += stiffness;
        let mut pr = self.hessian.fixed_view_mut::<3, 3>(0, 3);
        pr -= ks;
        let mut rp = self.hessian.fixed_view_mut::<3, 3>(3, 0);
        rp -= ks.transpose();
        let mut rr = self.hessian.fixed_view_mut::<3, 3>(3, 3);
        rr -= Vector3::from(*force).cross_matrix() * arm + arm * ks;
    }

    /// The Hessian of the potential: symmetric, in the increment `R <- exp(dφ) R`.
    pub(crate) fn symmetric_hessian(&self) -> Matrix6<f64> {
        0.5 * (self.hessian + self.hessian.transpose())
    }
}
