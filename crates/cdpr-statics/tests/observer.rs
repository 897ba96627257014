//! Observer robots in lanes: the answers of the scalar models, whoever else is in the batch.

use crate::common::{alone, caroca, cogiro, ipanema, observed, points_and_planar, robots};
use cdpr_robot::{CableEnd, Parameter, Pose, Pulley, Robot, RobotError, TensionReference, Vector3, library};
use cdpr_statics::batch::{Observation, ObservationSlopes, ScalarReason};
use cdpr_statics::{Load, Observer, Residual, StaticsError};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;

/// Rows of the ranges of Table 3 of the paper, `times` as wide.
fn rows(robot: &Robot, count: usize, times: f64, seed: u64) -> Vec<f64> {
    let n = robot.cables.len();
    let modulus = 0.2 * robot.cables[0].properties.youngs_modulus;
    let density = 0.1 * robot.cables[0].properties.linear_density;
    let half: Vec<f64> = [0.05 * robot.platform.mass, density, modulus]
        .into_iter()
        .chain([0.015].repeat(3 * n))
        .chain([0.03].repeat(3 * n))
        .chain([0.015].repeat(3))
        .chain([15.0].repeat(n))
        .chain(Parameter::of(robot)[6 + 7 * n..].iter().map(|parameter| match parameter {
            Parameter::PulleyRadius(_) => 0.0005,
            Parameter::Lead(_) => 0.05,
            _ => 0.0,
        }))
        .collect();
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let mut row = || half.iter().map(|half| times * half * rng.random_range(-1.0..1.0)).collect::<Vec<_>>();
    (0..count).flat_map(|_| row()).collect()
}

/// How many rows the lanes left to the scalar models, and how many failed.
fn compare(robot: &Robot, pose: &Pose, load: &Load, rows: &[f64]) -> (usize, usize) {
    let observer = Observer::new(robot, pose, load).unwrap();
    compared(robot, &observer, rows, 1e-12 * scale(robot, pose))
}

/// The longest cable over 20 m, or 1: rounding of larger robots is larger.
fn scale(robot: &Robot, pose: &Pose) -> f64 {
    let longest = (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max);
    (longest / 20.0).max(1.0)
}

/// The same of any observer, whose displacements may differ by `allowed` [m].
pub(crate) fn compared(robot: &Robot, observer: &Observer, rows: &[f64], allowed: f64) -> (usize, usize) {
    let together = observed::<Observation>(observer, rows);
    let scale = scale(robot, observer.pose());
    // Rounding of heavier robots is larger, too.
    let heavy = (robot.platform.mass / 400.0).max(1.0);
    let (mut left, mut failed) = (0, 0);
    for (row, found) in rows.chunks(Parameter::of(robot).len()).zip(&together) {
        match (found, alone::<Observation>(observer, row)) {
            (Ok(found), Ok(alone)) => {
                let error = (found.displacement - alone.displacement).norm();
                assert!(error < allowed, "{error:e} m of {:e} m", alone.displacement.norm());
                for residual in [found.unloaded, found.loaded] {
                    let Residual { closure, force, moment } = residual;
                    assert!(closure < 3e-12 * scale, "{residual:?}");
                    assert!(force.max(moment / scale) < 1e-8 * heavy, "{residual:?}");
                }
                left += usize::from(found.scalar.is_some());
            }
            (Err(found), Err(alone)) => {
                assert_eq!(found.kind(), alone.kind());
                failed += 1;
            }
            outcomes => panic!("{outcomes:?}"),
        }
    }
    (left, failed)
}

#[test]
fn the_papers_observations_are_those_of_the_scalar_models() {
    let robot = caroca();
    let rows = rows(&robot, 2000, 1.0, 1);
    let load = Load::payload(50.0);
    assert_eq!(compare(&robot, &Pose::at(0.0, 0.0, 1.75), &load, &rows), (0, 0));
    let (left, failed) = compare(&robot, &Pose::at(3.2, 1.7, 3.0), &load, &rows);
    println!("non-symmetric pose: {left} of 2000 left to the scalar models, {failed} failed there");
    assert!(left < 60 && failed < 5);
}

#[test]
fn lanes_prefer_the_same_tensions_and_keep_the_same_limits() {
    let robots = [
        (caroca(), Pose::at(0.5, 0.2, 1.75), 700.0),
        (cogiro(), Pose::at(0.5, 1.0, 2.0), 1200.0),
        (ipanema(), Pose::at(0.3, 0.2, 1.5), 600.0),
    ];
    for (mut robot, pose, reference) in robots {
        let load = Load::payload(0.2 * robot.platform.mass);
        let rows = rows(&robot, 300, 0.5, 3);
        let least_norm = observed::<Observation>(&Observer::new(&robot, pose, &load).unwrap(), &rows);
        for preferred in [TensionReference::All(reference), TensionReference::MID] {
            robot.tension_reference = Some(preferred);
            assert_eq!(compare(&robot, &pose, &load, &rows), (0, 0), "{}", robot.name);
        }
        let observed = observed::<Observation>(&Observer::new(&robot, pose, &load).unwrap(), &rows);
        let differ = observed.iter().zip(&least_norm).filter(|(a, b)| {
            (a.as_ref().unwrap().magnitude() - b.as_ref().unwrap().magnitude()).abs()
                > 1e-4 * b.as_ref().unwrap().magnitude()
        });
        assert_eq!(differ.count(), 300, "{}", robot.name);
        // Limits that some of the perturbed robots reach by their offsets, and some do not.
        robot.tension_reference = Some(TensionReference::All(reference));
        let free = cdpr_statics::inverse(&robot, &pose, &Load::none()).unwrap();
        let tightest =
            (0..free.tensions.len()).max_by(|a, b| free.tensions[*a].total_cmp(&free.tensions[*b])).unwrap();
        for end in [CableEnd::Anchor, CableEnd::Exit] {
            let own = &mut robot.cables[tightest].tension_limits;
            (own.max_at, own.max) = (Some(end), Some(free.tensions[tightest] + 4.0));
            let (left, failed) = compare(&robot, &pose, &load, &rows);
            println!("{}: {left} of 300 left to the scalar models, {failed} failed there", robot.name);
            assert!(left < 15 && failed == 0, "{}: {left}, {failed}", robot.name);
        }
    }
}

#[test]
fn other_robots_poses_loads_and_ranges_agree_too() {
    let rng = &mut ChaCha8Rng::seed_from_u64(2);
    let mut outcomes: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for (name, robot, height) in [("CAROCA", caroca(), 1.75), ("CoGiRo", cogiro(), 2.5)] {
        for case in 0..30 {
            let at = Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0));
            let pose = Pose::at(2.5 * at.x, 1.2 * at.y, height + at.z)
                .moved(Vector3::zeros(), Vector3::from_fn(|_, _| rng.random_range(-0.2..0.2)));
            let mut load = Load::payload(rng.random_range(0.0..50.0));
            load.wrench.force = Vector3::from_fn(|_, _| rng.random_range(-50.0..50.0));
            if case % 5 == 0 {
                load.wrench.moment = Vector3::from_fn(|_, _| rng.random_range(-5.0..5.0));
            }
            let times = if case % 3 == 0 { 5.0 } else { 1.0 };
            let (left, failed) = compare(&robot, &pose, &load, &rows(&robot, 40, times, case));
            let sum = outcomes.entry(name).or_default();
            *sum = (sum.0 + left, sum.1 + failed);
        }
    }
    println!("of 1200 each, (left to the scalar models, failed): {outcomes:?}");
}

#[test]
fn cables_at_their_limits_and_cables_that_sag_stay_in_the_lanes() {
    // Robots that are held from all sides have cables at a limit at every pose, and those of the telescope
    // and of a stadium sag. Deviations are shares of the robot's size.
    let named = |name| Robot::from_json(library::named(library::ROBOTS, name).unwrap().text).unwrap();
    let more = [
        (named("segesta"), Pose::at(0.05, 0.02, 0.5)),
        (named("cable-robot-simulator"), Pose::at(0.5, 0.3, 0.2)),
    ];
    for (mut robot, pose) in robots().into_iter().chain(more) {
        robot.cables.iter_mut().for_each(|cable| (cable.pulley, cable.lead) = (None, 0.0));
        let rows = rows_by_size(&robot, &pose, 200, 1.0, 11);
        let load = Load::payload(0.1 * robot.platform.mass);
        let (left, failed) = compare(&robot, &pose, &load, &rows);
        println!("{}: {left} of 200 left to the scalar models, {failed} failed there", robot.name);
        assert!(left <= 2, "{}: {left}, {failed}", robot.name);
    }
}

/// Rows for a robot of any size, `times` as wide.
pub(crate) fn rows_by_size(robot: &Robot, pose: &Pose, count: usize, times: f64, seed: u64) -> Vec<f64> {
    let longest = (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max);
    let size = (longest / 20.0).min(robot.platform_size());
    let mut rows = rows(robot, count, times, seed);
    let parameters = Parameter::of(robot);
    for (k, value) in rows.iter_mut().enumerate() {
        *value *= match parameters[k % parameters.len()] {
            Parameter::Mass | Parameter::LinearDensity | Parameter::YoungsModulus => 0.5,
            Parameter::TensionOffset(_) => robot.platform.mass / 400.0,
            Parameter::PulleyRadius(_) => longest / 10.0,
            Parameter::Lead(_) => longest / 10.0,
            _ => 0.2 * size,
        };
    }
    rows
}

#[test]
fn robots_of_the_library_stay_in_the_lanes_wherever_they_stand() {
    let mut robots = 0;
    for file in library::ROBOTS {
        let robot = Robot::from_json(file.text).unwrap();
        let rng = &mut ChaCha8Rng::seed_from_u64(7);
        let exits = || robot.cables.iter().map(|cable| cable.exit_point);
        let [low, high] =
            [exits().reduce(|a, b| a.inf(&b)), exits().reduce(|a, b| a.sup(&b))].map(Option::unwrap);
        // Below exit points at one height.
        let suspended = high.z - low.z < 0.3 * (high.x - low.x);
        let mut position = || {
            let at = Vector3::from_fn(|_, _| rng.random_range(0.1..0.9));
            let mut position = low + at.component_mul(&(high - low));
            if suspended {
                position.z = low.z - at.z * (high.x - low.x);
            }
            position
        };
        let poses: Vec<Pose> = (0..200)
            .map(|_| Pose { position: position(), ..Pose::at(0.0, 0.0, 0.0) })
            .filter(|pose| cdpr_statics::inverse(&robot, pose, &Load::none()).is_ok())
            .take(20)
            .collect();
        let (mut left, mut failed, mut reasons) = (0, 0, BTreeMap::<&str, usize>::new());
        for pose in &poses {
            let longest = (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max);
            let rows = rows_by_size(&robot, pose, 20, 1.0, 19);
            let load = Load::payload(0.3 * robot.platform.mass);
            let observer = Observer::new(&robot, pose, &load).unwrap();
            let (more, fewer) = compared(&robot, &observer, &rows, 1e-12 * longest);
            (left, failed) = (left + more, failed + fewer);
            for why in observed::<Observation>(&observer, &rows)
                .into_iter()
                .flatten()
                .filter_map(|found| found.scalar)
            {
                *reasons.entry(why.name()).or_default() += 1;
            }
        }
        let all = 20 * poses.len();
        println!("{}: {left} of {all} left to the scalar models ({reasons:?}), {failed} failed", file.name);
        // The load turns COPacabana's robots so far that many of their branches are followed in steps.
        let share = if file.name.starts_with("copacabana") { 4 } else { 30 };
        assert!(share * left <= all, "{}: {left} of {all}", file.name);
        robots += usize::from(poses.len() >= 15);
    }
    assert!(robots >= 14, "{robots}");
}

#[test]
fn points_and_planar_platforms_stay_in_the_lanes() {
    for (robot, pose) in points_and_planar() {
        let rows = rows_by_size(&robot, &pose, 200, 1.0, 13);
        let mut load = Load::payload(0.1 * robot.platform.mass);
        let weight = robot.platform.mass * 9.81;
        load.wrench.force = Vector3::new(0.02, 0.03, -0.01) * weight;
        load.wrench.moment = Vector3::new(0.01, -0.02, 0.01) * (weight * robot.platform_size());
        let longest = (0..robot.cables.len()).map(|i| robot.span(&pose, i).norm()).fold(0.0, f64::max);
        let observer = Observer::new(&robot, pose, &load).unwrap();
        let (left, failed) = compared(&robot, &observer, &rows, 1e-13 * longest);
        println!("{}: {left} of 200 left to the scalar models, {failed} failed there", robot.name);
        assert!(left <= 2, "{}: {left}, {failed}", robot.name);
    }
}

#[test]
fn cables_over_vertical_pulleys_and_behind_leads_stay_in_the_lanes() {
    let named = |name| Robot::from_json(library::named(library::ROBOTS, name).unwrap().text).unwrap();
    let with_their_own = [
        (named("copacabana-handling"), Pose::at(0.5, 0.3, 2.0)),
        (named("hrpcables"), Pose::at(0.3, 0.2, 1.5)),
        (named("ipanema-2"), Pose::at(0.3, 0.2, 1.5)),
        (named("expo2015-roberto"), Pose::at(0.3, 0.2, 1.5)),
    ];
    let up = Vector3::z();
    for (mut robot, pose) in robots().into_iter().chain(with_their_own) {
        let own = robot.cables[0].pulley;
        let longest = (0..robot.cables.len()).map(|i| robot.span(&pose, i).norm()).fold(0.0, f64::max);
        let radius = own.map_or(0.006 * longest, |pulley| pulley.radius);
        // All cables; some, from both sides and with other radii; leads alone.
        for case in 0..3 {
            for (i, cable) in robot.cables.iter_mut().enumerate() {
                let axis = if i % 3 == 0 { -up } else { up };
                let some = (i % 4 != 1).then_some(Pulley { radius: radius * (1.0 + 0.1 * i as f64), axis });
                cable.pulley = [own.or(Some(Pulley { radius, axis: up })), some, None][case];
                cable.lead = [0.0, if i % 2 == 0 { 0.1 * longest } else { 0.0 }, 0.2 * longest][case];
            }
            let load = Load::payload(0.1 * robot.platform.mass);
            let rows = rows_by_size(&robot, &pose, 200, 1.0, 17);
            let (left, failed) = compare(&robot, &pose, &load, &rows);
            println!("{} {case}: {left} of 200 left to the scalar models, {failed} failed", robot.name);
            assert!(left <= 2 && failed == 0, "{} {case}: {left}, {failed}", robot.name);
        }
    }
}

#[test]
fn a_greatest_tension_at_the_leave_point_of_a_pulley_is_kept_in_lanes() {
    for (mut robot, pose) in [(caroca(), Pose::at(0.5, 0.2, 1.75)), (ipanema(), Pose::at(0.3, 0.2, 1.5))] {
        for cable in &mut robot.cables {
            (cable.pulley, cable.lead) = (Some(Pulley { radius: 0.1, axis: Vector3::z() }), 1.0);
        }
        let load = Load::payload(0.2 * robot.platform.mass);
        let rows = rows(&robot, 200, 0.5, 5);
        let free = cdpr_statics::inverse(&robot, &pose, &Load::none()).unwrap();
        let tightest =
            (0..free.tensions.len()).max_by(|a, b| free.tensions[*a].total_cmp(&free.tensions[*b])).unwrap();
        let own = &mut robot.cables[tightest].tension_limits;
        (own.max_at, own.max) = (Some(CableEnd::Exit), Some(free.tensions[tightest] + 4.0));
        let (left, failed) = compare(&robot, &pose, &load, &rows);
        println!("{}: {left} of 200 left to the scalar models, {failed} failed there", robot.name);
        assert!(left <= 2 && failed < 20, "{}: {left}, {failed}", robot.name);
    }
}

#[test]
fn derivatives_of_rows_whose_axes_tilt_are_left_to_the_scalar_models_alone() {
    let mut robot = caroca();
    for cable in &mut robot.cables {
        cable.pulley = Some(Pulley { radius: 0.045, axis: Vector3::z() });
    }
    let (pose, load) = (Pose::at(0.0, 0.0, 1.75), Load::payload(50.0));
    let mut rows = rows(&robot, 9, 1.0, 6);
    let parameters = Parameter::of(&robot);
    let tilt = parameters.iter().position(|parameter| matches!(parameter, Parameter::Tilt(..))).unwrap();
    rows[4 * parameters.len() + tilt + 3] = 0.02;
    let observer = Observer::new(&robot, pose, &load).unwrap();
    let found = observed::<ObservationSlopes>(&observer, &rows);
    let reasons = found.into_iter().map(|found| found.unwrap().observation.scalar);
    let expected = (0..9).map(|row| (row == 4).then_some(ScalarReason::Derivatives));
    assert!(reasons.eq(expected));
    // A radius below zero is no robot.
    let radius =
        parameters.iter().position(|parameter| matches!(parameter, Parameter::PulleyRadius(_))).unwrap();
    rows[radius + 2] = -0.1;
    assert!(matches!(
        &observed::<Observation>(&observer, &rows)[0],
        Err(StaticsError::Robot(RobotError::Invalid { field, .. })) if field == "cables[2].pulley.radius"
    ));
}

#[test]
fn an_answer_depends_on_its_own_row_alone() {
    let robot = caroca();
    let rows = rows(&robot, 50, 2.0, 3);
    let pose = Pose::at(3.2, 1.7, 3.0);
    let observer = Observer::new(&robot, pose, &Load::payload(50.0)).unwrap();
    let together = observed::<Observation>(&observer, &rows);
    for size in [1, 3, 8, 11] {
        let apart = rows.chunks(62 * size).flat_map(|rows| observed::<Observation>(&observer, rows));
        assert!(apart.eq(together.iter().cloned()), "{size} at a time");
    }
}

#[test]
fn a_row_that_is_no_robot_fails_alone_and_says_why() {
    let robot = caroca();
    let mut rows = rows(&robot, 9, 1.0, 4);
    rows[0] = -1e4;
    rows[62 + 2] = -1e12;
    rows[2 * 62 + 5] = f64::NAN;
    rows[3 * 62 + 60] = f64::INFINITY;
    rows[4 * 62 + 1] = -1.0;
    let observer = Observer::new(&robot, Pose::at(0.0, 0.0, 1.75), &Load::payload(50.0)).unwrap();
    let found = observed::<Observation>(&observer, &rows);
    let field = |i: usize| match &found[i] {
        Err(StaticsError::Robot(RobotError::Invalid { field, .. })) => field.as_str(),
        outcome => panic!("{outcome:?}"),
    };
    assert_eq!(
        [field(0), field(1), field(2), field(3), field(4)],
        ["platform.mass", "cable.youngs_modulus", "a1.z", "dt7", "cable.linear_density"]
    );
    assert!(found[5..].iter().all(Result::is_ok));
}
