//! `cdpr study new`: a first study of a robot.

use crate::program::arguments::endings;
use crate::program::arguments::poses::pose;
use crate::program::arguments::{self, FreeArguments, Overwrite, RobotArgument};
use crate::program::error::ProgramError;
use crate::program::output::patiently;
use crate::program::questions;
use crate::program::said::{Said, is_said};
use cdpr_robot::{Pose, Rotation3};
use cdpr_study::{StudyError, template, template_cost, template_notes, write_template};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// File to write; if left out, the study is printed.
    #[arg(short, long, value_parser = endings::json())]
    out: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
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
    let Settings { robot, out, overwrite, pose, payload, free } = settings;
    if pose.is_some_and(|pose| pose.rotation != Rotation3::identity()) {
        let expected = "--pose: expected x,y,z, a level platform; the study file takes rotations, too";
        return Err(ProgramError::Usage(expected.to_owned()));
    }
    let (path, position) = (robot.path(), pose.map(|pose| pose.position.into()));
    let robot = questions::open_robot(path)?;
    let text =
        |path: &str| patiently("trying poses", || template(&robot, path, position, *payload, &free.free));
    let notes = format!("{}\n\n{}", template_notes(&robot), template_cost(&robot));
    match out {
        Some(out) => {
            if overwrite.is_wanted() && out.is_file() {
                // The file stays where the new one cannot be made.
                let name = out.file_name().unwrap_or_default().to_string_lossy();
                let made = out.with_file_name(format!(".{name}.{}", std::process::id()));
                write_template(&made, path, text)?;
                std::fs::rename(&made, out)
                    .map_err(|source| StudyError::Write { path: out.clone(), source })?;
            } else {
                write_template(out, path, text)?;
            }
            println!("{} is a study of {}", out.display(), path.display());
            if is_said(Said::Usual) {
                println!("\n{notes}");
            }
        }
        None => {
            println!("{}", text(&path.display().to_string())?.trim_end());
            if is_said(Said::Usual) {
                eprintln!("{notes}");
            }
        }
    }
    Ok(())
}
