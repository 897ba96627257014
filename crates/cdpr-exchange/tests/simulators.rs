//! Systems of MoorPy and MoorDyn, and models of Gazebo.

use crate::fixtures::{YAML, all_options, imported, notes, options};
use cdpr_exchange::{ImportOptions, Imported, NoteKind};
use cdpr_robot::{Matrix3, TensionLimits, Vector3};
use std::f64::consts::PI;

/// Two cables with names and columns of MoorDyn's first version.
const SYSTEM: &str = "MoorDyn Input File
a body on two lines
---------------------- LINE TYPES -----------
Name  Diam  MassDen  EA       BA/-zeta   EI    Cd    Ca   CdAx   CaAx
(-)   (m)   (kg/m)   (N)      (N-s/-)   (-)   (-)   (-)   (-)   (-)
rope  0.02  0.3   2.0E+06  -1        0     1    0.27  1      0.20
---------------------- BODIES ---------------
ID   Attachment  X0 Y0 Z0  r0 p0 y0  Mass  CG*  I*  Volume  CdA*  Ca*
(#)     (-)  (m) (m) (m)  (deg) (deg) (deg)  (kg)  (m)  (kg-m^2) (m^3) (m^2) (-)
1  Free  0 0 1  0 0 0  12  0.1  3|4|5  0  0  0
---------------------- POINTS ---------------
Node Type      X     Y      Z     M    V   CdA   CA
(-)  (-)      (m)   (m)    (m)   (kg) (m^3)  (m^2) (-)
1   Fixed  -2.0   0.0  3.0    0    0    0    0
2   Fixed   2.0   0.5  3.0    0    0    0    0
3   Body1   -0.2   0.0  0.1    0    0    0    0
4   Body1    0.2   0.0  0.1    0    0    0    0
---------------------- LINES ----------------
Line  LineType UnstrLen NodeAnch  NodeFair  NumSegs    Flags/Outputs
(-)   (-)      (m)       (-)       (-)      (-)        (-)
1     rope     2.2         1         3     40          pt
2     rope     2.3         4         2     40          pt
---------------------- OPTIONS --------------
9.80665  g
0        rho
0.001    dtM       - time step (s)
---------------------- OUTPUTS --------------
FairTen1
--------------------- need this line --------
";

fn with_limits() -> ImportOptions {
    ImportOptions { tension_limits: Some(TensionLimits { min: 1.0, max: 500.0 }), ..ImportOptions::default() }
}

fn system(text: &str) -> Imported {
    imported(&[("lines.txt", text)], &with_limits()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_body_on_lines_of_moordyn_is_a_robot() {
    let found = system(SYSTEM);
    let robot = &found.robot;
    assert_eq!((robot.name.as_str(), robot.cables.len(), robot.platform.mass), ("lines", 2, 12.0));
    // A centre of gravity with one number is above the origin.
    assert_eq!(robot.platform.center_of_mass, Vector3::new(0.0, 0.0, 0.1));
    assert_eq!(robot.platform.inertia, Some(Matrix3::from_diagonal(&Vector3::new(3.0, 4.0, 5.0))));
    assert_eq!(robot.gravity.vector(), Vector3::new(0.0, 0.0, -9.80665));
    // Either end of a line may be the fixed one.
    assert_eq!(robot.cables[1].exit_point, Vector3::new(2.0, 0.5, 3.0));
    assert_eq!(robot.cables[1].anchor_point, Vector3::new(0.2, 0.0, 0.1));
    let properties = &robot.cables[0].properties;
    assert!(
        (properties.section - PI * 1e-4).abs() < 1e-18 && (properties.axial_stiffness() - 2e6).abs() < 1e-6
    );
    assert_eq!((properties.linear_density, properties.diameter), (0.3, Some(0.02)));
    assert_eq!(notes(&found, NoteKind::Questioned), [""; 0]);
}

#[test]
fn a_free_point_on_lines_is_a_point_mass() {
    let body = SYSTEM
        .split("---------------------- BODIES")
        .nth(1)
        .unwrap()
        .split("---------------------- POINTS")
        .next();
    let text = SYSTEM
        .replace(&format!("---------------------- BODIES{}", body.unwrap()), "")
        .replace("3   Body1   -0.2   0.0  0.1    0 ", "3   Free   0 0 1    7 ")
        .replace("4   Body1    0.2   0.0  0.1    0    0    0    0\n", "")
        .replace("      4         2 ", "      3         2 ");
    let found = system(&text);
    assert!(found.robot.platform.point);
    assert_eq!((found.robot.platform.mass, found.robot.cables[1].anchor_point), (7.0, Vector3::zeros()));
}

#[test]
fn water_bending_and_what_is_not_known_are_questioned_or_refused() {
    let said =
        |from: &str, to: &str| notes(&system(&SYSTEM.replacen(from, to, 1)), NoteKind::Questioned).join("\n");
    assert!(said("0        rho\n", "").contains("the lines hang in water of 1025 kg/m³"));
    assert!(said("0        rho", "998 rho").contains("998 kg/m³"));
    assert!(
        said("-1        0     1 ", "-1        5     1 ")
            .contains("EI: cables of a robot have no bending stiffness")
    );
    assert!(
        said(
            "---------------------- OPTIONS",
            "---- FAILURE ----\na\nb\n1 2\n---------------------- OPTIONS"
        )
        .contains("a section of another kind")
    );
    let refused = |from: &str, to: &str| {
        let text = SYSTEM.replacen(from, to, 1);
        imported(&[("lines.dat", &text)], &with_limits()).map(drop).unwrap_err().to_string()
    };
    for (from, to, line, message) in [
        ("2.0E+06", "2e6|3e6", 6, "ea is \"2e6|3e6\": expected a finite number"),
        ("0.02 ", "0 ", 6, "diam is \"0\": expected a positive number"),
        ("1  Free", "1  Fixed", 10, "Attachment is \"Fixed\": expected Free or Coupled"),
        ("3   Body1", "3   Body2", 16, "Attachment is \"Body2\": expected the body of the file"),
        ("3   Body1", "3   Free", 16, "other free points are not imported"),
        ("4   Body1", "3   Body1", 17, "ID is \"3\": expected a number of one point"),
        ("1         3 ", "1         2 ", 21, "one end at a fixed point, the other one at the body"),
        ("1         3 ", "1         R3A ", 21, "attachment is \"R3A\": expected the number of a point"),
        ("1     rope", "1     wire", 21, "LineType is \"wire\": expected a name of the line types"),
        ("1  Free", "2 Free 0 0 1 0 0 0 1 0 0 0 0 0\n1  Free", 11, "one body: robots with several"),
        ("0.5  3.0", "0.5  seabed", 15, "z is \"seabed\": expected a finite number"),
        ("9.80665  g", "x  g", 24, "g is \"x\": expected a finite number"),
    ] {
        let error = refused(from, to);
        assert!(
            error.contains(&format!("lines.dat, line {line}, column ")) && error.contains(message),
            "{error}"
        );
    }
    let rods = SYSTEM.replace(
        "---------------------- POINTS",
        "---- RODS ----\na\nb\n1 r Fixed\n---------------------- POINTS",
    );
    let error = imported(&[("r.txt", &rods)], &with_limits()).map(drop).unwrap_err().to_string();
    assert!(error.contains("rods are not imported"), "{error}");
}

/// A model of Gazebo with the rods of oKermorgant's script for the first cables of the YAML.
fn sdf(cables: usize) -> String {
    let link =
        |name: &str, pose: &str| format!("<link name=\"{name}\"><pose>{pose} 0.1 0.2 0.3</pose></link>\n");
    let points =
        [("-3.5 -2 3.5", "1.5 0.6 0"), ("-3.5 -2 3.5", "0.3 1.2 0.4"), ("3.5 -2 3.5", "0.3 0.6 0.4")];
    let rods: String = points[..cables]
        .iter()
        .enumerate()
        .map(|(i, (exit, anchor))| {
            let joint = format!(
                "<joint name=\"cable{i}\"><axis><limit><effort>10000</effort></limit></axis></joint>\n"
            );
            link(&format!("virt_X{i}"), exit) + &link(&format!("virt_Xpf{i}"), anchor) + &joint
        })
        .collect();
    format!(
        "<?xml version=\"1.0\"?>\n<sdf version=\"1.4\"><model name=\"/home/a/caroca\"><link name=\"frame\"/>
        <link name=\"platform\"><pose>0.9 0.9 0.2 0 0 0</pose><inertial><mass>150</mass><inertia>
        <ixx>6.5</ixx><iyy>20</iyy><izz>22.5</izz></inertia></inertial></link>
        {rods}</model></sdf>"
    )
}

#[test]
fn rods_of_gazebo_are_the_cables_that_they_were_made_of() {
    let found =
        imported(&[("caroca.sdf", &sdf(3))], &ImportOptions { tension_limits: None, ..options() }).unwrap();
    let of_yaml = imported(&[("caroca.yaml", YAML)], &options()).unwrap().robot;
    assert_eq!((found.robot.name.as_str(), found.robot.platform), ("caroca", of_yaml.platform));
    for (ours, theirs) in found.robot.cables.iter().zip(&of_yaml.cables) {
        assert!((ours.exit_point - theirs.exit_point).norm() < 1e-12);
        assert!((ours.anchor_point - theirs.anchor_point).norm() < 1e-12);
    }
    assert_eq!(found.robot.tension_limits.max, 10000.0);
    assert!(notes(&found, NoteKind::Questioned)[0].contains("the least one is in the YAML file alone"));
}

#[test]
fn models_without_cables_say_what_to_import() {
    let refused =
        |text: &str| imported(&[("a.sdf", text)], &all_options()).map(drop).unwrap_err().to_string();
    let message = refused(&sdf(0));
    assert!(
        message.contains("SDF has no element for cables: import the YAML file that the model was made of"),
        "{message}"
    );
    let urdf = refused("<robot name=\"r\"><link name=\"l\"/></robot>");
    assert!(urdf.contains("it is URDF, which has no element for cables"), "{urdf}");
}
