//! `cdpr cable ...`: one cable: its catenary, modulus and mass per length.

mod catenary;
mod density;
mod modulus;

use crate::program::error::ProgramError;
use clap::Subcommand;

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Compute one cable between two points.
    ///
    /// Prints its force, tensions, sag and energy.
    #[command(after_help = "Example: cdpr cable catenary steel-4mm --length 4.3 \
                      --end 4.1,-1.7")]
    Catenary(catenary::Settings),
    /// Compute the moduli of a load-elongation record.
    ///
    /// Each modulus has its uncertainty; the energy that the loop dissipates is printed below them.
    #[command(after_help = "Example: cdpr cable modulus data/cables/caroca-4mm-record.csv \
                      --breaking-force 10290 --section 1.2566e-5 --length 1 --range 5-10 --range 10-30")]
    Modulus(modulus::Settings),
    /// Compute the mass per length of a weighed piece.
    #[command(
        after_help = "Example: cdpr cable density --mass 0.203 --length 2 --errors mass=0.001,length=0.001"
    )]
    Density(density::Settings),
}

pub(crate) fn run(command: &Command) -> Result<(), ProgramError> {
    match command {
        Command::Catenary(settings) => catenary::run(settings),
        Command::Modulus(settings) => modulus::run(settings),
        Command::Density(settings) => density::run(settings),
    }
}
