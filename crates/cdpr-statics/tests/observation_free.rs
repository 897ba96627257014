//! Observations of robots with fewer cables than free motions in lanes: those of the scalar models.

use crate::any_lanes::{Case, case};
use crate::common::{alone, caroca, cogiro, fast, observed};
use crate::free_derivatives::with_few_cables;
use crate::observer::{compared, rows_by_size};
use cdpr_cable::{PiecewiseLaw, Segment};
use cdpr_robot::{Coordinate, Parameter, Pose, Pulley, Robot, Rotation3, TensionLimits, Vector3, library};
use cdpr_statics::batch::{Observation, ObservationMotion, ScalarReason};
use cdpr_statics::error::RestFault;
use cdpr_statics::free_coordinates::free_solutions;
use cdpr_statics::{Load, Observer, StaticsError, WantedPose, deflection, inverse};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::BTreeMap;

use Coordinate::{Pitch, Roll, X, Y, Yaw};

/// A robot on some of its cables, with plain ones, at a pose with free coordinates.
struct Few {
    robot: Robot,
    pose: Pose,
    free: Vec<Coordinate>,
}

fn few(mut robot: Robot, cables: &[usize], pose: Pose, free: &[Coordinate]) -> Few {
    robot.cables = cables.iter().map(|i| robot.cables[*i].clone()).collect();
    robot.cables.iter_mut().for_each(|cable| (cable.pulley, cable.lead) = (None, 0.0));
    robot.name += &format!(" on {} cables with free {free:?}", cables.len());
    Few { robot, pose, free: free.to_vec() }
}

fn named(name: &str) -> Robot {
    Robot::from_json(library::named(library::ROBOTS, name).unwrap().text).unwrap()
}

/// Robots on two to five cables: of steel and of fibre, light and heavy ones that sag, one in a plane, also
/// with its platform turned out of that, and a point.
fn robots() -> Vec<Few> {
    let at_grab =
        Pose { rotation: Rotation3::from_euler_angles(0.0, 0.0, 0.136), ..Pose::at(1.28, -0.19, -0.92) };
    let [(planar, in_plane, pitch, _), ..] = with_few_cables();
    let mut point = planar.clone();
    (point.platform.point, point.plane) = (true, None);
    let out_of_plane = Pose { rotation: Rotation3::from_euler_angles(0.2, 0.1, -0.3), ..in_plane };
    vec![
        few(cogiro(), &[1, 3, 5, 7], Pose::at(1.0, -0.3, 2.0), &[Roll, Yaw]),
        few(named("grab"), &[0, 1, 2, 3], at_grab, &[Pitch, Roll]),
        few(fast(), &[0, 1, 3, 4], Pose::at(10.0, 5.0, 100.0), &[Roll, Pitch]),
        few(named("four-cables"), &[0, 2], Pose::at(0.0, 0.0, 1.0), &[X, Y, Pitch, Roll]),
        few(cogiro(), &[1, 2, 4, 5, 6], Pose::at(1.0, 0.5, 2.0), &[Pitch]),
        few(caroca(), &[1, 2, 3, 4, 5], Pose::at(0.2, 0.1, 1.0), &[Pitch]),
        few(fast(), &[0, 1, 2, 3, 5], Pose::at(10.0, 5.0, 100.0), &[Yaw]),
        few(fast(), &[0, 2, 4], Pose::at(10.0, 5.0, 100.0), &[Roll, Pitch, Yaw]),
        few(planar.clone(), &[0, 1], in_plane, &pitch),
        few(planar, &[0, 1], out_of_plane, &pitch),
        few(point, &[0, 1], in_plane, &[Y]),
    ]
}

/// The longest distance of the two ends of a cable [m].
fn longest(robot: &Robot, pose: &Pose) -> f64 {
    (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max)
}

/// Observes rows of deviations, a tenth of those of the other tests; returns how many the lanes left.
fn left(Few { robot, pose, free }: &Few) -> usize {
    let load = Load::payload(0.1 * robot.platform.mass);
    let rows = rows_by_size(robot, pose, 200, 0.1, 11);
    let observer = Observer::new(robot, WantedPose::at(pose).free(free), &load).unwrap();
    // Platforms on few cables are soft.
    let (left, failed) = compared(robot, &observer, &rows, 1e-12 * longest(robot, pose));
    println!("{}: {left} of 200 left to the scalar models, {failed} failed there", robot.name);
    let alone =
        rows.chunks(Parameter::of(robot).len()).flat_map(|row| observed::<Observation>(&observer, row));
    assert!(
        alone.eq(observed::<Observation>(&observer, &rows)),
        "{}: a row depends on those beside it",
        robot.name
    );
    left
}

#[test]
fn plain_cables_on_a_level_base_and_a_tilted_one_stay_in_the_lanes() {
    for mut few in robots() {
        assert!(left(&few) <= 1, "{}", few.robot.name);
        if few.robot.plane.is_some() {
            continue;
        }
        let gravity = few.robot.gravity.vector() + Vector3::new(0.1, -0.05, 0.0);
        few.robot.gravity = gravity.into();
        assert!(left(&few) <= 1, "{}, tilted", few.robot.name);
    }
}

#[test]
fn vertical_pulleys_leads_and_laws_stay_in_the_lanes() {
    for Few { robot, pose, free } in robots() {
        let longest = longest(&robot, &pose);
        let up = -robot.gravity.vector().normalize();
        let mut guided = robot.clone();
        for (i, cable) in guided.cables.iter_mut().enumerate() {
            let axis = if i % 3 == 0 { -up } else { up };
            cable.pulley = (i % 4 != 1).then_some(Pulley { radius: 0.005 * longest, axis });
            cable.lead = 0.1 * longest;
        }
        let weight = robot.platform.mass * 9.81;
        let segments = [(0.0, 0.8), (0.1 * weight, 1.2)].map(|(tension, ratio)| Segment { tension, ratio });
        let mut lawful = robot.clone();
        for cable in &mut lawful.cables {
            cable.properties.law = PiecewiseLaw::new(0.0, &segments).ok();
        }
        for robot in [guided, lawful] {
            let few = Few { robot, pose, free: free.clone() };
            assert!(left(&few) <= 1, "{}", few.robot.name);
        }
    }
}

#[test]
fn an_answer_has_the_free_coordinates_of_a_search_from_the_nominal_robots() {
    for Few { robot, pose, free } in robots() {
        let load = Load::payload(0.1 * robot.platform.mass);
        let rows = rows_by_size(&robot, &pose, 20, 0.1, 12);
        let observer = Observer::new(&robot, WantedPose::at(&pose).free(&free), &load).unwrap();
        let wanted =
            inverse(&robot, WantedPose::at(&pose).free(&free), &Load::none()).unwrap().equilibrium.pose;
        assert_eq!(observer.pose(), &wanted);
        let longest = longest(&robot, &pose);
        let motions = observed::<ObservationMotion>(&observer, &rows);
        for ((row, found), moved) in rows
            .chunks(Parameter::of(&robot).len())
            .zip(observed::<Observation>(&observer, &rows))
            .zip(motions)
        {
            let (found, moved) = (found.unwrap(), moved.unwrap());
            let perturbed = robot.perturbed(row).unwrap();
            let (robot, offsets) = (&perturbed.robot, &perturbed.tension_offsets);
            let alone =
                deflection(robot, WantedPose::at(&wanted).free(&free).tension_offsets(offsets), &load)
                    .unwrap();
            let error = (found.displacement - alone.displacement()).norm();
            assert!(error < 1e-11 * longest, "{}: {error:e} m", robot.name);
            assert_eq!(moved.observation, found);
            let turned: Vector3<f64> = alone.motion().fixed_rows::<3>(3).into();
            let error = (moved.rotation - turned).norm();
            assert!(error < 1e-10, "{}: {error:e} rad of {:e} rad", robot.name, turned.norm());
        }
        // No answer depends on the others of its batch.
        let width = Parameter::of(&robot).len();
        let together = observed::<Observation>(&observer, &rows);
        let apart = rows.chunks(3 * width).flat_map(|rows| observed::<Observation>(&observer, rows));
        assert!(apart.eq(together), "{}", robot.name);
    }
}

#[test]
fn what_lanes_do_not_know_is_left_with_its_reason() {
    let Few { robot, pose, free } = few(cogiro(), &[1, 3, 5, 7], Pose::at(1.0, -0.3, 2.0), &[Roll, Yaw]);
    let load = Load::payload(9.0);
    let width = Parameter::of(&robot).len();
    let why = |robot: &Robot, free: &[Coordinate], row: &[f64]| {
        let found = observed::<Observation>(
            &Observer::new(robot, WantedPose::at(&pose).free(free), &load).unwrap(),
            row,
        );
        found[0].as_ref().unwrap().scalar
    };
    assert_eq!(why(&robot, &free, &vec![0.0; width]), None);
    // A centre of mass with which the platform turns by more than a solution beside the nominal one may.
    let centre = Parameter::of(&robot).iter().position(|one| matches!(one, Parameter::CenterOfMass(_)));
    let wanted = inverse(&robot, WantedPose::at(&pose).free(&free), &Load::none()).unwrap().equilibrium.pose;
    let shifted = |k: i32| {
        let mut row = vec![0.0; width];
        row[centre.unwrap()] = 0.02 * f64::from(k);
        row
    };
    let turns = |row: &Vec<f64>| {
        let found =
            inverse(&robot.perturbed(row).unwrap().robot, WantedPose::at(&wanted).free(&free), &Load::none());
        found.is_ok_and(|found| wanted.rotation.angle_to(&found.equilibrium.pose.rotation) > 0.0301)
    };
    let row = (1..20).map(shifted).find(turns).unwrap();
    assert_eq!(why(&robot, &free, &row), Some(ScalarReason::FreeCoordinates));
    // Limits within which four cables do not carry the platform: every rest is beyond them.
    let mut limited = robot.clone();
    limited.tension_limits.max = 0.2 * robot.platform.mass * robot.gravity.magnitude();
    let error = Observer::new(&limited, WantedPose::at(&pose).free(&free), &load).unwrap_err();
    assert_eq!(error.kind(), "infeasible_tension");
    // The ground, where it is so near that lanes cannot tell, and where the base may be tilted.
    let lowest = robot.cables.iter().map(|cable| (wanted.position + wanted.rotation * cable.anchor_point).z);
    let lowest = lowest.fold(f64::INFINITY, f64::min);
    let mut grounded = Robot { ground_z: Some(lowest - 0.01), ..robot.clone() };
    assert_eq!(why(&grounded, &free, &vec![0.0; width]), None);
    let up = Parameter::of(&robot).iter().position(|one| matches!(one, Parameter::AnchorPoint(..)));
    let mut row = vec![0.0; width];
    row[up.unwrap() + 2] = -0.2;
    let found = observed::<Observation>(
        &Observer::new(&grounded, WantedPose::at(&pose).free(&free), &load).unwrap(),
        &row,
    );
    assert!(found[0].is_err() || found[0].as_ref().unwrap().scalar == Some(ScalarReason::FreeCoordinates));
    grounded.gravity = Vector3::new(0.0, 0.0, -9.81).into();
    let row = vec![0.0; Parameter::of(&grounded).len()];
    assert_eq!(why(&grounded, &free, &row), Some(ScalarReason::FreeCoordinates));
    // A plane is one of the base frame, which gravity as a vector may tilt.
    let [(mut planar, at, free, payload), ..] = with_few_cables();
    planar.gravity = Vector3::new(0.0, 0.0, -9.81).into();
    let observer = Observer::new(&planar, WantedPose::at(&at).free(&free), &Load::payload(payload)).unwrap();
    let found = observed::<Observation>(&observer, &vec![0.0; Parameter::of(&planar).len()]);
    assert_eq!(found[0].as_ref().unwrap().scalar, Some(ScalarReason::FewCables));
    // Names are checked.
    let error = Observer::new(&robot, WantedPose::at(&pose).free(&[Yaw]), &load).unwrap_err();
    assert_eq!(error.kind(), "free_coordinates");
}

#[test]
fn a_rest_that_leaves_its_limits_is_refused_without_a_search_for_others() {
    let (robot, free) = (named("four-cables"), [Roll, Pitch]);
    let load = Load::payload(6.0);
    let observer =
        Observer::new(&robot, WantedPose::at(&Pose::at(0.5, 0.3, 2.0)).free(&free), &load).unwrap();
    let rest = *observer.pose();
    let points: Vec<usize> = (0..Parameter::of(&robot).len())
        .filter(|i| matches!(Parameter::of(&robot)[*i], Parameter::AnchorPoint(..)))
        .collect();
    let rng = &mut ChaCha8Rng::seed_from_u64(5);
    let (mut refused, mut searched) = (BTreeMap::<&str, usize>::new(), 0);
    for _ in 0..60 {
        let mut row = vec![0.0; Parameter::of(&robot).len()];
        points.iter().for_each(|i| row[*i] = rng.random_range(-2e-3..2e-3));
        let fault = match alone::<Observation>(&observer, &row) {
            Ok(_) => continue,
            Err(StaticsError::NoRest { starts: 1, nearest: RestFault::Limit(_) }) => "limit",
            Err(StaticsError::NoRest { starts: 1, nearest: RestFault::Pushing { .. } }) => "pushing",
            Err(StaticsError::NoRest { starts: 1, nearest: RestFault::Residual { .. } }) => "lost",
            Err(StaticsError::Unstable { .. }) => "unstable",
            Err(_) => {
                searched += 1;
                continue;
            }
        };
        *refused.entry(fault).or_default() += 1;
        // A search from many starts finds no other next to it.
        let perturbed = robot.perturbed(&row).unwrap().robot;
        if let Ok(found) = free_solutions(&perturbed, WantedPose::at(&rest).free(&free), &Load::none()) {
            let away = rest.rotation.angle_to(&found.first.equilibrium.pose.rotation);
            assert!(away > 0.3 || !found.first.stability.is_stable(), "{fault}: {row:?}");
        }
    }
    println!("{refused:?}, {searched} searched");
    assert!(refused["pushing"] > 20, "{refused:?}");
    assert!(searched <= 3, "{searched} were searched for: {refused:?}");
}

/// Random robots; `CDPR_CASES` takes the place of this number.
const CASES: u64 = 300;

/// What became of each row of a random robot on two to five cables.
fn outcomes(seed: u64) -> Vec<(String, f64)> {
    let Some(Case { mut robot, pose, load, .. }) = case(seed) else { return Vec::new() };
    let rng = &mut ChaCha8Rng::seed_from_u64(seed ^ 0xfee);
    let motions = robot.freedoms().count();
    if motions < 3 {
        return Vec::new();
    }
    robot.cables.truncate(rng.random_range(2..motions));
    let mut free = Coordinate::ALL.to_vec();
    free.retain(|coordinate| robot.freedoms().contains(coordinate.component()));
    while free.len() > motions - robot.cables.len() {
        free.remove(rng.random_range(0..free.len()));
    }
    // Angles rather than positions.
    let level = [Roll, Pitch, Yaw, X, Y];
    if rng.random_bool(0.7) && motions == 6 {
        free = level[..6 - robot.cables.len()].to_vec();
    }
    let weight = robot.platform.mass * robot.gravity.magnitude();
    robot.tension_limits = TensionLimits { min: 1e-4 * weight, max: 1e2 * weight };
    robot.cables.iter_mut().for_each(|cable| cable.tension_limits = Default::default());
    let observer = match Observer::new(&robot, WantedPose::at(&pose).free(&free), &load) {
        Ok(observer) => observer,
        Err(error) => return vec![(format!("nominal: {}", error.kind()), 0.0)],
    };
    let longest = longest(&robot, &pose);
    let rows = rows_by_size(&robot, &pose, 8, 0.1, seed);
    let outcome = |(row, found): (&[f64], &Result<Observation, _>)| match found {
        Err(error) => (format!("failed: {}", StaticsError::kind(error)), 0.0),
        Ok(found) => match (found.scalar, alone::<Observation>(&observer, row)) {
            (Some(why), _) => (format!("scalar: {}", why.name()), 0.0),
            (None, Err(error)) => (format!("LANES ONLY: {}", error.kind()), 0.0),
            (None, Ok(alone)) => {
                let error = (found.displacement - alone.displacement).norm() / longest;
                if error > 1e-11 {
                    println!("robot {seed}: {error:.1e} of the longest cable");
                }
                (if error > 1e-11 { "DIFFERENT" } else { "lanes" }.to_owned(), error)
            }
        },
    };
    let found = observed::<Observation>(&observer, &rows);
    rows.chunks(Parameter::of(&robot).len()).zip(&found).map(outcome).collect()
}

#[test]
fn lanes_answer_as_the_scalar_models_do_for_any_robot_with_few_cables() {
    let cases = std::env::var("CDPR_CASES").map_or(CASES, |cases| cases.parse().unwrap());
    let all: Vec<_> = (0..cases).into_par_iter().flat_map_iter(outcomes).collect();
    let mut counts = BTreeMap::<&str, u64>::new();
    for (outcome, _) in &all {
        *counts.entry(outcome).or_default() += 1;
    }
    let worst = all.iter().filter(|(what, _)| what == "lanes").map(|(_, error)| *error).fold(0.0, f64::max);
    println!("{cases} random robots on two to five cables: {counts:#?}, differences up to {worst:.1e}");
    let of = |outcome: &str| counts.get(outcome).copied().unwrap_or_default();
    assert!(of("lanes") > cases / 10, "{counts:?}");
    assert!(!counts.keys().any(|what| *what == "DIFFERENT" || what.starts_with("LANES ONLY")), "{counts:?}");
}
