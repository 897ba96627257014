//! MoorPy and MoorDyn: fixed points, a free body and elastic catenaries, in air.
//!
//! Both read the same tables, but not the same angles of a body and not the same options. MoorDyn's motion
//! over time needs a method of high order and steps that axial waves allow: its own, 1 ms and second order,
//! end in NaN within six.

use crate::error::ExchangeError;
use crate::write::scene::{Exported, check_plain, check_upright, inertia, unplaced, words};
use cdpr_robot::{Matrix3, Pose, Robot, RobotCable, Vector3};
use cdpr_statics::{Load, inverse};
use std::f64::consts::PI;

/// Segments of a line.
const SEGMENTS: usize = 20;

/// Which of the two programs reads the file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reader {
    Moorpy,
    Moordyn,
}

pub(crate) fn write(robot: &Robot, pose: &Pose, reader: Reader) -> Result<Exported, ExchangeError> {
    check_plain(robot)?;
    let weightless = robot.cables.iter().position(|cable| cable.properties.linear_density == 0.0);
    if let (Reader::Moordyn, Some(i)) = (reader, weightless) {
        let field = format!("cables[{i}].linear_density");
        return Err(ExchangeError::no_place(field, 0, "cables with mass"));
    }
    check_upright(robot)?;
    let lengths = inverse(robot, pose, &Load::none())?.lengths;
    let mut notes = unplaced(robot);
    if robot.ground_z.is_some() {
        notes.push("the height of the ground (ground_z) has no place".to_owned());
    }
    notes.push(match reader {
        Reader::Moorpy => "MoorPy's lines are elastic catenaries between points: limits of tension and products of \
                           inertia have no place"
            .to_owned(),
        Reader::Moordyn => format!(
            "MoorDyn's lines are {SEGMENTS} straight segments without damping (BA): limits of tension and products \
             of inertia have no place"
        ),
    });
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
{options}\
---------------------- need this line -----------------------------------
",
        line_types = line_types(robot),
        body = body(robot, pose, &inertia, reader),
        points = points(robot),
        lines = lines(&lengths),
        gravity = robot.gravity.vector().norm(),
        options = options(robot, &lengths, 1000.0 - lowest, reader),
    );
    Ok(Exported { files: vec![(".txt", text)], notes })
}

/// What only one of the programs knows. The ground is far below.
fn options(robot: &Robot, lengths: &[f64], depth: f64, reader: Reader) -> String {
    match reader {
        Reader::Moorpy => format!("{depth:?} depth\n"),
        // The rest of the lines is that of the file: nothing is searched for.
        Reader::Moordyn => {
            format!("{depth:?} WtrDpth\nrk4 tScheme\n{:.3e} dtM\n0 TmaxIC\n", step(robot, lengths))
        }
    }
}

/// Steps of time [s] with which RK4 follows the axial waves of the segments: they vibrate at up to 2 c/h, h
/// being the length of a segment and c² = EA/μ, and RK4 is stable below a step of 1.41 h/c.
fn step(robot: &Robot, lengths: &[f64]) -> f64 {
    const SHARE: f64 = 0.5;
    let of = |(cable, length): (&RobotCable, &f64)| {
        let speed = (cable.properties.axial_stiffness() / cable.properties.linear_density).sqrt();
        SHARE * length / (SEGMENTS as f64 * speed)
    };
    robot.cables.iter().zip(lengths).map(of).fold(f64::INFINITY, f64::min)
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

fn body(robot: &Robot, pose: &Pose, inertia: &Matrix3<f64>, reader: Reader) -> String {
    let (roll, pitch, yaw) = match reader {
        // Rz(yaw) Ry(pitch) Rx(roll).
        Reader::Moorpy => pose.rotation.euler_angles(),
        // Rx(roll) Ry(pitch) Rz(yaw): the inverse has the negative angles in the other order.
        Reader::Moordyn => {
            let matrix = pose.rotation.matrix();
            (
                (-matrix[(1, 2)]).atan2(matrix[(2, 2)]),
                matrix[(0, 2)].clamp(-1.0, 1.0).asin(),
                (-matrix[(0, 1)]).atan2(matrix[(0, 0)]),
            )
        }
    };
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
        format!("{number} cable{number} {number} {anchor} {length:?} {SEGMENTS} -\n")
    };
    lengths.iter().enumerate().map(row).collect()
}
