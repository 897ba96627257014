//! Gravity in any direction: nothing tells a robot from the same robot turned together with gravity.

use crate::common::{alone, caroca, cogiro, observed};
use crate::pulleys::{led, tilted, turned};
use cdpr_robot::{Matrix3, PiecewiseLaw, Pose, Robot, Rotation3, Vector3, Wrench};
use cdpr_statics::batch::Observation;
use cdpr_statics::vibration::{PoseModes, modes_at};
use cdpr_statics::{DirectStart, Load, Observer, Tracker, derivatives, direct, inverse};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn turned_pose(pose: &Pose, rotation: &Rotation3<f64>) -> Pose {
    Pose { position: rotation * pose.position, rotation: rotation * pose.rotation }
}

fn turned_load(load: &Load, rotation: &Rotation3<f64>) -> Load {
    let Wrench { force, moment } = load.wrench;
    Load { wrench: Wrench { force: rotation * force, moment: rotation * moment }, ..*load }
}

/// A base that is a little out of level, one on its side, one upside down, and others.
fn rotations() -> Vec<Rotation3<f64>> {
    let rng = &mut ChaCha8Rng::seed_from_u64(1);
    let mut vector = || Vector3::from_fn(|_, _| rng.random_range(-2.0..2.0));
    let chosen = [
        Vector3::new(0.01, -0.02, 0.3),
        Vector3::x() * std::f64::consts::FRAC_PI_2,
        Vector3::x() * std::f64::consts::PI,
        Vector3::new(1e-9, 0.0, 0.0),
    ];
    chosen.into_iter().chain([vector(), vector(), vector()]).map(Rotation3::new).collect()
}

/// CAROCA and CoGiRo; the same over pulleys with leads; with a law; over pulleys with tilted axes.
fn robots() -> Vec<(Robot, Pose)> {
    let pose = Pose::at(0.6, -0.4, 1.6).moved(Vector3::zeros(), Vector3::new(0.05, -0.08, 0.1));
    let mut with_law = caroca();
    for cable in &mut with_law.cables {
        let stiffness = cable.properties.axial_stiffness();
        let segments = [(0.0, 0.7), (400.0, 1.1)];
        let segments = segments.map(|(tension, ratio)| cdpr_robot::Segment { tension, ratio });
        cable.properties.law = Some(PiecewiseLaw::new(1e-4 * stiffness, &segments).unwrap());
    }
    let at = Pose { position: Vector3::new(1.0, -1.0, 2.0), ..pose };
    vec![
        (caroca(), pose),
        (cogiro(), at),
        (led(caroca(), 0.045, 3.0), pose),
        (with_law, pose),
        (tilted(led(cogiro(), 0.06, 2.0)), at),
    ]
}

fn load() -> Load {
    Load {
        payload: 20.0,
        wrench: Wrench { force: Vector3::new(40.0, -30.0, 10.0), moment: Vector3::new(1.0, 2.0, -1.5) },
    }
}

fn close(found: &[f64], expected: &[f64], relative: f64, what: &str) {
    let size = expected.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= relative * size, "{what}: {found}, {expected}");
    }
}

#[test]
fn natural_frequencies_and_tensions_do_not_depend_on_the_base_frame() {
    for (mut robot, pose) in robots() {
        robot.platform.inertia = Some(Matrix3::from_diagonal(&Vector3::new(4.0, 5.0, 6.0)));
        let level = modes_at(&robot, pose, &load()).unwrap();
        let frequencies =
            |found: &PoseModes| found.modes.iter().map(|mode| mode.frequency).collect::<Vec<_>>();
        for rotation in rotations() {
            let what = format!("{} {:?}", robot.name, rotation.scaled_axis().as_slice());
            let (other, at) = (turned(&robot, &rotation), turned_pose(&pose, &rotation));
            let found = modes_at(&other, at, &turned_load(&load(), &rotation)).unwrap();
            close(&found.equilibrium.tensions(), &level.equilibrium.tensions(), 1e-9, &what);
            close(&frequencies(&found), &frequencies(&level), 1e-8, &what);
        }
    }
}

#[test]
fn a_turned_robot_is_found_from_its_lengths_from_a_pose_nearby() {
    for (robot, pose) in robots() {
        for rotation in rotations() {
            let (robot, pose) = (turned(&robot, &rotation), turned_pose(&pose, &rotation));
            let wanted = inverse(&robot, &pose, &Load::none()).unwrap();
            let start = pose.moved(Vector3::new(0.2, -0.1, 0.1), Vector3::new(0.1, 0.2, -0.1));
            let found = direct(&robot, &wanted.lengths, &Load::none(), DirectStart::Pose(&start)).unwrap();
            let motion = pose.motion_to(&found.equilibrium.pose);
            assert!(motion.norm() < 1e-9, "{}: {motion}", robot.name);
        }
    }
}

#[test]
fn derivatives_turn_with_the_robot() {
    for (robot, pose) in robots() {
        let load = Load { wrench: Wrench { moment: Vector3::zeros(), ..load().wrench }, ..load() };
        let level = derivatives(&robot, &pose, &load).unwrap();
        let rotation = rotations().pop().unwrap();
        let (other, at) = (turned(&robot, &rotation), turned_pose(&pose, &rotation));
        let found = derivatives(&other, &at, &turned_load(&load, &rotation)).unwrap();
        let (level_magnitude, magnitude) = (level.magnitude().unwrap(), found.magnitude().unwrap());
        // What has no direction of the base frame.
        for (column, parameter) in level.inputs.parameters.iter().enumerate() {
            if ["b", "gravity", "tilt"].contains(&parameter.group()) {
                continue;
            }
            let turned = found.inputs.column(*parameter).unwrap();
            let size = level_magnitude[column].abs().max(1e-12);
            assert!(
                (magnitude[turned] - level_magnitude[column]).abs() < 1e-6 * size,
                "{} {parameter}: {} {}",
                robot.name,
                magnitude[turned],
                level_magnitude[column]
            );
        }
    }
}

#[test]
fn the_lanes_observe_turned_robots_as_the_level_one() {
    let rng = &mut ChaCha8Rng::seed_from_u64(7);
    for (robot, pose) in [(caroca(), Pose::at(0.5, 0.2, 1.75)), (cogiro(), Pose::at(0.5, 1.0, 2.0))] {
        let mut level = robot.clone();
        level.gravity = robot.gravity.vector().into();
        let load = Load { wrench: Wrench { moment: Vector3::zeros(), ..load().wrench }, ..load() };
        for rotation in rotations() {
            let other = turned(&robot, &rotation);
            let (at, turned_load) = (turned_pose(&pose, &rotation), turned_load(&load, &rotation));
            let mut deviate = |half: f64| half * rng.random_range(-1.0..1.0);
            for _ in 0..10 {
                let mut row = vec![deviate(5.0), deviate(0.002), deviate(5e9)];
                row.extend((0..24).map(|_| deviate(0.01)));
                let exits: Vec<_> =
                    (0..8).map(|_| Vector3::new(deviate(0.02), deviate(0.02), deviate(0.02))).collect();
                let gravity = Vector3::new(deviate(0.3), deviate(0.3), deviate(0.1));
                let rest: Vec<f64> = (0..11).map(|k| deviate(if k < 3 { 0.01 } else { 10.0 })).collect();
                let of = |rotation: &Rotation3<f64>| -> Vec<f64> {
                    let points = exits.iter().flat_map(|exit| <[f64; 3]>::from(rotation * exit));
                    let gravity: [f64; 3] = (rotation * gravity).into();
                    let row = row.iter().copied().chain(points).chain(rest.iter().copied());
                    row.chain(gravity).collect()
                };
                let observed = |robot: &Robot, pose: &Pose, load: &Load, row: &[f64]| {
                    let observer = Observer::new(robot, pose, load).unwrap();
                    let found = observed::<Observation>(&observer, row).remove(0).unwrap();
                    let alone = alone::<Observation>(&observer, row).unwrap();
                    assert_ne!(found, alone, "left to the scalar models");
                    assert!((found.displacement - alone.displacement).norm() < 1e-12);
                    found
                };
                let expected = observed(&level, &pose, &load, &of(&Rotation3::identity()));
                let found = observed(&other, &at, &turned_load, &of(&rotation));
                let difference = rotation * expected.displacement - found.displacement;
                assert!(difference.norm() < 1e-12, "{}: {difference}", robot.name);
            }
        }
    }
}

#[test]
fn a_turned_robot_is_tracked_as_the_level_one() {
    let level = caroca();
    for rotation in rotations() {
        let other = turned(&level, &rotation);
        let start = inverse(&level, &Pose::at(-1.0, 0.0, 1.5), &Load::none()).unwrap();
        let mut tracker = Tracker::new(&level, &start.lengths, &Load::none(), &start.equilibrium).unwrap();
        let mut begin = start.equilibrium.clone();
        begin.pose = turned_pose(&begin.pose, &rotation);
        let mut along = Tracker::new(&other, &start.lengths, &Load::none(), &begin).unwrap();
        let mut lengths = start.lengths.clone();
        for k in 0..40 {
            lengths[k % 8] += if k % 3 == 0 { 2e-3 } else { -1e-3 };
            let load = Load {
                payload: if k < 20 { 0.0 } else { 30.0 },
                wrench: Wrench { force: Vector3::new(10.0, 5.0, -3.0), moment: Vector3::zeros() },
            };
            let expected = turned_pose(&tracker.update(&lengths, &load).unwrap().pose, &rotation);
            let allocated = allocation_counter::measure(|| {
                along.update(&lengths, &turned_load(&load, &rotation)).unwrap();
            });
            assert_eq!(allocated.count_total, 0, "left to the direct model");
            let motion = along.equilibrium().pose.motion_to(&expected);
            assert!(motion.norm() < 1e-11, "{motion}");
        }
    }
}
