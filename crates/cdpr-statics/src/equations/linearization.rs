//! Small displacements about an equilibrium.
//!
//! The assembled equations `g(x, θ) = 0` give `dx = -(dg/dx)⁻¹ (dg/dθ) dθ`: one factorisation answers for
//! wrenches, lengths and whatever else moves the platform. Section 3.3 of the paper says why such a
//! displacement is not the static deflection of a robot with sagging cables; both are here to be compared.

use crate::equations::assembled::{FactoredJacobian, State, closure_row, jacobian};
use crate::equations::balance::{Balance, symmetric_part};
use crate::equations::motions::Pins;
use crate::equations::spanned::SpannedCable;
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_robot::{Matrix3, Matrix6xX, Vector2, Vector3, Vector6, Wrench};
use nalgebra::{DMatrix, Matrix6};

/// The direct problem linearised at an equilibrium.
pub struct Linearization {
    factored: FactoredJacobian,
    stiffness: Matrix6<f64>,
    pins: Pins,
    /// d(x, z)/dL of every cable at constant force [m/m].
    end_per_length: Vec<Vector2<f64>>,
}

impl DirectProblem<'_> {
    /// The problem linearised at an equilibrium of its own.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless the equilibrium is finite and has one force for each cable.
    pub fn linearize(&self, equilibrium: &Equilibrium) -> Result<Linearization, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        let mut balance = Balance::of_load(self, &equilibrium.pose);
        let mut end_per_length = Vec::with_capacity(self.cables());
        for (i, force) in equilibrium.cable_forces.iter().enumerate() {
            let catenary = self.catenary(i, *force);
            let cable = SpannedCable::of(self.robot, &equilibrium.pose, i, &catenary);
            if let Some(linearized) = cable.linearized() {
                let stiffness = linearized.stiffness_in_space();
                balance.add_cable(&cable.anchor_arm, &cable.force_on_platform(), stiffness);
            }
            if let Some(skew) = cable.skew_stiffness(&catenary) {
                // dr_i = dp - [s_i] dφ
                let arm = Vector3::from(cable.anchor_arm).cross_matrix();
                for (row, left) in [(0, Matrix3::identity()), (3, arm)] {
                    for (column, right) in [(0, Matrix3::identity()), (3, -arm)] {
                        let mut block = balance.hessian.fixed_view_mut::<3, 3>(row, column);
                        block += left * skew * right;
                    }
                }
            }
            // Paying out a slack cable without weight moves nothing.
            end_per_length.push(cable.response.map_or([0.0; 2], |response| response.end_per_length).into());
        }
        balance.hold(self.robot.freedoms());
        let pins = Pins::new(self, equilibrium, &balance.symmetric_hessian());
        let mut jacobian = jacobian(self, &State::from(equilibrium));
        if !pins.are_none() {
            let size = jacobian.nrows();
            for k in (0..6).filter(|k| !self.robot.freedoms().contains(*k)) {
                jacobian.view_mut((k, 6), (1, size - 6)).fill(0.0);
                jacobian.view_mut((6, k), (size - 6, 1)).fill(0.0);
            }
            let platform = pins.pinned(&jacobian.fixed_view::<6, 6>(0, 0).into_owned(), 1.0);
            jacobian.fixed_view_mut::<6, 6>(0, 0).copy_from(&platform);
        }
        Ok(Linearization {
            factored: FactoredJacobian::new(&jacobian),
            stiffness: balance.hessian,
            pins,
            end_per_length,
        })
    }
}

impl Linearization {
    /// Cartesian stiffness matrix H, 6 x 6, of (dp, dφ) in the base frame about P [N/m, N/rad, N, N m/rad].
    ///
    /// It is the true tangent `-dG/d(p, φ)` of the balance, with sag and weight of the cables and rotations
    /// `R <- exp(dφ) R`: a small additional wrench is H times the displacement. It is symmetric to rounding
    /// unless a moment M acts, or cables with weight run over pulleys. A moment of constant components has no
    /// potential, and the lower right block of H has the skew part `-[M]/2`. Rows and columns of held motions
    /// are zero.
    pub fn stiffness(&self) -> &Matrix6<f64> {
        &self.stiffness
    }

    /// Symmetric part of [`Linearization::stiffness`]: positive definite where the equilibrium is stable.
    ///
    /// Without moment and pulleys it is the Hessian of the potential.
    pub fn symmetric_stiffness(&self) -> Matrix6<f64> {
        symmetric_part(&self.stiffness)
    }

    /// Displacement (dp, dφ) [m, rad] under a small additional wrench. What holds a motion takes its part of
    /// the wrench, and a motion that nothing resists is left out.
    pub fn displacement(&self, wrench: &Wrench) -> Vector6<f64> {
        let mut right = DMatrix::zeros(6 + 2 * self.end_per_length.len(), 1);
        right.fixed_view_mut::<6, 1>(0, 0).copy_from(&self.pins.rest(&wrench.to_vector()));
        self.factored.solve(&right).fixed_view::<6, 1>(0, 0).into()
    }

    /// d(p, φ)/dL: displacement of the platform per unstrained length of each cable, 6 x n [m/m, rad/m].
    pub fn pose_per_length(&self) -> Matrix6xX<f64> {
        let n = self.end_per_length.len();
        let mut right = DMatrix::zeros(6 + 2 * n, n);
        for (i, end) in self.end_per_length.iter().enumerate() {
            right.fixed_view_mut::<2, 1>(closure_row(i), i).copy_from(end);
        }
        let solution = self.factored.solve(&right);
        Matrix6xX::from_fn(n, |row, column| solution[(row, column)])
    }
}
