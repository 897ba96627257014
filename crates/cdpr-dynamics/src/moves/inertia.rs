//! The wrench with which platform and cables resist a motion.

use super::way::{Motion, Way};
use crate::error::DynamicsError;
use crate::response::{Damping, FrequencyResponse};
use cdpr_robot::{Robot, Vector3, Vector6};
use cdpr_statics::{DirectProblem, DirectStart, Load, Matrix6, StaticsError, inverse};
use nalgebra::{Complex, DVector, Matrix6xX};
use std::f64::consts::TAU;

/// (N16) of platform and payload.
pub(super) fn resistance(robot: &Robot, load: &Load, motion: &Motion) -> Result<Vector6<f64>, StaticsError> {
    let platform = &robot.platform;
    let mass = platform.mass + load.payload;
    let rotation = motion.pose.rotation.matrix();
    let part = |vector: &Vector6<f64>, first: usize| {
        Vector3::new(vector[first], vector[first + 1], vector[first + 2])
    };
    let (spin, turn) = (part(&motion.velocity, 3), part(&motion.acceleration, 3));
    let lever = rotation * platform.center_of_mass;
    let acceleration = part(&motion.acceleration, 0) + turn.cross(&lever) + spin.cross(&spin.cross(&lever));
    let force = acceleration * -mass;
    let mut moment = lever.cross(&force);
    let freedoms = robot.freedoms();
    if (3..6).any(|k| freedoms.contains(k)) {
        let Some(inertia) = platform.inertia else {
            return Err(StaticsError::Invalid {
                field: "platform.inertia".to_owned(),
                value: "missing".to_owned(),
                expected: "the inertia about the centre of mass, 3 x 3 in the platform frame [kg m²]"
                    .to_owned(),
            });
        };
        let inertia = rotation * inertia * rotation.transpose();
        moment -= inertia * turn + spin.cross(&(inertia * spin));
    }
    let wrench = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
    Ok(freedoms.of_vector(&wrench))
}

/// Inertia of the cables at low frequencies, at shares of the way.
pub(super) struct CableInertia(Vec<Inertia>);

struct Inertia {
    /// M_c of (N17), 6 x 6 [kg, kg m, kg m²].
    mass: Matrix6<f64>,
    /// W of (N17), 6 x n [kg, kg m].
    winches: Matrix6xX<f64>,
}

impl CableInertia {
    /// At poses along a way, with the tensions of the robot at rest there.
    pub(super) fn along(robot: &Robot, load: &Load, way: &Way) -> Result<Self, DynamicsError> {
        const POSES: usize = 5;
        let at = |k: usize| Inertia::at(robot, load, &way.at([k as f64 / (POSES - 1) as f64, 0.0, 0.0]));
        Ok(Self((0..POSES).map(at).collect::<Result<_, _>>()?))
    }

    /// The wrench with which cables resist a motion at a share of the way with L'' of (N17) [m/s²].
    pub(super) fn resistance(&self, share: f64, motion: &Motion, growth: &[f64]) -> Vector6<f64> {
        let place = share.clamp(0.0, 1.0) * (self.0.len() - 1) as f64;
        let k = (place as usize).min(self.0.len() - 2);
        let (b, growth) = (place - k as f64, DVector::from_column_slice(growth));
        let of = |inertia: &Inertia| -(inertia.mass * motion.acceleration) - &inertia.winches * &growth;
        of(&self.0[k]) * (1.0 - b) + of(&self.0[k + 1]) * b
    }
}

impl Inertia {
    fn at(robot: &Robot, load: &Load, motion: &Motion) -> Result<Self, DynamicsError> {
        /// Share of the slowest cable's frequency at which the inertia is that at rest to its square.
        const LOW: f64 = 0.02;
        let held = inverse(robot, &motion.pose, load)?;
        let problem = DirectProblem::new(robot, &held.lengths, load)?;
        let rest = problem.direct(DirectStart::Near(&held.equilibrium))?.equilibrium;
        let frequencies = problem.cable_frequencies(&rest)?.into_iter().flatten();
        let Some(slowest) = frequencies.min_by(f64::total_cmp) else {
            let winches = Matrix6xX::zeros(robot.cables.len());
            return Ok(Self { mass: Matrix6::zeros(), winches });
        };
        let low = LOW * slowest;
        let response = FrequencyResponse::new(&problem, &rest, low, Damping::default())?;
        let square = (TAU * low).powi(2);
        let [still, slow] = [0.0, low].map(|frequency| response.of_cables(frequency));
        let ((still, pulls), (slow, moved)) = (still?, slow?);
        // In amplitudes -ω² is a second derivative, and -L'' that of what a winch takes in:
        // D v = -P δ becomes (K - ω² M) v = -(P_0 + ω² W) δ.
        let real = |matrix: Matrix6<Complex<f64>>| matrix.map(|value| value.re);
        let mass = real(still - slow) / square;
        Ok(Self { mass, winches: (moved - pulls).map(|value| value.re) / square })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::platform::MovingPlatform;
    use cdpr_robot::Pose;

    #[test]
    fn slow_motions_feel_the_mass_of_the_static_shapes_of_the_cables() {
        let mut robot = Robot::from_library("cogiro").unwrap();
        let poses = [Pose::at(0.0, 0.0, 2.0), Pose::at(1.0, 0.5, 2.0)];
        for density in [robot.cables[0].properties.linear_density, 0.0] {
            robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density = density);
            let load = Load::none();
            let start = Way::new(&poses, 1.0).unwrap().at([0.0; 3]);
            let inertia = Inertia::at(&robot, &load, &start).unwrap();
            let held = inverse(&robot, &start.pose, &load).unwrap();
            let problem = DirectProblem::new(&robot, &held.lengths, &load).unwrap();
            let platform = MovingPlatform::new(&problem, &held.equilibrium, 2.0).unwrap();
            let expected = platform.cables.iter().fold(Matrix6::zeros(), |sum, cable| sum + cable.mass);
            let error = (inertia.mass - expected).norm();
            assert!(error <= 2e-3 * expected.norm(), "{error} {}", expected.norm());
            assert_eq!(inertia.winches.norm() > 0.0, density > 0.0);
        }
    }
}
