//! Robots on a path, with a load that the observer does not know.

use cdpr_robot::library::{ROBOTS, named};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{DirectStart, Load, direct, inverse};

pub(crate) fn robot(name: &str) -> Robot {
    Robot::from_json(named(ROBOTS, name).unwrap().text).unwrap()
}

/// The same robot whose platform carries a load with its centre at `center` [m] from that of the platform,
/// and whose modulus is another one.
pub(crate) fn loaded(robot: &Robot, mass: f64, center: Vector3<f64>, modulus: f64) -> Robot {
    let mut loaded = robot.clone();
    let platform = &mut loaded.platform;
    platform.center_of_mass += center * (mass / (platform.mass + mass));
    platform.mass += mass;
    loaded.cables.iter_mut().for_each(|cable| cable.properties.youngs_modulus *= modulus);
    loaded
}

/// Number of poses of a path, which is followed back and forth.
pub(crate) const POSES: usize = 100;

/// A path of a robot: lengths of each pose, and what the model of the true robot says of them.
pub(crate) struct Followed {
    pub(crate) lengths: Vec<Vec<f64>>,
    pub(crate) poses: Vec<Pose>,
    pub(crate) tensions: Vec<Vec<f64>>,
}

/// A path with steps of this size [m] and a tilt [rad] at its end, from a pose that the robot holds.
pub(crate) fn follow(nominal: &Robot, truth: &Robot, start: [f64; 3], [step, tilt]: [f64; 2]) -> Followed {
    let [x, y, z] = start;
    let (mut lengths, mut poses, mut tensions) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..POSES {
        let s = k as f64 / POSES as f64;
        let along = POSES as f64 * step * s;
        let mut pose = Pose::at(x + along, y + 0.5 * along * (3.0 * s).sin(), z + 0.3 * along);
        if nominal.is_fully_actuated() {
            pose = pose.moved(Vector3::zeros(), tilt * s * Vector3::new(1.0, -0.5, 0.3));
        }
        let own = if nominal.is_fully_actuated() {
            inverse(nominal, &pose, &Load::none()).unwrap().lengths
        } else {
            // Straight cables to the pose; the platform finds its own tilt.
            (0..nominal.cables.len()).map(|i| nominal.span(&pose, i).norm()).collect()
        };
        let near = poses.last().copied().unwrap_or(pose);
        let found = direct(truth, &own, &Load::none(), DirectStart::Pose(&near)).unwrap();
        tensions.push(found.equilibrium.tensions());
        poses.push(found.equilibrium.pose);
        lengths.push(own);
    }
    Followed { lengths, poses, tensions }
}

/// Index of sample k on the way forth and back.
pub(crate) fn index(k: usize) -> usize {
    let along = k % (2 * POSES - 2);
    if along < POSES { along } else { 2 * POSES - 2 - along }
}
