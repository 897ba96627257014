//! Motion over time, with the mass, sag and elasticity of the cables.

mod band;
mod cable;
mod change;
mod collocation;
mod event;
mod lead;
mod links;
mod matrices;
mod mesh;
mod midpoint;
mod run;
mod series;
mod setting;
mod solver;
mod system;
mod winch;

pub use collocation::Work;
pub use event::{Change, CutAt, Event, events_from_json, events_schema};
pub use run::{Command, Control};
pub use setting::{Discretization, Settings};
pub use winch::{Profile, WinchLengths};

use crate::error::DynamicsError;
use cdpr_robot::Wrench;
use cdpr_statics::{DirectProblem, Equilibrium};
use run::{Wanted, begin};
pub use series::{Difference, Energy, Excursion, Sample, Series};

/// The motion of a robot from rest under events.
///
/// It is computed twice, with [`Settings::discretization`] and with a coarser one: their differences are in
/// `Series::difference`. Without it, it is computed with finer ones until two of them agree.
///
/// # Errors
/// [`DynamicsError::Invalid`] for settings and events that are not possible; [`DynamicsError::Stalled`] where
/// no step is short enough; those of [`DirectProblem::small_motions`].
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
    let start = |elements, tolerance| {
        begin(
            Wanted { problem, rest, events, settings: Settings { tolerance, ..*settings }, control },
            elements,
        )
    };
    let (tolerance, coarse) = (settings.tolerance, 4.0 * settings.tolerance);
    let chain = |place: usize| Some(Discretization::chain(CHAINS[place]));
    let (elements, coarser) = match settings.discretization {
        None => ((Discretization::TAUT, chain(1)), (Discretization::TAUT.coarser(), chain(0))),
        Some(elements) => [elements, elements.coarser()].map(|own| (own, own.of_slack())).into(),
    };
    let both = |elements: (Discretization, Option<Discretization>), tolerance| {
        let begun = start(elements, tolerance)?;
        let series = begun.end(elements.1)?;
        Ok::<_, DynamicsError>((begun, series))
    };
    let (fine, coarse) = rayon::join(|| both(elements, tolerance), || both(coarser, coarse));
    let ((mut begun, mut fine), (_, coarse)) = (fine?, coarse?);
    fine.difference = fine.difference_to(&coarse);
    let size = problem.robot().platform_size();
    let away = |by: &Difference| by.position.max(size * by.rotation);
    let is_chosen = settings.discretization.is_some();
    let has_chain =
        |series: &Series, elements| series.discretizations.contains(&Discretization::chain(elements));
    for elements in FINER {
        if is_chosen || has_chain(&fine, CHAINS[1]) || away(&fine.difference) <= ENOUGH_TAUT {
            break;
        }
        let taut = Discretization { elements, ..Discretization::TAUT };
        let finer;
        (begun, finer) = both((taut, Some(Discretization::chain(CHAINS[1]))), tolerance)?;
        fine = Series { difference: finer.difference_to(&fine), ..finer };
    }
    for pair in CHAINS[1..].windows(2) {
        let enough = (ENOUGH[0] * away(&fine.motion())).max(ENOUGH[1]);
        if is_chosen || !has_chain(&fine, pair[0]) || away(&fine.difference) <= enough {
            break;
        }
        let finer = begun.end(Some(Discretization::chain(pair[1])))?;
        fine = Series { difference: finer.difference_to(&fine), ..finer };
    }
    Ok(fine)
}

/// Elements of taut cables that are tried in turn after [`Discretization::TAUT`].
const FINER: [usize; 3] = [6, 12, 24];

/// They are fine enough where a coarser computation moves the platform otherwise by this length [m]: it errs
/// ten times as much and more.
const ENOUGH_TAUT: f64 = 1e-4;

/// Elements of the chains that are tried in turn.
const CHAINS: [usize; 4] = [10, 20, 40, 80];

/// Chains are fine enough where those of half as many elements move the platform otherwise by this share of
/// its motion, or by this length [m].
const ENOUGH: [f64; 2] = [2e-3, 3e-4];
