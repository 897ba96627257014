//! Motions of robots of the library.

use crate::robots::{ROBOTS, free_coordinates, robot, wanted};
use cdpr_dynamics::simulate::{
    Change, CutAt, Discretization, Event, Profile, Series, Settings, events_from_json, simulate,
};
use cdpr_dynamics::{Modes, Wanted};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, Vector6, inverse};
use std::f64::consts::TAU;

/// Its lengths at the pose, and the rest.
pub(crate) fn rest(robot: &Robot, [x, y, z]: [f64; 3], free: &str) -> (Vec<f64>, Equilibrium) {
    let (pose, free) = (Pose::at(x, y, z), free_coordinates(free));
    let held = inverse(robot, wanted(&pose, &free), &Load::none()).unwrap();
    let problem = DirectProblem::new(robot, &held.lengths, &Load::none()).unwrap();
    let found = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap();
    (held.lengths, found.equilibrium)
}

/// Greatest motion from a pose [m, rad].
pub(crate) fn moved(series: &Series, from: &Pose) -> f64 {
    series.samples.iter().map(|sample| from.motion_to(&sample.pose).norm()).fold(0.0, f64::max)
}

pub(crate) fn at(time: f64, change: Change) -> Event {
    Event { time, change }
}

#[test]
fn robots_at_rest_stay_at_rest() {
    for (file, position, free) in ROBOTS {
        let robot = robot(file);
        let (lengths, rest) = rest(&robot, position, free);
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let series = simulate(&problem, &rest, &[], &Settings::until(1.0)).unwrap();
        let way = moved(&series, &rest.pose);
        assert!(way < 1e-9, "{}: {way:e}", robot.name);
        let exits = rest.exit_tensions(&robot, &lengths);
        for (i, [exit, anchor]) in series.samples[100].tensions.iter().enumerate() {
            let expected = [exits[i], rest.cable_forces[i].norm()];
            let off = (exit - expected[0]).abs().max((anchor - expected[1]).abs());
            assert!(off < 1e-5 * expected[0], "{}: cable {i}: {exit} {anchor} {expected:?}", robot.name);
        }
    }
}

/// Leads and pulleys, too: their rest elsewhere is that of the direct model.
#[test]
fn a_platform_put_where_it_rests_with_a_payload_stays_there_with_it() {
    for (k, (file, position, free)) in ROBOTS.into_iter().enumerate() {
        let mut robot = robot(file);
        if k % 2 == 1 {
            robot.cables.iter_mut().for_each(|cable| cable.lead = 4.0);
        }
        let (lengths, rest) = rest(&robot, position, free);
        let payload = 0.1 * robot.platform.mass;
        let loaded = DirectProblem::new(&robot, &lengths, &Load::payload(payload)).unwrap();
        let loaded = loaded.direct(DirectStart::Near(&rest)).unwrap().equilibrium;
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let motion = rest.pose.motion_to(&loaded.pose);
        let events = [at(0.0, Change::Displace(motion)), at(0.0, Change::Payload(payload))];
        let series = simulate(&problem, &rest, &events, &Settings::until(0.5)).unwrap();
        let way = moved(&series, &loaded.pose);
        println!("{}: {way:.1e} of {:.1e}", robot.name, motion.norm());
        assert!(way < 2e-3 * motion.norm(), "{}: {way:e}", robot.name);
    }
}

/// Motions by a small force are the sum over the natural motions: x = K⁻¹F - Σ v (v F)/ω² cos ωt.
#[test]
fn small_motions_are_the_sum_of_natural_ones() {
    for ((file, position, free), below) in [(ROBOTS[1], 80.0), (ROBOTS[0], 200.0), (ROBOTS[5], 100.0)] {
        let robot = robot(file);
        let (lengths, rest) = rest(&robot, position, free);
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let modes = Modes::new(&problem, &rest, Wanted::Below(below)).unwrap().modes;
        let force = 1e-3 * 9.81 * robot.platform.mass;
        let change = Change::Wrench { force: Vector3::new(force, 0.0, 0.0), moment: Vector3::zeros() };
        let series = simulate(&problem, &rest, &[at(0.0, change)], &Settings::until(0.4)).unwrap();
        let share = |mode: &cdpr_dynamics::Mode, time: f64| {
            let omega = TAU * mode.frequency;
            let motion = Vector6::from_iterator(mode.translation.iter().chain(mode.rotation.iter()).copied());
            motion * (mode.translation.x * force / (omega * omega) * (1.0 - (omega * time).cos()))
        };
        let (mut off, mut greatest) = (0.0_f64, 0.0_f64);
        for sample in &series.samples {
            let expected: Vector6<f64> = modes.iter().map(|mode| share(mode, sample.time)).sum();
            let found = rest.pose.motion_to(&sample.pose);
            off = off.max((found - expected).norm());
            greatest = greatest.max(found.norm());
        }
        println!("{}: {off:.1e} of {greatest:.1e}, {} motions", robot.name, modes.len());
        assert!(off < 5e-3 * greatest, "{}: {off:e} of {greatest:e}", robot.name);
    }
}

#[test]
fn cables_part_and_winches_turn_on_every_robot() {
    for (k, (file, position, free)) in ROBOTS.into_iter().enumerate() {
        let robot = robot(file);
        let (lengths, rest) = rest(&robot, position, free);
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let cut = [CutAt::Anchor, CutAt::Exit][k % 2];
        let by = 1e-3 * lengths[1];
        for change in [
            Change::Cut { cable: 0, at: cut },
            Change::Shorten { cable: 1, by, over: 0.1, profile: Profile::Polynomial },
        ] {
            let settings = Settings { damping: 2e-4, ..Settings::until(0.2) };
            let series = simulate(&problem, &rest, &[at(0.05, change.clone())], &settings).unwrap();
            let way = moved(&series, &rest.pose);
            println!("{}: {change:?}: {way:.1e}; {:?}", robot.name, series.difference);
            let before = series.samples[0].pose.motion_to(&series.samples[4].pose).norm();
            assert!(before < 1e-9, "{}: {before:e}", robot.name);
            assert!(way > 1e-6 && series.difference.position < 5e-3 * way, "{}", robot.name);
            let exit_and_anchor = series.samples[20].tensions[0];
            match change {
                Change::Cut { at: CutAt::Anchor, .. } => assert_eq!(exit_and_anchor, [0.0; 2]),
                Change::Cut { .. } => assert_eq!(exit_and_anchor[0], 0.0),
                _ => assert!(exit_and_anchor[0] != 0.0),
            }
        }
    }
}

/// Long heavy cables have waves that the elements of others do not resolve.
#[test]
fn taut_cables_get_as_many_elements_as_their_motion_needs() {
    let (file, _, free) = ROBOTS[2];
    let mut robot = robot(file);
    robot.tension_limits.min = 20_000.0;
    let (lengths, rest) = rest(&robot, [20.0, -10.0, 140.0], free);
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let events = [at(0.0, Change::Displace(Vector6::new(0.1, -0.05, 0.08, 0.01, -0.02, 0.015)))];
    let settings = Settings { damping: 1e-3, rate: 7.3, ..Settings::until(3.0) };
    let taut = Settings { discretization: Some(Discretization { elements: 10, degree: 7 }), ..settings };
    let [own, fine] = [settings, taut].map(|by| simulate(&problem, &rest, &events, &by).unwrap());
    let off = own.samples.iter().zip(&fine.samples);
    let off = off.map(|(own, fine)| own.pose.motion_to(&fine.pose).norm()).fold(0.0, f64::max);
    println!("{off:e} {:?} {:?}", own.discretizations[0], own.difference);
    assert!(off < 1e-5 && own.discretizations[0].elements > 3, "{off:e}");
}

/// Twelve elements differ from six by 0.24 mm here.
#[test]
fn sagging_cables_of_a_stadium_get_elements_until_half_of_them_suffice() {
    let exits = [[-45, -30, 28], [44, -31, 27], [46, 29, 29], [-44, 30, 28]];
    let cables: Vec<String> =
        exits.iter().map(|p| format!(r#"{{"exit_point": {p:?}, "anchor_point": [0, 0, 0]}}"#)).collect();
    let robot = Robot::from_json(&format!(
        r#"{{"format": "cdpr-robot/1", "name": "Camera", "gravity": 9.81, "lead": 12,
        "platform": {{"mass": 35, "center_of_mass": [0, 0, 0], "point": true}},
        "cable": {{"diameter": 0.01, "section": 6e-5, "youngs_modulus": 3e10, "linear_density": 0.3}},
        "tension_limits": {{"min": 50, "max": 9000}}, "cables": [{}]}}"#,
        cables.join(",")
    ))
    .unwrap();
    let (lengths, rest) = rest(&robot, [0.0, 0.0, 5.0], "");
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let events = [at(0.0, Change::Displace(Vector6::new(0.1, 0.1, 0.141, 0.0, 0.0, 0.0)))];
    let series = simulate(&problem, &rest, &events, &Settings::until(1.0)).unwrap();
    println!("{:?} {:?}", series.discretizations[0], series.difference);
    assert!(series.difference.position < 1e-4, "{:?}", series.difference);
}

/// Elements of slack cables lose and regain their tension. Steps of the method for smooth motions take seven
/// evaluations at least, and there would be more than 600 of them. Those for slack cables resolve the fastest
/// motion of the platform, and not the sum over all of them.
#[test]
fn slack_cables_of_a_light_robot_take_few_evaluations_and_keep_the_energy() {
    let robot = robot(ROBOTS[3].0);
    let (lengths, rest) = rest(&robot, ROBOTS[3].1, "");
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    for damping in [0.0, 2e-4] {
        let settings = Settings { damping, ..Settings::until(0.2) };
        let events = [at(0.0, Change::Cut { cable: 0, at: CutAt::Anchor })];
        let series = simulate(&problem, &rest, &events, &settings).unwrap();
        let (work, energy) = (series.work, series.energy);
        println!("{work:?}, {energy:?}");
        assert!(series.slack.contains(&true) && work.evaluations < 1600, "{damping}: {work:?}");
        assert!(energy.drift.abs() < 1e-3 * energy.kinetic, "{damping}: {energy:?}");
    }
}

/// Two iterations of Newton's method at least would be seven evaluations a step. One does where the last ones
/// have converged fast.
#[test]
fn waves_along_taut_cables_take_less_than_two_iterations_a_step() {
    let robot = robot(ROBOTS[0].0);
    let (lengths, rest) = rest(&robot, ROBOTS[0].1, "");
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let force = Vector3::new(0.1 * 9.81 * robot.platform.mass, 0.0, 0.0);
    let wind = at(0.0, Change::Wrench { force, moment: Vector3::zeros() });
    let work = simulate(&problem, &rest, &[wind], &Settings::until(0.5)).unwrap().work;
    println!("{work:?}");
    assert!(work.evaluations < 7 * work.steps, "{work:?}");
}

#[test]
fn events_that_are_not_possible_are_refused_with_their_place() {
    let robot = robot(ROBOTS[1].0);
    let (lengths, rest) = rest(&robot, ROBOTS[1].1, "");
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let solve = |text: &str| {
        let events = events_from_json(text)?;
        simulate(&problem, &rest, &events, &Settings::until(0.1))
    };
    for (text, place) in [
        ("{}", "events: line 1"),
        (r#"[{"t": 0, "cutt": 1}]"#, "events: line 1, column 16"),
        (r#"[{"t": 0}]"#, "event 1 is an event with 0 changes"),
        (r#"[{"t": 0, "cut": 1, "payload": 3}]"#, "event 1 is an event with 2 changes"),
        (
            r#"[{"t": 0, "payload": 1}, {"t": 0, "cut": 9}]"#,
            "event 2, cut is 9: expected the number of a cable, 1 to 8",
        ),
        (r#"[{"t": 0, "cut": 0}]"#, "event 1, cut is 0"),
        (r#"[{"t": 0, "at": "exit"}]"#, "event 1, at is given"),
        (r#"[{"t": -1, "payload": 1}]"#, "event 1, t is -1.0"),
        (r#"[{"t": 0, "payload": -500}]"#, "event 1, payload is -500.0"),
        (r#"[{"t": 0, "force": [1e300, 0, 0]}]"#, "event 1, force is [1e300, 0.0, 0.0]"),
        (r#"[{"t": 1, "displace": [0, 0, 0.1, 0, 0, 0]}]"#, "event 1, t is 1.0: expected 0"),
        (r#"[{"t": 0, "shorten": {"cable": 1, "by": 30, "over": 1}}]"#, "event 1, shorten.by is 30.0"),
        (r#"[{"t": 0, "shorten": {"cable": 1, "by": 0.1, "over": 0}}]"#, "event 1, shorten.over is 0.0"),
        (r#"[{"t": 0, "payload": 1e30}]"#, "event 1, payload is 1e30: expected a payload of 1e12 kg at most"),
        (
            r#"[{"t": 0, "displace": [1e9, 0, 0, 0, 0, 0]}]"#,
            "event 1, displace is [1000000000.0, 0.0, 0.0]: expected a translation of",
        ),
        (
            r#"[{"t": 0, "displace": [0, 0, 0, 5, 0, 0]}]"#,
            "event 1, displace is [5.0, 0.0, 0.0]: expected a rotation vector of 3.1416 rad at most",
        ),
        (
            r#"[{"t": 0, "displace": [0.1, 0, 0, 0, 0, 0]}, {"t": 0, "displace": [0, 0, 0, 0.1, 0, 0]}]"#,
            "event 2, displace is [0.0, 0.0, 0.0, 0.1, 0.0, 0.0]: expected one displacement",
        ),
        (
            r#"[{"t": 0, "shorten": {"cable": 1, "by": -1e9, "over": 1}}]"#,
            "event 1, shorten.by is -1000000000.0: expected -97.",
        ),
        (
            r#"[{"t": 0, "shorten": {"cable": 1, "by": 5, "over": 1}},
                {"t": 0.5, "shorten": {"cable": 1, "by": 5, "over": 1}}]"#,
            "event 2, shorten.by is 5.0: expected -102.4 to 3.765 m: the cable has 4.739 m after",
        ),
        (
            r#"[{"t": 0, "lengths": {"times": [0], "lengths": []}}]"#,
            "event 1, lengths over time is 0 rows at 1 times",
        ),
        (
            r#"[{"t": 0, "lengths": {"times": [0, 1, 1], "lengths": []}}]"#,
            "event 1, lengths over time is 0 rows at 3 times",
        ),
        (
            r#"[{"t": 0, "lengths": {"times": [0, 1], "lengths": []}}]"#,
            "event 1, lengths over time is 0 rows at 2 times",
        ),
        (
            r#"[{"t": 0, "lengths": {"times": [0, 1], "lengths": [[1], [1]]}}]"#,
            "event 1, lengths is a table of 1 lengths: expected one for each of the 8 cables",
        ),
        (
            r#"[{"t": 0, "lengths": {"times": [0, 1], "lengths": [[1, 1, 1, 1, 1, 1, 1, 1], [2, 1, 1, 1, 1, 1, 1, 1]]}}]"#,
            "event 1, lengths, first row is 1.000000 m: expected the length of cable 1 then",
        ),
    ] {
        let error = solve(text).unwrap_err().to_string();
        assert!(error.starts_with(place), "{text}: {error}");
    }
}

#[test]
fn settings_that_are_not_possible_are_refused() {
    let robot = robot(ROBOTS[1].0);
    let (lengths, rest) = rest(&robot, ROBOTS[1].1, "");
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    for settings in [
        Settings { rate: f64::NAN, ..Settings::until(1.0) },
        Settings { rate: 1e9, ..Settings::until(1.0) },
        Settings { damping: -1.0, ..Settings::until(1.0) },
        Settings { tolerance: 0.0, ..Settings::until(1.0) },
        Settings::until(0.0),
        Settings::until(f64::INFINITY),
    ] {
        assert!(simulate(&problem, &rest, &[], &settings).is_err(), "{settings:?}");
    }
}
