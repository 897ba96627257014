//! Maps of robots that differ: a plane with the load on it, where most positions are held and where none is.

#![allow(clippy::unwrap_used)]

use cdpr_assess::{Further, Workspace, compute_workspace};
use cdpr_robot::{Robot, Rotation3};
use cdpr_statics::Load;
use cdpr_study::{Grid, GridAxis};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;

/// A map: its name, the robot, half of the extent along x and y and the height [m], the payload [kg], and
/// whether more than half of the positions are held.
type Map = (&'static str, &'static str, [f64; 3], f64, bool);

const MAPS: [Map; 5] = [
    ("caroca", include_str!("../../../data/robots/caroca.json"), [3.0, 1.6, 1.75], 50.0, true),
    ("caroca_outside", include_str!("../../../data/robots/caroca.json"), [3.0, 1.6, 4.5], 50.0, false),
    ("cogiro", include_str!("../../../data/robots/cogiro.json"), [6.0, 4.0, 1.5], 50.0, true),
    ("fast", include_str!("../../../data/robots/fast.json"), [10.0, 10.0, 140.1], 3000.0, true),
    ("pulleys", include_str!("../../../data/robots/ipanema-3.json"), [4.0, 3.0, 1.0], 5.0, true),
];

/// Points along either axis.
const POINTS: usize = 16;

fn workspace(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("workspace");
    group.throughput(Throughput::Elements((POINTS * POINTS) as u64));
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for (name, robot, [x, y, z], payload, mostly_held) in MAPS {
        let robot = Robot::from_json(robot).unwrap();
        let axis = |half: f64| GridAxis { min: -half, max: half, points: POINTS };
        let height = GridAxis { min: z, max: z, points: 1 };
        let workspace = Workspace {
            robot: &robot,
            grid: Grid::new([axis(x), axis(y), height]).unwrap(),
            rotation: Rotation3::identity(),
            load: Load::payload(payload),
            tolerances: None,
            free: &[],
            further: Further::default(),
        };
        let map = || one.install(|| compute_workspace(black_box(&workspace), &|| (), &|| false).unwrap());
        let held = map().iter().filter(|pose| pose.outcome.is_ok()).count();
        assert_eq!(2 * held > POINTS * POINTS, mostly_held, "{name}: {held} held");
        group.bench_function(BenchmarkId::new("map", name), |b| b.iter(map));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(3));
    targets = workspace
}
criterion_main!(benches);
