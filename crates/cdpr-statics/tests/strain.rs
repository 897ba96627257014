//! Strains beyond which no model answers.

use crate::common::{caroca, cogiro, observed};
use cdpr_cable::MAX_STRAIN;
use cdpr_robot::{ParameterLayout, Pose, Pulley, Robot, Vector3, Wrench};
use cdpr_statics::batch::{LoadedPose, Observation, loaded_poses};
use cdpr_statics::capacity::{greatest_payload, tension_margin};
use cdpr_statics::free_coordinates::free_solutions;
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::vibration::modes_at;
use cdpr_statics::{
    DirectStart, InversePath, Load, Observer, StaticsError, Tracker, deflection, derivatives, direct,
    inverse, is_feasible,
};

/// Cables so soft that the tensions of a pose strain them by a multiple of what the models hold for.
fn soft(mut robot: Robot, pose: &Pose, times: f64) -> Robot {
    let found = inverse(&robot, pose, &Load::none()).unwrap();
    let greatest = found.tensions.iter().copied().fold(0.0, f64::max);
    for cable in &mut robot.cables {
        cable.properties.youngs_modulus *=
            greatest / (times * MAX_STRAIN * cable.properties.axial_stiffness());
    }
    robot
}

#[test]
fn no_model_answers_beyond_the_strain_that_it_holds_for() {
    let pose = Pose::at(0.4, -0.3, 1.6);
    let none = Load::none();
    let mut guided = caroca();
    for cable in &mut guided.cables {
        cable.pulley = Some(Pulley { radius: 0.045, axis: Vector3::z() });
    }
    for robot in [caroca(), guided] {
        for times in [1.1, 3.0, 14.0] {
            let robot = &soft(robot.clone(), &pose, times);
            let kinds = |answers: Vec<(&'static str, Option<StaticsError>)>| {
                for (name, error) in answers {
                    let kind = error.map_or("an answer", |error| error.kind());
                    assert_eq!(kind, "cable_overstrained", "{name} at {times} times the strain");
                }
            };
            let load = Load::payload(1.0);
            let observer = Observer::new(robot, pose, &load).unwrap();
            let deviations = vec![0.0; 3 * ParameterLayout::of(robot).count()];
            let mut path = InversePath::new(robot);
            kinds(vec![
                ("inverse", inverse(robot, &pose, &none).err()),
                ("a path", path.solve(pose, &none).err()),
                ("at rest", inverse(robot, &pose, &none).err()),
                ("free coordinates", free_solutions(robot, pose, &none).err()),
                ("a map", inverse(robot, &[pose; 3], &none).remove(2).err()),
                ("deflection", deflection(robot, &pose, &load).err()),
                ("derivatives", derivatives(robot, &pose, &load).err()),
                ("stiffness", stiffness_at(robot, pose, &none).err()),
                ("modes", modes_at(robot, pose, &none).err()),
                ("an observation", observed::<Observation>(&observer, &deviations).remove(1).err()),
            ]);
            assert_eq!(is_feasible(robot, &pose, &none), Ok(false));
        }
    }
}

#[test]
fn an_answer_just_within_the_strain_stands() {
    let pose = Pose::at(0.4, -0.3, 1.6);
    let robot = &soft(caroca(), &pose, 0.9);
    let found = inverse(robot, &pose, &Load::none()).unwrap();
    let tensions = found.equilibrium.exit_tensions(robot, &found.lengths);
    let strains = tensions.iter().enumerate().map(|(i, tension)| robot.cable(i).strain(*tension));
    let greatest = strains.fold(0.0, f64::max);
    assert!(greatest > 0.08 && greatest < MAX_STRAIN, "{greatest}");
    assert_eq!(is_feasible(robot, &pose, &Load::none()), Ok(true));
    assert!(loaded_poses::<LoadedPose>(robot, &[&found], &Load::none())[0].is_ok());
    // More load strains more.
    let load = Load::payload(200.0);
    let start = DirectStart::Near(&found.equilibrium);
    assert_eq!(direct(robot, &found.lengths, &load, start).unwrap_err().kind(), "cable_overstrained");
    assert_eq!(
        loaded_poses::<LoadedPose>(robot, &[&found], &load).remove(0).unwrap_err().kind(),
        "cable_overstrained"
    );
    let mut tracker = Tracker::new(robot, &found.lengths, &Load::none(), &found.equilibrium).unwrap();
    assert_eq!(tracker.update(&found.lengths, &load).unwrap_err().kind(), "cable_overstrained");
}

#[test]
fn payloads_and_margins_with_tensions_distributed_anew_have_the_same_bound() {
    let pose = Pose::at(1.0, -0.5, 2.0);
    let robot = soft(cogiro(), &pose, 0.9);
    for found in
        [greatest_payload(&robot, &pose, &Wrench::none()), tension_margin(&robot, &pose, &Load::none())]
    {
        let found = found.unwrap();
        let tensions = found.equilibrium.exit_tensions(&robot, &found.lengths);
        assert!(tensions.iter().enumerate().all(|(i, t)| robot.cable(i).strain(*t) <= MAX_STRAIN));
    }
    // Where the platform's own weight strains cables too much, nothing is carried.
    let robot = soft(cogiro(), &pose, 1.1);
    assert_eq!(greatest_payload(&robot, &pose, &Wrench::none()).unwrap_err().kind(), "cable_overstrained");
}

/// From an unstable equilibrium, where the first slope is rounding, the descent goes on to a rest.
#[test]
fn a_platform_that_stands_on_its_head_falls_to_a_rest() {
    for (name, [x, y, z], up) in [
        ("ipanema-1", [0.1, 0.1, 1.0], 0.2),
        ("ipanema-1", [0.1, 0.1, 1.0], 0.5),
        ("macarm", [1.17, 1.17, 1.17], 2.5),
        ("hrpcables", [0.2, 0.1, 0.8], 5.0),
        ("caroca", [0.0, 0.0, 1.75], 10.0),
    ] {
        let mut robot = Robot::from_library(name).unwrap();
        robot.platform.center_of_mass.z += up;
        let pose = Pose::at(x, y, z);
        let held = inverse(&robot, &pose, &Load::none()).unwrap();
        let found = direct(&robot, &held.lengths, &Load::none(), DirectStart::Pose(&pose));
        let found = found.unwrap_or_else(|error| panic!("{name}, {up} m: {error}"));
        assert!(found.stability.is_stable(), "{name}");
        assert!(held.equilibrium.pose.motion_to(&found.equilibrium.pose).norm() > 1e-4, "{name}");
    }
}
