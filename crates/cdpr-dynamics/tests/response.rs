//! The response of platforms that are shaken.

use crate::reference::{number, numbers, pose, robot};
use cdpr_dynamics::{Damping, DynamicsError, FrequencyResponse, LargestInBand, Modes, Wanted};
use cdpr_evidence::accept;
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load, Matrix6, inverse};
use serde_json::Value;
use std::f64::consts::TAU;

const MOTION: &str = include_str!("../../../data/reference/motion.json");

#[test]
fn receptances_without_damping_are_those_of_transfer_matrices() {
    let file: Value = serde_json::from_str(MOTION).unwrap();
    let mut compared = 0;
    for case in file["cases"].as_array().unwrap() {
        let Some(references) = case["receptance"].as_array() else { continue };
        let (robot, lengths) = (robot(case), numbers(&case["unstrained_lengths"]));
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let rest = problem.direct(DirectStart::Pose(&pose(case))).unwrap().equilibrium;
        let bound = number(&case["bound_hz"]);
        let response = FrequencyResponse::new(&problem, &rest, bound, Damping::default()).unwrap();
        for reference in references {
            let found = response.at(number(&reference["frequency_hz"])).unwrap().per_wrench;
            let expected = &reference["receptance"];
            let size = expected.as_array().unwrap().len();
            let entry = |i: usize, j: usize| if i < size && j < size { number(&expected[i][j]) } else { 0.0 };
            let expected = Matrix6::from_fn(entry);
            let error = (found.map(|value| value.re) - expected).norm() / expected.norm();
            let imaginary = found.map(|value| value.im).norm();
            accept("V-MOTION-005", error);
            assert_eq!(imaginary, 0.0, "{}", case["name"]);
            compared += 1;
        }
    }
    assert!(compared >= 9, "{compared}");
}

/// Robots, a pose each, and a frequency above that of the platform [Hz].
const ROBOTS: [(&str, [f64; 3], f64); 6] = [
    (include_str!("../../../data/robots/caroca.json"), [0.4, 0.3, 1.75], 20.0),
    (include_str!("../../../data/robots/cogiro.json"), [0.5, 0.2, 2.0], 10.0),
    (include_str!("../../../data/robots/fast.json"), [0.0, 0.0, 140.0], 1.0),
    (include_str!("../../../data/robots/ipanema-1.json"), [0.3, 0.2, 1.1], 10.0),
    (include_str!("../../../data/robots/ipanema-3.json"), [0.5, 0.2, 1.5], 20.0),
    (include_str!("../../../data/robots/hrpcables.json"), [0.0, 0.0, 1.5], 10.0),
];

#[test]
fn slow_shaking_moves_a_platform_as_the_static_models_say() {
    for (file, [x, y, z], highest) in ROBOTS {
        for lead in [0.0, 2.0] {
            let mut robot = Robot::from_json(file).unwrap();
            robot.platform.inertia = Some(robot.platform.inertia.unwrap_or_else(|| robot.assumed_inertia()));
            if lead > 0.0 {
                robot.cables.iter_mut().for_each(|cable| cable.lead = lead);
            }
            let Ok(held) = inverse(&robot, &Pose::at(x, y, z), &Load::none()) else {
                panic!("{} is not held", robot.name)
            };
            let problem = DirectProblem::new(&robot, &held.lengths, &Load::none()).unwrap();
            let rest = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap().equilibrium;
            let damping = Damping { stretch: 2e-4, drag: 0.1 };
            let response = FrequencyResponse::new(&problem, &rest, highest, damping).unwrap();
            let still = response.at(0.0).unwrap();
            let linear = problem.linearize(&rest).unwrap();
            let expected = -linear.pose_per_length();
            let found = still.per_shortening.map(|value| value.re);
            let error = (&found - &expected).norm() / expected.norm();
            println!("{} with leads of {lead} m: {error:.1e}", robot.name);
            assert!(error < 1e-8, "{}: {error:e} {found} {expected}", robot.name);
            let identity = still.per_wrench.map(|value| value.re) * linear.stiffness();
            assert!((identity - Matrix6::identity()).norm() < 1e-6, "{}: {identity}", robot.name);
            // Damping takes energy out of every motion.
            for share in [0.1, 0.37, 0.7, 1.0] {
                let at = response.at(share * highest).unwrap();
                let dissipated = at.per_wrench.map(|value| -value.im).symmetric_eigenvalues();
                assert!(dissipated.min() > -1e-9 * dissipated.max(), "{}: {dissipated}", robot.name);
            }
        }
    }
}

#[test]
fn a_mass_on_one_light_cable_is_a_damped_oscillator() {
    let file: Value = serde_json::from_str(MOTION).unwrap();
    let cases = file["cases"].as_array().unwrap();
    let case = cases.iter().find(|case| case["name"] == "hanging cable with a point mass of 5 kg").unwrap();
    let mut robot = robot(case);
    robot.cables[0].properties.linear_density = 0.0;
    let lengths = numbers(&case["unstrained_lengths"]);
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let rest = problem.direct(DirectStart::Pose(&pose(case))).unwrap().equilibrium;
    let (tau, mass) = (1e-3, robot.platform.mass);
    let damping = Damping { stretch: tau, drag: 0.0 };
    let stiffness = number(&case["axial_stiffness"][0]) / lengths[0];
    let natural = (stiffness / mass).sqrt() / TAU;
    let response = FrequencyResponse::new(&problem, &rest, 2.0 * natural, damping).unwrap();
    for frequency in [0.2 * natural, natural, 1.7 * natural] {
        let omega = TAU * frequency;
        let expected =
            nalgebra::Complex::new(stiffness - mass * omega * omega, stiffness * omega * tau).inv();
        let found = response.at(frequency).unwrap().per_wrench[(2, 2)];
        assert!((found - expected).norm() < 1e-9 * expected.norm(), "{frequency}: {found} {expected}");
    }
}

#[test]
fn the_response_is_greatest_at_natural_frequencies_and_a_point_moves_with_the_platform() {
    let robot = Robot::from_json(ROBOTS[1].0).unwrap();
    let held = inverse(&robot, &Pose::at(0.5, 0.2, 2.0), &Load::none()).unwrap();
    let problem = DirectProblem::new(&robot, &held.lengths, &Load::none()).unwrap();
    let rest = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap().equilibrium;
    let modes = Modes::new(&problem, &rest, Wanted::OfPlatform).unwrap();
    let platform = modes.of_platform().unwrap();
    let damping = Damping { stretch: 2e-4, drag: 0.05 };
    let response = FrequencyResponse::new(&problem, &rest, 10.0, damping).unwrap();
    let size = |frequency: f64| response.at(frequency).unwrap().per_wrench.norm();
    let at = |share: f64| size(share * platform.frequency);
    assert!(
        at(1.0) > 2.0 * at(0.995) && at(1.0) > 2.0 * at(1.005),
        "{} {} {}",
        at(0.995),
        at(1.0),
        at(1.005)
    );
    let found = response.at(4.7).unwrap();
    let lever = Vector3::new(0.3, -0.2, 0.5);
    let (per_force, per_shortening) = found.at_point(&lever);
    // A force at the point is a force and its moment about P.
    let force = Vector3::new(1.0, 2.0, -3.0);
    let moment = lever.cross(&force);
    let wrench = nalgebra::Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
    let motion = found.per_wrench * wrench.map(|value| nalgebra::Complex::new(value, 0.0));
    let turn = Vector3::new(motion[3].re, motion[4].re, motion[5].re);
    let expected = Vector3::new(motion[0].re, motion[1].re, motion[2].re) + turn.cross(&lever);
    let moved = (per_force * force.map(|value| nalgebra::Complex::new(value, 0.0))).map(|value| value.re);
    assert!((moved - expected).norm() < 1e-12 * expected.norm());
    assert_eq!(per_shortening.ncols(), 8);
    let refused = FrequencyResponse::new(&problem, &rest, 10.0, Damping { stretch: -1.0, drag: 0.0 });
    assert!(matches!(refused, Err(DynamicsError::Invalid { field: "damping", .. })));
    assert!(matches!(response.at(11.0), Err(DynamicsError::Invalid { field: "frequency", .. })));
}

#[test]
fn the_largest_amplitude_of_an_oscillator_is_that_of_its_formula() {
    let file: Value = serde_json::from_str(MOTION).unwrap();
    let cases = file["cases"].as_array().unwrap();
    let case = cases.iter().find(|case| case["name"] == "hanging cable with a point mass of 5 kg").unwrap();
    let mut robot = robot(case);
    robot.cables[0].properties.linear_density = 0.0;
    let lengths = numbers(&case["unstrained_lengths"]);
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let rest = problem.direct(DirectStart::Pose(&pose(case))).unwrap().equilibrium;
    let stiffness = number(&case["axial_stiffness"][0]) / lengths[0];
    let (mass, natural) = (robot.platform.mass, (stiffness / robot.platform.mass).sqrt());
    for share in [1e-4, 0.1, 0.3] {
        // |k - m ω² + i k ω τ| is least where ω² = k/m - (k τ/m)²/2.
        let tau = share / natural;
        let square = natural * natural * (1.0 - 0.5 * share * share);
        let least = (stiffness - mass * square).hypot(stiffness * tau * square.sqrt());
        let damping = Damping { stretch: tau, drag: 0.0 };
        let band = [0.8 * natural / TAU, 1.5 * natural / TAU];
        let found = LargestInBand::new(&problem, &rest, band, damping, &Vector3::zeros()).unwrap();
        assert!((found.per_force.amplitude * least - 1.0).abs() < 1e-6, "{share}: {found:?} {least}");
        assert!((found.per_force.frequency * TAU / square.sqrt() - 1.0).abs() < 1e-3, "{share}: {found:?}");
        // The winch pulls at the other end of the spring, which is stiff and damped alike.
        let pull = stiffness * (share * square.sqrt() / natural).hypot(1.0);
        assert!((found.per_shortening.amplitude * least / pull - 1.0).abs() < 0.3, "{share}: {found:?}");
    }
    let undamped = Damping::default();
    let band = [0.8 * natural / TAU, 1.5 * natural / TAU];
    let refused = LargestInBand::new(&problem, &rest, band, undamped, &Vector3::zeros());
    assert!(matches!(refused, Err(DynamicsError::Resonance { .. })), "{refused:?}");
    let below = [0.5 * natural / TAU, 0.8 * natural / TAU];
    let found = LargestInBand::new(&problem, &rest, below, undamped, &Vector3::zeros()).unwrap();
    assert!(found.per_force.amplitude > 0.0);
    for band in [[2.0, 1.0], [-1.0, 1.0], [0.0, f64::NAN], [f64::NAN, 1.0]] {
        let refused = LargestInBand::new(&problem, &rest, band, undamped, &Vector3::zeros());
        assert!(matches!(refused, Err(DynamicsError::Invalid { .. })), "{band:?}: {refused:?}");
    }
}

#[test]
fn no_frequency_of_a_fine_grid_shakes_a_platform_more_than_the_largest_amplitude() {
    for (file, [x, y, z], highest) in ROBOTS {
        let mut robot = Robot::from_json(file).unwrap();
        robot.platform.inertia = Some(robot.platform.inertia.unwrap_or_else(|| robot.assumed_inertia()));
        let held = inverse(&robot, &Pose::at(x, y, z), &Load::none()).unwrap();
        let problem = DirectProblem::new(&robot, &held.lengths, &Load::none()).unwrap();
        let rest = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap().equilibrium;
        let (damping, marker) = (Damping { stretch: 1e-3, drag: 0.3 }, Vector3::new(0.1, -0.2, 0.3));
        let band = [0.1 * highest, 0.5 * highest];
        let found = LargestInBand::new(&problem, &rest, band, damping, &marker).unwrap();
        let response = FrequencyResponse::new(&problem, &rest, band[1], damping).unwrap();
        let lever = rest.pose.rotation * marker;
        let at = |frequency: f64| {
            let found = response.at(frequency).unwrap();
            let (_, winches) = found.at_point(&lever);
            let winches = winches.column_iter().map(|column| column.norm()).collect::<Vec<_>>();
            (found.by_force(&lever), winches)
        };
        let (mut force, mut winch) = (0.0_f64, 0.0_f64);
        const POINTS: usize = 500;
        for k in 0..=POINTS {
            let (by_force, by_winches) = at(band[0] + (band[1] - band[0]) * k as f64 / POINTS as f64);
            force = force.max(by_force);
            winch = by_winches.into_iter().fold(winch, f64::max);
        }
        let (by_force, _) = at(found.per_force.frequency);
        let (_, by_winches) = at(found.per_shortening.frequency);
        println!("{}: {found:?}, of the grid {force} {winch}", robot.name);
        assert!((found.per_force.amplitude / by_force - 1.0).abs() < 1e-12);
        assert!((found.per_shortening.amplitude / by_winches[found.winch] - 1.0).abs() < 1e-12);
        assert!(found.per_force.amplitude >= force * (1.0 - 1e-9), "{}: {force}", robot.name);
        assert!(found.per_shortening.amplitude >= winch * (1.0 - 1e-9), "{}: {winch}", robot.name);
    }
}
