//! `cdpr linear-density`: the mass per length of a cable from a weighing.

use crate::arguments::{Format, number};
use crate::error::ProgramError;
use crate::questions;
use cdpr_cable::{Measured, linear_density};
use cdpr_robot::plausible;
use serde::Serialize;

/// The piece of cable that was weighed.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Mass of the piece [kg].
    #[arg(long, value_parser = number, allow_hyphen_values = true)]
    mass: f64,
    /// Length of the piece [m].
    #[arg(long, value_parser = number, allow_hyphen_values = true)]
    length: f64,
    /// Greatest error of the mass [kg].
    #[arg(long, value_parser = number, allow_hyphen_values = true, default_value_t = 0.0)]
    mass_error: f64,
    /// Greatest error of the length [m].
    #[arg(long, value_parser = number, allow_hyphen_values = true, default_value_t = 0.0)]
    length_error: f64,
    /// How the result is printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Found {
    linear_density: f64,
    error: f64,
    unit: &'static str,
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let found = linear_density(
        Measured { value: settings.mass, error: settings.mass_error },
        Measured { value: settings.length, error: settings.length_error },
    )?;
    questions::ask(plausible::linear_density(found.value));
    let found = Found { linear_density: found.value, error: found.error, unit: "kg/m" };
    let text = |found: &Found| println!("{:.6} kg/m +- {:.6} kg/m", found.linear_density, found.error);
    Ok(settings.format.print(&found, text)?)
}
