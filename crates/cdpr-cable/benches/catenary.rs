//! One cable, over its sag ratio: from a taut cable to one that hangs in a deep loop.

#![allow(clippy::unwrap_used)]

use cdpr_cable::{Cable, Catenary, Vector2, end_force, length_for_tension, response};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;

/// What `cargo xtask bench` counts the instructions of.
#[inline(never)]
fn counted<T>(task: impl FnOnce() -> T) -> T {
    task()
}

fn catenary(criterion: &mut Criterion) {
    let cable = Cable::linear(0.9957, 1.284e6);
    let end = Vector2::new(4.1, -1.7);
    let mut group = criterion.benchmark_group("catenary");
    for slack in [-5e-4, 0.0, 1e-3, 1e-2, 1e-1, 1.0] {
        let length = end.norm() * (1.0 + slack);
        let solution = end_force(&cable, length, end).unwrap();
        assert!(solution.residual < 1e-13);
        let Catenary { force, .. } = solution.catenary;
        let tension = force.norm();
        let again = length_for_tension(&cable, end, tension).unwrap();
        // Deep loops share their tension with a shorter cable, which is the answer.
        assert!((again.catenary.anchor_tension() / tension - 1.0).abs() < 1e-12);
        let respond = |[fx, fz]: [f64; 2]| {
            response(cable.weight_per_length, cable.axial_stiffness.recip(), length, [fx, fz])
        };
        assert!((Vector2::from(respond(force.into()).end) - end).norm() < 1e-12);

        let ratio = format!("sag {:.1e}", solution.catenary.sag() / end.norm());
        group.bench_function(BenchmarkId::new("response", &ratio), |b| {
            b.iter(|| counted(|| respond(black_box(force.into()))));
        });
        group.bench_function(BenchmarkId::new("end_force", &ratio), |b| {
            b.iter(|| counted(|| end_force(black_box(&cable), length, black_box(end))));
        });
        group.bench_function(BenchmarkId::new("length_for_tension", &ratio), |b| {
            b.iter(|| counted(|| length_for_tension(black_box(&cable), black_box(end), tension)));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(2));
    targets = catenary
}
criterion_main!(benches);
