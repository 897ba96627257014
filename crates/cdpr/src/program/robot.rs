//! `cdpr robot ...`: robots and their files, and the commands about a robot as a whole.

mod check;
pub(crate) mod design;
pub(crate) mod explore;
mod export;
mod import;
mod library;
mod show;
pub(crate) mod workspace;

use crate::program::error::ProgramError;
use crate::program::output::Ending;
use clap::Subcommand;

#[derive(Subcommand)]
pub(crate) enum Command {
    /// List the robots and cables that come with the program.
    ///
    /// Every command takes the name of such a robot instead of a robot file; a file of that name comes first.
    #[command(after_help = "Example: cdpr robot list")]
    List(library::Settings),
    /// Print what a robot is: platform, cables, source.
    #[command(after_help = "Example: cdpr robot show cogiro")]
    Show(show::Settings),
    /// List everything that is odd about a robot file.
    #[command(after_help = "Example: cdpr robot check data/robots/cogiro.json")]
    Check(check::Settings),
    /// Make a robot file of the files of another program.
    ///
    /// What the files lack is named with the option that gives it. What is assumed, what looks like a value
    /// of a template (exit code 3) and what a robot file has no place for is listed.
    #[command(after_help = "Examples:
  cdpr robot import CASPR/ACROBOT --cable steel-2mm --out acrobot.json
  cdpr robot import EXPO2015_Lucia.wcrfx --tension-limits 10,4000 --out lucia.json
  cdpr robot import caroca.yaml --cable steel-4mm --out caroca.json")]
    Import(import::Settings),
    /// Write a robot for other programs and for firmware.
    ///
    /// Klipper, RepRapFirmware and Maslow get the points of straight lines in millimetres. What their
    /// kinematics cannot say is printed or refused. A table has the lengths with stretch and sag, and its
    /// notes bound the error of interpolation.
    #[command(after_help = "Examples:
  cdpr robot export cogiro --to mjcf --pose 0,0,2 --out cogiro.xml
  cdpr robot export cogiro --to table --region -2:2:9,-1:1:5,2:3:3 --out lengths.csv
  cdpr robot export ipanema-3 --to caspr --pose 0,0,1.3 --out IPAnema3")]
    Export(export::Settings),
}

pub(crate) fn run(command: &Command) -> Result<Ending, ProgramError> {
    match command {
        Command::List(settings) => library::run(settings)?,
        Command::Show(settings) => show::run(settings)?,
        Command::Check(settings) => return check::run(settings),
        Command::Import(settings) => return import::run(settings),
        Command::Export(settings) => export::run(settings)?,
    }
    Ok(Ending::Well)
}
