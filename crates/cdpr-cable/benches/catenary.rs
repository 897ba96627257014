//! One cable, over its sag ratio: from a taut cable to one that hangs in a deep loop.

#![allow(clippy::unwrap_used)]

use cdpr_cable::kernel::response;
use cdpr_cable::{
    Cable, Catenary, ElasticLaw, PiecewiseLaw, Segment, Vector2, end_force, length_for_tension,
};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;

/// What `cargo xtask bench` counts the instructions of.
#[inline(never)]
fn in_one_call<T>(task: impl FnOnce() -> T) -> T {
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
            b.iter(|| in_one_call(|| respond(black_box(force.into()))));
        });
        group.bench_function(BenchmarkId::new("end_force", &ratio), |b| {
            b.iter(|| in_one_call(|| end_force(black_box(&cable), length, black_box(end))));
        });
        group.bench_function(BenchmarkId::new("length_for_tension", &ratio), |b| {
            b.iter(|| in_one_call(|| length_for_tension(black_box(&cable), black_box(end), tension)));
        });
    }
    group.finish();
}

/// A cable whose stiffness changes within its length, and one that stays within a piece of its law.
fn elastic_law(criterion: &mut Criterion) {
    let segments = [(0.0, 0.6), (50.0, 0.8), (50.5, 1.0), (600.0, 1.2)]
        .map(|(tension, ratio)| Segment { tension, ratio });
    let law = PiecewiseLaw::new(0.0, &segments).unwrap();
    let cable = Cable { law: ElasticLaw::Piecewise(&law), ..Cable::linear(0.9957, 1.284e6) };
    let end = Vector2::new(4.1, -1.7);
    let mut group = criterion.benchmark_group("catenary/law");
    for (name, tension) in [("kink", 51.0), ("piece", 550.0)] {
        let taut = length_for_tension(&cable, end, tension).unwrap();
        assert!(taut.residual < 1e-13);
        let Catenary { unstrained_length: length, .. } = taut.catenary;
        let found = end_force(&cable, length, end).unwrap();
        assert!((found.catenary.anchor_tension() / tension - 1.0).abs() < 1e-9);
        group.bench_function(BenchmarkId::new("response", name), |b| {
            b.iter(|| in_one_call(|| black_box(&taut.catenary).response()));
        });
        group.bench_function(BenchmarkId::new("end_force", name), |b| {
            b.iter(|| in_one_call(|| end_force(black_box(&cable), length, black_box(end))));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(2));
    targets = catenary, elastic_law
}
criterion_main!(benches);
