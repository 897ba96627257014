//! Stability of an equilibrium, and the stiffness of its motions.

use cdpr_robot::Vector3;
use nalgebra::{Matrix6, Vector6};
use std::array::from_fn;

/// Stability of an equilibrium: stable where all eigenvalues of the potential's Hessian are positive.
///
/// The Hessian is that in (dp, ℓ dφ), where the characteristic length ℓ makes rotations comparable with
/// translations.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    hessian: Matrix6<f64>,
    characteristic_length: f64,
    stable: bool,
}

/// A motion of the platform along an eigenvector of its stiffness, `|translation|² + ℓ² |rotation|² = 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Eigenvalue [N/m].
    pub stiffness: f64,
    /// Translation of P per unit of the motion [m/m].
    pub translation: Vector3<f64>,
    /// Rotation per unit of the motion [rad/m].
    pub rotation: Vector3<f64>,
}

impl Stability {
    /// From the symmetric Hessian in (dp, dφ).
    pub(crate) fn new(hessian: &Matrix6<f64>, characteristic_length: f64) -> Self {
        let per_length = 1.0 / characteristic_length;
        let scale = Vector6::new(1.0, 1.0, 1.0, per_length, per_length, per_length);
        let hessian = hessian.component_mul(&(scale * scale.transpose()));
        Self { stable: hessian.cholesky().is_some(), hessian, characteristic_length }
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

    /// The motions along the eigenvectors of the stiffness, each resisted along itself only, from the
    /// softest.
    pub fn modes(&self) -> [Mode; 6] {
        let eigen = self.hessian.symmetric_eigen();
        let mut modes = from_fn(|k| {
            let direction = eigen.eigenvectors.column(k);
            // Of the two signs, the one that makes the largest component positive.
            let direction = direction * direction[direction.iamax()].signum();
            let [translation, rotation] = [0, 3].map(|row| direction.fixed_rows::<3>(row).into_owned());
            Mode {
                stiffness: eigen.eigenvalues[k],
                translation,
                rotation: rotation / self.characteristic_length,
            }
        });
        modes.sort_by(|a, b| a.stiffness.total_cmp(&b.stiffness));
        modes
    }

    /// The smallest eigenvalue [N/m]: the stiffness of the softest motion. An equilibrium disappears where it
    /// reaches zero.
    pub fn least_stiffness(&self) -> f64 {
        self.eigenvalues()[0]
    }

    /// Number of independent directions in which the platform would move away: of negative eigenvalues.
    pub fn unstable_directions(&self) -> usize {
        let negative = self.eigenvalues().iter().filter(|value| **value < 0.0).count();
        // At the border of stability rounding decides: the answer agrees with `is_stable`.
        if self.stable { 0 } else { negative.max(1) }
    }

    /// Characteristic length ℓ that makes rotations comparable with translations [m].
    ///
    /// It is the root mean square distance of the anchor points from P, or a thousandth of the longest cable
    /// where that is more.
    pub fn characteristic_length(&self) -> f64 {
        self.characteristic_length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_modes_make_up_the_stiffness() {
        let half = Matrix6::from_fn(|i, j| ((3 * i + 5 * j) as f64).sin() + if i == j { 4.0 } else { 0.0 });
        let hessian = half * half.transpose();
        let stability = Stability::new(&hessian, 0.5);
        let modes = stability.modes();
        let sum: Matrix6<f64> = modes
            .iter()
            .map(|mode| {
                let [t, r] = [mode.translation, 0.5 * 0.5 * mode.rotation];
                let covector = Vector6::new(t.x, t.y, t.z, r.x, r.y, r.z);
                mode.stiffness * covector * covector.transpose()
            })
            .sum();
        assert!((sum - hessian).norm() < 1e-12 * hessian.norm());
        for (mode, value) in modes.iter().zip(stability.eigenvalues()) {
            assert!((mode.stiffness - value).abs() < 1e-12 * hessian.norm());
        }
    }
}
