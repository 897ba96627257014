//! One cable, over its sag ratio: from a taut cable to one that hangs in a deep loop.

#![allow(clippy::unwrap_used)]

use cdpr_cable::{Cable, Vector2, end_force, length_for_tension};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn catenary(criterion: &mut Criterion) {
    let cable = Cable { weight_per_length: 0.9957, axial_stiffness: 1.284e6 };
    let end = Vector2::new(4.1, -1.7);
    let mut group = criterion.benchmark_group("catenary");
    for slack in [-5e-4, 0.0, 1e-3, 1e-2, 1e-1, 1.0] {
        let length = end.norm() * (1.0 + slack);
        let solution = end_force(&cable, length, end).unwrap();
        assert!(solution.residual < 1e-13);
        let ratio = format!("sag {:.1e}", solution.catenary.sag() / end.norm());
        group.bench_with_input(BenchmarkId::new("end_force", &ratio), &length, |b, &length| {
            b.iter(|| end_force(black_box(&cable), length, black_box(end)));
        });
        group.bench_with_input(BenchmarkId::new("compliance", &ratio), &solution.catenary, |b, catenary| {
            b.iter(|| black_box(catenary).compliance());
        });
        let tension = solution.catenary.anchor_tension();
        group.bench_with_input(BenchmarkId::new("length_for_tension", &ratio), &tension, |b, &tension| {
            b.iter(|| length_for_tension(black_box(&cable), black_box(end), tension));
        });
    }
    group.finish();
}

criterion_group!(benches, catenary);
criterion_main!(benches);
