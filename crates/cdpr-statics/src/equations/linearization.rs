//! Small displacements about an equilibrium.
//!
//! The assembled equations `g(x, θ) = 0` give `dx = -(dg/dx)⁻¹ (dg/dθ) dθ`: one factorisation answers for
//! wrenches, lengths and whatever else moves the platform. Section 3.3 of the paper says why such a
//! displacement is not the static deflection of a robot with sagging cables; both are here to be compared.

use crate::equations::assembled::{FactoredJacobian, State, jacobian};
use crate::equations::balance::Balance;
use crate::equations::spanned::SpannedCable;
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_robot::{Matrix6xX, Vector2, Vector6, Wrench};
use nalgebra::{DMatrix, Matrix6};

/// The direct problem linearised at an equilibrium.
pub struct Linearization {
    factored: FactoredJacobian,
    stiffness: Matrix6<f64>,
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
            let cable = SpannedCable::of(self.robot, &equilibrium.pose, i, &self.catenary(i, *force));
            if let Some(linearized) = cable.linearized() {
                let stiffness = linearized.stiffness_in_space();
                balance.add_cable(&cable.anchor_arm, &cable.force_on_platform(), stiffness);
            }
            // Paying out a slack cable without weight moves nothing.
            end_per_length.push(cable.response.map_or([0.0; 2], |response| response.end_per_length).into());
        }
        Ok(Linearization {
            factored: FactoredJacobian::new(&jacobian(self, &State::from(equilibrium))),
            stiffness: balance.symmetric_hessian(),
            end_per_length,
        })
    }
}

impl Linearization {
    /// Cartesian stiffness matrix H, 6 x 6, of (dp, dφ) in the base frame about P [N/m, N/rad, N, N m/rad].
    ///
    /// It is the Hessian of the potential, with sag and weight of the cables: symmetric, and positive
    /// definite where the equilibrium is stable. A moment M of constant components has no potential. Its
    /// unsymmetric part [M]/2, which depends on how rotations are counted, is missing here and contained in
    /// [`Linearization::displacement`].
    pub fn stiffness(&self) -> &Matrix6<f64> {
        &self.stiffness
    }

    /// Displacement (dp, dφ) [m, rad] under a small additional wrench.
    pub fn displacement(&self, wrench: &Wrench) -> Vector6<f64> {
        let mut right = DMatrix::zeros(6 + 2 * self.end_per_length.len(), 1);
        right.fixed_view_mut::<6, 1>(0, 0).copy_from(&wrench.to_vector());
        self.factored.solve(&right).fixed_view::<6, 1>(0, 0).into()
    }

    /// d(p, φ)/dL: displacement of the platform per unstrained length of each cable, 6 x n [m/m, rad/m].
    pub fn pose_per_length(&self) -> Matrix6xX<f64> {
        let n = self.end_per_length.len();
        let mut right = DMatrix::zeros(6 + 2 * n, n);
        for (i, end) in self.end_per_length.iter().enumerate() {
            right.fixed_view_mut::<2, 1>(6 + 2 * i, i).copy_from(end);
        }
        let solution = self.factored.solve(&right);
        Matrix6xX::from_fn(n, |row, column| solution[(row, column)])
    }
}
