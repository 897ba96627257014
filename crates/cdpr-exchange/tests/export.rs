//! Exported robots rest at their pose, and come back from CASPR as they went.

use cdpr_exchange::{ExchangeError, ForeignFile, ImportOptions, Target, export, import};
use cdpr_robot::library::{ROBOTS, named};
use cdpr_robot::{CatalogueCable, Pose, Robot, Rotation3, Vector3};
use roxmltree::{Document, Node};

fn robot(name: &str) -> Robot {
    Robot::from_json(named(ROBOTS, name).unwrap().text).unwrap()
}

fn numbers(node: &Node, name: &str) -> Vec<f64> {
    node.attribute(name).unwrap().split(' ').map(|word| word.parse().unwrap()).collect()
}

fn vector(node: &Node, name: &str) -> Vector3<f64> {
    Vector3::from_column_slice(&numbers(node, name))
}

#[test]
fn the_springs_of_mujoco_balance_the_weight_at_the_pose() {
    let turned = Pose {
        position: Vector3::new(0.5, -0.4, 2.2),
        rotation: Rotation3::from_euler_angles(0.05, -0.03, 0.1),
    };
    let cases = [
        ("caroca", Pose::at(0.3, 0.1, 1.75)),
        ("cogiro", turned),
        ("fast", Pose::at(0.0, 0.0, 140.1)),
        ("nist-robocrane", Pose::at(0.0, 0.0, 1.5)),
    ];
    for (name, pose) in cases {
        let robot = robot(name);
        let exported = export(&robot, &pose, Target::Mjcf).unwrap();
        let document = Document::parse(&exported.files[0].1).unwrap();
        let find = |tag: &'static str| document.descendants().filter(move |node| node.has_tag_name(tag));
        let site = |name: &str| find("site").find(|node| node.attribute("name") == Some(name)).unwrap();
        let body = find("body").next().unwrap();
        assert_eq!(vector(&body, "pos"), pose.position);
        let [w, x, y, z] = numbers(&body, "quat")[..] else { panic!() };
        let quaternion = cdpr_robot::UnitQuaternion::from_quaternion([x, y, z, w].into());
        let rotation = quaternion.to_rotation_matrix();
        let inertial = find("inertial").next().unwrap();
        let mass = numbers(&inertial, "mass")[0];
        let mut force = mass * robot.gravity.vector();
        let mut moment = (rotation * vector(&inertial, "pos")).cross(&force);
        let weight = force.norm();
        for tendon in find("spatial") {
            let ends: Vec<_> = tendon.children().filter_map(|node| node.attribute("site")).collect();
            let arm = rotation * vector(&site(ends[1]), "pos");
            let span = vector(&site(ends[0]), "pos") - pose.position - arm;
            let stretched = span.norm() - numbers(&tendon, "springlength")[1];
            assert!(stretched > 0.0, "{name}");
            let pull = numbers(&tendon, "stiffness")[0] * stretched * span.normalize();
            force += pull;
            moment += arm.cross(&pull);
        }
        assert!(force.norm() < 1e-8 * weight, "{name}: {force:?}");
        assert!(moment.norm() < 1e-8 * weight * robot.platform_size(), "{name}: {moment:?}");
    }
}

#[test]
fn every_robot_of_the_library_comes_back_from_caspr() {
    for library in ROBOTS {
        let robot = robot(library.name);
        let pose = Pose { rotation: Rotation3::from_euler_angles(0.1, 0.2, 0.3), ..Pose::at(0.1, 0.2, 1.0) };
        let exported = export(&robot, &pose, Target::Caspr).unwrap();
        let files: Vec<_> = exported
            .files
            .into_iter()
            .map(|(name, text)| ForeignFile { name: name.to_owned(), text })
            .collect();
        let properties = robot.cables[0].properties.clone();
        let cable = CatalogueCable { name: "its own".to_owned(), source: None, properties };
        let options = ImportOptions { cable: Some(cable), ..ImportOptions::default() };
        let back = import(&files, &options).unwrap_or_else(|error| panic!("{}: {error}", library.name)).robot;
        assert_eq!(back.name, robot.name);
        assert_eq!(back.platform.mass, robot.platform.mass);
        assert_eq!(back.platform.center_of_mass, robot.platform.center_of_mass);
        if robot.platform.inertia.is_some() {
            assert_eq!(back.platform.inertia, robot.platform.inertia);
        }
        for (i, (cable, was)) in back.cables.iter().zip(&robot.cables).enumerate() {
            assert_eq!((cable.exit_point, cable.anchor_point), (was.exit_point, was.anchor_point));
            assert_eq!(cable.pulley.map(|p| p.radius), was.pulley.map(|p| p.radius));
            if let (Some(pulley), Some(was)) = (cable.pulley, was.pulley) {
                assert!((pulley.axis - was.axis.normalize()).norm() < 1e-15);
            }
            assert_eq!(back.limits(i), robot.limits(i));
            // That of a law is the one at the pose.
            if was.properties.law.is_none() {
                let (stiffness, was) = (cable.properties.axial_stiffness(), was.properties.axial_stiffness());
                assert!((stiffness - was).abs() < 1e-12 * was, "{}", library.name);
            }
        }
    }
}

#[test]
fn moorpy_has_the_lengths_of_the_inverse_model() {
    let (robot, pose) = (robot("cogiro"), Pose::at(0.0, 0.0, 2.0));
    let text = &export(&robot, &pose, Target::Moorpy).unwrap().files[0].1;
    let lengths = cdpr_statics::inverse(&robot, &pose, &cdpr_statics::Load::none()).unwrap().lengths;
    let lines = text.split("(-) (-)\n").last().unwrap().lines().take(8);
    let written: Vec<f64> = lines.map(|line| line.split(' ').nth(4).unwrap().parse().unwrap()).collect();
    assert_eq!(written, lengths);
}

/// MoorDyn turns a body by Rx(roll) Ry(pitch) Rz(yaw), as its own points show (test_exchange.py).
#[test]
fn moordyn_has_the_angles_of_its_own_order_and_steps_that_axial_waves_allow() {
    for (name, height) in [("caroca", 1.75), ("cogiro", 2.0), ("ipanema-1", 1.0)] {
        let robot = robot(name);
        let rotation = Rotation3::from_euler_angles(0.02, -0.03, 0.05);
        let pose = Pose { position: Vector3::new(0.0, 0.0, height), rotation };
        let text = &export(&robot, &pose, Target::Moordyn).unwrap().files[0].1;
        let body = text.lines().find(|line| line.contains(" Free ")).unwrap();
        let angle = |k: usize| body.split(' ').nth(k).unwrap().parse::<f64>().unwrap().to_radians();
        let about = |axis, k| Rotation3::from_axis_angle(&axis, angle(k));
        let again = about(Vector3::x_axis(), 5) * about(Vector3::y_axis(), 6) * about(Vector3::z_axis(), 7);
        assert!((again.matrix() - rotation.matrix()).norm() < 1e-14, "{name}");
        let option = |name: &str| {
            let line = text.lines().find(|line| line.ends_with(name)).unwrap();
            line.split(' ').next().unwrap().to_owned()
        };
        assert_eq!((option(" tScheme").as_str(), option(" TmaxIC").as_str()), ("rk4", "0"));
        let step: f64 = option(" dtM").parse().unwrap();
        let lengths = cdpr_statics::inverse(&robot, &pose, &cdpr_statics::Load::none()).unwrap().lengths;
        for (cable, length) in robot.cables.iter().zip(lengths) {
            let speed = (cable.properties.axial_stiffness() / cable.properties.linear_density).sqrt();
            let passes = length / 20.0 / speed;
            assert!(step < 1.41 * passes && step > 0.01 * passes, "{name}: {step} {passes}");
        }
    }
    let mut light = robot("caroca");
    light.cables[3].properties.linear_density = 0.0;
    match export(&light, &Pose::at(0.0, 0.0, 1.75), Target::Moordyn) {
        Err(ExchangeError::NoPlace { field, .. }) => assert_eq!(field, "cables[3].linear_density"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_a_format_has_no_place_for_is_refused_by_its_field() {
    let refused = |name: &str, target| match export(&robot(name), &Pose::at(0.0, 0.0, 1.0), target) {
        Err(ExchangeError::NoPlace { field, .. }) => field,
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!(refused("ipanema-3", Target::Mjcf), "cables[0].pulley");
    assert_eq!(refused("ipanema-3", Target::Moorpy), "cables[0].pulley");
    assert_eq!(refused("ipanema-3", Target::Moordyn), "cables[0].pulley");
    assert_eq!(refused("caroca-law", Target::Mjcf), "cables[0].cable.law");
    let words =
        |robot: &Robot, target| export(robot, &Pose::at(0.0, 0.0, 10.0), target).unwrap_err().to_string();
    let maslow = words(&robot("caroca"), Target::Maslow);
    let expected = "plane is not given: the format has no place for it, expected a planar robot with four";
    assert!(maslow.starts_with(expected), "{maslow}");
    let point = Robot::from_json(include_str!("../../../docs/how-to/planner/stadium.json")).unwrap();
    let caspr = words(&point, Target::Caspr);
    let named = "expected a body; klipper, rrf and table take this robot at this pose";
    assert!(caspr.ends_with(named), "{caspr}");
}
