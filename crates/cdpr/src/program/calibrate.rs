//! `cdpr calibrate ...`: from the poses to measure to the calibrated robot.

mod candidates;
mod fit;
mod identify;
mod plan;
mod pulleys;
mod sensors;
mod simulate;

use crate::program::error::ProgramError;
use crate::program::output::Ending;
use clap::Subcommand;

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Choose the poses to measure.
    ///
    /// They leave the least uncertainty together, and are compared with random and outermost poses.
    #[command(after_help = "Example: cdpr calibrate plan caroca --region=-2:2:5,-1:1:3,1:2.5:3 \
                      --uncertainty a=0.002,b=0.002,youngs_modulus=5e9 --noise position=1e-4,rotation=1e-4 \
                      --work=-1:1:3,-1:1:3,1.5:2:2 --with criterion=mean-position --number 20")]
    Plan(Box<plan::Settings>),
    /// Find which parameters measurements identify.
    ///
    /// Prints the combinations of parameters that they identify and do not identify, and the best poses.
    #[command(after_help = "Example: cdpr calibrate identify caroca --region=-2:2:5,-1:1:3,1:2.5:3 \
                      --uncertainty a=0.002,b=0.002,youngs_modulus=5e9 --noise position=1e-4,rotation=1e-4")]
    Identify(Box<identify::Settings>),
    /// Write what the sensors of a robot would read.
    ///
    /// The robot has deviations that are drawn from its tolerances.
    #[command(after_help = "Example: cdpr calibrate simulate caroca --region=-2:2:5,-1:1:3,1:2.5:3 \
                      --uncertainty tolerances.json --noise position=1e-4,rotation=1e-4,length=1e-4 --seed 1 \
                      --out measurements.csv")]
    Simulate(Box<simulate::Settings>),
    /// Fit the parameters of a robot to measurements.
    ///
    /// Writes the calibrated robot, and the accuracy that is left.
    #[command(after_help = "Examples:
  cdpr calibrate fit caroca measurements.csv --uncertainty tolerances.json \
                      --noise position=1e-4,rotation=1e-4,length=1e-4 --out calibration
  cdpr calibrate fit irma4u lengths-and-tensions.csv --parameters mass \
                      --unknown length_offset --noise length=1e-3,tension=2 --out calibration")]
    Fit(Box<fit::Settings>),
    /// Find the friction of pulleys from tensions at the winches.
    ///
    /// Prints the coefficients that the measurements identify, or the sum of them that they do, and how far
    /// the tensions are from the model.
    #[command(after_help = "Example: cdpr calibrate pulleys expo2015-lucia load-cycle.csv --pose 0.2,0.1,2")]
    Pulleys(Box<pulleys::Settings>),
}

pub(crate) fn run(command: &Command) -> Result<Ending, ProgramError> {
    match command {
        Command::Plan(settings) => plan::run(settings),
        Command::Identify(settings) => identify::run(settings),
        Command::Simulate(settings) => simulate::run(settings),
        Command::Fit(settings) => fit::run(settings),
        Command::Pulleys(settings) => pulleys::run(settings),
    }
}
