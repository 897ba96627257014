//! The wrench with which platform and cables resist a motion.

use super::way::{Motion, Way};
use crate::error::DynamicsError;
use crate::response::shaken::StiffnessAndPull;
use crate::response::{Damping, FrequencyResponse};
use cdpr_robot::{Robot, Vector3, Vector6};
use cdpr_statics::vibration::CableAtRest;
use cdpr_statics::{DirectProblem, DirectStart, Load, StaticsError, inverse};
use nalgebra::Matrix3;
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
pub(super) struct CableInertia(Vec<Vec<Inertia>>);

/// That of one cable.
#[derive(Clone, Default)]
struct Inertia {
    /// M_i of (N17) [kg].
    mass: Matrix3<f64>,
    /// W_i of (N17) [kg].
    winch: Vector3<f64>,
    /// Z_i of (N24) [kg].
    at_winch: f64,
}

/// What a cable does to the platform and at its exit because it moves itself.
#[derive(Clone, Default)]
pub(super) struct Resistance {
    /// Force on the platform at the anchor point, in the base frame [N].
    pub(super) force: Vector3<f64>,
    /// What the tension at the exit point grows by [N].
    pub(super) at_exit: f64,
}

impl CableInertia {
    /// At poses along a way, with the tensions of the robot at rest there.
    pub(super) fn along(robot: &Robot, load: &Load, way: &Way) -> Result<Self, DynamicsError> {
        const POSES: usize = 5;
        let at = |k: usize| Inertia::at(robot, load, &way.at([k as f64 / (POSES - 1) as f64, 0.0, 0.0]));
        Ok(Self((0..POSES).map(at).collect::<Result<_, _>>()?))
    }

    /// How each cable resists at a share of the way where its anchor point has this acceleration and its
    /// length L'' of (N17) [m/s²].
    pub(super) fn resistance(&self, share: f64, accelerations: &[(Vector3<f64>, f64)]) -> Vec<Resistance> {
        let place = share.clamp(0.0, 1.0) * (self.0.len() - 1) as f64;
        let k = (place as usize).min(self.0.len() - 2);
        let b = place - k as f64;
        let one =
            |((before, after), (acceleration, growth)): ((&Inertia, &Inertia), &(Vector3<f64>, f64))| {
                let of = |part: &dyn Fn(&Inertia) -> Vector3<f64>| part(before) * (1.0 - b) + part(after) * b;
                let winch = of(&|inertia| inertia.winch);
                let at_winch = before.at_winch * (1.0 - b) + after.at_winch * b;
                Resistance {
                    force: -of(&|inertia| inertia.mass * acceleration) - winch * *growth,
                    at_exit: -winch.dot(acceleration) - at_winch * growth,
                }
            };
        self.0[k].iter().zip(&self.0[k + 1]).zip(accelerations).map(one).collect()
    }
}

impl Inertia {
    fn at(robot: &Robot, load: &Load, motion: &Motion) -> Result<Vec<Self>, DynamicsError> {
        /// Share of the slowest cable's frequency at which the inertia is that at rest to its square.
        const LOW: f64 = 0.02;
        let held = inverse(robot, &motion.pose, load)?;
        let problem = DirectProblem::new(robot, &held.lengths, load)?;
        let rest = problem.direct(DirectStart::Near(&held.equilibrium))?.equilibrium;
        let frequencies = problem.cable_frequencies(&rest)?.into_iter().flatten();
        let Some(slowest) = frequencies.min_by(f64::total_cmp) else {
            return Ok(vec![Self::default(); robot.cables.len()]);
        };
        let low = LOW * slowest;
        let response = FrequencyResponse::new(&problem, &rest, low, Damping::default())?;
        let [still, slow] = [0.0, low].map(|frequency| response.of_each_cable(frequency));
        let cables = problem.small_motions(&rest)?.cables;
        let of = |((still, slow), cable): ((Option<_>, Option<_>), &CableAtRest)| {
            still
                .zip(slow)
                .map_or_else(Self::default, |(still, slow)| Self::of_cable(still, slow, cable, low))
        };
        Ok(still?.into_iter().zip(slow?).zip(&cables).map(of).collect())
    }

    /// From what its end answers at rest and slowly, at a frequency [Hz].
    fn of_cable(
        (still, pull): StiffnessAndPull,
        (slow, moved): StiffnessAndPull,
        cable: &CableAtRest,
        frequency: f64,
    ) -> Self {
        let square = (TAU * frequency).powi(2);
        // In amplitudes -ω² is a second derivative, and -L'' that of what a winch takes in:
        // D v = -P δ becomes (K - ω² M) v = -(P_0 + ω² W) δ.
        let mass = (still - slow).map(|value| value.re) / square;
        let winch = (moved - pull).map(|value| value.re) / square;
        let along = outwards(cable);
        let whole = cable.linear_density * cable.catenary.free().unstrained_length;
        Self { mass, winch, at_winch: whole - along.dot(&(mass * along)) - 2.0 * winch.dot(&along) }
    }
}

/// Direction of a cable at its anchor point, away from its exit, in the base frame; zero without a force.
pub(super) fn outwards(cable: &CableAtRest) -> Vector3<f64> {
    let force = cable.catenary.force;
    let along = cable.axes * Vector3::new(force.x, 0.0, force.y);
    along.try_normalize(0.0).unwrap_or_default()
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
            for (i, (cable, inertia)) in platform.cables.iter().zip(&inertia).enumerate() {
                // Translations move the anchor point as the platform.
                let expected: Matrix3<f64> = cable.mass.fixed_view::<3, 3>(0, 0).into();
                let error = (inertia.mass - expected).norm();
                assert!(error <= 2e-3 * expected.norm(), "cable {i}: {error} {}", expected.norm());
                assert_eq!(inertia.winch.norm() > 0.0, density > 0.0);
            }
        }
    }
}
