//! Derivatives against what mechanics demands of them.

use crate::common::caroca;
use crate::derivatives::{Case, STUDY_POSES};
use crate::derivatives_by_gravity::random_case;
use crate::pulleys::{led, turned};
use cdpr_robot::{Parameter, Pose, Rotation3, Vector3, Vector6, Wrench};
use cdpr_statics::{Deflection, Derivatives, DirectProblem, Load, WantedPose, derivatives};
use nalgebra::DVector;
use std::collections::BTreeMap;

/// A CAROCA that is turned and off centre, with offsets.
fn some_case() -> Case {
    let pose = Pose::at(0.6, -0.4, 1.4).moved(Vector3::zeros(), Vector3::new(0.05, -0.08, 0.1));
    let offsets = vec![10.0, -20.0, 5.0, 0.0, -3.0, 8.0, 14.0, -9.0];
    Case { robot: caroca(), pose, offsets, load: Load::payload(50.0) }
}

fn some_derivatives() -> Derivatives {
    let Case { robot, pose, offsets, load } = some_case();
    derivatives(&robot, WantedPose::at(&pose).tension_offsets(&offsets), &load).unwrap()
}

/// The change of all inputs that `change` gives for each parameter, the payload and the wanted pose.
fn direction(
    exact: &Derivatives,
    change: impl Fn(Parameter) -> f64,
    payload: f64,
    motion: Vector6<f64>,
) -> DVector<f64> {
    let parameters = exact.inputs.parameters.iter().map(|parameter| change(*parameter));
    let all: Vec<f64> = parameters.chain([payload]).chain(motion.iter().copied()).collect();
    DVector::from_vec(all)
}

fn component(vector: Vector3<f64>, axis: cdpr_robot::Axis) -> f64 {
    vector[axis as usize]
}

#[test]
fn moving_all_exit_points_and_the_pose_alike_moves_the_platform_and_changes_nothing_else() {
    let exact = some_derivatives();
    let shift = Vector3::new(0.3, -0.7, 0.4);
    let exits = |parameter| match parameter {
        Parameter::ExitPoint(_, axis) => component(shift, axis),
        _ => 0.0,
    };
    let all = direction(&exact, exits, 0.0, Vector6::new(shift.x, shift.y, shift.z, 0.0, 0.0, 0.0));
    assert!((&exact.lengths * &all).amax() < 1e-12);
    assert!((&exact.set_points * &all).amax() < 1e-8);
    assert!((exact.displacement() * &all).amax() < 1e-12);
    for at in [&exact.unloaded, &exact.loaded] {
        assert!((&at.tensions * &all).amax() < 1e-8);
        let motion = &at.pose * &all;
        assert!(
            (motion.fixed_rows::<3>(0) - shift).norm() < 1e-11 && motion.fixed_rows::<3>(3).norm() < 1e-11
        );
    }
}

#[test]
fn scaling_all_forces_scales_the_tensions_and_moves_nothing() {
    let Case { robot, offsets, load, .. } = some_case();
    let exact = some_derivatives();
    let forces = |parameter: Parameter| match parameter {
        Parameter::TensionOffset(i) => offsets[i],
        Parameter::Mass | Parameter::LinearDensity | Parameter::YoungsModulus => parameter.nominal(&robot),
        _ => 0.0,
    };
    let all = direction(&exact, forces, load.payload, Vector6::zeros());
    assert!((&exact.lengths * &all).amax() < 1e-12);
    assert!((exact.displacement() * &all).amax() < 1e-12);
    for (at, found) in
        [(&exact.unloaded, &exact.deflection.unloaded), (&exact.loaded, &exact.deflection.loaded)]
    {
        assert!((&at.pose * &all).amax() < 1e-11);
        let tensions = DVector::from_vec(found.equilibrium.tensions());
        assert!((&at.tensions * &all - &tensions).amax() < 1e-10 * tensions.amax());
    }
}

#[test]
fn turning_robot_and_pose_about_the_vertical_turns_the_answer() {
    let case = some_case();
    let exact = some_derivatives();
    let up = Vector3::z();
    let exits = |parameter| match parameter {
        Parameter::ExitPoint(i, axis) => component(up.cross(&case.robot.cables[i].exit_point), axis),
        _ => 0.0,
    };
    let swept = up.cross(&case.pose.position);
    let all = direction(&exact, exits, 0.0, Vector6::new(swept.x, swept.y, swept.z, 0.0, 0.0, 1.0));
    assert!((&exact.lengths * &all).amax() < 1e-11);
    let turned = up.cross(&exact.deflection.displacement());
    assert!((exact.displacement() * &all - turned).amax() < 1e-11);
    for (at, found) in
        [(&exact.unloaded, &exact.deflection.unloaded), (&exact.loaded, &exact.deflection.loaded)]
    {
        let swept = up.cross(&found.equilibrium.pose.position);
        let expected = Vector6::new(swept.x, swept.y, swept.z, 0.0, 0.0, 1.0);
        assert!((&at.pose * &all - expected).amax() < 1e-10);
        assert!((&at.tensions * &all).amax() < 1e-7);
    }
}

/// With gravity and the swivel axes of the pulleys the base can turn about any axis.
#[test]
fn turning_robot_pose_and_gravity_about_any_axis_turns_the_answer() {
    let slanted = Rotation3::new(Vector3::new(0.3, -0.5, 0.4));
    for (radius, rotation) in [(0.0, Rotation3::identity()), (0.045, Rotation3::identity()), (0.045, slanted)]
    {
        let case = some_case();
        let robot = turned(&led(case.robot, radius, 2.0), &rotation);
        let pose = Pose { position: rotation * case.pose.position, rotation: rotation * case.pose.rotation };
        let exact =
            derivatives(&robot, WantedPose::at(&pose).tension_offsets(&case.offsets), &case.load).unwrap();
        for about in [Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(0.6, -0.3, 0.5)] {
            let base = |parameter| match parameter {
                Parameter::ExitPoint(i, axis) => component(about.cross(&robot.cables[i].exit_point), axis),
                Parameter::Gravity(axis) => component(about.cross(&robot.gravity.vector()), axis),
                Parameter::Tilt(i, axis) => about.dot(&axis.of(&robot.cables[i].pulley.unwrap())),
                _ => 0.0,
            };
            let turning = |position: &Vector3<f64>| {
                let swept = about.cross(position);
                Vector6::new(swept.x, swept.y, swept.z, about.x, about.y, about.z)
            };
            let all = direction(&exact, base, 0.0, turning(&pose.position));
            assert!((&exact.lengths * &all).amax() < 1e-11);
            assert!((&exact.set_points * &all).amax() < 1e-7);
            let swung = about.cross(&exact.deflection.displacement());
            assert!((exact.displacement() * &all - swung).amax() < 1e-11);
            for (at, found) in
                [(&exact.unloaded, &exact.deflection.unloaded), (&exact.loaded, &exact.deflection.loaded)]
            {
                let expected = turning(&found.equilibrium.pose.position);
                assert!((&at.pose * &all - expected).amax() < 1e-10);
                assert!((&at.tensions * &all).amax() < 1e-7);
            }
        }
    }
}

#[test]
fn a_payload_moves_the_platform_as_the_tangent_says() {
    let Case { robot, load, .. } = some_case();
    let exact = some_derivatives();
    let loaded = &exact.deflection.loaded;
    let linearization = DirectProblem::new(&robot, &exact.deflection.lengths, &load)
        .unwrap()
        .linearize(&loaded.equilibrium)
        .unwrap();
    let arm = loaded.equilibrium.pose.rotation * robot.platform.center_of_mass;
    let force = robot.gravity.vector();
    let expected = linearization.displacement(&Wrench { force, moment: arm.cross(&force) });
    let payload = exact.inputs.payload();
    assert!((exact.loaded.pose.column(payload) - expected).norm() < 1e-9 * expected.norm());
    assert_eq!(exact.unloaded.pose.column(payload).amax(), 0.0);
    assert_eq!(exact.lengths.column(payload).amax(), 0.0);
}

#[test]
fn the_chain_through_the_lengths_is_that_of_the_assembled_equations() {
    for seed in 0..40 {
        let Case { robot, pose, offsets, load } = random_case(seed);
        let Ok(exact) = derivatives(&robot, WantedPose::at(&pose).tension_offsets(&offsets), &load) else {
            continue;
        };
        let Deflection { lengths, loaded, .. } = &exact.deflection;
        let problem = DirectProblem::new(&robot, lengths, &load).unwrap();
        let held = problem.derivatives(&loaded.equilibrium).unwrap();
        let linearization = problem.linearize(&loaded.equilibrium).unwrap();
        let expected = linearization.pose_per_length() * &exact.lengths + &held.pose;
        let pose = exact.inputs.pose();
        let parameters = 0..exact.inputs.payload();
        for column in parameters.chain(pose) {
            let error = (expected.column(column) - exact.loaded.pose.column(column)).amax();
            let scale = held.pose.column(column).amax().max(expected.column(column).amax());
            assert!(error <= 1e-8 * scale, "{column}: {error:e} of {scale:e}");
        }
    }
}

#[test]
fn a_clamped_set_point_does_not_depend_on_its_offset() {
    let Case { robot, pose, mut offsets, load } = some_case();
    offsets[2] = -1e4;
    let exact = derivatives(&robot, WantedPose::at(&pose).tension_offsets(&offsets), &load).unwrap();
    let dt3 = exact.inputs.parameters.iter().position(|p| *p == Parameter::TensionOffset(2)).unwrap();
    assert_eq!(exact.lengths.column(dt3).amax(), 0.0);
    assert_eq!(exact.loaded.pose.column(dt3).amax(), 0.0);
    assert!((exact.set_points[(3, dt3 + 1)] - 1.0).abs() < 1e-15);
}

#[test]
fn the_norm_of_no_deflection_has_no_derivative() {
    let Case { robot, pose, offsets, .. } = some_case();
    let exact = derivatives(&robot, WantedPose::at(&pose).tension_offsets(&offsets), &Load::none()).unwrap();
    assert_eq!(
        exact.magnitude().unwrap_err().to_string(),
        "the norm of the deflection has no derivative: the load does not displace the platform"
    );
    assert!(exact.displacement().amax() < 1e3);
}

#[test]
fn the_modulus_makes_the_variance_of_the_mechanical_study() {
    let study: serde_json::Value =
        serde_json::from_str(include_str!("../../../data/studies/caroca.json")).unwrap();
    let laws = &study["error_models"]["table_3"];
    for position in STUDY_POSES {
        let pose = Pose { position: position.into(), rotation: Rotation3::identity() };
        let exact = derivatives(&caroca(), &pose, &Load::payload(50.0)).unwrap();
        let variance = |parameter: &Parameter| {
            let law = &laws[parameter.group()]["law"]["uniform"];
            let [min, max] = ["min", "max"].map(|end| law[end].as_f64().unwrap());
            (max - min).powi(2) / 12.0
        };
        assert_eq!(exact.one_sided, []);
        let parameters = || exact.inputs.parameters.iter();
        let each = parameters().zip(exact.magnitude().unwrap());
        let parts: Vec<f64> = each.map(|(parameter, slope)| slope * slope * variance(parameter)).collect();
        let all: f64 = parts.iter().sum();
        let mut groups = BTreeMap::<_, f64>::new();
        for (parameter, part) in parameters().zip(&parts) {
            *groups.entry(parameter.group()).or_default() += 100.0 * part / all;
        }
        println!(
            "{position:?}: |dp| = {:.5} mm, predicted standard deviation {:.5} mm, shares [%]: {groups:.4?}",
            1e3 * exact.deflection.magnitude(),
            1e3 * all.sqrt()
        );
        if position == STUDY_POSES[0] {
            assert!((groups["youngs_modulus"] - 99.45).abs() < 0.01);
        }
    }
}
