//! Natural motions on winches whose rotors yield.

use crate::reference::{number, numbers, pose, robot, vector};
use crate::robots;
use cdpr_dynamics::{DynamicsError, Modes, MovingPlatform, Rotor, Wanted};
use cdpr_robot::{Pose, Robot, Vector3, Wrench};
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, Matrix6, Vector6, inverse};
use serde_json::Value;
use std::f64::consts::TAU;

fn rotor(mass: f64, stiffness: f64) -> Option<Rotor> {
    Some(Rotor { mass, stiffness })
}

/// By `winches.py`, which shares no code with this project.
#[test]
fn one_cable_on_a_winch_that_yields_vibrates_as_another_program_says() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/winches.json")).unwrap();
    let (mut compared, mut worst) = (0, 0.0_f64);
    for case in file["cases"].as_array().unwrap() {
        let (robot, lengths) = (robot(case), numbers(&case["unstrained_lengths"]));
        let wrench = Wrench { force: vector(&case["force"]), moment: Vector3::zeros() };
        let load = Load { payload: 0.0, wrench };
        let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
        let rest = problem.direct(DirectStart::Pose(&pose(case))).unwrap().equilibrium;
        let off = (rest.pose.position - vector(&case["position"])).norm();
        assert!(off < 1e-9, "{}: {off:e}", case["name"]);
        let winch = rotor(number(&case["winch_mass"]), number(&case["winch_stiffness"]));
        let wanted = Wanted::Below(number(&case["bound_hz"]));
        let found = Modes::on_winches(&problem, &rest, wanted, winch).unwrap();
        let expected = numbers(&case["frequencies_hz"]);
        assert_eq!((found.modes.len(), found.counted), (expected.len(), expected.len()), "{}", case["name"]);
        for (mode, expected) in found.modes.iter().zip(&expected) {
            let error = (mode.frequency / expected - 1.0).abs();
            assert!(error <= mode.within + 1e-9, "{}, {expected} Hz: {error:e}", case["name"]);
            worst = worst.max(error);
            let shares = mode.platform_share + mode.cable_shares[0];
            assert!((shares - 1.0).abs() < 1e-9, "{}, {expected} Hz: {shares}", case["name"]);
        }
        compared += expected.len();
    }
    println!("{compared} frequencies, largest error {worst:.1e}");
    assert!(compared > 180 && worst < 2e-6);
}

#[test]
fn a_weightless_cable_makes_two_masses_on_two_springs_of_platform_and_rotor() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/motion.json")).unwrap();
    let cases = file["cases"].as_array().unwrap();
    let case = cases.iter().find(|case| case["name"] == "hanging cable with a point mass of 5 kg").unwrap();
    let (mut robot, lengths) = (robot(case), numbers(&case["unstrained_lengths"]));
    robot.cables[0].properties.linear_density = 0.0;
    for (winch, servo, lead) in [(0.3, 2e5, 0.0), (7.0, 5e4, 0.0), (0.0, 3e4, 0.0), (7.0, 5e4, 2.0)] {
        robot.cables[0].lead = lead;
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let rest = problem.direct(DirectStart::Pose(&pose(case))).unwrap().equilibrium;
        let found = Modes::on_winches(&problem, &rest, Wanted::Number(3), rotor(winch, servo)).unwrap();
        // (k_c - m ω²) (k_c + k - m_w ω²) = k_c².
        let (spring, mass) = (number(&case["axial_stiffness"][0]) / lengths[0], robot.platform.mass);
        let (a, b) = (winch * mass, mass * (spring + servo) + winch * spring);
        let c = spring * servo;
        let square = 2.0 * c / (b + (b * b - 4.0 * a * c).sqrt());
        let along = square.sqrt() / TAU;
        let pendulum = (number(&case["gravity"][2]).abs() / -rest.pose.position.z).sqrt() / TAU;
        for (mode, expected) in found.modes.iter().zip([pendulum, pendulum, along]) {
            let off = (mode.frequency / expected - 1.0).abs();
            assert!(off < 1e-9, "{winch} {servo} {lead}: {} {expected}", mode.frequency);
        }
        if winch > 0.0 {
            let fast = Modes::on_winches(&problem, &rest, Wanted::Number(4), rotor(winch, servo)).unwrap();
            let expected = (c / a / square).sqrt() / TAU;
            assert!((fast.modes[3].frequency / expected - 1.0).abs() < 1e-9, "{winch} {servo} {lead}");
        }
    }
}

/// Robots at rest: with and without pulleys, leads and sag.
fn robots_at_rest() -> Vec<(Robot, Pose)> {
    let of = |file: &str, [x, y, z]: [f64; 3], lead: f64| {
        let mut robot = robots::robot(file);
        robot.cables.iter_mut().for_each(|cable| cable.lead += lead);
        (robot, Pose::at(x, y, z))
    };
    vec![
        of(include_str!("../../../data/robots/cogiro.json"), [0.5, 0.2, 2.0], 0.0),
        of(include_str!("../../../data/robots/cogiro.json"), [0.5, 0.2, 2.0], 3.0),
        of(include_str!("../../../data/robots/caroca.json"), [0.4, 0.3, 1.75], 0.0),
        of(include_str!("../../../data/robots/ipanema-3.json"), [0.5, 0.2, 1.5], 0.0),
        of(include_str!("../../../data/robots/hrpcables.json"), [0.0, 0.0, 1.5], 0.0),
        of(include_str!("../../../data/robots/fast.json"), [0.0, 0.0, 140.0], 0.0),
    ]
}

fn at_rest(robot: &Robot, pose: &Pose) -> (Vec<f64>, Equilibrium) {
    let held = inverse(robot, pose, &Load::none()).unwrap();
    let problem = DirectProblem::new(robot, &held.lengths, &Load::none()).unwrap();
    let rest = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap().equilibrium;
    (held.lengths, rest)
}

/// A heavy rotor moves as 1/m, which two masses take away.
#[test]
fn rotors_without_end_in_mass_or_stiffness_are_winches_that_hold() {
    for (robot, pose) in robots_at_rest() {
        let (lengths, rest) = at_rest(&robot, &pose);
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let first = Modes::new(&problem, &rest, Wanted::Number(6)).unwrap();
        // Below all motions: next to those of cables with held ends errors grow.
        let highest = first.lowest().unwrap().frequency;
        let at = |winches: Option<Rotor>, frequency: f64| {
            let platform = MovingPlatform::on_winches(&problem, &rest, highest, winches).unwrap();
            platform.dynamic_stiffness(frequency)
        };
        for share in [0.2, 0.5, 0.8] {
            let frequency = share * highest;
            let fixed = at(None, frequency);
            let off = |found: Matrix6<f64>| (found - fixed).norm() / fixed.norm();
            let stiff = off(at(rotor(1.0, 1e20), frequency));
            let spring = robot.cables[0].properties.youngs_modulus * robot.cables[0].properties.section / 5.0;
            let mass = 2e5 * spring / (TAU * frequency).powi(2);
            let heavy =
                off(at(rotor(2.0 * mass, spring), frequency) * 2.0 - at(rotor(mass, spring), frequency));
            println!("{} at {frequency:.2} Hz: {stiff:.1e} {heavy:.1e}", robot.name);
            assert!(stiff < 1e-9 && heavy < 1e-9, "{}: {stiff:e} {heavy:e}", robot.name);
        }
        let stiff = Modes::on_winches(&problem, &rest, Wanted::Number(6), rotor(1e-9, 1e18)).unwrap();
        for (one, other) in stiff.modes.iter().zip(&first.modes) {
            assert!((one.frequency / other.frequency - 1.0).abs() < 2e-6, "{}", robot.name);
        }
    }
}

/// Slow motions are those of the direct model whose winches feed what the servo gives way.
#[test]
fn slow_platforms_on_servos_yield_as_the_direct_model_with_fed_lengths_says() {
    for (robot, pose) in robots_at_rest() {
        let (lengths, rest) = at_rest(&robot, &pose);
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let exits = rest.exit_tensions(&robot, &lengths);
        let properties = &robot.cables[0].properties;
        let servo = 0.5 * properties.youngs_modulus * properties.section / lengths[0];
        let platform = MovingPlatform::on_winches(&problem, &rest, 1.0, rotor(3.0, servo)).unwrap();
        let compliance = platform.dynamic_stiffness(0.0).try_inverse().unwrap();
        let moved = |wrench: Vector6<f64>| {
            let load = Load { payload: 0.0, wrench: Wrench::from_vector(&wrench) };
            let (mut fed, mut found) = (lengths.clone(), rest.clone());
            for _ in 0..200 {
                let problem = DirectProblem::new(&robot, &fed, &load).unwrap();
                found = problem.direct(DirectStart::Near(&found)).unwrap().equilibrium;
                let mut change = 0.0_f64;
                for (i, tension) in found.exit_tensions(&robot, &fed).into_iter().enumerate() {
                    let stretch = 1.0 + robot.cable(i).strain(tension);
                    let wanted = lengths[i] + (tension - exits[i]) / (servo * stretch);
                    change = change.max((wanted - fed[i]).abs());
                    fed[i] += 0.5 * (wanted - fed[i]);
                }
                if change < 1e-13 {
                    break;
                }
            }
            rest.pose.motion_to(&found.pose)
        };
        for k in [0, 2, 4] {
            let size = 1e-4 * robot.platform.mass * if k < 3 { 9.81 } else { robot.platform_size() };
            let wrench = Vector6::ith(k, size);
            let expected = (moved(wrench) - moved(-wrench)) / 2.0;
            let found = compliance * wrench;
            let off = (found - expected).norm() / expected.norm();
            println!("{}, {k}: {off:.1e}", robot.name);
            assert!(off < 1e-5, "{}, {k}: {off:e} {found} {expected}", robot.name);
        }
    }
}

#[test]
fn rotors_that_hold_nothing_are_refused_with_field_and_value() {
    let (robot, pose) = robots_at_rest().swap_remove(0);
    let (lengths, rest) = at_rest(&robot, &pose);
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let refused =
        |mass, stiffness| Modes::on_winches(&problem, &rest, Wanted::Number(3), rotor(mass, stiffness));
    for (mass, stiffness, wrong, said) in [
        (-1.0, 1e5, "mass of the winches", "-1.0: expected a finite mass"),
        (f64::NAN, 1e5, "mass of the winches", "NaN"),
        (1.0, 0.0, "stiffness of the winches", "free rotors hold no platform"),
        (1e30, 1e5, "mass of the winches", "with this stiffness"),
        (1.0, f64::INFINITY, "stiffness of the winches", "inf"),
    ] {
        let error = refused(mass, stiffness).unwrap_err();
        assert!(matches!(&error, DynamicsError::Invalid { field, .. } if *field == wrong), "{error}");
        assert!(error.to_string().contains(said), "{error}");
    }
}
