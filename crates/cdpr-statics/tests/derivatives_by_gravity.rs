//! Derivatives by gravity, tilts of pulleys, and at limits, are those of differences.

use crate::common::{caroca, cogiro, ipanema, ring, stadium};
use crate::derivatives::{Case, check, report, with_lead};
use crate::pulleys::{led, turned};
use cdpr_robot::{
    CableEnd, Platform, Pose, Robot, Rotation3, TensionLimits, TensionReference, Vector3, Wrench,
};
use cdpr_statics::{Load, inverse};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

#[test]
fn derivatives_by_tilts_and_gravity_are_those_of_differences() {
    let slanted = Rotation3::new(Vector3::new(0.06, -0.1, 0.4));
    let (level, on_its_side) = (Rotation3::identity(), Rotation3::new(Vector3::new(0.0, 1.4, 0.3)));
    let load = Load {
        payload: 20.0,
        wrench: Wrench { force: Vector3::new(40.0, -30.0, 10.0), moment: Vector3::zeros() },
    };
    for (robot, position) in [(caroca(), [0.6, -0.4, 1.6]), (cogiro(), [1.0, -2.0, 2.0])] {
        for (radius, lead) in [(0.0, 0.0), (0.0, 3.0), (0.045, 3.0)] {
            for rotation in [level, slanted, on_its_side] {
                let robot = if radius > 0.0 {
                    led(robot.clone(), radius, lead)
                } else {
                    with_lead(robot.clone(), lead)
                };
                let robot = turned(&robot, &rotation);
                let pose = Pose { position: rotation * Vector3::from(position), rotation };
                let found = check(&Case { robot: robot.clone(), pose, offsets: vec![0.0; 8], load }).unwrap();
                let turn = rotation.angle().to_degrees();
                let title = format!("{}, {radius} m, lead {lead} m, turned by {turn:.0} degrees", robot.name);
                assert_eq!(found.crossed, 0, "{title}");
                report(&title, &[found]);
            }
        }
    }
}

/// Suspended robots with 6 to 12 cables, steel to rope, light to heavy; centred to near the border of the
/// workspace.
pub(crate) fn random_case(seed: u64) -> Case {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let n = rng.random_range(6..=12);
    let modulus = 10f64.powf(rng.random_range(-1.5..0.5));
    let density = 10f64.powf(rng.random_range(-1.0..0.7));
    let mut cables = ring(n, || rng.random_range(-0.5..0.5));
    for (i, cable) in cables.iter_mut().enumerate() {
        cable.properties.youngs_modulus *= modulus;
        cable.properties.linear_density *= density;
        // In the last cases heavy cables from the ground pull as little as their weight allows.
        if seed >= 100 && i % 3 == 0 {
            cable.exit_point.z = 0.0;
            cable.properties.linear_density *= 4.0;
        }
    }
    let mass = 10f64.powf(rng.random_range(1.0..2.7));
    let robot = Robot {
        name: format!("random robot {seed}"),
        platform: Platform::new(mass, Vector3::new(0.02, -0.01, -0.05)),
        tension_limits: TensionLimits { min: 10f64.powf(rng.random_range(-1.0..1.5)), max: 1e5 },
        cables,
        ..caroca()
    };
    let mut within = |size: f64| Vector3::from_fn(|_, _| rng.random_range(-size..size));
    let pose = Pose::at(0.0, 0.0, 1.5).moved(within(1.5), within(0.1));
    let force = mass * within(1.0);
    let moment = 0.1 * mass * within(1.0);
    let wrench = if seed.is_multiple_of(2) { Wrench::none() } else { Wrench { force, moment } };
    let payload = mass * rng.random_range(0.05..0.5);
    let offset = [0.0, 0.1, 1.0][seed as usize % 3] * mass;
    let offsets = (0..n).map(|_| offset * rng.random_range(-1.0..1.0)).collect();
    Case { robot, pose, offsets, load: Load { payload, wrench } }
}

/// Greatest tensions at exit points and of single cables, on which tensions and set-points rest, and tensions
/// that are preferred.
#[test]
fn derivatives_follow_the_limits_of_single_cables_and_exit_points_and_the_preferred_tensions() {
    let lawful = include_str!("../../../data/robots/caroca-law.json");
    let robots = [
        (caroca(), Pose::at(0.6, -0.4, 1.4), 900.0),
        (Robot::from_json(lawful).unwrap(), Pose::at(0.6, -0.4, 1.4), 900.0),
        (cogiro(), Pose::at(0.5, -0.4, 3.0), 1200.0),
        (ipanema(), Pose::at(0.3, 0.2, 1.5), 600.0),
        (stadium(), Pose::at(-8.0, -4.0, 10.0), 1500.0),
    ];
    // A base out of level, with leads and without.
    let slanted = Rotation3::new(Vector3::new(0.06, -0.1, 0.4));
    let tilted = [0.0, 3.0].map(|lead| {
        let position = slanted * Vector3::new(0.6, -0.4, 1.4);
        (turned(&with_lead(caroca(), lead), &slanted), Pose { position, rotation: slanted }, 900.0)
    });
    let mut all = Vec::new();
    for (mut robot, pose, reference) in robots.into_iter().chain(tilted) {
        robot.tension_reference = Some(TensionReference::All(reference));
        let free = inverse(&robot, &pose, &Load::none()).unwrap();
        let exits = free.equilibrium.exit_tensions(&robot, &free.lengths);
        let order = |sign: f64| {
            (0..exits.len()).max_by(|a, b| (sign * exits[*a]).total_cmp(&(sign * exits[*b]))).unwrap()
        };
        let (tightest, slackest) = (order(1.0), order(-1.0));
        let own = &mut robot.cables[tightest].tension_limits;
        (own.max, own.max_at) = (Some(0.999 * exits[tightest]), Some(CableEnd::Exit));
        robot.cables[slackest].tension_limits.min = Some(1.001 * free.tensions[slackest]);
        let n = exits.len();
        for at in 0..2 {
            let mut offsets = vec![0.0; n];
            // Another set-point is led beyond its limit, at the exit point or at the platform.
            let third = (0..n).find(|i| ![tightest, slackest].contains(i)).unwrap();
            let limited = &mut robot.cables[third].tension_limits;
            limited.max_at = Some([CableEnd::Exit, CableEnd::Anchor][at]);
            limited.max = Some(1.05 * exits[third].max(free.tensions[third]));
            offsets[third] = 0.3 * exits[third];
            offsets[tightest] = -0.01 * exits[tightest];
            let load = Load::payload(0.1 * robot.platform.mass);
            let found = check(&Case { robot: robot.clone(), pose, offsets, load }).unwrap();
            assert_eq!((found.active, found.lowered), (2, 1), "{}", robot.name);
            assert!(found.crossed < found.columns / 10, "{}", robot.name);
            all.push(found);
        }
    }
    report("limits of single cables", &all);
}
