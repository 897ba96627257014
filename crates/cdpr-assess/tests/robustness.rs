//! The test of robustness: what it counts, that its numbers follow from the seed, and which settings it
//! refuses.

use cdpr_assess::{
    AssessError, Outcome, PoseRegion, Protocol, ProtocolSummary, RobustnessResult, anchor_distance,
    run_robustness,
};
use cdpr_robot::{Coordinate, Pose, Robot, Vector3, library};
use std::sync::atomic::{AtomicUsize, Ordering};

fn cogiro() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap()
}

fn run(protocol: &Protocol) -> RobustnessResult {
    run_robustness(&cogiro(), protocol, &|| ()).unwrap()
}

/// Without the wall times, which differ from run to run.
fn timeless(mut result: RobustnessResult) -> RobustnessResult {
    result.solves.iter_mut().for_each(|solve| solve.microseconds = 0.0);
    result
}

#[test]
fn counts_add_up_and_no_solve_fails() {
    let steps = AtomicUsize::new(0);
    let tick = || {
        steps.fetch_add(1, Ordering::Relaxed);
    };
    let protocol = Protocol::mahnke_caverly(50, 4);
    let result = run_robustness(&cogiro(), &protocol, &tick).unwrap();
    assert_eq!((result.solves.len(), steps.into_inner()), (50, 100));
    let ProtocolSummary { total, rows, draws, .. } = ProtocolSummary::new(&result);
    let refused = draws.infeasible.values().chain(draws.unanswered.values()).sum::<usize>() + draws.unstable;
    assert_eq!((draws.drawn, result.refused.len()), (50 + refused, refused));
    assert!(refused > 0, "some poses of the room cannot be held");

    assert_eq!(rows.len(), 25);
    assert!(rows.iter().all(|row| row.solves == 2));
    assert_eq!(total.solves, rows.iter().map(|row| row.solves).sum::<usize>());
    assert_eq!(total.true_pose, rows.iter().map(|row| row.true_pose).sum::<usize>());
    assert_eq!(total.true_pose + total.other_equilibrium, 50);
    assert_eq!(total.newton + total.trust_region, 50);
    assert!(total.failed.is_empty(), "{:?}", total.failed);
    assert!(total.true_pose_distance.unwrap().max < 1e-9);
}

#[test]
fn the_same_seed_gives_the_same_numbers_on_any_number_of_threads() {
    let protocol = Protocol::mahnke_caverly(40, 7);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        timeless(pool.install(|| run(&protocol)))
    };
    let one = on(1);
    assert_eq!(one, on(3));
    assert_ne!(one.solves[0].wanted, run(&Protocol::mahnke_caverly(40, 8)).solves[0].wanted);
    // A shorter run is the beginning of a longer one.
    let short = timeless(run(&Protocol::mahnke_caverly(10, 7)));
    assert_eq!(short.solves[..], one.solves[..10]);
}

#[test]
fn starts_are_as_far_away_as_the_protocol_says_and_poses_inside_of_the_region() {
    for protocol in [Protocol::mahnke_caverly(30, 3), Protocol::thirty_poses(3)] {
        for solve in run(&protocol).solves {
            let offset = &protocol.starts[solve.start_offset];
            let motion = solve.wanted.motion_to(&solve.start);
            assert!((motion.fixed_rows::<3>(0).norm() - offset.distance).abs() < 1e-12);
            assert!((motion.fixed_rows::<3>(3).norm() - offset.angle).abs() < 1e-12);
            let region = &protocol.region;
            for (k, p) in solve.wanted.position.iter().enumerate() {
                assert!((region.low[k]..region.high[k]).contains(p));
            }
            let angle = Pose::at(0.0, 0.0, 0.0).motion_to(&solve.wanted).fixed_rows::<3>(3).norm();
            assert!(angle <= region.max_angle + 1e-12);
        }
    }
}

#[test]
fn each_of_thirty_poses_is_looked_for_from_both_distances() {
    let result = run(&Protocol::thirty_poses(2017));
    assert_eq!(result.solves.len(), 60);
    for pair in result.solves.chunks(2) {
        assert_eq!((pair[0].wanted, pair[0].start_offset), (pair[1].wanted, 0));
        assert_eq!(pair[1].start_offset, 1);
        assert!(pair[0].start_distance > pair[1].start_distance);
    }
    let rows = ProtocolSummary::new(&result).rows;
    assert_eq!(rows.iter().map(|row| row.published.unwrap().found).collect::<Vec<_>>(), [22, 25]);
}

#[test]
fn what_is_farther_than_the_limits_or_open_is_not_the_true_pose() {
    let mut solve = run(&Protocol::thirty_poses(1)).solves.remove(0);
    let answer = solve.answer.clone().unwrap();
    let mut outcome = |distance, degrees: f64, is_equilibrium| {
        let mut answer = answer;
        (answer.distance, answer.angle) = (distance, degrees.to_radians());
        answer.is_equilibrium = is_equilibrium;
        solve.answer = Ok(answer);
        (solve.outcome(0.1), solve.failure())
    };
    assert_eq!(outcome(0.099, 0.99, true), (Outcome::TruePose, None));
    assert_eq!(outcome(0.101, 0.0, true), (Outcome::OtherEquilibrium, None));
    assert_eq!(outcome(0.0, 1.01, true), (Outcome::OtherEquilibrium, None));
    assert_eq!(outcome(0.0, 0.0, false), (Outcome::Failed, Some("large_residual")));
}

#[test]
fn the_distance_of_the_anchor_points_is_that_of_a_shift_and_the_arc_of_a_turn() {
    let robot = cogiro();
    let pose = Pose::at(0.0, 0.0, 2.0);
    let shifted = pose.moved(Vector3::new(0.3, 0.0, -0.4), Vector3::zeros());
    assert!((anchor_distance(&robot, &pose, &shifted) - 0.5).abs() < 1e-14);
    let half_turn = pose.moved(Vector3::zeros(), Vector3::new(0.0, 0.0, std::f64::consts::PI));
    let squares = robot.cables.iter().map(|cable| 4.0 * cable.anchor_point.xy().norm_squared());
    let expected = (squares.sum::<f64>() / 8.0).sqrt();
    assert!((anchor_distance(&robot, &pose, &half_turn) - expected).abs() < 1e-14);
}

#[test]
fn settings_that_no_test_can_have_are_refused_with_field_value_and_remedy() {
    let refusal = |spoil: fn(&mut Protocol)| {
        let mut protocol = Protocol::mahnke_caverly(10, 1);
        spoil(&mut protocol);
        run_robustness(&cogiro(), &protocol, &|| ()).unwrap_err().to_string()
    };
    assert_eq!(refusal(|p| p.poses = 0), "poses is 0: expected 1 to 10000000");
    let modulus = "expected a finite, positive modulus [Pa]";
    assert_eq!(refusal(|p| p.youngs_modulus = Some(f64::NAN)), format!("youngs_modulus is NaN: {modulus}"));
    assert_eq!(refusal(|p| p.youngs_modulus = Some(-1.0)), format!("youngs_modulus is -1: {modulus}"));
    assert!(refusal(|p| p.starts.clear()).starts_with("starts is empty: expected at least one"));
    assert!(refusal(|p| p.starts[3].angle = f64::NAN).starts_with("starts[3].angle is NaN: "));
    assert!(refusal(|p| p.region.high[1] = -5.0).contains("region is PoseRegion { low: "));
}

#[test]
fn a_region_in_which_nothing_is_held_ends_with_what_was_drawn() {
    let mut protocol = Protocol::mahnke_caverly(10, 1);
    // Above all exit points.
    (protocol.region.low[2], protocol.region.high[2]) = (8.0, 9.0);
    let error = run_robustness(&cogiro(), &protocol, &|| ()).unwrap_err();
    assert!(
        matches!(error, AssessError::TooFewPoses { found: 0, drawn: 1000, infeasible: 1000, .. }),
        "{error}"
    );
}

#[test]
fn robots_of_other_sizes_and_with_few_cables_are_tested_in_their_own_room() {
    let few = [Coordinate::Roll, Coordinate::Pitch];
    let robots: [(&str, &[Coordinate]); 4] =
        [("ipanema-3", &[]), ("segesta", &[]), ("caroca", &[]), ("four-cables", &few)];
    for (name, free) in robots {
        let robot = Robot::from_json(library::named(library::ROBOTS, name).unwrap().text).unwrap();
        let room = PoseRegion::of(&robot);
        let inside = |p: &Vector3<f64>| (0..3).all(|k| (room.low[k]..=room.high[k]).contains(&p[k]));
        assert!(robot.cables.iter().any(|cable| !inside(&cable.exit_point)), "{name}: {room:?}");
        let protocol = Protocol { free: free.to_vec(), ..Protocol::thirty_poses(3).in_region(room) };
        assert!(protocol.starts.iter().all(|start| start.published.is_none()), "{name}");
        let result = run_robustness(&robot, &protocol, &|| ()).unwrap();
        let total = ProtocolSummary::new(&result).total;
        assert_eq!((total.solves, total.failed.len()), (60, 0), "{name}: {:?}", total.failed);
        assert!(total.true_pose >= 58, "{name}: {}", total.true_pose);
        assert!(result.solves.iter().all(|solve| inside(&solve.wanted.position)), "{name}");
    }
}

#[test]
fn few_cables_hold_a_share_of_poses_that_are_drawn_level_and_a_test_ends_early_where_they_do_not() {
    let robot = Robot::from_json(library::named(library::ROBOTS, "four-cables").unwrap().text).unwrap();
    let free = vec![Coordinate::Roll, Coordinate::Pitch];
    let protocol = Protocol { free, ..Protocol::thirty_poses(3).in_region(PoseRegion::of(&robot)) };
    let result = run_robustness(&robot, &protocol, &|| ()).unwrap();
    assert!(result.drawn <= 150, "{}", result.drawn);
    // Level, with its position free, the tensions of this robot are not determined.
    let free = vec![Coordinate::X, Coordinate::Y];
    let error = run_robustness(&robot, &Protocol { free, poses: 10_000, ..protocol }, &|| ()).unwrap_err();
    assert!(matches!(error, AssessError::TooFewPoses { found: 0, drawn, .. } if drawn <= 300), "{error}");
}
