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
//!
//! Its skew part is half of the cross-product matrix of the moment of cables and weight.

use crate::problem::DirectProblem;
use cdpr_number::Number;
use cdpr_number::vector::{cross, wrench};
use cdpr_robot::{Freedoms, Pose, Vector3, Vector6};
use nalgebra::Matrix6;

/// Platform wrench and stiffness at a pose, from the cables' forces and stiffnesses.
pub(crate) struct Balance {
    /// -G [N, N m], equation (S4): the gradient of the potential.
    pub(crate) gradient: Vector6<f64>,
    /// Upper triangle of the symmetric part of H, by rows.
    upper: [[f64; 6]; 6],
    /// Moment of cables and weight [N m]: of the forces that turn with the platform's points.
    moment: Vector3<f64>,
}

impl Balance {
    /// No force and no stiffness.
    pub(crate) fn nothing() -> Self {
        Self { gradient: Vector6::zeros(), upper: [[0.0; 6]; 6], moment: Vector3::zeros() }
    }

    /// Weight and load alone.
    pub(crate) fn of_load(problem: &DirectProblem, pose: &Pose) -> Self {
        let total = problem.load.total(problem.robot, pose);
        let weight = problem.robot.weight(pose, problem.load.payload).force;
        let center = pose.rotation * problem.robot.platform.center_of_mass;
        let moment = center.cross(&weight);
        let mut balance = Self { gradient: -total.to_vector(), moment, ..Self::nothing() };
        add_stiffness(&mut balance.upper, &center.into(), &(-weight).into(), &[[0.0; 3]; 3]);
        balance
    }

    /// Adds a cable with the force F [N] on the platform and the stiffness K3 [N/m] at the arm s [m] from P.
    #[inline(always)]
    pub(crate) fn add_cable(&mut self, s: &[f64; 3], force: &[f64; 3], stiffness: &[[f64; 3]; 3]) {
        self.add_predicted(s, [force, force], stiffness);
    }

    /// Adds a cable whose force is predicted to become another one, by both.
    #[inline(always)]
    pub(crate) fn add_predicted(
        &mut self,
        s: &[f64; 3],
        [force, predicted]: [&[f64; 3]; 2],
        stiffness: &[[f64; 3]; 3],
    ) {
        // Eq. (3) with the opposite sign: -w_i t_i.
        self.gradient -= Vector6::from(wrench(s, predicted));
        self.moment += Vector3::from(cross(s, force));
        add_stiffness(&mut self.upper, s, &force.map(|component| -component), stiffness);
    }

    /// H, equation (S5), along the motions that are free; symmetric where the gradient vanishes without an
    /// external moment.
    pub(crate) fn hessian(&self, freedoms: Freedoms) -> Matrix6<f64> {
        let mut hessian = self.symmetric_hessian(freedoms);
        let mut rotations = hessian.fixed_view_mut::<3, 3>(3, 3);
        rotations += 0.5 * self.moment.cross_matrix();
        if freedoms.are_all() { hessian } else { freedoms.of_matrix(&hessian) }
    }

    /// The Hessian of the potential: symmetric, in the increment `R <- exp(dφ) R`.
    pub(crate) fn symmetric_hessian(&self, freedoms: Freedoms) -> Matrix6<f64> {
        let hessian = Matrix6::from_fn(|i, j| self.upper[i.min(j)][i.max(j)]);
        if freedoms.are_all() { hessian } else { freedoms.of_matrix(&hessian) }
    }

    /// The gradient along the motions that are free.
    pub(crate) fn free_gradient(&self, freedoms: Freedoms) -> Vector6<f64> {
        if freedoms.are_all() { self.gradient } else { freedoms.of_vector(&self.gradient) }
    }
}

pub(crate) fn symmetric_part(matrix: &Matrix6<f64>) -> Matrix6<f64> {
    0.5 * (matrix + matrix.transpose())
}

/// Adds a cable with the stiffness K3 = `k` and the force -F_i = `f` at the arm s to the upper triangle of
/// the symmetric part of the stiffness, equation (S5).
#[inline(always)]
pub(crate) fn add_stiffness<T: Number>(upper: &mut [[T; 6]; 6], s: &[T; 3], f: &[T; 3], k: &[[T; 3]; 3]) {
    let [sx, sy, sz] = *s;
    // K [s], row by row: k x s.
    let ks = [cross(&k[0], s), cross(&k[1], s), cross(&k[2], s)];
    for row in 0..3 {
        for column in 0..3 {
            upper[row][3 + column] = upper[row][3 + column] - ks[row][column];
        }
        for column in row..3 {
            upper[row][column] = upper[row][column] + k[row][column];
            // [s] K [s], column by column: s x K [s].
            let swung = match row {
                0 => sy * ks[2][column] - sz * ks[1][column],
                1 => sz * ks[0][column] - sx * ks[2][column],
                _ => sx * ks[1][column] - sy * ks[0][column],
            };
            upper[3 + row][3 + column] = upper[3 + row][3 + column] - swung;
        }
    }
    // The symmetric part of s fᵀ - (s·f) 1.
    let (x, y, z) = (sx * f[0], sy * f[1], sz * f[2]);
    upper[3][3] = upper[3][3] - (y + z);
    upper[4][4] = upper[4][4] - (x + z);
    upper[5][5] = upper[5][5] - (x + y);
    let half = [sx * 0.5, sy * 0.5, sz * 0.5];
    upper[3][4] = upper[3][4] + (half[0] * f[1] + half[1] * f[0]);
    upper[3][5] = upper[3][5] + (half[0] * f[2] + half[2] * f[0]);
    upper[4][5] = upper[4][5] + (half[1] * f[2] + half[2] * f[1]);
}
