//! `cdpr cable density`: the mass per length of a cable from a weighing.

use crate::program::arguments::{Named, Printing, named, number};
use crate::program::error::ProgramError;
use crate::program::questions;
use cdpr_cable::{Measured, linear_density};
use cdpr_robot::{plausible, visible};
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
    /// Greatest errors: mass=0.001,length=0.001 [kg, m]; without error if left out.
    #[arg(long, value_parser = named, default_value = "mass=0")]
    errors: Named,
    #[command(flatten)]
    printing: Printing,
}

#[derive(Serialize)]
struct Found {
    #[serde(rename = "linear_density_kg_per_m")]
    linear_density: f64,
    #[serde(rename = "error_kg_per_m")]
    error: f64,
}

pub(super) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let [mass, length] = settings.errors.all("--errors", ["mass", "length"])?.map(Option::unwrap_or_default);
    let found = linear_density(
        Measured { value: settings.mass, error: mass },
        Measured { value: settings.length, error: length },
    )?;
    questions::ask(plausible::linear_density(found.value));
    let found = Found { linear_density: found.value, error: found.error };
    let text = |found: &Found| match found.error {
        // Without errors nothing bounds the density.
        0.0 => println!("{} kg/m", visible(found.linear_density, 6)),
        error => println!("{} kg/m +- {} kg/m", visible(found.linear_density, 6), visible(error, 6)),
    };
    Ok(settings.printing.format().print(&found, text)?)
}
