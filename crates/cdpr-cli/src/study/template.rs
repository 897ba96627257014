//! `cdpr study new`: a first study of a robot.

use crate::arguments::{self, FreeArguments};
use crate::endings;
use crate::error::ProgramError;
use crate::output::patiently;
use crate::questions;
use cdpr_study::{TEMPLATE_NOTES, template, template_cost, write_template};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Settings {
    /// Robot file (JSON, `cdpr-robot/1`).
    #[arg(long)]
    robot: PathBuf,
    /// File to write, which must not exist; if left out, the study is printed.
    #[arg(long, value_parser = endings::json())]
    out: Option<PathBuf>,
    /// Position of the platform: x,y,z [m]; if left out, the middle of the exit points.
    #[arg(long, value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    position: Option<[f64; 3]>,
    /// Payload, whose effect is the deflection [kg]; if left out, a tenth of the platform's mass.
    #[arg(long, value_parser = arguments::payload, allow_hyphen_values = true)]
    payload: Option<f64>,
    #[command(flatten)]
    free: FreeArguments,
}

pub(super) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let Settings { robot: path, out, position, payload, free } = settings;
    let robot = questions::open_robot(path)?;
    let text =
        |path: &str| patiently("trying poses", || template(&robot, path, *position, *payload, &free.free));
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
