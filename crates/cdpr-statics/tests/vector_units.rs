//! Results in lanes are those of one lane, to the last bit, whatever the vector unit and the neighbours.

use crate::common::{caroca, cogiro, observed};
use cdpr_number::lanes::Unit;
use cdpr_robot::{Coordinate, Parameter, Pose, Pulley, Robot, Vector3};
use cdpr_statics::batch::{
    LoadedPose, Observation, ObservationMotion, ObservationSlopes, PoseSlopes, loaded_poses,
};
use cdpr_statics::{
    DirectStart, InverseSolution, Load, Observer, StaticsError, Tracker, WantedPose, direct, inverse,
};
use std::fmt::Debug;

/// The result of `task`, which must be the same on all vector units.
fn on_all_units<R: PartialEq + Debug>(task: impl Fn() -> R) -> R {
    let scalar = Unit::Scalar.run(&task);
    for unit in Unit::all() {
        assert_eq!(scalar, unit.run(&task), "{unit:?}");
    }
    scalar
}

/// Rows of a sawtooth through the ranges `half` of all parameters.
fn sawtooth(half: &[f64]) -> Vec<f64> {
    let n = half.len();
    (0..n * 100).map(|i| half[i % n] * ((i * 37 % 101) as f64 / 50.0 - 1.0)).collect()
}

fn over_pulleys(mut robot: Robot, lead: impl Fn(usize) -> f64) -> Robot {
    for (i, cable) in robot.cables.iter_mut().enumerate() {
        cable.pulley = Some(Pulley { radius: 0.045, axis: Vector3::z() });
        cable.lead = lead(i);
    }
    robot
}

/// Observations, motions and derivatives of all rows, of which at most `most` are left to the scalar models.
fn observe(observer: &Observer, deviations: &[f64], most: usize) {
    let found = on_all_units(|| observed::<Observation>(observer, deviations));
    let left = found.iter().filter(|found| found.as_ref().map_or(true, |found| found.scalar.is_some()));
    assert!(left.count() <= most);
    on_all_units(|| observed::<ObservationMotion>(observer, deviations));
    on_all_units(|| observed::<ObservationSlopes>(observer, deviations));
}

#[test]
fn the_vector_unit_changes_no_bit_of_an_observation() {
    let tilted = Robot { gravity: Vector3::new(0.6, -0.3, -9.7).into(), ..caroca() };
    for robot in [caroca(), tilted, over_pulleys(caroca(), |i| i as f64)] {
        // The ranges of the paper's Table 3; for gravity 0.1 m/s².
        let half = Parameter::of(&robot).into_iter().map(|parameter| match parameter {
            Parameter::Mass => 18.0,
            Parameter::LinearDensity => 0.01,
            Parameter::YoungsModulus => 1.8e10,
            Parameter::TensionOffset(_) => 15.0,
            Parameter::Gravity(_) => 0.1,
            Parameter::PulleyRadius(_) => 0.001,
            Parameter::Lead(_) | Parameter::Tilt(..) => 0.0,
            _ => 0.015,
        });
        let deviations = sawtooth(&half.collect::<Vec<_>>());
        for pose in [Pose::at(0.0, 0.0, 1.75), Pose::at(3.2, 1.7, 3.0)] {
            observe(&Observer::new(&robot, pose, &Load::payload(50.0)).unwrap(), &deviations, 9);
        }
    }
}

#[test]
fn the_vector_unit_changes_no_bit_of_robots_with_free_coordinates() {
    let mut robot = cogiro();
    robot.cables = [1, 3, 5, 7].map(|i| robot.cables[i].clone()).to_vec();
    let tilted = Robot { gravity: Vector3::new(0.1, -0.2, -9.8).into(), ..robot.clone() };
    for robot in [robot.clone(), tilted, over_pulleys(robot, |_| 1.0)] {
        let (pose, free) = (Pose::at(1.0, -0.3, 2.0), [Coordinate::Yaw, Coordinate::Roll]);
        let half = Parameter::of(&robot).into_iter().map(|parameter| match parameter {
            Parameter::Mass => 1.0,
            Parameter::LinearDensity => 0.001,
            Parameter::YoungsModulus => 1e9,
            Parameter::Tilt(..) => 0.0,
            // Rows that turn the platform far are left to the scalar models.
            _ => 0.0003,
        });
        let deviations = sawtooth(&half.collect::<Vec<_>>());
        let observer = Observer::new(&robot, WantedPose::at(&pose).free(&free), &Load::payload(9.0)).unwrap();
        observe(&observer, &deviations, 9);
    }
}

#[test]
fn neither_vector_unit_nor_neighbours_change_a_bit_of_a_pose() {
    let mut robot = cogiro();
    robot.cables[3].lead = 2.0;
    let load = Load::payload(50.0);
    let poses: Vec<_> = (0..21).map(|k| Pose::at(0.4 * f64::from(k) - 4.0, 0.4, 1.6)).collect();
    let wanted: Vec<InverseSolution> =
        poses.iter().map(|pose| inverse(&robot, pose, &Load::none()).unwrap()).collect();
    let wanted: Vec<_> = wanted.iter().collect();
    let found = on_all_units(|| loaded_poses::<LoadedPose>(&robot, &wanted, &load));
    assert_eq!(found[3..], loaded_poses::<LoadedPose>(&robot, &wanted[3..], &load));
    let in_lanes = |found: &&Result<_, StaticsError>| {
        let found: &Result<cdpr_statics::batch::LoadedPose, _> = found;
        found.as_ref().is_ok_and(|found| found.scalar.is_none())
    };
    assert!(found.iter().filter(in_lanes).count() > 15);
    on_all_units(|| loaded_poses::<PoseSlopes>(&robot, &wanted, &load));
}

#[test]
fn the_vector_unit_changes_no_bit_of_the_inverse_model() {
    let poses: Vec<_> = (0..21).map(|k| Pose::at(0.9 + 0.03 * f64::from(k), 0.4, 1.6)).collect();
    let found = on_all_units(|| inverse(&cogiro(), &poses, &Load::payload(50.0)));
    assert!(found.iter().all(Result::is_ok));
}

#[test]
fn the_vector_unit_changes_no_bit_of_the_direct_model_nor_of_a_tracker() {
    let grab = Robot::from_json(include_str!("../../../data/robots/grab.json")).unwrap();
    let pulleys = over_pulleys(caroca(), |i| i as f64);
    for robot in [caroca(), cogiro(), pulleys] {
        let pose = Pose::at(0.1, 0.2, 1.75);
        let wanted = inverse(&robot, &pose, &Load::none()).unwrap();
        let load = Load::payload(30.0);
        let near = DirectStart::Near(&wanted.equilibrium);
        assert!(on_all_units(|| direct(&robot, &wanted.lengths, &load, near)).is_ok());
        let mut tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.equilibrium).unwrap();
        let mut found = Vec::new();
        for unit in Unit::all() {
            found.push(unit.run(|| tracker.update(&wanted.lengths, &load).unwrap().clone()));
            tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.equilibrium).unwrap();
        }
        assert!(found.iter().all(|equilibrium| *equilibrium == found[0]), "{}", robot.name);
    }
    let pose = Pose::at(1.28, -0.19, -0.92);
    let free = [Coordinate::Roll, Coordinate::Pitch];
    let observer = Observer::new(&grab, WantedPose::at(&pose).free(&free), &Load::payload(0.5)).unwrap();
    let rows = vec![1e-5; 5 * Parameter::of(&grab).len()];
    on_all_units(|| observed::<ObservationMotion>(&observer, &rows));
}

#[test]
fn no_load_moves_nothing() {
    let robot = caroca();
    let wanted = inverse(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none()).unwrap();
    let none = loaded_poses::<LoadedPose>(&robot, &[&wanted], &Load::none()).remove(0).unwrap();
    assert_eq!((none.scalar, none.displacement), (None, Vector3::zeros()));
}
