//! Derivatives of the lowest natural frequency and of the lowest stiffness.
//!
//! Both are eigenvalues λ of the symmetric stiffness K, with the mass matrix M of (V1) of `loading/modes.rs`
//! or with the norm `|dp|² + ℓ² |dφ|²` for the metric N. With the motion v = (v_p, v_r), `vᵀ N v = 1`,
//!
//! ```text
//! dλ = d(vᵀ K v) - λ d(vᵀ N v),      v constant                                                   (D12)
//! ```
//!
//! unless two motions have the same λ. The length ℓ is a constant: it does not deviate with the inputs. The
//! motion moves the anchor point A_i by `v_i = v_p + v_r x s_i`, and
//! with (S5)
//!
//! ```text
//! vᵀ K v = sum[ v_i·K3_i v_i - F_i·(v_r x (v_r x s_i)) ] - F_w·(v_r x (v_r x R c))                (D13)
//! vᵀ M v = m |v_p + v_r x R c|² + v_r·R J_c Rᵀ v_r
//! ```
//!
//! All inputs change these directly and through pose, lengths and forces of the equilibrium. The derivatives
//! of `K3_i v_i`, second derivatives of the catenary, are (C28) of `cdpr_cable`.

use crate::direct::DirectSolution;
use crate::equations::{CableDerivatives, Inputs, Reading, Weighed, each_effect_on_weight, read};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load};
use cdpr_robot::{Matrix6xX, Robot, Vector3};
use nalgebra::{DMatrix, RowDVector};
use std::f64::consts::TAU;

/// Two eigenvalues that differ by less than this share are one: neither has a derivative then.
const SAME: f64 = 1e-7;

/// A motion of the platform, and the eigenvalue that it has.
struct Softest {
    value: f64,
    translation: Vector3<f64>,
    rotation: Vector3<f64>,
}

/// An equilibrium with the derivatives of what moves it; columns are inputs.
pub(super) struct AtRest<'a> {
    pub(super) robot: &'a Robot,
    pub(super) load: &'a Load,
    pub(super) inputs: &'a Inputs,
    pub(super) found: &'a DirectSolution,
    pub(super) lengths: &'a [f64],
    /// Derivatives of the lengths, n x count.
    pub(super) length_slopes: &'a DMatrix<f64>,
    /// Derivatives of the pose, 6 x count.
    pub(super) pose_slopes: &'a Matrix6xX<f64>,
}

impl AtRest<'_> {
    /// The lowest natural frequency [Hz] and its derivatives.
    pub(super) fn frequency(&self) -> Result<(f64, Vec<f64>), StaticsError> {
        const QUANTITY: &str = "the lowest natural frequency";
        let problem = DirectProblem::new(self.robot, self.lengths, self.load)?;
        let modes = problem.modes(&self.found.equilibrium)?;
        let mut resisted = modes.iter().filter(|mode| mode.frequency > 0.0);
        let square = |frequency: f64| (TAU * frequency).powi(2);
        let lowest = resisted.next().map(|mode| Softest {
            value: square(mode.frequency),
            translation: mode.translation,
            rotation: mode.rotation,
        });
        let next = resisted.next().map(|mode| square(mode.frequency));
        let softest = single(lowest, next, QUANTITY)?;
        let mut slopes = self.energy(&problem, &softest);
        slopes -= softest.value * self.inertia(&softest);
        let frequency = softest.value.sqrt() / TAU;
        // λ = (2π f)²
        slopes /= 2.0 * TAU * TAU * frequency;
        finite(slopes, QUANTITY).map(|slopes| (frequency, slopes))
    }

    /// The lowest stiffness [N/m] with the characteristic length ℓ [m], and its derivatives.
    pub(super) fn least_stiffness(&self, length: f64) -> Result<(f64, Vec<f64>), StaticsError> {
        const QUANTITY: &str = "the lowest stiffness";
        let problem = DirectProblem::new(self.robot, self.lengths, self.load)?;
        let problem = problem.with_characteristic_length(length);
        let modes = problem.stability(&self.found.equilibrium)?.modes();
        let mut resisted = modes.iter();
        let lowest = resisted.next().map(|mode| Softest {
            value: mode.stiffness,
            translation: mode.translation,
            rotation: mode.rotation,
        });
        let next = resisted.next().map(|mode| mode.stiffness);
        let softest = single(lowest, next, QUANTITY)?;
        let slopes = self.energy(&problem, &softest);
        finite(slopes, QUANTITY).map(|slopes| (softest.value, slopes))
    }

    /// Derivatives of `vᵀ K v`, (D13).
    fn energy(&self, problem: &DirectProblem, softest: &Softest) -> RowDVector<f64> {
        let Softest { translation, rotation: turn, .. } = *softest;
        let Self { robot, inputs, load, .. } = *self;
        let Equilibrium { pose, cable_forces: forces } = &self.found.equilibrium;
        let moved = |cable: &CableDerivatives| translation + turn.cross(&cable.arm);
        let twice = |v: &Vector3<f64>| turn.cross(&turn.cross(v));
        let cables = CableDerivatives::all(problem, pose, forces);
        let along: Vec<_> = cables
            .iter()
            .enumerate()
            .map(|(i, cable)| {
                cable.of_stiffness(robot, pose, i, &problem.catenary(i, forces[i]), moved(cable))
            })
            .collect();
        let of_forces = |cable: &CableDerivatives| Reading {
            per_force: -twice(&cable.arm),
            per_arm: cable.resisted_both_ways(&moved(cable)).cross(&turn) - twice(&cable.force),
        };
        // These vectors are -K3_i v_i.
        let of_stiffness =
            |cable: &CableDerivatives| Reading { per_force: -moved(cable), per_arm: Vector3::zeros() };
        let partials = read(inputs, pose, &cables, of_forces) + read(inputs, pose, &along, of_stiffness);
        let mut slopes = partials.row_sum();
        let weight = robot.weight(pose, load.payload).force;
        let center = pose.rotation * robot.platform.center_of_mass;
        each_effect_on_weight(robot, inputs, pose, load, |column, of: Weighed| {
            slopes[column] -= of.force.dot(&twice(&center)) + weight.dot(&twice(&of.turn));
        });
        self.follow(&mut slopes);
        for (i, (cable, along)) in cables.iter().zip(&along).enumerate() {
            let per_length = of_forces(cable).per_force.dot(&cable.per_actuation)
                + of_stiffness(along).per_force.dot(&along.per_actuation);
            slopes += per_length * self.length_slopes.row(i);
        }
        slopes
    }

    /// Derivatives of `vᵀ M v`, (D13).
    fn inertia(&self, softest: &Softest) -> RowDVector<f64> {
        let Softest { translation, rotation: turn, .. } = *softest;
        let Self { robot, inputs, load, .. } = *self;
        let pose = &self.found.equilibrium.pose;
        let mass = robot.platform.mass + load.payload;
        let velocity = translation + turn.cross(&(pose.rotation * robot.platform.center_of_mass));
        let mut slopes = self.zeros();
        each_effect_on_weight(robot, inputs, pose, load, |column, of: Weighed| {
            slopes[column] +=
                of.mass * velocity.norm_squared() + 2.0 * mass * velocity.dot(&turn.cross(&of.turn));
        });
        if let Some(inertia) = robot.platform.inertia {
            let momentum = pose.rotation * (inertia * (pose.rotation.inverse() * turn));
            // d(R J Rᵀ) = [dφ] R J Rᵀ - R J Rᵀ [dφ]
            let per_turn = 2.0 * momentum.cross(&turn);
            let first = inputs.pose().start + 3;
            (0..3).for_each(|axis| slopes[first + axis] += per_turn[axis]);
        }
        self.follow(&mut slopes);
        slopes
    }

    fn zeros(&self) -> RowDVector<f64> {
        RowDVector::zeros(self.inputs.count())
    }

    /// The columns of the pose of `slopes` are those of the pose reached, which every input moves.
    fn follow(&self, slopes: &mut RowDVector<f64>) {
        let columns = self.inputs.pose();
        let per_motion = slopes.columns(columns.start, columns.len()).into_owned();
        slopes.columns_mut(columns.start, columns.len()).fill(0.0);
        *slopes += per_motion * self.pose_slopes;
    }
}

/// The motion of the lowest eigenvalue, which no other motion has.
fn single(
    lowest: Option<Softest>,
    next: Option<f64>,
    quantity: &'static str,
) -> Result<Softest, StaticsError> {
    let none = |reason| StaticsError::NoDerivative { quantity, reason };
    let lowest = lowest.ok_or_else(|| none("nothing resists the platform"))?;
    if next.is_some_and(|next| next - lowest.value <= SAME * next.abs()) {
        return Err(none("two motions have it"));
    }
    Ok(lowest)
}

fn finite(slopes: RowDVector<f64>, quantity: &'static str) -> Result<Vec<f64>, StaticsError> {
    if slopes.iter().all(|slope| slope.is_finite()) {
        return Ok(slopes.as_slice().to_vec());
    }
    Err(StaticsError::NoDerivative { quantity, reason: "a cable hangs folded in a plane without width" })
}
