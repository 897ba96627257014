//! MoorPy and MoorDyn: fixed points, a free body and elastic catenaries, in air. Stiff and light lines need small
//! steps of a method of high order: MoorDyn's own, 1 ms and second order, end in NaN within six.

use crate::error::ExchangeError;
use crate::write::scene::{Exported, check_plain, inertia, unplaced, words};
use cdpr_robot::{Matrix3, Pose, Robot, RobotCable, Vector3};
use cdpr_statics::{Load, inverse};
use std::f64::consts::PI;

pub(crate) fn write(robot: &Robot, pose: &Pose) -> Result<Exported, ExchangeError> {
    check_plain(robot)?;
    let down = robot.gravity.vector();
    if down.xy().norm() > 1e-9 * down.norm() {
        let value = format!("{:?}", down.as_slice());
        return Err(ExchangeError::NoPlace { field: "gravity".to_owned(), value });
    }
    let lengths = inverse(robot, pose, &Load::none())?.lengths;
    let mut notes = unplaced(robot);
    if robot.ground_z.is_some() {
        notes.push("the height of the ground (ground_z) has no place".to_owned());
    }
    notes.push(
        "MoorPy's lines are elastic catenaries between points: limits of tension and products of inertia \
         have no place"
            .to_owned(),
    );
    let inertia = inertia(robot, &mut notes);
    let lowest = robot.cables.iter().map(|cable| cable.exit_point.z).fold(pose.position.z, f64::min);
    let text = format!(
        "--------------------- MoorDyn v2 input file, in air ---------------------
---------------------- LINE TYPES ---------------------------------------
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
{line_types}\
---------------------- BODIES -------------------------------------------
ID Attachment X0 Y0 Z0 r0 p0 y0 Mass CG I Volume CdA Ca
(#) (-) (m) (m) (m) (deg) (deg) (deg) (kg) (m) (kg-m^2) (m^3) (m^2) (-)
{body}
---------------------- POINTS -------------------------------------------
ID Attachment X Y Z Mass Volume CdA Ca
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
{points}\
---------------------- LINES --------------------------------------------
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
{lines}\
---------------------- OPTIONS ------------------------------------------
{gravity:?} g
0 rho
{depth:?} depth
rk4 tScheme
1e-4 dtM
---------------------- need this line -----------------------------------
",
        line_types = line_types(robot),
        body = body(robot, pose, &inertia),
        points = points(robot),
        lines = lines(&lengths),
        gravity = down.norm(),
        depth = 1000.0 - lowest,
    );
    Ok(Exported { files: vec![(".txt", text)], notes })
}

fn line_types(robot: &Robot) -> String {
    let row = |(i, cable): (usize, &RobotCable)| {
        let p = &cable.properties;
        let diameter = p.diameter.unwrap_or_else(|| (4.0 * p.section / PI).sqrt());
        let (number, stiffness) = (i + 1, p.axial_stiffness());
        format!("cable{number} {diameter:?} {:?} {stiffness:?} 0 0 0 0 0 0\n", p.linear_density)
    };
    robot.cables.iter().enumerate().map(row).collect()
}

fn body(robot: &Robot, pose: &Pose, inertia: &Matrix3<f64>) -> String {
    // MoorPy rotates a body by Rz(yaw) Ry(pitch) Rx(roll).
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let [roll, pitch, yaw] = [roll, pitch, yaw].map(f64::to_degrees);
    let (position, mass, c) = (words(&pose.position), robot.platform.mass, robot.platform.center_of_mass);
    let [xx, yy, zz] = [0, 1, 2].map(|i| inertia[(i, i)]);
    format!(
        "1 Free {position} {roll:?} {pitch:?} {yaw:?} {mass:?} {:?}|{:?}|{:?} {xx:?}|{yy:?}|{zz:?} 0 0 0",
        c.x, c.y, c.z
    )
}

/// All exit points, then all anchor points.
fn points(robot: &Robot) -> String {
    let exits = robot.cables.iter().map(|cable| ("Fixed", cable.exit_point));
    let points = exits.chain(robot.cables.iter().map(|cable| ("Body1", cable.anchor_point)));
    let row = |(i, (of, place)): (usize, (&str, Vector3<f64>))| {
        format!("{} {of} {} 0 0 0 0\n", i + 1, words(&place))
    };
    points.enumerate().map(row).collect()
}

fn lines(lengths: &[f64]) -> String {
    let row = |(i, length): (usize, &f64)| {
        let (number, anchor) = (i + 1, lengths.len() + i + 1);
        format!("{number} cable{number} {number} {anchor} {length:?} 20 -\n")
    };
    lengths.iter().enumerate().map(row).collect()
}
