//! Moves from rest to rest.

use crate::robots::robot;
use cdpr_dynamics::DynamicsError;
use cdpr_dynamics::moves::{
    FeedForward, Move, Residual, SetPoint, Shaper, ShaperKind, residual, winch_lengths,
};
use cdpr_dynamics::simulate::{Change, Discretization, Event, Profile, Settings, simulate};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load, StaticsError, inverse};

const CAROCA: &str = include_str!("../../../data/robots/caroca.json");
const COGIRO: &str = include_str!("../../../data/robots/cogiro.json");
const STADIUM: &str = include_str!("../../../docs/how-to/loads/stadium.json");
const IPANEMA_3: &str = include_str!("../../../data/robots/ipanema-3.json");

/// One metre along x at a height, in one second.
fn poses(height: f64) -> [Pose; 2] {
    [-0.5, 0.5].map(|x| Pose::at(x, 0.0, height))
}

fn plain<'a>(robot: &'a Robot, poses: &'a [Pose], profile: Profile) -> Move<'a> {
    Move {
        robot,
        load: Load::none(),
        poses,
        seconds: 1.0,
        profile,
        shaper: Shaper::default(),
        feed_forward: FeedForward::None,
        rate: 200.0,
    }
}

fn after(robot: &Robot, points: &[SetPoint]) -> Residual {
    let discretization = Some(Discretization { elements: 2, degree: 5 });
    let settings = Settings { rate: 200.0, discretization, tolerance: 1e-6, ..Settings::until(0.5) };
    residual(robot, &Load::none(), points, &[], &settings).unwrap()
}

#[test]
fn a_shaper_leaves_less_than_a_third_of_the_vibration_after_a_metre_in_a_second() {
    for (file, height, most) in [(CAROCA, 1.75, 0.03), (COGIRO, 2.0, 0.25), (IPANEMA_3, 1.5, 0.10)] {
        let (robot, poses) = (robot(file), poses(height));
        let plain = plain(&robot, &poses, Profile::Cosine);
        let unshaped = after(&robot, &plain.plan().unwrap());
        let (shaped, chosen) = plain.shaped(ShaperKind::Zvd, 2, 0.0).unwrap();
        let left = after(&robot, &shaped.plan().unwrap());
        let share = left.amplitude / unshaped.amplitude;
        println!("{}: {:.1} % of {:.3} mm", robot.name, 100.0 * share, 1e3 * unshaped.amplitude);
        assert!(share < most && chosen.len() == 2, "{}: {share} {chosen:?}", robot.name);
        assert!(left.difference < 0.1 * unshaped.amplitude && left.slack.is_empty(), "{left:?}");
        // The way still ends at the wanted pose, after the same time.
        assert!((shaped.shaper.duration() < 1.0) && left.deviation < unshaped.deviation + 2e-3);
    }
}

#[test]
fn feed_forward_holds_the_platform_on_its_way() {
    for (file, height, seconds) in [(CAROCA, 1.75, 1.0), (COGIRO, 2.0, 1.5)] {
        let (robot, poses) = (robot(file), poses(height));
        let of = |feed_forward| {
            let plain = plain(&robot, &poses, Profile::Polynomial);
            after(&robot, &Move { feed_forward, seconds, ..plain }.plan().unwrap())
        };
        let [none, platform, cables] =
            [FeedForward::None, FeedForward::Platform, FeedForward::Cables].map(of);
        let deviations = [&none, &platform, &cables].map(|of| 1e6 * of.deviation);
        let amplitudes = [&none, &platform, &cables].map(|of| 1e6 * of.amplitude);
        println!("{}: {deviations:.1?} {amplitudes:.1?} um", robot.name);
        for of in [platform, cables] {
            assert!(of.deviation < 0.05 * none.deviation, "{}: {of:?} {none:?}", robot.name);
            assert!(of.amplitude < 0.5 * none.amplitude, "{}: {of:?} {none:?}", robot.name);
        }
    }
}

/// The force of the cables and the weight on the platform, with cables that pull along their chords.
fn net_force(robot: &Robot, point: &SetPoint) -> Vector3<f64> {
    let pulls = point.tensions.iter().enumerate();
    let pull = |(i, tension): (usize, &f64)| robot.span(&point.pose, i).normalize() * *tension;
    pulls.fold(robot.weight(&point.pose, 0.0).force, |sum, cable| sum - pull(cable))
}

#[test]
fn the_platform_is_carried_by_the_force_that_accelerates_it() {
    let (robot, poses) = (robot(CAROCA), poses(1.75));
    let plain = plain(&robot, &poses, Profile::Polynomial);
    let of = |feed_forward| Move { feed_forward, ..plain.clone() }.plan().unwrap();
    let points = of(FeedForward::Platform);
    for points in [&points, &of(FeedForward::None), &of(FeedForward::Cables)] {
        assert_eq!(points.len(), 201);
        for point in points.iter().step_by(20) {
            // The cables sag little, and have 3 kg.
            let (force, growth) = (net_force(&robot, point), Profile::Polynomial.at(point.time)[2]);
            let wanted = robot.platform.mass * growth;
            assert!((force.x - wanted).abs() < 40.0, "{}: {} {wanted}", point.time, force.x);
        }
    }
    // It passes through its poses at the times of the profile.
    let middle = &points[100];
    assert!(middle.pose.position.x.abs() < 1e-12 && (middle.time - 0.5).abs() < 1e-12);
    let table = winch_lengths(&points).unwrap();
    assert!((table.at(0, 0.5)[0] - middle.lengths[0]).abs() < 1e-12);
}

/// How far the tensions of set points are off those of a simulation with damping at any time, and how far
/// those at rest at the same poses are [N].
fn off_simulated(robot: &Robot, points: &[SetPoint]) -> [f64; 2] {
    let load = Load::none();
    let problem = DirectProblem::new(robot, &points[0].lengths, &load).unwrap();
    let rest = problem.direct(DirectStart::Pose(&points[0].pose)).unwrap().equilibrium;
    let follow = Event { time: 0.0, change: Change::Lengths(winch_lengths(points).unwrap()) };
    let until = points[points.len() - 1].time;
    let discretization = Some(Discretization { elements: 2, degree: 5 });
    let settings = Settings { damping: 2e-3, discretization, tolerance: 1e-6, ..Settings::until(until) };
    let series = simulate(&problem, &rest, &[follow], &settings).unwrap();
    let mut off = [0.0_f64; 2];
    // Two set points for each sample.
    for (sample, point) in series.samples.iter().zip(points.iter().step_by(2)) {
        assert!((sample.time - point.time).abs() < 1e-9);
        let still = inverse(robot, &point.pose, &load).unwrap();
        let still_exits = still.equilibrium.exit_tensions(robot, &still.lengths);
        for (i, [exit, anchor]) in sample.tensions.iter().enumerate() {
            let of_point = (exit - point.exit_tensions[i]).abs().max((anchor - point.tensions[i]).abs());
            let of_rest = (exit - still_exits[i]).abs().max((anchor - still.tensions[i]).abs());
            off = [off[0].max(of_point), off[1].max(of_rest)];
        }
    }
    off
}

/// What swings is not in the tensions of a plan. IPAnema 3 swings more, because its lengths have kinks where
/// cables come to their least tension.
#[test]
fn tensions_without_feed_forward_are_those_of_the_simulated_motion() {
    for (file, height, share) in [(CAROCA, 1.75, 0.1), (IPANEMA_3, 1.5, 0.6)] {
        let (robot, poses) = (robot(file), poses(height));
        let plain = plain(&robot, &poses, Profile::Polynomial);
        let points = Move { seconds: 1.5, ..plain }.plan().unwrap();
        let [off, still] = off_simulated(&robot, &points);
        println!("{}: {off:.2} N, those at rest {still:.1} N", robot.name);
        assert!(off < share * still, "{}: {off} {still}", robot.name);
        assert!(points.iter().all(|point| point.feed_forward.iter().all(|more| *more == 0.0)));
    }
}

/// The inertia of a heavy cable is a force at both of its ends.
#[test]
fn heavy_cables_pull_as_they_move_themselves() {
    for (file, height) in [(CAROCA, 1.75), (COGIRO, 2.0)] {
        let mut robot = robot(file);
        for i in [1, 3] {
            robot.cables[i].properties.linear_density *= 3.0;
        }
        let poses = poses(height);
        // Without feed-forward the motion swings more.
        for (feed_forward, share) in
            [(FeedForward::Cables, 0.03), (FeedForward::Platform, 0.03), (FeedForward::None, 0.07)]
        {
            let plain = plain(&robot, &poses, Profile::Polynomial);
            let points = Move { seconds: 3.0, feed_forward, ..plain }.plan().unwrap();
            let [off, still] = off_simulated(&robot, &points);
            println!("{} {feed_forward:?}: {off:.3} N, those at rest {still:.2} N", robot.name);
            assert!(off < share * still, "{} {feed_forward:?}: {off} {still}", robot.name);
        }
    }
}

/// Cables that sag much turn and grow as a camera flies past them, which takes no force.
#[test]
fn a_camera_at_constant_speed_has_the_tensions_of_rest_and_feed_forward_keeps_it_near_its_way() {
    let robot = robot(STADIUM);
    let poses = [-20.0, 20.0].map(|x| Pose::at(x, 5.0, 12.0));
    let plain = plain(&robot, &poses, Profile::Polynomial);
    let deviation = |feed_forward| {
        let points = Move { seconds: 10.0, feed_forward, ..plain.clone() }.plan().unwrap();
        let middle = &points[points.len() / 2];
        let still = inverse(&robot, &middle.pose, &Load::none()).unwrap().tensions;
        for (moving, still) in middle.tensions.iter().zip(&still) {
            assert!((moving - still).abs() < 0.01 * still, "{moving} {still}");
        }
        after(&robot, &points).deviation
    };
    let [none, platform, cables] =
        [FeedForward::None, FeedForward::Platform, FeedForward::Cables].map(deviation);
    assert!(platform < 0.5 * none && cables < 0.8 * platform, "{none} {platform} {cables}");
}

#[test]
fn moves_that_are_not_possible_are_refused_with_the_reason() {
    let (robot, poses) = (robot(COGIRO), poses(2.0));
    let plain = plain(&robot, &poses, Profile::Polynomial);
    let refused = |of: Move| of.plan().unwrap_err();
    let too_fast =
        refused(Move { seconds: 0.35, feed_forward: FeedForward::Platform, rate: 500.0, ..plain.clone() });
    let DynamicsError::TooFast { time, position, cable: Some(cable), source } = &too_fast else {
        panic!("{too_fast:?}")
    };
    assert!(*time > 0.0 && *time < 0.35 && position[0] < 0.5 && *cable < 8, "{too_fast}");
    assert!(matches!(**source, StaticsError::NoTensions { .. }), "{source}");
    assert!(too_fast.to_string().contains("give it more seconds"), "{too_fast}");
    let mut without = robot.clone();
    without.platform.inertia = None;
    let of_platform = Move { feed_forward: FeedForward::Platform, ..plain.clone() };
    let error = refused(Move { robot: &without, ..of_platform.clone() });
    assert!(error.to_string().starts_with("platform.inertia is missing"), "{error}");
    let shaper = Shaper::new(ShaperKind::Zvd, 0.9, 0.0).unwrap();
    for (of, expected) in [
        (Move { shaper, ..plain.clone() }, "more than the 1.1111 s that the shaper takes"),
        (Move { profile: Profile::Linear, ..plain.clone() }, "begins with a jump of the speed"),
        (Move { profile: Profile::Cosine, ..of_platform }, "polynomial with feed-forward"),
        (Move { seconds: f64::NAN, ..plain.clone() }, "a duration [s] above zero"),
        (Move { rate: 1.0, ..plain.clone() }, "2 to 1e6 set points"),
        (Move { poses: &poses[..1], ..plain.clone() }, "two poses or more"),
    ] {
        let error = refused(of).to_string();
        assert!(error.contains(expected), "{error}");
    }
    // A pose that no cables hold at rest is no matter of the motion.
    let far = [poses[0], Pose::at(60.0, 0.0, 2.0)];
    assert!(matches!(refused(Move { poses: &far, ..plain }), DynamicsError::Statics(_)));
}
