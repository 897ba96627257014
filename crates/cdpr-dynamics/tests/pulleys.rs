//! Motions of robots whose cables leave over pulleys.

use crate::robots::robot;
use crate::simulated::{at, moved, rest};
use cdpr_dynamics::simulate::{Change, CutAt, Discretization, Profile, Series, Settings, simulate};
use cdpr_dynamics::{Mode, Modes, Wanted};
use cdpr_robot::{Pose, Pulley, Robot, Vector3, Wrench};
use cdpr_statics::{DirectProblem, DirectStart, Load, Vector6};
use std::f64::consts::TAU;

/// A robot with pulleys, a pose, and a frequency [Hz] up to which natural motions are summed.
type OnPulleys = (Robot, [f64; 3], f64);

/// Two robots of the library, the lighter one on wheels of 0.4 m and of 0.25 m with a tilted axis, and a large
/// one on wheels of 0.5 m.
fn on_pulleys() -> [OnPulleys; 5] {
    let on_wheels = |robot: &Robot, name: &str, radius: f64, axis: Vector3<f64>| {
        let mut robot = robot.clone();
        robot.name = name.to_owned();
        robot.cables.iter_mut().for_each(|cable| cable.pulley = Some(Pulley { radius, axis }));
        robot
    };
    let ipanema = robot(include_str!("../../../data/robots/ipanema-3.json"));
    let hrpcables = robot(include_str!("../../../data/robots/hrpcables.json"));
    let cogiro = robot(include_str!("../../../data/robots/cogiro.json"));
    let large = on_wheels(&hrpcables, "HRPCables on large wheels", 0.4, Vector3::z());
    let axis = Vector3::new(0.1, 0.2, 1.0).normalize();
    let tilted = on_wheels(&hrpcables, "HRPCables on tilted wheels", 0.25, axis);
    let cogiro = on_wheels(&cogiro, "CoGiRo on wheels", 0.5, Vector3::z());
    [
        (ipanema, [0.5, 0.2, 1.5], 150.0),
        (hrpcables, [0.4, 0.2, 1.0], 100.0),
        (large, [0.4, 0.2, 1.0], 100.0),
        (tilted, [0.4, 0.2, 1.0], 100.0),
        (cogiro, [0.0, 0.0, 2.0], 80.0),
    ]
}

#[test]
fn robots_on_pulleys_at_rest_stay_at_rest() {
    for (robot, position, _) in on_pulleys() {
        let (lengths, rest) = rest(&robot, position, "");
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let series = simulate(&problem, &rest, &[], &Settings::until(1.0)).unwrap();
        let way = moved(&series, &rest.pose);
        println!("{}: {way:e}, drift {:e}", robot.name, series.energy.drift);
        assert!(way < 1e-11, "{}: {way:e}", robot.name);
    }
}

/// Loads move the leave points; the rest under them is that of the direct model.
#[test]
fn platforms_on_pulleys_put_where_they_rest_under_a_load_stay_there_with_it() {
    for (robot, position, _) in on_pulleys() {
        let (lengths, rest) = rest(&robot, position, "");
        let force = Vector3::new(0.02, 0.03, -0.02) * (9.81 * robot.platform.mass);
        let wrench = Wrench { force, moment: Vector3::zeros() };
        let loaded = DirectProblem::new(&robot, &lengths, &Load { wrench, ..Load::none() }).unwrap();
        let loaded = loaded.direct(DirectStart::Near(&rest)).unwrap().equilibrium;
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let motion = rest.pose.motion_to(&loaded.pose);
        let wind = Change::Wrench { force, moment: Vector3::zeros() };
        let events = [at(0.0, Change::Displace(motion)), at(0.0, wind)];
        let series = simulate(&problem, &rest, &events, &Settings::until(0.3)).unwrap();
        let way = moved(&series, &loaded.pose);
        println!("{}: {way:.1e} of {:.1e}", robot.name, motion.norm());
        // Cable that comes onto a tilted wheel has weight, which it has not in the direct model.
        let bound = if robot.name.contains("tilted") { 5e-4 } else { 2e-5 };
        assert!(way < bound * motion.norm(), "{}: {way:e}", robot.name);
    }
}

/// Of motions in which the cables stay taut without damping. What is missing is due to the steps: of light
/// robots it vanishes with a smaller error of them.
#[test]
fn without_damping_the_energy_of_a_robot_on_pulleys_stays() {
    let [ipanema, hrpcables, large, _, cogiro] = on_pulleys();
    let short = [(hrpcables, [5e-4, 2e-4, -5e-4, 0.0]), (large, [2e-4, 0.0, -1e-4, 2e-4])];
    let short = short.into_iter().chain([(cogiro, [1e-3, 1e-3, -3e-3, 1e-3])]);
    let all = short.map(|(case, motion)| (case, motion, 3, 1e-10, 0.02));
    let first = (ipanema, [0.0, 0.0, -8e-4, 0.0], 4, 1e-9, 0.05);
    for ((robot, position, _), [x, y, z, turn], elements, tolerance, until) in all.chain([first]) {
        let (lengths, rest) = rest(&robot, position, "");
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let events = [at(0.0, Change::Displace(Vector6::new(x, y, z, 0.0, turn, 0.0)))];
        let discretization = Some(Discretization { elements, degree: 5 });
        let settings = Settings { tolerance, discretization, ..Settings::until(until) };
        let series = simulate(&problem, &rest, &events, &settings).unwrap();
        println!("{}: {:.1e} of {:.1e} J", robot.name, series.energy.drift, series.energy.kinetic);
        assert!(!series.slack.contains(&true), "{}", robot.name);
        assert!(series.energy.drift.abs() < 1e-6 * series.energy.kinetic, "{:?}", series.energy);
    }
}

/// Greatest distance from the sum over natural motions, and greatest motion [m, rad].
fn off_from_sum(series: &Series, modes: &[Mode], from: &Pose, force: &Vector3<f64>) -> [f64; 2] {
    let share = |mode: &Mode, time: f64| {
        let omega = TAU * mode.frequency;
        let motion = mode.translation.iter().chain(mode.rotation.iter()).copied();
        let by = mode.translation.dot(force) / (omega * omega) * (1.0 - (omega * time).cos());
        Vector6::from_iterator(motion) * by
    };
    series.samples.iter().fold([0.0; 2], |[off, greatest], sample| {
        let expected: Vector6<f64> = modes.iter().map(|mode| share(mode, sample.time)).sum();
        let found = from.motion_to(&sample.pose);
        [off.max((found - expected).norm()), greatest.max(found.norm())]
    })
}

/// As of robots without pulleys, for forces in three directions. Elements resolve the waves of all cables, and
/// the accuracy is below the motions. Natural motions over tilted wheels leave a part of the inertia out.
#[test]
fn small_motions_on_pulleys_are_the_sum_of_natural_ones() {
    for (robot, position, below) in on_pulleys() {
        let (lengths, rest) = rest(&robot, position, "");
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let modes = Modes::new(&problem, &rest, Wanted::Below(below)).unwrap().modes;
        let name = &robot.name;
        let (tolerance, until) = if name.starts_with("HRP") { (1e-11, 0.3) } else { (1e-12, 0.1) };
        let bound = if name.contains("tilted") { 8e-3 } else { 1e-3 };
        let discretization = Some(Discretization { elements: 8, degree: 6 });
        for k in 0..3 {
            let mut force = Vector3::zeros();
            force[k] = 1e-4 * 9.81 * robot.platform.mass;
            let change = Change::Wrench { force, moment: Vector3::zeros() };
            let settings = Settings { tolerance, discretization, ..Settings::until(until) };
            let series = simulate(&problem, &rest, &[at(0.0, change)], &settings).unwrap();
            let [off, greatest] = off_from_sum(&series, &modes, &rest.pose, &force);
            println!("{name} {k}: {:.1e}, {off:.1e} of {greatest:.1e}, {}", off / greatest, modes.len());
            assert!(off < bound * greatest, "{name} {k}: {off:e} of {greatest:e}");
        }
    }
}

/// With damping the platform comes to where the direct model has it with the new length.
#[test]
fn winches_behind_pulleys_bring_the_platform_where_the_direct_model_has_it() {
    for (robot, position, _) in on_pulleys() {
        let (mut lengths, rest) = rest(&robot, position, "");
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let by = if robot.name.starts_with("HRP") { 0.01 } else { 1e-3 };
        let change = Change::Shorten { cable: 0, by, over: 0.5, profile: Profile::Polynomial };
        let settings = Settings { damping: 2e-3, ..Settings::until(2.0) };
        let series = simulate(&problem, &rest, &[at(0.0, change)], &settings).unwrap();
        lengths[0] -= by;
        let after = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let after = after.direct(DirectStart::Near(&rest)).unwrap().equilibrium;
        let way = rest.pose.motion_to(&after.pose).norm();
        let last = &series.samples[series.samples.len() - 50..];
        let mean: Vector6<f64> = last.iter().map(|sample| after.pose.motion_to(&sample.pose)).sum();
        let off = mean.norm() / last.len() as f64;
        let slack = series.slack.contains(&true);
        println!("{}: {off:.1e} of {way:.1e}, {:?}, slack {slack}", robot.name, series.energy);
        assert!(off < 0.05 * way, "{}: {off:e} of {way:e}", robot.name);
    }
}

/// A cable is cut at its pulley or at the platform; others go slack over their pulleys.
#[test]
fn cables_over_pulleys_part_and_go_slack_and_the_energy_is_known() {
    for (robot, position, _) in on_pulleys() {
        let (lengths, rest) = rest(&robot, position, "");
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        for cut in [CutAt::Anchor, CutAt::Exit] {
            let events = [at(0.02, Change::Cut { cable: 0, at: cut })];
            let settings = Settings { damping: 2e-4, ..Settings::until(0.2) };
            let series = simulate(&problem, &rest, &events, &settings).unwrap();
            let (energy, slack) = (series.energy, series.slack.contains(&true));
            let name = &robot.name;
            println!("{name}: {cut:?}, slack {slack}, {energy:?}, {:?}", series.difference);
            assert!(moved(&series, &rest.pose) > 1e-5, "{name}");
            let bound = if slack { 0.01 } else { 2e-5 };
            assert!(energy.drift.abs() < bound * energy.kinetic, "{name}: {cut:?}: {energy:?}");
            let tensions = series.samples.iter().flat_map(|sample| sample.tensions.iter().flatten());
            assert!(tensions.clone().all(|tension| tension.is_finite()), "{name}");
        }
    }
}
