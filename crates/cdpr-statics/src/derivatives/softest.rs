//! Derivatives of the lowest stiffness.
//!
//! It is the least eigenvalue λ of the symmetric stiffness K in the norm `|dp|² + ℓ² |dφ|²`. With its motion
//! v = (v_p, v_r) of unit norm,
//!
//! ```text
//! dλ = d(vᵀ K v),      v constant                                                                 (D12)
//! ```
//!
//! unless two motions have the same λ. The length ℓ is a constant: it does not deviate with the inputs. The
//! motion moves the anchor point A_i by `v_i = v_p + v_r x s_i`, and with (S5)
//!
//! ```text
//! vᵀ K v = sum[ v_i·K3_i v_i - F_i·(v_r x (v_r x s_i)) ] - F_w·(v_r x (v_r x R c))                (D13)
//! ```
//!
//! All inputs change it directly and through pose, lengths and forces of the equilibrium. The derivatives
//! of `K3_i v_i`, second derivatives of the catenary, are (C28) of `cdpr_cable`.

use crate::derivatives::Derivatives;
use crate::direct::Mode;
use crate::equations::{CableDerivatives, Reading, each_effect_on_weight, read};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load};
use cdpr_robot::{Robot, Vector3};
use nalgebra::RowDVector;

/// Two eigenvalues that differ by less than this share are one: neither has a derivative then.
const SAME: f64 = 1e-7;

impl Derivatives {
    /// The lowest stiffness [N/m] of `robot` under `load`, those of these derivatives, and its derivatives
    /// [N/m per unit], one for each input: see [`crate::Stability::least_stiffness`]. The characteristic
    /// length is that of `robot`, a constant.
    ///
    /// # Errors
    /// [`StaticsError::NoDerivative`] where two motions have the lowest stiffness or nothing resists any, and
    /// for a cable that hangs folded without width.
    pub fn least_stiffness(&self, robot: &Robot, load: &Load) -> Result<(f64, Vec<f64>), StaticsError> {
        self.least_stiffness_with(robot, load, self.deflection.loaded.stability.characteristic_length())
    }

    /// As [`Derivatives::least_stiffness`], with another characteristic length ℓ [m]: that of the nominal
    /// robot for one that deviates from it.
    ///
    /// # Errors
    /// As [`Derivatives::least_stiffness`].
    pub fn least_stiffness_with(
        &self,
        robot: &Robot,
        load: &Load,
        characteristic_length: f64,
    ) -> Result<(f64, Vec<f64>), StaticsError> {
        let none = |reason| StaticsError::NoDerivative { quantity: "the lowest stiffness", reason };
        let problem = DirectProblem::new(robot, &self.deflection.lengths, load)?;
        let problem = problem.with_characteristic_length(characteristic_length);
        let modes = problem.stability(&self.deflection.loaded.equilibrium)?.modes();
        let lowest = modes.first().ok_or_else(|| none("nothing resists the platform"))?;
        let is_same = |next: &Mode| next.stiffness - lowest.stiffness <= SAME * next.stiffness.abs();
        if modes.get(1).is_some_and(is_same) {
            return Err(none("two motions have it"));
        }
        let slopes = self.energy(&problem, lowest);
        if slopes.iter().all(|slope| slope.is_finite()) {
            return Ok((lowest.stiffness, slopes.as_slice().to_vec()));
        }
        Err(none("a cable hangs folded in a plane without width"))
    }

    /// Derivatives of `vᵀ K v`, (D13).
    fn energy(&self, problem: &DirectProblem, softest: &Mode) -> RowDVector<f64> {
        let Mode { translation, rotation: turn, .. } = *softest;
        let (robot, load, inputs) = (problem.robot, &problem.load, &self.inputs);
        let Equilibrium { pose, cable_forces: forces } = &self.deflection.loaded.equilibrium;
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
        each_effect_on_weight(robot, inputs, pose, load, |column, force, lever| {
            slopes[column] -= force.dot(&twice(&center)) + weight.dot(&twice(&lever));
        });
        // The columns of the pose are those of the pose reached, which every input moves.
        let columns = inputs.pose();
        let per_motion = slopes.columns(columns.start, columns.len()).into_owned();
        slopes.columns_mut(columns.start, columns.len()).fill(0.0);
        slopes += per_motion * &self.loaded.pose;
        for (i, (cable, along)) in cables.iter().zip(&along).enumerate() {
            let per_length = of_forces(cable).per_force.dot(&cable.per_actuation)
                + of_stiffness(along).per_force.dot(&along.per_actuation);
            slopes += per_length * self.lengths.row(i);
        }
        slopes
    }
}
