//! Planar robots and point masses: what the platform cannot change is no measurement of the robot.

use cdpr_calibration::{
    AtWork, Calibration, CalibrationSummary, Campaign, FitSettings, Measurement, Measurements, Noise,
    Quantity, Row, Simulated, Unknowns, carry_out, drawn, fit, simulate,
};
use cdpr_robot::{Axis, CableEnd, Pose, Robot, Rotation3, UnitQuaternion, Vector3};
use cdpr_statics::Load;
use cdpr_study::{ErrorModel, uncertainties};
use std::collections::BTreeMap;

/// A table of 1 m with four cables, all in one plane.
fn table() -> Robot {
    let cable = |exit: &str, anchor: &str| {
        format!(r#"{{ "exit_point": [{exit}, 0], "anchor_point": [{anchor}, 0] }}"#)
    };
    let cables = [
        cable("0, 0", "-0.05, 0.04"),
        cable("1, 0", "0.05, 0.04"),
        cable("1, 1", "0.05, -0.04"),
        cable("0, 1", "-0.05, -0.04"),
    ];
    let text = format!(
        r#"{{ "format": "cdpr-robot/1", "name": "Table robot", "gravity": 9.81, "plane": "xy",
            "platform": {{ "mass": 1.2, "center_of_mass": [0.01, 0.005, 0] }},
            "cable": {{ "section": 6.1e-7, "youngs_modulus": 5e10, "linear_density": 0.0006 }},
            "tension_limits": {{ "min": 5, "max": 150 }}, "tension_reference": 40, "cables": [{}] }}"#,
        cables.join(", ")
    );
    Robot::from_json(&text).unwrap()
}

fn maslow() -> Robot {
    Robot::from_json(include_str!("../../../docs/how-to/planner/maslow.json")).unwrap()
}

fn model(robot: &Robot, named: &[(&str, f64)]) -> ErrorModel {
    let named: Vec<_> = named.iter().map(|(name, std)| ((*name).to_owned(), *std)).collect();
    ErrorModel::normal(robot, &uncertainties(robot, &named).unwrap())
}

const NOISE: Noise = Noise {
    position: Some(5e-5),
    rotation: Some(2e-4),
    length: Some(1e-4),
    tension: None,
    displacement: None,
    marker: None,
    swivel: None,
};

fn campaign(robot: &Robot, model: &ErrorModel, poses: &[Pose], noise: Noise) -> Vec<Row> {
    simulate(&Simulated {
        nominal: robot,
        deviations: &drawn(model, 4),
        poses,
        free: &[],
        load: Load::none(),
        noise,
        markers: &[],
        errors: &[],
        tension_at: CableEnd::Anchor,
        seed: 4,
    })
    .unwrap()
}

fn poses() -> Vec<Pose> {
    let at = |x: f64, y: f64, yaw: f64| Pose {
        position: Vector3::new(x, y, 0.0),
        rotation: Rotation3::from_euler_angles(0.0, 0.0, yaw),
    };
    let corners = [[0.25, 0.3], [0.25, 0.7], [0.7, 0.3], [0.7, 0.7]];
    let mut poses: Vec<Pose> =
        corners.iter().flat_map(|[x, y]| [-0.17, 0.17].map(|yaw| at(*x, *y, yaw))).collect();
    poses.extend([at(0.4, 0.5, 0.0), at(0.55, 0.5, 0.1)]);
    poses
}

fn summary(robot: &Robot, model: &ErrorModel, rows: Vec<Row>) -> CalibrationSummary {
    let unknowns = Unknowns::of_model(model);
    let campaign = Campaign {
        robot,
        prior: Some(model),
        unknowns: &unknowns,
        measured: &Measurements { rows, noise_is_stated: true, markers: 0, names: BTreeMap::new() },
        name: "measured.csv",
        settings: FitSettings::default(),
        folds: 0,
    };
    carry_out(&campaign, None, |_, _, _| String::new()).unwrap().summary
}

fn identifiable(of: &CalibrationSummary) -> Vec<&String> {
    of.parameters.iter().filter(|(_, of)| of.identifiable).map(|(name, _)| name).collect()
}

/// The same rows in the plane: no height, and no turn but that about its normal.
fn flat(rows: &[Row], offset: f64) -> Vec<Row> {
    let mut rows = rows.to_vec();
    for row in &mut rows {
        let turn = UnitQuaternion::from_rotation_matrix(&row.rotation.unwrap()).scaled_axis();
        row.rotation = Some(Rotation3::new(Vector3::new(0.0, 0.0, turn.z)));
        for reading in &mut row.readings {
            if reading.quantity == Quantity::Position(Axis::Z) {
                reading.value = offset;
            }
        }
    }
    rows
}

#[test]
fn noise_of_coordinates_that_are_held_decides_nothing() {
    let robot = table();
    let model = model(&robot, &[("a", 5e-4), ("b", 1e-3)]);
    let rows = campaign(&robot, &model, &poses(), NOISE);
    let measured = summary(&robot, &model, rows.clone());
    let expected = ["b1.x", "b1.y", "b2.x", "b2.y", "b3.x", "b3.y", "b4.x", "b4.y"];
    assert_eq!(identifiable(&measured), expected);
    assert!(measured.warnings.is_empty(), "{:?}", measured.warnings);
    let mut without = flat(&rows, 0.0);
    for row in &mut without {
        row.readings.retain(|of| of.quantity != Quantity::Position(Axis::Z));
    }
    // In the plane, without height, and with one that is 3 mm off.
    for rows in [flat(&rows, 0.0), without, flat(&rows, 3e-3)] {
        let other = summary(&robot, &model, rows);
        assert_eq!(identifiable(&other), expected);
        assert_eq!(other.degrees_of_freedom, measured.degrees_of_freedom);
        assert!((other.chi_square / measured.chi_square - 1.0).abs() < 0.02, "{}", other.chi_square);
        for (name, of) in &measured.parameters {
            let stds = [of.std_of_data, other.parameters[name].std_of_data];
            if let [Some(one), Some(two)] = stds {
                assert!((one / two - 1.0).abs() < 0.01, "{name}: {stds:?}");
            }
        }
    }
}

#[test]
fn a_platform_that_is_measured_out_of_its_plane_is_a_warning() {
    let robot = table();
    let model = model(&robot, &[("a", 5e-4), ("b", 1e-3)]);
    let rows = campaign(&robot, &model, &poses(), NOISE);
    let chi_square = summary(&robot, &model, rows.clone()).chi_square;
    let mut lifted = rows.clone();
    let is_height = |of: &&mut cdpr_calibration::Reading| of.quantity == Quantity::Position(Axis::Z);
    lifted[3].readings.iter_mut().find(is_height).unwrap().value += 2e-3;
    let mut tilted = rows;
    tilted[5].rotation = tilted[5].rotation.map(|of| Rotation3::new(Vector3::x() * 0.01) * of);
    for (rows, words) in [
        (lifted, "column z_m is 1.8 mm off in line 4, 36 standard deviations, though the robot cannot leave"),
        (tilted, "the orientation is 0.5"),
    ] {
        let found = summary(&robot, &model, rows);
        let [warning] = &found.warnings[..] else { panic!("{:?}", found.warnings) };
        assert!(warning.contains(words), "{warning}");
        assert!((found.chi_square / chi_square - 1.0).abs() < 0.05, "{} {chi_square}", found.chi_square);
    }
}

/// The errors of x and y by the geometry of the straight cables, `K⁻¹` of another program: 0.8896 and 0.7348
/// mm.
#[test]
fn the_coordinates_of_a_planar_robot_are_those_of_its_plane() {
    let robot = table();
    let model = model(&robot, &[("a", 5e-4), ("b", 1e-3)]);
    let nothing = [Measurement::Pose { position: 1e3, rotation: Some(1e3) }];
    let before = |at: &Pose| {
        let mut calibration = Calibration::of_model(&robot, &model).unwrap();
        calibration.add(at, &Load::none(), &nothing).unwrap();
        calibration.add_work(at, &Load::none(), AtWork::Position).unwrap();
        calibration.quality(&[0])
    };
    let found = before(&Pose::at(0.35, 0.6, 0.0));
    let (mean, worst) = (found.mean_at_work.unwrap(), found.worst_at_work.unwrap());
    let expected = ((0.8896f64.powi(2) + 0.7348f64.powi(2)) / 2.0).sqrt();
    assert!((1e3 * mean - expected).abs() < 1e-3 && (1e3 * worst - 0.8896).abs() < 1e-3, "{mean} {worst}");
    let rows = campaign(&robot, &model, &poses(), NOISE);
    let fitted = fit(&robot, &rows, &Unknowns::of_model(&model), &FitSettings::default()).unwrap();
    let squares: f64 = fitted.poses.iter().map(|at| before(at).mean_at_work.unwrap().powi(2)).sum();
    let expected = (squares / rows.len() as f64).sqrt();
    let found = summary(&robot, &model, rows).position_std_before.unwrap();
    assert!((found / expected - 1.0).abs() < 1e-2, "{found} {expected}");
}

#[test]
fn the_map_of_a_planar_robot_is_in_its_plane() {
    let robot = maslow();
    let model = model(&robot, &[("b", 3e-3)]);
    let at = [0.6, 1.2, 1.8, 2.3];
    let poses: Vec<Pose> = at.iter().flat_map(|x| [0.5, 1.0, 1.5].map(|z| Pose::at(*x, 0.0, z))).collect();
    let noise = Noise { position: Some(5e-4), length: Some(5e-4), ..Noise::default() };
    let map = summary(&robot, &model, campaign(&robot, &model, &poses, noise)).workspace.unwrap();
    assert_eq!(map.axes, [Axis::X, Axis::Z, Axis::Y]);
    assert!(map.rows[8] - map.rows[0] > 0.9 && map.at.abs() < 1e-3, "{map:?}");
    let written = serde_json::to_value(&map).unwrap();
    assert!(written["x"].is_array() && written["z"].is_array() && written["y"].is_f64(), "{written}");
    // The accuracy differs from row to row.
    let of = |row: usize| map.after[9 * row + 4].unwrap();
    assert!((of(0) / of(8) - 1.0).abs() > 1e-3, "{} {}", of(0), of(8));
}

#[test]
fn a_turn_of_a_point_mass_is_no_measurement() {
    let robot = maslow();
    let model = model(&robot, &[("b", 3e-3)]);
    let poses: Vec<Pose> = (0..8).map(|k| Pose::at(0.6 + 0.2 * f64::from(k), 0.0, 1.0)).collect();
    let noise = Noise { position: Some(5e-4), length: Some(5e-4), ..Noise::default() };
    let rows = campaign(&robot, &model, &poses, noise);
    let expected = summary(&robot, &model, rows.clone());
    let mut turned = rows;
    for row in &mut turned {
        let angle = |k| cdpr_calibration::Reading { quantity: Quantity::Angle(k), value: 0.2, std: 1e-3 };
        row.readings.extend([0, 1, 2].map(angle));
    }
    let found = summary(&robot, &model, turned);
    assert_eq!(
        (found.chi_square, found.degrees_of_freedom),
        (expected.chi_square, expected.degrees_of_freedom)
    );
    assert!(
        found.warnings.iter().any(|warning| warning.contains("the orientation is")),
        "{:?}",
        found.warnings
    );
}

#[test]
fn anchor_points_of_a_point_mass_are_no_parameters() {
    let robot = maslow();
    let model = model(&robot, &[("a", 1e-3), ("b", 3e-3)]);
    let poses: Vec<Pose> = (0..8).map(|k| Pose::at(0.6 + 0.2 * f64::from(k), 0.0, 1.0)).collect();
    let noise = Noise { position: Some(5e-4), length: Some(5e-4), ..Noise::default() };
    let rows = campaign(&robot, &model, &poses, noise);
    let unknowns = Unknowns::sought(&robot, Some(&model), &[], &[]).unwrap();
    assert!(unknowns.all.len() == 12 && unknowns.all.iter().all(|unknown| unknown.name.starts_with('b')));
    let measured = Measurements { rows, noise_is_stated: true, markers: 0, names: BTreeMap::new() };
    let prior = Some(&model);
    let (settings, name) = (FitSettings::default(), "measured.csv");
    let campaign =
        Campaign { robot: &robot, prior, unknowns: &unknowns, measured: &measured, name, settings, folds: 0 };
    let made = carry_out(&campaign, None, |_, _, _| String::new()).unwrap();
    // The robot is a robot file, and the anchor points keep their law.
    Robot::from_json(&made.robot.to_json()).unwrap();
    let index = made.posterior.parameters.iter().position(|name| name == "a1.x").unwrap();
    assert!((made.posterior.covariance[index][index] - 1e-6).abs() < 1e-15);
    assert!(Unknowns::usual(&robot).all.iter().all(|unknown| !unknown.name.starts_with('a')));
    let error = Unknowns::free(&robot, &["a"]).unwrap_err().to_string();
    assert!(error.contains("unknown is a: expected parameters of the robot"), "{error}");
}

/// Positions in the plane without a height: lengths 1 and 3, then x and y, are exchanged.
#[test]
fn columns_of_a_planar_robot_that_are_exchanged_are_named() {
    let robot = table();
    let model = model(&robot, &[("a", 5e-4), ("b", 1e-3)]);
    let mut rows = campaign(&robot, &model, &poses(), NOISE);
    for row in &mut rows {
        row.readings.retain(|of| of.quantity != Quantity::Position(Axis::Z));
    }
    let refused = |rows: &[Row]| {
        fit(&robot, rows, &Unknowns::of_model(&model), &FitSettings::default()).unwrap_err().to_string()
    };
    let mut lengths = rows.clone();
    lengths.iter_mut().for_each(|row| row.lengths.as_mut().unwrap().swap(0, 2));
    let error = refused(&lengths);
    assert!(error.contains("column l1_m and l3_m: expected them the other way round"), "{error}");
    for reading in rows.iter_mut().flat_map(|row| &mut row.readings) {
        reading.quantity = match reading.quantity {
            Quantity::Position(Axis::X) => Quantity::Position(Axis::Y),
            Quantity::Position(Axis::Y) => Quantity::Position(Axis::X),
            other => other,
        };
    }
    let error = refused(&rows);
    assert!(error.contains("column x_m and y_m: expected them the other way round"), "{error}");
}
