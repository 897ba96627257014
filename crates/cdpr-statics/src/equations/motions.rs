//! Constrained motions of the platform, and motions that nothing resists.
//!
//! What constrains a motion takes any wrench along it: its row and column are left out of the balance. Fewer
//! cables than free motions may leave motions that no force resists, such as the rotation of a platform
//! that hangs on one cable. Along such a neutral motion v the stiffness is zero, `H v = 0`, and every pose is
//! an equilibrium. An eigenvalue that is zero to rounding is no proof, because a light platform on stiff
//! cables has one, too. So the platform is moved along v by a finite screw motion, and the balance is looked
//! at again.

use crate::equations::rounding::forces;
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Residual};
use cdpr_robot::{Freedoms, Matrix3, Matrix6xX, Pose, Vector3, Vector6};
use nalgebra::{Matrix6, SymmetricEigen};

/// Eigenvalues below this share of the greatest may be those of neutral motions.
const NEARLY_ZERO: f64 = 1e-10;

/// A neutral motion is tried over this share of the characteristic length, and over as many radians at most:
/// so little that hardly a slack cable becomes taut on the way.
const TRIED: f64 = 1e-3;

/// Residual after a neutral motion, relative to all forces.
const BALANCED: f64 = 1e-9;

/// The forces of all cables at a pose, each in its own equilibrium.
pub(crate) fn cables_at(problem: &DirectProblem, pose: &Pose) -> Result<Equilibrium, StaticsError> {
    let cable_forces = (0..problem.cables())
        .map(|i| problem.force_at(pose, i, None).map_err(StaticsError::cable(i)))
        .collect::<Result<_, _>>()?;
    Ok(Equilibrium { pose: *pose, cable_forces })
}

/// From (dp, l dφ) to (dp, dφ).
pub(crate) fn per_length(length: f64) -> Vector6<f64> {
    let per_length = 1.0 / length;
    Vector6::new(1.0, 1.0, 1.0, per_length, per_length, per_length)
}

/// The eigenvalues [N/m] and unit eigenvectors of a symmetric stiffness in (dp, ℓ dφ), over free motions,
/// from the softest motion; then the number of neutral motions, which are put first.
pub(crate) struct Motions {
    pub(crate) pairs: Vec<(f64, Vector6<f64>)>,
    pub(crate) neutral: usize,
}

impl Motions {
    /// Those of an equilibrium with this stiffness, which is finite.
    pub(crate) fn new(problem: &DirectProblem, equilibrium: &Equilibrium, hessian: &Matrix6<f64>) -> Self {
        let freedoms = problem.robot.freedoms();
        let free = freedoms.components();
        let SymmetricEigen { eigenvalues, eigenvectors } = freedoms.block(hessian).symmetric_eigen();
        let mut pairs: Vec<_> = eigenvectors
            .column_iter()
            .zip(eigenvalues.iter())
            .map(|(column, value)| {
                let mut vector = Vector6::zeros();
                free.iter().zip(column.iter()).for_each(|(k, component)| vector[*k] = *component);
                (*value, vector)
            })
            .collect();
        pairs.sort_by(|one, other| one.0.total_cmp(&other.0));
        let greatest = pairs.iter().fold(0.0, |greatest: f64, (value, _)| greatest.max(value.abs()));
        let is_neutral = |(value, vector): &(f64, Vector6<f64>)| {
            value.abs() <= NEARLY_ZERO * greatest && stays_balanced(problem, equilibrium, vector, greatest)
        };
        let (mut neutral, resisted): (Vec<_>, Vec<_>) = pairs.into_iter().partition(is_neutral);
        let count = neutral.len();
        neutral.extend(resisted);
        Self { pairs: neutral, neutral: count }
    }
}

/// Whether the platform is in balance after a finite screw motion along a unit vector of (dp, ℓ dφ), too.
fn stays_balanced(
    problem: &DirectProblem,
    equilibrium: &Equilibrium,
    direction: &Vector6<f64>,
    stiffness: f64,
) -> bool {
    let length = problem.characteristic_length();
    let motion = direction.component_mul(&per_length(length)) * (TRIED * length);
    let (velocity, turn): (Vector3<f64>, Vector3<f64>) =
        (motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into());
    let (angle, cross) = (turn.norm(), turn.cross_matrix());
    // P moves along a helix: the integral of exp([turn] s) over s from 0 to 1, times its velocity.
    let (once, twice) = if angle < 1e-3 {
        (0.5, 1.0 / 6.0)
    } else {
        ((1.0 - angle.cos()) / angle.powi(2), (angle - angle.sin()) / angle.powi(3))
    };
    let helix = Matrix3::identity() + cross * once + cross * cross * twice;
    let Ok(moved) = cables_at(problem, &equilibrium.pose.moved(helix * velocity, turn)) else { return false };
    let Residual { force, moment, .. } = Residual::of(problem, &moved);
    // Rounding of the points, too, is a force in stiff cables.
    let points = f64::EPSILON * (problem.size() + problem.coordinates(&moved.pose));
    force + moment / length <= BALANCED * forces(problem, &moved) + 10.0 * stiffness * points
}

/// Artificial stiffness on constrained and zero-stiffness motions: the 6 x 6 system is regular and they do
/// not move.
pub(crate) struct Pins {
    freedoms: Freedoms,
    /// For each neutral motion: (dp, dφ), and the covector that reads it from a motion.
    neutral: Vec<(Vector6<f64>, Vector6<f64>)>,
    stiffness: f64,
}

impl Pins {
    /// Those of an equilibrium with the symmetric stiffness `hessian` in (dp, dφ).
    pub(crate) fn new(problem: &DirectProblem, equilibrium: &Equilibrium, hessian: &Matrix6<f64>) -> Self {
        let freedoms = problem.robot.freedoms();
        let scale = per_length(problem.characteristic_length());
        let scaled = hessian.component_mul(&(scale * scale.transpose()));
        let stiffness = scaled.amax();
        if !scaled.iter().all(|entry| entry.is_finite()) || is_definite(problem, &scaled) {
            return Self { freedoms, neutral: Vec::new(), stiffness };
        }
        let Motions { pairs, neutral } = Motions::new(problem, equilibrium, &scaled);
        let pin = |(_, v): &(f64, Vector6<f64>)| (v.component_mul(&scale), v.component_div(&scale));
        Self { freedoms, neutral: pairs[..neutral].iter().map(pin).collect(), stiffness }
    }

    /// Whether every motion is free and resisted.
    pub(crate) fn are_none(&self) -> bool {
        self.freedoms.are_all() && self.neutral.is_empty()
    }

    /// The stiffness, times `sign`, with the pins.
    pub(crate) fn pinned(&self, matrix: &Matrix6<f64>, sign: f64) -> Matrix6<f64> {
        if self.are_none() {
            return *matrix;
        }
        let mut pinned = self.freedoms.of_matrix(matrix);
        (0..6).filter(|k| !self.freedoms.contains(*k)).for_each(|k| pinned[(k, k)] = sign);
        for (_, covector) in &self.neutral {
            pinned += sign * self.stiffness * covector * covector.transpose();
        }
        pinned
    }

    /// The part of a wrench that no pin takes.
    pub(crate) fn rest(&self, wrench: &Vector6<f64>) -> Vector6<f64> {
        let free = self.freedoms.of_vector(wrench);
        self.neutral.iter().fold(free, |rest, (motion, covector)| rest - covector * motion.dot(&free))
    }

    /// Takes the pins' parts out of wrenches, one in each column.
    pub(crate) fn take(&self, wrenches: &mut Matrix6xX<f64>) {
        if !self.are_none() {
            wrenches.column_iter_mut().for_each(|mut column| {
                let rest = self.rest(&column.clone_owned());
                column.copy_from(&rest);
            });
        }
    }
}

/// Whether a stiffness in (dp, ℓ dφ) is positive definite, so that no motion is neutral: clearly so where
/// there are fewer cables than free motions.
pub(crate) fn is_definite(problem: &DirectProblem, scaled: &Matrix6<f64>) -> bool {
    const CLEARLY: f64 = 1e-8;
    let Some(factor) = scaled.cholesky() else { return false };
    let pivots = factor.l_dirty().diagonal();
    problem.robot.is_fully_actuated() || pivots.min().powi(2) > CLEARLY * pivots.max().powi(2)
}
