//! What files mean: planar robots, points, offsets, limits in other places, robots within other entries.

use crate::fixtures::{
    BODIES, CABLES_OF_CASPR, IRMA, TABLE, WIREX, YAML, all_options, catalogue, imported, notes, options,
    reference,
};
use cdpr_exchange::{ExchangeError, ImportOptions, Imported, NoteKind};
use cdpr_robot::{Plane, Pose, TensionLimits, Vector3};
use cdpr_statics::{Load, inverse};

/// The robot of a case that users have found, with the kinds of its files.
fn case(folder: &str, stem: &str, options: &ImportOptions) -> Imported {
    let [bodies, cables] = ["bodies", "cables"].map(|part| format!("{stem}_{part}.xml"));
    let files = [
        (bodies.as_str(), reference(&format!("{folder}/{bodies}"))),
        (cables.as_str(), reference(&format!("{folder}/{cables}"))),
    ];
    let files: Vec<_> = files.iter().map(|(name, text)| (*name, text.as_str())).collect();
    imported(&files, options).unwrap()
}

fn questions(found: &Imported) -> Vec<String> {
    notes(found, NoteKind::Questioned)
}

#[test]
fn a_planar_robot_of_caspr_needs_the_inertia_about_its_normal_alone() {
    let found = case("caspr-planar-izz-only", "plate", &options());
    let robot = &found.robot;
    assert_eq!((robot.plane, robot.platform.point), (Some(Plane::Xy), false));
    assert_eq!(robot.platform.inertia.unwrap()[(2, 2)], 0.1);
    assert_eq!(questions(&found), [""; 0]);
    // A rotation in the plane has the frequency that Izz alone decides.
    let pose = Pose::at(0.1, 0.0, 0.0);
    assert!(inverse(robot, &pose, &Load::none()).is_ok());
}

#[test]
fn a_point_mass_of_caspr_moves_in_its_plane() {
    let found = case("caspr-point-xz", "point", &options());
    let robot = &found.robot;
    assert_eq!((robot.plane, robot.platform.point), (Some(Plane::Xz), true));
    assert_eq!(robot.platform.inertia, None);
    assert_eq!(questions(&found), [""; 0]);
    for (joint, plane) in [("P_XY", Some(Plane::Xy)), ("P_XZ", Some(Plane::Xz)), ("T_XYZ", None)] {
        let bodies = BODIES.replace("SPATIAL_EULER_XYZ", joint);
        let found = imported(&[("b", &bodies), ("c", CABLES_OF_CASPR)], &options()).unwrap();
        assert_eq!((found.robot.plane, found.robot.platform.point), (plane, true));
        // A platform that cannot rotate: r = p + a - b for every cable, whatever its anchor point.
        let spatial = imported(&[("b", BODIES), ("c", CABLES_OF_CASPR)], &options()).unwrap().robot;
        let pose = Pose::at(0.4, -0.3, 1.2);
        for i in 0..2 {
            assert!((found.robot.span(&pose, i) - spatial.span(&pose, i)).norm() < 1e-15);
            assert_eq!(found.robot.cables[i].anchor_point, Vector3::zeros());
        }
    }
    let bodies = BODIES.replace("SPATIAL_EULER_XYZ", "P_X");
    let refused = imported(&[("b", &bodies), ("c", CABLES_OF_CASPR)], &options()).map(drop).unwrap_err();
    assert!(refused.to_string().contains("joint/@type is \"P_X\": expected SPATIAL_*, T_XYZ, or PLANAR_"));
}

#[test]
fn the_joint_of_caspr_moves_from_the_location_of_its_parent() {
    let found = case("caspr-parent-offset", "plate", &options());
    // At q = (1, 1, 0) all cables are equally long: from (0, 0.25, 0) to (0.8, 0.25, 0.9).
    let pose = Pose::at(1.0, 0.0, 1.0);
    for i in 0..4 {
        assert!((found.robot.span(&pose, i).norm() - 1.45_f64.sqrt()).abs() < 1e-15);
    }
    // With the cable of 2 mm that the trial took: 1.2308 m where the location is dropped.
    let options = ImportOptions { cable: Some(catalogue("steel-2mm")), ..ImportOptions::default() };
    let robot = case("caspr-parent-offset", "plate", &options).robot;
    let lengths = inverse(&robot, &pose, &Load::none()).unwrap().lengths;
    assert!((lengths[0] - 1.2050).abs() < 5e-5 && (lengths[2] - 1.2050).abs() < 5e-5, "{lengths:?}");
    let said = notes(&found, NoteKind::Assumed).join("\n");
    assert!(said.contains("the origin of the base frame is the joint's, (0, 0.25, 0) m"), "{said}");
}

#[test]
fn limits_of_the_application_of_wirex_are_limits_of_the_robot() {
    let text = reference("limits-in-application.wcrfx");
    let limits = |text: &str| imported(&[("box.wcrfx", text)], &options()).map(|found| found.robot.limits(0));
    assert_eq!(limits(&text).unwrap(), TensionLimits { min: 30.0, max: 800.0 });
    // Those of winch and cable hold as well: the stricter ones count.
    let winch = |max: &str| {
        let winch = format!(
            "</robot><winch name=\"w\"><cable f_max=\"{max}\"/></winch><cable minimum_load=\"40\" \
             breaking_load=\"1e4\"/>"
        );
        limits(&text.replace("</robot>", &winch)).unwrap()
    };
    assert_eq!(winch("700"), TensionLimits { min: 40.0, max: 700.0 });
    assert_eq!(winch("900"), TensionLimits { min: 40.0, max: 800.0 });
    let without = text.replace("max_cable_load=\"800\"", "");
    assert!(matches!(limits(&without), Err(ExchangeError::Lacking(_))));
}

#[test]
fn the_motion_pattern_of_wirex_is_that_of_the_robot() {
    let of = |pattern: &str, text: &str| {
        let text = text.replace("motionpattern=\"3R3T\"", &format!("motionpattern=\"{pattern}\""));
        imported(&[("r.wcrfx", &text)], &all_options())
            .map(|found| (found.robot.plane, found.robot.platform.point))
    };
    let text = reference("limits-in-application.wcrfx");
    assert_eq!(of("3T", &text).unwrap(), (None, true));
    assert_eq!(of("1R2T", &text).unwrap(), (Some(Plane::Xy), false));
    // Exit points in the plane of x and z.
    let upright = ["-1 2", "1 2", "1 0", "-1 0"].map(|point| {
        let (x, z) = point.split_once(' ').unwrap();
        format!("<chain><base x=\"{x}\" y=\"0\" z=\"{z}\"/><platform x=\"0\" y=\"0\" z=\"0\"/></chain>")
    });
    let (begin, end) = (text.find("<chain").unwrap(), text.find("</geometry>").unwrap());
    let upright = format!("{}{}{}", &text[..begin], upright.concat(), &text[end..]);
    assert_eq!(of("1R2T", &upright).unwrap(), (Some(Plane::Xz), false));
    assert_eq!(of("2T", &upright).unwrap(), (Some(Plane::Xz), true));
    assert!(of("2R3T", &text).unwrap_err().to_string().contains("expected 3R3T, 3T, 1R2T or 2T"));
    assert!(of("1R2T", WIREX).unwrap_err().to_string().contains("lie in no plane of the base frame"));
}

#[test]
fn a_robot_in_yaml_is_found_within_other_entries_and_documents() {
    let text = reference("nested-model.yaml");
    let found = imported(&[("nested.yaml", &text)], &options()).unwrap();
    let robot = &found.robot;
    assert_eq!((robot.cables.len(), robot.platform.mass), (4, 20.0));
    assert_eq!(robot.limits(0), TensionLimits { min: 5.0, max: 900.0 });
    assert_eq!(questions(&found), [""; 0]);
    let second = format!("calibrated: yes\n---\n{YAML}");
    let found = imported(&[("r.yaml", &second)], &options()).unwrap();
    assert_eq!(found.robot.cables.len(), 8);
    assert_eq!(questions(&found), ["a further document: not known and not imported"]);
    let lost = format!("{YAML}---\nlimits: {{min: 3}}\n");
    let found = imported(&[("r.yaml", &lost)], &options()).unwrap();
    assert_eq!(questions(&found), ["a further document: not known and not imported"]);
    let two = format!("{YAML}---\n{YAML}");
    let refused = imported(&[("r.yaml", &two)], &options()).map(drop).unwrap_err().to_string();
    assert!(refused.contains("points is a further robot: expected one"), "{refused}");
    let frame = YAML.replace("frame: {color", "global_frame: {position: [0, 0, 2]}\nframe: {color");
    let found = imported(&[("r.yaml", &frame)], &options()).unwrap();
    assert_eq!(questions(&found), ["global_frame: not known and not imported"]);
}

#[test]
fn columns_of_one_meaning_are_refused() {
    let with = |name: &str| {
        let text = TABLE.replace(",colour", &format!(",{name}")).replace("red", "1").replace("blue", "1");
        imported(&[("r.csv", &text)], &all_options()).map(|found| questions(&found))
    };
    let twice = with("exit_x").unwrap_err().to_string();
    assert!(twice.contains("r.csv, line 1: column exit_x is there twice"), "{twice}");
    for (name, meant) in [
        ("Exit X", "exit_x"),
        ("bx", "exit_x"),
        ("EXIT.Y [mm]", "exit_y"),
        ("ax", "anchor_x"),
        ("anchor point z (m)", "anchor_z"),
        ("Pulley radius", "radius"),
    ] {
        let message = with(name).unwrap_err().to_string();
        let said = format!("{name} is a second column of {meant}, after ");
        assert!(message.contains("line 1, column 11") && message.contains(&said), "{message}");
    }
    assert_eq!(with("Tmax [kN]").unwrap(), [""; 0]);
    assert_eq!(with("offset").unwrap(), ["column offset: not known and not imported"]);
}

#[test]
fn columns_are_known_by_meaning_and_unit() {
    let table = "Exit X [mm],Exit Y [mm],Exit Z [mm],ax,ay,az,Lead (m),min tension,max tension [kN],cable\n\
                 -2000,-1500,3000,0.2,-0.1,0,1.5,5,2,1\n2000,1500,3000,-0.2,0.1,0,0,5,2,2\n";
    let found = imported(&[("r.dat", table)], &ImportOptions { mass: Some(3.0), ..options() }).unwrap();
    let cable = &found.robot.cables[0];
    assert_eq!(cable.exit_point, Vector3::new(-2.0, -1.5, 3.0));
    assert_eq!((cable.anchor_point, cable.lead), (Vector3::new(0.2, -0.1, 0.0), 1.5));
    assert_eq!(found.robot.tension_limits, TensionLimits { min: 5.0, max: 2000.0 });
    assert!(
        questions(&found)[0].starts_with("columns ax, ay, az: a is read as the anchor point on the platform")
    );
    let by_commas = imported(&[("r.csv", TABLE)], &all_options()).unwrap().robot.cables;
    for text in [TABLE.replace(',', ";").replace('.', ","), TABLE.replace(',', "\t")] {
        assert_eq!(imported(&[("r.csv", &text)], &all_options()).unwrap().robot.cables, by_commas);
    }
}

#[test]
fn what_is_there_twice_and_what_is_not_known_is_not_dropped() {
    let twice = |files: &[(&str, &str)]| imported(files, &all_options()).map(drop).unwrap_err().to_string();
    let bodies = BODIES.replace("<mass>", "<mass>3</mass><mass>");
    assert!(twice(&[("b", &bodies), ("c", CABLES_OF_CASPR)]).contains("physical/mass[2] is there twice"));
    let sets = CABLES_OF_CASPR.replace("id=\"springs\"", "id=\"pulleys\"");
    assert!(twice(&[("b", BODIES), ("c", &sets)]).contains("cable_set[2]/@id is there twice"));
    let wirex = WIREX.replace("<controller", "<platform mass=\"3\"/><controller");
    assert!(twice(&[("r.wcrfx", &wirex)]).contains("robot/platform[2] is there twice"));
    let wirex = WIREX.replace("</models>", "<winch name=\"IPAnema-Winde\"/></models>");
    assert!(twice(&[("r.wcrfx", &wirex)]).contains("there twice: expected one of a name"));
    let said = |files: &[(&str, &str)]| questions(&imported(files, &all_options()).unwrap()).join("\n");
    let bodies = BODIES.replace("<parent>", "<scale>2</scale><parent>");
    let scale = "bodies_system/links/link_rigid: scale 2: not known and not imported";
    assert!(said(&[("b", &bodies), ("c", CABLES_OF_CASPR)]).contains(scale));
    let irma = IRMA.replace("THREE_R_THREE_T", "THREE_T");
    assert!(said(&[("r.json", &irma)]).contains("motion_pattern THREE_T: the platform has all six motions"));
    let irma = IRMA.replace("\"pos_PG_loc\"", "\"ext_force_loc\": [[0], [0], [-3]], \"pos_PG_loc\"");
    assert!(said(&[("r.json", &irma)]).contains("ext_force_loc: loads are arguments of the commands"));
}

#[test]
fn the_ground_of_a_file_is_that_of_the_robot() {
    let found = imported(&[("r.yaml", YAML)], &options()).unwrap();
    assert_eq!(found.robot.ground_z, Some(0.0));
}

#[test]
fn a_table_whose_numbers_leave_out_a_cable_is_refused() {
    let with = |name: &str, numbers: [&str; 2]| {
        let text = TABLE.replace(",colour", &format!(",{name}")).replace("red", numbers[0]);
        imported(&[("r.csv", &text.replace("blue", numbers[1]))], &all_options())
    };
    for (name, numbers) in [("cable", ["1", "3"]), ("No.", ["2", "1"]), ("Cables", ["0", "0"])] {
        let message = with(name, numbers).map(drop).unwrap_err().to_string();
        let next = numbers[0].parse::<i32>().unwrap() + 1;
        let said = format!("line 3, column 11: {name} is {}: expected {next}: each cable once", numbers[1]);
        assert!(message.contains(&said), "{message}");
    }
    for (name, numbers) in
        [("cable", ["0", "1"]), ("cable", ["7", "8"]), ("cable", ["A", "C"]), ("id", ["1", "3"])]
    {
        assert_eq!(with(name, numbers).unwrap().robot.cables.len(), 2, "{name} {numbers:?}");
    }
}

/// A product with 0.001 is 0.17500000000000002.
#[test]
fn millimetres_are_divided_and_zero_has_no_sign() {
    let table = "Exit X [mm],Exit Y [mm],Exit Z [mm],ax,ay,az [cm],linear_density [g/m],section,modulus\n\
                 175,-1644,-0,-0.0,0,7,83,1e-5,1e11\n";
    let robot = imported(&[("r.csv", table)], &all_options()).unwrap().robot;
    let cable = &robot.cables[0];
    let numbers = [cable.exit_point.x, cable.exit_point.y, cable.exit_point.z, cable.anchor_point.x];
    assert_eq!(format!("{numbers:?}"), "[0.175, -1.644, 0.0, 0.0]");
    assert_eq!(cable.anchor_point.z, 0.07);
}
