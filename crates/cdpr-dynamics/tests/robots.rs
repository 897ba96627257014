//! Robots of the library: what holds whatever the numbers are.

use cdpr_dynamics::{DynamicsError, Modes, Swing, Wanted, modes_at};
use cdpr_robot::{Gravity, Pose, Robot, Rotation3};
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, StaticsError, WantedPose, inverse};

/// Robots with a pose that they hold and the coordinates that are found there.
pub(crate) const ROBOTS: [(&str, [f64; 3], &str); 6] = [
    (include_str!("../../../data/robots/caroca.json"), [0.4, 0.3, 1.75], ""),
    (include_str!("../../../data/robots/cogiro.json"), [0.0, 0.0, 2.0], ""),
    (include_str!("../../../data/robots/fast.json"), [0.0, 0.0, 140.0], ""),
    (include_str!("../../../data/robots/ipanema-1.json"), [0.0, 0.0, 1.0], ""),
    (include_str!("../../../data/robots/ipanema-3.json"), [0.5, 0.2, 1.5], ""),
    (include_str!("../../../data/robots/four-cables.json"), [0.3, 0.2, 2.0], "roll,pitch"),
];

pub(crate) fn robot(file: &str) -> Robot {
    let mut robot = Robot::from_json(file).unwrap();
    robot.platform.inertia = Some(robot.platform.inertia.unwrap_or_else(|| robot.assumed_inertia()));
    robot
}

pub(crate) fn wanted<'a>(pose: &'a Pose, free: &'a [cdpr_robot::Coordinate]) -> WantedPose<'a> {
    WantedPose::at(pose).free(free)
}

#[test]
fn the_first_motions_are_the_same_by_number_and_below_a_frequency() {
    for (file, [x, y, z], free) in ROBOTS {
        let (robot, pose) = (robot(file), Pose::at(x, y, z));
        let free = free_coordinates(free);
        let found = |what: Wanted| modes_at(&robot, wanted(&pose, &free), &Load::none(), what).unwrap();
        let first = found(Wanted::Number(10));
        assert_eq!((first.modes.len(), first.counted), (10, 10), "{}", robot.name);
        let below = found(Wanted::Below(first.complete_below));
        assert_eq!(below.counted, 10, "{}", robot.name);
        for (one, other) in first.modes.iter().zip(&below.modes) {
            let off = (one.frequency / other.frequency - 1.0).abs();
            assert!(off <= 1e-6, "{}: {} {}", robot.name, one.frequency, other.frequency);
            assert!(one.within <= 1e-6 && one.platform_share > -1e-9, "{}", robot.name);
            let sum = one.platform_share + one.cable_shares.iter().sum::<f64>();
            assert!((sum - 1.0).abs() < 1e-8, "{}: {sum}", robot.name);
        }
        let platform = first.of_platform().unwrap();
        println!("{}: {:.4} Hz, {:.1} %", robot.name, platform.frequency, 100.0 * platform.platform_share);
    }
}

pub(crate) fn free_coordinates(names: &str) -> Vec<cdpr_robot::Coordinate> {
    names.split(',').filter(|name| !name.is_empty()).map(|name| name.parse().unwrap()).collect()
}

/// Lowest frequency of the platform that is not zero [Hz], on cables without mass.
fn lowest_massless(problem: &DirectProblem, rest: &Equilibrium) -> f64 {
    let modes = problem.modes(rest).unwrap();
    modes.iter().map(|mode| mode.frequency).find(|frequency| *frequency > 0.0).unwrap()
}

#[test]
fn a_platform_swings_as_the_first_of_its_natural_motions_say() {
    for (file, [x, y, z], free) in ROBOTS {
        let (robot, pose) = (robot(file), Pose::at(x, y, z));
        let free = free_coordinates(free);
        let held = inverse(&robot, wanted(&pose, &free), &Load::none()).unwrap();
        let problem = DirectProblem::new(&robot, &held.lengths, &Load::none()).unwrap();
        let rest = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap().equilibrium;
        let clock = std::time::Instant::now();
        let swing = Swing::new(&problem, &rest).unwrap();
        let massless = lowest_massless(&problem, &rest);
        println!("{} {:?}: {swing:?}, without mass of cables {massless}", robot.name, clock.elapsed());
        let first = Modes::new(&problem, &rest, Wanted::Number(1)).unwrap();
        assert!((swing.lowest / first.modes[0].frequency - 1.0).abs() < 2e-6, "{}", robot.name);
        let all = Modes::new(&problem, &rest, Wanted::Below(2.0 * massless)).unwrap();
        assert!(all.modes.iter().all(|mode| mode.swing_share <= mode.platform_share + 1e-9));
        let most = all.modes.iter().map(|mode| mode.swing_share).fold(0.0, f64::max);
        assert!((all.of_platform().unwrap().swing_share - most).abs() < 1e-12 && most > 0.0);
        assert!(all.modes.iter().any(|mode| (mode.frequency / swing.platform - 1.0).abs() < 2e-6));
        // Without mass of the cables both are the lowest frequency of the platform.
        let mut light = robot.clone();
        light.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.0);
        let problem = DirectProblem::new(&light, &held.lengths, &Load::none()).unwrap();
        let Ok(rest) = problem.direct(DirectStart::Pose(&rest.pose)) else { continue };
        let swing = Swing::new(&problem, &rest.equilibrium).unwrap();
        let massless = lowest_massless(&problem, &rest.equilibrium);
        assert!((swing.lowest / massless - 1.0).abs() < 1e-9 && swing.lowest_share > 1.0 - 1e-9);
        assert!((swing.platform / massless - 1.0).abs() < 1e-3, "{}: {swing:?}", robot.name);
    }
}

#[test]
fn a_robot_vibrates_alike_however_its_base_is_turned() {
    let turn = Rotation3::from_euler_angles(0.4, -0.9, 2.0);
    for (file, [x, y, z], _) in ROBOTS.into_iter().filter(|robot| robot.2.is_empty()) {
        let (robot, pose) = (robot(file), Pose::at(x, y, z));
        let held = inverse(&robot, &pose, &Load::none()).unwrap();
        let mut turned = robot.clone();
        turned.gravity = Gravity::from(turn * robot.gravity.vector());
        turned.ground_z = None;
        for cable in &mut turned.cables {
            cable.exit_point = turn * cable.exit_point;
            if let Some(pulley) = &mut cable.pulley {
                pulley.axis = turn * pulley.axis;
            }
        }
        let turned_pose = Pose { position: turn * pose.position, rotation: turn * pose.rotation };
        let modes = |robot: &Robot, pose: &Pose| {
            let problem = DirectProblem::new(robot, &held.lengths, &Load::none()).unwrap();
            let rest = problem.direct(DirectStart::Pose(pose)).unwrap();
            Modes::new(&problem, &rest.equilibrium, Wanted::Number(8)).unwrap()
        };
        let (one, other) = (modes(&robot, &pose), modes(&turned, &turned_pose));
        for (one, other) in one.modes.iter().zip(&other.modes) {
            let off = (one.frequency / other.frequency - 1.0).abs();
            assert!(off < 2e-6, "{}: {} {}", robot.name, one.frequency, other.frequency);
        }
    }
}

#[test]
fn what_has_no_natural_motions_is_refused_with_its_reason() {
    let robot = robot(ROBOTS[1].0);
    let pose = Pose::at(0.0, 0.0, 2.0);
    let refused = |what: Wanted| modes_at(&robot, pose, &Load::none(), what).unwrap_err();
    for bound in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(refused(Wanted::Below(bound)).to_string().contains("a frequency [Hz] above zero"));
    }
    assert!(refused(Wanted::Number(0)).to_string().contains("one at least"));
    for bound in [1e6, 1e150, f64::MAX] {
        let too_high = refused(Wanted::Below(bound)).to_string();
        let limit = too_high.split_once("expected ").unwrap().1.split(' ').next().unwrap();
        assert!((100.0..1e4).contains(&limit.parse().unwrap()), "{too_high}");
    }
    let mut without = robot.clone();
    without.platform.inertia = None;
    let error = modes_at(&without, pose, &Load::none(), Wanted::Number(3)).unwrap_err();
    assert!(
        matches!(&error, DynamicsError::Statics(StaticsError::Invalid { field, .. })
        if field == "platform.inertia"),
        "{error}"
    );
}
