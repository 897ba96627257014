//! Derivatives with free coordinates are those of differences.

use crate::common::cogiro;
use crate::few_cables::suspended;
use cdpr_robot::{
    CableProperties, Coordinate, Parameter, Plane, Platform, Pose, Robot, Rotation3, Vector3, Vector6,
};
use cdpr_statics::{Deflection, DirectSolution, Load, WantedPose, deflection, derivatives, inverse};
use nalgebra::DVector;

/// Set-points, lengths, both poses relative to those of `about`, and tensions with the load.
fn outputs(
    robot: &Robot,
    pose: &Pose,
    offsets: &[f64],
    load: &Load,
    free: &[Coordinate],
    about: &Deflection,
) -> Vec<DVector<f64>> {
    let found = deflection(robot, WantedPose::at(pose).free(free).tension_offsets(offsets), load).unwrap();
    let rest = deflection(robot, WantedPose::at(pose).free(free), load).unwrap();
    let set_points = rest.unloaded.equilibrium.tensions().into_iter().zip(offsets).map(|(t, dt)| t + dt);
    let motion = |from: &DirectSolution, to: &DirectSolution| {
        DVector::from_column_slice(from.equilibrium.pose.motion_to(&to.equilibrium.pose).as_slice())
    };
    vec![
        DVector::from_iterator(offsets.len(), set_points),
        DVector::from_vec(found.lengths.clone()),
        motion(&about.unloaded, &found.unloaded),
        motion(&about.loaded, &found.loaded),
        DVector::from_vec(found.loaded.equilibrium.tensions()),
        DVector::from_element(1, found.magnitude()),
    ]
}

/// A planar robot on two cables, four cables of CoGiRo, and GRAB with cables that yield and have a weight;
/// each with a pose, its free coordinates and a payload [kg].
pub(crate) fn with_few_cables() -> [(Robot, Pose, Vec<Coordinate>, f64); 3] {
    let points = [[[-3.0, 0.0, 4.0], [-0.3, 0.0, 0.1]], [[3.0, 0.0, 4.0], [0.3, 0.0, 0.1]]];
    let platform = Platform::new(8.0, Vector3::new(0.02, 0.0, -0.1));
    let rope = CableProperties::linear(1.0, 0.08, 5e4);
    let planar = Robot { plane: Some(Plane::Xz), ..suspended(&points, &rope, platform) };
    let mut four = cogiro();
    four.cables = [1, 3, 5, 7].map(|i| four.cables[i].clone()).to_vec();
    let mut grab = Robot::from_json(include_str!("../../../data/robots/grab.json")).unwrap();
    grab.cables.iter_mut().for_each(|cable| {
        cable.properties.youngs_modulus = 2e9;
        cable.properties.linear_density = 1e-3;
    });
    let at_grab =
        Pose { rotation: Rotation3::from_euler_angles(0.0, 0.0, 0.136), ..Pose::at(1.28, -0.19, -0.92) };
    let [roll, pitch, yaw] = [Coordinate::Roll, Coordinate::Pitch, Coordinate::Yaw];
    [
        (planar, Pose::at(0.5, 0.0, 1.5), vec![pitch], 2.0),
        (four, Pose::at(1.0, -0.3, 2.0), vec![roll, yaw], 20.0),
        (grab, at_grab, vec![roll, pitch], 0.2),
    ]
}

/// The step of a difference by an input, in its unit.
fn step(robot: &Robot, parameters: &[Parameter], column: usize, payload: f64) -> f64 {
    match parameters.get(column) {
        Some(one @ (Parameter::Mass | Parameter::LinearDensity | Parameter::YoungsModulus)) => {
            1e-3 * one.nominal(robot)
        }
        Some(Parameter::TensionOffset(_)) => 1e-3 * robot.platform.mass,
        Some(_) => 1e-4 * robot.platform_size(),
        None if column == parameters.len() => 1e-3 * payload,
        None => 1e-4 * robot.platform_size().min(1.0),
    }
}

#[test]
fn derivatives_with_free_coordinates_are_central_differences() {
    let [planar, four, grab] = with_few_cables();
    let cases = [
        (planar.clone(), vec![0.0; 2]),
        (planar, vec![3.0, -2.0]),
        (four.clone(), vec![0.0; 4]),
        (four, vec![5.0, -3.0, 8.0, 2.0]),
        (grab, vec![0.0; 4]),
    ];
    for ((robot, pose, free, payload), offsets) in cases {
        let load = Load::payload(payload);
        // Beside a rest of the platform the search is short.
        let turn = if robot.plane.is_some() { Vector3::zeros() } else { Vector3::new(4e-3, -6e-3, 3e-3) };
        let rest =
            inverse(&robot, WantedPose::at(&pose).free(&free), &Load::none()).unwrap().equilibrium.pose;
        let pose = rest.moved(Vector3::zeros(), turn);
        let found =
            derivatives(&robot, WantedPose::at(&pose).free(&free).tension_offsets(&offsets), &load).unwrap();
        let about = &found.deflection;
        assert_eq!(
            *about,
            deflection(&robot, WantedPose::at(&pose).free(&free).tension_offsets(&offsets), &load).unwrap()
        );
        let magnitude = found.magnitude().unwrap();
        let parameters = Parameter::of(&robot);
        for column in 0..found.inputs.count() {
            let held = column > parameters.len() && !robot.freedoms().contains(column - parameters.len() - 1);
            if held {
                continue;
            }
            let step = step(&robot, &parameters, column, payload);
            let at = |share: f64| {
                let mut deviations = vec![0.0; parameters.len()];
                let (mut load, mut motion) = (load, Vector6::zeros());
                match column.checked_sub(parameters.len()) {
                    None => deviations[column] = share * step,
                    Some(0) => load.payload += share * step,
                    Some(k) => motion[k - 1] = share * step,
                }
                let perturbed = robot.perturbed(&deviations).unwrap();
                let offsets: Vec<f64> =
                    offsets.iter().zip(&perturbed.tension_offsets).map(|(one, other)| one + other).collect();
                let pose = pose.moved(motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into());
                outputs(&perturbed.robot, &pose, &offsets, &load, &free, about)
            };
            let [far, near, back, far_back] = [2.0, 1.0, -1.0, -2.0].map(at);
            let exact = [
                found.set_points.column(column).into_owned(),
                found.lengths.column(column).into_owned(),
                DVector::from_column_slice(found.unloaded.pose.column(column).as_slice()),
                DVector::from_column_slice(found.loaded.pose.column(column).as_slice()),
                found.loaded.tensions.column(column).into_owned(),
                DVector::from_element(1, magnitude[column]),
            ];
            let scales = [
                about.unloaded.equilibrium.tensions().iter().sum::<f64>(),
                about.lengths.iter().sum(),
                robot.platform_size(),
                robot.platform_size(),
                about.loaded.equilibrium.tensions().iter().sum(),
                robot.platform_size(),
            ];
            for (k, (exact, scale)) in exact.iter().zip(scales).enumerate() {
                let difference = (8.0 * (&near[k] - &back[k]) - (&far[k] - &far_back[k])) / (12.0 * step);
                let (size, noise) = (exact.norm().max(difference.norm()), 1e-10 * scale / step);
                let input = parameters.get(column).map_or_else(|| format!("{column}"), ToString::to_string);
                assert!(
                    (exact - &difference).norm() < 2e-6 * size + noise,
                    "{} {input}, output {k}: {exact} and not {difference}",
                    robot.name
                );
            }
        }
    }
}

#[test]
fn an_offset_that_a_limit_keeps_has_no_derivative_with_free_coordinates() {
    let mut four = cogiro();
    four.cables = [1, 3, 5, 7].map(|i| four.cables[i].clone()).to_vec();
    let free = [Coordinate::Roll, Coordinate::Yaw];
    let wanted = Pose::at(1.0, -0.3, 2.0);
    let found = derivatives(
        &four,
        WantedPose::at(&wanted).free(&free).tension_offsets(&[-1e4, 0.0, 0.0, 0.0]),
        &Load::payload(20.0),
    );
    assert_eq!(found.unwrap_err().kind(), "no_derivative");
    let found = derivatives(&four, WantedPose::at(&wanted).free(&free[..1]), &Load::payload(20.0));
    assert_eq!(found.unwrap_err().kind(), "free_coordinates");
}
