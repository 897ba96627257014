//! `cdpr export`: a robot in the files of another program.

use crate::error::ProgramError;
use crate::output::patiently;
use crate::poses::{Angles, place, pose};
use cdpr_exchange::{Target, export};
use cdpr_robot::{Pose, shown};
use cdpr_study::{open_robot, write_text};
use std::path::PathBuf;

/// A robot, a pose and a format.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Robot file (JSON, `cdpr-robot/1`).
    robot: PathBuf,
    /// Format.
    #[arg(long, value_enum)]
    to: Format,
    /// Pose at which the robot rests: x,y,z [m], or x,y,z,qw,qx,qy,qz with a quaternion.
    #[arg(long, value_parser = pose, allow_hyphen_values = true)]
    pose: Pose,
    #[command(flatten)]
    angles: Angles,
    /// File to write, over nothing but a file of this format; with CASPR what both names begin with.
    #[arg(long)]
    out: PathBuf,
}

/// Formats of other programs.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Format {
    /// MuJoCo: a platform with a free joint and a spring a cable, straight and without weight.
    Mjcf,
    /// CASPR: bodies and cables (XML), pulleys included.
    Caspr,
    /// MoorPy and MoorDyn: elastic catenaries.
    Moorpy,
}

impl Format {
    /// The format, and a text that its files have.
    fn target(self) -> (Target, &'static str) {
        match self {
            Self::Mjcf => (Target::Mjcf, "<mujoco"),
            Self::Caspr => (Target::Caspr, "<?xml"),
            Self::Moorpy => (Target::Moorpy, "LINE TYPES"),
        }
    }
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let robot = open_robot(&settings.robot)?;
    let pose = settings.angles.of(&settings.pose)?;
    let (target, like) = settings.to.target();
    let exported = patiently("solving", || export(&robot, &pose, target))?;
    let single = exported.files.len() == 1;
    for (ending, text) in &exported.files {
        let mut path = settings.out.clone().into_os_string();
        if !single {
            path.push(ending);
        }
        let path = PathBuf::from(path);
        write_text(&path, text, like)?;
        println!("{}: {} at {}", path.display(), shown(&robot.name), place(&pose));
    }
    exported.notes.iter().for_each(|note| println!("note: {note}"));
    Ok(())
}
