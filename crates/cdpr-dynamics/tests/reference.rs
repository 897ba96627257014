//! Natural motions against two programs that share no code with this one (`data/reference/motion.json`).

use cdpr_dynamics::{Modes, MovingPlatform, Wanted};
use cdpr_evidence::accept;
use cdpr_robot::{
    CableProperties, Gravity, Matrix3, Platform, Pose, Robot, RobotCable, Rotation3, TensionLimits, Vector3,
};
use cdpr_statics::{DirectProblem, DirectStart, Load, Matrix6};
use serde_json::Value;

pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

pub(crate) fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_row_slice(&numbers(value))
}

pub(crate) fn matrix(value: &Value) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| number(&value[i][j]))
}

pub(crate) fn robot(case: &Value) -> Robot {
    let template = Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap();
    let cables = case["exit_points"].as_array().unwrap().iter().enumerate().map(|(i, exit)| {
        let properties = CableProperties::linear(
            1e-5,
            number(&case["linear_density"][i]),
            number(&case["axial_stiffness"][i]) / 1e-5,
        );
        let mut cable = RobotCable::between(vector(exit), vector(&case["anchor_points"][i]), properties);
        cable.lead = case.get("lead").map_or(0.0, |lead| number(&lead[i]));
        cable
    });
    let platform = Platform {
        inertia: case["inertia_about_com"].is_array().then(|| matrix(&case["inertia_about_com"])),
        point: case["point_mass"].as_bool().unwrap(),
        ..Platform::new(number(&case["mass"]), vector(&case["center_of_mass"]))
    };
    Robot {
        gravity: Gravity::from(vector(&case["gravity"])),
        platform,
        ground_z: None,
        tension_limits: TensionLimits { min: 0.0, max: 1e12 },
        cables: cables.collect(),
        ..template
    }
}

pub(crate) fn pose(case: &Value) -> Pose {
    let rotation = Rotation3::from_matrix_unchecked(matrix(&case["rotation"]));
    Pose { position: vector(&case["position"]), rotation }
}

fn modes(case: &Value, wanted: Wanted) -> Modes {
    let robot = robot(case);
    let lengths = numbers(&case["unstrained_lengths"]);
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let rest = problem.direct(DirectStart::Pose(&pose(case))).unwrap();
    Modes::new(&problem, &rest.equilibrium, wanted).unwrap()
}

#[test]
fn every_natural_motion_below_the_bound_is_found_with_its_frequency_and_share() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/motion.json")).unwrap();
    let mut compared = 0;
    for case in file["cases"].as_array().unwrap() {
        let name = case["name"].as_str().unwrap();
        // A robot's lead has the mass of its cable.
        if case["lead_has_mass"].as_bool() == Some(false) {
            continue;
        }
        let bound = number(&case["bound_hz"]);
        let found = modes(case, Wanted::Below(bound));
        let expected = numbers(&case["frequencies_hz"]);
        assert_eq!((found.modes.len(), found.counted), (expected.len(), expected.len()), "{name}");
        let (mut worst, mut worst_below_half) = (0.0_f64, 0.0_f64);
        for (mode, expected) in found.modes.iter().zip(&expected) {
            let error = (mode.frequency / expected - 1.0).abs();
            assert!(error <= mode.within + 1e-9, "{name}, {expected} Hz: {error:e} {:e}", mode.within);
            worst = worst.max(error);
            if *expected < 0.5 * bound {
                worst_below_half = worst_below_half.max(error);
            }
            let shares = mode.platform_share + mode.cable_shares.iter().sum::<f64>();
            assert!((shares - 1.0).abs() < 1e-9, "{name}, {expected} Hz: shares add up to {shares}");
        }
        accept("V-MOTION-001", worst);
        accept("V-MOTION-002", worst_below_half);
        for (k, share) in numbers(&case["platform_share"]).into_iter().enumerate() {
            let near =
                |other: usize| expected.get(other).is_some_and(|f| (f / expected[k] - 1.0).abs() < 1e-3);
            if !(near(k + 1) || k > 0 && near(k - 1)) {
                let found = found.modes[k].platform_share;
                assert!((found - share).abs() < 1e-3, "{name}, {} Hz: {found} {share}", expected[k]);
            }
        }
        compared += expected.len();
    }
    assert_eq!(compared, 891);
}

#[test]
fn the_dynamic_stiffness_of_platforms_is_that_of_transfer_matrices() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/motion.json")).unwrap();
    let mut compared = 0;
    for case in file["cases"].as_array().unwrap() {
        let Some(references) = case["receptance"].as_array() else { continue };
        let (robot, lengths) = (robot(case), numbers(&case["unstrained_lengths"]));
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let rest = problem.direct(DirectStart::Pose(&pose(case))).unwrap().equilibrium;
        let platform = MovingPlatform::new(&problem, &rest, number(&case["bound_hz"])).unwrap();
        for reference in references {
            let frequency = number(&reference["frequency_hz"]);
            let found = platform.dynamic_stiffness(frequency);
            let expected = &reference["dynamic_stiffness"];
            let size = expected.as_array().unwrap().len();
            let expected =
                Matrix6::from_fn(
                    |i, j| {
                        if i < size && j < size { number(&expected[i][j]) } else { found[(i, j)] }
                    },
                );
            let error = (found - expected).norm() / expected.norm();
            accept("V-MOTION-003", error);
            compared += 1;
        }
    }
    assert!(compared >= 9, "{compared}");
}

#[test]
fn without_mass_of_cables_the_natural_motions_are_those_of_the_static_models() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/motion.json")).unwrap();
    let mut compared = 0;
    for case in file["cases"].as_array().unwrap().iter().filter(|case| case["lead"].is_null()) {
        let mut robot = robot(case);
        let lengths = numbers(&case["unstrained_lengths"]);
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let rest = problem.direct(DirectStart::Pose(&pose(case))).unwrap().equilibrium;
        let massless = problem.modes(&rest).unwrap();
        for (mode, expected) in massless.iter().zip(numbers(&case["massless_frequencies_hz"])) {
            assert!((mode.frequency / expected - 1.0).abs() < 1e-9, "{}", case["name"]);
        }
        let stiffness = problem.linearize(&rest).unwrap().symmetric_stiffness();
        let free = robot.freedoms();
        let platform = MovingPlatform::new(&problem, &rest, number(&case["bound_hz"])).unwrap();
        let error = (platform.dynamic_stiffness(0.0) - free.of_matrix(&stiffness)).norm() / stiffness.norm();
        accept("V-MOTION-004", error);
        robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.0);
        let light = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let Ok(rest) = light.direct(DirectStart::Pose(&rest.pose)) else { continue };
        let rest = rest.equilibrium;
        let expected = light.modes(&rest).unwrap();
        let bound = 1.001 * expected.last().unwrap().frequency;
        let found = Modes::new(&light, &rest, Wanted::Below(bound));
        let found = found.unwrap();
        assert_eq!(found.counted, expected.len(), "{}", case["name"]);
        compared += 1;
        for (mode, expected) in found.modes.iter().zip(&expected) {
            let off = (mode.frequency / expected.frequency - 1.0).abs();
            assert!(
                off < 1e-9 && (mode.platform_share - 1.0).abs() < 1e-9,
                "{}: {} {}",
                case["name"],
                mode.frequency,
                expected.frequency
            );
        }
    }
    assert!(compared >= 8, "{compared}");
}
