//! The least 1-norm and infinity-norm of the tensions of sagging cables.

use cdpr_evidence::accept;
use cdpr_robot::{Pose, Robot, TensionDistribution, TensionReference, Vector3};
use cdpr_statics::{InversePath, Load, Observer, StaticsError, WantedPose, deflection, derivatives, inverse};
use serde_json::Value;

fn robot(name: &str) -> Robot {
    let folder = if name.starts_with("stadium") { "data/reference/robots" } else { "data/robots" };
    let path = format!("{}/../../{folder}/{name}", env!("CARGO_MANIFEST_DIR"));
    Robot::from_json(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn choosing(robot: &Robot, distribution: TensionDistribution) -> Robot {
    let mut robot = robot.clone();
    robot.choose(Some(distribution), None);
    robot
}

fn sum(tensions: &[f64]) -> f64 {
    tensions.iter().sum()
}

fn greatest(tensions: &[f64]) -> f64 {
    tensions.iter().copied().fold(0.0, f64::max)
}

type Norm = fn(&[f64]) -> f64;

const NORMS: [(TensionDistribution, Norm); 2] =
    [(TensionDistribution::LeastOneNorm, sum), (TensionDistribution::LeastInfinityNorm, greatest)];

#[test]
fn the_least_norms_are_those_of_scipy() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/reference/norms.json");
    let reference: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let poses = reference["poses"].as_array().unwrap();
    assert_eq!(poses.len(), 10);
    let mut worst: f64 = 0.0;
    for row in poses {
        let number = |value: &Value| value.as_f64().unwrap();
        let three = |field: &str| Vector3::from_fn(|k, _| number(&row[field][k]));
        let position = three("position");
        let [roll, pitch, yaw] = three("roll_pitch_yaw_deg").map(f64::to_radians).into();
        let pose = Pose { position, rotation: cdpr_robot::Rotation3::from_euler_angles(roll, pitch, yaw) };
        let robot = robot(row["robot"].as_str().unwrap());
        for (k, (distribution, norm)) in NORMS.into_iter().enumerate() {
            let found = inverse(&choosing(&robot, distribution), &pose, &Load::none()).unwrap();
            let (value, expected) = (norm(&found.tensions), number(&row["sagging"][k]));
            worst = worst.max((value / expected - 1.0).abs());
            println!("{} {position:?} {distribution:?}: {value} N, SciPy {expected} N", row["robot"]);
            assert!(value < expected * (1.0 + 1e-8), "{value} {expected}");
            assert!((value - expected).abs() < 1e-6 * expected, "{value} {expected}");
            let size = sum(&found.tensions);
            assert!(found.residual.force < 1e-10 * size && found.stationarity < 1e-8 * size, "{found:?}");
        }
    }
    accept("V-INVERSE-005", worst);
}

/// Robots that are suspended, prestressed, large, light, over pulleys and with many cables.
const PLACES: [(&str, [f64; 3]); 8] = [
    ("caroca.json", [0.0, 0.0, 1.75]),
    ("caroca.json", [1.1, -0.4, 2.2]),
    ("cogiro.json", [2.0, 1.0, 1.5]),
    ("ipanema-1.json", [0.2, 0.1, 1.0]),
    ("ipanema-3.json", [0.2, 0.1, 1.3]),
    ("fast.json", [10.0, 0.0, 150.0]),
    ("expo2015-lucia.json", [0.0, 0.0, 2.0]),
    ("four-cables.json", [0.5, 0.3, 2.0]),
];

#[test]
fn no_tensions_that_come_near_to_less_have_less() {
    for (name, [x, y, z]) in PLACES {
        let robot = robot(name);
        let (pose, load) = (Pose::at(x, y, z), Load::payload(2.0));
        for (distribution, norm) in NORMS {
            let found = match inverse(&choosing(&robot, distribution), &pose, &load) {
                Ok(found) => found,
                Err(StaticsError::FreeCoordinates { .. }) if name == "four-cables.json" => continue,
                Err(error) => panic!("{name} {distribution:?}: {error}"),
            };
            let least = norm(&found.tensions);
            println!("{name} {distribution:?}: {least} N in {} programs", found.iterations);
            let limits = cdpr_statics::limits::limits_at(&robot, &pose).unwrap();
            assert!(found.tensions.iter().zip(&limits).all(|(t, limits)| *t <= limits.max), "{name}");
            assert!(found.residual.force < 1e-9 * sum(&found.tensions), "{name}: {:?}", found.residual);
            for share in [0.999, 0.9, 0.5] {
                let less: Vec<f64> = match distribution {
                    TensionDistribution::LeastOneNorm => found.tensions.iter().map(|t| share * t).collect(),
                    _ => found.tensions.iter().map(|t| t.min(share * least)).collect(),
                };
                let other = inverse(&robot, WantedPose::at(&pose).tension_reference(&less), &load).unwrap();
                let value = norm(&other.tensions);
                assert!(value > least * (1.0 - 1e-8), "{name} {distribution:?}: {value} N, {least} N");
            }
        }
    }
}

#[test]
fn the_least_two_norm_is_the_nearest_to_zero() {
    let (pose, load) = (Pose::at(0.5, 0.2, 2.0), Load::payload(10.0));
    let robot = robot("caroca.json");
    let nearest = inverse(&robot, &pose, &load).unwrap();
    let two = choosing(&robot, TensionDistribution::LeastTwoNorm);
    assert_eq!(inverse(&two, &pose, &load).unwrap(), nearest);
}

#[test]
fn a_deflection_begins_with_the_tensions_that_are_chosen() {
    let pose = Pose::at(0.5, 0.2, 2.0);
    let even = choosing(&robot("caroca.json"), TensionDistribution::LeastInfinityNorm);
    let wanted = inverse(&even, &pose, &Load::none()).unwrap();
    let found = deflection(&even, &pose, &Load::payload(50.0)).unwrap();
    for (one, other) in found.unloaded.equilibrium.tensions().iter().zip(&wanted.tensions) {
        assert!((one - other).abs() < 1e-9 * other, "{one} {other}");
    }
    let all = inverse(&even, &[pose], &Load::none()).remove(0).unwrap();
    assert_eq!(all.tensions, wanted.tensions);
}

#[test]
fn tensions_that_cannot_hold_the_pose_are_refused_as_by_the_inverse_model() {
    let (pose, load) = (Pose::at(0.0, 0.0, 1.75), Load::payload(1e5));
    let robot = robot("caroca.json");
    for (distribution, _) in NORMS {
        let refusal = inverse(&choosing(&robot, distribution), &pose, &load).unwrap_err();
        assert!(matches!(refusal, StaticsError::NoTensions { refuted: true, .. }), "{refusal}");
    }
}

#[test]
fn what_follows_smooth_tensions_refuses_norms_that_jump_and_names_the_field() {
    let (pose, load) = (Pose::at(0.0, 0.0, 1.75), Load::payload(5.0));
    for (distribution, _) in NORMS {
        let even = choosing(&robot("caroca.json"), distribution);
        let refusals = [
            derivatives(&even, &pose, &load).map(|_| ()).unwrap_err(),
            Observer::new(&even, pose, &load).map(|_| ()).unwrap_err(),
            InversePath::new(&even).solve(pose, &load).map(|_| ()).unwrap_err(),
        ];
        for refusal in refusals {
            assert!(
                matches!(&refusal, StaticsError::Invalid { field, .. } if field == "distribution"),
                "{refusal}"
            );
        }
        assert!(
            InversePath::new(&even)
                .solve(WantedPose::at(&pose).tension_reference(&[900.0; 8]), &load)
                .is_ok()
        );
    }
}

#[test]
fn a_norm_with_a_reference_is_no_robot() {
    let mut robot = robot("caroca.json");
    robot.tension_reference = Some(TensionReference::All(900.0));
    robot.distribution = TensionDistribution::LeastOneNorm;
    assert!(robot.validate().unwrap_err().to_string().contains("distribution is least_1_norm"));
}
