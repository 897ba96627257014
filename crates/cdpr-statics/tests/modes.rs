//! Natural frequencies against arithmetic of 20 digits (`data/reference/README.md`), and their invariants.

use crate::common::{caroca, cogiro};
use crate::equilibria::{number, vector};
use crate::pulleys::{led, robot};
use crate::reference::rotation;
use cdpr_robot::{Matrix3, Platform, Pose, Robot, Vector3, Vector6, Wrench};
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::vibration::modes_at;
use cdpr_statics::{DirectProblem, DirectStart, Load};
use nalgebra::Matrix6;
use serde_json::Value;

fn with_inertia(robot: Robot, inertia: Matrix3<f64>) -> Robot {
    let platform = Platform { inertia: Some(inertia), ..robot.platform };
    Robot { platform, ..robot }
}

#[test]
fn cogiro_says_that_its_cables_vibrate_less_than_twice_as_fast_as_its_platform() {
    // An independent program that gives the cables their mass finds 3.87 and 4.39 Hz around the 4.158 Hz of
    // cables without mass.
    let found = modes_at(&cogiro(), Pose::at(0.0, 0.0, 2.0), &Load::none()).unwrap();
    let (slowest, platform) = found.lowest();
    let (slowest, platform) = (slowest.unwrap(), platform.unwrap());
    println!("cables {:?} Hz, platform {platform} Hz", found.cable_frequencies);
    assert!((platform - 4.158).abs() < 1e-3);
    assert!(slowest.is_near(platform) && slowest.frequency > 0.5 * platform);
    assert!(slowest.warning(platform).unwrap().contains("less than twice 4.158 Hz"));
    // Without mass no cable vibrates; a light one is fast.
    for (density, expected) in [(0.0, None), (1e-5, Some(false))] {
        let mut robot = cogiro();
        robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density = density);
        let (slowest, platform) = modes_at(&robot, Pose::at(0.0, 0.0, 2.0), &Load::none()).unwrap().lowest();
        assert_eq!(slowest.map(|cable| cable.is_near(platform.unwrap())), expected);
    }
}

#[test]
fn frequencies_and_shapes_match_arithmetic_of_20_digits() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/modes.json")).unwrap();
    let mut compared = 0;
    for case in file["cases"].as_array().unwrap() {
        let inertia = Matrix3::from_fn(|i, j| number(&case["inertia_about_com"][i][j]));
        let robot = with_inertia(robot(case), inertia);
        robot.validate().unwrap();
        let lengths: Vec<f64> = case["unstrained_lengths"].as_array().unwrap().iter().map(number).collect();
        let load = Load::wrench(Wrench { force: vector(&case["force"]), moment: vector(&case["moment"]) });
        let start =
            Pose { position: vector(&case["start_position"]), rotation: rotation(&case["start_rotation"]) };
        let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
        let found = problem.direct(DirectStart::Pose(&start)).unwrap();
        let modes = problem.modes(&found.equilibrium).unwrap();
        let mass = Matrix6::from_fn(|i, j| number(&case["mass_matrix"][i][j]));
        for (k, mode) in modes.iter().enumerate() {
            let expected = number(&case["frequencies_hz"][k]);
            assert!((mode.frequency / expected - 1.0).abs() < 1e-9, "{k}: {} {expected}", mode.frequency);
            let shape = nalgebra::Vector6::from_iterator(
                mode.translation.iter().chain(mode.rotation.iter()).copied(),
            );
            let expected = nalgebra::Vector6::from_fn(|i, _| number(&case["mode_shapes"][k][i]));
            // Up to the sign, and next to a neighbour of nearly the same frequency to its distance.
            let off = (shape - expected).norm().min((shape + expected).norm());
            assert!(off < 1e-7 * expected.norm(), "{} {k}: {off:e}", case["kind"]);
            let unit = (shape.transpose() * mass * shape)[0];
            assert!((unit - 1.0).abs() < 1e-11, "{} {k}: {:e}", case["kind"], unit - 1.0);
            let shares = mode.cables.iter().sum::<f64>() + mode.weight;
            assert!((shares - 1.0).abs() < 1e-9, "{shares}");
        }
        compared += 1;
    }
    assert_eq!(compared, 8);
}

#[test]
fn a_heavier_platform_moves_more_slowly_and_a_payload_is_mass_at_its_centre() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(12.0, 10.0, 8.0));
    for robot in [caroca(), cogiro(), led(caroca(), 0.045, 3.0)] {
        let robot = with_inertia(robot, inertia);
        let pose = Pose::at(0.5, -0.3, 2.0);
        let modes = |robot: &Robot, load: &Load| modes_at(robot, pose, load).unwrap().modes;
        let light = modes(&robot, &Load::none());
        assert!(light.windows(2).all(|pair| pair[0].frequency <= pair[1].frequency));
        let loaded = modes(&robot, &Load::payload(20.0));
        let heavier = Platform { mass: robot.platform.mass + 20.0, ..robot.platform };
        let heavier = modes(&Robot { platform: heavier, ..robot.clone() }, &Load::none());
        for (one, other) in loaded.iter().zip(&heavier) {
            assert!((one.frequency / other.frequency - 1.0).abs() < 1e-9);
        }
        // Twice all masses in the mass matrix alone, by an inertia and a mass without weight.
        let slow = with_inertia(robot.clone(), 4.0 * inertia);
        assert!(modes(&slow, &Load::none())[5].frequency < light[5].frequency);
    }
}

#[test]
fn a_robot_without_inertia_and_an_unstable_equilibrium_have_no_frequencies() {
    let error = modes_at(&caroca(), Pose::at(0.0, 0.0, 1.75), &Load::none()).unwrap_err().to_string();
    assert!(error.contains("platform.inertia is missing"), "{error}");
}

#[test]
fn the_modes_of_a_stability_make_up_the_stiffness() {
    for (robot, pose) in [(caroca(), Pose::at(0.3, -0.2, 1.75)), (cogiro(), Pose::at(2.0, 1.0, 1.5))] {
        let found = stiffness_at(&robot, pose, &Load::none()).unwrap();
        let length = found.stability.characteristic_length();
        let modes = found.stability.modes();
        let sum: Matrix6<f64> = modes
            .iter()
            .map(|mode| {
                let [t, r] = [mode.translation, length * length * mode.rotation];
                let covector = Vector6::new(t.x, t.y, t.z, r.x, r.y, r.z);
                mode.stiffness * covector * covector.transpose()
            })
            .sum();
        let size = found.symmetric_part.norm();
        assert!((sum - found.symmetric_part).norm() < 1e-10 * size);
        for (mode, value) in modes.iter().zip(found.stability.eigenvalues()) {
            assert!((mode.stiffness - value).abs() < 1e-12 * size);
        }
    }
}
