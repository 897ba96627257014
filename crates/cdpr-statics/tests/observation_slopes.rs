//! Derivatives of observations in lanes: those of the scalar models.

use crate::any_lanes::{Case, case};
use crate::common::robots;
use cdpr_robot::{Parameter, Pose, Robot, Vector3};
use cdpr_statics::{Load, Observer, ScalarReason};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Random robots; `CDPR_CASES` takes the place of this number.
const CASES: u64 = 1_000;

/// Largest difference of two slopes times the range of their parameter, relative to the longest cable: as
/// that of two observations in `any_lanes.rs`.
const AGREEMENT: f64 = 1e-11;

/// What became of each row, with the greatest difference of two slopes times the range of their parameter,
/// relative to the largest such product.
fn compare(robot: &Robot, pose: &Pose, load: &Load, rows: &[f64]) -> Vec<(&'static str, f64)> {
    let (name, parameters) = (&robot.name, Parameter::of(robot).len());
    let longest = (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max);
    let observer = Observer::new(robot, pose, load).unwrap();
    let range = |k: usize| rows.chunks(parameters).map(|row| row[k].abs()).fold(0.0, f64::max);
    let ranges: Vec<f64> = (0..parameters).map(range).collect();
    let observed = observer.observe_all(rows);
    let found = observer.observe_all_slopes(rows);
    assert_eq!(found.len(), observed.len());
    let outcome = |((row, observed), found): ((&[f64], _), &Result<_, _>)| {
        let (observed, found): (&Result<_, _>, &cdpr_statics::ObservationSlopes) = match found {
            Ok(found) => (observed, found),
            Err(error) => return (cdpr_statics::StaticsError::kind(error), 0.0),
        };
        if let Some(why) = found.observation.scalar {
            return (why.name(), 0.0);
        }
        assert_eq!(Some(&found.observation), observed.as_ref().ok(), "{name}");
        let Ok(alone) = observer.observe_slopes(row) else { return ("lanes only", 0.0) };
        let distance = (alone.observation.displacement - found.observation.displacement).norm();
        if distance > AGREEMENT * longest {
            return ("another minimum", 0.0);
        }
        let scaled =
            |slopes: &[f64]| -> Vec<f64> { slopes.iter().zip(&ranges).map(|(s, r)| s * r).collect() };
        let (found, alone) = (scaled(&found.rms), scaled(&alone.rms));
        let largest = alone.iter().fold(0.0, |largest: f64, slope| largest.max(slope.abs()));
        let errors = found.iter().zip(&alone).map(|(a, b)| (a - b).abs());
        let (worst, error) = errors.enumerate().fold((0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
        if error.is_nan() || error > AGREEMENT * longest {
            println!("{name}: parameter {worst}: {:e} in lanes, {:e} alone", found[worst], alone[worst]);
            return ("DIFFERENT", error / largest);
        }
        ("lanes", error / largest)
    };
    rows.chunks(parameters).zip(&observed).zip(&found).map(outcome).collect()
}

fn counts(all: &[(&'static str, f64)]) -> BTreeMap<&'static str, usize> {
    all.iter().fold(BTreeMap::new(), |mut counts, (outcome, _)| {
        *counts.entry(*outcome).or_default() += 1;
        counts
    })
}

#[test]
fn slopes_in_lanes_are_those_of_the_scalar_models() {
    let level = robots();
    let tilted = level.clone().map(|(robot, pose)| {
        let gravity = Vector3::new(0.3, -0.2, -9.8).into();
        (Robot { gravity, name: format!("{} on a tilted base", robot.name), ..robot }, pose)
    });
    for (robot, pose) in level.into_iter().chain(tilted) {
        let load = Load::payload(0.1 * robot.platform.mass);
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
        let all = compare(&robot, &pose, &load, &rows);
        let worst = all.iter().map(|(_, error)| *error).fold(0.0, f64::max);
        println!("{}: {:?}, differences up to {worst:.1e}", robot.name, counts(&all));
        assert!(counts(&all)["lanes"] > 56 && worst < 1e-9, "{}", robot.name);
    }
}

#[test]
fn slopes_in_lanes_are_those_of_the_scalar_models_for_any_robot() {
    let cases = std::env::var("CDPR_CASES").map_or(CASES, |cases| cases.parse().unwrap());
    let of = |seed| {
        let Some(Case { robot, pose, load, rows, .. }) = case(seed) else { return Vec::new() };
        compare(&robot, &pose, &load, &rows)
    };
    let all: Vec<_> = (0..cases).into_par_iter().flat_map_iter(of).collect();
    let counts = counts(&all);
    let mut errors: Vec<f64> =
        all.iter().filter(|(what, _)| *what == "lanes").map(|(_, error)| *error).collect();
    errors.sort_by(f64::total_cmp);
    let quantile = |q: f64| errors[((errors.len() - 1) as f64 * q) as usize];
    println!("{counts:?}, differences {:.1e} {:.1e} {:.1e}", quantile(0.5), quantile(0.999), quantile(1.0));
    assert!(counts["lanes"] > cases as usize / 3);
    assert!(!counts.contains_key("DIFFERENT") && !counts.contains_key("lanes only"));
    assert!(!counts.contains_key(ScalarReason::OneByOne.name()));
}
