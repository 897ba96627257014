//! Stability of an equilibrium, and the stiffness of its motions.

use crate::equations::{Motions, is_definite, per_length};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_robot::Vector3;
use nalgebra::{Matrix6, Vector6};

/// Stability of an equilibrium: stable where all eigenvalues of the potential's Hessian are positive, except
/// those of neutral motions, which nothing resists.
///
/// The Hessian is that in (dp, ℓ dφ), where the characteristic length ℓ makes rotations comparable with
/// translations. Constrained motions have no eigenvalues.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    hessian: Matrix6<f64>,
    /// The motions, unless all six are free and resisted.
    some: Option<Box<Sorted>>,
    characteristic_length: f64,
    stable: bool,
}

/// Free motions.
#[derive(Clone, Debug, PartialEq)]
struct Sorted {
    /// From the softest.
    resisted: Vec<Mode>,
    neutral: Vec<Mode>,
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

impl Mode {
    /// Along a unit vector of (dp, ℓ dφ).
    fn new(stiffness: f64, direction: &Vector6<f64>, characteristic_length: f64) -> Self {
        // Of the two signs, the one that makes the largest component positive.
        let direction = direction * direction[direction.iamax()].signum();
        let [translation, rotation] = [0, 3].map(|row| direction.fixed_rows::<3>(row).into_owned());
        Self { stiffness, translation, rotation: rotation / characteristic_length }
    }
}

impl DirectProblem<'_> {
    /// The stability of an equilibrium, which it need not have reported itself: with the characteristic
    /// length of this problem.
    ///
    /// # Errors
    /// As [`DirectProblem::linearize`].
    pub fn stability(&self, equilibrium: &Equilibrium) -> Result<Stability, StaticsError> {
        let stiffness = self.linearize(equilibrium)?.symmetric_stiffness();
        let hessian = self.robot.freedoms().of_matrix(&stiffness);
        Ok(Stability::new(self, equilibrium, &hessian))
    }
}

impl Stability {
    /// Of an equilibrium with a symmetric Hessian in (dp, dφ).
    pub(crate) fn new(problem: &DirectProblem, equilibrium: &Equilibrium, hessian: &Matrix6<f64>) -> Self {
        let characteristic_length = problem.characteristic_length();
        let scale = per_length(characteristic_length);
        let hessian = hessian.component_mul(&(scale * scale.transpose()));
        let all = |stable| Self { stable, hessian, some: None, characteristic_length };
        if is_definite(problem, &hessian) {
            return all(true);
        }
        if !hessian.iter().all(|entry| entry.is_finite()) {
            return all(false);
        }
        let Motions { pairs, neutral } = Motions::new(problem, equilibrium, &hessian);
        if neutral == 0 && pairs.len() == 6 {
            return all(hessian.cholesky().is_some());
        }
        let mode = |(stiffness, v): &(f64, Vector6<f64>)| Mode::new(*stiffness, v, characteristic_length);
        let resisted: Vec<_> = pairs[neutral..].iter().map(mode).collect();
        let neutral = pairs[..neutral].iter().map(|(_, v)| mode(&(0.0, *v))).collect();
        Self {
            stable: resisted.iter().all(|mode| mode.stiffness > 0.0),
            hessian,
            some: Some(Box::new(Sorted { resisted, neutral })),
            characteristic_length,
        }
    }

    /// Whether the potential has a minimum here: every small displacement that is resisted at all is pulled
    /// back.
    pub fn is_stable(&self) -> bool {
        self.stable
    }

    /// Whether every motion is stiffer than `share` of what it is in `other`, and none is constrained
    /// or of zero stiffness.
    pub(crate) fn exceeds(&self, share: f64, other: &Self) -> bool {
        self.some.is_none() && (self.hessian - share * other.hessian).cholesky().is_some()
    }

    /// Eigenvalues of the stiffness, ascending, of all motions that are neither constrained nor of zero
    /// stiffness [N/m].
    pub fn eigenvalues(&self) -> Vec<f64> {
        match &self.some {
            None => {
                let mut values: [f64; 6] = self.hessian.symmetric_eigenvalues().into();
                values.sort_by(f64::total_cmp);
                values.to_vec()
            }
            Some(sorted) => sorted.resisted.iter().map(|mode| mode.stiffness).collect(),
        }
    }

    /// The motions along the eigenvectors of the stiffness, each resisted along itself only, from the
    /// softest; without those that are constrained or of zero stiffness.
    pub fn modes(&self) -> Vec<Mode> {
        match &self.some {
            None => {
                let eigen = self.hessian.symmetric_eigen();
                let pairs = eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter());
                let mut modes: Vec<_> = pairs
                    .map(|(value, vector)| Mode::new(*value, &vector.into(), self.characteristic_length))
                    .collect();
                modes.sort_by(|a, b| a.stiffness.total_cmp(&b.stiffness));
                modes
            }
            Some(sorted) => sorted.resisted.clone(),
        }
    }

    /// Motions that nothing resists, such as the rotation of a platform that hangs on one cable: every pose
    /// along them is an equilibrium.
    pub fn neutral(&self) -> &[Mode] {
        self.some.as_ref().map_or(&[], |sorted| &sorted.neutral)
    }

    /// The smallest eigenvalue [N/m]: the stiffness of the softest motion that is resisted at all. An
    /// equilibrium disappears where it reaches zero.
    pub fn least_stiffness(&self) -> f64 {
        match &self.some {
            None => {
                let values: [f64; 6] = self.hessian.symmetric_eigenvalues().into();
                values.into_iter().min_by(f64::total_cmp).unwrap_or_default()
            }
            Some(sorted) => sorted.resisted.first().map_or(0.0, |mode| mode.stiffness),
        }
    }

    /// Characteristic length ℓ that makes rotations comparable with translations [m].
    ///
    /// It is the root mean square distance of the anchor points from P, or a thousandth of the longest cable
    /// where that is more.
    pub fn characteristic_length(&self) -> f64 {
        self.characteristic_length
    }
}
