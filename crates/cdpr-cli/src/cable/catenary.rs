//! `cdpr catenary`: one cable between two points, from two of its length, end, force and tension.

use crate::answer::vector;
use crate::arguments::{self, Format};
use crate::error::ProgramError;
use crate::questions;
use cdpr_cable::{Cable, Known, Vector2};
use cdpr_robot::plausible;
use serde::Serialize;

/// The cable and what is known of it.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Weight per unstrained length [N/m]; 0 makes the cable a straight spring.
    #[arg(long, value_parser = arguments::number, allow_hyphen_values = true)]
    weight: f64,
    /// Axial stiffness EA [N].
    #[arg(long, value_parser = arguments::number, allow_hyphen_values = true)]
    stiffness: f64,
    /// Unstrained length [m].
    #[arg(long, value_parser = arguments::number, allow_hyphen_values = true)]
    length: Option<f64>,
    /// Position x,z of the anchor point [m]; the exit point is the origin, x >= 0, z up.
    #[arg(long, value_parser = arguments::components::<2>, allow_hyphen_values = true)]
    end: Option<[f64; 2]>,
    /// Force fx,fz on the cable at the anchor point [N], with --length, in place of --end.
    #[arg(long, value_parser = arguments::components::<2>, allow_hyphen_values = true)]
    force: Option<[f64; 2]>,
    /// Tension at the anchor point [N], with --end, in place of --length.
    #[arg(long, value_parser = arguments::number, allow_hyphen_values = true)]
    tension: Option<f64>,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let Settings { weight, stiffness, length, end, .. } = settings;
    let chord = end.map(|[x, z]| x.hypot(z));
    questions::ask(plausible::span(*weight, *stiffness, *length, chord));
    let answer = Answer::new(settings)?;
    Ok(settings.format.print(&answer, Answer::print)?)
}

/// The cable in equilibrium, in SI units.
#[derive(Serialize)]
struct Answer {
    /// Force on the cable at the anchor point.
    force: [f64; 2],
    tension: Tension,
    /// Greatest height of the chord above the cable [m].
    sag: f64,
    /// Elastic energy plus potential energy of the weight, which is zero at the height of the exit point [J].
    energy: f64,
    unstrained_length: f64,
    end: [f64; 2],
    /// Distance between the given end and the end of the catenary [m].
    residual: f64,
}

#[derive(Serialize)]
struct Tension {
    anchor: f64,
    exit: f64,
}

impl Answer {
    fn new(settings: &Settings) -> Result<Self, ProgramError> {
        let Settings { weight, stiffness, length, end, force, tension, .. } = *settings;
        let cable = Cable::linear(weight, stiffness);
        let [end, force] = [end, force].map(|vector| vector.map(Vector2::from));
        let known = Known::from_given(length, end, force, tension).ok_or_else(|| {
            let expected = "--length and --end, --length and --force, or --end and --tension";
            ProgramError::Usage(format!("expected two of what is known: {expected}"))
        })?;
        let solution = known.solve(&cable)?;
        let catenary = &solution.catenary;
        Ok(Self {
            force: catenary.force.into(),
            tension: Tension { anchor: catenary.anchor_tension(), exit: catenary.exit_tension() },
            sag: catenary.vertical_sag(),
            energy: catenary.potential_energy(),
            unstrained_length: catenary.unstrained_length,
            end: solution.end.into(),
            residual: solution.residual,
        })
    }

    fn print(&self) {
        println!("unstrained length  {:.6} m", self.unstrained_length);
        println!("anchor point       {} m from the exit point", vector(&self.end, 6));
        println!("force at it        {} N on the cable", vector(&self.force, 6));
        println!("tension            {:.6} N at the anchor point", self.tension.anchor);
        println!("                   {:.6} N at the exit point", self.tension.exit);
        println!("sag                {:.6} m below the chord", self.sag);
        println!("energy             {:.6} J", self.energy);
    }
}
