//! Derivatives of natural frequencies against references and differences.

use crate::reference::{number, numbers, pose, robot};
use cdpr_dynamics::{FrequencyDerivatives, Modes, Wanted};
use cdpr_evidence::accept;
use cdpr_robot::{Coordinate, Gravity, Parameter, Pose, Robot, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, WantedPose, inverse};
use serde_json::Value;

#[test]
fn derivatives_by_mass_density_stiffness_and_a_length_are_those_of_the_references() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/motion.json")).unwrap();
    let mut compared = 0;
    for case in file["cases"].as_array().unwrap() {
        let expected = &case["derivatives"];
        if expected.is_null() || case["lead_has_mass"].as_bool() == Some(false) {
            continue;
        }
        let (name, robot) = (case["name"].as_str().unwrap(), robot(case));
        let lengths = numbers(&case["unstrained_lengths"]);
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let rest = problem.direct(DirectStart::Pose(&pose(case))).unwrap();
        let modes =
            Modes::new(&problem, &rest.equilibrium, Wanted::Below(number(&case["bound_hz"]))).unwrap();
        let keys = [
            "platform_mass_and_inertia",
            "linear_density_of_all",
            "axial_stiffness_of_all",
            "unstrained_length_of_cable_1",
        ];
        let references = keys.map(|key| numbers(&expected[key]["df_dlog"]));
        let errors = keys.map(|key| number(&expected[key]["estimated_error"]));
        let largest =
            references.each_ref().map(|all| all.iter().fold(0.0_f64, |most, one| most.max(one.abs())));
        let mut worst = [0.0_f64; 5];
        for k in 0..modes.modes.len() {
            let expected = references.each_ref().map(|all| all[k]);
            let found = FrequencyDerivatives::new(&problem, &modes, k).unwrap();
            let by = |parameter: Parameter, nominal: f64| {
                nominal * found.per_input[found.inputs.column(parameter).unwrap()]
            };
            let properties = &robot.cables[0].properties;
            let mass = by(Parameter::Mass, robot.platform.mass) + found.per_inertia;
            let density = by(Parameter::LinearDensity, properties.linear_density);
            let modulus = by(Parameter::YoungsModulus, properties.youngs_modulus);
            let length = lengths[0] * found.per_length[0];
            for (i, one) in [mass, density, modulus, length].into_iter().enumerate() {
                worst[i] = worst[i].max((one - expected[i]).abs() / largest[i]);
            }
            let sum = (mass + density + modulus).abs();
            worst[4] = worst[4].max(sum / mass.abs().max(density.abs()).max(modulus.abs()));
            compared += 1;
        }
        worst[..4].iter().for_each(|worst| accept("V-MOTION-006", *worst));
        accept("V-MOTION-007", worst[4]);
        for (worst, (error, largest)) in worst.iter().zip(errors.iter().zip(&largest)) {
            assert!(*worst < 1e-8_f64.max(error / largest), "{name}: {worst:e}");
        }
    }
    assert_eq!(compared, 380);
}

/// Robots, a pose each, and coordinates that are found there.
pub(crate) fn robots() -> Vec<(&'static str, Robot, Pose, &'static [Coordinate])> {
    let robot = |file: &str| {
        let mut robot = Robot::from_json(file).unwrap();
        robot.platform.inertia = Some(robot.platform.inertia.unwrap_or_else(|| robot.assumed_inertia()));
        robot
    };
    let cogiro = robot(include_str!("../../../data/robots/cogiro.json"));
    let mut led = cogiro.clone();
    for (i, cable) in led.cables.iter_mut().enumerate() {
        cable.lead = 1.0 + i as f64;
    }
    led.gravity = Gravity::from(Vector3::new(-0.3, 0.5, -9.8));
    let caroca = robot(include_str!("../../../data/robots/caroca.json"));
    let law = robot(include_str!("../../../data/robots/caroca-law.json"));
    let fast = robot(include_str!("../../../data/robots/fast.json"));
    let ipanema = robot(include_str!("../../../data/robots/ipanema-1.json"));
    let pulleys = robot(include_str!("../../../data/robots/ipanema-3.json"));
    let few = robot(include_str!("../../../data/robots/four-cables.json"));
    let mut point = cogiro.clone();
    point.platform.point = true;
    vec![
        ("CAROCA", caroca, Pose::at(0.4, 0.3, 1.75), &[]),
        ("CAROCA with a law", law, Pose::at(0.4, 0.3, 1.75), &[]),
        ("CoGiRo", cogiro, Pose::at(0.5, 0.2, 2.0), &[]),
        ("CoGiRo behind leads, tilted", led, Pose::at(0.5, 0.2, 2.0), &[]),
        ("CoGiRo as a point", point, Pose::at(0.5, 0.2, 2.0), &[]),
        ("FAST", fast, Pose::at(5.0, -2.0, 140.0), &[]),
        ("IPAnema 1", ipanema, Pose::at(0.3, 0.2, 1.1), &[]),
        ("IPAnema 3, over pulleys", pulleys, Pose::at(0.5, 0.2, 1.5), &[]),
        ("four cables", few, Pose::at(0.3, 0.2, 2.0), &[Coordinate::Roll, Coordinate::Pitch]),
    ]
}

/// The derivatives of the motion with which the platform swings; next to a frequency [Hz] if given.
fn of_platform(problem: &DirectProblem, start: &Equilibrium, near: Option<f64>) -> FrequencyDerivatives {
    let rest = problem.direct(DirectStart::Near(start)).unwrap();
    let modes = Modes::new(problem, &rest.equilibrium, Wanted::OfPlatform).unwrap();
    let wanted = near.unwrap_or_else(|| modes.of_platform().unwrap().frequency);
    let off = |k: &usize| (modes.modes[*k].frequency - wanted).abs();
    let nearest = (0..modes.modes.len()).min_by(|one, other| off(one).total_cmp(&off(other)));
    FrequencyDerivatives::new(problem, &modes, nearest.unwrap()).unwrap()
}

#[test]
fn the_frequency_of_the_platform_changes_as_differences_say() {
    for (name, robot, pose, free) in robots() {
        let load = Load::payload(0.02 * robot.platform.mass);
        let held = inverse(&robot, WantedPose::at(&pose).free(free), &load).unwrap();
        let problem = DirectProblem::new(&robot, &held.lengths, &load).unwrap();
        let found = of_platform(&problem, &held.equilibrium, None);
        let size = robot.platform_size();
        let scale = |parameter: &Parameter| match parameter {
            Parameter::Mass | Parameter::LinearDensity | Parameter::YoungsModulus => {
                parameter.nominal(&robot)
            }
            Parameter::Gravity(_) => 10.0,
            _ => size,
        };
        let parameters = &found.inputs.parameters;
        // One of each kind, of one cable.
        let is_of = |parameter: &Parameter| {
            let name = parameter.to_string();
            name.chars().find(char::is_ascii_digit).is_none_or(|number| number == '3')
                && !matches!(parameter, Parameter::TensionOffset(_) | Parameter::Tilt(..))
        };
        let mut worst = (0.0_f64, String::new());
        let mut largest = 0.0_f64;
        for (k, parameter) in parameters.iter().enumerate().filter(|(_, parameter)| is_of(parameter)) {
            let at = |share: f64| {
                let mut deviations = vec![0.0; parameters.len()];
                deviations[k] = share * scale(parameter);
                let changed = robot.perturbed(&deviations).unwrap().robot;
                let problem = DirectProblem::new(&changed, &held.lengths, &load).unwrap();
                of_platform(&problem, &held.equilibrium, Some(found.frequency)).frequency
            };
            let central = |step: f64| (at(step) - at(-step)) / (2.0 * step);
            let (one, other) = (central(STEP), central(0.5 * STEP));
            let difference = (4.0 * other - one) / 3.0;
            let exact = found.per_input[k] * scale(parameter);
            largest = largest.max(exact.abs());
            if (exact - difference).abs() > worst.0 {
                worst = ((exact - difference).abs(), format!("{parameter}: {exact} {difference}"));
            }
        }
        for i in [0, robot.cables.len() - 1] {
            let at = |step: f64| {
                let mut lengths = held.lengths.clone();
                lengths[i] *= 1.0 + step;
                let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
                of_platform(&problem, &held.equilibrium, Some(found.frequency)).frequency
            };
            let central = |step: f64| (at(step) - at(-step)) / (2.0 * step);
            let step = 0.02 * STEP;
            let difference = (4.0 * central(0.5 * step) - central(step)) / 3.0;
            let exact = found.per_length[i] * held.lengths[i];
            largest = largest.max(exact.abs());
            if (exact - difference).abs() > worst.0 {
                worst = ((exact - difference).abs(), format!("length {i}: {exact} {difference}"));
            }
        }
        println!(
            "{name}: {} Hz, {:.3}, gap {:.1e}, largest {largest}, {worst:?}",
            found.frequency, found.platform_share, found.gap
        );
        assert!(worst.0 < 1e-6 * largest, "{name}: {worst:?} of {largest}");
    }
}

/// Step of differences, relative to the size of a parameter.
const STEP: f64 = 2e-5;
