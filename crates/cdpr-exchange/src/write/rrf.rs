//! RepRapFirmware's kinematics of the Hangprinter: `M669` has the anchors, `M666` the flex of the lines.
//!
//! Source: Duet3D/RepRapFirmware 3.5.3, `src/Movement/Kinematics/HangprinterKinematics.cpp` (pull
//! request #606). `M669 K6` has N anchors, A, B, C, D and I [mm]. `M666` has A, the mode of the anchors (0:
//! none, 1: the last one on top, 2: all on top), U, mechanical advantages, Y, guy wires [mm], W, the mover's
//! weight [kg], S, the spring constant per unit length, which is EA [N], and I and X, the least and greatest
//! force of each line [N]. The firmware balances the forces on a point by g = 9.81 m/s² and shortens each
//! line by `F d / S`. It does so, and computes a position from lengths, in mode 1 with four or five lines
//! alone.

use crate::error::ExchangeError;
use crate::write::anchors::{Anchors, fixed, joined};
use crate::write::scene::{Exported, check_upright, stiffness_at};
use cdpr_robot::{Pose, Robot, TensionLimits, Vector3};
use std::fmt::Write;

/// Letters of the anchors.
const LETTERS: [char; 5] = ['A', 'B', 'C', 'D', 'I'];

/// Three lines or more hold a point.
const LEAST: usize = 3;

/// The firmware's acceleration of gravity [m/s²].
const GRAVITY: f64 = 9.81;

/// Greatest difference of EA among the lines, which have one S, relative to it.
const SAME: f64 = 1e-9;

pub(crate) fn write(robot: &Robot, pose: &Pose) -> Result<Exported, ExchangeError> {
    let count = robot.cables.len();
    if !(LEAST..=LETTERS.len()).contains(&count) {
        return Err(ExchangeError::no_place("cables", format!("a list of {count}"), "3 to 5 cables"));
    }
    check_upright(robot)?;
    check_one_stiffness(robot)?;
    let (stiffness, law) = stiffness_at(robot, pose, "S");
    // The firmware has one number for all lines.
    let stiffness = stiffness.iter().sum::<f64>() / count as f64;
    let Anchors { points, mut notes } = Anchors::new(robot, pose)?;
    let mode = mode(&points, pose);
    notes.push(match mode {
        1 => {
            "the stretch of the lines is that of the firmware's own tensions, with W and S, in its versions 3.5 and \
             3.6 (later ones may need `M666 F1` for it: see their list of changes); sag has no place"
                .to_owned()
        }
        _ => {
            "the firmware has stretch, and positions from lengths, only where four or five lines end in one \
              above all others: it has neither for this robot"
                .to_owned()
        }
    });
    notes.extend(law.map(|note| note + ", their mean where they differ"));
    notes.push(
        "the radius of the printed area (P), spools, gears and motors (Q, R, L, H, J, C) are not in a robot \
         file"
            .to_owned(),
    );
    let mut text = format!("M669 K6 N{count}");
    for (letter, point) in LETTERS.into_iter().zip(&points) {
        // Writing to a string cannot fail.
        let _ = write!(text, " {letter}{}", joined(point.iter().map(|value| 1e3 * value)));
    }
    let each = |value: f64| joined(vec![value; count]);
    let limits = |limit: fn(TensionLimits) -> f64| joined((0..count).map(|i| limit(robot.limits(i))));
    let _ = write!(
        text,
        "\nM666 A{mode} U{} O{} Y{}\nM666 W{} S{} I{} X{}\n",
        each(1.0),
        each(1.0),
        each(0.0),
        fixed(robot.platform.mass * robot.gravity.magnitude() / GRAVITY),
        fixed(stiffness),
        limits(|limits| limits.min),
        limits(|limits| limits.max),
    );
    Ok(Exported { files: vec![(".g", text)], notes })
}

/// Refuses lines of different EA.
fn check_one_stiffness(robot: &Robot) -> Result<(), ExchangeError> {
    let stiffness = |i: usize| robot.cables[i].properties.axial_stiffness();
    let first = stiffness(0);
    match (0..robot.cables.len()).find(|i| (stiffness(*i) - first).abs() > SAME * first) {
        None => Ok(()),
        Some(i) => {
            let value = format!("EA = {} N, and {} N in cables[0]", stiffness(i), first);
            Err(ExchangeError::no_place(format!("cables[{i}].cable"), value, "one EA of all cables"))
        }
    }
}

/// The mode of the anchors: the last one on top, all on top, or none.
fn mode(points: &[Vector3<f64>], pose: &Pose) -> u8 {
    match points {
        [below @ .., last] if below.len() >= LEAST && below.iter().all(|point| point.z < last.z) => 1,
        _ if points.iter().all(|point| point.z > pose.position.z) => 2,
        _ => 0,
    }
}
