//! Small displacements about an equilibrium.
//!
//! The assembled equations `g(x, θ) = 0` give `dx = -(dg/dx)⁻¹ (dg/dθ) dθ`: one factorisation answers for wrenches, lengths
//! and whatever else moves the platform. Section 3.3 of the paper says why such a displacement is not the static
//! deflection of a robot with sagging cables; both are here to be compared.

use crate::direct::DirectSolution;
use crate::equations::assembled::{Factored, State, jacobian};
use crate::equations::balance::Balance;
use crate::error::StaticsError;
use crate::model::Model;
use crate::state::{Equilibrium, Load};
use cdpr_robot::{Matrix6xX, Robot, Vector2, Vector6, Wrench};
use nalgebra::{DMatrix, Matrix6};

/// The linearised model at an equilibrium.
pub struct Tangent {
    factored: Factored,
    stiffness: Matrix6<f64>,
    /// d(x, z)/dL of every cable at constant force [m/m].
    end_per_length: Vec<Vector2<f64>>,
}

impl Tangent {
    /// Linearises at `equilibrium`, which must be one for these lengths and this load.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for lengths or loads that are none.
    pub fn new(
        robot: &Robot,
        lengths: &[f64],
        load: &Load,
        equilibrium: &Equilibrium,
    ) -> Result<Self, StaticsError> {
        let model = Model::new(robot, lengths, load)?;
        let mut balance = Balance::of_load(&model, &equilibrium.pose);
        let mut end_per_length = Vec::with_capacity(lengths.len());
        for (i, force) in equilibrium.cable_forces.iter().enumerate() {
            let span = model.span(&equilibrium.pose, i);
            let catenary = model.catenary(i, *force);
            let s = robot.anchor_arm(&equilibrium.pose, i);
            balance.add_cable(&s, &span.lift(*force), &catenary.stiffness(span.azimuth));
            // Paying out a slack cable without weight moves nothing.
            let limp = catenary.is_limp();
            end_per_length.push(if limp { Vector2::zeros() } else { catenary.compliance().end_per_length });
        }
        Ok(Self {
            factored: Factored::new(&jacobian(&model, &State::from(equilibrium))),
            stiffness: balance.symmetric_hessian(),
            end_per_length,
        })
    }

    /// Linearises at the solution of a direct problem.
    ///
    /// # Errors
    /// As [`Tangent::new`].
    pub fn at(
        robot: &Robot,
        lengths: &[f64],
        load: &Load,
        solution: &DirectSolution,
    ) -> Result<Self, StaticsError> {
        Self::new(robot, lengths, load, &solution.equilibrium)
    }

    /// Cartesian stiffness matrix, 6 x 6, of (dp, dφ) in the base frame about P [N/m, N/rad, N, N m/rad]: the Hessian of the
    /// potential, cables' sag and weight included. Symmetric; positive definite where the equilibrium is stable. A moment of
    /// constant components M has no potential: its unsymmetric part [M]/2, which depends on how rotations are counted, is
    /// left out here and contained in [`Tangent::displacement`].
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
