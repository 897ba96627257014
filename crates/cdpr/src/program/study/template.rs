//! `cdpr study new`: a first study of a robot.

use crate::program::arguments::endings;
use crate::program::arguments::poses::pose;
use crate::program::arguments::{self, FreeArguments, RobotArgument};
use crate::program::error::ProgramError;
use crate::program::output::patiently;
use crate::program::questions;
use cdpr_robot::{Pose, Rotation3};
use cdpr_study::{TEMPLATE_NOTES, template, template_cost, write_template};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// File to write, which must not exist; if left out, the study is printed.
    #[arg(short, long, value_parser = endings::json())]
    out: Option<PathBuf>,
    /// Pose of the platform, level: x,y,z [m]; if left out, one near the middle of the exit points.
    #[arg(long, value_parser = pose, allow_hyphen_values = true)]
    pose: Option<Pose>,
    /// Payload, whose effect is the deflection [kg]; if left out, a tenth of the platform's mass.
    #[arg(long, value_parser = arguments::payload, allow_hyphen_values = true)]
    payload: Option<f64>,
    #[command(flatten)]
    free: FreeArguments,
}

pub(super) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let Settings { robot, out, pose, payload, free } = settings;
    if pose.is_some_and(|pose| pose.rotation != Rotation3::identity()) {
        let expected = "--pose: expected x,y,z, a level platform; the study file takes rotations, too";
        return Err(ProgramError::Usage(expected.to_owned()));
    }
    let (path, position) = (robot.path(), pose.map(|pose| pose.position.into()));
    let robot = questions::open_robot(path)?;
    let text =
        |path: &str| patiently("trying poses", || template(&robot, path, position, *payload, &free.free));
    let notes = format!("{TEMPLATE_NOTES}\n\n{}", template_cost(&robot));
    match out {
        Some(out) => {
            write_template(out, path, text)?;
            println!("{} is a study of {}\n\n{notes}", out.display(), path.display());
        }
        None => {
            println!("{}", text(&path.display().to_string())?.trim_end());
            eprintln!("{notes}");
        }
    }
    Ok(())
}
