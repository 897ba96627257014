//! Platforms whose cables hang in the wind.

use crate::common::{caroca, robots};
use crate::equilibria::{self, number, vector};
use cdpr_evidence::accept;
use cdpr_robot::{Matrix3, Pose, Robot, Rotation3, Vector3, Wrench};
use cdpr_statics::weather::{RestInWeather, Weather, Wind, WindProfile, in_weather};
use cdpr_statics::{Deflection, DirectProblem, DirectStart, Load, StaticsError, deflection, direct};
use serde_json::Value;

pub(crate) fn named(name: &str) -> Robot {
    let path = format!("{}/../../data/robots/{name}.json", env!("CARGO_MANIFEST_DIR"));
    Robot::from_json(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// [`robots`], whose cables have the diameters of full circles where they have none.
fn robots_with_diameters() -> [(Robot, Pose); 5] {
    let mut all = robots();
    for cable in all.iter_mut().flat_map(|(robot, _)| &mut robot.cables) {
        let full = (4.0 * cable.properties.section / std::f64::consts::PI).sqrt();
        cable.properties.diameter.get_or_insert(full);
    }
    all
}

/// The rest without wind and under `load`, and the one in the wind.
fn blown(robot: &Robot, pose: &Pose, load: &Load, velocity: Vector3<f64>) -> (Deflection, RestInWeather) {
    let still = deflection(robot, pose, load).unwrap();
    let problem = DirectProblem::new(robot, &still.lengths, load).unwrap();
    let rest = problem.in_wind(&Wind::new(velocity).unwrap(), &still.loaded).unwrap();
    (still, rest)
}

#[test]
fn platforms_rest_where_an_independent_integration_has_them() {
    let reference: Value = serde_json::from_str(include_str!("../../../data/reference/wind.json")).unwrap();
    let cases = reference["robots"].as_array().unwrap();
    assert_eq!(cases.len(), 5);
    for case in cases {
        let mut robot = equilibria::robot(case);
        robot.platform.point = case["point"].as_bool().unwrap();
        for cable in &mut robot.cables {
            cable.properties.diameter = Some(number(&case["diameter"]));
        }
        let numbers = |key: &str| serde_json::from_value::<Vec<f64>>(case[key].clone()).unwrap();
        let pose = |of: &Value, position: &str, rotation: &str| {
            let rows: [[f64; 3]; 3] = serde_json::from_value(of[rotation].clone()).unwrap();
            let rotation = Rotation3::from_matrix(&Matrix3::from(rows).transpose());
            Pose { position: vector(&of[position]), rotation }
        };
        let mut wind = Wind::new(vector(&case["wind"])).unwrap();
        if let Ok([roughness, reference]) = serde_json::from_value::<[f64; 2]>(case["profile"].clone()) {
            wind = wind.over_height(WindProfile { roughness, reference }).unwrap();
        }
        let windy = Weather { wind, ..Weather::default() };
        let near = pose(case, "start_position", "start_rotation");
        let mut in_both = vec![(windy, case)];
        if !case["weather"].is_null() {
            let [warmer, cable_expansion, frame_expansion, ice, creep] =
                ["warmer", "cable_expansion", "frame_expansion", "ice", "creep"]
                    .map(|name| number(&case["weather"][name]));
            let hot = Weather { wind, warmer, cable_expansion, frame_expansion, ice, creep };
            in_both.push((hot, &case["in_weather"]));
        }
        for (weather, known) in in_both {
            let changed = weather.robot(&robot).unwrap();
            let lengths = weather.lengths(&numbers("unstrained_lengths"));
            let still = direct(&changed, &lengths, &Load::none(), DirectStart::Pose(&near)).unwrap();
            let problem = DirectProblem::new(&changed, &lengths, &Load::none()).unwrap();
            let rest = problem.in_wind(&wind, &still).unwrap();
            let apart = rest.pose.motion_to(&pose(known, "position", "rotation"));
            accept("V-DIRECT-014", apart.fixed_rows::<3>(0).norm());
            assert!(apart.fixed_rows::<3>(3).norm() < 1e-7, "{}: {apart}", robot.name);
            let tensions = serde_json::from_value::<Vec<f64>>(known["tensions"].clone()).unwrap();
            for (tension, known) in rest.tensions().iter().zip(tensions) {
                assert!((tension - known).abs() < 1e-5 * known, "{}: {tension}, {known}", robot.name);
            }
        }
    }
}

#[test]
fn no_wind_moves_nothing() {
    for (robot, pose) in robots_with_diameters() {
        let (still, rest) = blown(&robot, &pose, &Load::none(), Vector3::zeros());
        let moved = still.loaded.equilibrium.pose.motion_to(&rest.pose).norm();
        assert!(moved < 1e-9, "{}: {moved}", robot.name);
        assert!(rest.drags.iter().all(|drag| drag.norm() < 1e-6), "{}", robot.name);
    }
}

/// The balance of platform and cables as one body: what the exit points bear is all weight and drag.
#[test]
fn residuals_are_small_and_forces_in_balance() {
    let load =
        Load { payload: 5.0, wrench: Wrench { force: [3.0, -2.0, 1.0].into(), moment: Vector3::zeros() } };
    for (robot, pose) in robots_with_diameters() {
        for velocity in [[15.0, 0.0, 0.0], [-9.0, 12.0, 4.0]] {
            let (_, rest) = blown(&robot, &pose, &load, velocity.into());
            let tensions: f64 = rest.tensions().iter().sum();
            assert!(rest.residual.force < 1e-8 * tensions, "{}: {:?}", robot.name, rest.residual);
            assert!(rest.residual.closure < 1e-9 && rest.integration < 1e-8, "{}", robot.name);
            let weight = robot.weight(&rest.pose, load.payload).force + load.wrench.force;
            let open = rest.forces.iter().sum::<Vector3<f64>>() + weight;
            assert!(open.norm() < 1e-8 * tensions, "{}: {open}", robot.name);
        }
    }
}

/// A cable that the wind carries up has no shape near the one it had in a quarter less drag: the drag is then
/// raised in smaller steps, and the rest turns with the wind as steadily as before.
#[test]
fn a_storm_is_raised_in_steps_as_small_as_it_needs() {
    let path = format!("{}/../../docs/how-to/broken-cable/stadium.json", env!("CARGO_MANIFEST_DIR"));
    let stadium = Robot::from_json(&std::fs::read_to_string(path).unwrap()).unwrap();
    let pose = Pose::at(20.0, 10.0, 12.0);
    let place = |degrees: i32| {
        let towards = f64::from(degrees).to_radians();
        let velocity = Vector3::new(towards.cos(), towards.sin(), 0.0) * 40.0;
        let (_, rest) = blown(&stadium, &pose, &Load::none(), velocity);
        assert!(rest.residual.force < 1e-6 && rest.residual.closure < 1e-9, "{degrees}: {:?}", rest.residual);
        rest.pose.position
    };
    let places: Vec<_> = (25..=32).map(place).collect();
    for three in places.windows(3) {
        let bend = three[0] - three[1] * 2.0 + three[2];
        assert!(bend.norm() < 0.05 * (three[2] - three[0]).norm(), "{three:?}");
    }
}

/// The drag of twice the wind is four times as great, and little of it moves a taut robot in proportion: by
/// the part that the platform bears, and by what it adds to the sag.
#[test]
fn light_wind_moves_a_taut_robot_in_proportion_to_the_drag() {
    let (robot, pose) = (caroca(), Pose::at(0.4, -0.3, 1.6));
    let moved = |speed: f64| {
        let (still, rest) = blown(&robot, &pose, &Load::none(), Vector3::new(speed, 0.0, 0.0));
        still.unloaded.equilibrium.pose.motion_to(&rest.pose)
    };
    let (light, double) = (moved(1.5), moved(3.0));
    assert!(light[0] > 1e-8, "{light}");
    assert!((double - 4.0 * light).norm() < 0.02 * double.norm(), "{light} {double}");
}

#[test]
fn a_robot_that_is_turned_with_its_wind_rests_in_the_same_way() {
    let robot = named("cogiro");
    let pose = Pose::at(1.0, -0.5, 2.0);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.7);
    let mut turned = robot.clone();
    turned.cables.iter_mut().for_each(|cable| cable.exit_point = turn * cable.exit_point);
    let velocity = Vector3::new(12.0, 5.0, 1.0);
    let (_, rest) = blown(&robot, &pose, &Load::payload(20.0), velocity);
    let pose = Pose { position: turn * pose.position, rotation: turn * pose.rotation };
    let (_, other) = blown(&turned, &pose, &Load::payload(20.0), turn * velocity);
    let expected = Pose { position: turn * rest.pose.position, rotation: turn * rest.pose.rotation };
    let apart = expected.motion_to(&other.pose).norm();
    assert!(apart < 1e-8, "{apart}");
}

#[test]
fn cables_over_pulleys_keep_the_length_that_is_wound_on_them() {
    let robot = named("expo2015-lucia");
    let pose = Pose::at(0.0, 0.0, 1.0);
    let (still, rest) = blown(&robot, &pose, &Load::none(), Vector3::zeros());
    let moved = still.unloaded.equilibrium.pose.motion_to(&rest.pose).norm();
    assert!(moved < 1e-9, "{moved}");
    let (_, rest) = blown(&robot, &pose, &Load::none(), Vector3::new(10.0, 0.0, 0.0));
    let moved = still.unloaded.equilibrium.pose.motion_to(&rest.pose);
    assert!(moved[0] > 0.0 && moved.norm() < 0.05, "{moved}");
}

#[test]
fn what_is_missing_or_impossible_is_named() {
    let error = Wind::new(Vector3::new(0.0, 300.0, 0.0)).unwrap_err().to_string();
    assert!(error.contains("wind is [0.0, 300.0, 0.0]: expected a velocity of at most 120 m/s"), "{error}");
    assert!(Wind::new(Vector3::repeat(f64::NAN)).is_err());
    let smooth = WindProfile { roughness: 0.0, reference: 10.0 };
    let error = Wind::default().over_height(smooth).unwrap_err().to_string();
    assert!(error.starts_with("wind_profile.roughness is 0: expected"), "{error}");
    let mut robot = caroca();
    robot.cables[2].properties.diameter = None;
    let still = deflection(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none()).unwrap();
    let problem = DirectProblem::new(&robot, &still.lengths, &Load::none()).unwrap();
    let wind = Wind::new(Vector3::new(10.0, 0.0, 0.0)).unwrap();
    let error = problem.in_wind(&wind, &still.loaded).unwrap_err();
    assert!(
        matches!(&error, StaticsError::Invalid { field, .. } if field == "cables[2].diameter"),
        "{error}"
    );
}

/// A point mass on one vertical cable, which the mass and its own weight stretch.
#[test]
fn a_hanging_platform_sinks_as_its_cables_lengthen() {
    let mut robot = named("cogiro");
    robot.cables.truncate(1);
    robot.platform.point = true;
    robot.cables[0].exit_point = Vector3::new(0.0, 0.0, 5.0);
    robot.cables[0].anchor_point = Vector3::zeros();
    let properties = robot.cables[0].properties.clone();
    let (mass, g) = (robot.platform.mass, robot.gravity.magnitude());
    let long = |length: f64, density: f64| {
        let weights = mass * g * length + 0.5 * density * g * length * length;
        length + weights / properties.axial_stiffness()
    };
    let height = |weather: &Weather| {
        let changed = weather.robot(&robot).unwrap();
        let lengths = weather.lengths(&[3.0]);
        let start = Pose::at(1e-3, 0.0, 5.0 - long(3.0, properties.linear_density));
        let rest = direct(&changed, &lengths, &Load::none(), DirectStart::Released(&start)).unwrap();
        (rest.equilibrium.pose.position.z, changed)
    };
    let heat = Weather { warmer: 40.0, cable_expansion: 1.2e-5, frame_expansion: 2e-5, ..Weather::default() };
    let (z, _) = height(&heat);
    let factor = 1.0 + 40.0 * 1.2e-5;
    let expected = 5.0 * (1.0 + 40.0 * 2e-5) - long(3.0 * factor, properties.linear_density / factor);
    assert!((z - expected).abs() < 1e-9, "{z} {expected}");
    let (z, changed) = height(&Weather { ice: 0.01, creep: 1e-3, ..Weather::default() });
    let density = properties.linear_density / 1.001 + 900.0 * std::f64::consts::PI * 0.01 * 0.014;
    assert!((changed.cables[0].properties.linear_density - density).abs() < 1e-12);
    assert!((z - (5.0 - long(3.003, density))).abs() < 1e-9, "{z}");
}

#[test]
fn weather_that_cannot_be_is_refused() {
    let robot = caroca();
    let refused = |weather: Weather| {
        let pose = Pose::at(0.0, 0.0, 1.75);
        in_weather(&robot, (&pose).into(), &Load::none(), &weather).unwrap_err().to_string()
    };
    let none = Weather::default();
    assert!(refused(Weather { warmer: 30.0, ..none }).starts_with("warmer is 30: expected"));
    assert!(refused(Weather { cable_expansion: 1.2e-5, ..none }).starts_with("warmer is 0: expected"));
    assert!(refused(Weather { ice: -0.01, ..none }).starts_with("ice is -0.01: expected"));
    assert!(refused(Weather { ice: f64::NAN, ..none }).starts_with("ice is NaN: expected"));
    assert!(refused(Weather { creep: 12.0, ..none }).starts_with("creep is 12: expected"));
    let mut bare = caroca();
    bare.cables.iter_mut().for_each(|cable| cable.properties.diameter = None);
    let pose = Pose::at(0.0, 0.0, 1.75);
    let iced = Weather { ice: 0.01, ..none };
    let refused = in_weather(&bare, (&pose).into(), &Load::none(), &iced).unwrap_err();
    assert!(refused.to_string().starts_with("cables[0].diameter is not given"), "{refused}");
    // A robot without diameters has another temperature nevertheless.
    let creeping = Weather { creep: 1e-4, ..none };
    let (still, rest) = in_weather(&bare, (&pose).into(), &Load::none(), &creeping).unwrap();
    assert!(rest.pose.position.z < still.loaded.equilibrium.pose.position.z - 1e-6);
}
