//! Inspection of robots: what is odd in a file, and what is only worth knowing.

use cdpr_assess::{Severity, doubtful_rest, inspect};
use cdpr_robot::{Gravity, Pose, Pulley, Robot, TensionLimits, TensionReference, Vector3};
use cdpr_statics::{DirectStart, Load, direct, inverse, rough_pose};

fn about_gravity(gravity: impl Into<Gravity>) -> Vec<(Severity, String)> {
    let mut robot = Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap();
    robot.gravity = gravity.into();
    let findings = inspect(&robot).into_iter().filter(|finding| finding.field == "gravity");
    findings.map(|finding| (finding.severity, finding.why)).collect()
}

#[test]
fn a_tilted_base_is_noted_with_its_angle_and_gravity_is_compared_by_its_magnitude() {
    assert_eq!(about_gravity(9.81), []);
    assert_eq!(about_gravity(Vector3::new(0.0, 0.0, -9.81)), []);
    let note = |why: &str| (Severity::Note, why.to_owned());
    let tilt = 9.81 * Vector3::new(0.1_f64.sin(), 0.0, -0.1_f64.cos());
    assert_eq!(about_gravity(tilt), [note("the base is tilted by 5.73\u{b0}")]);
    let moon = 1.62 * Vector3::new(0.0, 0.6, -0.8);
    assert_eq!(
        about_gravity(moon),
        [note("the base is tilted by 36.87\u{b0}"), note("not that of the Earth's surface")]
    );
    let up = about_gravity(Vector3::new(0.0, 0.0, 9.81));
    assert!(
        matches!(&up[..], [(Severity::Warning, why)] if why.ends_with("things fall towards +z")),
        "{up:?}"
    );
}

#[test]
fn a_modulus_far_from_the_law_and_one_anchor_point_in_millimetres_are_named() {
    let law = include_str!("../../../data/robots/caroca-law.json");
    let fields = |robot: &Robot| -> Vec<String> {
        let found = inspect(robot).into_iter().filter(|finding| finding.severity == Severity::Warning);
        found.map(|finding| finding.field).collect()
    };
    assert!(fields(&Robot::from_json(law).unwrap()).is_empty());
    let robot = Robot::from_json(&law.replace("1.022e11", "1.022e9")).unwrap();
    assert!(fields(&robot).contains(&"cable.youngs_modulus".to_owned()), "{:?}", fields(&robot));
    let mut robot = Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap();
    robot.cables[2].anchor_point *= 1000.0;
    assert!(fields(&robot).contains(&"cables[2].anchor_point".to_owned()), "{:?}", fields(&robot));
}

#[test]
fn wheels_that_cables_hardly_touch_or_come_back_over_and_wheels_in_one_place_are_named() {
    let cogiro = Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap();
    let about_pulleys = |axis: &dyn Fn(Vector3<f64>) -> Vector3<f64>| -> Vec<(Severity, String)> {
        let mut robot = cogiro.clone();
        // Two cables that enter at one place.
        robot.cables[1].exit_point = robot.cables[0].exit_point + Vector3::new(0.01, 0.0, 0.0);
        for cable in &mut robot.cables {
            cable.pulley = Some(Pulley { radius: 0.05, axis: axis(cable.exit_point) });
        }
        let found = inspect(&robot).into_iter().filter(|finding| finding.field.contains("pulley"));
        found.map(|finding| (finding.severity, finding.field)).collect()
    };
    let note = (Severity::Note, "cables[1].pulley".to_owned());
    // From below, over the top, and down to the platform: as such robots are built.
    assert_eq!(about_pulleys(&|_| Vector3::z()), std::slice::from_ref(&note));
    // Straight on from outside the frame to the platform, and back from it.
    let towards = |exit: Vector3<f64>| Vector3::new(0.0, 0.0, 2.7) - exit;
    let warned = |found: &[(Severity, String)]| {
        found
            .iter()
            .filter(|(severity, field)| *severity == Severity::Warning && field.ends_with("axis"))
            .count()
    };
    let straight_on = about_pulleys(&towards);
    assert!(warned(&straight_on) >= 4 && straight_on.contains(&note), "{straight_on:?}");
    let sideways = |exit: Vector3<f64>| 0.2 * exit.norm() * Vector3::new(-exit.y, exit.x, 0.0).normalize();
    let back = about_pulleys(&|exit| sideways(exit) - towards(exit));
    assert!(warned(&back) >= 4 && back.contains(&note), "{back:?}");
}

/// A robot of the library.
fn named(name: &str) -> Robot {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/robots");
    Robot::from_json(&std::fs::read_to_string(format!("{folder}/{name}.json")).unwrap()).unwrap()
}

/// Value and reason of the question about where a robot rests with these lengths.
fn asked_of_rest(robot: &Robot, lengths: &[f64], load: &Load) -> Option<String> {
    let start = rough_pose(robot, lengths);
    let found = direct(robot, lengths, load, DirectStart::Pose(&start)).unwrap();
    let doubt = doubtful_rest(robot, "the equilibrium", (lengths, load), &found, None)?;
    Some(format!("{} {}", doubt.value, doubt.why))
}

#[test]
fn lengths_of_another_robot_are_questioned_where_the_platform_rests_and_its_own_are_not() {
    let held = |name: &str, pose: Pose| {
        let robot = named(name);
        let lengths = inverse(&robot, &pose, &Load::none()).unwrap().lengths;
        for load in [Load::none(), Load::payload(0.2 * robot.platform.mass)] {
            assert_eq!(asked_of_rest(&robot, &lengths, &load), None, "{name}");
        }
        lengths
    };
    let cogiro = held("cogiro", Pose::at(0.0, 0.0, 2.7));
    let caroca = held("caroca", Pose::at(0.0, 0.0, 1.75));
    let lucia = held("expo2015-lucia", Pose::at(-0.5, 0.0, 3.0));
    let handling = held("copacabana-handling", Pose::at(-0.1, 0.3, 1.1));
    for (robot, lengths, expected) in [
        ("caroca", &cogiro, "below the floor of the base frame, z = 0"),
        ("copacabana-handling", &caroca, "below the lowest exit point"),
        ("ipanema-2", &lucia, "below the floor"),
        ("copacabana-inspection", &handling, "with 4 of 8 cables slack"),
        ("cable-robot-simulator", &cogiro, "with 8 of 8 cables slack or below"),
    ] {
        let asked = asked_of_rest(&named(robot), lengths, &Load::none()).unwrap();
        assert!(asked.contains(expected), "{robot}: {asked}");
    }
}

#[test]
fn a_platform_below_the_ground_or_turned_over_is_questioned() {
    let mut robot = named("caroca");
    let wanted = Pose::at(0.0, 0.0, 0.6);
    let lengths = inverse(&robot, &wanted, &Load::none()).unwrap().lengths;
    assert_eq!(asked_of_rest(&robot, &lengths, &Load::none()), None);
    robot.ground_z = Some(0.5);
    let asked = asked_of_rest(&robot, &lengths, &Load::none()).unwrap();
    assert!(asked.contains("below the ground, ground_z = 0.5 m"), "{asked}");
    robot.ground_z = None;
    // From a start that is turned over itself.
    let found = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&wanted)).unwrap();
    let start = Pose { rotation: cdpr_robot::Rotation3::from_euler_angles(3.0, 0.0, 0.0), ..wanted };
    let given = (&lengths[..], &Load::none());
    let asked = doubtful_rest(&robot, "it", given, &found, Some(&start)).unwrap();
    assert!(asked.value.starts_with("turned over by 172 degrees"), "{asked}");
}

#[test]
fn a_platform_that_stays_at_its_start_is_not_turned_from_it() {
    let robot = named("caroca");
    for yaw in 1..=20 {
        let rotation = cdpr_robot::Rotation3::from_euler_angles(0.0, 0.0, 0.005 * f64::from(yaw));
        let wanted = Pose { rotation, ..Pose::at(0.0, 0.0, 1.75) };
        let lengths = inverse(&robot, &wanted, &Load::none()).unwrap().lengths;
        let found = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&wanted)).unwrap();
        let given = (&lengths[..], &Load::none());
        let asked = doubtful_rest(&robot, "it", given, &found, Some(&wanted));
        assert!(asked.is_none(), "{asked:?}");
    }
}

/// Fields of the warnings about the inertia of a robot and the properties of its cables.
fn warned(robot: &Robot) -> Vec<String> {
    let warnings = inspect(robot).into_iter().filter(|finding| finding.severity == Severity::Warning);
    let fields = warnings.map(|finding| finding.field);
    fields.filter(|field| field == "platform.inertia" || field.starts_with("cable.")).collect()
}

#[test]
fn an_inertia_or_a_density_ten_times_off_is_warned_about_and_no_robot_of_the_library_is() {
    let mut with_inertia = 0;
    let tutorial = include_str!("../../../docs/tutorials/my-robot/robot.json");
    for text in cdpr_robot::library::ROBOTS.iter().map(|file| file.text).chain([tutorial]) {
        let robot = Robot::from_json(text).unwrap();
        assert_eq!(warned(&robot), [""; 0], "{}", robot.name);
        let Some(inertia) = robot.platform.inertia else { continue };
        with_inertia += 1;
        for factor in [0.001, 0.1, 10.0, 1000.0] {
            let mut other = robot.clone();
            other.platform.inertia = Some(factor * inertia);
            assert_eq!(warned(&other), ["platform.inertia"], "{} times {factor}", robot.name);
        }
    }
    assert_eq!(with_inertia, 6);
    let field = |section: f64, density: f64| {
        let mut robot = named("cogiro");
        for cable in &mut robot.cables {
            (cable.properties.section, cable.properties.linear_density) = (section, density);
        }
        warned(&robot)
    };
    // A full circle of 4 mm with few digits, then sections of none.
    for (section, density, expected) in [
        (1.256e-5, 0.064, "cable.section"),
        (1e-5, 0.05, "cable.linear_density"),
        (8.2051e-6, 0.64, "cable.linear_density"),
        (8.2051e-6, 0.0034, "cable.linear_density"),
    ] {
        assert_eq!(field(section, density), [expected], "{density} kg/m on {section} m2");
    }
    for density in [0.0, 0.0057, 0.0082, 0.022, 0.064, 0.075] {
        assert_eq!(field(8.2051e-6, density), [""; 0], "{density} kg/m");
    }
}

#[test]
fn limits_in_kilonewtons_are_in_doubt_and_not_the_preferred_tensions() {
    let robot = |limits: TensionLimits, reference: f64| {
        let mut robot = Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap();
        (robot.tension_limits, robot.tension_reference) = (limits, Some(TensionReference::All(reference)));
        let found = inspect(&robot).into_iter();
        found.map(|of| (of.severity, of.field, of.remedy)).collect::<Vec<_>>()
    };
    let warning = |field: &str, remedy: &str| (Severity::Warning, field.to_owned(), remedy.to_owned());
    let kilonewtons = TensionLimits { min: 0.001, max: 5.0 };
    assert_eq!(robot(kilonewtons, 400.0), [warning("tension_limits.max", "5000 N, if 5 is in kN")]);
    let newtons = TensionLimits { min: 1.0, max: 5000.0 };
    assert_eq!(robot(newtons, 4e5), [warning("tension_reference", "400 N, if 4.000e5 is in mN")]);
    assert_eq!(robot(newtons, 400.0), []);
}
