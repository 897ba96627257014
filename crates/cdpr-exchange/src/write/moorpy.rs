//! MoorPy and MoorDyn: fixed points, a free body and elastic catenaries, in air. Stiff and light lines need small
//! steps of a method of high order: MoorDyn's own, 1 ms and second order, end in NaN within six.

use crate::error::ExchangeError;
use crate::write::scene::{Exported, check_plain, inertia, unplaced, words};
use cdpr_robot::{Pose, Robot};
use cdpr_statics::{Load, inverse};
use std::f64::consts::PI;
use std::fmt::Write;

pub(crate) fn write(robot: &Robot, pose: &Pose) -> Result<Exported, ExchangeError> {
    check_plain(robot)?;
    let down = robot.gravity.vector();
    if down.xy().norm() > 1e-9 * down.norm() {
        let value = format!("{:?}", down.as_slice());
        return Err(ExchangeError::NoPlace { field: "gravity".to_owned(), value });
    }
    let lengths = inverse(robot, pose, &Load::none())?.lengths;
    let (about_center, assumed) = inertia(robot);
    let mut notes = unplaced(robot);
    if robot.ground_z.is_some() {
        notes.push("the height of the ground (ground_z) has no place".to_owned());
    }
    notes.push(
        "MoorPy's lines are elastic catenaries between points: limits of tension and products of inertia \
         have no place"
            .to_owned(),
    );
    if assumed {
        notes.push(
            "the inertia is that of a ball as large as the platform: the robot file has none".to_owned(),
        );
    }
    // MoorPy rotates a body by Rz(yaw) Ry(pitch) Rx(roll).
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let c = robot.platform.center_of_mass;
    let [xx, yy, zz] = [0, 1, 2].map(|i| about_center[(i, i)]);
    let mut text = String::from(
        "--------------------- MoorDyn v2 input file, in air ---------------------
---------------------- LINE TYPES ---------------------------------------
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
",
    );
    // Writing to a string cannot fail.
    for (i, cable) in robot.cables.iter().enumerate() {
        let p = &cable.properties;
        let diameter = p.diameter.unwrap_or_else(|| (4.0 * p.section / PI).sqrt());
        let _ = writeln!(
            text,
            "cable{} {diameter:?} {:?} {:?} 0 0 0 0 0 0",
            i + 1,
            p.linear_density,
            p.axial_stiffness()
        );
    }
    let _ = write!(
        text,
        "---------------------- BODIES -------------------------------------------
ID Attachment X0 Y0 Z0 r0 p0 y0 Mass CG I Volume CdA Ca
(#) (-) (m) (m) (m) (deg) (deg) (deg) (kg) (m) (kg-m^2) (m^3) (m^2) (-)
1 Free {} {:?} {:?} {:?} {:?} {:?}|{:?}|{:?} {xx:?}|{yy:?}|{zz:?} 0 0 0
---------------------- POINTS -------------------------------------------
ID Attachment X Y Z Mass Volume CdA Ca
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
",
        words(&pose.position),
        roll.to_degrees(),
        pitch.to_degrees(),
        yaw.to_degrees(),
        robot.platform.mass,
        c.x,
        c.y,
        c.z
    );
    let count = robot.cables.len();
    for (i, cable) in robot.cables.iter().enumerate() {
        let _ = writeln!(text, "{} Fixed {} 0 0 0 0", i + 1, words(&cable.exit_point));
    }
    for (i, cable) in robot.cables.iter().enumerate() {
        let _ = writeln!(text, "{} Body1 {} 0 0 0 0", count + i + 1, words(&cable.anchor_point));
    }
    text += "---------------------- LINES --------------------------------------------
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
";
    for (i, length) in lengths.iter().enumerate() {
        let _ = writeln!(text, "{} cable{} {} {} {length:?} 20 -", i + 1, i + 1, i + 1, count + i + 1);
    }
    let lowest = robot.cables.iter().map(|cable| cable.exit_point.z).fold(pose.position.z, f64::min);
    let _ = write!(
        text,
        "---------------------- OPTIONS ------------------------------------------
{:?} g
0 rho
{:?} depth
rk4 tScheme
1e-4 dtM
---------------------- need this line -----------------------------------
",
        down.norm(),
        1000.0 - lowest,
    );
    Ok(Exported { files: vec![(".txt", text)], notes })
}
