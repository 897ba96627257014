//! Wind from all directions.

use cdpr_assess::{
    AnyWeather, DIRECTIONS, Further, HELD, Winds, Workspace, WorkspaceSummary, compute_workspace, winds,
};
use cdpr_robot::{Pose, Robot, Rotation3, Vector3};
use cdpr_statics::weather::{Weather, Wind, WindProfile, in_weather};
use cdpr_statics::{InverseSolution, Load, StaticsError, WantedPose, deflection, inverse};
use cdpr_study::{Grid, GridAxis};

fn stadium() -> Robot {
    Robot::from_json(include_str!("../../../docs/how-to/loads/stadium.json")).unwrap()
}

fn any(speed: f64) -> AnyWeather {
    AnyWeather { weather: Weather::default(), speed: Some(speed) }
}

/// The robot held at a pose, in weather.
fn blown(robot: &Robot, pose: &Pose, weather: &AnyWeather) -> Winds {
    let InverseSolution { lengths, .. } = inverse(robot, WantedPose::at(pose), &Load::none()).unwrap();
    winds(robot, &lengths, &Load::none(), [pose, pose], weather).unwrap()
}

#[test]
fn no_direction_is_worse_than_the_worst_one() {
    let (robot, pose) = (stadium(), Pose::at(20.0, 10.0, 12.0));
    let found = blown(&robot, &pose, &any(15.0));
    assert!(found.failures.is_empty() && found.rests.len() > DIRECTIONS);
    let worst = found.farthest().unwrap();
    let tension = found.tightest().unwrap().greatest_tension().0;
    let mut near = 0.0_f64;
    for k in 0..72 {
        let azimuth = f64::from(k) * std::f64::consts::TAU / 72.0;
        let wind = Wind::new(15.0 * Vector3::new(azimuth.cos(), azimuth.sin(), 0.0)).unwrap();
        let weather = Weather { wind, ..Weather::default() };
        let (still, rest) = in_weather(&robot, (&pose).into(), &Load::none(), &weather).unwrap();
        let moved = (rest.pose.position - still.unloaded.equilibrium.pose.position).norm();
        near = near.max(moved);
        assert!(moved <= worst.moved() + 1e-7, "{k}: {moved} {}", worst.moved());
        // Between the directions a tension may be a little greater.
        assert!(rest.exit_tensions.iter().all(|exit| *exit < 1.01 * tension));
    }
    assert!(worst.moved() < 1.01 * near, "{} {near}", worst.moved());
}

#[test]
fn a_robot_that_is_turned_has_its_worst_wind_turned() {
    let (robot, pose, angle) = (stadium(), Pose::at(20.0, 10.0, 12.0), 0.4);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
    let mut turned = robot.clone();
    turned.cables.iter_mut().for_each(|cable| cable.exit_point = turn * cable.exit_point);
    let one = blown(&robot, &pose, &any(15.0));
    let other = blown(&turned, &Pose { position: turn * pose.position, ..pose }, &any(15.0));
    let (one, other) = (one.farthest().unwrap(), other.farthest().unwrap());
    assert!((one.moved() - other.moved()).abs() < 1e-5 * one.moved(), "{} {}", one.moved(), other.moved());
    let apart = other.azimuth.unwrap() - one.azimuth.unwrap() - angle;
    let apart = (apart + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
    assert!(apart.abs() < 5e-3, "{apart}");
}

#[test]
fn wind_is_horizontal_over_a_base_that_is_tilted() {
    let (robot, pose) = (stadium(), Pose::at(20.0, 10.0, 12.0));
    let turn = Rotation3::new(Vector3::new(0.3, -0.2, 0.5));
    let mut turned = robot.clone();
    turned.cables.iter_mut().for_each(|cable| cable.exit_point = turn * cable.exit_point);
    turned.gravity = (turn * robot.gravity.vector()).into();
    let there = Pose { position: turn * pose.position, rotation: turn * pose.rotation };
    let [one, other] = [blown(&robot, &pose, &any(15.0)), blown(&turned, &there, &any(15.0))];
    let [one, other] = [&one, &other].map(|winds| winds.farthest().unwrap().moved());
    assert!((one - other).abs() < 1e-5 * one, "{one} {other}");
}

#[test]
fn each_position_of_a_map_has_its_worst_wind() {
    let robot = stadium();
    let load = Load::payload(5.0);
    let axis = |min: f64, max: f64, points| GridAxis { min, max, points };
    let profile = WindProfile { roughness: 0.3, reference: 10.0 };
    let steady = Wind::new(Vector3::new(10.0, 5.0, 0.0)).unwrap().over_height(profile).unwrap();
    let fixed = Weather { wind: steady, ice: 0.002, ..Weather::default() };
    let map = |weather: AnyWeather| {
        let workspace = Workspace {
            robot: &robot,
            grid: Grid::new([axis(0.0, 20.0, 2), axis(-10.0, 10.0, 2), axis(12.0, 12.0, 1)]).unwrap(),
            rotation: Rotation3::identity(),
            load,
            tolerances: None,
            free: &[],
            further: Further { weather: Some(weather), ..Further::default() },
        };
        let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
        WorkspaceSummary::new(&workspace, &poses)
    };
    let of_one = map(AnyWeather { weather: fixed, speed: None });
    let of_all = map(AnyWeather { weather: fixed, speed: Some(steady.velocity().norm()) });
    for (one, all) in of_one.rows.iter().zip(&of_all.rows) {
        assert_eq!(one.status, HELD);
        let pose = Pose::at(one.x_m, one.y_m, one.z_m);
        let (_, rest) = in_weather(&robot, (&pose).into(), &load, &fixed).unwrap();
        let from = deflection(&robot, &pose, &load).unwrap().unloaded.equilibrium.pose.position;
        let moved = 1e3 * (rest.pose.position - from).norm();
        assert!((one.weather_moved_mm.unwrap() - moved).abs() < 1e-4, "{one:?} {moved}");
        assert!(one.weather_azimuth_deg.is_none());
        // That direction is not one of the 24, but it is near two of them.
        assert!(all.weather_moved_mm.unwrap() > 0.98 * moved, "{all:?} {moved}");
        assert!(all.weather_azimuth_deg.is_some_and(|azimuth| (0.0..360.0).contains(&azimuth)));
        assert!(all.weather_greatest_tension_n.unwrap() > all.weather_least_tension_n.unwrap());
    }
    assert_eq!(of_one.weather.unwrap().velocity, Some([10.0, 5.0, 0.0]));
    assert!(of_all.weather.unwrap().conditions().contains("from any direction, at 10 m over ground"));
    assert!(of_all.weather_moved_mm.unwrap().max > of_one.weather_moved_mm.unwrap().min);
}

#[test]
fn a_cable_without_diameter_is_named() {
    let mut robot = stadium();
    robot.cables[1].properties.diameter = None;
    let pose = Pose::at(0.0, 0.0, 12.0);
    let InverseSolution { lengths, .. } = inverse(&robot, WantedPose::at(&pose), &Load::none()).unwrap();
    let refused = winds(&robot, &lengths, &Load::none(), [&pose, &pose], &any(15.0)).unwrap_err();
    assert!(
        matches!(&refused, StaticsError::Invalid { field, .. } if field == "cables[1].diameter"),
        "{refused}"
    );
}

/// Where cables bear differently, the least safety factor is looked for, not that of the greatest tension.
#[test]
fn the_least_safety_factor_is_that_of_the_weakest_cable() {
    let mut robot = Robot::from_library("cogiro").unwrap();
    robot.cables.iter_mut().for_each(|cable| cable.properties.breaking_force = Some(8000.0));
    robot.cables[2].properties.breaking_force = Some(1200.0);
    let pose = Pose::at(1.0, 1.0, 2.0);
    let found = blown(&robot, &pose, &any(40.0));
    let (worst, factor, cable) = found.least_safe().unwrap();
    let tight = found.tightest().unwrap();
    assert!(cable == 2 && tight.greatest_tension().1 != 2, "{cable}");
    assert!(factor < 0.9 * tight.safety_factor.unwrap().0, "{factor}");
    // No other direction has a lesser one, but for what is between the steps of the search.
    let InverseSolution { lengths, .. } = inverse(&robot, WantedPose::at(&pose), &Load::none()).unwrap();
    for degrees in (0..360).step_by(15) {
        let [sin, cos] = [f64::sin, f64::cos].map(|of| 40.0 * of(f64::from(degrees).to_radians()));
        let wind = Wind::new(Vector3::new(cos, sin, 0.0)).unwrap();
        let weather = AnyWeather { weather: Weather { wind, ..Weather::default() }, speed: None };
        let one = winds(&robot, &lengths, &Load::none(), [&pose, &pose], &weather).unwrap();
        let here = one.least_safe().unwrap().1;
        assert!(here > 0.9999 * factor, "{degrees}: {here} < {factor} at {:?}", worst.azimuth);
    }
}
