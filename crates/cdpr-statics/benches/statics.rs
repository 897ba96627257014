//! Inverse model, direct model (near, far, slack; over the number of cables) and a whole deflection.

#![allow(clippy::unwrap_used)]

mod problems;

use cdpr_robot::{Pose, Pulley, Robot, Vector3};
use cdpr_statics::continuation::{Setting, follow};
use cdpr_statics::{DirectProblem, DirectStart, Load, Tracker, deflection, derivatives, direct, inverse};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use problems::{caroca, in_one_call, ring, settings};
use std::hint::black_box;

fn inverse_model(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("inverse");
    let robot = caroca();
    for (name, pose) in [("symmetric", Pose::at(0.0, 0.0, 1.75)), ("corner", Pose::at(3.2, 1.7, 3.0))] {
        let solution = inverse(&robot, &pose, &Load::none()).unwrap();
        assert!(solution.residual.force < 1e-9);
        group.bench_function(name, |b| {
            b.iter(|| in_one_call(|| inverse(black_box(&robot), black_box(&pose), &Load::none())));
        });
    }
    for (name, axis) in pulleys() {
        let (robot, pose) = (led(axis), Pose::at(0.0, 0.0, 1.75));
        assert!(inverse(&robot, &pose, &Load::none()).unwrap().residual.force < 1e-9);
        group.bench_function(BenchmarkId::new("pulleys", name), |b| {
            b.iter(|| in_one_call(|| inverse(black_box(&robot), black_box(&pose), &Load::none())));
        });
    }
    group.finish();
}

/// CAROCA with pulleys of 45 mm, which its cables enter along `axis`, and leads of 3 m.
fn led(axis: Vector3<f64>) -> Robot {
    let mut robot = caroca();
    for cable in &mut robot.cables {
        (cable.pulley, cable.lead) = (Some(Pulley { radius: 0.045, axis }), 3.0);
    }
    robot
}

/// Axes along which cables enter their pulleys.
fn pulleys() -> [(&'static str, Vector3<f64>); 2] {
    [("vertical", Vector3::z()), ("tilted", Vector3::new(0.05, -0.03, 1.0))]
}

fn direct_model(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("direct");
    let robot = caroca();
    let pose = Pose::at(0.4, -0.3, 1.75);
    let wanted = inverse(&robot, &pose, &Load::none()).unwrap();
    let slack: Vec<f64> =
        wanted.lengths.iter().enumerate().map(|(i, l)| if i % 4 == 1 { l + 0.3 } else { *l }).collect();
    let far = pose.moved(Vector3::new(0.3, 0.2, -0.3), Vector3::new(0.15, -0.1, 0.15));
    // 50 kg added; 0.5 m and 0.25 rad away; two cables slack.
    let cases = [
        ("near", &wanted.lengths, Load::payload(50.0), DirectStart::Near(&wanted.equilibrium)),
        ("far", &wanted.lengths, Load::none(), DirectStart::Pose(&far)),
        ("slack", &slack, Load::none(), DirectStart::Pose(&pose)),
    ];
    for (name, lengths, load, start) in cases {
        let found = direct(&robot, lengths, &load, start).unwrap();
        assert!(found.report.residual.force < 1e-8, "{name}: {:?}", found.report);
        group.bench_function(name, |b| {
            b.iter(|| in_one_call(|| direct(black_box(&robot), black_box(lengths), &load, start)));
        });
    }
    let lawful = Robot::from_library("caroca-law").unwrap();
    let unloaded = inverse(&lawful, &pose, &Load::none()).unwrap();
    let (load, near) = (Load::payload(50.0), DirectStart::Near(&unloaded.equilibrium));
    assert!(direct(&lawful, &unloaded.lengths, &load, near).unwrap().report.residual.force < 1e-8);
    group.bench_function("law", |b| {
        b.iter(|| in_one_call(|| direct(black_box(&lawful), black_box(&unloaded.lengths), &load, near)));
    });
    for n in [6, 8, 12, 16] {
        let robot = ring(n);
        let pose = Pose::at(0.1, 0.2, 1.5);
        let lengths: Vec<f64> = (0..n).map(|i| 0.9999 * robot.span(&pose, i).norm()).collect();
        let start = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&pose)).unwrap();
        let near = DirectStart::Near(&start.equilibrium);
        let load = Load::payload(5.0);
        assert!(direct(&robot, &lengths, &load, near).unwrap().report.residual.force < 1e-8);
        group.bench_function(BenchmarkId::new("cables", n), |b| {
            b.iter(|| in_one_call(|| direct(black_box(&robot), black_box(&lengths), &load, near)));
        });
    }
    group.finish();
}

/// A control loop: the length of every cable changes by up to a millimetre between two solves.
fn tracking(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("direct");
    let robot = caroca();
    let wanted = inverse(&robot, &Pose::at(0.4, -0.3, 1.75), &Load::none()).unwrap();
    let load = Load::payload(50.0);
    let changed: Vec<f64> =
        wanted.lengths.iter().enumerate().map(|(i, l)| l + 1e-3 * (i as f64).sin()).collect();
    let mut tracker = Tracker::new(&robot, &wanted.lengths, &load, &wanted.equilibrium).unwrap();
    let expected =
        direct(&robot, &changed, &load, DirectStart::Near(&wanted.equilibrium)).unwrap().equilibrium.pose;
    let found = tracker.update(&changed, &load).unwrap().pose;
    assert!((found.position - expected.position).norm() < 1e-12);
    let mut there = false;
    group.bench_function("tracked", |b| {
        b.iter(|| {
            there = !there;
            let lengths = black_box(if there { &wanted.lengths } else { &changed });
            in_one_call(|| tracker.update(lengths, &load).is_ok())
        });
    });
    group.finish();
}

fn proofs_and_searches(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("direct");
    let robot = caroca();
    let pose = Pose::at(0.4, -0.3, 1.75);
    let wanted = inverse(&robot, &pose, &Load::none()).unwrap();
    let load = Load::payload(50.0);
    let found = direct(&robot, &wanted.lengths, &load, DirectStart::Near(&wanted.equilibrium)).unwrap();
    let proof = DirectProblem::new(&robot, &wanted.lengths, &load).unwrap().certify(&found).unwrap();
    assert!(proof.position < 1e-12 && proof.is_stable());
    group.bench_function("certify", |b| {
        b.iter(|| {
            in_one_call(|| {
                DirectProblem::new(black_box(&robot), black_box(&wanted.lengths), &load)?.certify(&found)
            })
        });
    });
    assert!(found.stability.least_stiffness() > 0.0);
    group.bench_function("least_stiffness", |b| {
        b.iter(|| in_one_call(|| black_box(&found).stability.least_stiffness()));
    });
    let from = Setting { lengths: wanted.lengths.clone(), load: Load::none() };
    let to = Setting { lengths: wanted.lengths.clone(), load };
    assert_eq!(follow(&robot, &from, &to, DirectStart::Near(&wanted.equilibrium)).unwrap().lost, None);
    group.bench_function("follow", |b| {
        b.iter(|| {
            in_one_call(|| follow(black_box(&robot), &from, &to, DirectStart::Near(&wanted.equilibrium)))
        });
    });
    group.finish();
}

fn whole_deflection(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("deflection");
    let (robot, load) = (caroca(), Load::payload(50.0));
    for (name, pose, expected_mm) in
        [("symmetric", Pose::at(0.0, 0.0, 1.75), 1.33125), ("corner", Pose::at(3.2, 1.7, 3.0), 0.82186)]
    {
        let found = deflection(&robot, &pose, &load).unwrap();
        assert!((1e3 * found.magnitude() - expected_mm).abs() < 1e-4);
        group.bench_function(name, |b| {
            b.iter(|| in_one_call(|| deflection(black_box(&robot), black_box(&pose), &load)));
        });
        group.bench_function(BenchmarkId::new("tangent", name), |b| {
            let (lengths, unloaded) = (&found.lengths, &found.unloaded.equilibrium);
            b.iter(|| {
                in_one_call(|| {
                    DirectProblem::new(black_box(&robot), lengths, &Load::none())?.linearize(unloaded)
                })
            });
        });
    }
    for (name, axis) in pulleys() {
        let (robot, pose) = (led(axis), Pose::at(0.0, 0.0, 1.75));
        let found = deflection(&robot, &pose, &load).unwrap();
        assert!(found.loaded.report.residual.force < 1e-8);
        group.bench_function(BenchmarkId::new("pulleys", name), |b| {
            b.iter(|| in_one_call(|| deflection(black_box(&robot), black_box(&pose), &load)));
        });
    }
    group.finish();
}

fn exact_derivatives(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("derivatives");
    let (robot, load) = (caroca(), Load::payload(50.0));
    // d|dp|/dE [mm/GPa].
    for (name, pose, expected) in
        [("symmetric", Pose::at(0.0, 0.0, 1.75), -0.012889), ("corner", Pose::at(3.2, 1.7, 3.0), -0.007163)]
    {
        let found = derivatives(&robot, &pose, &load).unwrap();
        assert!((1e12 * found.magnitude().unwrap()[2] - expected).abs() < 1e-6);
        group.bench_function(name, |b| {
            b.iter(|| in_one_call(|| derivatives(black_box(&robot), black_box(&pose), &load)));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = settings();
    targets = inverse_model, direct_model, tracking, proofs_and_searches, whole_deflection, exact_derivatives
}
criterion_main!(benches);
