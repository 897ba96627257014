//! Motion over time, with the mass, sag and elasticity of the cables.

mod band;
mod cable;
mod change;
mod event;
mod lead;
mod mesh;
mod radau;
mod run;
mod setting;
mod system;
mod winch;

pub use event::{Change, CutAt, Event, events_from_json, events_schema};
pub use radau::Work;
pub use run::{Command, Control, Difference, Energy, Sample, Series};
pub use setting::{Discretization, Settings};
pub use winch::{Profile, WinchLengths};

use crate::error::DynamicsError;
use cdpr_robot::Wrench;
use cdpr_statics::{DirectProblem, Equilibrium};
use run::{Wanted, run};

/// The motion of a robot from rest under events.
///
/// It is computed twice, with [`Settings::discretization`] and with a coarser one: their differences are in
/// [`Series::difference`].
///
/// # Errors
/// [`DynamicsError::Invalid`] for settings and events that are not possible; [`DynamicsError::Stalled`] where no
/// step is short enough; those of [`DirectProblem::small_motions`].
pub fn simulate(
    problem: &DirectProblem,
    rest: &Equilibrium,
    events: &[Event],
    settings: &Settings,
) -> Result<Series, DynamicsError> {
    simulate_controlled(problem, rest, events, settings, &|_| Command::Wrench(Wrench::none()))
}

/// As [`simulate`], with a control that is called at each sample and decides what acts until the next one.
///
/// # Errors
/// As [`simulate`].
pub fn simulate_controlled(
    problem: &DirectProblem,
    rest: &Equilibrium,
    events: &[Event],
    settings: &Settings,
    control: &Control,
) -> Result<Series, DynamicsError> {
    settings.check()?;
    event::check(problem, events)?;
    let wanted = Wanted { problem, rest, events, settings, control };
    let coarse = Settings { tolerance: 4.0 * settings.tolerance, ..*settings };
    let (taut, slack) = match settings.discretization {
        Some(discretization) => (discretization, None),
        None => (Discretization::TAUT, Some(Discretization::SLACK)),
    };
    let (fine, coarse) = rayon::join(
        || run(wanted, (taut, slack)),
        || {
            let coarser = (taut.coarser(), slack.map(Discretization::coarser));
            run(Wanted { settings: &coarse, ..wanted }, coarser)
        },
    );
    let (fine, coarse) = (fine?, coarse?);
    Ok(Series { difference: fine.difference_to(&coarse), ..fine })
}
