//! Robots of several tests, and poses that they hold.

use cdpr_calibration::{Noise, Simulated};
use cdpr_robot::{CableEnd, Coordinate, Parameter, Pose, Robot, Vector3};
use cdpr_statics::free_coordinates::free_solutions;
use cdpr_statics::{Load, WantedPose};
use cdpr_study::ErrorModel;

pub(crate) fn caroca() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap()
}

/// A robot to be calibrated, its tolerances and the centre and size of the region in which it is measured.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) robot: Robot,
    pub(crate) stds: Vec<f64>,
    pub(crate) center: Vector3<f64>,
    pub(crate) half: Vector3<f64>,
    pub(crate) tilt: f64,
    pub(crate) free: Vec<Coordinate>,
}

impl Case {
    fn new(
        name: &'static str,
        text: &str,
        (points, mass): (f64, f64),
        (center, half, tilt): ([f64; 3], [f64; 3], f64),
        free: &[Coordinate],
    ) -> Self {
        let mut robot = Robot::from_json(text).unwrap();
        // Its six cables hold few level poses with the tensions that the file asks for.
        robot.tension_limits.min = robot.tension_limits.min.min(2e4);
        let of = |parameter: &Parameter| match parameter.group() {
            "a" | "b" => points,
            "mass" => mass * robot.platform.mass,
            "youngs_modulus" => 0.05 * parameter.nominal(&robot),
            "r" => 0.02 * parameter.nominal(&robot),
            _ => 0.0,
        };
        let stds = Parameter::of(&robot).iter().map(of).collect();
        let free = free.to_vec();
        Self { name, robot, stds, center: center.into(), half: half.into(), tilt, free }
    }

    pub(crate) fn model(&self) -> ErrorModel {
        ErrorModel::normal(&self.robot, &self.stds)
    }

    /// The same with another region.
    pub(crate) fn within(&self, half: Vector3<f64>) -> Self {
        let (robot, stds, free) = (self.robot.clone(), self.stds.clone(), self.free.clone());
        Self { half, robot, stds, free, ..*self }
    }

    /// A campaign without load and without errors of sensors.
    pub(crate) fn simulated<'a>(
        &'a self,
        deviations: &'a [f64],
        poses: &'a [Pose],
        noise: Noise,
        seed: u64,
    ) -> Simulated<'a> {
        Simulated {
            nominal: &self.robot,
            deviations,
            poses,
            free: &self.free,
            load: Load::none(),
            noise,
            markers: &[],
            errors: &[],
            tension_at: CableEnd::Anchor,
            seed,
        }
    }

    /// Poses over the region, by a Halton sequence: position and small rotations.
    pub(crate) fn poses(&self, count: usize) -> Vec<Pose> {
        let halton = |mut k: usize, base: usize| {
            let (mut share, mut value) = (1.0, 0.0);
            while k > 0 {
                share /= base as f64;
                value += share * (k % base) as f64;
                k /= base;
            }
            2.0 * value - 1.0
        };
        // A cable without weight that becomes slack tells nothing about its length.
        let is_taut = |pose: &Pose| {
            let held = || free_solutions(&self.robot, WantedPose::at(pose).free(&self.free), &Load::none());
            let least = 0.05 * self.robot.weight(pose, 0.0).force.norm();
            self.free.is_empty() || held().is_ok_and(|held| held.first.tensions.iter().all(|t| *t > least))
        };
        (1..)
            .map(|k| {
                let at = |base| halton(k, base);
                let offset = Vector3::new(at(2), at(3), at(5)).component_mul(&self.half);
                let turn = Vector3::new(at(7), at(11), at(13)) * self.tilt;
                Pose::at(0.0, 0.0, 0.0).moved(self.center + offset, turn)
            })
            .filter(is_taut)
            .take(count)
            .collect()
    }
}

/// CAROCA, CoGiRo, IPAnema with pulleys, FAST, GRAB with four cables.
pub(crate) fn cases() -> [Case; 5] {
    use Coordinate::{Pitch, Roll};
    [
        Case::new(
            "CAROCA",
            include_str!("../../../data/robots/caroca.json"),
            (2e-3, 0.01),
            ([0.0, 0.0, 1.9], [2.0, 1.0, 0.7], 0.1),
            &[],
        ),
        Case::new(
            "CoGiRo",
            include_str!("../../../data/robots/cogiro.json"),
            (2e-3, 0.01),
            ([0.0, 0.0, 2.0], [3.0, 2.0, 0.8], 0.1),
            &[],
        ),
        Case::new(
            "IPAnema",
            include_str!("../../../data/robots/ipanema-3.json"),
            (2e-3, 0.01),
            ([0.0, 0.0, 1.3], [2.0, 2.0, 0.5], 0.1),
            &[],
        ),
        Case::new(
            "FAST",
            include_str!("../../../data/robots/fast.json"),
            (2e-2, 0.01),
            ([0.0, 0.0, 140.0], [40.0, 40.0, 10.0], 0.0),
            &[],
        ),
        Case::new(
            "GRAB",
            include_str!("../../../data/robots/grab.json"),
            (2e-3, 0.01),
            ([1.25, -0.19, -0.9], [0.2, 0.25, 0.15], 0.03),
            &[Roll, Pitch],
        ),
    ]
}

/// Pose by a tracker, lengths by the winches.
pub(crate) const EXTERNAL: Noise = Noise {
    position: Some(1e-4),
    rotation: Some(1e-4),
    length: Some(1e-4),
    tension: None,
    displacement: None,
    marker: None,
    swivel: None,
};
