//! `cdpr calibration`: what measurements identify, the poses to measure, and what a campaign would read.

mod candidates;
mod identify;
mod plan;
mod simulated;

use crate::error::ProgramError;
use clap::Subcommand;
use identify::Settings;
use plan::PlanSettings;
use simulated::SimulateSettings;

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Find the combinations of parameters that measurements identify, and the poses that identify most.
    #[command(after_help = "Example: cdpr calibration identify caroca --grid=-2:2:5,-1:1:3,1:2.5:3 \
                      --uncertainty a=0.002,b=0.002,youngs_modulus=5e9 --noise position=1e-4,rotation=1e-4")]
    Identify(Box<Settings>),
    /// Choose the poses that together leave least uncertainty, beside random and outermost ones.
    #[command(after_help = "Example: cdpr calibration plan caroca --grid=-2:2:5,-1:1:3,1:2.5:3 \
                      --uncertainty a=0.002,b=0.002,youngs_modulus=5e9 --noise position=1e-4,rotation=1e-4 \
                      --work=-1:1:3,-1:1:3,1.5:2:2 --criterion mean-at-work --count 20")]
    Plan(Box<PlanSettings>),
    /// Write what the sensors of a robot with deviations drawn from its tolerances would read.
    #[command(after_help = "Example: cdpr calibration simulate caroca --grid=-2:2:5,-1:1:3,1:2.5:3 \
                      --model tolerances.json --noise position=1e-4,rotation=1e-4,length=1e-4 --seed 1 \
                      --out measurements.csv")]
    Simulate(Box<SimulateSettings>),
}

pub(crate) fn run(command: &Command) -> Result<(), ProgramError> {
    match command {
        Command::Identify(settings) => identify::identify(settings),
        Command::Plan(settings) => plan::plan(settings),
        Command::Simulate(settings) => simulated::simulated(settings),
    }
}
