//! Observations of perturbed robots: one by the scalar chain, many in the lanes of the vector unit, over
//! their number and over the number of cables, without and with the derivatives by all parameters; and of
//! robots with free coordinates.

#![allow(clippy::unwrap_used)]

mod problems;

use cdpr_robot::{Coordinate, Parameter, Pose, Pulley, Robot, Vector3};
use cdpr_statics::batch::{Observation, ObservationSlopes};
use cdpr_statics::{Load, Observer, WantedPose};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use problems::common::{alone, observed, robots};
use problems::{caroca, in_one_call, ring, settings};
use std::hint::black_box;

/// Rows of deviations: sawtooths through the ranges of Table 3 of Baklouti, Caro, Courteille (CableCon 2017),
/// one a parameter.
fn deviations(robot: &Robot, robots: usize) -> Vec<f64> {
    sawtooths(robot, robots, |parameter| match parameter {
        Parameter::Mass => 18.0,
        Parameter::LinearDensity => 0.01015,
        Parameter::YoungsModulus => 1.8e10,
        Parameter::AnchorPoint(..) | Parameter::CenterOfMass(_) => 0.015,
        Parameter::ExitPoint(..) => 0.03,
        Parameter::TensionOffset(_) => 15.0,
        _ => 0.0,
    })
}

/// The same in proportion to a robot's weight, cables and platform.
fn shares(robot: &Robot, robots: usize) -> Vec<f64> {
    let cable = &robot.cables[0].properties;
    sawtooths(robot, robots, |parameter| match parameter {
        Parameter::Mass => 0.05 * robot.platform.mass,
        Parameter::LinearDensity => 0.1 * cable.linear_density,
        Parameter::YoungsModulus => 0.2 * cable.youngs_modulus,
        Parameter::TensionOffset(_) => 0.04 * robot.platform.mass,
        Parameter::PulleyRadius(_) => 0.0005,
        Parameter::Lead(_) => 0.05,
        Parameter::Tilt(..) => 0.0,
        _ => 0.01 * robot.platform_size(),
    })
}

/// The robot with a pulley and a lead for every cable.
fn guided(mut robot: Robot) -> Robot {
    for cable in &mut robot.cables {
        cable.pulley = Some(Pulley { radius: 0.045, axis: Vector3::z() });
        cable.lead = 3.0;
    }
    robot.name += ", pulleys and leads";
    robot
}

fn sawtooths(robot: &Robot, robots: usize, half_range: impl Fn(&Parameter) -> f64) -> Vec<f64> {
    let parameters = Parameter::of(robot);
    let entries = 0..parameters.len() * robots;
    entries
        .map(|i| half_range(&parameters[i % parameters.len()]) * ((i * 37 % 101) as f64 / 50.0 - 1.0))
        .collect()
}

fn observation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("observation");
    let (robot, load) = (caroca(), Load::payload(50.0));
    let observer = Observer::new(&robot, Pose::at(0.0, 0.0, 1.75), &load).unwrap();
    let nominal = alone::<Observation>(&observer, &[0.0; 62]).unwrap();
    assert!((1e3 * nominal.magnitude() - 1.33125).abs() < 1e-4);

    let one = deviations(&robot, 1);
    group.throughput(Throughput::Elements(1));
    group.bench_function("scalar", |b| {
        b.iter(|| in_one_call(|| alone::<Observation>(&observer, black_box(&one))));
    });
    for batch in [1, 8, 64, 256, 4096] {
        let rows = deviations(&robot, batch);
        for (found, row) in observed::<Observation>(&observer, &rows).iter().zip(rows.chunks(62)) {
            let (found, scalar) = (found.as_ref().unwrap(), alone::<Observation>(&observer, row).unwrap());
            assert!((found.displacement - scalar.displacement).norm() < 1e-12);
        }
        group.throughput(Throughput::Elements(batch as u64));
        group.bench_function(BenchmarkId::new("batch", batch), |b| {
            b.iter(|| in_one_call(|| observed::<Observation>(&observer, black_box(&rows))));
        });
    }

    const BATCH: usize = 256;
    group.throughput(Throughput::Elements(BATCH as u64));
    for cables in [6, 8, 10, 12, 14, 16] {
        let robot = ring(cables);
        let observer = Observer::new(&robot, Pose::at(0.1, 0.2, 1.5), &load).unwrap();
        let rows = deviations(&robot, BATCH);
        let found = observed::<Observation>(&observer, &rows);
        assert!(found.iter().all(|found| found.as_ref().is_ok_and(|found| found.loaded.force < 1e-8)));
        group.bench_function(BenchmarkId::new("cables", cables), |b| {
            b.iter(|| in_one_call(|| observed::<Observation>(&observer, black_box(&rows))));
        });
    }
    let guided = robots().map(|(robot, pose)| (guided(robot), pose));
    for (robot, pose) in robots().into_iter().chain(guided) {
        let load = Load::payload(0.1 * robot.platform.mass);
        let observer = Observer::new(&robot, pose, &load).unwrap();
        let rows = shares(&robot, BATCH);
        assert!(observed::<Observation>(&observer, &rows).iter().all(Result::is_ok), "{}", robot.name);
        group.bench_function(BenchmarkId::new("robots", &robot.name), |b| {
            b.iter(|| in_one_call(|| observed::<Observation>(&observer, black_box(&rows))));
        });
        let found = observed::<ObservationSlopes>(&observer, &rows).into_iter().map(Result::unwrap);
        let in_lanes = found.filter(|found| found.observation.scalar.is_none()).count();
        assert!(in_lanes > BATCH * 7 / 8, "{}: {in_lanes}", robot.name);
        group.bench_function(BenchmarkId::new("slopes", &robot.name), |b| {
            b.iter(|| in_one_call(|| observed::<ObservationSlopes>(&observer, black_box(&rows))));
        });
    }
    for (robot, pose, free) in on_four_cables() {
        let load = Load::payload(0.1 * robot.platform.mass);
        let observer = Observer::new(&robot, WantedPose::at(&pose).free(&free), &load).unwrap();
        let rows: Vec<f64> = shares(&robot, BATCH).iter().map(|deviation| 0.1 * deviation).collect();
        let found = observed::<Observation>(&observer, &rows);
        assert!(found.iter().all(|found| found.as_ref().unwrap().scalar.is_none()), "{}", robot.name);
        group.bench_function(BenchmarkId::new("free", &robot.name), |b| {
            b.iter(|| in_one_call(|| observed::<Observation>(&observer, black_box(&rows))));
        });
    }
    group.finish();
}

/// Robots whose four cables leave two angles free, without pulleys.
fn on_four_cables() -> [(Robot, Pose, [Coordinate; 2]); 2] {
    let [_, (mut cogiro, _), ..] = robots();
    cogiro.cables = [0, 2, 4, 6].map(|i| cogiro.cables[i].clone()).to_vec();
    cogiro.name += ", four cables";
    let mut grab = Robot::from_library("grab").unwrap();
    grab.cables.iter_mut().for_each(|cable| cable.pulley = None);
    use Coordinate::{Pitch, Roll, Yaw};
    [(cogiro, Pose::at(1.0, 0.5, 2.0), [Roll, Yaw]), (grab, Pose::at(1.2, -0.2, -0.3), [Roll, Pitch])]
}

criterion_group! {
    name = benches;
    config = settings();
    targets = observation
}
criterion_main!(benches);
