//! Tension distribution in closed form, with active bounds, and by Clarabel.

#![allow(clippy::unwrap_used)]

use cdpr_robot::{Pose, Robot, TensionLimits};
use cdpr_tension::{DistributionMethod, Problem, TensionError, distribute};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;

/// What `cargo xtask bench` counts the instructions of.
#[inline(never)]
fn counted<T>(task: impl FnOnce() -> T) -> T {
    task()
}

fn tension(criterion: &mut Criterion) {
    let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap();
    let pose = Pose::at(1.0, 0.5, 2.0);
    let pulls: Vec<_> = (0..8).map(|i| -robot.span(&pose, i).normalize()).collect();
    let wrench_matrix = robot.wrench_matrix(&pose, &pulls);
    let wrench = robot.weight(&pose, 0.0).to_vector();
    let mut group = criterion.benchmark_group("tension");
    for (name, min, method) in [
        ("closed_form", 1.0, DistributionMethod::ClosedForm),
        ("active_bounds", 450.0, DistributionMethod::ActiveSet),
    ] {
        let limits = &[TensionLimits { min, max: 10290.0 }; 8];
        let problem = Problem { wrench_matrix: &wrench_matrix, wrench, reference: &[0.0; 8], limits };
        let solution = distribute(&problem).unwrap();
        assert_eq!(solution.method, method);
        assert!(solution.residual.norm() < 1e-9);
        group.bench_function(name, |b| b.iter(|| counted(|| distribute(black_box(&problem)))));
    }
    // Tensions too small for the weight: Clarabel proves it and finds the best attempt.
    let limits = &[TensionLimits { min: 1.0, max: 10.0 }; 8];
    let problem = Problem { wrench_matrix: &wrench_matrix, wrench, reference: &[0.0; 8], limits };
    assert!(matches!(distribute(&problem), Err(TensionError::Infeasible { .. })));
    group.bench_function("clarabel", |b| b.iter(|| counted(|| distribute(black_box(&problem)))));
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(2));
    targets = tension
}
criterion_main!(benches);
