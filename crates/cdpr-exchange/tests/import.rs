//! Imported robots stand where the geometry of the other programs says.

use crate::fixtures::{BODIES, CABLES_OF_CASPR, IRMA, TABLE, WIREX, YAML, all_options, imported, options};
use cdpr_exchange::{ExchangeError, ImportOptions, Imported, Lacking, NoteKind};
use cdpr_robot::{Pose, Pulley, Robot, Rotation3, Vector3};
use std::f64::consts::PI;

/// Length of a straight cable from `d` over a pulley of radius `r` and swivel axis `k` to `p`, as CASPR,
/// WireX and IRMA compute it: an independent transcription.
fn length_over_pulley(d: Vector3<f64>, k: Vector3<f64>, r: f64, p: Vector3<f64>) -> f64 {
    let d_to_p = p - d;
    let u = (d_to_p - k * k.dot(&d_to_p)).normalize();
    let (x, y) = (u.dot(&d_to_p), k.dot(&d_to_p));
    let psi = 2.0 * (y / x + ((y / x).powi(2) + 1.0 - 2.0 * r / x).sqrt()).atan();
    let leave = d + r * (u + psi.cos() * u + psi.sin() * k);
    r * (PI - psi) + (p - leave).norm()
}

/// The greatest difference of the lengths of straight cables from formula and points alone [m].
fn off(robot: &Robot) -> f64 {
    let rotations = [Rotation3::identity(), Rotation3::from_euler_angles(0.2, -0.1, 0.4)];
    let middle =
        robot.cables.iter().map(|cable| cable.exit_point).sum::<Vector3<f64>>() / robot.cables.len() as f64;
    let below = |x: f64, z: f64| middle + Vector3::new(x, 0.3 * x, z);
    let poses = rotations.iter().flat_map(|rotation| {
        [below(1.1, -2.0), below(-1.3, -1.2), below(0.7, -2.8)]
            .map(|position| Pose { position, rotation: *rotation })
    });
    let mut worst: f64 = 0.0;
    for pose in poses {
        for (i, cable) in robot.cables.iter().enumerate() {
            let span = robot.span(&pose, i);
            let level = robot.gravity.level().map_or(span, |level| level * span);
            let ours = robot.cable(i).straight_length_in_space(level);
            let theirs = match cable.pulley {
                Some(Pulley { radius, axis }) => {
                    let p = cable.exit_point + span;
                    length_over_pulley(cable.exit_point, axis.normalize(), radius, p)
                }
                None => span.norm(),
            };
            worst = worst.max((ours - theirs).abs());
        }
    }
    worst
}

fn texts(imported: &Imported, kind: NoteKind) -> Vec<String> {
    imported.notes.iter().filter(|note| note.kind == kind).map(|note| note.text.clone()).collect()
}

fn caspr(options: &ImportOptions) -> Result<Imported, ExchangeError> {
    imported(&[("CoGiRo_bodies.xml", BODIES), ("CoGiRo_cables.xml", CABLES_OF_CASPR)], options)
}

#[test]
fn a_robot_of_caspr_has_its_pulleys_its_shifted_anchors_and_its_body() {
    let found = caspr(&options()).unwrap();
    let robot = &found.robot;
    assert_eq!((robot.name.as_str(), robot.cables.len(), robot.platform.mass), ("CoGiRo", 2, 91.058));
    let [first, second] = &robot.cables[..] else { panic!() };
    assert_eq!(first.pulley, Some(Pulley { radius: 0.045, axis: Vector3::z() }));
    assert_eq!(first.exit_point, Vector3::new(1.659, -2.85, 3.221));
    // attachment_reference="com": its location is that from the centre of mass.
    let c = Vector3::new(-0.034, -0.013, 0.264);
    assert_eq!(robot.platform.center_of_mass, c);
    assert!((second.anchor_point - (Vector3::new(-0.13, -0.21, -0.105) + c)).norm() < 1e-15);
    assert_eq!((robot.limits(0).min, robot.limits(0).max), (1.0, 1000.0));
    assert_eq!((robot.limits(1).min, robot.limits(1).max), (5.0, 800.0));
    assert_eq!(robot.platform.inertia.unwrap()[(0, 2)], 3.012);
    assert!(off(robot) < 1e-9, "{}", off(robot));
    let no_place = texts(&found, NoteKind::NoPlace).join("\n");
    for said in
        ["further cable sets: springs", "q_initial", "diameter 0.004", "end_location", "display_range"]
    {
        assert!(no_place.contains(said), "{said}: {no_place}");
    }
    assert!(robot.provenance.assumed.iter().any(|text| text.contains("Steel rope, 4 mm")));
}

#[test]
fn a_spring_of_caspr_has_its_stiffness_and_the_density_of_the_cable_that_is_given() {
    let springs = ImportOptions { cable_set: Some("springs".to_owned()), ..options() };
    let robot = caspr(&springs).unwrap().robot;
    let cable = &options().cable.unwrap().properties;
    assert!((robot.cables[0].properties.axial_stiffness() - 350_000.0).abs() < 1e-6);
    assert_eq!(robot.cables[0].properties.linear_density, cable.linear_density);
}

#[test]
fn an_inertia_about_the_joint_of_caspr_is_moved_to_the_centre_of_mass() {
    let about_joint = BODIES.replace("ref=\"com\"", "ref=\"joint\"").replace("<Ixx>36.598", "<Ixx>60");
    let found = imported(&[("b", &about_joint), ("c", CABLES_OF_CASPR)], &options()).unwrap();
    let (m, c) = (91.058, Vector3::new(-0.034_f64, -0.013, 0.264));
    let expected = 60.0 - m * (c.y * c.y + c.z * c.z);
    assert!((found.robot.platform.inertia.unwrap()[(0, 0)] - expected).abs() < 1e-12);
}

#[test]
fn a_robot_of_wirex_has_its_axes_and_its_template_is_questioned() {
    let found = imported(&[("CoGiRo.wcrfx", WIREX)], &ImportOptions::default()).unwrap();
    let robot = &found.robot;
    assert_eq!(robot.cables[0].pulley, Some(Pulley { radius: 0.1, axis: Vector3::new(0.6, 0.0, 0.8) }));
    assert_eq!(robot.cables[1].pulley, Some(Pulley { radius: 0.1, axis: Vector3::z() }));
    assert!(off(robot) < 1e-9, "{}", off(robot));
    let properties = &robot.cables[0].properties;
    assert_eq!((properties.youngs_modulus, properties.linear_density), (1.1e11, 0.023));
    assert!((properties.section - PI * 3.6e-5).abs() < 1e-18);
    assert_eq!(
        texts(&found, NoteKind::Questioned),
        [
            "the cable is that of the template: 6 mm radius, 0.023 kg/m, 110 GPa",
            "the greatest force of the winch, 720 N, is that of the template",
            "the mass of 25 kg and the centre of mass (0, 1, 0.2) m are those of the template",
            "the inertia, Ixx 14 alone, is that of the template"
        ]
    );
    let grade = WIREX.replace("110000000000", "1770000000");
    let found = imported(&[("Lucia.wcrfx", &grade)], &ImportOptions::default()).unwrap();
    assert!(texts(&found, NoteKind::Questioned)[0].starts_with("the modulus is a grade of steel wire"));
}

#[test]
fn the_yaml_of_okermorgant_has_its_points_and_its_rods_are_no_cables() {
    let found = imported(&[("sdf/caroca.yaml", YAML)], &options()).unwrap();
    let robot = &found.robot;
    assert_eq!((robot.name.as_str(), robot.cables.len(), robot.platform.mass), ("caroca", 8, 150.0));
    assert_eq!((robot.tension_limits.min, robot.tension_limits.max), (50.0, 10000.0));
    assert_eq!(robot.cables[7].anchor_point, Vector3::new(-0.6, 0.3, -0.2));
    assert!(off(robot) < 1e-9, "{}", off(robot));
    assert!(texts(&found, NoteKind::NoPlace)[0].contains("cable"));
    let lacking = imported(&[("caroca.yaml", YAML)], &ImportOptions::default()).unwrap_err();
    assert!(matches!(lacking, ExchangeError::Lacking(ref lacking) if lacking[..] == [Lacking::Cable]));
}

#[test]
fn a_robot_of_irma_has_its_vertical_and_leaves_out_what_is_not_active() {
    let found = imported(&[("Grab.json", IRMA)], &ImportOptions { mass: None, ..all_options() }).unwrap();
    let robot = &found.robot;
    assert_eq!(robot.cables.len(), 1);
    assert_eq!(robot.cables[0].pulley.unwrap().radius, 0.022482);
    let up = Vector3::<f64>::new(0.0086989, -0.0058238, 0.9999452);
    assert!((robot.gravity.vector() + 9.81 * up).norm() < 1e-6);
    let older = IRMA.replace("gravity_axis", "grav_ax");
    assert_eq!(imported(&[("Grab.json", &older)], &all_options()).unwrap().robot.gravity, robot.gravity);
    assert!(off(robot) < 1e-9, "{}", off(robot));
    assert_eq!(texts(&found, NoteKind::Questioned), ["the mass is 1 kg: inertias are those per kilogram"]);
    assert!(texts(&found, NoteKind::NoPlace).contains(&"actuators that are not active: 2".to_owned()));
}

#[test]
fn a_table_of_points_has_its_pulleys_and_lists_its_other_columns() {
    let found = imported(&[("mine.csv", TABLE)], &all_options()).unwrap();
    let robot = &found.robot;
    assert_eq!(robot.cables[0].pulley, Some(Pulley { radius: 0.03, axis: -Vector3::z() }));
    assert_eq!((robot.cables[1].pulley, robot.platform.mass), (None, 12.0));
    assert!(off(robot) < 1e-9, "{}", off(robot));
    assert_eq!(texts(&found, NoteKind::NoPlace), ["column colour"]);
    let lacking = imported(&[("mine.csv", TABLE)], &ImportOptions::default()).unwrap_err();
    assert_eq!(
        lacking.to_string(),
        "the files do not have section, density and modulus of the cables, nor the mass of the platform, nor \
         limits of tension"
    );
}

#[test]
fn limits_that_replace_those_of_the_file_and_a_column_that_is_missing_are_named() {
    let found = caspr(&all_options()).unwrap();
    let said = texts(&found, NoteKind::Assumed).join("\n");
    assert!(
        said.contains(
            "between 1 N and 500 N, instead of least ones of 0 to 5 N and greatest ones of 800 to 1000 N"
        ),
        "{said}"
    );
    let without = TABLE.replace("axis_x", "other").replace("axis_y", "another");
    let error = imported(&[("mine.csv", &without)], &all_options()).map(drop).unwrap_err().to_string();
    assert!(error.contains("axis_x is missing"), "{error}");
}

#[test]
fn a_cable_of_the_catalogue_says_what_it_replaces_of_a_table_and_leaves_what_it_lacks() {
    let table = "exit_x,exit_y,exit_z,anchor_x,anchor_y,anchor_z,diameter_mm,breaking_force_kN\n\
                 -2,-1.5,3,0.2,-0.1,0,6,21\n2,1.5,3,-0.2,0.1,0,6,22\n";
    let mut with = all_options();
    let of = |options: &ImportOptions| imported(&[("plate.csv", table)], options).unwrap();
    let found = of(&with);
    let said = texts(&found, NoteKind::Assumed).join("\n");
    assert!(
        said.contains("diameters of 0.006 m") && said.contains("breaking forces of 21000 to 22000 N"),
        "{said}"
    );
    assert!(said.contains("in the files"), "{said}");
    let given = with.cable.as_ref().unwrap().properties.clone();
    assert_eq!(found.robot.cables[1].properties, given);
    // What the cable of the catalogue lacks stays.
    let cable = with.cable.as_mut().unwrap();
    (cable.properties.diameter, cable.properties.breaking_force) = (None, None);
    let found = of(&with);
    let kept =
        found.robot.cables.iter().map(|cable| (cable.properties.diameter, cable.properties.breaking_force));
    assert_eq!(kept.collect::<Vec<_>>(), [(Some(0.006), Some(21e3)), (Some(0.006), Some(22e3))]);
    let said = texts(&found, NoteKind::Assumed).join("\n");
    assert!(
        said.contains("the breaking forces of the cables are those of the files, 21000 to 22000 N"),
        "{said}"
    );
}
