//! Which root of the balance is taken where cables are fewer than free motions.

use crate::equilibria::number;
use cdpr_evidence::accept;
use cdpr_robot::{Coordinate, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::error::RestFault;
use cdpr_statics::free_coordinates::{FreeSolution, FreeSolutions, LONGEST, free_solutions};
use cdpr_statics::limits::{Limit, out_of_limits};
use cdpr_statics::{DirectProblem, Load, StaticsError, WantedPose, inverse};
use serde_json::Value;

const FREE: [Coordinate; 2] = [Coordinate::Roll, Coordinate::Pitch];

fn four_cables() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/four-cables.json")).unwrap()
}

#[test]
fn the_taut_root_within_the_limits_is_taken() {
    let found =
        free_solutions(&four_cables(), WantedPose::at(&Pose::at(0.5, 0.3, 2.0)).free(&FREE), &Load::none())
            .unwrap()
            .first;
    let (roll, pitch, _) = found.equilibrium.pose.rotation.euler_angles();
    for (angle, expected) in [(roll, 3.075547), (pitch, -1.224933)] {
        assert!((angle.to_degrees() - expected).abs() < 1e-6, "{roll} {pitch}");
    }
    for (length, expected) in found.lengths.iter().zip([5.8017435, 5.1433489, 4.8092710, 5.5122534]) {
        assert!((length - expected).abs() < 1e-7, "{:?}", found.lengths);
    }
    for (tension, expected) in found.tensions.iter().zip([453.573, 85.081, 501.209, 73.323]) {
        assert!((tension - expected).abs() < 1e-3, "{:?}", found.tensions);
    }
    assert!(found.stability.is_stable());
}

#[test]
fn a_grid_has_roots_within_the_limits_where_taut_cables_have_them() {
    let robot = four_cables();
    for x in [0.3, 0.4, 0.5, 0.6] {
        for y in [0.2, 0.3, 0.4] {
            for z in [1.5, 2.0, 2.5] {
                let found =
                    free_solutions(&robot, WantedPose::at(&Pose::at(x, y, z)).free(&FREE), &Load::none());
                let exists = !((y == 0.2 && x >= 0.5) || (y == 0.3 && x == 0.6));
                assert_eq!(found.is_ok(), exists, "{x}, {y}, {z}");
                match found {
                    Ok(found) => assert!(found.first.loops(&robot).is_empty()),
                    Err(StaticsError::NoRest { nearest, .. }) => println!("{x} {y} {z}: {nearest}"),
                    Err(other) => panic!("{other}"),
                }
            }
        }
    }
}

#[test]
fn a_loop_is_an_answer_only_where_it_is_asked_for() {
    let robot = Robot::from_json(include_str!("../../../data/reference/robots/four-crossed-cables.json"));
    let robot = robot.unwrap();
    for pose in [Pose::at(0.9, 0.9, 0.2), Pose::at(0.0, 0.0, 2.0)] {
        match free_solutions(&robot, WantedPose::at(&pose).free(&FREE), &Load::none()) {
            Ok(found) => assert_sound(&robot, &found.first),
            Err(StaticsError::NoRest { nearest, .. }) => println!("{nearest}"),
            Err(other) => panic!("{other}"),
        }
        let found =
            free_solutions(&robot, WantedPose::at(&pose).free(&FREE).with_loops(), &Load::none()).unwrap();
        let mut all = [&found.first].into_iter().chain(&found.others);
        assert!(all.any(|one| !one.loops(&robot).is_empty()), "{:?}", found.first.lengths);
    }
}

#[test]
fn a_stable_root_near_other_ones_is_found() {
    let pose = Pose::at(-0.52, 0.05, 3.28);
    let found =
        free_solutions(&four_cables(), WantedPose::at(&pose).free(&FREE), &Load::none()).unwrap().first;
    assert!(found.stability.is_stable());
    assert_sound(&four_cables(), &found);
    for (tension, expected) in found.tensions.iter().zip([126.0, 836.0, 28.0, 836.0]) {
        assert!((tension - expected).abs() < 12.0, "{:?}", found.tensions);
    }
}

#[test]
fn a_refusal_names_the_cable_and_its_limit() {
    let mut robot = four_cables();
    robot.tension_limits.min = 80.0;
    let error = free_solutions(&robot, WantedPose::at(&Pose::at(0.5, 0.3, 2.0)).free(&FREE), &Load::none())
        .unwrap_err();
    let StaticsError::NoRest { nearest: RestFault::Limit(passed), .. } = &error else { panic!("{error}") };
    assert_eq!((passed.cable, passed.limit, passed.value), (3, Limit::Min, 80.0));
    let text = error.to_string();
    assert!(text.contains("only with cable 4 at 73.323 N, below its limit of 80 N"), "{text}");
    assert_eq!(error.kind(), "infeasible_tension");
}

#[test]
fn no_anchor_point_and_no_cable_is_below_the_ground() {
    let pose = Pose::at(0.5, 0.3, 2.0);
    let on = |ground_z: f64, heavy: f64| {
        let mut robot = Robot { ground_z: Some(ground_z), ..four_cables() };
        robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density *= heavy);
        free_solutions(&robot, WantedPose::at(&pose).free(&FREE), &Load::none())
    };
    assert!(on(2.0, 1.0).is_ok());
    let error = on(2.25, 1.0).unwrap_err();
    let StaticsError::NoRest { nearest: RestFault::BelowGround { is_anchor, height, .. }, .. } = &error
    else {
        panic!("{error}")
    };
    assert!(*is_anchor && (2.1..2.25).contains(height), "{error}");
    // A cable that hangs below its anchor point, on a level base and on one that is hardly tilted.
    let pose = Pose::at(-2.5, 0.1, 4.2);
    for tilt in [0.0, 1e-9] {
        let mut robot = four_cables();
        robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 2.0);
        robot.gravity = Vector3::new(tilt, 0.0, -9.81).into();
        let lowest = |found: &FreeSolution| {
            let (none, at) = (Load::none(), &found.equilibrium);
            let problem = DirectProblem::new(&robot, &found.lengths, &none).unwrap();
            let of_cable = |i: usize| {
                let points = problem.shape(at, i, 2, 2001).unwrap().points.into_iter().map(|point| point.z);
                let anchor = at.pose.position.z + robot.anchor_arm(&at.pose, i).z;
                (points.fold(f64::INFINITY, f64::min), anchor)
            };
            let all = (0..4).map(of_cable);
            all.fold((f64::INFINITY, f64::INFINITY), |(a, b), (c, d)| (a.min(c), b.min(d)))
        };
        let found = free_solutions(&robot, WantedPose::at(&pose).free(&FREE), &Load::none()).unwrap().first;
        let (hanging, anchor) = lowest(&found);
        assert!(hanging < anchor - 0.01, "{hanging} {anchor}");
        let above = |ground: f64| {
            let robot = Robot { ground_z: Some(ground), ..robot.clone() };
            free_solutions(&robot, WantedPose::at(&pose).free(&FREE), &Load::none())
        };
        assert_eq!(above(hanging - 0.005).unwrap().first, found);
        match above(hanging + 0.005) {
            Ok(other) => assert!(lowest(&other.first).0 > hanging + 0.0049),
            Err(StaticsError::NoRest { nearest, .. }) => {
                assert!(matches!(nearest, RestFault::BelowGround { is_anchor: false, .. }), "{nearest}");
            }
            Err(other) => panic!("{other}"),
        }
    }
}

/// Within the limits, no loop, in balance.
fn assert_sound(robot: &Robot, found: &FreeSolution) {
    let passed = out_of_limits(robot, &found.lengths, &[&found.equilibrium]);
    assert!(passed.iter().all(|one| !matches!(one.limit, Limit::Min | Limit::Max)), "{passed:?}");
    assert!(found.loops(robot).is_empty());
    let weight = robot.platform.mass * robot.gravity.magnitude();
    assert!(found.residual.force < 1e-7 * weight && found.residual.closure < 1e-9, "{:?}", found.residual);
}

/// A pose of the reference: x, y, z [m], roll, pitch, yaw [rad].
fn pose_of(robot: &Robot, numbers: &[f64]) -> Pose {
    let rotation = match robot.plane {
        Some(plane) => Rotation3::new(Vector3::ith(plane.normal(), numbers[3 + plane.normal()])),
        None => Rotation3::from_euler_angles(numbers[3], numbers[4], numbers[5]),
    };
    Pose { position: Vector3::new(numbers[0], numbers[1], numbers[2]), rotation }
}

/// Distance of two poses by where they take the points of a platform.
fn apart(robot: &Robot, one: &Pose, other: &Pose) -> f64 {
    let anchors = robot.cables.iter().map(|cable| cable.anchor_point);
    let points = anchors.chain([robot.platform.center_of_mass]);
    let at = |pose: &Pose, point: &Vector3<f64>| pose.position + pose.rotation * point;
    points.map(|point| (at(one, &point) - at(other, &point)).norm()).fold(0.0, f64::max)
}

/// What became of the poses of a robot.
#[derive(Default)]
struct Tally {
    poses: usize,
    /// The reference has a taut, stable root within the limits, and so has the answer; the same root.
    stable: usize,
    found: usize,
    same: usize,
    /// All its roots of the reference, and those among the answers.
    roots: usize,
    listed: usize,
    refused: usize,
}

#[test]
fn taut_solutions_are_found_where_an_independent_search_has_them() {
    let reference: Value =
        serde_json::from_str(include_str!("../../../data/reference/few_roots.json")).unwrap();
    assert_eq!(number(&reference["longest_chords"]), LONGEST);
    let mut all = Tally::default();
    for case in reference["cases"].as_array().unwrap() {
        let tally = tally(case);
        let Tally { poses, stable, found, same, roots, listed, refused } = tally;
        println!(
            "{:30} {poses} poses, {found} of {stable} with a stable root ({same} the same), \
             {listed} of {roots} roots, {refused} refused",
            case["name"].as_str().unwrap()
        );
        all = Tally {
            poses: all.poses + poses,
            stable: all.stable + stable,
            found: all.found + found,
            same: all.same + same,
            roots: all.roots + roots,
            listed: all.listed + listed,
            refused: all.refused + refused,
        };
    }
    let Tally { poses, stable, found, same, roots, listed, refused } = all;
    println!("{poses} poses: {found} of {stable}, {same} the same; {listed} of {roots}; {refused} refused");
    assert!(poses == 2000 && stable > 800, "{poses} {stable}");
    accept("V-DIRECT-010", found as f64 / stable as f64);
    // The other solutions are those that the search has met.
    accept("V-DIRECT-011", listed as f64 / roots as f64);
}

fn tally(case: &Value) -> Tally {
    let robot = Robot::from_json(&case["robot"].to_string()).unwrap();
    let free: Vec<Coordinate> =
        case["free"].as_array().unwrap().iter().map(|name| name.as_str().unwrap().parse().unwrap()).collect();
    let edge: Vec<u64> = case["edge"].as_array().unwrap().iter().map(|i| i.as_u64().unwrap()).collect();
    let numbers = |list: &Value| -> Vec<f64> { list.as_array().unwrap().iter().map(number).collect() };
    let mut tally = Tally::default();
    let each = case["poses"].as_array().unwrap().iter().zip(case["roots"].as_array().unwrap());
    for (index, (pose, roots)) in each.enumerate() {
        tally.poses += 1;
        let given = numbers(pose);
        let wanted = pose_of(&robot, &given);
        let answer = free_solutions(&robot, WantedPose::at(&wanted).free(&free), &Load::none());
        let expected: Vec<(Pose, i8)> = roots
            .as_array()
            .unwrap()
            .iter()
            .map(|root| {
                let (root, mut at) = (numbers(root), given.clone());
                for (coordinate, value) in free.iter().zip(&root) {
                    at[coordinate.component()] = *value;
                }
                (pose_of(&robot, &at), root[free.len()] as i8)
            })
            .collect();
        let stable: Vec<&Pose> = expected.iter().filter(|one| one.1 == 1).map(|one| &one.0).collect();
        let FreeSolutions { first, others } = match answer {
            Ok(found) => found,
            Err(StaticsError::NoRest { nearest, .. }) => {
                tally.refused += 1;
                if !stable.is_empty() && !edge.contains(&(index as u64)) {
                    println!("missed at {given:?}: {nearest}");
                    tally.stable += 1;
                }
                continue;
            }
            Err(other) => panic!("{other}"),
        };
        assert_sound(&robot, &first);
        assert!([&first].into_iter().chain(&others).all(|one| one.loops(&robot).is_empty()));
        if !stable.is_empty() {
            tally.stable += 1;
            tally.found += usize::from(first.stability.is_stable());
            let to_first = |pose: &&&Pose| apart(&robot, pose, &first.equilibrium.pose) < 1e-5;
            tally.same += usize::from(stable.iter().any(|pose| to_first(&pose)));
        }
        for (pose, _) in &expected {
            tally.roots += 1;
            let all = [&first].into_iter().chain(&others);
            let near = |one: &FreeSolution| apart(&robot, pose, &one.equilibrium.pose) < 1e-5;
            tally.listed += usize::from(all.into_iter().any(near));
        }
        // What commands and studies start from is sound, too.
        if index % 10 == 0 {
            let held = inverse(&robot, WantedPose::at(&wanted).free(&free), &Load::none()).unwrap();
            let passed = out_of_limits(&robot, &held.lengths, &[&held.equilibrium]);
            assert!(passed.iter().all(|one| !matches!(one.limit, Limit::Min | Limit::Max)), "{passed:?}");
        }
    }
    tally
}

/// A head of 60 kg below four far winches, symmetric in x and y.
fn arena_head(least: f64) -> Robot {
    let cable = |x: f64, y: f64| {
        let [a, b] = [0.2 * x.signum(), 0.15 * y.signum()];
        format!(r#"{{"exit_point": [{x}, {y}, 35], "anchor_point": [{a}, {b}, 0.2]}}"#)
    };
    let cables = [(-60.0, -40.0), (60.0, -40.0), (60.0, 40.0), (-60.0, 40.0)].map(|(x, y)| cable(x, y));
    let text = format!(
        r#"{{"format": "cdpr-robot/1", "name": "head", "gravity": 9.81, "ground_z": 0,
        "platform": {{"mass": 60, "center_of_mass": [0, 0, -0.3]}},
        "cable": {{"section": 1.045e-5, "youngs_modulus": 1e11, "linear_density": 0.09525}},
        "pulley": {{"radius": 0.15, "axis": [0, 0, 1]}}, "lead": 35,
        "tension_limits": {{"min": {least}, "max": 5000}}, "cables": [{}]}}"#,
        cables.join(", ")
    );
    Robot::from_json(&text).unwrap()
}

#[test]
fn a_rest_below_the_ground_says_which_tension_is_out_of_its_limits_too() {
    // Cable 1 reaches z = -13 m with 71 N.
    let at = Pose::at(40.0, 17.0, 10.0);
    let refused = |least: f64| {
        let robot = arena_head(least);
        free_solutions(&robot, WantedPose::at(&at).free(&FREE), &Load::none()).unwrap_err().to_string()
    };
    let (both, one) = (refused(100.0), refused(20.0));
    assert!(both.contains("below the ground at 0 m, and with cable 1 at 7"), "{both}");
    assert!(both.contains(" N, below its limit of 100 N; change the pose, or both ground_z and"), "{both}");
    assert!(one.ends_with("below the ground at 0 m; change the pose or ground_z"), "{one}");
}
