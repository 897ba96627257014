//! Rotations of observations in lanes: those of the scalar models.

use crate::any_lanes::case;
use crate::common::{alone, observed, robots};
use cdpr_robot::{Parameter, Pose, Robot, Vector3};
use cdpr_statics::batch::{Observation, ObservationMotion};
use cdpr_statics::{Load, Observer};
use rayon::prelude::*;

/// Random robots.
const CASES: u64 = 1_000;

/// Largest difference of two motions relative to the longest cable, as in `any_lanes.rs`; rotations are times
/// the size of the platform.
const AGREEMENT: f64 = 1e-11;

/// Number of rows that were found in lanes, and the largest rotation among them [rad].
fn compare(robot: &Robot, pose: &Pose, load: &Load, rows: &[f64]) -> (usize, f64) {
    let (name, parameters) = (&robot.name, Parameter::of(robot).len());
    let longest = (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max);
    let observer = Observer::new(robot, pose, load).unwrap();
    let (observed, found) =
        (observed::<Observation>(&observer, rows), observed::<ObservationMotion>(&observer, rows));
    assert_eq!(found.len(), observed.len());
    let (mut in_lanes, mut largest) = (0, 0.0);
    for ((row, observed), found) in rows.chunks(parameters).zip(observed).zip(found) {
        // NaN in residuals is not equal to itself.
        assert_eq!(
            format!("{:?}", found.as_ref().map(|of| of.observation)),
            format!("{:?}", observed.as_ref())
        );
        let (Ok(found), Ok(alone)) = (found, alone::<ObservationMotion>(&observer, row)) else { continue };
        let distance = (alone.observation.displacement - found.observation.displacement).norm();
        if found.observation.scalar.is_some() || distance > AGREEMENT * longest {
            continue;
        }
        let difference = (found.rotation - alone.rotation).norm() * robot.platform_size();
        assert!(
            difference <= AGREEMENT * longest,
            "{name}: {:?} is not {:?}",
            found.rotation,
            alone.rotation
        );
        in_lanes += 1;
        largest = f64::max(largest, found.rotation.norm());
    }
    (in_lanes, largest)
}

#[test]
fn rotations_in_lanes_are_those_of_the_scalar_models() {
    let level = robots();
    let tilted = level.clone().map(|(robot, pose)| {
        let gravity = Vector3::new(0.3, -0.2, -9.8).into();
        (Robot { gravity, name: format!("{} on a tilted base", robot.name), ..robot }, pose)
    });
    for (robot, pose) in level.into_iter().chain(tilted) {
        let mut load = Load::payload(0.1 * robot.platform.mass);
        load.wrench.force = Vector3::new(0.3, 0.2, 0.0) * robot.platform.mass;
        let parameters = Parameter::of(&robot);
        let half = |parameter: &Parameter| match parameter {
            Parameter::Mass => 0.05 * robot.platform.mass,
            Parameter::LinearDensity => 0.1 * robot.cables[0].properties.linear_density,
            Parameter::YoungsModulus => 0.2 * robot.cables[0].properties.youngs_modulus,
            Parameter::TensionOffset(_) => 0.04 * robot.platform.mass,
            Parameter::Gravity(_) => 0.05,
            _ => 0.01 * robot.platform_size(),
        };
        let entry = |i: usize| half(&parameters[i % parameters.len()]) * ((i * 37 % 101) as f64 / 50.0 - 1.0);
        let rows: Vec<f64> = (0..64 * parameters.len()).map(entry).collect();
        let (in_lanes, largest) = compare(&robot, &pose, &load, &rows);
        println!("{}: {in_lanes} of 64 in lanes, rotations up to {largest:.1e} rad", robot.name);
        assert!(in_lanes > 56 && largest > 1e-6, "{}", robot.name);
    }
}

#[test]
fn rotations_in_lanes_are_those_of_the_scalar_models_for_any_robot() {
    let of = |seed| case(seed).map(|of| compare(&of.robot, &of.pose, &of.load, &of.rows).0);
    let in_lanes: usize = (0..CASES).into_par_iter().filter_map(of).sum();
    println!("{in_lanes} in lanes");
    assert!(in_lanes > CASES as usize / 3);
}
