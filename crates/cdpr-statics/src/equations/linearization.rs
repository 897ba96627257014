//! Small displacements about an equilibrium.
//!
//! With the stiffness H of the platform, (S5) and what a moment and cables over guides add to it, a small
//! additional wrench and small changes of the lengths move it by
//!
//! ```text
//! H (dp, dφ) = dw + sum [k_L; s_i x k_L] dL_i,      k_L = K ∂A/∂L                                  (S6)
//! ```
//!
//! with K the stiffness of cable i in space and ∂A/∂L the way of its free end per length. Section 3.3 of
//! the paper says why such a displacement is not the static deflection of a robot with sagging cables; both
//! are here to be compared.

use crate::equations::balance::{Balance, symmetric_part};
use crate::equations::cable_derivatives::wrench;
use crate::equations::motions::Pins;
use crate::equations::spanned::SpannedCable;
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_robot::{Matrix6xX, Vector3, Vector6, Wrench};
use nalgebra::{Matrix3x6, Matrix6};

/// The direct problem linearized at an equilibrium.
pub struct Linearization {
    stiffness: Matrix6<f64>,
    pins: Pins,
    /// The inverse of the stiffness with its pins; `None` at the border of stability.
    flexibility: Option<Matrix6<f64>>,
    /// [k_L; s_i x k_L] of every cable [N/m, N].
    wrench_per_length: Vec<Vector6<f64>>,
}

impl DirectProblem<'_> {
    /// The problem linearized at an equilibrium of its own.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless the equilibrium is finite and has one force for each cable.
    pub fn linearize(&self, equilibrium: &Equilibrium) -> Result<Linearization, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        let mut balance = Balance::of_load(self, &equilibrium.pose);
        let mut of_guides = Matrix6::zeros();
        let mut wrench_per_length = Vec::with_capacity(self.cables());
        for (i, force) in equilibrium.cable_forces.iter().enumerate() {
            let catenary = self.catenary(i, *force);
            let cable = SpannedCable::of(self.robot, &equilibrium.pose, i, &catenary);
            let Some(linearized) = cable.linearized() else {
                // Paying out a slack cable without weight moves nothing.
                wrench_per_length.push(Vector6::zeros());
                continue;
            };
            let mut stiffness = linearized.stiffness();
            balance.add_cable(&cable.anchor_arm, &cable.force_on_platform(), &stiffness.into());
            if let Some(skew) = cable.skew_stiffness(&catenary) {
                stiffness += skew;
                // dr_i = dp - [s_i] dφ
                let mut motion = Matrix3x6::identity();
                motion.fixed_columns_mut::<3>(3).copy_from(&-Vector3::from(cable.anchor_arm).cross_matrix());
                of_guides += motion.transpose() * skew * motion;
            }
            wrench_per_length.push(wrench(&cable.anchor_arm.into(), &(stiffness * cable.end_per_length())));
        }
        let freedoms = self.robot.freedoms();
        let stiffness = balance.hessian(freedoms) + freedoms.of_matrix(&of_guides);
        let pins = Pins::new(self, equilibrium, &symmetric_part(&stiffness));
        let flexibility = pins.pinned(&stiffness, 1.0).try_inverse();
        Ok(Linearization { stiffness, pins, flexibility, wrench_per_length })
    }
}

impl Linearization {
    /// Cartesian stiffness matrix H, 6 x 6, of (dp, dφ) in the base frame about P [N/m, N/rad, N, N m/rad].
    ///
    /// It is the true tangent `-dG/d(p, φ)` of the balance, with sag and weight of the cables and rotations
    /// `R <- exp(dφ) R`: a small additional wrench is H times the displacement. It is symmetric to rounding
    /// unless a moment M acts, or cables with weight run over pulleys. A moment of constant components has no
    /// potential, and the lower right block of H has the skew part `-[M]/2`. Rows and columns of constrained
    /// motions are zero.
    pub fn stiffness(&self) -> &Matrix6<f64> {
        &self.stiffness
    }

    /// Symmetric part of [`Linearization::stiffness`]: positive definite where the equilibrium is stable.
    ///
    /// Without moment and pulleys it is the Hessian of the potential.
    pub fn symmetric_stiffness(&self) -> Matrix6<f64> {
        symmetric_part(&self.stiffness)
    }

    /// Displacement (dp, dφ) [m, rad] under a small additional wrench; not a number at the border of
    /// stability. What constrains a motion takes its part of the wrench, and a motion that nothing resists is
    /// left out.
    pub fn displacement(&self, wrench: &Wrench) -> Vector6<f64> {
        self.moved(wrench.to_vector())
    }

    /// d(p, φ)/dL: displacement of the platform per unstrained length of each cable, 6 x n [m/m, rad/m].
    pub fn pose_per_length(&self) -> Matrix6xX<f64> {
        let columns: Vec<_> = self.wrench_per_length.iter().map(|wrench| self.moved(*wrench)).collect();
        Matrix6xX::from_columns(&columns)
    }

    fn moved(&self, wrench: Vector6<f64>) -> Vector6<f64> {
        self.flexibility
            .map_or_else(|| Vector6::repeat(f64::NAN), |flexibility| flexibility * self.pins.rest(&wrench))
    }
}
