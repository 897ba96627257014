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

use crate::problem::DirectProblem;
use cdpr_number::Number;
use cdpr_number::vector::{cross, wrench};
use cdpr_robot::{Matrix3, Pose, Vector6};
use nalgebra::{ClosedAddAssign, Matrix6, Scalar};

/// Platform wrench and stiffness at a pose, from the cables' forces and stiffnesses.
pub(crate) struct Balance {
    /// -G [N, N m], equation (S4): the gradient of the potential.
    pub(crate) gradient: Vector6<f64>,
    /// H, equation (S5); symmetric where the gradient vanishes without an external moment.
    pub(crate) hessian: Matrix6<f64>,
}

impl Balance {
    /// No force and no stiffness.
    pub(crate) fn nothing() -> Self {
        Self { gradient: Vector6::zeros(), hessian: Matrix6::zeros() }
    }

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
        add_stiffness(&mut self.hessian, s, force, stiffness);
    }

    /// The Hessian of the potential: symmetric, in the increment `R <- exp(dφ) R`.
    pub(crate) fn symmetric_hessian(&self) -> Matrix6<f64> {
        symmetric_part(&self.hessian)
    }
}

pub(crate) fn symmetric_part(matrix: &Matrix6<f64>) -> Matrix6<f64> {
    0.5 * (matrix + matrix.transpose())
}

/// Adds a cable with the stiffness K3 and the force F on the platform at the arm s, equation (S5).
#[inline(always)]
pub(crate) fn add_stiffness<T: Number + Scalar + ClosedAddAssign>(
    hessian: &mut Matrix6<T>,
    s: &[T; 3],
    force: &[T; 3],
    stiffness: [[T; 3]; 3],
) {
    let mut add = |row: usize, column: usize, block: Matrix3<T>| {
        let mut view = hessian.fixed_view_mut::<3, 3>(row, column);
        view += block;
    };
    let turned = |matrix: Matrix3<T>| Matrix3::from(matrix.data.0.map(|column| cross(s, &column)));
    let sk = turned(stiffness.into());
    add(0, 0, stiffness.into());
    add(0, 3, sk.transpose());
    add(3, 0, sk);
    // [s] K3 [s] = -[s] ([s] K3)ᵀ and [F][s] = s Fᵀ - (s·F) 1.
    add(3, 3, turned(sk.transpose()));
    let ([sx, sy, sz], [fx, fy, fz]) = (*s, *force);
    let (x, y, z) = (sx * fx, sy * fy, sz * fz);
    add(3, 3, Matrix3::new(y + z, -sx * fy, -sx * fz, -sy * fx, x + z, -sy * fz, -sz * fx, -sz * fy, x + y));
}
