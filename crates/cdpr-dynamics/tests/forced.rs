//! The response to a force in the worst direction, at rest, and over pulleys with tilted axes.

use cdpr_dynamics::{Damping, DynamicsError, FrequencyResponse, LargestInBand, Modes, Response, Wanted};
use cdpr_robot::{Coordinate, Pose, Pulley, Robot, Vector3, Wrench};
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, Matrix6, Unstable, WantedPose, inverse};
use nalgebra::Matrix3;
use std::f64::consts::TAU;

/// The lengths and the rest of a robot at a pose.
fn rest(robot: &Robot, pose: &Pose, free: &[Coordinate], load: &Load) -> (Vec<f64>, Equilibrium) {
    let held = inverse(robot, WantedPose::at(pose).free(free), load).unwrap();
    let problem = DirectProblem::new(robot, &held.lengths, load).unwrap();
    let start = DirectStart::Near(&held.equilibrium);
    let rest = problem.with_unstable(Unstable::Accepted).direct(start).unwrap().equilibrium;
    (held.lengths, rest)
}

fn library(name: &str) -> Robot {
    let mut robot = Robot::from_library(name).unwrap();
    robot.platform.inertia = Some(robot.platform.inertia.unwrap_or_else(|| robot.assumed_inertia()));
    robot
}

/// The largest norm of the complex motion over many directions of a unit force.
fn by_directions(found: &Response, lever: &Vector3<f64>) -> f64 {
    let (per_force, _) = found.at_point(lever);
    const STEPS: usize = 300;
    let angle = |k: usize| std::f64::consts::PI * k as f64 / STEPS as f64;
    let directions = (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (angle(i), angle(j))));
    let moved = |(polar, azimuth): (f64, f64)| {
        let [sine, cosine] = [polar.sin(), polar.cos()];
        let u = Vector3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine);
        (per_force * u.map(|part| nalgebra::Complex::new(part, 0.0))).norm()
    };
    directions.map(moved).fold(0.0, f64::max)
}

#[test]
fn the_worst_direction_is_a_direction() {
    let robot = library("four-cables");
    let (free, pose) = ([Coordinate::Roll, Coordinate::Pitch], Pose::at(0.4, 0.24, 3.0));
    let (lengths, rest) = rest(&robot, &pose, &free, &Load::none());
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let damping = Damping { stretch: 2e-4, drag: 0.5 };
    let response = FrequencyResponse::new(&problem, &rest, 8.0, damping).unwrap();
    let lever = Vector3::zeros();
    let mut less = 0;
    for frequency in [0.5, 2.0, 3.7, 5.8, 7.9] {
        let found = response.at(frequency).unwrap();
        let (amplitude, sampled) = (found.by_force(&lever), by_directions(&found, &lever));
        assert!((0.0..1e-3).contains(&(amplitude / sampled - 1.0)), "{frequency}: {amplitude} {sampled}");
        // Forces whose direction turns would move it more.
        let turning = found.at_point(&lever).0.singular_values().max();
        assert!(amplitude <= turning * (1.0 + 1e-12));
        less += usize::from(amplitude < 0.95 * turning);
    }
    assert!(less > 0);
}

/// Robots on pulleys whose axes are tilted.
fn tilted() -> [(Robot, Pose, Vec<Coordinate>); 3] {
    let mut hrpcables = library("hrpcables");
    hrpcables.cables.iter_mut().for_each(|cable| {
        cable.pulley = cable.pulley.map(|pulley| Pulley { axis: Vector3::x(), ..pulley });
    });
    let two = vec![Coordinate::Roll, Coordinate::Pitch];
    [
        (hrpcables, Pose::at(0.2, 0.1, 0.8), Vec::new()),
        (library("irma4u"), Pose::at(0.11, 0.06, 1.31), two.clone()),
        (library("grab"), Pose::at(1.29, -0.11, 0.0), two),
    ]
}

#[test]
fn platforms_on_tilted_wheels_move_slowly_as_the_static_models_say_and_most_at_natural_frequencies() {
    for (robot, pose, free) in tilted() {
        let (lengths, rest) = rest(&robot, &pose, &free, &Load::none());
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let modes = Modes::new(&problem, &rest, Wanted::OfPlatform).unwrap();
        let natural = modes.of_platform().unwrap().frequency;
        let damping = Damping { stretch: 1e-6, drag: 1e-4 };
        let response = FrequencyResponse::new(&problem, &rest, 1.01 * natural, damping).unwrap();
        let still = response.at(0.0).unwrap();
        let linear = problem.linearize(&rest).unwrap();
        let expected = linear.stiffness().try_inverse().unwrap();
        let error = (still.per_wrench.map(|value| value.re) - expected).norm() / expected.norm();
        assert!(error < 1e-9, "{}: {error:e}", robot.name);
        let expected = -linear.pose_per_length();
        let error = (still.per_shortening.map(|value| value.re) - &expected).norm() / expected.norm();
        println!("{}: {error:.1e}", robot.name);
        assert!(error < 1e-8, "{}: {error:e}", robot.name);
        let size = |share: f64| response.at(share * natural).unwrap().per_wrench.norm();
        for share in [1.0 - 1e-6, 1.0 + 1e-6, 0.999, 1.001] {
            assert!(size(1.0) > size(share), "{} {share}: {} {}", robot.name, size(1.0), size(share));
        }
    }
}

#[test]
fn slow_forces_move_a_platform_under_a_moment_as_its_whole_stiffness_says() {
    let robot = library("hrpcables");
    let wrench = Wrench { moment: Vector3::new(2.0, 1.0, 2.0), ..Wrench::none() };
    let load = Load { wrench, ..Load::none() };
    let (lengths, rest) = rest(&robot, &Pose::at(0.2, 0.1, 0.8), &[], &load);
    let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
    let response = FrequencyResponse::new(&problem, &rest, 1.0, Damping::USUAL).unwrap();
    let still = response.at(0.0).unwrap();
    let linear = problem.linearize(&rest).unwrap();
    let expected = linear.stiffness().try_inverse().unwrap();
    let error = |of: &Matrix6<f64>| (still.per_wrench.map(|value| value.re) - of).norm() / of.norm();
    assert!(error(&expected) < 1e-9, "{:e}", error(&expected));
    assert!(error(&linear.symmetric_stiffness().try_inverse().unwrap()) > 1e-6);
    let expected = -linear.pose_per_length();
    let found = still.per_shortening.map(|value| value.re);
    assert!((&found - &expected).norm() < 1e-8 * expected.norm());
}

/// A body on one cable without mass: a double pendulum that turns about the cable as it likes.
fn pendulum() -> Robot {
    let mut robot = Robot::from_json(
        r#"{"format":"cdpr-robot/1","name":"p","gravity":9.81,"platform":{"mass":5,"center_of_mass":[0,0,0],
        "inertia":[[0.3,0,0],[0,0.5,0],[0,0,0.7]]},
        "cable":{"diameter":0.004,"section":8e-6,"linear_density":0.06,"youngs_modulus":1e11},
        "tension_limits":{"min":1,"max":5000},
        "cables":[{"exit_point":[0,0,5],"anchor_point":[0,0,0.4]}]}"#,
    )
    .unwrap();
    robot.cables[0].properties.linear_density = 0.0;
    robot
}

const PENDULUM: [Coordinate; 5] =
    [Coordinate::X, Coordinate::Y, Coordinate::Roll, Coordinate::Pitch, Coordinate::Yaw];

#[test]
fn a_force_at_rest_moves_a_hook_as_far_as_what_resists_lets_it() {
    let robot = pendulum();
    let (lengths, rest) = rest(&robot, &Pose::at(0.0, 0.0, 1.6), &PENDULUM, &Load::none());
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let response = FrequencyResponse::new(&problem, &rest, 3.0, Damping::USUAL).unwrap();
    let still = response.at(0.0).unwrap();
    assert_eq!(still.neutral.len(), 1);
    let (per_force, _) = still.at_point(&Vector3::zeros());
    let expected = 3.4 / (5.0 * 9.81);
    let found = per_force.map(|entry| entry.re);
    let stretch = 3.0 / 8e5;
    let expected = Matrix3::from_diagonal(&Vector3::new(expected, expected, stretch));
    assert!((found - expected).norm() < 1e-4 * expected.norm(), "{found}");
    assert!((found[(0, 0)] / found[(1, 1)] - 1.0).abs() < 1e-9 && found[(0, 1)].abs() < 1e-9);
    // Slow forces move it as those at rest.
    let slow = response.at(1e-5).unwrap().at_point(&Vector3::zeros()).0.map(|entry| entry.re);
    assert!((slow - found).norm() < 1e-7 * found.norm(), "{slow} {found}");
    // A point off the axis runs away under forces across its lever alone.
    let lever = Vector3::new(0.2, 0.0, 0.0);
    let (per_force, _) = still.at_point(&lever);
    let slow = response.at(1e-5).unwrap().at_point(&lever).0.map(|entry| entry.re);
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        let entry = per_force[(i, j)];
        if (i, j) == (1, 1) {
            assert!(entry.re == f64::INFINITY && slow[(i, j)].abs() > 1e3);
        } else {
            assert!((entry.re - slow[(i, j)]).abs() < 1e-6 * found.norm(), "{per_force} {slow}");
        }
    }
    assert_eq!(still.by_force(&lever), f64::INFINITY);
    let size = |marker: Vector3<f64>, from: f64| {
        LargestInBand::new(&problem, &rest, [from, 0.1], Damping::USUAL, &marker)
    };
    assert!(size(Vector3::zeros(), 0.0).unwrap().per_force.amplitude >= found[(0, 0)]);
    assert!(size(lever, 0.01).is_ok());
    assert!(matches!(size(lever, 0.0), Err(DynamicsError::Resonance { frequency: 0.0 })));
}

#[test]
fn a_pendulum_shakes_as_its_formula_says() {
    let robot = pendulum();
    let (lengths, rest) = rest(&robot, &Pose::at(0.0, 0.0, 1.6), &PENDULUM, &Load::none());
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let response = FrequencyResponse::new(&problem, &rest, 3.0, Damping::default()).unwrap();
    let (mass, weight) = (5.0, 5.0 * 9.81);
    for (k, inertia) in [(0, 0.5), (1, 0.3)] {
        for frequency in [0.0, 0.1, 0.2, 0.5, 2.0] {
            let square = (TAU * frequency).powi(2);
            // The end of a cable of length L at a, x = a + h φ; the body turns by φ below it.
            let (length, below) = (3.0 + 0.0, 0.4);
            let d = nalgebra::Matrix2::new(
                weight / length - mass * square,
                -mass * square * -below,
                -mass * square * -below,
                weight * below - (inertia + mass * below * below) * square,
            );
            let force = nalgebra::Vector2::new(1.0, -below);
            let expected = force.dot(&(d.try_inverse().unwrap() * force));
            let found = response.at(frequency).unwrap().at_point(&Vector3::zeros()).0[(k, k)].re;
            assert!((found / expected - 1.0).abs() < 2e-4, "{k} {frequency}: {found} {expected}");
        }
    }
}
