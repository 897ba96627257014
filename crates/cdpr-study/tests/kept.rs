//! Samplings under forces, and on lengths that every robot has.

use crate::output::{observed, opened, same, study};
use cdpr_robot::{Deviations, Parameter, ParameterLayout, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load, WantedPose, deflection, inverse};
use cdpr_study::Study;
use serde_json::{Value, json};

const ROBOTS: [(&str, [f64; 3]); 2] = [("caroca", [0.3, -0.2, 1.75]), ("cogiro", [1.0, 0.5, 2.0])];

/// A study under a payload, a force and a moment.
fn pulled(robot: &str, position: [f64; 3]) -> Value {
    let mut study = study(robot, position, "deflection");
    study["force"] = json!([40.0, -25.0, 10.0]);
    study["moment"] = json!([3.0, 8.0, -5.0]);
    study
}

/// The same on lengths: those of the inverse model, the first one slightly longer.
fn kept(robot: &str, position: [f64; 3]) -> Value {
    let mut value = pulled(robot, position);
    let of_pose = opened(&value).unwrap();
    let pose = of_pose.sampling("point").unwrap().pose;
    let mut lengths = inverse(&of_pose.robot, &pose, &Load::none()).unwrap().lengths;
    lengths[0] *= 1.0003;
    value["samplings"]["point"]["lengths"] = json!(lengths);
    value["error_models"]["all"].as_object_mut().unwrap().shift_remove("dt");
    value
}

fn opened_kept() -> [Study; 2] {
    ROBOTS.map(|(robot, position)| opened(&kept(robot, position)).unwrap())
}

#[test]
fn a_deflection_is_that_under_payload_force_and_moment() {
    for (robot, position) in ROBOTS {
        let study = opened(&pulled(robot, position)).unwrap();
        let sampling = study.sampling("point").unwrap();
        let mut load = Load::payload(30.0);
        (load.wrench.force, load.wrench.moment) =
            (Vector3::new(40.0, -25.0, 10.0), Vector3::new(3.0, 8.0, -5.0));
        for (deviations, measured) in observed(&sampling).iter().step_by(7) {
            let deviating = study.robot.perturbed(deviations).unwrap();
            let wanted = WantedPose::at(&sampling.pose).tension_offsets(&deviating.tension_offsets);
            let expected = deflection(&deviating.robot, wanted, &load).unwrap();
            same(measured.value(), 1e3 * expected.magnitude(), 1e-7);
        }
        let without = opened(&super::output::study(robot, position, "deflection")).unwrap();
        assert_ne!(study.hash().unwrap(), without.hash().unwrap());
        let alone = without.sampling("point").unwrap().nominal_value;
        assert!((sampling.nominal_value / alone - 1.0).abs() > 1e-3);
    }
}

#[test]
fn on_given_lengths_every_robot_is_where_the_direct_model_puts_it() {
    for study in opened_kept() {
        let sampling = study.sampling("point").unwrap();
        let lengths = study.file.samplings["point"].lengths.clone().unwrap();
        let at = |robot: &cdpr_robot::Robot, load: &Load| {
            let problem = DirectProblem::new(robot, &lengths, load).unwrap();
            problem.direct(DirectStart::Pose(&sampling.pose)).unwrap().equilibrium.pose.position
        };
        for (deviations, measured) in observed(&sampling).iter().step_by(7) {
            let robot = study.robot.perturbed(deviations).unwrap().robot;
            let dp = at(&robot, &study.file.load()) - at(&robot, &Load::none());
            same(measured.value(), 1e3 * dp.norm(), 1e-7);
            assert!((at(&robot, &Load::none()) - sampling.pose.position).norm() > 1e-4);
        }
        let dp = at(&study.robot, &study.file.load()) - at(&study.robot, &Load::none());
        same(sampling.nominal_value, 1e3 * dp.norm(), 1e-7);
    }
}

#[test]
fn slopes_on_given_lengths_are_central_differences() {
    for study in opened_kept() {
        let sampling = study.sampling("point").unwrap();
        let observer = &sampling.observer;
        let layout = ParameterLayout::of(&study.robot);
        let mut deviations = observed(&sampling)[3].0.clone();
        let at = |deviations: &[f64]| {
            let row = Deviations::of_one(&layout, deviations).unwrap();
            observer.displacements(&row).remove(0).unwrap().norm()
        };
        let perturbed = study.robot.perturbed(&deviations).unwrap();
        let (magnitude, slopes) = observer.magnitude_slopes(&perturbed).unwrap();
        same(magnitude, at(&deviations), 1e-9);
        let parameters = Parameter::of(&study.robot);
        for (name, step) in [("mass", 1e-1), ("youngs_modulus", 1e8), ("b3.y", 1e-5), ("a2.x", 1e-5)] {
            let column = parameters.iter().position(|one| one.to_string() == name).unwrap();
            let middle = deviations[column];
            let [after, before] = [step, -step].map(|step| {
                deviations[column] = middle + step;
                at(&deviations)
            });
            deviations[column] = middle;
            let difference = (after - before) / (2.0 * step);
            let (slope, rounding) = (slopes[column], 1e-12 / step);
            assert!(
                (slope - difference).abs() < 1e-4 * slope.abs() + rounding,
                "{name}: {slope} {difference}"
            );
        }
    }
}

#[test]
fn lengths_that_are_no_sampling_are_refused() {
    let refused = |change: &dyn Fn(&mut Value), words: &str| {
        let mut value = kept("caroca", ROBOTS[0].1);
        change(&mut value);
        let reason = opened(&value).unwrap_err().to_string();
        assert!(reason.contains("samplings.point.lengths") && reason.contains(words), "{reason}");
    };
    let point = |value: &mut Value, field: &str, with: Value| value["samplings"]["point"][field] = with;
    refused(&|value| point(value, "lengths", json!([1.0, 2.0])), "8, one for each cable");
    refused(&|value| point(value, "lengths", json!([1.0, 2.0, 3.0, -4.0, 5.0, 6.0, 7.0, 8.0])), "above zero");
    refused(&|value| point(value, "lengths", json!(vec![9e3; 8])), "lengths in m");
    refused(&|value| value["output"] = json!("stiffness"), "output deflection or position");
    refused(
        &|value| {
            value["error_models"]["all"]["dt1"] =
                json!({ "law": { "uniform": { "min": -1.0, "max": 1.0 } } });
        },
        "without `dt`",
    );
    refused(
        &|value| {
            let sampling = value["samplings"]["point"].as_object_mut().unwrap();
            let pose = sampling.shift_remove("pose").unwrap();
            sampling.insert("poses".to_owned(), json!({ "list": [pose] }));
        },
        "given with `poses`",
    );
}

#[test]
fn a_load_is_a_payload_or_a_force_and_finite() {
    let mut value = pulled("caroca", ROBOTS[0].1);
    value["payload"] = json!(0.0);
    assert!(opened(&value).is_ok());
    (value["force"], value["moment"]) = (json!([0, 0, 0]), json!([0, 0, 0]));
    let reason = opened(&value).unwrap_err().to_string();
    assert!(reason.contains("payload") && reason.contains("`force`"), "{reason}");
    value["payload"] = json!(-1.0);
    assert!(opened(&value).is_err());
}
