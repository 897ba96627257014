use super::layout::ParameterLayout;
use super::perturbed::{Perturbed, deviations};
use super::*;
use crate::robot::Robot;

fn caroca() -> Robot {
    Robot::from_library("caroca").unwrap()
}

/// CAROCA with so many cables, the first three on pulleys, the second with a lead, its gravity a vector.
fn guided(cables: usize) -> Robot {
    let mut robot = caroca();
    robot.cables = robot.cables.iter().cycle().take(cables).cloned().collect();
    for (i, axis) in [Vector3::z(), -Vector3::z(), Vector3::new(0.0, 0.6, 0.8)].into_iter().enumerate() {
        robot.cables[i].pulley = Some(Pulley { radius: 0.045, axis });
    }
    robot.cables[1].lead = 3.0;
    robot.gravity = Vector3::new(0.3, -0.2, -9.8).into();
    robot
}

#[test]
fn eight_cables_have_the_62_parameters_of_the_paper() {
    let parameters = Parameter::of(&caroca());
    let names: Vec<String> = parameters.iter().map(ToString::to_string).collect();
    assert_eq!(names.len(), 62);
    assert_eq!(names[..4], ["mass", "linear_density", "youngs_modulus", "a1.x"]);
    assert_eq!(names[26..28], ["a8.z", "b1.x"]);
    assert_eq!(names[50..55], ["b8.z", "cog.x", "cog.y", "cog.z", "dt1"]);
    assert_eq!(names[61], "dt8");
    let geometric = parameters.iter().filter(|p| p.unit() == "m").count();
    assert_eq!((geometric, 62 - geometric), (51, 11));
}

#[test]
fn pulleys_leads_and_a_vector_of_gravity_come_after_the_parameters_of_every_robot() {
    let names: Vec<String> = Parameter::of(&guided(8)).iter().map(ToString::to_string).collect();
    let tilts = ["tilt1.u", "tilt1.v", "tilt2.u", "tilt2.v", "tilt3.u", "tilt3.v"];
    assert_eq!(names[61..66], ["dt8", "r1", "r2", "r3", "lead2"]);
    assert_eq!(names[66..72], tilts);
    assert_eq!(names[72..], ["gravity.x", "gravity.y", "gravity.z"]);
}

#[test]
fn the_layout_gives_the_index_of_every_parameter() {
    for robot in (6..=16).flat_map(|cables| {
        let mut plain = caroca();
        plain.cables = plain.cables.iter().cycle().take(cables).cloned().collect();
        [plain, guided(cables)]
    }) {
        let (layout, all) = (ParameterLayout::of(&robot), Parameter::of(&robot));
        assert_eq!(all.len(), layout.count());
        let indices: Vec<_> = all.iter().map(|parameter| layout.index(*parameter)).collect();
        assert_eq!(indices, (0..layout.count()).map(Some).collect::<Vec<_>>());
        for absent in [Parameter::AnchorPoint(robot.cables.len(), Axis::X), Parameter::PulleyRadius(3)] {
            assert_eq!(layout.index(absent), None);
        }
    }
}

#[test]
fn names_are_read_back() {
    for cables in 6..=16 {
        for parameter in Parameter::of(&guided(cables)) {
            assert_eq!(parameter.to_string().parse(), Ok(parameter));
        }
    }
    for name in [
        "",
        "a",
        "a0.x",
        "a1.w",
        "a1",
        "b.x",
        "dt",
        "dt0",
        "c1.x",
        "Mass",
        "ä1.x",
        "r",
        "r0",
        "r1.x",
        "lead",
        "lead0",
        "tilt1",
        "tilt1.x",
        "tilt0.u",
        "a1.u",
        "gravity",
        "gravity.u",
    ] {
        assert!(name.parse::<Parameter>().is_err(), "{name}");
    }
}

#[test]
fn a_robot_with_another_value_has_that_very_value() {
    for robot in [caroca(), guided(8)] {
        let parameters = Parameter::of(&robot);
        let own = |p: &&Parameter| !matches!(p, Parameter::TensionOffset(_) | Parameter::Tilt(..));
        for (parameter, value) in parameters.iter().filter(own).zip(1..) {
            let value = f64::from(value) / 3.0;
            let mut changed = Perturbed { robot: robot.clone(), tension_offsets: Vec::new() };
            parameter.change(&robot, &mut changed, |old| *old = value);
            assert_eq!(parameter.nominal(&changed.robot), value, "{parameter}");
        }
    }
    let mut robot = caroca();
    assert_eq!(robot.with_values(&[("mass", 185.0)]).unwrap().platform.mass, 185.0);
    // Cables of two materials differ as before.
    robot.cables[3].properties.youngs_modulus = 4e10;
    let nominal = robot.cables[0].properties.youngs_modulus;
    let softer = robot.with_values(&[("youngs_modulus", nominal - 1e9)]).unwrap();
    assert_eq!([0, 3].map(|i| softer.cables[i].properties.youngs_modulus), [nominal - 1e9, 3.9e10]);
    assert_eq!(robot.with_values(&[("youngs_modulus", nominal)]).unwrap(), robot);
    let refused = [("dt1", 1.0), ("a9.x", 1.0), ("mass", -1.0), ("b1.x", f64::NAN), ("r1", 0.1)];
    for (name, value) in refused.into_iter().chain([("lead1", 0.1), ("tilt1.u", 0.1), ("gravity.x", 0.1)]) {
        assert!(robot.with_values(&[(name, value)]).is_err(), "{name}");
    }
}

#[test]
fn a_tilt_turns_the_axis_of_the_pulley_about_u_and_v() {
    let robot = guided(8);
    // Axes u and v of (0, 0, 1), (0, 0, -1) and (0, 3, 4)/5.
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    let expected = [(x, y), (x, -y), (-x, 0.6 * z - 0.8 * y)];
    for (i, (u, v)) in expected.into_iter().enumerate() {
        let pulley = robot.cables[i].pulley.unwrap();
        let axes = TiltAxis::ALL.map(|axis| axis.of(&pulley));
        assert!((axes[0] - u).norm() + (axes[1] - v).norm() < 1e-15, "{i}: {axes:?}");
        for (axis, about) in TiltAxis::ALL.into_iter().zip(axes) {
            let mut changed = Perturbed { robot: robot.clone(), tension_offsets: Vec::new() };
            Parameter::Tilt(i, axis).change(&robot, &mut changed, |angle| *angle = 0.1);
            let turned = changed.robot.cables[i].pulley.unwrap().axis;
            let expected = 0.1_f64.cos() * pulley.axis + 0.1_f64.sin() * about.cross(&pulley.axis);
            assert!((turned - expected).norm() < 1e-15, "{i} {axis:?}");
        }
    }
}

#[test]
fn a_parameter_that_the_robot_does_not_have_is_refused() {
    for name in ["b9.x", "r1", "lead1", "tilt1.u", "gravity.x"] {
        let found = deviations(&caroca(), &[(name, 0.1)]);
        assert!(matches!(found, Err(RobotError::UnknownParameter { .. })), "{name}");
    }
}
