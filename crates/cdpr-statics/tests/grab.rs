//! GRAB, a prototype with four cables over horizontal swivel axes: equilibria and natural frequencies next to
//! what motion capture recorded (`data/reference/grab.json`, docs/grab.md).

use crate::equilibria::{number, vector};
use cdpr_evidence::accept;
use cdpr_robot::{Coordinate, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::error::RestFault;
use cdpr_statics::free_coordinates::free_solutions;
use cdpr_statics::{DirectProblem, DirectStart, Load, StaticsError, WantedPose, deflection};
use serde_json::Value;
use std::fmt::Write;

fn grab() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/grab.json")).unwrap()
}

/// R = Rx Ry Rz.
fn pose(record: &Value) -> Pose {
    let angles = vector(&record["angles"]);
    let about = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
    Pose {
        position: vector(&record["position"]),
        rotation: about(Vector3::x_axis(), angles.x)
            * about(Vector3::y_axis(), angles.y)
            * about(Vector3::z_axis(), angles.z),
    }
}

/// Lengths of straight cables at a pose: cables that are rigid and have no weight.
fn lengths(robot: &Robot, pose: &Pose) -> Vec<f64> {
    let level = *robot.gravity.level().unwrap();
    (0..4).map(|i| robot.cable(i).straight_length_in_space(level * robot.span(pose, i))).collect()
}

/// Pose of the equilibrium near a pose, and the two lowest frequencies [Hz].
fn found(robot: &Robot, lengths: &[f64], start: &Pose) -> (Pose, [f64; 2]) {
    let load = Load::none();
    let problem = DirectProblem::new(robot, lengths, &load).unwrap();
    let held = problem.direct(DirectStart::Pose(start)).unwrap();
    let modes = problem.modes(&held.equilibrium).unwrap();
    (held.equilibrium.pose, [modes[0].frequency, modes[1].frequency])
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 { values[middle] } else { 0.5 * (values[middle - 1] + values[middle]) }
}

#[test]
fn the_frequencies_of_a_prototype_are_those_that_motion_capture_recorded() {
    let robot = grab();
    let records: Value = serde_json::from_str(include_str!("../../../data/reference/grab.json")).unwrap();
    let mut errors: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    let mut off: f64 = 0.0;
    let mut table = String::from(
        "| record | from the mean pose [mm, °] | f1 [Hz] | measured | | f2 [Hz] | measured | | power ratio |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for record in records["records"].as_array().unwrap() {
        let mean = pose(record);
        let (rest, frequencies) = found(&robot, &lengths(&robot, &mean), &mean);
        let motion = mean.motion_to(&rest);
        let (away, turned) = (motion.fixed_rows::<3>(0).norm(), motion.fixed_rows::<3>(3).norm());
        let ratio = number(&record["power_ratio"]);
        let excited = ratio > 0.02;
        let [first, second] = [0, 1].map(|k| {
            let measured = number(&record["measured_hz"][k]);
            let error = 100.0 * (frequencies[k] / measured - 1.0);
            if excited {
                errors[k].push(error);
            }
            off = off.max((frequencies[k] - number(&record["model_hz"][k])).abs());
            format!("{:.3} | {measured:.3} | {error:+.1} %", frequencies[k])
        });
        let (away, turned) = (1e3 * away, turned.to_degrees());
        let place = format!("{away:.1}, {turned:.2}");
        writeln!(table, "| {} | {place} | {first} | {second} | {ratio:.3} |", record["record"]).unwrap();
        assert!(away < 30.0 && turned < 3.0, "{}: {away} mm {turned}°", record["record"]);
    }
    let [first, second] = errors;
    assert_eq!(first.len(), 24);
    let size = |errors: &[f64]| -> Vec<f64> { errors.iter().map(|error| error.abs()).collect() };
    table += "\n24 records with a power ratio above 0.02:\n\n| | median of the error's size | worst | median of the \
              error |\n|---|---|---|---|\n";
    for (name, errors) in [("f1", &first), ("f2", &second)] {
        let worst = size(errors).into_iter().fold(0.0, f64::max);
        let medians = [median(size(errors)), median(errors.clone())];
        writeln!(table, "| {name} | {:.2} % | {worst:.1} % | {:+.2} % |", medians[0], medians[1]).unwrap();
        let k = usize::from(name == "f2");
        accept(["V-MOTION-013", "V-MOTION-014"][k], median(size(errors)));
        accept("V-MOTION-015", worst);
    }
    accept("V-MOTION-016", off);
    // Without pulleys the error is larger by half and more.
    let mut plain = robot.clone();
    plain.cables.iter_mut().for_each(|cable| cable.pulley = None);
    let worse: Vec<f64> = records["records"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|record| number(&record["power_ratio"]) > 0.02)
        .map(|record| {
            let (_, frequencies) = found(&plain, &lengths(&plain, &pose(record)), &pose(record));
            100.0 * (frequencies[0] / number(&record["measured_hz"][0]) - 1.0).abs()
        })
        .collect();
    let worse = median(worse);
    writeln!(table, "\nWithout the pulleys the median of the error's size of f1 is {worse:.2} %.").unwrap();
    assert!(worse > 1.5 * median(size(&first)));
    kept(&table);
}

/// Compares the table of docs/grab.md; `INSTA_UPDATE=always` writes it.
fn kept(table: &str) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/evidence/grab.md");
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        std::fs::write(path, table).unwrap();
    }
    let kept = std::fs::read_to_string(path).unwrap();
    for (line, kept) in table.lines().zip(kept.lines()) {
        assert_eq!(line, kept, "data/evidence/grab.md; INSTA_UPDATE=always writes it");
    }
    assert_eq!(table.lines().count(), kept.lines().count());
}

#[test]
fn lengths_averaged_over_a_record_give_the_frequencies_of_20_digits() {
    let robot = grab();
    let cases: Value = serde_json::from_str(include_str!("../../../data/reference/modes.json")).unwrap();
    let grab = cases["cases"].as_array().unwrap().iter().filter(|case| case["kind"] == "grab");
    let mut compared = 0;
    for case in grab {
        let expected = &case["record_mean"];
        let lengths: Vec<f64> =
            expected["unstrained_lengths"].as_array().unwrap().iter().map(number).collect();
        let start = Pose {
            position: vector(&case["position"]),
            rotation: crate::reference::rotation(&case["rotation"]),
        };
        let (pose, frequencies) = found(&robot, &lengths, &start);
        assert!((pose.position - vector(&expected["position"])).norm() < 1e-9);
        for (k, frequency) in frequencies.iter().enumerate() {
            let exact = number(&expected["frequencies_hz"][k]);
            assert!((frequency / exact - 1.0).abs() < 1e-8, "{}: {frequency} {exact}", case["record"]);
        }
        compared += 1;
    }
    assert_eq!(compared, 6);
}

#[test]
fn a_pose_that_is_held_upside_down_alone_is_refused() {
    let (robot, free) = (grab(), [Coordinate::Roll, Coordinate::Pitch]);
    let at = |x, y| Pose::at(x, y, -0.92);
    let load = Load::payload(0.5);
    let near_the_middle = deflection(&robot, WantedPose::at(&at(1.36, 0.06)).free(&free), &load).unwrap();
    assert!(near_the_middle.unloaded.stability.is_stable());
    // The only solutions from 49 x 32 starts have the platform turned over.
    for (x, y) in [(0.1, 0.48), (0.52, -0.78), (1.36, 0.48), (1.78, -1.2)] {
        let only = free_solutions(&robot, WantedPose::at(&at(x, y)).free(&free), &Load::none()).unwrap_err();
        let StaticsError::NoRest { nearest: RestFault::TurnedOver { angle, .. }, .. } = only else {
            panic!("{only}")
        };
        assert!(angle > 2.0, "{x}, {y}: {angle}");
        let error = deflection(&robot, WantedPose::at(&at(x, y)).free(&free), &load).unwrap_err();
        assert_eq!(error, only);
    }
}

/// A cable without weight that carries nothing is slack, over a pulley, too.
#[test]
fn a_slack_cable_of_three_carries_nothing_at_its_exit() {
    let mut robot = grab();
    robot.cables.remove(2);
    let lengths = [1.4099167065036977, 1.2698086609156398, 1.3544342314307407];
    let pose = cdpr_robot::Pose::at(1.29, -0.11, 0.0);
    let start = cdpr_statics::DirectStart::Pose(&pose);
    let found = cdpr_statics::direct(&robot, &lengths, &cdpr_statics::Load::none(), start).unwrap();
    assert_eq!(found.report.slack, [0]);
    let exits = found.equilibrium.exit_tensions(&robot, &lengths);
    assert!(exits[0] == 0.0 && exits[1] > 1.0 && exits[2] > 1.0, "{exits:?}");
}
