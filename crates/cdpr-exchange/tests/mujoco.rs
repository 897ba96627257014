//! Models of MuJoCo of other people's kinds: defaults, nested bodies, geoms, pulleys, joints.

use crate::fixtures::{all_options, imported, notes, options};
use cdpr_exchange::{Imported, NoteKind};
use cdpr_robot::{Matrix3, Plane, TensionLimits, Vector3};

/// A box on three tendons over sliding winches, as simulators of cable robots have it; a floor below.
const BOX: &str = r#"<mujoco model="box">
  <compiler angle="radian"/>
  <asset><material name="m" rgba="1 0 0 1"/></asset>
  <worldbody>
    <geom name="floor" size="0 0 1" type="plane" pos="0 0 -0.1"/>
    <site name="p0" pos="-1 -1 2"/> <site name="p1" pos="1 -1 2"/> <site name="p2" pos="0 1 2"/>
    <light pos="0 0 0"/>
    <body name="effector" pos="0.1 0 0.5">
      <joint type="free" limited="false"/>
      <geom size="0.1 0.2 0.3" type="box" mass="2"/>
      <site name="d0" pos="-0.1 -0.2 0.3"/> <site name="d1" pos="0.1 -0.2 0.3"/>
      <site name="d2" pos="0 0.2 0.3"/>
      <body name="marker" pos="0 0 0.1"><geom size="0.03" mass="0"/></body>
    </body>
    <body pos="-1 -1 2">
      <joint name="s0" axis="0 1 0" type="slide"/> <geom size="0.01" mass="1"/> <site name="w0"/>
    </body>
    <body pos="1 -1 2">
      <joint name="s1" axis="0 1 0" type="slide"/> <geom size="0.01" mass="1"/> <site name="w1"/>
    </body>
    <body pos="0 1 2">
      <joint name="s2" axis="0 1 0" type="slide"/> <geom size="0.01" mass="1"/> <site name="w2"/>
    </body>
  </worldbody>
  <tendon>
    <spatial name="c0" limited="true" range="0 5" springlength="0 5" width="0.005">
      <site site="d0"/> <site site="p0"/> <site site="w0"/>
    </spatial>
    <spatial name="c1"><site site="w1"/> <site site="p1"/> <site site="d1"/></spatial>
    <spatial name="c2"><site site="d2"/> <site site="p2"/></spatial>
  </tendon>
  <actuator><position joint="s0" kp="500" ctrlrange="0 35"/></actuator>
  <sensor><tendonpos tendon="c0"/></sensor>
</mujoco>
"#;

fn found(text: &str) -> Imported {
    imported(&[("box.xml", text)], &all_options_without_mass()).unwrap_or_else(|error| panic!("{error}"))
}

fn all_options_without_mass() -> cdpr_exchange::ImportOptions {
    cdpr_exchange::ImportOptions { tension_limits: Some(TensionLimits { min: 1.0, max: 500.0 }), ..options() }
}

fn refused(text: &str) -> String {
    imported(&[("box.xml", text)], &all_options()).map(|found| found.robot.name).unwrap_err().to_string()
}

#[test]
fn tendons_of_three_sites_are_cables_from_the_frame_to_the_free_body() {
    let found = found(BOX);
    let robot = &found.robot;
    assert_eq!((robot.name.as_str(), robot.cables.len(), robot.platform.mass), ("box", 3, 2.0));
    assert_eq!(robot.cables[0].exit_point, Vector3::new(-1.0, -1.0, 2.0));
    assert_eq!(robot.cables[1].exit_point, Vector3::new(1.0, -1.0, 2.0));
    assert_eq!(robot.cables[1].anchor_point, Vector3::new(0.1, -0.2, 0.3));
    assert_eq!(robot.platform.center_of_mass, Vector3::zeros());
    // A box with the edges 0.2, 0.4 and 0.6 m.
    let expected = Vector3::new(0.16 + 0.36, 0.04 + 0.36, 0.04 + 0.16) * (2.0 / 12.0);
    let inertia = robot.platform.inertia.unwrap();
    assert!((inertia - Matrix3::from_diagonal(&expected)).norm() < 1e-15);
    assert_eq!(notes(&found, NoteKind::Questioned), [""; 0]);
    assert_eq!(robot.ground_z, Some(-0.1));
}

#[test]
fn a_spring_has_the_stiffness_of_its_unstrained_length() {
    let spring = BOX
        .replace("<spatial name=\"c2\">", "<spatial name=\"c2\" stiffness=\"2e4\" springlength=\"0 2.5\">");
    let ea = |text: &str| found(text).robot.cables[2].properties.axial_stiffness();
    assert!((ea(&spring) - 5e4).abs() < 1e-9);
    // Without a length it is that of the model as it begins.
    let of_start = spring.replace(" springlength=\"0 2.5\"", "");
    let span = Vector3::new(0.1, -0.8, -1.2).norm();
    assert!(f64::abs(ea(&of_start) - 2e4 * span) < 1e-9);
    let both_ways = found(&spring.replace("\"0 2.5\"", "\"2.5\""));
    assert!(notes(&both_ways, NoteKind::Questioned)[0].contains("a spring that also pushes"));
    let bent = BOX
        .replace("<spatial name=\"c1\">", "<spatial name=\"c1\" stiffness=\"2e4\" springlength=\"0 2.5\">");
    assert!(notes(&found(&bent), NoteKind::Questioned)[0].contains("stiffness: of the whole tendon"));
}

#[test]
fn defaults_nested_bodies_and_angles_count() {
    // The same robot, with the effector's sites in a body that is turned by 90 degrees, and defaults.
    let turned = BOX
        .replace(
            "<compiler angle=\"radian\"/>",
            "<default><geom type=\"box\"/><default class=\"heavy\"><geom mass=\"2\"/></default></default>",
        )
        .replace(
            "<geom size=\"0.1 0.2 0.3\" type=\"box\" mass=\"2\"/>",
            "<geom size=\"0.1 0.2 0.3\" class=\"heavy\"/>",
        )
        .replace(
            "<site name=\"d0\" pos=\"-0.1 -0.2 0.3\"/>",
            "<body euler=\"0 0 90\" pos=\"0 0 0.3\"><site name=\"d0\" pos=\"-0.2 0.1 0\"/></body>",
        )
        .replace("size=\"0.03\"", "size=\"0.03\" type=\"sphere\"")
        .replace("size=\"0.01\"", "size=\"0.01\" type=\"sphere\"");
    let (turned, plain) = (found(&turned).robot, found(BOX).robot);
    assert!((turned.cables[0].anchor_point - plain.cables[0].anchor_point).norm() < 1e-15);
    assert_eq!((turned.platform.mass, turned.platform.inertia), (2.0, plain.platform.inertia));
    let by_quaternion = BOX
        .replace("pos=\"0.1 0 0.5\"", "pos=\"0.1 0 0.5\" quat=\"0.7071067811865476 0 0 0.7071067811865476\"");
    assert_eq!(found(&by_quaternion).robot.cables, plain.cables);
}

#[test]
fn masses_of_geoms_are_those_of_their_shapes() {
    let of = |geom: &str| {
        let text = BOX.replace("<geom size=\"0.1 0.2 0.3\" type=\"box\" mass=\"2\"/>", geom);
        let platform = found(&text).robot.platform;
        (platform.mass, platform.inertia.unwrap(), platform.center_of_mass)
    };
    let pi = std::f64::consts::PI;
    let (mass, inertia, _) = of("<geom size=\"0.3\"/>");
    assert!((mass - 4000.0 / 3.0 * pi * 0.027).abs() < 1e-12);
    assert!((inertia[(0, 0)] - 0.4 * mass * 0.09).abs() < 1e-12);
    // A capsule is a cylinder and a ball; the ball's halves lie at its ends.
    let (mass, inertia, _) = of("<geom type=\"capsule\" size=\"0.1 0.2\" density=\"500\"/>");
    let (tube, ball) = (500.0 * pi * 0.01 * 0.4, 500.0 * 4.0 / 3.0 * pi * 0.001);
    assert!((mass - tube - ball).abs() < 1e-12);
    let of_half = 0.4 * 0.01 - (3.0 / 8.0 * 0.1_f64).powi(2) + (0.2 + 3.0 / 8.0 * 0.1_f64).powi(2);
    let across = tube * (3.0 * 0.01 + 0.16) / 12.0 + ball * of_half;
    assert!((inertia[(0, 0)] - across).abs() < 1e-12);
    // Two equal balls, apart from each other by steps of 0.4 m.
    let (mass, inertia, center) =
        of("<geom size=\"0.1\" mass=\"1\" pos=\"0.4 0 0\"/><geom size=\"0.1\" mass=\"1\"/>");
    assert_eq!((mass, center), (2.0, Vector3::new(0.2, 0.0, 0.0)));
    assert!((inertia[(2, 2)] - 2.0 * (0.4 * 0.01 + 0.04)).abs() < 1e-15);
    let (_, inertia, _) = of("<geom type=\"cylinder\" size=\"0.1\" fromto=\"0 -0.3 0 0 0.3 0\" mass=\"3\"/>");
    assert!((inertia[(1, 1)] - 0.5 * 3.0 * 0.01).abs() < 1e-15);
    assert!((inertia[(0, 0)] - 3.0 * (0.03 + 0.36) / 12.0).abs() < 1e-15);
    let (mass, inertia, _) = of("<geom type=\"ellipsoid\" size=\"0.1 0.2 0.3\" mass=\"5\"/>");
    assert!((inertia[(0, 0)] - mass * 0.13 / 5.0).abs() < 1e-15);
    // Five turned shapes in one body, as MuJoCo 3 compiles them.
    let (mass, inertia, center) =
        of("<geom type=\"capsule\" size=\"0.1 0.2\" density=\"500\" pos=\"0.3 0 0\" euler=\"0.3 0.2 0.5\"/>\
         <geom type=\"ellipsoid\" size=\"0.1 0.2\" mass=\"5\" fromto=\"0 0 0 0 0.3 0.4\"/>\
         <geom type=\"cylinder\" size=\"0.1\" fromto=\"0 -0.3 0 0.2 0.3 0.1\" mass=\"3\"/>\
         <geom type=\"box\" size=\"0.1 0.2 0.3\" pos=\"0 -0.4 0.1\" xyaxes=\"1 1 0 0 1 1\"/>\
         <geom size=\"0.15\" pos=\"0 0.4 0.1\"/>");
    assert!((mass - 78.51474735072686).abs() < 1e-12);
    let expected = Vector3::new(0.035831155519165, -0.162964712430166, 0.093787688842983);
    assert!((center - expected).norm() < 1e-14);
    let expected = Matrix3::new(
        10.197156661001522,
        0.030942226560185,
        -0.056538956552655,
        0.030942226560185,
        2.809858581593771,
        0.281747569509801,
        -0.056538956552655,
        0.281747569509801,
        10.322021084427053,
    );
    assert!((inertia - expected).norm() < 1e-12, "{inertia}");
}

#[test]
fn a_cylinder_with_its_entry_on_it_is_a_pulley_that_is_questioned() {
    // The cable rises along x = 1.05 to the wheel around (1, -1, 2) and leaves it for the effector.
    let sites = "<site name=\"p1\" pos=\"1.05 -1 2\"/><site name=\"low\" pos=\"1.05 -1 0\"/>\
                 <site name=\"side\" pos=\"1 -1 2.05\"/><geom name=\"wheel\" type=\"cylinder\" \
                 size=\"0.05 0.02\" pos=\"1 -1 2\" euler=\"1.5707963267948966 0 0\"/>";
    let over_wheel = "<site site=\"d1\"/> <geom geom=\"wheel\" sidesite=\"side\"/> <site site=\"p1\"/> \
                      <site site=\"low\"/>";
    let wheel = BOX
        .replace("<site name=\"p1\" pos=\"1 -1 2\"/>", sites)
        .replace("<site site=\"w1\"/> <site site=\"p1\"/> <site site=\"d1\"/>", over_wheel);
    let imported = found(&wheel);
    let cable = &imported.robot.cables[1];
    assert_eq!(cable.exit_point, Vector3::new(1.05, -1.0, 2.0));
    let pulley = cable.pulley.unwrap();
    assert_eq!((pulley.radius, pulley.axis), (0.05, Vector3::z()));
    assert!(notes(&imported, NoteKind::Questioned)[0].contains("the pulley of a robot swivels"));
    let off = wheel.replace("pos=\"1.05 -1 2\"", "pos=\"1.1 -1 2\"");
    assert!(
        refused(&off).contains("@geom is \"wheel\": expected a cylinder of the frame, then a site on it")
    );
}

#[test]
fn slides_and_a_hinge_make_a_planar_robot_or_a_point() {
    let joints = |joints: &str| {
        BOX.replace("<joint type=\"free\" limited=\"false\"/>", joints)
            .replace("<spatial name=\"c1\"><site site=\"w1\"/>", "<spatial name=\"c1\">")
    };
    let slides = "<joint type=\"slide\" axis=\"1 0 0\"/><joint type=\"slide\" axis=\"0 0 1\"/>";
    let robot = found(&joints(slides)).robot;
    assert_eq!((robot.plane, robot.platform.point), (Some(Plane::Xz), true));
    // r = p + a - b, whatever the anchor point.
    assert_eq!(robot.cables[2].exit_point, Vector3::new(0.0, 1.0, 2.0) - Vector3::new(0.0, 0.2, 0.3));
    let robot = found(&joints(&format!("{slides}<joint axis=\"0 1 0\"/>"))).robot;
    assert_eq!((robot.plane, robot.platform.point), (Some(Plane::Xz), false));
    let robot = found(&joints(&format!("{slides}<joint type=\"slide\" axis=\"0 1 0\"/>"))).robot;
    assert_eq!((robot.plane, robot.platform.point), (None, true));
    let error = refused(&joints("<joint type=\"ball\"/>"));
    assert!(error.contains("is ball: expected a free joint, slides along axes"), "{error}");
}

#[test]
fn what_a_robot_cannot_have_is_refused_or_questioned() {
    for (from, to, said) in [
        ("<worldbody>", "<include file=\"a.xml\"/><worldbody>", "included files are not read"),
        ("<compiler", "<compiler coordinate=\"global\"", "@coordinate is \"global\": expected local"),
        ("name=\"p1\"", "name=\"p0\"", "\"p0\", there twice: expected one of a name"),
        ("site=\"d2\"", "site=\"d9\"", "@site is \"d9\": expected the name of a site"),
        (
            "<site site=\"d2\"/>",
            "<site site=\"d2\"/><pulley divisor=\"2\"/>",
            "is pulley: expected site or geom",
        ),
        (
            "<site site=\"d2\"/>",
            "<site site=\"p0\"/><site site=\"d2\"/>",
            "a tendon with 2: expected one change",
        ),
        ("<tendon>", "<tendons>", "box.xml, line"),
        ("0.1 0.2 0.3", "0.1 0.2", "@size is \"0.1 0.2\": expected 3 positive sizes of a box"),
        ("<compiler", "<option><flag gravity=\"disable\"/></option><compiler", "robots without gravity"),
    ] {
        let message = refused(&BOX.replacen(from, to, 1));
        assert!(message.contains(said), "{message}");
    }
    for (from, to, said) in [
        (
            "<sensor>",
            "<equality><weld body1=\"effector\"/></equality><sensor>",
            "equality: not known and not imported",
        ),
        (
            "<body name=\"marker\"",
            "<body name=\"tool\"><joint name=\"turn\"/><geom size=\"0.1\"/></body><body name=\"marker\"",
            "the body tool with joints on the platform: it is taken as fixed",
        ),
        (
            "<actuator>",
            "<actuator><motor tendon=\"c0\" ctrlrange=\"-9 0\"/><motor tendon=\"c1\"/><motor tendon=\"c2\"/>",
            "their ranges are not imported as limits",
        ),
        ("<site site=\"p2\"/>", "<site site=\"w0\"/>", "the exit point lies on a body that moves"),
        (
            "</tendon>",
            "<spatial name=\"c3\"><site site=\"w0\"/><site site=\"p0\"/></spatial></tendon>",
            "a tendon that does not end at the platform",
        ),
    ] {
        let text = BOX.replacen(from, to, 1);
        let said_all = notes(&found(&text), NoteKind::Questioned).join("\n");
        assert!(said_all.contains(said), "{said_all}");
    }
    let mesh = BOX.replace("size=\"0.1 0.2 0.3\" type=\"box\" mass=\"2\"", "type=\"mesh\" mesh=\"m\"");
    let lacking = imported(&[("box.xml", &mesh)], &options()).map(drop).unwrap_err().to_string();
    assert!(lacking.contains("the mass of the platform"), "{lacking}");
}
