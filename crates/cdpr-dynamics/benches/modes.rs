//! Natural motions with the mass of the cables: at one pose, with and without the counts; and a fifth of a
//! second of motion.

use cdpr_dynamics::moves::{FeedForward, Move, Shaper, ShaperKind};
use cdpr_dynamics::simulate::{Change, CutAt, Event, Profile, Settings, simulate};
use cdpr_dynamics::{Modes, MovingPlatform, Wanted};
use cdpr_robot::{Pose, Robot};
use cdpr_statics::{DirectProblem, DirectStart, Load, inverse};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

/// Robots, poses and bounds [Hz]: light and heavy cables, long ones with much sag, and pulleys.
const CASES: [(&str, &str, [f64; 3], f64); 4] = [
    ("cogiro", include_str!("../../../data/robots/cogiro.json"), [0.0, 0.0, 2.0], 20.0),
    ("caroca", include_str!("../../../data/robots/caroca.json"), [0.4, 0.3, 1.75], 40.0),
    ("ipanema-3", include_str!("../../../data/robots/ipanema-3.json"), [0.5, 0.2, 1.5], 20.0),
    ("fast", include_str!("../../../data/robots/fast.json"), [0.0, 0.0, 140.0], 1.0),
];

#[allow(clippy::unwrap_used)]
fn modes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("modes");
    for (name, file, [x, y, z], bound) in CASES {
        let mut robot = Robot::from_json(file).unwrap();
        let inertia = robot.platform.inertia.unwrap_or_else(|| robot.assumed_inertia());
        robot.platform.inertia = Some(inertia);
        let load = Load::none();
        let held = inverse(&robot, &Pose::at(x, y, z), &load).unwrap();
        let problem = DirectProblem::new(&robot, &held.lengths, &load).unwrap();
        let rest = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap().equilibrium;
        group.bench_function(name, |bencher| {
            bencher.iter(|| Modes::new(&problem, black_box(&rest), Wanted::Below(bound)).unwrap());
        });
        let platform = MovingPlatform::new(&problem, &rest, bound).unwrap();
        group.bench_function(format!("{name}/count"), |bencher| {
            bencher.iter(|| platform.count(black_box(bound)));
        });
    }
    group.finish();
}

/// A dropped payload on taut cables, and cables that part, after which others go slack: heavy and light ones.
#[allow(clippy::unwrap_used)]
fn motions(criterion: &mut Criterion) {
    let settings = Settings { damping: 2e-4, ..Settings::until(0.2) };
    let mut group = criterion.benchmark_group("simulate");
    group.sample_size(10);
    let light = include_str!("../../../data/robots/ipanema-1.json");
    let cut = Change::Cut { cable: 0, at: CutAt::Anchor };
    for (name, file, height, change) in [
        ("cogiro/payload", CASES[0].1, 2.0, Change::Payload(-50.0)),
        ("cogiro/cut", CASES[0].1, 2.0, cut.clone()),
        ("ipanema-1/cut", light, 1.0, cut),
    ] {
        let mut robot = Robot::from_json(file).unwrap();
        let inertia = robot.platform.inertia.unwrap_or_else(|| robot.assumed_inertia());
        robot.platform.inertia = Some(inertia);
        let load = Load::payload(if height == 2.0 { 50.0 } else { 0.0 });
        let held = inverse(&robot, &Pose::at(0.0, 0.0, height), &load).unwrap();
        let problem = DirectProblem::new(&robot, &held.lengths, &load).unwrap();
        let rest = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap().equilibrium;
        let events = [Event { time: 0.0, change }];
        group.bench_function(name, |bencher| {
            bencher.iter(|| simulate(&problem, black_box(&rest), &events, &settings).unwrap());
        });
    }
    group.finish();
}

/// The set points of a metre in a second, with a shaper and with feed-forward.
#[allow(clippy::unwrap_used)]
fn moves(criterion: &mut Criterion) {
    let robot = Robot::from_json(CASES[0].1).unwrap();
    let poses = [Pose::at(-0.5, 0.0, 2.0), Pose::at(0.5, 0.0, 2.0)];
    let plain = Move {
        robot: &robot,
        load: Load::none(),
        poses: &poses,
        seconds: 1.0,
        profile: Profile::Polynomial,
        shaper: Shaper::default(),
        feed_forward: FeedForward::None,
        rate: 200.0,
    };
    let mut group = criterion.benchmark_group("moves");
    group.sample_size(10);
    group.bench_function("cogiro/shaper", |bencher| {
        bencher.iter(|| black_box(&plain).shaped(ShaperKind::Zvd, 2, 0.0).unwrap().0.plan().unwrap());
    });
    let ahead = Move { feed_forward: FeedForward::Cables, ..plain.clone() };
    group.bench_function("cogiro/feed-forward", |bencher| {
        bencher.iter(|| black_box(&ahead).plan().unwrap());
    });
    group.finish();
}

criterion_group!(benches, modes, motions, moves);
criterion_main!(benches);
