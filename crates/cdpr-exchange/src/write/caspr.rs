//! CASPR: bodies and cables. Cables are linear springs with K = EA, with their pulleys.

use crate::error::ExchangeError;
use crate::write::scene::{Exported, escaped, inertia, stiffness_at, unplaced, words};
use cdpr_robot::{Plane, Pose, Robot};
use std::fmt::Write;

pub(crate) fn write(robot: &Robot, pose: &Pose) -> Result<Exported, ExchangeError> {
    if robot.platform.point {
        return Err(ExchangeError::no_place("platform.point", true, "a body"));
    }
    let mut notes = unplaced(robot);
    if robot.ground_z.is_some() {
        notes.push("the height of the ground (ground_z) has no place".to_owned());
    }
    notes.push("CASPR's cables have no density and no section: their stiffness K is EA".to_owned());
    let earthly = robot.gravity.vector();
    notes.push(format!("CASPR has its own gravity along -z; that of the robot is {} m/s²", words(&earthly)));
    if robot.cables.iter().any(|cable| cable.lead > 0.0) {
        notes.push("leads have no place".to_owned());
    }
    let (stiffness, law) = stiffness_at(robot, pose, "K");
    notes.extend(law);
    let about_center = inertia(robot, &mut notes);
    let joint = match robot.plane {
        None => "SPATIAL_EULER_XYZ",
        Some(Plane::Xy) => "PLANAR_XY",
        Some(Plane::Xz) => "PLANAR_XZ",
        Some(Plane::Yz) => "PLANAR_YZ",
    };
    let entries: String =
        [("Ixx", 0, 0), ("Iyy", 1, 1), ("Izz", 2, 2), ("Ixy", 0, 1), ("Ixz", 0, 2), ("Iyz", 1, 2)]
            .map(|(name, i, j)| format!(" <{name}>{:?}</{name}>", about_center[(i, j)]))
            .concat();
    let bodies = format!(
        r#"<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE bodies_system SYSTEM "../../../../templates/bodies.dtd">
<bodies_system>
  <links display_range="{range}" view_angle="-37 32">
    <link_rigid num="1" name="{name}">
      <joint type="{joint}" q_initial="{initial}"/>
      <physical>
        <mass>{mass:?}</mass>
        <com_location>{center}</com_location>
        <end_location>0.0 0.0 0.0</end_location>
        <inertia ref="com">{entries} </inertia>
      </physical>
      <parent> <num>0</num> <location>0.0 0.0 0.0</location> </parent>
    </link_rigid>
  </links>
</bodies_system>
"#,
        range = display_range(robot),
        name = escaped(&robot.name),
        initial = initial(pose, robot.plane),
        mass = robot.platform.mass,
        center = words(&robot.platform.center_of_mass),
    );
    Ok(Exported { files: vec![("_bodies.xml", bodies), ("_cables.xml", cables(robot, &stiffness))], notes })
}

/// Cables with these axial stiffnesses [N].
fn cables(robot: &Robot, stiffness: &[f64]) -> String {
    let mut text = String::from(
        r#"<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE cables SYSTEM "../../../../templates/cables.dtd">
<cables default_cable_set="original">
  <cable_set id="original">
"#,
    );
    for (i, cable) in robot.cables.iter().enumerate() {
        let limits = robot.limits(i);
        let exit = words(&cable.exit_point);
        let exit = match cable.pulley.filter(|pulley| pulley.radius > 0.0) {
            Some(pulley) => format!(
                "<base_rotating_pulley> <fixed_location>{exit}</fixed_location> \
                 <pulley_radius>{:?}</pulley_radius> <cable_entry_vector>{}</cable_entry_vector> \
                 </base_rotating_pulley>",
                pulley.radius,
                words(&pulley.axis.normalize())
            ),
            None => format!("<attachment> <link>0</link> <location>{exit}</location> </attachment>"),
        };
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            r#"    <cable_linear_spring name="{number}" attachment_reference="joint">
      <properties> <K>{stiffness:?}</K> <force_min>{min:?}</force_min> <force_max>{max:?}</force_max> </properties>
      <attachments>
        {exit}
        <attachment> <link>1</link> <location>{anchor}</location> </attachment>
      </attachments>
    </cable_linear_spring>
"#,
            number = i + 1,
            stiffness = stiffness[i],
            min = limits.min,
            max = limits.max,
            anchor = words(&cable.anchor_point),
        );
    }
    text + "  </cable_set>\n</cables>\n"
}

/// The pose in the coordinates of the joint: R = Rx Ry Rz in space.
fn initial(pose: &Pose, plane: Option<Plane>) -> String {
    let p = pose.position;
    // R^T = Rz(-c) Ry(-b) Rx(-a).
    let (a, b, c) = pose.rotation.inverse().euler_angles();
    let (a, b, c) = (-a, -b, -c);
    match plane {
        None => format!("{} {a:?} {b:?} {c:?}", words(&p)),
        Some(Plane::Xy) => format!("{:?} {:?} {c:?}", p.x, p.y),
        Some(Plane::Xz) => format!("{:?} {:?} {b:?}", p.x, p.z),
        Some(Plane::Yz) => format!("{:?} {:?} {a:?}", p.y, p.z),
    }
}

/// Least and greatest coordinates of the exit points with a metre around them.
fn display_range(robot: &Robot) -> String {
    let range = |axis: usize| {
        let values = || robot.cables.iter().map(move |cable| cable.exit_point[axis]);
        let (min, max) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        format!("{:.1} {:.1}", min - 1.0, max + 1.0)
    };
    [range(0), range(1), range(2)].join(" ")
}
