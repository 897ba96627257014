//! Derivatives of observations in lanes: those of the scalar models.

use crate::any_lanes::{Case, case};
use crate::common::{alone, caroca, observed, points_and_planar, robots};
use cdpr_cable::{PiecewiseLaw, Segment};
use cdpr_robot::{CableEnd, Parameter, Pose, Pulley, Robot, Vector3, library};
use cdpr_statics::batch::{Observation, ObservationSlopes, ScalarReason};
use cdpr_statics::{Load, Observer, StaticsError};
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
    let (name, all) = (&robot.name, Parameter::of(robot));
    let parameters = all.len();
    let longest = (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max);
    let observer = Observer::new(robot, pose, load).unwrap();
    let range = |k: usize| match all[k] {
        // Axes that deviate from the vertical are left to the scalar models: such rows have none.
        Parameter::Tilt(..) => 0.01,
        Parameter::Gravity(_) => 0.05,
        _ => rows.chunks(parameters).map(|row| row[k].abs()).fold(0.0, f64::max),
    };
    let ranges: Vec<f64> = (0..parameters).map(range).collect();
    let found = observed::<ObservationSlopes>(&observer, rows);
    let observed = observed::<Observation>(&observer, rows);
    assert_eq!(found.len(), observed.len());
    let outcome = |((row, observed), found): ((&[f64], _), &Result<_, _>)| {
        let (observed, found): (&Result<_, _>, &cdpr_statics::batch::ObservationSlopes) = match found {
            Ok(found) => (observed, found),
            Err(error) => return (cdpr_statics::StaticsError::kind(error), 0.0),
        };
        if let Some(why) = found.observation.scalar {
            return (why.name(), 0.0);
        }
        assert_eq!(Some(&found.observation), observed.as_ref().ok(), "{name}");
        let Ok(alone) = alone::<ObservationSlopes>(&observer, row) else { return ("lanes only", 0.0) };
        let distance = (alone.observation.displacement - found.observation.displacement).norm();
        if distance > AGREEMENT * longest {
            return ("another minimum", 0.0);
        }
        let scaled =
            |slopes: &[f64]| -> Vec<f64> { slopes.iter().zip(&ranges).map(|(s, r)| s * r).collect() };
        let (found, alone) = (scaled(&found.magnitude), scaled(&alone.magnitude));
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

/// Rows of deviations, in proportion to the size and the weight of a robot.
fn rows(robot: &Robot, count: usize) -> Vec<f64> {
    let parameters = Parameter::of(robot);
    let pulleys = robot.cables.iter().any(|cable| cable.pulley.is_some());
    let half = |parameter: &Parameter| match parameter {
        Parameter::Mass => 0.05 * robot.platform.mass,
        Parameter::LinearDensity => 0.1 * robot.cables[0].properties.linear_density,
        Parameter::YoungsModulus => 0.2 * robot.cables[0].properties.youngs_modulus,
        Parameter::TensionOffset(_) => 0.04 * robot.platform.mass,
        Parameter::Gravity(_) if pulleys => 0.0,
        Parameter::Gravity(_) => 0.05,
        Parameter::Tilt(..) => 0.0,
        Parameter::PulleyRadius(i) => 0.1 * robot.cables[*i].pulley.unwrap().radius,
        Parameter::Lead(i) => 0.1 * robot.cables[*i].lead,
        _ => 0.01 * robot.platform_size(),
    };
    let entry = |i: usize| half(&parameters[i % parameters.len()]) * ((i * 37 % 101) as f64 / 50.0 - 1.0);
    (0..count * parameters.len()).map(entry).collect()
}

/// The robots on a level and on a tilted base.
fn on_both_bases(robots: impl IntoIterator<Item = (Robot, Pose)>) -> impl Iterator<Item = (Robot, Pose)> {
    robots.into_iter().flat_map(|(robot, pose)| {
        let gravity = Vector3::new(0.3, -0.2, -9.8).into();
        let name = format!("{} on a tilted base", robot.name);
        [(robot.clone(), pose), (Robot { gravity, name, ..robot }, pose)]
    })
}

/// Compares 64 rows, and expects lanes to have found most of them, with slopes times ranges within `share` of
/// the largest.
fn expect_lanes(robot: &Robot, pose: &Pose, share: f64) {
    let all = compare(robot, pose, &Load::payload(0.1 * robot.platform.mass), &rows(robot, 64));
    let worst = all.iter().map(|(_, error)| *error).fold(0.0, f64::max);
    println!("{}: {:?}, differences up to {worst:.1e}", robot.name, counts(&all));
    assert!(counts(&all).get("lanes").is_some_and(|lanes| *lanes > 56) && worst < share, "{}", robot.name);
}

#[test]
fn slopes_in_lanes_are_those_of_the_scalar_models() {
    for (robot, pose) in on_both_bases(robots()) {
        expect_lanes(&robot, &pose, 1e-9);
    }
}

#[test]
fn slopes_of_points_and_planar_platforms_are_those_of_the_scalar_models() {
    for (robot, pose) in on_both_bases(points_and_planar()) {
        if robot.plane.is_none() || !robot.gravity.is_vector() {
            expect_lanes(&robot, &pose, 1e-9);
        }
    }
}

#[test]
fn where_free_cables_do_not_act_on_all_motions_there_are_no_slopes() {
    // On its axis four cables of IPAnema 1 carry the platform, and four are at their least tension.
    let robot = Robot::from_json(library::named(library::ROBOTS, "ipanema-1").unwrap().text).unwrap();
    let none = vec![0.0; Parameter::of(&robot).len()];
    for height in [0.5, 1.0, 1.5] {
        let observer = Observer::new(&robot, Pose::at(0.0, 0.0, height), &Load::payload(2.5)).unwrap();
        let found = observed::<ObservationSlopes>(&observer, &none).remove(0);
        assert!(matches!(found, Err(StaticsError::NoDerivative { .. })), "{found:?}");
        // What is not differentiated is observed as ever.
        assert!(observed::<Observation>(&observer, &none).remove(0).is_ok());
    }
}

/// All cables over pulleys that they enter from below; some over pulleys that they enter from either side,
/// some behind leads, with an elastic law; all behind leads.
fn guided(mut robot: Robot, pose: &Pose, case: usize) -> Robot {
    let up = -robot.gravity.vector();
    let own = robot.cables[0].pulley.map(|pulley| pulley.radius);
    let longest = (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max);
    let radius = own.unwrap_or(0.006 * longest);
    let kink = 0.3 * robot.platform.mass * 9.81;
    let segments = [(0.0, 0.7), (kink, 1.1), (2.0 * kink, 1.3)];
    let law = PiecewiseLaw::new(0.0, &segments.map(|(tension, ratio)| Segment { tension, ratio })).unwrap();
    for (i, cable) in robot.cables.iter_mut().enumerate() {
        let axis = if i % 3 == 0 { -up } else { up };
        let some = (i % 4 != 1).then_some(Pulley { radius: radius * (1.0 + 0.1 * i as f64), axis });
        cable.pulley = [Some(Pulley { radius, axis: up }), some, None][case];
        cable.lead = [0.0, if i % 2 == 0 { 0.1 * longest } else { 0.0 }, 0.2 * longest][case];
        if case == 1 {
            cable.properties.law = Some(law.clone());
        }
    }
    robot.name += [" over pulleys", " over some pulleys, with a law", " behind leads"][case];
    robot
}

#[test]
fn slopes_in_lanes_are_those_of_the_scalar_models_over_pulleys_and_behind_leads() {
    let named = |name| Robot::from_json(library::named(library::ROBOTS, name).unwrap().text).unwrap();
    let with_their_own =
        [(named("hrpcables"), Pose::at(0.3, 0.2, 1.5)), (named("ipanema-2"), Pose::at(0.3, 0.2, 1.5))];
    for (robot, pose) in on_both_bases(robots().into_iter().chain(with_their_own)) {
        for case in 0..3 {
            expect_lanes(&guided(robot.clone(), &pose, case), &pose, 1e-7);
        }
    }
}

#[test]
fn slopes_over_pulleys_and_behind_leads_are_differences_of_observations() {
    let pose = Pose::at(0.4, -0.3, 1.6);
    let load = Load::payload(50.0);
    for (robot, case) in
        on_both_bases([(caroca(), pose)]).flat_map(|(robot, _)| [0, 1, 2].map(|case| (robot.clone(), case)))
    {
        let mut robot = guided(robot, &pose, case);
        // Changes across a kink of a law are not smooth.
        robot.cables.iter_mut().for_each(|cable| cable.properties.law = None);
        let parameters = Parameter::of(&robot);
        let observer = Observer::new(&robot, pose, &load).unwrap();
        let found = observed::<ObservationSlopes>(&observer, &vec![0.0; parameters.len()]).remove(0).unwrap();
        assert_eq!(found.observation.scalar, None);
        let largest = rows(&robot, 101);
        let steps: Vec<f64> = (0..parameters.len())
            .map(|k| match parameters[k] {
                Parameter::Tilt(..) => 1e-3,
                Parameter::Gravity(_) => 0.02,
                _ => 0.05 * largest.chunks(parameters.len()).map(|row| row[k]).fold(0.0, f64::max),
            })
            .collect();
        let length = |k: usize, times: f64| {
            let mut row = vec![0.0; parameters.len()];
            row[k] = times * steps[k];
            observed::<Observation>(&observer, &row)[0].as_ref().unwrap().magnitude()
        };
        // The change of |dp| over one step, to fourth order.
        let change = |k: usize| {
            let by = |times: f64| length(k, times) - length(k, -times);
            (8.0 * by(1.0) - by(2.0)) / 12.0
        };
        let changes: Vec<f64> = (0..parameters.len()).map(change).collect();
        let scale = changes.iter().fold(0.0, |scale: f64, change| scale.max(change.abs()));
        for (k, change) in changes.iter().enumerate() {
            let error = (found.magnitude[k] * steps[k] - change).abs() / scale;
            assert!(error < 1e-6, "{} {}: {error:.1e}", robot.name, parameters[k]);
        }
        // Those of guides are not lost among the others.
        let of_guides = |parameter: &Parameter| {
            matches!(parameter, Parameter::Lead(_) | Parameter::PulleyRadius(_) | Parameter::Tilt(..))
        };
        for (k, parameter) in parameters.iter().enumerate().filter(|(_, parameter)| of_guides(parameter)) {
            assert!(changes[k].abs() > 1e-6 * scale, "{} {parameter}", robot.name);
        }
    }
}

#[test]
fn a_greatest_tension_at_the_exit_point_has_slopes_in_lanes_but_for_pulleys() {
    for pulleys in [false, true] {
        let (mut robot, pose) = (caroca(), Pose::at(0.5, 0.2, 1.75));
        for cable in &mut robot.cables {
            let pulley = Pulley { radius: 0.1, axis: Vector3::z() };
            (cable.pulley, cable.lead) = (pulleys.then_some(pulley), 1.0);
        }
        let free = cdpr_statics::inverse(&robot, &pose, &Load::none()).unwrap();
        let tightest =
            (0..free.tensions.len()).max_by(|a, b| free.tensions[*a].total_cmp(&free.tensions[*b])).unwrap();
        let own = &mut robot.cables[tightest].tension_limits;
        (own.max_at, own.max) = (Some(CableEnd::Exit), Some(free.tensions[tightest] + 4.0));
        let load = Load::payload(50.0);
        let all = compare(&robot, &pose, &load, &rows(&robot, 64));
        println!("{:?}", counts(&all));
        let [lanes, refused] = ["lanes", "no_derivative"].map(|kind| *counts(&all).get(kind).unwrap_or(&0));
        assert_eq!(lanes + refused, 64);
        // Half of the rows are at the limit.
        assert!(if pulleys { refused > 10 && lanes > 10 } else { refused == 0 });
    }
}

#[test]
fn slopes_in_lanes_are_those_of_the_scalar_models_for_any_robot() {
    let cases = std::env::var("CDPR_CASES").map_or(CASES, |cases| cases.parse().unwrap());
    let of = |seed| {
        let Some(Case { robot, pose, load, rows, .. }) = case(seed) else { return Vec::new() };
        let guided = (0..robot.cables.len()).any(|i| robot.cable(i).guide.is_some());
        compare(&robot, &pose, &load, &rows).into_iter().map(|found| (guided, found)).collect()
    };
    let all: Vec<_> = (0..cases).into_par_iter().flat_map_iter(of).collect();
    for (guided, kind, least) in [(false, "plain cables", cases / 4), (true, "pulleys and leads", cases / 12)]
    {
        let these: Vec<_> = all.iter().filter(|(of, _)| *of == guided).map(|(_, found)| *found).collect();
        let counts = counts(&these);
        let mut errors: Vec<f64> =
            these.iter().filter(|(what, _)| *what == "lanes").map(|(_, error)| *error).collect();
        errors.sort_by(f64::total_cmp);
        let quantile = |q: f64| errors[((errors.len() - 1) as f64 * q) as usize];
        let [median, most, worst] = [0.5, 0.999, 1.0].map(quantile);
        println!("{kind}: {counts:?}, differences {median:.1e} {most:.1e} {worst:.1e}");
        assert!(counts["lanes"] > least as usize, "{kind}");
        assert!(!counts.contains_key("DIFFERENT") && !counts.contains_key("lanes only"));
        assert!(!counts.contains_key(ScalarReason::OneByOne.name()));
    }
}
