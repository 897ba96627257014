//! The uncertain parameters of CAROCA, with their nominal values.

#![allow(clippy::print_stdout)]

use cdpr_robot::{Parameter, Robot, RobotError};

fn main() -> Result<(), RobotError> {
    let robot = Robot::from_library("caroca")?;
    for parameter in Parameter::of(&robot) {
        println!("{parameter:16} {:>14} {}", parameter.nominal(&robot), parameter.unit());
    }
    Ok(())
}
