//! Whether an equilibrium holds, and how far it is from losing hold.

use nalgebra::{Matrix6, Vector6};

/// Stability of an equilibrium: the Hessian of the potential in (dp, ρ dφ), where the length ρ makes rotations comparable with
/// translations. Stable where all its eigenvalues are positive.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    hessian: Matrix6<f64>,
    arm: f64,
    stable: bool,
}

impl Stability {
    /// From the symmetric Hessian in (dp, dφ).
    pub(crate) fn new(hessian: &Matrix6<f64>, arm: f64) -> Self {
        let scale = Vector6::new(1.0, 1.0, 1.0, 1.0 / arm, 1.0 / arm, 1.0 / arm);
        let hessian = hessian.component_mul(&(scale * scale.transpose()));
        Self { stable: hessian.cholesky().is_some(), hessian, arm }
    }

    /// Whether the potential has a minimum here: every small displacement is pulled back.
    pub fn is_stable(&self) -> bool {
        self.stable
    }

    /// Eigenvalues of the stiffness, ascending [N/m].
    pub fn eigenvalues(&self) -> [f64; 6] {
        let mut values: [f64; 6] = self.hessian.symmetric_eigenvalues().into();
        values.sort_by(f64::total_cmp);
        values
    }

    /// The smallest eigenvalue [N/m]: the stiffness of the softest motion. An equilibrium disappears where it reaches zero.
    pub fn least_stiffness(&self) -> f64 {
        self.eigenvalues()[0]
    }

    /// In how many independent directions the platform would move away: the number of negative eigenvalues.
    pub fn unstable_directions(&self) -> usize {
        let negative = self.eigenvalues().iter().filter(|value| **value < 0.0).count();
        // At the border rounding decides; the factorisation has the last word.
        if self.stable { 0 } else { negative.max(1) }
    }

    /// The length ρ that makes rotations comparable with translations [m]: the root mean square distance of the anchor
    /// points from P, or a thousandth of the longest cable where that is more.
    pub fn arm(&self) -> f64 {
        self.arm
    }
}
