//! Where the platform comes to rest when cables break: against the model of the robot that lacks them, and
//! against a motion with damping.

use cdpr_assess::{AnyWeather, Breaks, safety_at, winds};
use cdpr_dynamics::simulate::{Change, CutAt, Event, Settings, simulate};
use cdpr_robot::{Coordinate, Platform, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load, StaticsError, WantedPose, inverse};

const PAIRS: Breaks = Breaks { pairs: true, follow: None };

fn robot(name: &str) -> Robot {
    let folder = if name == "stadium" { "docs/how-to/broken-cable" } else { "data/robots" };
    let path = format!("{}/../../{folder}/{name}.json", env!("CARGO_MANIFEST_DIR"));
    Robot::from_json(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Robots that differ, each at a pose that it holds.
fn robots() -> Vec<(Robot, Pose)> {
    let at = |name: &str, x, y, z| (robot(name), Pose::at(x, y, z));
    vec![
        at("caroca", 0.0, 0.0, 1.75),
        at("cogiro", 1.0, 0.5, 2.0),
        at("ipanema-3", 0.0, 0.0, 1.0),
        at("ipanema-1", 0.0, 0.0, 1.0),
        at("stadium", 5.0, 3.0, 12.0),
    ]
}

#[test]
fn every_rest_is_a_stable_equilibrium_of_the_robot_without_the_cable() {
    let mut rests = 0;
    for (robot, pose) in robots() {
        let found = safety_at(&robot, WantedPose::at(&pose), &Load::none(), Breaks::default()).unwrap();
        assert_eq!(found.broken.len(), robot.cables.len());
        for broken in &found.broken {
            let (Ok(rest), [gone]) = (&broken.rest, &broken.cables[..]) else { continue };
            rests += 1;
            let mut others = robot.clone();
            others.cables.remove(*gone);
            others.tension_reference = None;
            let mut lengths = found.lengths.clone();
            lengths.remove(*gone);
            let problem = DirectProblem::new(&others, &lengths, &Load::none()).unwrap();
            let again = problem.direct(DirectStart::Pose(&rest.pose)).unwrap();
            assert!(again.stability.is_stable(), "{} {gone}", robot.name);
            let apart = (again.equilibrium.pose.position - rest.pose.position).norm();
            assert!(apart < 1e-6, "{} without {gone}: {apart} m", robot.name);
            assert_eq!(rest.tensions[*gone], [0.0; 2]);
            let moved = (rest.pose.position - pose.position).norm();
            assert!((moved - rest.moved).abs() < 1e-12 && rest.moved > 0.0);
            assert!(rest.residual.force < 1e-5, "{} {gone}: {:?}", robot.name, rest.residual);
        }
    }
    assert!(rests >= 30, "{rests}");
}

#[test]
fn the_potential_falls_from_the_pose_to_each_rest() {
    // The path of a strongly damped platform leads downhill: the rest of the whole robot, released, is its
    // pose.
    for (robot, pose) in robots() {
        let found = safety_at(&robot, WantedPose::at(&pose), &Load::none(), Breaks::default()).unwrap();
        let problem = DirectProblem::new(&robot, &found.lengths, &Load::none()).unwrap();
        let whole = problem.direct(DirectStart::Released(&pose)).unwrap();
        let apart = (whole.equilibrium.pose.position - pose.position).norm();
        assert!(apart < 1e-6, "{}: {apart} m", robot.name);
    }
}

#[test]
fn pairs_come_after_single_cables_and_the_ground_is_noticed() {
    let robot = robot("stadium");
    let pose = Pose::at(5.0, 3.0, 12.0);
    let found = safety_at(&robot, WantedPose::at(&pose), &Load::none(), PAIRS).unwrap();
    let sets: Vec<_> = found.broken.iter().map(|broken| broken.cables.clone()).collect();
    assert_eq!(sets[..5], [vec![0], vec![1], vec![2], vec![3], vec![0, 1]]);
    assert_eq!(sets.len(), 10);
    let below = |found: &cdpr_assess::Safety| {
        found.broken.iter().filter(|one| one.rest.as_ref().is_ok_and(|rest| rest.below_ground)).count()
    };
    let high = Robot { ground_z: Some(11.9), ..robot.clone() };
    let above = safety_at(&high, WantedPose::at(&pose), &Load::none(), Breaks::default()).unwrap();
    assert!(below(&above) > 0);
    let deep = Robot { ground_z: Some(-1000.0), ..robot };
    assert_eq!(below(&safety_at(&deep, WantedPose::at(&pose), &Load::none(), PAIRS).unwrap()), 0);
}

#[test]
fn a_robot_with_few_cables_rests_and_an_unheld_pose_is_refused() {
    let few = robot("four-cables");
    let pose = Pose::at(0.5, 0.3, 2.0);
    let wanted = WantedPose::at(&pose).free(&[Coordinate::Roll, Coordinate::Pitch]);
    let found = safety_at(&few, wanted, &Load::none(), Breaks::default()).unwrap();
    assert_eq!(found.broken.len(), 4);
    assert!(found.broken.iter().all(|broken| broken.rest.is_ok()), "{found:?}");
    let refused = safety_at(&few, WantedPose::at(&pose), &Load::none(), Breaks::default());
    assert!(matches!(refused, Err(StaticsError::FreeCoordinates { .. })), "{refused:?}");
    let heavy = safety_at(
        &robot("cogiro"),
        WantedPose::at(&Pose::at(0.0, 0.0, 2.0)),
        &Load::payload(1e7),
        Breaks::default(),
    );
    assert!(matches!(heavy, Err(StaticsError::NoTensions { .. })), "{heavy:?}");
}

#[test]
fn the_swing_is_that_of_the_simulation() {
    let cases = [("caroca", Pose::at(0.0, 0.0, 1.75), 0.02), ("stadium", Pose::at(5.0, 3.0, 12.0), 0.2)];
    for (name, pose, until) in cases {
        let robot = robot(name);
        let platform = Platform { inertia: Some(robot.assumed_inertia()), ..robot.platform };
        let robot = Robot { platform, ..robot };
        let breaks = Breaks { pairs: false, follow: Some(until) };
        let found = safety_at(&robot, WantedPose::at(&pose), &Load::none(), breaks).unwrap();
        let held = inverse(&robot, WantedPose::at(&pose), &Load::none()).unwrap();
        let problem = DirectProblem::new(&robot, &held.lengths, &Load::none()).unwrap();
        let first = found.broken[0].swing.as_ref().unwrap().as_ref().unwrap();
        let cut = Event { time: 0.0, change: Change::Cut { cable: 0, at: CutAt::Anchor } };
        let settings = Settings { rate: (100.0_f64 / until).max(100.0), ..Settings::until(until) };
        let series = simulate(&problem, &held.equilibrium, &[cut], &settings).unwrap();
        let peak = series.peaks[1..].iter().map(|peak| peak.0).fold(0.0, f64::max);
        assert_eq!(first.greatest.0, peak, "{}", robot.name);
        let last = series.samples.last().unwrap();
        assert!(first.moved >= (last.pose.position - pose.position).norm() - 1e-9, "{}", robot.name);
        assert_ne!(first.greatest.1, 0);
    }
}

#[test]
fn without_inertia_the_rest_is_there_and_the_swing_has_its_reason() {
    let robot = robot("caroca");
    let breaks = Breaks { pairs: false, follow: Some(0.01) };
    let found = safety_at(&robot, WantedPose::at(&Pose::at(0.0, 0.0, 1.75)), &Load::none(), breaks).unwrap();
    for broken in &found.broken {
        assert!(broken.rest.is_ok());
        assert!(
            matches!(&broken.swing, Some(Err(error)) if error.to_string().contains("inertia")),
            "{broken:?}"
        );
    }
}

/// Turned about the vertical, the winds of a grid blow from elsewhere upon the robot: the searches find the
/// same.
#[test]
fn the_worst_winds_do_not_depend_on_how_the_base_is_turned() {
    let worst = |degrees: f64| {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), degrees.to_radians());
        let mut robot = robot("cogiro");
        for cable in &mut robot.cables {
            cable.exit_point = turn * cable.exit_point;
        }
        let pose = Pose { position: turn * Vector3::new(0.8, 0.5, 2.0), rotation: turn };
        let held = inverse(&robot, &pose, &Load::none()).unwrap();
        let question = AnyWeather { speed: Some(40.0), ..AnyWeather::default() };
        let found = winds(&robot, &held.lengths, &Load::none(), [&pose, &pose], &question).unwrap();
        let greatest = found.tightest().unwrap().greatest_tension().0;
        [found.farthest().unwrap().moved(), greatest, found.least_tension().unwrap()]
    };
    let [own, turned] = [worst(0.0), worst(7.5)];
    for (own, turned) in own.into_iter().zip(turned) {
        assert!((own / turned - 1.0).abs() < 2e-4, "{own} {turned}");
    }
}

/// A platform that does not stay where it is held has no rest from which a break could move it.
#[test]
fn an_unstable_pose_is_refused() {
    let mut robot = robot("ipanema-1");
    robot.platform.center_of_mass.z += 0.15;
    robot.tension_limits.max = 2000.0;
    let pose = Pose::at(0.1, 0.1, 1.0);
    let found = safety_at(&robot, WantedPose::at(&pose), &Load::none(), PAIRS);
    assert!(matches!(found, Err(StaticsError::Unstable { .. })), "{found:?}");
}

#[test]
fn a_cable_without_breaking_force_leaves_no_safety_factor_while_it_is_whole() {
    let mut robot = robot("caroca");
    robot.cables.iter_mut().for_each(|cable| cable.properties.breaking_force = Some(1e4));
    let found = |robot: &Robot| {
        let wanted = Pose::at(0.0, 0.0, 1.75);
        safety_at(robot, WantedPose::at(&wanted), &Load::none(), Breaks::default()).unwrap()
    };
    assert!(found(&robot).safety_factor.is_some());
    robot.cables[2].properties.breaking_force = None;
    let found = found(&robot);
    assert_eq!(found.safety_factor, None);
    for broken in &found.broken {
        let factor = broken.rest.as_ref().unwrap().safety_factor;
        assert_eq!(factor.is_some(), broken.cables == [2], "{:?}", broken.cables);
    }
}
