//! `cdpr robot export`: a robot in the files of another program, or its lengths as a table for firmware.

use crate::program::arguments::endings::check_foreign;
use crate::program::arguments::poses::{PoseArguments, place};
use crate::program::arguments::{Overwrite, Region, RobotArgument, region};
use crate::program::error::ProgramError;
use crate::program::output::patiently;
use crate::program::questions;
use cdpr_exchange::{ExchangeError, Exported, Target, correction_table, export, takers};
use cdpr_robot::{Axis, Pose, Robot, counted, shown};
use cdpr_statics::StaticsError;
use std::path::PathBuf;

/// A robot, a pose or a region, and a format.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// Format.
    #[arg(long, value_enum)]
    to: Format,
    #[command(flatten)]
    pose: PoseArguments,
    /// Positions of a table: a plane, z=1.75, or x, y and z, each of them a coordinate, min:max or
    /// min:max:points [m], such as -2:2:9,-1:1:5,1.75.
    ///
    /// What is left out, such as in ::11,::7,1.75, is that of the frame of the exit points, and 41 points in
    /// a plane or 11 in a box.
    #[arg(long, value_parser = region, allow_hyphen_values = true)]
    region: Option<Region>,
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
    /// Klipper, kinematics `winch`: the points of straight lines.
    Klipper,
    /// RepRapFirmware, Hangprinter (`M669`, `M666`): points and flex of straight lines.
    Rrf,
    /// Maslow, FluidNC's `MaslowKinematics`: the corners of a planar robot with four cables.
    Maslow,
    /// CSV of lengths with stretch and sag at the positions of a --region, to be interpolated.
    Table,
}

impl Format {
    /// The format of another program, `None` for a table; what its file is, and the endings of its name.
    fn file(self) -> (Option<Target>, &'static str, &'static [&'static str]) {
        match self {
            Self::Mjcf => (Some(Target::Mjcf), "a model of MuJoCo is XML", &["xml", "mjcf"]),
            Self::Caspr => (Some(Target::Caspr), "`_bodies.xml` and `_cables.xml` are put behind it", &[]),
            Self::Moorpy => (Some(Target::Moorpy), "a system of MoorPy is text", &["txt", "dat"]),
            Self::Moordyn => (Some(Target::Moordyn), "a system of MoorDyn is text", &["txt", "dat"]),
            Self::Klipper => (Some(Target::Klipper), "a configuration of Klipper is text", &["cfg"]),
            Self::Rrf => (Some(Target::Rrf), "commands of RepRapFirmware are G-code", &["g", "gcode"]),
            Self::Maslow => (Some(Target::Maslow), "a configuration of FluidNC is YAML", &["yaml", "yml"]),
            Self::Table => (None, "the table is CSV", &["csv", "txt"]),
        }
    }
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let (target, is, endings) = settings.to.file();
    check_foreign(&settings.out, is, endings).map_err(ProgramError::Usage)?;
    let Some(target) = target else { return table(settings) };
    if settings.region.is_some() {
        return Err(ProgramError::Usage(
            "--region: expected --to table, whose positions it names".to_owned(),
        ));
    }
    let pose = settings.pose.needed()?;
    let robot = questions::open_robot(settings.robot.path())?;
    questions::about_pose(&robot, "--pose", &pose);
    let exported = match patiently("solving", || export(&robot, &pose, target)) {
        Err(ExchangeError::Pose(StaticsError::FreeCoordinates { cables, freedoms, .. })) => {
            return Err(ProgramError::TooFewCables { cables, freedoms, instead: instead(&robot, &pose) });
        }
        exported => exported?,
    };
    write(settings, &exported, &format!("{} at {}", shown(&robot.name), place(&pose)))
}

/// What takes a robot with few cables.
fn instead(robot: &Robot, pose: &Pose) -> String {
    let others = cdpr_exchange::instead(&takers(robot, pose));
    format!("`cdpr inverse --pose POSE --free NAMES` finds the lengths; {others}")
}

/// Writes lengths and corrections at the positions of a region.
fn table(settings: &Settings) -> Result<(), ProgramError> {
    let rotation = settings.pose.rotation_of_region()?;
    let Some(region) = settings.region else {
        let expected = "--to table: expected --region, the positions, such as -2:2:9,-1:1:5,1.75";
        return Err(ProgramError::Usage(expected.to_owned()));
    };
    let robot = questions::open_robot(settings.robot.path())?;
    let grid = region.grid(&robot)?;
    let corners = grid.corners();
    ProgramError::unless_chosen(&robot, || instead(&robot, &corners[0]))?;
    questions::about_corners(&robot, "the table", &corners);
    let coordinates = Axis::ALL.map(|axis| grid.axis(axis).coordinates());
    let made = patiently("solving", || correction_table(&robot, &rotation, &coordinates))?;
    let of = format!("{} at {}", shown(&robot.name), counted(grid.count(), "position"));
    write(settings, &made.exported, &of)
}

/// Writes the files and prints what they have no place for.
fn write(settings: &Settings, exported: &Exported, what: &str) -> Result<(), ProgramError> {
    let single = exported.files.len() == 1;
    for (ending, text) in &exported.files {
        let mut path = settings.out.clone().into_os_string();
        if !single {
            path.push(ending);
        }
        let path = PathBuf::from(path);
        settings.overwrite.write(&path, text)?;
        println!("{}: {what}", path.display());
    }
    exported.notes.iter().for_each(|note| println!("note: {note}"));
    Ok(())
}
