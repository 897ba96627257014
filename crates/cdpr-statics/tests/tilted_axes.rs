//! Cables over pulleys with tilted axes in lanes: invariances, and the answers of the scalar models, which
//! search for the force of such a cable in another way.

use crate::common::{caroca, ipanema, observed, robots};
use crate::observer::{compared, rows_by_size};
use cdpr_robot::{Coordinate, Parameter, Pose, Pulley, Robot, Rotation3, Vector3, library};
use cdpr_statics::batch::{LoadedPose, Observation, ObservationMotion, loaded_poses};
use cdpr_statics::{Load, Observer, WantedPose, deflection_from, inverse};

fn named(name: &str) -> Robot {
    Robot::from_json(library::named(library::ROBOTS, name).unwrap().text).unwrap()
}

/// The longest distance of the two ends of a cable [m].
fn longest(robot: &Robot, pose: &Pose) -> f64 {
    (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max)
}

/// The robot with pulleys whose axes tilt, each in another direction, by up to `tilt`.
fn tilted(mut robot: Robot, pose: &Pose, tilt: f64) -> Robot {
    let radius = 0.006 * longest(&robot, pose);
    for (i, cable) in robot.cables.iter_mut().enumerate() {
        let about = 2.4 * i as f64;
        let axis = Vector3::new(tilt * about.cos(), tilt * about.sin(), if i % 3 == 0 { -1.0 } else { 1.0 });
        cable.pulley = Some(Pulley { radius: radius * (1.0 + 0.1 * i as f64), axis });
        cable.lead = if i % 2 == 0 { 20.0 * radius } else { 0.0 };
    }
    robot.name += &format!(", axes tilted by {tilt}");
    robot
}

#[test]
fn cables_over_tilted_axes_stay_in_the_lanes() {
    let mut bad = Vec::new();
    for (robot, pose) in robots() {
        for tilt in [0.02, 0.3, 1.5] {
            let robot = tilted(robot.clone(), &pose, tilt);
            let mut rows = rows_by_size(&robot, &pose, 48, 1.0, 17);
            let parameters = Parameter::of(&robot);
            for (k, value) in rows.iter_mut().enumerate() {
                if let Parameter::Tilt(..) = parameters[k % parameters.len()] {
                    *value = 0.01 * ((k * 37 % 101) as f64 / 50.0 - 1.0);
                }
            }
            let load = Load::payload(0.1 * robot.platform.mass);
            let observer = Observer::new(&robot, pose, &load).unwrap();
            let (left, failed) = compared(&robot, &observer, &rows, 1e-12 * longest(&robot, &pose));
            println!("{}: {left} of 48 left to the scalar models, {failed} failed", robot.name);
            bad.extend((left > 2 || failed > 0).then(|| format!("{}: {left}, {failed}", robot.name)));
        }
    }
    assert!(bad.is_empty(), "{bad:?}");
}

#[test]
fn grab_stays_in_the_lanes() {
    use Coordinate::{Pitch, Roll};
    let robot = named("grab");
    let pose =
        Pose { rotation: Rotation3::from_euler_angles(0.0, 0.0, 0.136), ..Pose::at(1.28, -0.19, -0.92) };
    let load = Load::payload(0.5);
    let observer = Observer::new(&robot, WantedPose::at(&pose).free(&[Roll, Pitch]), &load).unwrap();
    let rows = rows_by_size(&robot, &pose, 200, 0.1, 11);
    let (left, failed) = compared(&robot, &observer, &rows, 1e-12 * longest(&robot, &pose));
    println!("{left} of 200 left to the scalar models, {failed} failed there");
    assert!(left <= 2 && failed == 0, "{left}, {failed}");
    let motions = observed::<ObservationMotion>(&observer, &rows);
    let alone = rows.chunks(Parameter::of(&robot).len());
    for (row, found) in alone.zip(motions) {
        assert_eq!(observed::<ObservationMotion>(&observer, row)[0].as_ref().unwrap(), &found.unwrap());
    }
}

#[test]
fn an_observation_over_tilted_axes_turns_with_the_robot_about_the_vertical() {
    for (robot, pose) in robots() {
        let robot = tilted(robot, &pose, 0.4);
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 1.1);
        let mut turned = robot.clone();
        for cable in &mut turned.cables {
            cable.exit_point = turn * cable.exit_point;
            cable.pulley.iter_mut().for_each(|pulley| pulley.axis = turn * pulley.axis);
        }
        let there = Pose { position: turn * pose.position, rotation: turn * pose.rotation };
        let mut load = Load::payload(0.1 * robot.platform.mass);
        load.wrench.force = Vector3::new(0.2, -0.1, 0.05) * robot.platform.mass;
        let mut turned_load = load;
        turned_load.wrench.force = turn * load.wrench.force;
        let row = vec![0.0; Parameter::of(&robot).len()];
        let [here, there] =
            [(&robot, pose, load), (&turned, there, turned_load)].map(|(robot, pose, load)| {
                observed::<Observation>(&Observer::new(robot, pose, &load).unwrap(), &row).remove(0).unwrap()
            });
        assert_eq!([here.scalar, there.scalar], [None; 2]);
        let error = (turn * here.displacement - there.displacement).norm();
        assert!(error < 1e-12 * longest(&robot, &pose), "{}: {error:e} m", robot.name);
    }
}

#[test]
fn maps_over_tilted_axes_are_found_in_lanes() {
    for (robot, pose) in [(caroca(), Pose::at(0.5, 0.2, 1.75)), (ipanema(), Pose::at(0.3, 0.2, 1.5))] {
        let robot = tilted(robot, &pose, 0.2);
        let poses: Vec<Pose> =
            (0..40).map(|k| pose.moved(Vector3::x() * (0.005 * f64::from(k)), Vector3::zeros())).collect();
        let found = inverse(&robot, &poses, &Load::none());
        let found: Vec<_> = found.into_iter().map(Result::unwrap).collect();
        let in_lanes = found.iter().filter(|found| found.iterations == 0).count();
        assert!(in_lanes > 35, "{}: {in_lanes}", robot.name);
        for (found, pose) in found.iter().zip(&poses) {
            let alone = inverse(&robot, pose, &Load::none()).unwrap();
            for (length, expected) in found.lengths.iter().zip(&alone.lengths) {
                assert!((length - expected).abs() < 1e-10 * expected, "{}: {length} {expected}", robot.name);
            }
        }
        let load = Load::payload(0.1 * robot.platform.mass);
        let loaded = loaded_poses::<LoadedPose>(&robot, &found.iter().collect::<Vec<_>>(), &load);
        for (loaded, found) in loaded.into_iter().zip(&found) {
            let loaded = loaded.unwrap();
            let alone = deflection_from(&robot, found.lengths.clone(), &load, &found.equilibrium).unwrap();
            let alone = LoadedPose::of(&robot, &alone);
            assert_eq!(loaded.scalar, None);
            assert!((loaded.displacement - alone.displacement).norm() < 1e-12 * longest(&robot, &pose));
            assert!((loaded.least_stiffness / alone.least_stiffness - 1.0).abs() < 1e-8);
        }
    }
}

#[test]
fn rows_with_vertical_and_with_tilted_axes_do_not_depend_on_each_other() {
    for (mut robot, pose) in [(caroca(), Pose::at(0.5, 0.2, 1.75)), (ipanema(), Pose::at(0.3, 0.2, 1.5))] {
        for cable in &mut robot.cables {
            cable.pulley = Some(Pulley { radius: 0.045, axis: Vector3::z() });
        }
        let mut rows = rows_by_size(&robot, &pose, 19, 1.0, 6);
        let parameters = Parameter::of(&robot);
        for (k, value) in rows.iter_mut().enumerate() {
            let (row, column) = (k / parameters.len(), k % parameters.len());
            if matches!(parameters[column], Parameter::Tilt(..)) && row % 3 == 1 {
                *value = 0.02 * (1.0 + (k % 7) as f64);
            }
        }
        let observer = Observer::new(&robot, pose, &Load::payload(0.1 * robot.platform.mass)).unwrap();
        let together = observed::<Observation>(&observer, &rows);
        let apart = rows.chunks(parameters.len()).flat_map(|row| observed::<Observation>(&observer, row));
        assert!(apart.eq(together.iter().cloned()), "{}", robot.name);
        assert_eq!(compared(&robot, &observer, &rows, 1e-12 * longest(&robot, &pose)), (0, 0));
    }
}
