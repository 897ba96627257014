//! The energy of motions whose winches move.

use crate::robots::{ROBOTS, robot};
use crate::simulated::{at, rest};
use cdpr_dynamics::DynamicsError;
use cdpr_dynamics::simulate::{Change, CutAt, Energy, Profile, Series, Settings, simulate};
use cdpr_robot::{Pulley, Robot, Vector3};
use cdpr_statics::{DirectProblem, Load};

/// Energy of a motion without damping in which a winch takes a length [m] of the second cable in; its cables
/// stay taut.
fn wound(robot: &Robot, (position, free): ([f64; 3], &str), by: f64, settings: &Settings) -> Energy {
    let (lengths, rest) = rest(robot, position, free);
    let problem = DirectProblem::new(robot, &lengths, &Load::none()).unwrap();
    let change = Change::Shorten { cable: 1, by, over: 0.2, profile: Profile::Cosine };
    let series = simulate(&problem, &rest, &[at(0.02, change)], settings).unwrap();
    let energy = series.energy;
    println!("{}: {:.1e} of {:.3e} J, {energy:?}", robot.name, energy.drift, energy.given);
    assert!(!series.slack.contains(&true) && energy.lost == 0.0, "{}", robot.name);
    energy
}

/// With the tension at the exit instead of the force on the first point, 6e-4 of the work of FAST's winch
/// were missing, and 1e-4 of that of HRPCables.
#[test]
fn without_damping_the_energy_is_the_work_of_the_winches() {
    let [caroca, cogiro, fast, _, ipanema, four] = ROBOTS;
    let macarm = (include_str!("../../../data/robots/macarm.json"), [1.17, 1.17, 1.17], "");
    let hrpcables = (include_str!("../../../data/robots/hrpcables.json"), [0.4, 0.2, 1.0], "");
    for ((file, position, free), by, until) in [
        (caroca, 2e-3, 0.3),
        (cogiro, 3e-3, 0.4),
        (fast, 0.1, 0.4),
        (ipanema, 5e-4, 0.3),
        (four, 2e-3, 0.4),
        (macarm, 5e-4, 0.3),
        (hrpcables, 2e-3, 0.2),
    ] {
        let robot = robot(file);
        let energy = wound(&robot, (position, free), by, &Settings::until(until));
        // The motion of MACARM is but thousands of times what is accepted of a step.
        let bound = if robot.name == "MACARM" { 2e-6 } else { 2e-7 };
        assert!(energy.drift.abs() < bound * energy.given, "{}: {energy:?}", robot.name);
    }
}

/// Also where points turn with the cable: behind a lead, and on wheels.
#[test]
fn winches_behind_leads_and_wheels_do_the_work_of_the_motion() {
    let (file, position, free) = ROBOTS[4];
    let mut behind_leads = robot(file);
    behind_leads.cables.iter_mut().for_each(|cable| cable.lead = 4.0);
    let mut on_wheels = robot(ROBOTS[1].0);
    on_wheels.cables.iter_mut().for_each(|cable| {
        cable.pulley = Some(Pulley { radius: 0.5, axis: Vector3::z() });
    });
    for (robot, position, by) in [(behind_leads, position, 5e-4), (on_wheels, ROBOTS[1].1, 2e-3)] {
        let energy = wound(&robot, (position, free), by, &Settings::until(0.2));
        assert!(energy.drift.abs() < 1e-7 * energy.given, "{}: {energy:?}", robot.name);
    }
}

/// A balance that holds whatever the steps are would say nothing of them.
#[test]
fn the_missing_energy_shows_how_exact_the_steps_are() {
    let (file, position, free) = ROBOTS[1];
    let robot = robot(file);
    let settings = Settings::until(0.4);
    let [fine, coarse] = [settings, Settings { tolerance: 1e-6, ..settings }]
        .map(|settings| wound(&robot, (position, free), 3e-3, &settings));
    assert!(fine.drift.abs() < 5e-6 * fine.kinetic, "{fine:?}");
    assert!(coarse.drift.abs() > 5.0 * fine.drift.abs(), "{coarse:?}, {fine:?}");
}

/// As the answers about a broken cable demand it.
#[test]
fn a_motion_that_gains_energy_or_strains_a_cable_too_much_says_nothing_of_a_robot() {
    let (file, position, free) = ROBOTS[0];
    let robot = robot(file);
    let (lengths, rest) = rest(&robot, position, free);
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let cut = at(0.0, Change::Cut { cable: 0, at: CutAt::Anchor });
    let series = simulate(&problem, &rest, &[cut], &Settings::until(0.02)).unwrap();
    series.check(&robot).unwrap();
    let refused = |series: &Series| match series.check(&robot) {
        Err(DynamicsError::Implausible { what }) => what,
        other => panic!("{other:?}"),
    };
    let mut gaining = series.clone();
    gaining.energy.drift = 0.02 * gaining.energy.kinetic + 1e-5;
    assert!(refused(&gaining).starts_with("its energy is off by "), "{}", refused(&gaining));
    gaining.energy.drift = f64::NAN;
    refused(&gaining);
    let mut strained = series;
    strained.peaks[3].0 = 1e9;
    assert!(refused(&strained).starts_with("cable 4 is strained by "), "{}", refused(&strained));
}
