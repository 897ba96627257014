//! Tension distribution in closed form and by Clarabel.

#![allow(clippy::unwrap_used)]

use cdpr_robot::{Pose, Robot, TensionLimits};
use cdpr_tension::{DistributionMethod, Objective, Problem, TensionError, distribute};
use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::{DMatrix, DVector};
use std::hint::black_box;
use std::time::Duration;

/// What `cargo xtask bench` counts the instructions of.
#[inline(never)]
fn in_one_call<T>(task: impl FnOnce() -> T) -> T {
    task()
}

fn tension(criterion: &mut Criterion) {
    let robot = Robot::from_library("caroca").unwrap();
    let pose = Pose::at(1.0, 0.5, 2.0);
    let pulls: Vec<_> = (0..8).map(|i| -robot.span(&pose, i).normalize()).collect();
    let wrench_matrix = &DMatrix::from_column_slice(6, 8, robot.wrench_matrix(&pose, &pulls).as_slice());
    let wrench = &DVector::from_column_slice(robot.weight(&pose, 0.0).to_vector().as_slice());
    let mut group = criterion.benchmark_group("tension");
    for (name, min, objective, method) in [
        ("closed_form", 1.0, Objective::Nearest(&[0.0; 8]), DistributionMethod::ClosedForm),
        ("nearest", 450.0, Objective::Nearest(&[0.0; 8]), DistributionMethod::OptimalityConditions),
        ("least_sum", 450.0, Objective::LeastSum, DistributionMethod::InteriorPoint),
    ] {
        let limits = &[TensionLimits { min, max: 10290.0 }; 8];
        let problem = Problem { wrench_matrix, wrench, limits };
        let solution = distribute(&problem, objective).unwrap();
        assert_eq!(solution.method, method);
        assert!(solution.residual.norm() < 1e-5);
        group.bench_function(name, |b| b.iter(|| in_one_call(|| distribute(black_box(&problem), objective))));
    }
    // Tensions too small for the weight: Clarabel proves it and finds the best attempt.
    let limits = &[TensionLimits { min: 1.0, max: 10.0 }; 8];
    let (problem, least) = (Problem { wrench_matrix, wrench, limits }, Objective::Nearest(&[0.0; 8]));
    assert!(matches!(distribute(&problem, least), Err(TensionError::Infeasible { .. })));
    group.bench_function("infeasible", |b| b.iter(|| in_one_call(|| distribute(black_box(&problem), least))));
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
