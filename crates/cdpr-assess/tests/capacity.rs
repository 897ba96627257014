//! What a robot can carry, how far tensions are from their limits, how near cables come: against an
//! independent program, and each way against the models.

use cdpr_assess::{Block, WrenchSet, capacity_at, clearance_at};
use cdpr_evidence::accept;
use cdpr_robot::{Coordinate, Pose, Robot, Rotation3, Vector3, Vector6, Wrench};
use cdpr_statics::free_coordinates::free_solutions;
use cdpr_statics::limits::Limit;
use cdpr_statics::{Load, StaticsError, WantedPose, deflection, inverse};
use serde_json::Value;

fn cogiro() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap()
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|k| value[k].as_f64().unwrap())
}

/// The 20 poses of `data/reference/capacity.json`.
fn poses() -> (Value, Vec<(Pose, Value)>) {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/capacity.json")).unwrap();
    let pose = |row: &Value| {
        let [x, y, z] = numbers(&row["position"]);
        let [roll, pitch, yaw] = numbers(&row["roll_pitch_yaw_deg"]).map(f64::to_radians);
        let rotation = Rotation3::from_euler_angles(roll, pitch, yaw);
        (Pose { position: Vector3::new(x, y, z), rotation }, row.clone())
    };
    let poses: Vec<_> = file["poses"].as_array().unwrap().iter().map(pose).collect();
    (file, poses)
}

#[test]
fn of_weightless_cables_the_figures_are_those_of_the_linear_program() {
    let (file, poses) = poses();
    let mut robot = cogiro();
    robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.0);
    let alone = WrenchSet::of(Vec::new());
    let boxed = alone.widened(&Wrench::from_vector(&Vector6::from(numbers(&file["box"]))));
    assert_eq!((poses.len(), boxed.wrenches().len()), (20, 64));
    let mut worst = [0.0_f64; 3];
    for (pose, row) in &poses {
        let found = capacity_at(&robot, pose, &Load::none(), &alone);
        let margin = capacity_at(&robot, pose, &Load::none(), &boxed).margin_recomputed;
        let figures = [found.payload_recomputed, found.margin_recomputed, margin];
        let names = ["straight_payload", "straight_margin", "straight_box_margin"];
        for ((figure, name), worst) in figures.into_iter().zip(names).zip(&mut worst) {
            let exact = row[name].as_f64().unwrap();
            *worst = worst.max((figure.unwrap().value / exact - 1.0).abs());
        }
    }
    ["V-CAPACITY-001", "V-CAPACITY-002", "V-CAPACITY-003"]
        .into_iter()
        .zip(worst)
        .for_each(|(id, off)| accept(id, off));
}

#[test]
fn of_sagging_cables_payload_and_distances_are_those_of_an_independent_program() {
    let (_, poses) = poses();
    let robot = cogiro();
    let (mut payloads, mut distances) = (0.0_f64, 0.0_f64);
    for (pose, row) in &poses {
        let found = capacity_at(&robot, pose, &Load::none(), &WrenchSet::of(Vec::new()));
        let exact = row["payload"].as_f64().unwrap();
        let payload = found.payload_recomputed.unwrap().value;
        payloads = payloads.max((payload / exact - 1.0).abs());
        assert!(payload < row["straight_payload"].as_f64().unwrap());

        let held = inverse(&robot, pose, &Load::none()).unwrap();
        let row = &row["distances"];
        for (tension, exact) in held.tensions.iter().zip(row["tensions"].as_array().unwrap()) {
            assert!((tension / exact.as_f64().unwrap() - 1.0).abs() < 1e-6);
        }
        let clearance = clearance_at(&robot, &held.lengths, &held.equilibrium).unwrap();
        let (cables, platform) = (clearance.cables.unwrap(), clearance.platform.unwrap());
        // The program has axes, the cables are 4 mm thick.
        distances = distances.max((cables.distance + 0.004 - row["cables"].as_f64().unwrap()).abs());
        distances = distances.max((platform.distance + 0.002 - row["hull"].as_f64().unwrap()).abs());
        assert_eq!(cables.pair.map(|i| i as u64 + 1), numbers(&row["pair"]).map(|i: f64| i as u64));
        assert_eq!(platform.cable as u64 + 1, row["hull_cable"].as_u64().unwrap());
    }
    accept("V-CAPACITY-004", payloads);
    accept("V-CAPACITY-005", distances);
}

#[test]
fn with_the_lengths_kept_the_payload_ends_where_a_tension_reaches_its_limit() {
    let ipanema = Robot::from_json(include_str!("../../../data/robots/ipanema-3.json")).unwrap();
    for (robot, pose) in [(cogiro(), Pose::at(0.5, -0.3, 1.5)), (ipanema, Pose::at(0.2, 0.1, 1.3))] {
        let found = capacity_at(&robot, pose, &Load::none(), &WrenchSet::of(Vec::new()));
        let tensions = |payload: f64| {
            let found = deflection(&robot, &pose, &Load::payload(payload)).unwrap();
            found.loaded.equilibrium.tensions()
        };
        for figure in [found.payload_kept.as_ref(), found.payload_kept_slack.as_ref()] {
            let figure = figure.unwrap();
            let [Block::Limit { cable, limit, value, .. }] = figure.blocking[..] else {
                panic!("{figure:?}")
            };
            println!("{}: {} kg, cable {} at {limit:?}", robot.name, figure.value, cable + 1);
            assert!((tensions(figure.value)[cable] / value - 1.0).abs() < 1e-7);
            assert!(limit != Limit::Min || tensions(figure.value + 1.0)[cable] < value);
        }
        let payload = found.payload_kept_slack.unwrap().value;
        assert!(payload >= found.payload_kept.unwrap().value);
        // Payloads are those of two poses, because the platform yields; margins are those of one.
        assert!(found.margin_recomputed.unwrap().value > found.margin_kept.unwrap().value);
    }
}

#[test]
fn with_free_coordinates_the_payload_ends_where_a_tension_reaches_its_limit() {
    let robot = Robot::from_json(include_str!("../../../data/robots/four-cables.json")).unwrap();
    let free = [Coordinate::Roll, Coordinate::Pitch];
    let set = WrenchSet::of(Vec::new());
    for pose in [Pose::at(0.5, 0.3, 2.0), Pose::at(0.4, 0.2, 1.5)] {
        let found = capacity_at(&robot, WantedPose::at(&pose).free(&free), &Load::none(), &set)
            .payload_recomputed
            .unwrap();
        let [Block::Limit { cable, limit: Limit::Max, value, .. }] = found.blocking[..] else {
            panic!("{found:?}")
        };
        println!("{} kg, {}", found.value, found.blocked_by());
        assert!(found.value > 3.0 * robot.platform.mass);
        let rests = free_solutions(
            &robot,
            WantedPose::at(&pose).free(&free),
            &Load::payload(found.value * (1.0 - 1e-9)),
        )
        .unwrap();
        assert!((rests.first.tensions[cable] / value - 1.0).abs() < 1e-6, "{found:?}");
    }
}

#[test]
fn a_payload_that_is_rounding_is_zero() {
    // The greatest tension of a cable is what it has already.
    let pose = Pose::at(0.3, 0.2, 1.5);
    let mut robot = cogiro();
    let held = inverse(&robot, &pose, &Load::none()).unwrap();
    let steepest = held.tensions.iter().copied().fold(0.0, f64::max);
    for cable in &mut robot.cables {
        cable.tension_limits.max = Some(steepest);
    }
    let found = capacity_at(&robot, pose, &Load::none(), &WrenchSet::of(Vec::new()));
    assert_eq!(found.payload_kept.unwrap().value, 0.0);
    // So is the least one of a cable.
    let ipanema = Robot::from_json(include_str!("../../../data/robots/ipanema-3.json")).unwrap();
    let pose = Pose::at(0.2, 0.1, 1.3);
    let found = capacity_at(&ipanema, pose, &Load::none(), &WrenchSet::of(Vec::new()));
    assert_eq!(found.payload_kept.unwrap().value, 0.0);
}

#[test]
fn few_cables_points_and_planes_have_a_capacity_or_say_why_not() {
    let mut few = cogiro();
    few.cables = [1, 3, 5, 7].map(|i| few.cables[i].clone()).to_vec();
    let set = WrenchSet::of(Vec::new());
    let pose = Pose::at(0.3, 0.2, 2.0);
    let refused = capacity_at(&few, pose, &Load::none(), &set).payload_recomputed.unwrap_err();
    assert!(matches!(refused, StaticsError::FreeCoordinates { cables: 4, .. }));
    let free = [Coordinate::Roll, Coordinate::Yaw];
    let found = capacity_at(&few, WantedPose::at(&pose).free(&free), &Load::none(), &set);
    // No stable solution has this pose.
    assert!(matches!(found.payload_kept, Err(StaticsError::Unstable { .. })));
    let payload = found.payload_recomputed.unwrap();
    let Block::Limit { cable, limit: Limit::Max, value, .. } = payload.blocking[0] else { panic!() };
    let rests =
        free_solutions(&few, WantedPose::at(&pose).free(&free), &Load::payload(payload.value)).unwrap();
    let mut rests = [rests.first].into_iter().chain(rests.others);
    assert!(rests.any(|rest| (rest.tensions[cable] / value - 1.0).abs() < 1e-7), "{payload:?}");

    let mut point = cogiro();
    point.cables = [0, 2, 4, 6].map(|i| point.cables[i].clone()).to_vec();
    point.cables.iter_mut().for_each(|cable| cable.anchor_point = Vector3::zeros());
    point.platform.point = true;
    let found = capacity_at(&point, pose, &Load::none(), &set);
    assert!(found.payload_recomputed.unwrap().value > 100.0 && found.margin_recomputed.unwrap().value > 0.0);
    let held = inverse(&point, &pose, &Load::none()).unwrap();
    let clearance = clearance_at(&point, &held.lengths, &held.equilibrium).unwrap();
    assert_eq!((clearance.cables, clearance.platform), (None, None));
}
