//! Robot files: what is read back, and the error for what is refused.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use cdpr_cable::Entry;
use cdpr_robot::{CableProperties, Pose, Robot, RobotError, Rotation3, Vector3, Wrench, deviations};

const CAROCA: &str = include_str!("../../../data/robots/caroca.json");
const COGIRO: &str = include_str!("../../../data/robots/cogiro.json");

#[test]
fn the_robot_files_are_read_and_written_back() {
    for text in [CAROCA, COGIRO] {
        let robot = Robot::from_json(text).unwrap();
        assert_eq!(robot.cables.len(), 8);
        assert_eq!(Robot::from_json(&robot.to_json()).unwrap(), robot);
    }
}

#[test]
fn gravity_is_a_number_or_a_vector_and_is_written_back_as_it_was() {
    let with = |gravity: &str| CAROCA.replace("\"gravity\": 9.81", &format!("\"gravity\": {gravity}"));
    for (given, vector) in [
        ("9.81", [0.0, 0.0, -9.81]),
        ("0", [0.0; 3]),
        ("[0.3, 0, -9.8]", [0.3, 0.0, -9.8]),
        ("[0, 0, -9.81]", [0.0, 0.0, -9.81]),
    ] {
        let robot = Robot::from_json(&with(given)).unwrap();
        assert_eq!(robot.gravity.vector(), Vector3::from(vector), "{given}");
        let written: serde_json::Value = serde_json::from_str(&robot.to_json()).unwrap();
        assert_eq!(written["gravity"].is_array(), given.starts_with('['), "{given}");
        assert_eq!(Robot::from_json(&robot.to_json()).unwrap(), robot);
        assert_eq!(robot.is_plain(), vector[0] == 0.0, "{given}");
    }
    for (wrong, message) in [
        ("-1", "gravity is -1: expected a finite number, zero or more [m/s²]"),
        ("[0, 1]", "gravity: expected a number [m/s²] or a vector of three in the base frame"),
        ("\"down\"", "gravity: expected a number [m/s²] or a vector of three in the base frame"),
        ("null", "gravity: expected a number [m/s²] or a vector of three in the base frame"),
    ] {
        let error = Robot::from_json(&with(wrong)).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
    let mut robot = Robot::from_json(CAROCA).unwrap();
    robot.gravity = Vector3::new(0.0, f64::NAN, -9.81).into();
    let error = robot.validate().unwrap_err().to_string();
    assert_eq!(error, "gravity[1] is NaN: expected a finite component [m/s²]");
}

#[test]
fn a_tilted_robot_has_its_weight_along_gravity_and_its_cables_their_weight() {
    let mut robot = Robot::from_json(CAROCA).unwrap();
    let vector = Vector3::new(3.0, -4.0, -12.0);
    robot.gravity = vector.into();
    let wrench = robot.weight(&Pose::at(0.0, 0.0, 1.75), 20.0);
    assert_eq!(wrench.force, (robot.platform.mass + 20.0) * vector);
    assert_eq!(robot.cable(0).weight_per_length, 13.0 * robot.cables[0].properties.linear_density);
}

#[test]
fn values_in_another_unit_are_questioned_with_what_they_would_be() {
    let modulus = |text: &str| refusal("1.022e11", text);
    assert_eq!(
        modulus("20"),
        "cable.youngs_modulus is 20: expected a modulus in Pa, soft rubber has 1e6: 20 GPa is 2e10, 20 MPa \
         is \
         2e7 (line 12, column 104)"
    );
    assert!(modulus("102200").contains("102200 MPa is 1.022e11"));
    let in_mm = {
        let mut robot = Robot::from_json(CAROCA).unwrap();
        for cable in &mut robot.cables {
            cable.exit_point *= 1000.0;
            cable.anchor_point *= 1000.0;
        }
        robot
    };
    let question = Robot::from_json(&in_mm.to_json()).unwrap_err().to_string();
    assert!(question.starts_with("cable 8, cables[7].exit_point"), "{question}");
    assert!(question.contains("coordinates in m, less than 2000 m apart: from mm, divide by 1000"));
    // An inspection reads them all the same.
    assert_eq!(Robot::from_json_in_any_unit(&in_mm.to_json()).unwrap(), in_mm);
}

#[test]
fn no_robot_that_exists_is_questioned() {
    let files = [
        CAROCA,
        COGIRO,
        include_str!("../../../data/robots/caroca-law.json"),
        include_str!("../../../data/reference/robots/stadium.json"),
        include_str!("../../../data/reference/robots/ipanema.json"),
        include_str!("../../../data/reference/robots/fast.json"),
    ];
    let robots = files.map(|text| Robot::from_json(text).unwrap());
    // From a desk to twice the widest telescope, from rubber to carbon fibre, thread to bridge cable; and EA
    // given as the modulus of a unit section.
    for (modulus, section) in [(1e6, 1e-7), (2e8, 2.8e-5), (1.77e9, 3.8e-5), (1e12, 1e-2), (5e5, 1.0)] {
        for size in [0.02, 1.0, 2.0] {
            for robot in &robots {
                let mut robot = robot.clone();
                for cable in &mut robot.cables {
                    cable.exit_point *= size;
                    cable.anchor_point *= size;
                    cable.properties = CableProperties::linear(section, 0.1, modulus);
                }
                robot.check_units().unwrap();
            }
        }
    }
}

#[test]
fn a_cable_may_have_its_own_properties() {
    let point = r#""anchor_point": [0.2, 0.15, 0.125]"#;
    let own = r#""cable": {"diameter": 0.006, "linear_density": 0.2, "youngs_modulus": 9e10}"#;
    let robot = Robot::from_json(&CAROCA.replacen(point, &format!("{point}, {own}"), 1)).unwrap();
    assert_eq!(robot.cables[0].properties.linear_density, 0.2);
    assert!((robot.cables[0].properties.section - 2.827_433e-5).abs() < 1e-11);
    assert_eq!(robot.cables[1].properties.linear_density, 0.1015);
    assert_eq!(Robot::from_json(&robot.to_json()).unwrap(), robot);
}

#[test]
fn cables_may_run_over_pulleys_behind_a_lead() {
    let limits = r#""tension_limits":"#;
    let common = r#""pulley": {"radius": 0.045, "axis": [0, 0, 1]}, "lead": 3.0,"#;
    let point = r#""anchor_point": [0.2, 0.15, 0.125]"#;
    let own = r#""pulley": {"radius": 0.1, "axis": [0, 0, -1]}, "lead": 0"#;
    let text = CAROCA.replacen(limits, &format!("{common} {limits}"), 1);
    let robot = Robot::from_json(&text.replacen(point, &format!("{point}, {own}"), 1)).unwrap();
    let guides: Vec<_> = robot.cables[..2].iter().map(|cable| cable.guide(None).unwrap()).collect();
    assert_eq!((guides[0].radius, guides[0].lead, guides[0].entry), (0.1, 0.0, Entry::Downwards));
    assert_eq!((guides[1].radius, guides[1].lead, guides[1].entry), (0.045, 3.0, Entry::Upwards));
    assert!(!robot.is_plain() && robot.is_linear());
    assert_eq!(Robot::from_json(&robot.to_json()).unwrap(), robot);
    let refusal = |common: &str| {
        let text = CAROCA.replacen(limits, &format!("{common}, {limits}"), 1);
        Robot::from_json(&text).unwrap_err().to_string()
    };
    let refused = refusal(r#""lead": -1"#);
    assert!(refused.contains("cables[0].lead is -1") && refused.contains("[m]"), "{refused}");
    let refused = refusal(r#""pulley": {"radius": -0.1, "axis": [0, 0, 1]}"#);
    assert!(refused.contains("cables[0].pulley.radius is -0.1"), "{refused}");
    let refused = refusal(r#""pulley": {"radius": 0.1, "axis": [0, 0, 0]}"#);
    assert!(refused.contains("cables[0].pulley.axis is") && refused.contains("not zero"), "{refused}");
    // Any other direction is that of the cable where it enters, in the level frame.
    let pulley = r#""pulley": {"radius": 0.1, "axis": [0, 3, 4]},"#;
    let robot = Robot::from_json(&CAROCA.replacen(limits, &format!("{pulley} {limits}"), 1)).unwrap();
    assert_eq!(robot.cables[0].guide(None).unwrap().entry, Entry::Along([0.0, 0.6, 0.8]));
    assert_eq!(Robot::from_json(&robot.to_json()).unwrap(), robot);
}

#[test]
fn a_robot_may_be_planar_or_a_point_mass_on_any_number_of_cables() {
    let cable = |x: f64, anchor: &str| format!(r#"{{"exit_point": [{x}, 0, 4], "anchor_point": {anchor}}}"#);
    let text = |platform: &str, plane: &str, cables: &[String]| {
        format!(
            r#"{{"format": "cdpr-robot/1", "name": "few", "gravity": 9.81, {plane}
            "platform": {{"mass": 4, "center_of_mass": [0, 0, 0]{platform}}},
            "cable": {{"diameter": 0.004, "linear_density": 0.06, "youngs_modulus": 1e11}},
            "tension_limits": {{"min": 1, "max": 1000}}, "cables": [{}]}}"#,
            cables.join(", ")
        )
    };
    let zero = "[0, 0, 0]";
    let point = Robot::from_json(&text(r#", "point": true"#, "", &[cable(1.0, zero)])).unwrap();
    assert_eq!((point.freedoms().components(), point.is_fully_actuated()), (vec![0, 1, 2], false));
    let planar = text("", r#""plane": "xz","#, &[cable(1.0, zero), cable(2.0, zero), cable(3.0, zero)]);
    let planar = Robot::from_json(&planar).unwrap();
    assert_eq!((planar.freedoms().components(), planar.is_fully_actuated()), (vec![0, 2, 4], true));
    for robot in [point, planar] {
        assert_eq!(Robot::from_json(&robot.to_json()).unwrap(), robot);
    }
    let beside = text(r#", "point": true"#, "", &[cable(1.0, zero), cable(2.0, "[0, 0.1, 0]")]);
    let refused = Robot::from_json(&beside).unwrap_err().to_string();
    assert!(refused.contains("cables[1].anchor_point is [0.0, 0.1, 0.0]"), "{refused}");
    let refused = Robot::from_json(&text("", r#""plane": "zx","#, &[cable(1.0, zero)])).unwrap_err();
    assert!(refused.to_string().contains("plane"), "{refused}");
}

#[test]
fn an_inertia_that_no_body_has_is_refused() {
    let with = |inertia: &str| {
        let own = "[[36.598, -0.453, 3.012], [-0.453, 35.982, -1.539], [3.012, -1.539, 25.439]]";
        assert!(COGIRO.contains(own));
        Robot::from_json(&COGIRO.replace(own, inertia))
    };
    let robot = with("[[2, 0.1, 0], [0.1, 3, 0], [0, 0, 4]]").unwrap();
    assert_eq!(robot.platform.inertia.unwrap()[(0, 1)], 0.1);
    assert_eq!(Robot::from_json(&robot.to_json()).unwrap(), robot);
    for (inertia, why) in [
        ("[[2, 0.1, 0], [0, 3, 0], [0, 0, 4]]", "symmetric"),
        ("[[2, 0, 0], [0, 3, 0], [0, 0, 6]]", "sum of the others"),
        ("[[2, 0, 0], [0, 3, 0], [0, 0, -1]]", "positive"),
    ] {
        let error = with(inertia).unwrap_err().to_string();
        assert!(error.contains("platform.inertia is") && error.contains(why), "{error}");
    }
}

#[test]
fn every_double_is_written_and_read_back_to_the_last_bit() {
    // Decimals whose nearest double is not found by multiplying digits with a power of ten.
    for mass in
        [180.123_456_789_012_35, 9.007_199_254_740_993e15, 1.0 / 3e300, 2.2250738585072014e-308, 5e-324]
    {
        let mut robot = Robot::from_json(CAROCA).unwrap();
        robot.platform.mass = mass;
        robot.gravity = (1.1 * mass).into();
        robot.platform.center_of_mass.x = -mass / 3.0;
        assert_eq!(Robot::from_json(&robot.to_json()).unwrap(), robot);
    }
}

#[test]
fn a_file_with_something_behind_its_end_is_refused() {
    let refusal =
        |tail: &str| Robot::from_json(&format!("{}{tail}", CAROCA.trim_end())).unwrap_err().to_string();
    let last = CAROCA.trim_end().lines().count();
    assert_eq!(refusal("\n}"), format!("line {}, column 1: the whole text: trailing characters", last + 1));
    assert!(refusal(CAROCA).ends_with("trailing characters"));
    assert!(Robot::from_json(&format!("{CAROCA}\n\t ")).is_ok());
}

/// The message for CAROCA's file with `from` replaced by `to`.
fn refusal(from: &str, to: &str) -> String {
    assert!(CAROCA.contains(from), "{from}");
    Robot::from_json(&CAROCA.replacen(from, to, 1)).unwrap_err().to_string()
}

#[test]
fn a_bad_file_is_refused_with_field_value_and_remedy() {
    let cases = [
        (r#""mass": 180.0, "#, "", "line 11, column 43: platform: missing field `mass`"),
        (
            r#""mass": 180.0"#,
            r#""mas": 180.0"#,
            "line 11, column 20: platform.mas: unknown field `mas`, expected one of `mass`, `center_of_mass`, \
             `inertia`, `point`",
        ),
        (
            r#""mass": 180.0"#,
            r#""mass": NaN"#,
            "line 11, column 24: platform.mass: expected a JSON value of this field's kind; NaN, \
             Infinity and bare words are not JSON",
        ),
        (
            r#""mass": 180.0"#,
            r#""mass": "heavy""#,
            "line 11, column 30: platform.mass: invalid type: string \"heavy\", expected a number",
        ),
        (
            r#""mass": 180.0"#,
            r#""mass": 1e999"#,
            "line 11, column 28: platform.mass: number out of range, expected a finite number",
        ),
        (
            r#""mass": 180.0"#,
            r#""mass": -1"#,
            "platform.mass is -1: expected a finite, positive mass [kg] (line 11, column 24)",
        ),
        (
            "1.2566370614e-5",
            "-1.2e-5",
            "cable.section is -0.000012: expected a finite, positive section [m²] (line 12, column 43)",
        ),
        (
            "1.022e11",
            "0",
            "cable.youngs_modulus is 0: expected a finite, positive modulus [Pa] (line 12, column 104)",
        ),
        (
            r#""min": 1.0, "max": 10290.0"#,
            r#""min": 20.0, "max": 10.0"#,
            "tension_limits.max is 10: expected a finite tension above tension_limits.min \
             (line 13, column 42)",
        ),
        (
            "cdpr-robot/1",
            "cdpr-robot/9",
            "format is \"cdpr-robot/9\": expected \"cdpr-robot/1\" (line 2, column 13)",
        ),
        (
            "[-3.5, 2, 3.5]",
            "[-3.5, 2]",
            "line 15, column 28: cable 1, cables[0].exit_point: invalid length 2, expected an array of length 3",
        ),
    ];
    for (from, to, expected) in cases {
        assert_eq!(refusal(from, to), expected);
    }
}

#[test]
fn points_that_cannot_hold_a_platform_are_refused() {
    let robot = Robot::from_json(CAROCA).unwrap();
    let refusal = |change: &dyn Fn(&mut Robot)| {
        let mut robot = robot.clone();
        change(&mut robot);
        robot.validate().unwrap_err().to_string()
    };
    let none = refusal(&|robot| robot.cables.truncate(0));
    assert_eq!(none, "cables is an empty list: expected at least one cable");
    let twice = refusal(&|robot| robot.cables[2].anchor_point = robot.cables[0].anchor_point);
    assert_eq!(
        twice,
        "cable 3, cables[2] is coincident with another cable: expected exit or anchor point different from those \
         of cable 1"
    );
    let line = refusal(&|robot| {
        for (i, cable) in robot.cables.iter_mut().enumerate() {
            cable.anchor_point = Vector3::new(0.1, 0.2, 0.3) * i as f64;
        }
    });
    assert!(line.starts_with("cables[*].anchor_point is on one line"), "{line}");
    let nan = refusal(&|robot| robot.cables[3].exit_point.y = f64::NAN);
    assert_eq!(nan, "cable 4, cables[3].exit_point[1] is NaN: expected a finite number [m]");
}

#[test]
fn a_perturbation_moves_exactly_the_named_parameters() {
    let robot = Robot::from_json(CAROCA).unwrap();
    let values =
        deviations(&robot, &[("a2.y", 0.01), ("cog.z", -0.02), ("dt3", 5.0), ("youngs_modulus", -1e9)])
            .unwrap();
    let perturbed = robot.perturbed(&values).unwrap();
    let mut expected = robot.clone();
    expected.cables[1].anchor_point.y += 0.01;
    expected.platform.center_of_mass.z -= 0.02;
    expected.cables.iter_mut().for_each(|cable| cable.properties.youngs_modulus -= 1e9);
    assert_eq!(perturbed.robot, expected);
    assert_eq!(perturbed.tension_offsets, [0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
}

#[test]
fn a_perturbation_that_makes_the_robot_invalid_is_refused() {
    let robot = Robot::from_json(CAROCA).unwrap();
    let result = robot.perturbed(&deviations(&robot, &[("mass", -200.0)]).unwrap());
    assert!(matches!(result, Err(RobotError::Invalid { field, .. }) if field == "platform.mass"));
    assert_eq!(robot.perturbed(&[0.0; 61]), Err(RobotError::DeviationCount { given: 61, parameters: 62 }));
}

#[test]
fn the_wrench_matrix_maps_tensions_to_force_and_moment_about_p() {
    let robot = Robot::from_json(COGIRO).unwrap();
    let pose = Pose {
        position: Vector3::new(0.5, -0.3, 2.0),
        rotation: Rotation3::new(Vector3::new(0.1, -0.2, 0.3)),
    };
    let pulls: Vec<_> = (0..8).map(|i| -robot.span(&pose, i).normalize()).collect();
    let tensions = nalgebra::DVector::from_fn(8, |i, _| 100.0 + 10.0 * i as f64);
    let wrench = robot.wrench_matrix(&pose, &pulls) * &tensions;
    let mut expected = Wrench::none();
    for (i, pull) in pulls.iter().enumerate() {
        let force = pull * tensions[i];
        let at = pose.rotation * robot.cables[i].anchor_point;
        expected = expected + Wrench { force, moment: at.cross(&force) };
    }
    assert!((wrench - expected.to_vector()).norm() < 1e-10);
}

#[test]
fn a_law_of_strain_over_tension_is_read_written_and_checked() {
    let text = include_str!("../../../data/robots/caroca.json");
    let with = |law: &str| {
        let text = text.replacen(
            "\"breaking_force\": 10290.0",
            &format!("\"breaking_force\": 10290.0, \"law\": {law}"),
            1,
        );
        Robot::from_json(&text)
    };
    let segments = r#"[{"tension": 0, "modulus": 7.25e10}, {"tension": 514.5, "modulus": 8.32e10}]"#;
    let robot = with(&format!(r#"{{"strain_at_rest": 1e-4, "segments": {segments}}}"#)).unwrap();
    assert!(!robot.is_linear());
    assert!(
        (robot.modulus_at(3, 100.0) - 7.25e10).abs() < 1.0
            && (robot.modulus_at(3, 600.0) - 8.32e10).abs() < 1.0
    );
    let strain = 1e-4 + 514.5 / (7.25e10 * 1.2566370614e-5);
    assert!((robot.cable(0).strain(514.5) - strain).abs() < 1e-15);
    let again = Robot::from_json(&robot.to_json()).unwrap();
    assert!((again.cable(7).strain(900.0) / robot.cable(7).strain(900.0) - 1.0).abs() < 1e-14);
    for (law, words) in [
        (r#"{"segments": []}"#.to_owned(), "cable.law.segments is 0: expected one segment"),
        (r#"{"segments": [{"tension": 5, "modulus": 1e11}]}"#.to_owned(), "cable.law.segments.tension is 5"),
        (r#"{"segments": [{"tension": 0, "modulus": -1}]}"#.to_owned(), "cable.law.segments.ratio is"),
    ] {
        let message = with(&law).unwrap_err().to_string();
        assert!(message.starts_with(words), "{message}");
    }
}
