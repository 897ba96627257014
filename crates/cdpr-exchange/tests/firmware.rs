//! Robots for firmware: what it computes of them, by formulas of its own, is what the model says.

use cdpr_exchange::{ExchangeError, Target, export};
use cdpr_robot::library::{ROBOTS, named};
use cdpr_robot::{Plane, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{Load, inverse};
use std::collections::BTreeMap;

fn robot(name: &str) -> Robot {
    Robot::from_json(named(ROBOTS, name).unwrap().text).unwrap()
}

/// A point mass of 2 kg on four lines, the last of which ends high above it.
fn hangprinter() -> Robot {
    Robot::from_json(
        r#"{"format": "cdpr-robot/1", "name": "a\n; M112", "source": "made up", "gravity": 9.81,
        "platform": {"mass": 2, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {"section": 1e-6, "youngs_modulus": 2e10, "linear_density": 1e-3},
        "tension_limits": {"min": 5, "max": 70},
        "cables": [{"exit_point": [0, -2, -0.1], "anchor_point": [0, 0, 0]},
            {"exit_point": [2, 1, -0.1], "anchor_point": [0, 0, 0]},
            {"exit_point": [-2, 1, -0.1], "anchor_point": [0, 0, 0]},
            {"exit_point": [0, 0, 3], "anchor_point": [0, 0, 0]}]}"#,
    )
    .unwrap()
}

/// The frame of Maslow's default configuration, upright in the plane of x and z.
fn maslow() -> Robot {
    Robot::from_json(include_str!("../../../docs/how-to/planner/maslow.json")).unwrap()
}

fn text(robot: &Robot, pose: &Pose, target: Target) -> (String, Vec<String>) {
    let exported = export(robot, pose, target).unwrap();
    assert_eq!(exported.files.len(), 1);
    (exported.files[0].1.clone(), exported.notes)
}

fn refused(robot: &Robot, pose: &Pose, target: Target) -> String {
    match export(robot, pose, target) {
        Err(ExchangeError::NoPlace { field, .. }) => field,
        other => panic!("{other:?}"),
    }
}

/// Spans of a robot in millimetres.
fn distances(robot: &Robot, pose: &Pose) -> Vec<f64> {
    (0..robot.cables.len()).map(|i| 1e3 * robot.span(pose, i).norm()).collect()
}

fn close(one: &[f64], other: &[f64]) {
    assert_eq!(one.len(), other.len());
    assert!(one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-5), "{one:?} {other:?}");
}

/// `stepper_a` is the first section, and its length is the distance of its anchor from the nozzle.
#[test]
fn klipper_computes_the_distances_of_a_platform_that_keeps_its_rotation() {
    let robot = robot("cogiro");
    let rotation = Rotation3::from_euler_angles(0.0, 0.0, 0.05);
    let pose = Pose { rotation, ..Pose::at(0.5, 0.2, 2.0) };
    let (text, notes) = text(&robot, &pose, Target::Klipper);
    assert!(text.starts_with("[printer]\nkinematics: winch\n\n[stepper_a]\nanchor_x: "), "{text}");
    let sections: Vec<Vec<f64>> = text
        .split("[stepper_")
        .skip(1)
        .map(|section| {
            let values = section.lines().skip(1).filter_map(|line| line.split_once(": "));
            values.map(|(_, value)| value.parse().unwrap()).collect()
        })
        .collect();
    for position in [[0.5, 0.2, 2.0], [-1.0, 1.5, 3.0]] {
        let moved = Pose { position: position.into(), rotation };
        let nozzle = 1e3 * Vector3::from(position);
        let lengths: Vec<f64> =
            sections.iter().map(|anchor| (Vector3::from_row_slice(anchor) - nozzle).norm()).collect();
        close(&lengths, &distances(&robot, &moved));
    }
    assert!(notes.iter().any(|note| note.contains("keep the rotation of the pose")), "{notes:?}");
    // 5.2 mm of stretch and sag.
    assert!(notes.iter().any(|note| note.contains("differ from them by up to ")), "{notes:?}");
}

/// `SpringK` of the firmware at the model's tensions: what remains is sag, and the square of the strain.
#[test]
fn rrf_shortens_lines_by_their_stretch() {
    let (robot, pose) = (hangprinter(), Pose::at(0.3, -0.2, 0.5));
    let (text, notes) = text(&robot, &pose, Target::Rrf);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "M669 K6 N4 A0:-2000:-100 B2000:1000:-100 C-2000:1000:-100 D0:0:3000");
    assert_eq!(lines[1], "M666 A1 U1:1:1:1 O1:1:1:1 Y0:0:0:0");
    assert_eq!(lines[2], "M666 W2 S20000 I5:5:5:5 X70:70:70:70");
    assert_eq!(lines.len(), 3);
    let spring: f64 = lines[2].split(' ').find_map(|word| word.strip_prefix('S')).unwrap().parse().unwrap();
    let solution = inverse(&robot, &pose, &Load::none()).unwrap();
    let mut stretched = 0.0_f64;
    for (i, distance) in distances(&robot, &pose).into_iter().enumerate() {
        let (tension, length) = (solution.tensions[i], 1e3 * solution.lengths[i]);
        let relaxed = distance - tension / (spring / distance);
        assert!((relaxed - length).abs() < 0.02, "{i}: {relaxed} {length}");
        stretched = stretched.max(distance - length);
    }
    assert!(stretched > 2.0, "{stretched}");
    assert!(notes.iter().any(|note| note.contains("sag has no place")), "{notes:?}");
}

#[test]
fn rrf_has_no_stretch_where_all_lines_end_at_one_height() {
    let camera = Robot::from_json(include_str!("../../../docs/how-to/planner/stadium.json")).unwrap();
    let (text, notes) = text(&camera, &Pose::at(0.0, 0.0, 14.0), Target::Rrf);
    assert!(text.contains("M666 A2 ") && text.contains("N4 A-50000:-35000:30000 B50000"), "{text}");
    assert!(notes.iter().any(|note| note.contains("it has neither for this robot")), "{notes:?}");
}

/// The belts' lengths by `computeTL` and the other three of MaslowKinematics.cpp.
#[test]
fn maslow_computes_the_distances_from_the_corners() {
    let robot = maslow();
    let pose = Pose::at(1.4, 0.0, 1.0);
    let (text, notes) = text(&robot, &pose, Target::Maslow);
    let values: BTreeMap<&str, f64> = text
        .lines()
        .filter_map(|line| line.trim().split_once(": "))
        .filter(|(name, _)| !name.starts_with('#'))
        .map(|(name, value)| (name, value.parse().unwrap()))
        .collect();
    for (name, value) in [("tlX", -27.6), ("tlY", 2064.9), ("tlZ", 100.0), ("trX", 2924.3), ("brX", 2953.2)] {
        assert_eq!(values[name], value, "{name}");
    }
    assert_eq!([values["blX"], values["blY"], values["brY"]], [0.0; 3]);
    assert!(text.contains("    # beltAxialStiffness: 178900\n    # sledWeight: 86.328\n"), "{text}");
    // calculateCenter
    let a = (values["trY"] - values["blY"]) / (values["trX"] - values["blX"]);
    let b = (values["brY"] - values["tlY"]) / (values["brX"] - values["tlX"]);
    let x = (values["brY"] - b * values["brX"] + a * values["trX"] - values["trY"]) / (a - b);
    let y = a * (x - values["trX"]) + values["trY"];
    let origin = notes.iter().find(|note| note.contains("where the diagonals cross")).unwrap();
    let said: Vec<f64> = origin.split(['(', ')', ',']).filter_map(|word| word.trim().parse().ok()).collect();
    // In metres to six decimals.
    let apart = [1e3 * said[0] - x, 1e3 * said[1], 1e3 * said[2] - y];
    assert!(apart.iter().all(|apart| apart.abs() < 1e-3), "{origin} {x} {y}");
    for [u, v] in [[0.0, 0.0], [700.0, -600.0], [-1200.0, 800.0]] {
        let length = |name: &str| {
            let [cx, cy, cz] = ["X", "Y", "Z"].map(|axis| values[format!("{name}{axis}").as_str()]);
            let arms = values["armLength"] + values["beltEndExtension"];
            (((cx - u - x).hypot(cy - v - y) - arms).powi(2) + cz.powi(2)).sqrt()
        };
        let moved = Pose::at(1e-3 * (u + x), 0.0, 1e-3 * (v + y));
        let lengths = ["tl", "tr", "bl", "br"].map(length);
        close(&lengths, &distances(&robot, &moved));
    }
}

/// The corners are found by where they are, and a frame that is tilted is turned back.
#[test]
fn maslows_corners_are_found_whatever_the_order_of_the_cables_and_the_plane() {
    let flat = |order: [usize; 4], tilt: f64| {
        let mut robot = maslow();
        let cables = robot.cables.clone();
        robot.cables = order.map(|i| cables[i].clone()).into();
        robot.plane = Some(Plane::Xy);
        let turn = Rotation3::from_euler_angles(0.0, 0.0, tilt);
        for cable in &mut robot.cables {
            let [x, y, z] = cable.exit_point.into();
            cable.exit_point = turn * Vector3::new(x, z, -y) + Vector3::new(0.3, -0.2, 0.0);
        }
        let center = turn * Vector3::new(1.4, 1.0, 0.0) + Vector3::new(0.3, -0.2, 0.0);
        let pose = Pose { position: center, rotation: Rotation3::identity() };
        text(&robot, &pose, Target::Maslow).0
    };
    let upright = text(&maslow(), &Pose::at(1.4, 0.0, 1.0), Target::Maslow).0;
    assert_eq!(flat([0, 1, 2, 3], 0.0), upright);
    assert_eq!(flat([3, 1, 0, 2], 0.0), upright);
    let tilted = flat([2, 0, 3, 1], 0.02);
    for (one, other) in tilted.lines().zip(upright.lines()) {
        let number = |line: &str| line.rsplit(' ').next().and_then(|word| word.parse::<f64>().ok());
        match (number(one), number(other)) {
            (Some(one), Some(other)) => assert!((one - other).abs() < 2e-6, "{one} {other}"),
            _ => assert_eq!(one, other),
        }
    }
}

/// The X axis of the firmware is the lower side of the frame, wherever that points.
#[test]
fn a_note_says_where_the_x_axis_of_maslow_points_unless_it_is_that_of_the_robot() {
    let zero = |robot: &Robot| {
        let notes = text(robot, &Pose::at(1.4, 0.0, 1.0), Target::Maslow).1;
        notes.into_iter().find(|note| note.contains("where the diagonals cross")).unwrap()
    };
    assert!(!zero(&maslow()).contains("X axis"), "{}", zero(&maslow()));
    let mut turned = maslow();
    // The lowest two corners, the right one 80 mm lower.
    let lowest = turned.cables.iter().map(|cable| cable.exit_point.z).fold(f64::INFINITY, f64::min);
    let mut lower: Vec<_> =
        turned.cables.iter_mut().filter(|cable| cable.exit_point.z < lowest + 0.5).collect();
    lower.sort_by(|a, b| a.exit_point.x.total_cmp(&b.exit_point.x));
    lower[1].exit_point.z -= 0.08;
    let mut along = lower[1].exit_point - lower[0].exit_point;
    along.y = 0.0; // Across its plane.
    let said = zero(&turned);
    let (_, axis) = said.split_once("its X axis points along (").unwrap();
    let axis: Vec<f64> = axis.split([',', ')']).filter_map(|word| word.trim().parse().ok()).collect();
    let expected = along / along.norm();
    assert!((Vector3::from_row_slice(&axis[..3]) - expected).norm() < 2e-6, "{said} {expected}");
}

#[test]
fn names_of_robots_cannot_become_commands() {
    for (robot, pose, target) in [
        (hangprinter(), Pose::at(0.0, 0.0, 0.5), Target::Klipper),
        (hangprinter(), Pose::at(0.0, 0.0, 0.5), Target::Rrf),
        (maslow(), Pose::at(1.4, 0.0, 1.0), Target::Maslow),
    ] {
        let named = Robot { name: "x\nM112\n[stepper_z]\n".to_owned(), ..robot.clone() };
        assert_eq!(export(&named, &pose, target).unwrap(), export(&robot, &pose, target).unwrap());
    }
}

#[test]
fn what_firmware_has_no_place_for_is_refused_by_its_field() {
    let low = Pose::at(0.0, 0.0, 0.5);
    let ipanema = robot("ipanema-3");
    assert_eq!(refused(&ipanema, &Pose::at(0.0, 0.0, 1.3), Target::Klipper), "cables[0].pulley");
    assert_eq!(refused(&robot("cogiro"), &Pose::at(0.0, 0.0, 2.0), Target::Rrf), "cables");
    assert_eq!(refused(&hangprinter(), &low, Target::Maslow), "plane");
    let with = |change: fn(&mut Robot)| {
        let mut robot = hangprinter();
        change(&mut robot);
        robot
    };
    let led = with(|robot| robot.cables[2].lead = 0.5);
    assert_eq!(refused(&led, &low, Target::Klipper), "cables[2].lead");
    let two = with(|robot| robot.cables.truncate(2));
    assert_eq!(refused(&two, &low, Target::Klipper), "cables");
    let soft = with(|robot| robot.cables[1].properties.youngs_modulus *= 0.5);
    assert_eq!(refused(&soft, &low, Target::Rrf), "cables[1].cable");
    let tilted = with(|robot| robot.gravity = Vector3::new(1.0, 0.0, -9.7).into());
    assert_eq!(refused(&tilted, &low, Target::Rrf), "gravity");
    let mut wide = maslow();
    wide.cables.iter_mut().for_each(|cable| cable.exit_point *= 4.0);
    assert_eq!(refused(&wide, &Pose::at(5.6, 0.0, 4.0), Target::Maslow), "cables");
    let mut five = maslow();
    five.cables.push(five.cables[0].clone());
    assert_eq!(refused(&five, &Pose::at(1.4, 0.0, 1.0), Target::Maslow), "cables");
    // A pose outside of the frame is not held.
    let outside = export(&hangprinter(), &Pose::at(5.0, 0.0, 0.5), Target::Klipper);
    assert!(matches!(outside, Err(ExchangeError::Pose(_))), "{outside:?}");
}
