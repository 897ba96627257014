//! The friction of pulleys from tables of tensions at the winches.

use cdpr_calibration::{Measurements, PulleyCalibration, calibrate_pulleys, read_measurements};
use cdpr_robot::{Coordinate, Pose, Robot};
use cdpr_statics::hysteresis::{HysteresisLaw, PulleyFriction, load_cycle_over_pulleys};
use serde_json::Value;

/// A robot of `data/robots` with leads [m].
fn library(name: &str, lead: f64) -> Robot {
    let mut robot = Robot::from_library(name).unwrap();
    robot.cables.iter_mut().for_each(|cable| cable.lead = lead);
    robot
}

fn measured(robot: &Robot, columns: &[String], rows: &[Vec<f64>]) -> Measurements {
    let line = |row: &Vec<f64>| row.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let text = [columns.join(",")].into_iter().chain(rows.iter().map(line)).collect::<Vec<_>>().join("\n");
    read_measurements(text.as_bytes(), robot, &[]).unwrap()
}

fn numbered(name: &str, n: usize) -> Vec<String> {
    (1..=n).map(|i| name.replace('#', &i.to_string())).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Distance of the identified sum from that of the true coefficients, in standard deviations.
fn off(found: &PulleyCalibration, truth: PulleyFriction) -> f64 {
    let [one, other] = found.combination;
    let exact = one * truth.friction + other * truth.bearing;
    (found.combined.value - exact).abs() / (found.combined.std + 1e-9)
}

/// Noise of this size [N] without a generator: sines of great multiples are spread like noise.
fn noise(k: usize, size: f64) -> f64 {
    size * (1e4 * (k * k + 1) as f64).sin() * std::f64::consts::SQRT_2
}

/// Cycles that another program has integrated, `data/reference/friction.py`.
#[test]
fn the_winches_of_another_program_identify_the_friction_that_it_used() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/friction.json")).unwrap();
    for case in file["cases"].as_array().unwrap() {
        let robot = Robot::from_json(&case["robot"].to_string()).unwrap();
        let (n, found) = (robot.cables.len(), case["found"].as_array().unwrap());
        let columns = [vec!["payload_kg".to_owned()], numbered("t#_winch_n", n)].concat();
        let row = |step: &Value| {
            let winches = step["winch"].as_array().unwrap().iter().map(number);
            std::iter::once(number(&step["payload"])).chain(winches).collect()
        };
        let rows: Vec<Vec<f64>> = found.iter().map(row).collect();
        let [x, y, z] = [0, 1, 2].map(|k| number(&case["pose"][k]));
        let measured = measured(&robot, &columns, &rows);
        let truth = PulleyFriction { friction: number(&case["friction"]), bearing: number(&case["bearing"]) };
        let fit = calibrate_pulleys(&robot, &measured, Some(&Pose::at(x, y, z)), &[]).unwrap();
        println!("{}: {:?} {:?} {:?} {:?}", case["kind"], fit.friction, fit.bearing, fit.combined, fit.rms_n);
        // Equal wraps identify one sum, to terms of the third order in it.
        let [one, other] = fit.combination;
        let exact = one * truth.friction + other * truth.bearing;
        assert!(fit.rms_n[1] < 0.03 * fit.rms_n[0], "{:?}", fit.rms_n);
        assert!((fit.combined.value - exact).abs() < 0.01 * exact, "{exact}");
        if let (Some(friction), Some(bearing)) = (fit.friction, fit.bearing) {
            assert!((friction.value - truth.friction).abs() < 3.0 * friction.std + 1e-6);
            assert!((bearing.value - truth.bearing).abs() < 3.0 * bearing.std + 1e-6);
        }
    }
}

/// Robots of the library with pulleys, a lead where the file has none, and a load cycle for each.
fn with_pulleys() -> Vec<(Robot, Pose, f64, Vec<Coordinate>)> {
    let at = |name, pose: [f64; 3], payload, free: &[Coordinate]| {
        (library(name, 2.0), Pose::at(pose[0], pose[1], pose[2]), payload, free.to_vec())
    };
    vec![
        at("ipanema-3", [0.0, 0.0, 1.5], 40.0, &[]),
        at("expo2015-lucia", [0.0, 0.0, 2.0], 60.0, &[]),
        at("expo2015-roberto", [0.3, 0.0, 2.0], 60.0, &[]),
        at("copacabana-inspection", [0.2, 0.1, 1.2], 40.0, &[]),
        at("hrpcables", [0.0, 0.0, 1.5], 20.0, &[]),
        at("irma4u", [0.2, 0.1, 0.8], 20.0, &[Coordinate::Roll, Coordinate::Pitch]),
    ]
}

#[test]
fn robots_of_the_library_identify_what_a_noisy_load_cycle_can() {
    let truth = PulleyFriction { friction: 0.05, bearing: 0.02 };
    for (robot, pose, payload, free) in with_pulleys() {
        let n = robot.cables.len();
        let laws = vec![HysteresisLaw::linear().unwrap(); n];
        let wanted = cdpr_statics::WantedPose::at(&pose).free(&free);
        let cycle = load_cycle_over_pulleys(&robot, wanted, &laws, payload, 12, truth).unwrap();
        for at_platform in [true, false] {
            let mut columns = [vec!["payload_kg".to_owned()], numbered("t#_winch_n", n)].concat();
            if at_platform {
                columns.extend(numbered("t#_n", n));
            }
            let steps = cycle.loading.iter().chain(cycle.unloading.iter().skip(1)).enumerate();
            let row = |(k, step): (usize, &cdpr_statics::hysteresis::CycleStep)| {
                let winches = step.pulleys.iter().enumerate();
                let mut row = vec![step.payload];
                row.extend(winches.map(|(i, wheel)| wheel.winch_tension + noise(17 * k + i, 0.2)));
                if at_platform {
                    row.extend(step.solution.equilibrium.tensions());
                }
                row
            };
            let rows: Vec<Vec<f64>> = steps.map(row).collect();
            let found =
                calibrate_pulleys(&robot, &measured(&robot, &columns, &rows), Some(&pose), &free).unwrap();
            println!(
                "{} {at_platform}: {:?} {:?} sum {:?} {:?}, noise {}, off {:.2}",
                robot.name,
                found.friction,
                found.bearing,
                found.combination,
                found.combined,
                found.noise_n,
                off(&found, truth)
            );
            // Without load cells at the platform the pretension is that of the first row, with its noise.
            let most = if at_platform { 0.3 } else { 1.0 };
            assert!(found.noise_n < most && found.rms_n[1] < 0.3 * found.rms_n[0], "{:?}", found.rms_n);
            assert!(off(&found, truth) < 4.0, "{}", robot.name);
            assert_eq!(found.readings.len(), 24 * n);
        }
    }
}

/// To second order the readings depend on how the coefficients share the sum, which they do not identify.
#[test]
fn large_friction_is_within_its_deviation_whatever_shares_it() {
    let text = include_str!("../../../data/reference/robots/suspended-leads.json");
    let robot = Robot::from_json(text).unwrap();
    let pose = Pose::at(0.0, 0.0, 1.5);
    let n = robot.cables.len();
    let laws = vec![HysteresisLaw::linear().unwrap(); n];
    for (friction, bearing) in [(0.15, 0.05), (0.2, 0.0), (0.05, 0.01)] {
        let truth = PulleyFriction { friction, bearing };
        let wanted = cdpr_statics::WantedPose::at(&pose);
        let cycle = load_cycle_over_pulleys(&robot, wanted, &laws, 40.0, 8, truth).unwrap();
        let columns =
            [vec!["payload_kg".to_owned()], numbered("t#_winch_n", n), numbered("t#_n", n)].concat();
        let steps = cycle.loading.iter().chain(cycle.unloading.iter().skip(1));
        let row = |step: &cdpr_statics::hysteresis::CycleStep| {
            let winches = step.pulleys.iter().map(|wheel| wheel.winch_tension);
            std::iter::once(step.payload).chain(winches).chain(step.solution.equilibrium.tensions()).collect()
        };
        let rows: Vec<Vec<f64>> = steps.map(row).collect();
        let found = calibrate_pulleys(&robot, &measured(&robot, &columns, &rows), Some(&pose), &[]).unwrap();
        println!("{truth:?} {found:?} off {}", off(&found, truth));
        assert!(found.friction.is_none() && off(&found, truth) < 2.0, "{truth:?} {:?}", found.combined);
        assert!(found.combined.std < 0.05 * found.combined.value, "{:?}", found.combined);
    }
}

/// The winches read the tensions at the wheels, which those at the platform differ from by the weight of the
/// cables.
#[test]
fn heavy_cables_do_not_change_the_friction_that_is_found() {
    let truth = PulleyFriction { friction: 0.05, bearing: 0.02 };
    let (mut robot, pose) = (library("expo2015-lucia", 2.0), Pose::at(0.2, 0.1, 2.0));
    robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density *= 10.0);
    let n = robot.cables.len();
    let laws = vec![HysteresisLaw::linear().unwrap(); n];
    let wanted = cdpr_statics::WantedPose::at(&pose);
    let cycle = load_cycle_over_pulleys(&robot, wanted, &laws, 60.0, 12, truth).unwrap();
    let columns = [vec!["payload_kg".to_owned()], numbered("t#_winch_n", n)].concat();
    let steps = cycle.loading.iter().chain(cycle.unloading.iter().skip(1));
    let row = |step: &cdpr_statics::hysteresis::CycleStep| {
        let winches = step.pulleys.iter().map(|wheel| wheel.winch_tension);
        std::iter::once(step.payload).chain(winches).collect()
    };
    let rows: Vec<Vec<f64>> = steps.map(row).collect();
    let found = calibrate_pulleys(&robot, &measured(&robot, &columns, &rows), Some(&pose), &[]).unwrap();
    let [one, other] = found.combination;
    let exact = one * truth.friction + other * truth.bearing;
    println!("{:?} {exact} {:?}", found.combined, found.rms_n);
    assert!((found.combined.value / exact - 1.0).abs() < 1e-3, "{:?} {exact}", found.combined);
    assert!(found.rms_n[1] < 5e-3 * found.rms_n[0], "{:?}", found.rms_n);
}

/// Tensions at both sides of wheels that slip the way in which the winches drive, by the capstan's equation.
#[test]
fn winches_that_drive_from_pose_to_pose_slip_the_way_in_which_cables_run() {
    let (robot, friction) = (library("expo2015-lucia", 0.0), 0.06_f64);
    let places = [[0.0, 0.0, 2.0], [0.5, 0.0, 2.2], [0.5, 0.6, 2.0], [-0.3, 0.6, 2.5], [-0.6, -0.5, 2.1]];
    let columns =
        [["x_m", "y_m", "z_m"].map(str::to_owned).to_vec(), numbered("t#_winch_n", 8), numbered("t#_n", 8)];
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut before: Option<Vec<f64>> = None;
    for [x, y, z] in places {
        let pose = Pose::at(x, y, z);
        // Straight cables from points at the wheels: which way each runs, and how far it lies on its wheel.
        let spans: Vec<f64> = (0..8).map(|i| robot.span(&pose, i).norm()).collect();
        let held = cdpr_statics::inverse(&robot, &pose, &cdpr_statics::Load::none()).unwrap();
        let wheel = |i: usize| {
            let history = cdpr_statics::hysteresis::LoadHistory::begin(
                &robot,
                pose,
                &cdpr_statics::Load::none(),
                PulleyFriction::default(),
            );
            history.unwrap().now.pulleys[i]
        };
        let winch = |i: usize| {
            let slip = before.as_ref().map_or(0.0, |before| (before[i] - spans[i]).signum());
            wheel(i).tension * (slip * friction * wheel(i).wrap).exp()
        };
        let tensions = held.equilibrium.tensions();
        rows.push([vec![x, y, z], (0..8).map(winch).collect(), tensions].concat());
        before = Some(spans);
    }
    let found = calibrate_pulleys(&robot, &measured(&robot, &columns.concat(), &rows), None, &[]).unwrap();
    println!("{:?} {:?} {:?}", found.combination, found.combined, found.rms_n);
    let exact = PulleyFriction { friction, bearing: 0.0 };
    assert_eq!(found.readings.len(), 32);
    assert!(found.readings.iter().all(|reading| reading.slip != 0));
    assert!(found.rms_n[1] < 0.01 * found.rms_n[0], "{:?}", found.rms_n);
    let [one, _] = found.combination;
    assert!((found.combined.value / (one * exact.friction) - 1.0).abs() < 0.01, "{:?}", found.combined);
    // Where the platform has no load cells, a pose does not determine the tensions of eight cables.
    let columns = columns[..2].concat();
    rows.iter_mut().for_each(|row| row.truncate(11));
    let refused = calibrate_pulleys(&robot, &measured(&robot, &columns, &rows), None, &[]).unwrap_err();
    assert!(refused.to_string().starts_with("column t1_n is missing: expected tensions at the platform"));
}

fn refused(robot: &Robot, text: &str, pose: Option<&Pose>) -> String {
    let measured = read_measurements(text.as_bytes(), robot, &[]).unwrap();
    calibrate_pulleys(robot, &measured, pose, &[]).unwrap_err().to_string()
}

#[test]
fn what_is_no_load_history_of_pulleys_is_refused() {
    let lucia = library("expo2015-lucia", 1.0);
    let pose = Pose::at(0.0, 0.0, 2.0);
    let rows = |loads: [f64; 4], winches: [f64; 4]| {
        let lines = loads.iter().zip(winches).map(|(load, winch)| format!("{load},{winch},{winch}"));
        std::iter::once("payload_kg,t1_winch_n,t2_winch_n".to_owned())
            .chain(lines)
            .collect::<Vec<_>>()
            .join("\n")
    };
    // A cable whose tension at the winch leads that at the platform
    let negative = [(0, 408, 400), (5, 440, 410), (10, 452, 420), (5, 396, 410), (0, 386, 400)];
    let negative = negative.map(|(load, winch, platform)| format!("{load},{winch},{platform}\n"));
    let negative = format!("payload_kg,t1_winch_n,t1_n\n{}", negative.concat());
    let good = rows([0.0, 20.0, 40.0, 0.0], [400.0, 410.0, 420.0, 400.0]);
    for (robot, text, pose, said) in [
        (
            &lucia,
            "payload_kg,t1_n\n0,100\n5,120\n",
            Some(&pose),
            "column t1_winch_n is missing: expected tensions",
        ),
        (
            &lucia,
            &rows([5.0; 4], [400.0; 4]),
            Some(&pose),
            "payload_kg is 5 in every row: expected two loads",
        ),
        (&lucia, &good, None, "pose is missing: expected that of the platform under the first load"),
        (
            &lucia,
            "x_m,y_m,z_m,t1_winch_n\n0,0,2,400\n",
            Some(&pose),
            "pose is given, and line 2 has a position",
        ),
        (&lucia, "x_m,y_m,z_m,t1_winch_n\n0,0,2,400\n0,,2,400\n", None, "line 3: expected the position"),
        (
            &lucia,
            "payload_kg,t1_winch_n,t1_n\n0,400,400\n5,410,\n",
            Some(&pose),
            "line 3: column t1_n is empty: expected a tension in every row",
        ),
        (
            &lucia,
            "payload_kg,t1_winch_n,dz_m\n0,400,0\n5,410,-1e-3\n",
            Some(&pose),
            "noise is not stated: expected the noise of tensions and displacements",
        ),
        (
            &lucia,
            "payload_kg,t1_winch_n\n0,400\n5,410\n",
            Some(&pose),
            "winch_tension is a list of 1: expected three or more for two coefficients",
        ),
        // Friction below zero
        (
            &lucia,
            &negative,
            Some(&pose),
            "expected tensions greater at the winch than at the platform where cable runs towards the winch",
        ),
        // Tensions at the winch that stay, whatever happens at the platform
        (
            &lucia,
            "payload_kg,t1_winch_n,t1_n\n0,400,400\n5,400,400.1\n10,400,400.2\n5,400,400.1\n0,400,400\n",
            Some(&pose),
            "wheels that stick",
        ),
    ] {
        let error = refused(robot, text, pose);
        assert!(error.contains(said), "{text}: {error}");
    }
}

#[test]
fn robots_without_pulleys_are_refused() {
    let pose = Pose::at(0.0, 0.0, 2.0);
    for name in ["caroca", "cogiro", "ipanema-1", "nist-robocrane", "four-cables", "segesta"] {
        let robot = Robot::from_library(name).unwrap();
        let error = refused(&robot, "payload_kg,t1_winch_n\n0,400\n5,410\n5,410\n0,400\n", Some(&pose));
        assert!(
            error.starts_with("pulley is missing at every cable: expected a robot with a `pulley`"),
            "{error}"
        );
    }
}
