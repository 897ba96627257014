//! The inverse model along paths.

use crate::common::{caroca, cogiro};
use crate::drawn::{Drawn, drawn};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{InversePath, Load, PathSolution, StaticsError, WantedPose, inverse};

fn robot(text: &str) -> Robot {
    Robot::from_json(text).unwrap()
}

fn stadium() -> Robot {
    robot(include_str!("../../../data/reference/robots/stadium.json"))
}

type Answer = Result<PathSolution, StaticsError>;

fn along(robot: &Robot, poses: &[Pose], load: &Load) -> Vec<Answer> {
    let mut path = InversePath::new(robot);
    poses.iter().map(|pose| path.solve(pose, load)).collect()
}

/// Poses on a line, `steps` steps apart.
fn line(from: [f64; 3], to: [f64; 3], steps: usize) -> Vec<Pose> {
    let (from, to) = (Vector3::from(from), Vector3::from(to));
    let at = |k| from + (to - from) * (k as f64 / steps as f64);
    (0..=steps).map(|k| Pose { position: at(k), ..Pose::at(0.0, 0.0, 0.0) }).collect()
}

/// The greatest change of a length from each pose to the next [m].
fn changes(answers: &[Answer]) -> Vec<f64> {
    let lengths: Vec<_> = answers.iter().map(|answer| &answer.as_ref().unwrap().solution.lengths).collect();
    let change = |pair: &[&Vec<f64>]| {
        let each = pair[0].iter().zip(pair[1]).map(|(a, b)| (b - a).abs());
        each.fold(0.0, f64::max)
    };
    lengths.windows(2).map(change).collect()
}

fn jumps(answers: &[Answer]) -> Vec<usize> {
    let jumped = |(k, answer): (usize, &Answer)| answer.as_ref().is_ok_and(|found| found.jump).then_some(k);
    answers.iter().enumerate().filter_map(jumped).collect()
}

fn greatest(changes: &[f64]) -> f64 {
    changes.iter().copied().fold(0.0, f64::max)
}

#[test]
fn lengths_are_continuous_along_a_path() {
    let ipanema = robot(include_str!("../../../data/reference/robots/ipanema.json"));
    for (robot, from, to, steps) in [
        (stadium(), [-25.0, -4.667, 10.0], [25.0, -4.667, 10.0], 200),
        (stadium(), [-20.0, -20.0, 25.0], [20.0, 20.0, 8.0], 200),
        (caroca(), [-3.0, 1.7, 3.0], [3.2, 1.7, 3.0], 100),
        (cogiro(), [-6.0, -3.0, 1.0], [6.0, 3.5, 3.0], 100),
        (ipanema, [-0.3, -0.2, 1.0], [0.3, 0.3, 1.5], 100),
    ] {
        let coarse = along(&robot, &line(from, to, steps), &Load::none());
        let fine = along(&robot, &line(from, to, 2 * steps), &Load::none());
        assert!(jumps(&coarse).is_empty() && jumps(&fine).is_empty(), "{}", robot.name);
        let [change, half] = [&coarse, &fine].map(|answers| greatest(&changes(answers)));
        println!("{}: lengths change by {change:.4} m, by {half:.4} m with half the step", robot.name);
        assert!(half < 0.6 * change);
        // Where the steps are does not matter.
        for (a, b) in coarse.iter().zip(fine.iter().step_by(2)) {
            let [a, b] = [a, b].map(|answer| &answer.as_ref().unwrap().solution);
            for (a, b) in a.lengths.iter().zip(&b.lengths) {
                assert!((a - b).abs() < 1e-9 * a, "{}: {a} {b}", robot.name);
            }
        }
    }
}

#[test]
fn a_jump_is_reported_where_a_branch_ends_and_is_as_long_in_smaller_steps() {
    // A random robot whose cables sag strongly.
    let Drawn { robot, pose, load, .. } = drawn(157).unwrap();
    let size = robot.cables.iter().map(|cable| cable.exit_point.norm()).fold(0.0, f64::max);
    let at = |share: f64| Pose { position: pose.position + Vector3::x() * (0.3 * size * share), ..pose };
    let coarse: Vec<_> = (0..=20).map(|k| at(0.01 * f64::from(k))).collect();
    let coarse = along(&robot, &coarse, &load);
    let [jump] = jumps(&coarse)[..] else { panic!("{:?}", jumps(&coarse)) };
    let changes_coarse = changes(&coarse);
    // The same step in 64 parts, from the same branch.
    let share = |k: usize| 0.01 * (jump as f64 - 1.0 + k as f64 / 64.0);
    let before = (0..jump).map(|k| at(0.01 * k as f64));
    let fine: Vec<_> = before.chain((1..=64).map(|k| at(share(k)))).collect();
    let fine = along(&robot, &fine, &load);
    let [jump_fine] = jumps(&fine)[..] else { panic!("{:?}", jumps(&fine)) };
    let mut steady = changes(&fine)[jump - 1..].to_vec();
    let leap = steady.remove(jump_fine - jump);
    println!(
        "a leap of {:.3} m, then {leap:.3} m; beside it {:.3} m",
        changes_coarse[jump - 1],
        greatest(&steady)
    );
    assert!(leap > 0.5 * changes_coarse[jump - 1] && greatest(&steady) < 0.1 * leap);
}

/// Along the way the least tension of cable 6 takes the place of that of cable 8.
#[test]
fn a_limit_that_cuts_off_the_corner_of_two_others_is_no_jump() {
    let robot = robot(include_str!("../../../data/robots/ipanema-3.json"));
    let wrenches = [[85.209, 0.35, -0.08, -0.84, -0.715, -0.3], [80.482, -0.085, -0.452, 0.097, 1.11, 0.283]];
    let [from, to] = wrenches.map(cdpr_robot::Vector6::from);
    for steps in [1, 2, 10, 999] {
        let mut path = InversePath::new(&robot);
        let mut last = Vec::new();
        for k in 0..=steps {
            let share = f64::from(k) / f64::from(steps);
            let wrench = cdpr_robot::Wrench::from_vector(&from.lerp(&to, share));
            let pose = Pose::at(0.4969 + 0.0006 * share, 0.0, 1.5);
            let found = path.solve(pose, &Load { wrench, ..Load::none() }).unwrap();
            assert!(!found.jump, "{k} of {steps}");
            assert!(k == 0 || found.solution.iterations < 12, "{k}: {}", found.solution.iterations);
            last = found.solution.active;
        }
        let bounded: Vec<usize> = (0..8).filter(|i| last[*i].is_some()).collect();
        assert_eq!(bounded, [4, 5]);
    }
}

#[test]
fn a_path_goes_on_after_a_pose_that_is_not_held() {
    let robot = caroca();
    let poses = [Pose::at(0.0, 0.0, 1.75), Pose::at(0.0, 0.0, 100.0), Pose::at(0.1, 0.0, 1.75)];
    let answers = along(&robot, &poses, &Load::none());
    assert!(matches!(answers[1], Err(StaticsError::NoTensions { .. })));
    let last = answers[2].as_ref().unwrap();
    let alone = inverse(&robot, &poses[2], &Load::none()).unwrap();
    assert!(!last.jump);
    for (a, b) in last.solution.lengths.iter().zip(&alone.lengths) {
        assert!((a - b).abs() < 1e-12 * a);
    }
}

#[test]
fn a_path_leads_through_rotations_loads_and_references() {
    let robot = cogiro();
    let mut path = InversePath::new(&robot);
    for k in 0..=8 {
        let share = f64::from(k) / 8.0;
        let pose = Pose::at(1.0, -0.5, 1.5).moved(Vector3::zeros(), Vector3::new(0.0, 0.1, 0.2) * share);
        let load = Load::payload(100.0 * share);
        let reference = vec![300.0 * share; 8];
        let found = path.solve(WantedPose::at(&pose).tension_reference(&reference), &load).unwrap();
        let alone = inverse(&robot, WantedPose::at(&pose).tension_reference(&reference), &load).unwrap();
        assert!(!found.jump && found.solution.residual.force < 1e-9);
        for (a, b) in found.solution.tensions.iter().zip(&alone.tensions) {
            assert!((a - b).abs() < 1e-9 * alone.tensions.iter().sum::<f64>(), "{k}: {a} {b}");
        }
    }
}

/// Along a path whose tensions change by no more than `change` the platform is in balance at each pose.
#[test]
fn no_tension_changes_by_more_than_is_allowed() {
    for (name, from, to, change) in [
        ("caroca", [-1.0, 0.0, 1.75], [1.0, 0.5, 2.0], 15.0),
        ("cogiro", [-2.0, -1.0, 1.5], [2.0, 1.0, 2.0], 100.0),
        ("fast", [-5.0, 0.0, 140.1], [5.0, 0.0, 140.1], 1000.0),
        ("ipanema-1", [-0.3, -0.2, 1.0], [0.3, 0.3, 1.5], 20.0),
        ("ipanema-3", [-0.3, 0.1, 1.2], [0.3, 0.2, 1.4], 20.0),
        ("segesta", [0.0, 0.0, 0.5], [0.05, 0.05, 0.55], 20.0),
    ] {
        let robot = Robot::from_library(name).unwrap();
        let mut path = InversePath::new(&robot);
        path.limit_change(change).unwrap();
        let poses = line(from, to, 100);
        let mut last = path.solve(poses[0], &Load::none()).unwrap().solution.tensions;
        // A reference that is far away at first.
        let reference: Vec<f64> = last.iter().map(|tension| 1.5 * tension + 2.0 * change).collect();
        let (mut greatest, mut held) = (0.0_f64, 0);
        for pose in &poses[1..] {
            let wanted = WantedPose { tension_reference: Some(&reference), ..pose.into() };
            match path.solve(wanted, &Load::none()) {
                Ok(PathSolution { solution, .. }) => {
                    let largest = solution.tensions.iter().copied().fold(0.0, f64::max);
                    assert!(solution.residual.force < 1e-9 * largest, "{name}: {:?}", solution.residual);
                    for (tension, last) in solution.tensions.iter().zip(&last) {
                        greatest = greatest.max((tension - last).abs());
                    }
                    last = solution.tensions;
                    held += 1;
                }
                Err(error) => panic!("{name} at {:?}: {error}", pose.position),
            }
        }
        assert!(greatest <= change * (1.0 + 1e-9), "{name}: {greatest}");
        println!("{name}: {held} poses, tensions change by {greatest:.3} N at most");
    }
}

#[test]
fn a_change_that_is_too_small_is_refused_and_the_path_goes_on() {
    let robot = caroca();
    let mut path = InversePath::new(&robot);
    assert!(matches!(path.limit_change(0.0), Err(StaticsError::Invalid { .. })));
    assert!(matches!(path.limit_change(f64::NAN), Err(StaticsError::Invalid { .. })));
    path.limit_change(1.0).unwrap();
    path.solve(Pose::at(0.0, 0.0, 1.75), &Load::none()).unwrap();
    let error = path.solve(Pose::at(1.0, 0.0, 1.75), &Load::none()).unwrap_err();
    let StaticsError::TensionChange { change, .. } = error else { panic!("{error}") };
    assert_eq!((change, error.kind()), (1.0, "infeasible_tension"));
    assert!(
        error.to_string().starts_with("within 1 N of the tensions at the last pose that is held: "),
        "{error}"
    );
    assert!(path.solve(Pose::at(0.001, 0.0, 1.75), &Load::none()).is_ok());
}
