//! Random robots, each held at a pose by tensions that were drawn.

use cdpr_robot::{
    CableEnd, CableProperties, Platform, Pose, Robot, RobotCable, Rotation3, TensionLimits, Vector3, Wrench,
};
use cdpr_statics::{Load, lengths_for_tensions};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A robot held at a pose by tensions that were drawn: the load balances them.
pub(crate) struct Drawn {
    pub(crate) robot: Robot,
    pub(crate) pose: Pose,
    pub(crate) load: Load,
    /// Tensions at the platform [N].
    pub(crate) tensions: Vec<f64>,
}

fn log_uniform(rng: &mut ChaCha8Rng, from: f64, to: f64) -> f64 {
    from * (to / from).powf(rng.random::<f64>())
}

fn in_cube(rng: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0))
}

/// Robots of 1 m to 300 m with 6 to 16 cables, suspended or held from all sides, straight or sagging nearly
/// as much as the taut branch allows, some without gravity, some prestressed by far more than their weight.
pub(crate) fn drawn(seed: u64) -> Option<Drawn> {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let n = rng.random_range(6..=16);
    let size = log_uniform(rng, 1.0, 300.0);
    let platform = size * log_uniform(rng, 0.02, 0.3);
    let level = log_uniform(rng, 10.0, 1e4);
    let gravity = if rng.random_bool(0.1) { 0.0 } else { 9.81 };
    let suspended = rng.random_bool(0.5);
    // Weight of a cable over its tension: none to more than the taut branch allows for the longest.
    let sag = if rng.random_bool(0.2) { 0.0 } else { log_uniform(rng, 1e-5, 1.0) };
    let properties = CableProperties {
        section: 1e-5,
        linear_density: sag * level / (size * 9.81),
        youngs_modulus: level / log_uniform(rng, 1e-5, 1e-2) / 1e-5,
        diameter: None,
        breaking_force: None,
        law: None,
    };
    let cables = (0..n)
        .map(|_| {
            let mut exit_point = in_cube(rng) * size;
            if suspended {
                exit_point.z = size;
            }
            RobotCable::between(exit_point, in_cube(rng) * platform, properties.clone())
        })
        .collect();
    let mass = level / 9.81 * log_uniform(rng, 1e-4, 10.0);
    let limits = TensionLimits { min: 0.2 * level, max: 5.0 * level };
    let robot = Robot {
        name: "drawn".to_owned(),
        provenance: Default::default(),
        gravity: gravity.into(),
        platform: Platform::new(mass, in_cube(rng) * platform),
        tension_limits: limits,
        max_at: CableEnd::Anchor,
        ground_z: None,
        plane: None,
        tension_reference: None,
        distribution: Default::default(),
        cables,
    };
    robot.validate().ok()?;
    let rotation = Rotation3::new(in_cube(rng) * 0.5);
    let pose = Pose { position: in_cube(rng) * (0.4 * size), rotation };
    let tensions: Vec<f64> = (0..n).map(|_| log_uniform(rng, limits.min, limits.max)).collect();
    let held = lengths_for_tensions(&robot, &pose, &tensions).ok()?;
    let tensions = held.equilibrium.tensions();
    // Beyond the greatest tension the drawn ones prove nothing.
    if tensions.iter().any(|t| *t > limits.max) {
        return None;
    }
    let mut wrench = robot.weight(&pose, 0.0);
    for (i, force) in held.equilibrium.cable_forces.iter().enumerate() {
        let r = robot.span(&pose, i);
        let azimuth = Vector3::new(r.x, r.y, 0.0).normalize();
        let pull = -(azimuth * force.x + Vector3::z() * force.y);
        wrench = wrench + Wrench::of_force_at(&robot.anchor_arm(&pose, i), pull);
    }
    let load = Load::wrench(Wrench { force: -wrench.force, moment: -wrench.moment });
    Some(Drawn { robot, pose, load, tensions })
}
