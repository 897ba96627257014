//! Winches that follow tables, and controls that are called at each sample.

use crate::robots::{ROBOTS, robot};
use crate::simulated::{at, moved, rest};
use cdpr_dynamics::simulate::{
    Change, Command, Profile, Sample, Series, Settings, WinchLengths, simulate, simulate_controlled,
};
use cdpr_robot::{Vector3, Vector6, Wrench};
use cdpr_statics::{DirectProblem, Load};
use std::f64::consts::PI;

fn apart(one: &Series, other: &Series) -> f64 {
    let pairs = one.samples.iter().zip(&other.samples);
    pairs.map(|(one, other)| one.pose.motion_to(&other.pose).norm()).fold(0.0, f64::max)
}

#[test]
fn winches_that_follow_a_table_of_a_profile_move_the_platform_as_the_profile_does() {
    for (file, position, free) in ROBOTS {
        let robot = robot(file);
        let (lengths, rest) = rest(&robot, position, free);
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let (by, over, settings) = (1e-3 * lengths[1], 0.2, Settings::until(0.3));
        let times: Vec<f64> = (0..=80).map(|k| over * f64::from(k) / 80.0).collect();
        let row = |time: &f64| {
            let mut row = lengths.clone();
            row[1] -= by * 0.5 * (1.0 - (PI * time / over).cos());
            row
        };
        let rows: Vec<_> = times.iter().map(row).collect();
        let table = Change::Lengths(WinchLengths::new(&times, &rows).unwrap());
        let profile = Change::Shorten { cable: 1, by, over, profile: Profile::Cosine };
        let [one, other] =
            [table, profile].map(|change| simulate(&problem, &rest, &[at(0.05, change)], &settings).unwrap());
        let (apart, way) = (apart(&one, &other), moved(&one, &rest.pose));
        println!("{}: {apart:.1e} of {way:.1e}", robot.name);
        assert!(way > 1e-6 && apart < 1e-3 * way, "{}: {apart:e} of {way:e}", robot.name);
    }
}

#[test]
fn a_second_table_begins_where_the_first_one_ended() {
    let robot = robot(ROBOTS[1].0);
    let (lengths, rest) = rest(&robot, ROBOTS[1].1, "");
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let shorter: Vec<f64> = lengths.iter().map(|length| length - 1e-3).collect();
    let table = |rows: [&Vec<f64>; 2]| {
        Change::Lengths(WinchLengths::new(&[0.0, 0.1], &rows.map(Clone::clone)).unwrap())
    };
    let events = [at(0.0, table([&lengths, &shorter])), at(0.1, table([&shorter, &lengths]))];
    let settings = Settings { damping: 2e-3, ..Settings::until(1.5) };
    let series = simulate(&problem, &rest, &events, &settings).unwrap();
    let motion = |k: usize| rest.pose.motion_to(&series.samples[k].pose);
    // It swings about its rest again.
    let mean = (50..=150).map(motion).sum::<Vector6<f64>>() / 101.0;
    assert!(mean.norm() < 0.2 * motion(10).norm(), "{:e} of {:e}", mean.norm(), motion(10).norm());
}

#[test]
fn a_control_that_pulls_the_same_everywhere_is_a_force() {
    for (file, position, free) in ROBOTS {
        let robot = robot(file);
        let (lengths, rest) = rest(&robot, position, free);
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let force = Vector3::new(0.01 * 9.81 * robot.platform.mass, 0.0, 0.0);
        let wrench = Wrench { force, ..Wrench::none() };
        let settings = Settings { damping: 2e-4, ..Settings::until(0.2) };
        let event = Change::Wrench { force, moment: Vector3::zeros() };
        let by_event = simulate(&problem, &rest, &[at(0.0, event)], &settings).unwrap();
        let by_control =
            simulate_controlled(&problem, &rest, &[], &settings, &|_| Command::Wrench(wrench)).unwrap();
        let (apart, way) = (apart(&by_event, &by_control), moved(&by_event, &rest.pose));
        assert!(way > 1e-7 && apart < 1e-5 * way, "{}: {apart:e} of {way:e}", robot.name);
    }
}

/// A control that brakes takes energy, which the account of energies has as work.
#[test]
fn a_control_that_brakes_ends_the_swing_of_a_platform() {
    let robot = robot(ROBOTS[0].0);
    let (lengths, rest) = rest(&robot, ROBOTS[0].1, "");
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let events = [at(0.0, Change::Payload(0.2 * robot.platform.mass))];
    let settings = Settings { rate: 500.0, damping: 2e-4, ..Settings::until(1.0) };
    let rate = 40.0 * robot.platform.mass;
    let brake = |sample: &Sample| {
        let velocity = Vector3::new(sample.velocity[0], sample.velocity[1], sample.velocity[2]);
        Command::Wrench(Wrench { force: -rate * velocity, ..Wrench::none() })
    };
    let free = simulate(&problem, &rest, &events, &settings).unwrap();
    let braked = simulate_controlled(&problem, &rest, &events, &settings, &brake).unwrap();
    let speed = |series: &Series| {
        let last = series.samples[400..].iter();
        last.map(|sample| sample.velocity.fixed_rows::<3>(0).norm()).fold(0.0, f64::max)
    };
    let [of_free, of_braked] = [&free, &braked].map(speed);
    assert!(of_braked < 0.1 * of_free, "{of_braked:e} of {of_free:e}");
    assert!(braked.energy.given < free.energy.given);
    assert!(braked.energy.drift.abs() < 1e-4 * braked.energy.kinetic, "{:?}", braked.energy);
}

#[test]
fn a_control_ends_a_motion_at_the_sample_where_it_stops() {
    let robot = robot(ROBOTS[1].0);
    let (lengths, rest) = rest(&robot, ROBOTS[1].1, "");
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let stop = |sample: &Sample| {
        if sample.time < 0.0549 { Command::Wrench(Wrench::none()) } else { Command::Stop }
    };
    let series = simulate_controlled(&problem, &rest, &[], &Settings::until(1.0), &stop).unwrap();
    let last = series.samples.last().unwrap().time;
    assert!((last - 0.06).abs() < 1e-12, "{last}");
}
