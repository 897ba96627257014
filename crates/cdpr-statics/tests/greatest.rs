//! The greatest payload and the margin of tensions are where the inverse model ends.

use cdpr_robot::{Pose, Robot, Vector3, Wrench};
use cdpr_statics::{Bound, Load, StaticsError, greatest_payload, inverse, is_held, tension_margin};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::time::Instant;

fn robot(name: &str) -> Robot {
    let path = format!("{}/../../data/robots/{name}.json", env!("CARGO_MANIFEST_DIR"));
    Robot::from_json(&std::fs::read_to_string(path).unwrap()).unwrap()
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
        let holds = |payload| inverse(&robot, &pose, &Load { payload, wrench }, None).is_ok();
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
        let holds = |margin: f64| {
            let mut drawn = robot.clone();
            for (i, cable) in drawn.cables.iter_mut().enumerate() {
                let limits = robot.limits(i);
                cable.tension_limits.min = Some(limits.min + margin);
                cable.tension_limits.max = Some(limits.max - margin);
            }
            inverse(&drawn, &pose, &Load::payload(3.0), None).is_ok()
        };
        println!("{name}: {} N in {} programs, {:?}", found.value, found.iterations, found.blocking);
        let size = 1e-7 * robot.limits(0).max;
        assert!(holds(found.value - size) && !holds(found.value + 10.0 * size), "{name}");
    }
}

#[test]
fn what_a_limit_gives_is_the_slope_of_the_payload() {
    let robot = robot("cogiro");
    let pose = Pose::at(1.0, 0.5, 2.0);
    let at = |robot: &Robot| greatest_payload(robot, &pose, &Wrench::zero()).unwrap();
    let found = at(&robot);
    assert_eq!(found.blocking.len(), 3);
    for block in &found.blocking {
        let moved = |by: f64| {
            let mut other = robot.clone();
            let limits = robot.limits(block.index);
            let own = &mut other.cables[block.index].tension_limits;
            match block.bound {
                Bound::Max => own.max = Some(limits.max + by),
                Bound::Min => own.min = Some(limits.min - by),
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
    let error = greatest_payload(&robot, &Pose::at(12.0, 0.0, 2.0), &Wrench::zero()).unwrap_err();
    assert!(matches!(error, StaticsError::NoTensions { .. }), "{error}");
}

/// `CDPR_CASES=2000 cargo test -p cdpr-statics --test integration whether_a_pose -- --nocapture`
#[test]
fn whether_a_pose_is_held_is_what_the_inverse_model_finds() {
    let cases = std::env::var("CDPR_CASES").map_or(60, |count| count.parse().unwrap());
    let robots = ["caroca", "cogiro", "ipanema-3", "fast", "segesta", "nist-robocrane", "hrpcables"];
    for name in robots {
        let robot = robot(name);
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        let exits: Vec<_> = robot.cables.iter().map(|cable| cable.exit_point).collect();
        let [low, high] = [f64::min, f64::max]
            .map(|ext| exits.iter().fold(exits[0], |corner, exit| corner.zip_map(exit, ext)));
        let wide = (high - low).max();
        let (mut counts, mut times) = ([[0; 2]; 2], [0.0; 2]);
        for _ in 0..cases {
            let mut position = low.zip_map(&high, |low, high| rng.random_range(low..=high));
            position.z = rng.random_range(high.z - 0.5 * wide..=high.z);
            let tilt = Vector3::from_fn(|_, _| rng.random_range(-0.15..0.15));
            let pose = Pose::at(position.x, position.y, position.z).moved(Vector3::zeros(), tilt);
            let load = Load::payload(0.1 * robot.platform.mass);
            let clock = Instant::now();
            let quick = is_held(&robot, &pose, &load).unwrap_or(false);
            times[0] += clock.elapsed().as_secs_f64();
            let clock = Instant::now();
            let held = match inverse(&robot, &pose, &load, None) {
                Ok(_) | Err(StaticsError::InverseNotConverged { .. }) => true,
                Err(_) => false,
            };
            times[1] += clock.elapsed().as_secs_f64();
            counts[usize::from(held)][usize::from(quick)] += 1;
        }
        let [[none, wrong], [missed, found]] = counts;
        let [quick, whole] = times.map(|time: f64| 1e6 * time / f64::from(cases));
        println!(
            "{name}: {found} held, {none} not; {missed} held ones not found, {wrong} wrong; \
             {quick:.0} us a pose, the inverse model {whole:.0} us"
        );
        assert_eq!(wrong, 0, "{name}");
        assert!(missed <= (found + missed) / 50, "{name}");
    }
}
