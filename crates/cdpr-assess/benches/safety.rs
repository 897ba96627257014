//! A single cut: where a released platform comes to rest on its other cables, of robots that differ.

#![allow(clippy::unwrap_used)]

use cdpr_assess::{Breaks, safety_at};
use cdpr_robot::{Coordinate, Pose, Robot};
use cdpr_statics::{Load, WantedPose};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;

/// A robot, and a position that it holds [m].
type Held = (&'static str, &'static str, [f64; 3]);

const ROBOTS: [Held; 6] = [
    ("caroca", include_str!("../../../data/robots/caroca.json"), [0.0, 0.0, 1.75]),
    ("cogiro", include_str!("../../../data/robots/cogiro.json"), [0.03, -0.03, 1.67]),
    ("fast", include_str!("../../../data/robots/fast.json"), [0.0, 0.0, 140.1]),
    ("prestressed", include_str!("../../../data/robots/ipanema-1.json"), [0.0, 0.0, 1.0]),
    ("few_cables", include_str!("../../../data/robots/four-cables.json"), [0.5, 0.3, 2.0]),
    ("pulleys", include_str!("../../../data/robots/ipanema-3.json"), [-0.25, 0.17, 1.33]),
];

/// All cuts of a pose; the time of one is that of an element.
fn safety(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("safety");
    for (name, robot, [x, y, z]) in ROBOTS {
        let (robot, pose) = (Robot::from_json(robot).unwrap(), Pose::at(x, y, z));
        let few = [Coordinate::Roll, Coordinate::Pitch];
        let free: &[Coordinate] = if robot.cables.len() == 4 { &few } else { &[] };
        let (load, breaks) = (Load::none(), Breaks::default());
        let cut = || safety_at(black_box(&robot), WantedPose::at(&pose).free(free), &load, breaks).unwrap();
        assert!(cut().broken.iter().all(|broken| broken.rest.is_ok()), "{name}");
        group.throughput(Throughput::Elements(robot.cables.len() as u64));
        group.bench_function(BenchmarkId::new("cuts", name), |b| b.iter(cut));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(3));
    targets = safety
}
criterion_main!(benches);
