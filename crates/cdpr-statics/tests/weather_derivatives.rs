//! Derivatives in weather are those of differences.

use crate::common::caroca;
use crate::in_wind::named;
use cdpr_robot::{Coordinate, Parameter, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::weather::{Weather, WeatherInput, Wind, WindProfile, in_weather, weather_derivatives};
use cdpr_statics::{Load, StaticsError, WantedPose};

/// Displacement from the pose without load and weather.
fn displaced(robot: &Robot, wanted: WantedPose, load: &Load, weather: &Weather) -> Vector3<f64> {
    let (still, rest) = in_weather(robot, wanted, load, weather).unwrap();
    rest.pose.position - still.unloaded.equilibrium.pose.position
}

/// The derivative at 0 from differences of fourth order.
fn difference(step: f64, at: impl Fn(f64) -> Vector3<f64>) -> Vector3<f64> {
    let central = |step: f64| (at(step) - at(-step)) / (2.0 * step);
    (4.0 * central(0.5 * step) - central(step)) / 3.0
}

/// Another value of a number of the weather.
fn changed(weather: &Weather, input: WeatherInput, by: f64) -> Weather {
    let mut weather = *weather;
    match input {
        WeatherInput::Warmer => weather.warmer += by,
        WeatherInput::CableExpansion => weather.cable_expansion += by,
        WeatherInput::FrameExpansion => weather.frame_expansion += by,
        WeatherInput::Ice => weather.ice += by,
        WeatherInput::Creep => weather.creep += by,
        WeatherInput::Wind => {
            let velocity = weather.wind.velocity();
            let faster = velocity * (1.0 + by / velocity.norm());
            weather.wind = weather.wind.with_velocity(faster).unwrap();
        }
        WeatherInput::Direction => {
            let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), by) * weather.wind.velocity();
            weather.wind = weather.wind.with_velocity(turned).unwrap();
        }
    }
    weather
}

/// A robot, a pose with its free coordinates, a load, and the accuracy of positions [m].
struct Case {
    robot: Robot,
    pose: Pose,
    free: Vec<Coordinate>,
    load: Load,
    accuracy: f64,
}

fn cases() -> Vec<Case> {
    let case = |robot: Robot, pose: Pose, free: &[Coordinate], payload: f64, accuracy: f64| {
        let mut robot = robot;
        for cable in &mut robot.cables {
            let full = (4.0 * cable.properties.section / std::f64::consts::PI).sqrt();
            cable.properties.diameter.get_or_insert(full);
        }
        Case { robot, pose, free: free.to_vec(), load: Load::payload(payload), accuracy }
    };
    let stadium = include_str!("../../../docs/how-to/loads/stadium.json");
    let mut led = caroca();
    led.cables.iter_mut().for_each(|cable| cable.lead = 1.5);
    let upright = [Coordinate::Roll, Coordinate::Pitch];
    vec![
        case(led, Pose::at(0.4, -0.3, 1.6), &[], 20.0, 1e-11),
        case(named("cogiro"), Pose::at(1.0, -0.5, 2.0), &[], 30.0, 1e-10),
        case(Robot::from_json(stadium).unwrap(), Pose::at(20.0, 10.0, 12.0), &[], 0.0, 1e-9),
        case(named("four-cables"), Pose::at(0.2, 0.1, 1.5), &upright, 2.0, 1e-9),
    ]
}

fn calm() -> Weather {
    Weather {
        wind: Wind::default(),
        warmer: 25.0,
        cable_expansion: 1.2e-5,
        frame_expansion: 1e-5,
        ice: 0.003,
        creep: 2e-4,
    }
}

fn windy() -> Weather {
    let wind = Wind::new(Vector3::new(9.0, -6.0, 1.0)).unwrap();
    Weather { wind: wind.over_height(WindProfile { roughness: 0.3, reference: 10.0 }).unwrap(), ..calm() }
}

#[test]
fn derivatives_by_the_weather_are_those_of_differences() {
    for Case { robot, pose, free, load, accuracy } in cases() {
        for weather in [calm(), windy()] {
            let wanted = || WantedPose::at(&pose).free(&free);
            let found = weather_derivatives(&robot, wanted(), &load, &weather).unwrap();
            for (input, slope) in WeatherInput::ALL.into_iter().zip(&found.per_weather) {
                let Ok(slope) = slope else {
                    assert!(input.name().starts_with("wind") && weather.wind.is_calm());
                    continue;
                };
                let step = match input {
                    WeatherInput::Warmer => 2.0,
                    WeatherInput::CableExpansion | WeatherInput::FrameExpansion => 2e-6,
                    WeatherInput::Ice => 2e-4,
                    WeatherInput::Creep => 2e-5,
                    WeatherInput::Wind => 0.2,
                    WeatherInput::Direction => 0.02,
                };
                let known =
                    difference(step, |by| displaced(&robot, wanted(), &load, &changed(&weather, input, by)));
                let apart = (slope - known).norm();
                let name = input.name();
                assert!(
                    apart < 1e-6 * known.norm() + accuracy / step,
                    "{} {name}: {slope} {known}",
                    robot.name
                );
            }
        }
    }
}

#[test]
fn derivatives_by_the_robot_are_those_of_differences() {
    for Case { robot, pose, free, load, accuracy } in cases() {
        let weather = windy();
        let wanted = || WantedPose::at(&pose).free(&free);
        let found = weather_derivatives(&robot, wanted(), &load, &weather).unwrap();
        // Tensions of few cables change much within a milliradian of yaw.
        let short = if robot.is_fully_actuated() { 1e-3 } else { 1e-4 };
        let mut compared = 0;
        for (column, parameter) in found.inputs.parameters.iter().enumerate() {
            let of_one_cable = match parameter {
                Parameter::TensionOffset(_) => continue,
                Parameter::ExitPoint(i, _) | Parameter::AnchorPoint(i, _) | Parameter::Lead(i) => *i % 3 != 0,
                _ => false,
            };
            if of_one_cable || found.one_sided.iter().any(|one| one.column == column) {
                continue;
            }
            let value = parameter.nominal(&robot);
            let step = match parameter {
                Parameter::YoungsModulus | Parameter::LinearDensity | Parameter::Mass => 1e-3 * value,
                _ => short,
            };
            let known = difference(step, |by| {
                let robot = robot.with_values(&[(&parameter.to_string(), value + by)]).unwrap();
                displaced(&robot, wanted(), &load, &weather)
            });
            let slope: Vector3<f64> = found.displacement.column(column).into();
            let bound = 1e-6 * known.norm() + 10.0 * accuracy / step;
            assert!((slope - known).norm() < bound, "{} {parameter}: {slope} {known}", robot.name);
            compared += 1;
        }
        assert!(compared >= 12, "{}: {compared}", robot.name);
        let step = 0.05;
        let known = difference(step, |by| {
            displaced(&robot, wanted(), &Load::payload(load.payload + 1.0 + by), &weather)
        });
        let heavier = Load::payload(load.payload + 1.0);
        let found = weather_derivatives(&robot, wanted(), &heavier, &weather).unwrap();
        let slope: Vector3<f64> = found.displacement.column(found.inputs.payload()).into();
        assert!((slope - known).norm() < 1e-6 * known.norm() + 10.0 * accuracy / step, "{}", robot.name);
        assert!(found.magnitude(&slope).is_some_and(f64::is_finite));
    }
}

#[test]
fn pulleys_have_derivatives_without_wind_and_none_in_it() {
    let robot = named("ipanema-3");
    let pose = Pose::at(0.0, 0.0, 1.0);
    let creep = Weather { creep: 1e-4, ..Weather::default() };
    let found = weather_derivatives(&robot, WantedPose::at(&pose), &Load::none(), &creep).unwrap();
    let of_creep = found.per_weather[4].as_ref().unwrap();
    let known = difference(2e-6, |by| {
        displaced(&robot, WantedPose::at(&pose), &Load::none(), &Weather { creep: 1e-4 + by, ..creep })
    });
    assert!((of_creep - known).norm() < 1e-6 * known.norm() + 1e-5, "{of_creep} {known}");
    let windy = Weather { wind: Wind::new(Vector3::new(8.0, 0.0, 0.0)).unwrap(), ..creep };
    let refused = weather_derivatives(&robot, WantedPose::at(&pose), &Load::none(), &windy).unwrap_err();
    assert!(matches!(refused, StaticsError::NoDerivative { .. } | StaticsError::Invalid { .. }), "{refused}");
}
