//! The inverse model against solutions of independent programs, and on robots of every kind.

use crate::common::ipanema;
use crate::drawn::{Drawn, drawn};
use cdpr_evidence::accept;
use cdpr_robot::{Pose, Robot, TensionLimits, UnitQuaternion, Vector3, Wrench};
use cdpr_statics::{
    Bound, DirectProblem, DirectStart, Load, StaticsError, Unstable, WantedPose, inverse,
    lengths_for_tensions,
};
use nalgebra::Quaternion;
use rayon::prelude::*;
use serde_json::Value;
use std::collections::BTreeMap;

fn numbers(value: &Value) -> Vec<f64> {
    let number = |v: &Value| v.as_f64().unwrap_or_else(|| v.as_str().unwrap().parse().unwrap());
    value.as_array().unwrap().iter().map(number).collect()
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_column_slice(&numbers(value))
}

#[test]
fn the_inverse_model_is_that_of_an_independent_program_with_40_digits() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/inverse.json")).unwrap();
    for case in file["cases"].as_array().unwrap() {
        let kind = case["kind"].as_str().unwrap();
        let robot = Robot::from_json(&case["robot"].to_string()).unwrap();
        let q = numbers(&case["quaternion_wxyz"]);
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(q[0], q[1], q[2], q[3]));
        let pose = Pose { position: vector(&case["position"]), rotation: rotation.to_rotation_matrix() };
        let wrench =
            Wrench { force: vector(&case["external_force"]), moment: vector(&case["external_moment"]) };
        let reference = numbers(&case["reference_tensions"]);
        let found =
            inverse(&robot, WantedPose::at(&pose).tension_reference(&reference), &Load::wrench(wrench));
        if case["infeasible"] == true {
            let refused = matches!(found, Err(StaticsError::NoTensions { refuted: true, .. }));
            assert!(refused, "{kind}: {found:?}");
            continue;
        }
        let found = found.unwrap_or_else(|error| panic!("{kind}: {error}"));
        let largest = found.tensions.iter().copied().fold(0.0, f64::max);
        for (id, ours, exact) in [
            ("V-INVERSE-001", &found.tensions, numbers(&case["tensions"])),
            ("V-INVERSE-002", &found.lengths, numbers(&case["unstrained_lengths"])),
        ] {
            ours.iter().zip(exact).for_each(|(ours, exact)| accept(id, (ours / exact - 1.0).abs()));
        }
        for (ours, exact) in found.active.iter().zip(case["active"].as_array().unwrap()) {
            let exact = exact.as_str().map(|name| if name == "max" { Bound::Max } else { Bound::Min });
            assert_eq!(*ours, exact, "{kind}");
        }
        assert!(found.stationarity <= 1e-9 * largest, "{kind}: {:e}", found.stationarity);
        assert!(found.residual.force <= 1e-9 * largest, "{kind}: {:?}", found.residual);
    }
}

#[test]
fn a_pose_that_tensions_hold_is_never_refused() {
    const CASES: u64 = 10_000;
    let outcomes: Vec<(&str, u64, String)> = (0..CASES)
        .into_par_iter()
        .map(|seed| {
            let Some(Drawn { robot, pose, load, tensions }) = drawn(seed) else {
                return ("not drawn", seed, String::new());
            };
            let found = match inverse(&robot, &pose, &load) {
                Ok(found) => found,
                Err(error) => return (error.kind(), seed, error.to_string()),
            };
            let norm = |t: &[f64]| t.iter().map(|t| t * t).sum::<f64>().sqrt();
            let largest = norm(&found.tensions);
            let text = format!(
                "{} {:e} {:e} {:?}",
                found.iterations,
                found.stationarity / largest,
                norm(&found.tensions) / norm(&tensions),
                found.residual
            );
            if found.stationarity > 1e-10 * largest || found.residual.force > 1e-10 * largest {
                return ("not an optimum", seed, text);
            }
            if norm(&found.tensions) > norm(&tensions) * (1.0 + 1e-9) {
                // A minimum, but not the least: only strongly sagging cables have several.
                return ("another minimum than the drawn tensions", seed, text);
            }
            let (low, high) =
                (robot.tension_limits.min * (1.0 - 1e-12), robot.tension_limits.max * (1.0 + 1e-12));
            if found.tensions.iter().any(|t| !(low..=high).contains(t)) {
                return ("beyond a limit", seed, text);
            }
            // Every tenth pose is found again from its lengths, where it is stable.
            let problem = DirectProblem::new(&robot, &found.lengths, &load).unwrap();
            if seed % 10 == 0
                && let Ok(again) =
                    problem.with_unstable(Unstable::Accepted).direct(DirectStart::Near(&found.equilibrium))
                && again.stability.is_stable()
            {
                let motion = pose.motion_to(&again.equilibrium.pose).norm();
                let size = found.lengths.iter().copied().fold(0.0, f64::max);
                // What rounding of the forces does to the softest motion.
                let soft = 1e-13 * largest / again.stability.least_stiffness();
                if motion > 1e-12 * size + soft {
                    return ("not found again", seed, format!("{motion:e} m"));
                }
                return ("found, and again from its lengths", seed, text);
            }
            ("found", seed, text)
        })
        .collect();
    let mut counts = BTreeMap::new();
    for (outcome, seed, text) in &outcomes {
        let count = counts.entry(*outcome).or_insert(0);
        *count += 1;
        if *count <= 3 {
            println!("{outcome}, seed {seed}: {text}");
        }
    }
    println!("{counts:?}");
    let count = |outcome: &str| counts.get(outcome).copied().unwrap_or(0);
    let others = count("another minimum than the drawn tensions");
    let found = count("found") + count("found, and again from its lengths") + others;
    accept("V-INVERSE-004", found as f64 / (CASES - count("not drawn")) as f64);
    assert!(found > 9_000 && others < 5, "{counts:?}");
}

/// `data/reference/drawn.py` looks for the least norm of the first 200 of these robots from 24 starts each.
#[test]
fn no_norm_is_above_the_best_that_an_independent_solver_finds() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/drawn.json")).unwrap();
    let norm = |t: &[f64]| t.iter().map(|t| t * t).sum::<f64>().sqrt();
    let mut counts = BTreeMap::new();
    for row in file["robots"].as_array().unwrap() {
        let (seed, row) = (row[0].as_u64().unwrap(), numbers(row));
        let Drawn { robot, pose, load, tensions } = drawn(seed).unwrap();
        let (drawn_norm, least, starts, held) = (row[1], row[2], row[4], row[5]);
        assert!((norm(&tensions) / drawn_norm - 1.0).abs() < 1e-12, "seed {seed} is another robot there");
        let ours = match inverse(&robot, &pose, &load) {
            Ok(found) => norm(&found.tensions) / least - 1.0,
            Err(error) => panic!("seed {seed}: {error}"),
        };
        accept("V-INVERSE-003", ours);
        let outcome = match ours {
            _ if ours > 1e-9 => "above",
            _ if ours < -1e-9 => "below",
            _ if starts < held => "the same, where starts lead to several minima",
            _ => "the same",
        };
        *counts.entry(outcome).or_insert(0) += 1;
        if ours.abs() > 1e-9 {
            println!("{outcome}, seed {seed}: {ours:e}, {starts} of {held} starts");
        }
    }
    println!("{counts:?}");
    assert_eq!(counts.values().sum::<i32>(), 200);
}

/// CAROCA with everything that its tensions can be in doubt about.
fn caroca() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap()
}

#[test]
fn set_points_around_the_least_tension_change_lengths_steadily() {
    let (robot, pose) = (caroca(), Pose::at(2.0, 1.0, 1.0));
    let length = |tension: f64| lengths_for_tensions(&robot, &pose, &[tension; 8]).unwrap().lengths[0];
    let end = robot.span(&pose, 0);
    let least = cdpr_cable::HeldCable::at_least_tension(&robot.cable(0), end).unwrap().tension();
    for share in [1.0, 1.001] {
        let [below, above] = [-1e-6, 1e-6].map(|e| length(least * share * (1.0 + e)));
        assert!((below - above).abs() < 1e-3, "{share}: {below} {above}");
    }
}

#[test]
fn a_light_platform_between_prestressed_cables_is_held() {
    let mut robot = ipanema();
    robot.tension_limits = TensionLimits { min: 1e3, max: 4e3 };
    for mass in [10.0, 1.0, 0.1, 1e-8] {
        robot.platform.mass = mass;
        let held = inverse(&robot, &Pose::at(0.1, 0.1, 1.0), &Load::none()).unwrap();
        assert!(held.residual.force < 1e-9 && held.stationarity < 1e-9, "{mass}: {held:?}");
        assert!(held.tensions.iter().all(|t| (1e3..=4e3).contains(t)), "{held:?}");
    }
}

#[test]
fn a_robot_without_gravity_is_held_by_its_prestress_alone() {
    let mut robot = ipanema();
    robot.gravity = (0.0).into();
    let held = inverse(&robot, &Pose::at(0.1, -0.2, 1.2), &Load::none()).unwrap();
    assert!(held.residual.force < 1e-11 && held.active.contains(&Some(Bound::Min)), "{held:?}");
}

/// All points in one vertical plane: the wrenches of the cables span three of six dimensions.
#[test]
fn a_pose_of_deficient_rank_is_held_where_the_load_lies_in_its_plane() {
    let mut robot = caroca();
    for cable in &mut robot.cables {
        cable.exit_point.y = 0.0;
        cable.anchor_point.y = 0.0;
        cable.anchor_point.x += 0.05 * cable.exit_point.x;
    }
    for (i, cable) in robot.cables.iter_mut().enumerate() {
        cable.exit_point.z += 0.1 * i as f64;
    }
    let pose = Pose::at(0.3, 0.0, 1.5);
    let held = inverse(&robot, &pose, &Load::none()).unwrap();
    assert!(held.residual.force < 1e-9 && held.residual.moment < 1e-9, "{:?}", held.residual);
    // Nothing resists a force out of the plane.
    let across = Wrench { force: Vector3::new(0.0, 10.0, 0.0), moment: Vector3::zeros() };
    let refused = inverse(&robot, &pose, &Load::wrench(across));
    assert!(matches!(refused, Err(StaticsError::NoTensions { rank_deficient: true, .. })), "{refused:?}");
}

#[test]
fn limits_just_below_the_only_tensions_that_balance_are_named_as_what_is_in_the_way() {
    let robot = Robot::from_library("nist-robocrane").unwrap();
    for pose in [Pose::at(0.0, 0.0, -2.0), Pose::at(0.3, 0.2, -2.5)] {
        let held = inverse(&robot, &pose, &Load::none()).unwrap().tensions;
        let greatest = held.iter().copied().fold(0.0, f64::max);
        let below = |share: f64| {
            let mut robot = robot.clone();
            robot.tension_limits.max = (1.0 - share) * greatest;
            inverse(&robot, &pose, &Load::none())
        };
        for share in [1e-6, 1e-7, 3e-8, 1e-8, 3e-9, 1e-9, 3e-10] {
            let error = below(share).unwrap_err();
            let StaticsError::NoTensions { force, blocked, refuted, .. } = &error else { panic!("{error}") };
            // Six cables have no other tensions: what is missing is the share.
            assert!((0.3..3.0).contains(&(force / (share * greatest))), "{share}: {error}");
            assert!(!blocked.is_empty() && !refuted && !error.to_string().contains("of 0.000 N"), "{error}");
        }
        assert!(below(1e-12).is_ok() && below(-1e-9).is_ok());
    }
}
