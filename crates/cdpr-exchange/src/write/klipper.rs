//! Klipper's kinematics `winch`: the anchors of 3 to 26 lines, in the syntax of its `printer.cfg`.
//!
//! Source: Klipper3d/klipper, `klippy/kinematics/winch.py` and `config/example-winch.cfg` at commit
//! 0cd60f8691cf: sections `stepper_a` to `stepper_z` with `anchor_x`, `anchor_y` and `anchor_z` [mm]. A line
//! is as long as the distance from its anchor to the nozzle; elasticity and weight have no option. Klipper's
//! pull requests #1023 and #7093 would add some.

use crate::error::ExchangeError;
use crate::write::anchors::{Anchors, millimetres};
use crate::write::scene::Exported;
use cdpr_robot::{Pose, Robot};
use std::fmt::Write;

/// Letters of the lines.
const LETTERS: std::ops::RangeInclusive<char> = 'a'..='z';

/// Klipper reads three sections at least.
const LEAST: usize = 3;

pub(crate) fn write(robot: &Robot, pose: &Pose) -> Result<Exported, ExchangeError> {
    let count = robot.cables.len();
    if !(LEAST..=LETTERS.count()).contains(&count) {
        return Err(ExchangeError::no_place("cables", format!("a list of {count}"), "3 to 26 cables"));
    }
    let Anchors { points, mut notes } = Anchors::new(robot, pose)?;
    notes.push(
        "pins, rotation_distance and the limits of velocity are not in a robot file; Klipper homes at 0, 0, 0"
            .to_owned(),
    );
    let mut text = "[printer]\nkinematics: winch\n".to_owned();
    for (letter, point) in LETTERS.zip(&points) {
        // Writing to a string cannot fail.
        let _ = write!(text, "\n[stepper_{letter}]\n");
        for (axis, value) in ['x', 'y', 'z'].into_iter().zip(point.iter()) {
            let _ = writeln!(text, "anchor_{axis}: {}", millimetres(*value));
        }
    }
    Ok(Exported { files: vec![(".cfg", text)], notes })
}
