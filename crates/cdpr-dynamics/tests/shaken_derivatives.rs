//! Derivatives of amplitudes of platforms that are shaken, against differences.

use crate::derivatives::robots;
use cdpr_dynamics::{AmplitudeAt, AmplitudeDerivatives, Damping, DynamicsError};
use cdpr_robot::{Axis, Parameter, Robot, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, StaticsError, WantedPose, inverse};

/// Step of differences, relative to the size of a parameter.
const STEP: f64 = 2e-5;

/// The amplitude of a robot next to a state.
fn amplitude(robot: &Robot, lengths: &[f64], load: &Load, start: &Equilibrium, at: &AmplitudeAt) -> f64 {
    let problem = DirectProblem::new(robot, lengths, load).unwrap();
    let rest = problem.direct(DirectStart::Near(start)).unwrap().equilibrium;
    at.of(&problem, &rest).unwrap()
}

/// The derivative of a function of a step, by differences of two widths.
fn difference(step: f64, of: impl Fn(f64) -> f64) -> f64 {
    let central = |step: f64| (of(step) - of(-step)) / (2.0 * step);
    (4.0 * central(0.5 * step) - central(step)) / 3.0
}

fn shaken(robot: &Robot, share: f64, along: Option<Axis>) -> AmplitudeAt {
    // In units of the angular frequency of a pendulum as long as the cables.
    let length = robot.cables.iter().map(|cable| cable.exit_point.norm()).fold(0.0, f64::max);
    AmplitudeAt {
        frequency: share * (9.81 / length).sqrt(),
        damping: Damping { stretch: 2e-3, drag: 0.5 },
        marker: robot.platform_size() * Vector3::new(0.3, -0.2, 0.4),
        along,
    }
}

#[test]
fn an_amplitude_changes_as_differences_say() {
    for (k, (name, robot, pose, free)) in robots().into_iter().enumerate() {
        let mut load = Load::payload(0.02 * robot.platform.mass);
        // A moment makes the stiffness unsymmetric.
        if free.is_empty() && robot.cables.len() > 6 {
            let size = 0.3 * robot.platform_size() * robot.platform.mass;
            load.wrench.moment = size * Vector3::new(1.0, -0.5, 0.7);
        }
        let held = inverse(&robot, WantedPose::at(&pose).free(free), &load).unwrap();
        let problem = DirectProblem::new(&robot, &held.lengths, &load).unwrap();
        let rest = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap().equilibrium;
        let along = [None, Some(Axis::X), Some(Axis::Z)][k % 3];
        let at = shaken(&robot, if k % 2 == 0 { 2.0 } else { 7.0 }, along);
        let found = at.derivatives(&problem, &rest).unwrap();
        assert!((found.amplitude / at.of(&problem, &rest).unwrap() - 1.0).abs() < 1e-12);
        let size = robot.platform_size();
        let scale = |parameter: &Parameter| match parameter {
            Parameter::Mass | Parameter::LinearDensity | Parameter::YoungsModulus => {
                parameter.nominal(&robot)
            }
            Parameter::Gravity(_) => 10.0,
            _ => size,
        };
        // One of each kind, of one cable.
        let is_of = |parameter: &Parameter| {
            let name = parameter.to_string();
            name.chars().find(char::is_ascii_digit).is_none_or(|number| number == '3')
                && !matches!(parameter, Parameter::TensionOffset(_) | Parameter::Tilt(..))
        };
        let parameters = &found.inputs.parameters;
        let (mut worst, mut largest) = ((0.0_f64, String::new()), 0.0_f64);
        let mut compare = |name: String, exact: f64, difference: f64| {
            largest = largest.max(exact.abs());
            if (exact - difference).abs() > worst.0 {
                worst = ((exact - difference).abs(), format!("{name}: {exact} {difference}"));
            }
        };
        for (column, parameter) in parameters.iter().enumerate().filter(|(_, of)| is_of(of)) {
            let by = difference(STEP, |share| {
                let mut deviations = vec![0.0; parameters.len()];
                deviations[column] = share * scale(parameter);
                let changed = robot.perturbed(&deviations).unwrap().robot;
                amplitude(&changed, &held.lengths, &load, &rest, &at)
            });
            compare(parameter.to_string(), found.per_input[column] * scale(parameter), by);
        }
        let payload = found.inputs.payload();
        let by = difference(STEP, |share| {
            let heavier = Load { payload: load.payload + share * robot.platform.mass, ..load };
            amplitude(&robot, &held.lengths, &heavier, &rest, &at)
        });
        compare("payload".to_owned(), found.per_input[payload] * robot.platform.mass, by);
        for i in [0, robot.cables.len() - 1] {
            let by = difference(0.02 * STEP, |step| {
                let mut lengths = held.lengths.clone();
                lengths[i] *= 1.0 + step;
                amplitude(&robot, &lengths, &load, &rest, &at)
            });
            compare(format!("length {i}"), found.per_length[i] * held.lengths[i], by);
        }
        println!("{name}: {} Hz {along:?}, {} m/N, {largest}, {worst:?}", at.frequency, found.amplitude);
        assert!(worst.0 < 1e-6 * largest, "{name}: {worst:?} of {largest}");
    }
}

#[test]
fn a_robot_that_is_heavier_and_stiffer_throughout_moves_less_by_as_much() {
    // The pieces of a law keep their tensions whatever the modulus is.
    for (name, robot, pose, free) in robots().into_iter().filter(|(name, ..)| !name.contains("law")) {
        let held = inverse(&robot, WantedPose::at(&pose).free(free), &Load::none()).unwrap();
        let problem = DirectProblem::new(&robot, &held.lengths, &Load::none()).unwrap();
        let rest = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap().equilibrium;
        for share in [0.5, 3.0, 9.0] {
            let AmplitudeDerivatives { amplitude, inputs, per_input, per_inertia, .. } =
                shaken(&robot, share, None).derivatives(&problem, &rest).unwrap();
            let by = |of: Parameter| of.nominal(&robot) * per_input[inputs.column(of).unwrap()];
            let parts = [
                by(Parameter::Mass) + per_inertia,
                by(Parameter::LinearDensity),
                by(Parameter::YoungsModulus),
            ];
            let size = parts.iter().fold(amplitude, |size, part| size.max(part.abs()));
            let error = (parts.iter().sum::<f64>() + amplitude).abs() / size;
            println!("{name}: {share}, {error:.1e}");
            assert!(error < 1e-6, "{name}: {parts:?} {amplitude}");
        }
    }
}

#[test]
fn what_has_no_derivative_says_why() {
    let (_, robot, pose, _) = robots().remove(0);
    let held = inverse(&robot, &pose, &Load::none()).unwrap();
    let problem = DirectProblem::new(&robot, &held.lengths, &Load::none()).unwrap();
    let at = shaken(&robot, 1.0, None);
    for frequency in [0.0, -1.0, f64::NAN] {
        let refused = AmplitudeAt { frequency, ..at }.derivatives(&problem, &held.equilibrium);
        assert!(matches!(refused, Err(DynamicsError::Invalid { field: "frequency", .. })), "{refused:?}");
    }
    let mut tilted = robots().remove(7).1;
    tilted.cables.iter_mut().for_each(|cable| {
        cable.pulley =
            cable.pulley.map(|pulley| cdpr_robot::Pulley { axis: Vector3::new(0.1, 0.0, 1.0), ..pulley });
    });
    let pose = robots().remove(7).2;
    let held = inverse(&tilted, &pose, &Load::none()).unwrap();
    let problem = DirectProblem::new(&tilted, &held.lengths, &Load::none()).unwrap();
    let refused = shaken(&tilted, 1.0, None).derivatives(&problem, &held.equilibrium);
    assert!(matches!(refused, Err(DynamicsError::Statics(StaticsError::NoDerivative { .. }))), "{refused:?}");
}
