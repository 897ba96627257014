//! `cdpr robot export`: a robot in the files of another program.

use crate::program::arguments::endings::check_foreign;
use crate::program::arguments::poses::{PoseArguments, place};
use crate::program::arguments::{Overwrite, RobotArgument};
use crate::program::error::ProgramError;
use crate::program::output::patiently;
use crate::program::questions;
use cdpr_exchange::{Target, export};
use cdpr_robot::shown;
use std::path::{Path, PathBuf};

/// A robot, a pose and a format.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// Format.
    #[arg(long, value_enum)]
    to: Format,
    #[command(flatten)]
    pose: PoseArguments,
    /// File to write; with CASPR what both names begin with.
    #[arg(short, long)]
    out: PathBuf,
    #[command(flatten)]
    overwrite: Overwrite,
}

/// Formats of other programs.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Format {
    /// MuJoCo: a platform with a free joint and a spring a cable, straight and without weight.
    Mjcf,
    /// CASPR: bodies and cables (XML), pulleys included.
    Caspr,
    /// MoorPy: elastic catenaries.
    Moorpy,
    /// MoorDyn: lines of straight segments with mass, for motions over time.
    Moordyn,
}

impl Format {
    /// Refuses the name of a file that says another format.
    fn check(self, out: &Path) -> Result<(), ProgramError> {
        let checked = match self {
            Self::Mjcf => check_foreign(out, "a model of MuJoCo is XML", &["xml", "mjcf"]),
            Self::Moorpy => check_foreign(out, "a system of MoorPy is text", &["txt", "dat"]),
            Self::Moordyn => check_foreign(out, "a system of MoorDyn is text", &["txt", "dat"]),
            Self::Caspr => check_foreign(out, "`_bodies.xml` and `_cables.xml` are put behind it", &[]),
        };
        checked.map_err(ProgramError::Usage)
    }

    fn target(self) -> Target {
        match self {
            Self::Mjcf => Target::Mjcf,
            Self::Caspr => Target::Caspr,
            Self::Moorpy => Target::Moorpy,
            Self::Moordyn => Target::Moordyn,
        }
    }
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    settings.to.check(&settings.out)?;
    let pose = settings.pose.needed()?;
    let robot = questions::open_robot(settings.robot.path())?;
    questions::about_pose(&robot, "--pose", &pose);
    let exported = patiently("solving", || export(&robot, &pose, settings.to.target()))?;
    let single = exported.files.len() == 1;
    for (ending, text) in &exported.files {
        let mut path = settings.out.clone().into_os_string();
        if !single {
            path.push(ending);
        }
        let path = PathBuf::from(path);
        settings.overwrite.write(&path, text)?;
        println!("{}: {} at {}", path.display(), shown(&robot.name), place(&pose));
    }
    exported.notes.iter().for_each(|note| println!("note: {note}"));
    Ok(())
}
