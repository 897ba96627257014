//! `cdpr cable catenary`: one cable between two points, from two of its length, end, force and tension.

use crate::program::answer::vector;
use crate::program::arguments::{self, Named, Printing, named};
use crate::program::error::ProgramError;
use crate::program::questions;
use cdpr_cable::{Cable, Known, Vector2};
use cdpr_robot::{Doubt, Gravity, plausible, visible};
use cdpr_study::open_cable;
use serde::Serialize;
use std::path::Path;

/// The cable and what is known of it.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Cable: a name of `cdpr robot list` or a cable file (JSON, `cdpr-cable/1`) under 9.80665 m/s², or
    /// weight and axial stiffness EA, weight=0.9957,stiffness=1.28e6 [N/m, N]; without weight it is a
    /// straight spring.
    cable: String,
    /// Unstrained length [m].
    #[arg(long, value_parser = arguments::number, allow_hyphen_values = true)]
    length: Option<f64>,
    /// Position x,z of the anchor point [m]; the exit point is the origin, x >= 0, z up.
    #[arg(long, value_parser = arguments::components::<2>, allow_hyphen_values = true)]
    end: Option<[f64; 2]>,
    /// Force fx,fz on the cable at the anchor point [N], with --length, instead of --end.
    #[arg(long, value_parser = arguments::components::<2>, allow_hyphen_values = true)]
    end_force: Option<[f64; 2]>,
    /// Tension at the anchor point [N], with --end, instead of --length.
    #[arg(long, value_parser = arguments::number, allow_hyphen_values = true)]
    tension: Option<f64>,
    #[command(flatten)]
    printing: Printing,
}

pub(super) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let chord = settings.end.map(|[x, z]| x.hypot(z));
    let ([weight, stiffness], breaking) = properties(&settings.cable)?;
    questions::ask(plausible::span(weight, stiffness, settings.length, chord));
    let answer = Answer::new(settings, &Cable::linear(weight, stiffness))?;
    let tension = answer.tension.anchor.max(answer.tension.exit);
    questions::ask(breaking.filter(|force| tension > *force).map(|force| Doubt {
        quantity: "tension".to_owned(),
        value: format!("{} N", visible(tension, 3)),
        why: format!("above the breaking force of the cable, {} N", visible(force, 3)),
        meant: "a smaller tension, or a stronger cable".to_owned(),
    }));
    Ok(settings.printing.format().print(&answer, Answer::print)?)
}

/// Weight per unstrained length [N/m] and axial stiffness [N], and the breaking force [N] if it is known.
fn properties(cable: &str) -> Result<([f64; 2], Option<f64>), ProgramError> {
    if !cable.contains('=') || Path::new(cable).exists() {
        let cable = open_cable(Path::new(cable))?.properties;
        let known = [cable.linear_density * Gravity::STANDARD, cable.axial_stiffness()];
        return Ok((known, cable.breaking_force));
    }
    let typed: Named = named(cable).map_err(|error| ProgramError::Usage(format!("{cable}: {error}")))?;
    let [weight, stiffness] = typed.all("the cable", ["weight", "stiffness"])?;
    let missing = || ProgramError::Usage(format!("{cable}: expected weight=N/m,stiffness=N"));
    Ok(([weight.unwrap_or_default(), stiffness.ok_or_else(missing)?], None))
}

/// The cable in equilibrium, in SI units.
#[derive(Serialize)]
struct Answer {
    /// Force on the cable at the anchor point.
    #[serde(rename = "force_n")]
    force: [f64; 2],
    tension: Tension,
    /// Greatest height of the chord above the cable [m]; `null` for a slack cable without weight, which has
    /// no shape.
    #[serde(rename = "sag_m")]
    sag: Option<f64>,
    /// Elastic energy plus potential energy of the weight, which is zero at the height of the exit point [J].
    #[serde(rename = "energy_j")]
    energy: f64,
    #[serde(rename = "unstrained_length_m")]
    unstrained_length: f64,
    #[serde(rename = "end_m")]
    end: [f64; 2],
    /// Distance between the given end and the end of the catenary [m].
    #[serde(rename = "residual_m")]
    residual: f64,
}

#[derive(Serialize)]
struct Tension {
    #[serde(rename = "anchor_n")]
    anchor: f64,
    #[serde(rename = "exit_n")]
    exit: f64,
}

impl Answer {
    fn new(settings: &Settings, cable: &Cable) -> Result<Self, ProgramError> {
        let Settings { length, end, end_force, tension, .. } = *settings;
        let [end, force] = [end, end_force].map(|vector| vector.map(Vector2::from));
        let known = Known::from_given(length, end, force, tension).ok_or_else(|| {
            let expected = "--length and --end, --length and --end-force, or --end and --tension";
            ProgramError::Usage(format!("expected two of what is known: {expected}"))
        })?;
        let solution = known.solve(cable)?;
        let catenary = &solution.catenary;
        Ok(Self {
            force: catenary.force.into(),
            tension: Tension { anchor: catenary.anchor_tension(), exit: catenary.exit_tension() },
            sag: (!catenary.is_slack_and_weightless()).then(|| catenary.vertical_sag()),
            energy: catenary.potential_energy(),
            unstrained_length: catenary.unstrained_length,
            end: solution.end.into(),
            residual: solution.residual,
        })
    }

    fn print(&self) {
        println!("unstrained length  {} m", visible(self.unstrained_length, 6));
        println!("anchor point       {} m from the exit point", vector(&self.end, 6));
        println!("force at it        {} N on the cable", vector(&self.force, 6));
        println!("tension            {} N at the anchor point", visible(self.tension.anchor, 6));
        println!("                   {} N at the exit point", visible(self.tension.exit, 6));
        match self.sag {
            Some(sag) => println!("sag                {} m below the chord", visible(sag, 6)),
            None => println!("sag                none: slack and without weight, it has no shape"),
        }
        println!("energy             {} J", visible(self.energy, 6));
    }
}
