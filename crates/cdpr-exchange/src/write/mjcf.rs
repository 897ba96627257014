//! MuJoCo's MJCF: a platform with a free joint, and a tendon a cable between two sites.
//!
//! A tendon is a spring without weight: f = k (l - L) for l > L, and no force below, which
//! `springlength="0 L"` says. With k = EA / L it is the straight cable of unstrained length L. The lengths
//! are those with which straight cables hold the pose. What MuJoCo has no place for is under `custom`, for
//! the import: section, density, modulus, diameter, breaking force (0 if not known) and limits of each cable.

use crate::error::ExchangeError;
use crate::write::scene::{Exported, check_plain, escaped, inertia, unplaced, words};
use cdpr_robot::{Matrix3, Pose, Robot, UnitQuaternion};
use cdpr_statics::{Load, inverse};
use std::fmt::Write;

pub(crate) fn write(robot: &Robot, pose: &Pose) -> Result<Exported, ExchangeError> {
    check_plain(robot)?;
    let mut straight = robot.clone();
    straight.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.0);
    let lengths = inverse(&straight, pose, &Load::none())?.lengths;
    let mut notes = unplaced(robot);
    let weight: f64 =
        robot.cables.iter().zip(&lengths).map(|(cable, l)| cable.properties.linear_density * l).sum();
    if weight > 0.0 {
        notes.push(format!(
            "MuJoCo's tendons are straight and have no weight: {weight:.3} kg of cables are left out"
        ));
    }
    let inertia = inertia(robot, &mut notes);
    let text = format!(
        r#"<mujoco model="{name}">
  <compiler angle="radian"/>
  <option gravity="{gravity}" timestep="0.0005" integrator="implicitfast"/>
  <worldbody>
{sites}{platform}  </worldbody>
  <tendon>
{tendons}  </tendon>
  <custom>
{custom}  </custom>
</mujoco>
"#,
        name = escaped(&robot.name),
        gravity = words(&robot.gravity.vector()),
        sites = exits_and_ground(robot),
        platform = platform(robot, pose, &inertia),
        tendons = tendons(robot, &lengths),
        custom = custom(robot),
    );
    Ok(Exported { files: vec![(".xml", text)], notes })
}

// Writing to a string cannot fail.

fn exits_and_ground(robot: &Robot) -> String {
    let mut text = String::new();
    for (i, cable) in robot.cables.iter().enumerate() {
        let _ = writeln!(text, "    <site name=\"exit_{}\" pos=\"{}\"/>", i + 1, words(&cable.exit_point));
    }
    if let Some(ground) = robot.ground_z {
        let _ = writeln!(
            text,
            "    <geom name=\"ground\" type=\"plane\" pos=\"0 0 {ground:?}\" size=\"0 0 1\"/>"
        );
    }
    text
}

/// The platform with its anchor points.
fn platform(robot: &Robot, pose: &Pose, inertia: &Matrix3<f64>) -> String {
    let q = UnitQuaternion::from_rotation_matrix(&pose.rotation);
    let [xx, yy, zz] = [0, 1, 2].map(|i| inertia[(i, i)]);
    let [xy, xz, yz] = [(0, 1), (0, 2), (1, 2)].map(|place| inertia[place]);
    let mut text = format!(
        r#"    <body name="platform" pos="{position}" quat="{:?} {:?} {:?} {:?}">
      <freejoint name="platform"/>
      <inertial pos="{center}" mass="{mass:?}" fullinertia="{xx:?} {yy:?} {zz:?} {xy:?} {xz:?} {yz:?}"/>
      <geom type="sphere" pos="{center}" size="{size:?}" contype="0" conaffinity="0" mass="0"/>
"#,
        q.w,
        q.i,
        q.j,
        q.k,
        position = words(&pose.position),
        center = words(&robot.platform.center_of_mass),
        mass = robot.platform.mass,
        size = 0.2 * robot.platform_size().max(0.01),
    );
    for (i, cable) in robot.cables.iter().enumerate() {
        let _ =
            writeln!(text, "      <site name=\"anchor_{}\" pos=\"{}\"/>", i + 1, words(&cable.anchor_point));
    }
    text + "    </body>\n"
}

fn tendons(robot: &Robot, lengths: &[f64]) -> String {
    let mut text = String::new();
    for (i, (cable, length)) in robot.cables.iter().zip(lengths).enumerate() {
        let number = i + 1;
        let stiffness = cable.properties.axial_stiffness() / length;
        let _ = writeln!(
            text,
            "    <spatial name=\"cable_{number}\" stiffness=\"{stiffness:?}\" springlength=\"0 {length:?}\" \
             width=\"0.005\">
      <site site=\"exit_{number}\"/> <site site=\"anchor_{number}\"/>
    </spatial>"
        );
    }
    text
}

/// What has no other place.
fn custom(robot: &Robot) -> String {
    let mut text = String::new();
    if let Some(source) = &robot.provenance.source {
        let _ = writeln!(text, "    <text name=\"source\" data=\"{}\"/>", escaped(source));
    }
    for (i, cable) in robot.cables.iter().enumerate() {
        let (number, p, limits) = (i + 1, &cable.properties, robot.limits(i));
        let known = |value: Option<f64>| value.unwrap_or(0.0);
        let _ = writeln!(
            text,
            "    <numeric name=\"cable_{number}.properties\" data=\"{:?} {:?} {:?} {:?} {:?}\"/>
    <numeric name=\"cable_{number}.tension_limits\" data=\"{:?} {:?}\"/>",
            p.section,
            p.linear_density,
            p.youngs_modulus,
            known(p.diameter),
            known(p.breaking_force),
            limits.min,
            limits.max,
        );
    }
    text
}
