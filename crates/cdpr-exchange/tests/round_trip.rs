//! Robots that are exported and imported again are the same to rounding, but for what has no place there.

use cdpr_exchange::{ExchangeError, ForeignFile, ImportOptions, NoteKind, Target, export, import};
use cdpr_robot::library::{ROBOTS, named};
use cdpr_robot::{CatalogueCable, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{Load, inverse};

fn robot(name: &str) -> Robot {
    Robot::from_json(named(ROBOTS, name).unwrap().text).unwrap()
}

/// The robot that comes back, or the reason why it does not go out.
fn back(robot: &Robot, pose: &Pose, target: Target, options: &ImportOptions) -> Result<Robot, ExchangeError> {
    let exported = export(robot, pose, target)?;
    let files =
        exported.files.into_iter().map(|(ending, text)| ForeignFile { name: format!("r{ending}"), text });
    let found = import(&files.collect::<Vec<_>>(), options).unwrap_or_else(|error| panic!("{error}"));
    // Nothing in our own files is questioned.
    let questions: Vec<_> = found.notes.iter().filter(|note| note.kind == NoteKind::Questioned).collect();
    assert!(questions.is_empty(), "{questions:?}");
    Ok(found.robot)
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-13 * b.abs()
}

/// Pose at which a robot of the library rests, found on a grid.
fn rest(robot: &Robot) -> Option<Pose> {
    let count = robot.cables.len() as f64;
    let middle = robot.cables.iter().map(|cable| cable.exit_point).sum::<Vector3<f64>>() / count;
    let high = robot.cables.iter().map(|cable| cable.exit_point.z).fold(f64::NEG_INFINITY, f64::max);
    [0.5, 0.4, 0.6, 0.3, 0.7, 0.2].into_iter().find_map(|share| {
        let position = Vector3::new(middle.x, middle.y, share * high);
        let pose = Pose { position, rotation: Rotation3::from_euler_angles(0.02, -0.01, 0.03) };
        inverse(robot, &pose, &Load::none()).ok().map(|_| pose)
    })
}

fn assert_same_geometry(back: &Robot, robot: &Robot, name: &str) {
    assert_eq!(back.cables.len(), robot.cables.len(), "{name}");
    for (cable, was) in back.cables.iter().zip(&robot.cables) {
        assert_eq!(cable.exit_point, was.exit_point, "{name}");
        assert_eq!(cable.anchor_point, was.anchor_point, "{name}");
    }
    assert_eq!(back.platform.mass, robot.platform.mass, "{name}");
    assert_eq!(back.platform.center_of_mass, robot.platform.center_of_mass, "{name}");
    assert_eq!(back.gravity.vector(), robot.gravity.vector(), "{name}");
}

#[test]
fn robots_of_the_library_come_back_from_mujoco_with_cables_limits_and_source() {
    let mut tried = 0;
    for library in ROBOTS {
        let robot = Robot { ground_z: Some(-0.25), ..robot(library.name) };
        let Some(pose) = rest(&robot) else { continue };
        let again = match back(&robot, &pose, Target::Mjcf, &ImportOptions::default()) {
            Ok(again) => again,
            Err(ExchangeError::NoPlace { .. } | ExchangeError::Pose(_)) => continue,
            Err(error) => panic!("{}: {error}", library.name),
        };
        tried += 1;
        assert_same_geometry(&again, &robot, library.name);
        assert_eq!((&again.name, again.ground_z), (&robot.name, robot.ground_z));
        if let Some(inertia) = robot.platform.inertia {
            assert_eq!(again.platform.inertia, Some(inertia), "{}", library.name);
        }
        for (i, (cable, was)) in again.cables.iter().zip(&robot.cables).enumerate() {
            assert_eq!(cable.properties, was.properties, "{}", library.name);
            assert_eq!(again.limits(i), robot.limits(i), "{}", library.name);
        }
        let source = again.provenance.source.unwrap();
        assert!(source.ends_with(&robot.provenance.source.unwrap_or_default()), "{source}");
    }
    assert!(tried >= 5, "{tried}");
}

#[test]
fn robots_of_the_library_come_back_from_moorpy_with_stiffness_and_weight() {
    let mut tried = 0;
    for library in ROBOTS {
        let robot = robot(library.name);
        let Some(pose) = rest(&robot) else { continue };
        let options =
            ImportOptions { tension_limits: Some(robot.tension_limits), ..ImportOptions::default() };
        let again = match back(&robot, &pose, Target::Moorpy, &options) {
            Ok(again) => again,
            Err(ExchangeError::NoPlace { .. }) => continue,
            Err(error) => panic!("{}: {error}", library.name),
        };
        tried += 1;
        assert_same_geometry(&again, &robot, library.name);
        for (cable, was) in again.cables.iter().zip(&robot.cables) {
            assert!(close(cable.properties.axial_stiffness(), was.properties.axial_stiffness()));
            assert_eq!(cable.properties.linear_density, was.properties.linear_density);
            if was.properties.diameter.is_none() {
                assert!(close(cable.properties.section, was.properties.section));
            }
        }
        let [ours, theirs] =
            [&again, &robot].map(|robot| inverse(robot, &pose, &Load::none()).unwrap().lengths);
        // Lengths depend on weight and stiffness of the cables, not on how EA is divided.
        if robot.cables.iter().all(|cable| cable.tension_limits == Default::default())
            && robot.tension_reference.is_none()
        {
            for (ours, theirs) in ours.iter().zip(&theirs) {
                assert!((ours - theirs).abs() < 1e-9 * theirs, "{}: {ours} {theirs}", library.name);
            }
        }
    }
    assert!(tried >= 5, "{tried}");
}

#[test]
fn a_robot_with_another_gravity_comes_back() {
    let mut robot = robot("cogiro");
    robot.gravity = cdpr_robot::Gravity::from(3.71);
    let pose = Pose::at(0.0, 0.0, 2.0);
    for target in [Target::Mjcf, Target::Moorpy, Target::Moordyn] {
        let options =
            ImportOptions { tension_limits: Some(robot.tension_limits), ..ImportOptions::default() };
        let again = back(&robot, &pose, target, &options).unwrap();
        assert_eq!(again.gravity.vector(), robot.gravity.vector());
    }
}

#[test]
fn a_tendon_of_mujoco_that_was_edited_counts_and_is_questioned() {
    let (robot, pose) = (robot("cogiro"), Pose::at(0.0, 0.0, 2.0));
    let text = export(&robot, &pose, Target::Mjcf).unwrap().files.remove(0).1;
    let stiffness = text.split_once("stiffness=\"").unwrap().1.split('"').next().unwrap();
    let halved = format!("stiffness=\"{}\"", 0.5 * stiffness.parse::<f64>().unwrap());
    let edited = text.replacen(&format!("stiffness=\"{stiffness}\""), &halved, 1);
    let file = ForeignFile { name: "r.xml".to_owned(), text: edited };
    let found = import(&[file], &ImportOptions::default()).unwrap();
    for (i, (cable, was)) in found.robot.cables.iter().zip(&robot.cables).enumerate() {
        let modulus = was.properties.youngs_modulus * if i == 0 { 0.5 } else { 1.0 };
        assert!(close(cable.properties.youngs_modulus, modulus), "{i}: {modulus}");
        assert_eq!(cable.properties.section, was.properties.section);
    }
    let questions = found.notes.iter().filter(|note| note.kind == NoteKind::Questioned);
    let questions: Vec<&str> = questions.map(|note| note.text.as_str()).collect();
    assert!(questions.len() == 1 && questions[0].contains("the tendon's counts"), "{questions:?}");
}

#[test]
fn laws_that_caspr_has_no_place_for_are_named() {
    let notes = |name: &str| {
        let robot = robot(name);
        export(&robot, &rest(&robot).unwrap(), Target::Caspr).unwrap().notes
    };
    let of_laws = |notes: &[String]| notes.iter().any(|note| note.contains("elastic laws of cables"));
    assert!(of_laws(&notes("caroca-law")) && !of_laws(&notes("caroca")));
}

#[test]
fn springs_of_caspr_are_as_stiff_as_the_laws_of_the_cables_at_the_pose() {
    let robot = robot("caroca-law");
    let pose = rest(&robot).unwrap();
    let exported = export(&robot, &pose, Target::Caspr).unwrap();
    let cables = &exported.files[1].1;
    let stiffness = cables.split("<K>").skip(1).map(|rest| rest.split('<').next().unwrap().parse().unwrap());
    let stiffness: Vec<f64> = stiffness.collect();
    let found = inverse(&robot, &pose, &Load::none()).unwrap();
    for (i, (spring, tension)) in stiffness.iter().zip(&found.tensions).enumerate() {
        // The slope of the strain over the tension, by a difference within a segment of the law.
        let cable = &robot.cables[i].properties;
        let law = cable.law.as_ref().unwrap();
        let strain = |tension: f64| law.scaled_strain(tension) / cable.axial_stiffness();
        let slope = (strain(tension + 1e-3) - strain(tension - 1e-3)) / 2e-3;
        assert!((spring * slope - 1.0).abs() < 1e-6, "cable {}: {spring} N", i + 1);
    }
    let plain = robot.cables[0].properties.axial_stiffness();
    assert!(stiffness.iter().any(|spring| (spring / plain - 1.0).abs() > 0.05), "{stiffness:?}");
}

#[test]
fn the_cable_that_is_given_goes_first() {
    let (robot, pose) = (robot("cogiro"), Pose::at(0.0, 0.0, 2.0));
    let properties = cdpr_robot::CableProperties::linear(1e-5, 0.1, 1e11);
    let cable = CatalogueCable { name: "mine".to_owned(), source: None, properties: properties.clone() };
    let options = ImportOptions { cable: Some(cable), ..ImportOptions::default() };
    let again = back(&robot, &pose, Target::Mjcf, &options).unwrap();
    // The file has the diameter, which the cable that is given lacks.
    let diameter = robot.cables[0].properties.diameter;
    let expected = cdpr_robot::CableProperties { diameter, ..properties };
    assert!(
        again.cables.iter().all(|cable| cable.properties == expected),
        "{:?}",
        again.cables[0].properties
    );
}
