//! The greatest payload and the margin of tensions are where the inverse model ends.

use cdpr_robot::{CableEnd, Plane, Pose, Robot, Vector3, Wrench};
use cdpr_statics::capacity::{Blocking, greatest_payload, tension_margin};
use cdpr_statics::limits::Limit;
use cdpr_statics::{Load, MAX_STRAIN, StaticsError, inverse, is_feasible};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::time::Instant;

/// A robot of the library without breaking forces.
fn robot(name: &str) -> Robot {
    let path = format!("{}/../../data/robots/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let mut robot = Robot::from_json(&std::fs::read_to_string(path).unwrap()).unwrap();
    robot.cables.iter_mut().for_each(|cable| cable.properties.breaking_force = None);
    robot
}

/// Robots that are suspended and prestressed, light and heavy, with pulleys.
const PLACES: [(&str, [f64; 3]); 7] = [
    ("cogiro", [0.0, 0.0, 2.0]),
    ("cogiro", [3.0, -1.5, 1.0]),
    ("caroca", [0.0, 0.0, 1.75]),
    ("caroca", [0.5, -0.3, 1.75]),
    ("ipanema-3", [0.2, 0.1, 1.3]),
    ("fast", [20.0, 10.0, 140.0]),
    ("expo2015-lucia", [0.0, 0.0, 2.0]),
];

#[test]
fn the_inverse_model_holds_the_greatest_payload_and_no_more() {
    for (name, [x, y, z]) in PLACES {
        let robot = robot(name);
        let pose = Pose::at(x, y, z).moved(Vector3::zeros(), Vector3::new(0.02, -0.01, 0.03));
        let wrench = Wrench { force: Vector3::new(20.0, -10.0, 5.0), moment: Vector3::new(1.0, 2.0, -3.0) };
        let found = greatest_payload(&robot, &pose, &wrench).unwrap();
        let holds = |payload| inverse(&robot, &pose, &Load { payload, wrench }).is_ok();
        println!("{name}: {} kg in {} programs, {:?}", found.value, found.iterations, found.blocking);
        assert!(holds(found.value * (1.0 - 1e-7)) && !holds(found.value * (1.0 + 1e-6)), "{name}");
        let largest = found.tensions.iter().fold(0.0, |a: f64, t| a.max(*t));
        assert!(found.residual.force < 1e-9 * largest && found.residual.closure < 1e-9, "{name}");
        assert!(!found.blocking.is_empty());
    }
}

#[test]
fn the_limits_can_be_drawn_in_by_the_margin_and_no_more() {
    for (name, [x, y, z]) in PLACES {
        let robot = robot(name);
        let pose = Pose::at(x, y, z);
        let found = tension_margin(&robot, &pose, &Load::payload(3.0)).unwrap();
        let holds = |margin| inverse(&drawn_in(&robot, margin), &pose, &Load::payload(3.0)).is_ok();
        println!("{name}: {} N in {} programs, {:?}", found.value, found.iterations, found.blocking);
        let size = 1e-7 * robot.limits(0).max;
        assert!(holds(found.value - size) && !holds(found.value + 10.0 * size), "{name}");
    }
}

/// Poses spread over the space between the exit points, tilted by up to 0.15 rad.
fn poses(robot: &Robot, count: usize) -> Vec<Pose> {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let exits: Vec<_> = robot.cables.iter().map(|cable| cable.exit_point).collect();
    let [low, high] =
        [f64::min, f64::max].map(|ext| exits.iter().fold(exits[0], |corner, exit| corner.zip_map(exit, ext)));
    let wide = (high - low).max();
    let pose = |_| {
        let mut position = low.zip_map(&high, |low, high| rng.random_range(low..=high));
        position.z = rng.random_range(high.z - 0.5 * wide..=high.z);
        let tilt = Vector3::from_fn(|_, _| rng.random_range(-0.15..0.15));
        Pose::at(position.x, position.y, position.z).moved(Vector3::zeros(), tilt)
    };
    (0..count).map(pose).collect()
}

/// The robot with all limits of tension drawn in by a margin [N].
fn drawn_in(robot: &Robot, margin: f64) -> Robot {
    let mut drawn = robot.clone();
    for (i, cable) in drawn.cables.iter_mut().enumerate() {
        let limits = robot.limits(i);
        cable.tension_limits.min = Some(limits.min + margin);
        cable.tension_limits.max = Some(limits.max - margin);
    }
    drawn
}

/// What is wrong about the greatest payload at a pose that is held, if anything is.
fn payload_fault(robot: &Robot, pose: &Pose) -> Option<String> {
    let holds = |payload| inverse(robot, pose, &Load::payload(payload)).is_ok();
    let found = match greatest_payload(robot, pose, &Wrench::none()) {
        Ok(found) => found,
        Err(error) => return Some(error.to_string()),
    };
    let largest = found.tensions.iter().fold(0.0, |a: f64, t| a.max(*t));
    let is_balanced = found.residual.force < 1e-9 * largest && found.residual.closure < 1e-9;
    // Next to the greatest payload the search for tensions may fail; there the residual is the proof.
    let [less, more] = [1.0 - 1e-4, 1.0 + 1e-6].map(|share| holds(share * found.value));
    let is_right = is_balanced && less && !more;
    (!is_right).then(|| format!("{} kg, balanced {is_balanced}, less {less}, more {more}", found.value))
}

/// What is wrong about the margin at a pose that is held, if anything is.
fn margin_fault(robot: &Robot, pose: &Pose) -> Option<String> {
    let holds = |margin| inverse(&drawn_in(robot, margin), pose, &Load::none()).is_ok();
    let found = match tension_margin(robot, pose, &Load::none()) {
        Ok(found) => found,
        Err(error) => return Some(error.to_string()),
    };
    let size = robot.limits(0).max;
    let [less, more] = [-1e-4, 1e-6].map(|share| holds(found.value + share * size));
    (!less || more).then(|| format!("{} N, less {less}, more {more}", found.value))
}

/// `CDPR_CASES=400 cargo test -p cdpr-statics --test integration payloads_and_margins_are -- --nocapture`
#[test]
fn payloads_and_margins_are_found_wherever_the_platform_is_held() {
    let cases = std::env::var("CDPR_CASES").map_or(60, |count| count.parse().unwrap());
    let mut faults = Vec::new();
    for name in ["caroca", "cogiro", "copacabana-handling", "ipanema-3", "expo2015-lucia"] {
        let robot = robot(name);
        let held = |pose: &Pose| inverse(&robot, pose, &Load::none()).is_ok();
        let poses: Vec<_> = poses(&robot, cases).into_iter().filter(held).collect();
        assert!(poses.len() >= 10, "{name}: {} poses are held", poses.len());
        for pose in &poses {
            let found = [payload_fault(&robot, pose), margin_fault(&robot, pose)].into_iter().flatten();
            faults.extend(found.map(|fault| format!("{name} at {:?}: {fault}", pose.position.as_slice())));
        }
        println!("{name}: {} held poses, {} faults until here", poses.len(), faults.len());
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Breaking forces act at both ends, and in these robots the exit points are the higher ones: limits at the
/// exit say the same.
#[test]
fn breaking_forces_limit_payloads_and_margins() {
    for (name, [x, y, z]) in PLACES {
        let limited = robot(name);
        let pose = Pose::at(x, y, z);
        let force = 0.6 * limited.limits(0).max;
        let mut breaking = limited.clone();
        breaking.cables.iter_mut().for_each(|cable| cable.properties.breaking_force = Some(force));
        let mut at_exit = limited.clone();
        for cable in &mut at_exit.cables {
            cable.tension_limits.max = Some(force);
            cable.tension_limits.max_at = Some(CableEnd::Exit);
        }
        let wrench = Wrench::none();
        let [found, known] =
            [&breaking, &at_exit].map(|robot| greatest_payload(robot, &pose, &wrench).unwrap());
        assert!(
            (found.value / known.value - 1.0).abs() < 1e-9,
            "{name}: {} kg, {}",
            found.value,
            known.value
        );
        assert!(found.value < greatest_payload(&limited, &pose, &wrench).unwrap().value);
        let ends = found.equilibrium.exit_tensions(&breaking, &found.lengths);
        assert!(ends.iter().chain(&found.tensions).all(|tension| *tension < force * (1.0 + 1e-9)), "{name}");
        let broken = |block: &Blocking| block.limit == Limit::BreakingForce && block.value == force;
        assert!(found.blocking.iter().any(broken), "{name}: {:?}", found.blocking);
        let [found, known] =
            [&breaking, &at_exit].map(|robot| tension_margin(robot, &pose, &Load::none()).unwrap().value);
        assert!((found - known).abs() < 1e-9 * force, "{name}: {found} N, {known}");
    }
}

/// Of a point mass with its load at the centre of mass a force of F upwards gives F/g more, however great.
#[test]
fn a_force_upwards_is_worth_its_payload() {
    let mut point = robot("cogiro");
    point.cables = [0, 2, 4, 6].map(|i| point.cables[i].clone()).to_vec();
    point.cables.iter_mut().for_each(|cable| cable.anchor_point = Vector3::zeros());
    (point.platform.point, point.platform.center_of_mass) = (true, Vector3::zeros());
    let payload = |up: f64| {
        let wrench = Wrench { force: Vector3::new(0.0, 0.0, up), moment: Vector3::zeros() };
        greatest_payload(&point, &Pose::at(0.5, 0.3, 2.0), &wrench).unwrap().value
    };
    let (own, sum) = (payload(0.0), 4.0 * point.limits(0).max);
    for up in [0.5 * sum, sum, 2.0 * sum, 10.0 * sum] {
        let expected = own + up / point.gravity.magnitude();
        assert!((payload(up) / expected - 1.0).abs() < 1e-8, "{up} N: {} kg, not {expected}", payload(up));
    }
}

#[test]
fn a_table_carries_any_payload() {
    let mut table = robot("cogiro");
    table.plane = Some(Plane::Xy);
    for cable in &mut table.cables {
        (cable.exit_point.z, cable.anchor_point.z) = (0.0, 0.0);
    }
    let found = greatest_payload(&table, &Pose::at(0.2, -0.1, 0.0), &Wrench::none()).unwrap();
    assert_eq!((found.value, found.blocking.len()), (f64::INFINITY, 0));
    assert!(found.residual.force < 1e-6, "{:?}", found.residual);
}

#[test]
fn the_greatest_payload_strains_no_cable_too_much() {
    // A fibre of 2 GPa whose limits of tension allow several times the greatest strain.
    let pose = Pose::at(1.0, -0.5, 2.0);
    let mut robot = robot("cogiro");
    for cable in &mut robot.cables {
        cable.properties.youngs_modulus = 2e9;
    }
    let largest = robot.limits(0).max / robot.cables[0].properties.axial_stiffness();
    assert!(largest > 1.5 * MAX_STRAIN, "{largest}");
    let found = greatest_payload(&robot, &pose, &Wrench::none()).unwrap();
    let tensions = found.equilibrium.exit_tensions(&robot, &found.lengths);
    let strains = tensions.iter().enumerate().map(|(i, tension)| robot.cable(i).strain(*tension));
    let greatest = strains.fold(0.0, f64::max);
    assert!(greatest <= MAX_STRAIN && greatest > (1.0 - 1e-6) * MAX_STRAIN, "{greatest}");
    let strained: Vec<_> = found.blocking.iter().filter(|block| block.limit == Limit::Strain).collect();
    assert!(!strained.is_empty() && found.value > 0.0, "{:?}", found.blocking);
    let beyond = inverse(&robot, &pose, &Load::payload(1.01 * found.value)).unwrap_err();
    assert_eq!(beyond.kind(), "cable_overstrained");
    // Stronger cables carry the limit of tension.
    assert!(greatest_payload(&self::robot("cogiro"), &pose, &Wrench::none()).unwrap().value > found.value);
}

#[test]
fn what_a_limit_gives_is_the_slope_of_the_payload() {
    let robot = robot("cogiro");
    let pose = Pose::at(1.0, 0.5, 2.0);
    let at = |robot: &Robot| greatest_payload(robot, &pose, &Wrench::none()).unwrap();
    let found = at(&robot);
    assert_eq!(found.blocking.len(), 3);
    for block in &found.blocking {
        let moved = |by: f64| {
            let mut other = robot.clone();
            let limits = robot.limits(block.index);
            let own = &mut other.cables[block.index].tension_limits;
            match block.limit {
                Limit::Max => own.max = Some(limits.max + by),
                Limit::Min => own.min = Some(limits.min - by),
                limit => panic!("{limit:?}"),
            }
            at(&other).value
        };
        let slope = 0.5 * (moved(1.0) - moved(-1.0));
        assert!((slope / block.gain - 1.0).abs() < 1e-4, "{slope} {block:?}");
    }
}

#[test]
fn a_pose_that_no_pull_can_hold_is_refused() {
    let robot = robot("cogiro");
    let error = greatest_payload(&robot, &Pose::at(12.0, 0.0, 2.0), &Wrench::none()).unwrap_err();
    assert!(matches!(error, StaticsError::NoTensions { .. }), "{error}");
}

/// `CDPR_CASES=2000 cargo test -p cdpr-statics --test integration whether_a_pose -- --nocapture`
#[test]
fn whether_a_pose_is_held_is_what_the_inverse_model_finds() {
    let cases = std::env::var("CDPR_CASES").map_or(60, |count| count.parse().unwrap());
    let robots = ["caroca", "cogiro", "ipanema-3", "fast", "segesta", "nist-robocrane", "hrpcables"];
    for name in robots {
        let robot = robot(name);
        let (mut counts, mut times) = ([[0; 2]; 2], [0.0; 2]);
        for pose in poses(&robot, cases) {
            let load = Load::payload(0.1 * robot.platform.mass);
            let clock = Instant::now();
            let quick = is_feasible(&robot, &pose, &load).unwrap_or(false);
            times[0] += clock.elapsed().as_secs_f64();
            let clock = Instant::now();
            let held = match inverse(&robot, &pose, &load) {
                Ok(_) | Err(StaticsError::InverseNotConverged { .. }) => true,
                Err(_) => false,
            };
            times[1] += clock.elapsed().as_secs_f64();
            counts[usize::from(held)][usize::from(quick)] += 1;
        }
        let [[none, wrong], [missed, found]] = counts;
        let [quick, whole] = times.map(|time: f64| 1e6 * time / cases as f64);
        println!(
            "{name}: {found} held, {none} not; {missed} held ones not found, {wrong} wrong; \
             {quick:.0} us a pose, the inverse model {whole:.0} us"
        );
        assert_eq!(wrong, 0, "{name}");
        assert!(missed <= (found + missed) / 50, "{name}");
    }
}
