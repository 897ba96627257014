//! The solution of the equations of motion by the method that serves.

use super::collocation::{Collocation, Method, Stalled, Work};
use super::midpoint::{Midpoint, Spent};
use super::system::{Snapshot, System};

/// First step after a change [s].
const FIRST_STEP: f64 = 1e-5;

/// A solution in progress.
pub(super) enum Solver<'a> {
    /// For smooth motions.
    Implicit(Box<Collocation<System<'a>>>),
    /// For slack cables.
    Midpoint(Box<Midpoint>),
}

impl<'a> Solver<'a> {
    /// The solution from a state on; `is_slack` says whether a cable is or was slack.
    pub(super) fn new(system: &System<'a>, time: f64, state: Vec<f64>, is_slack: bool) -> Self {
        let midpoint = if is_slack { Midpoint::new(system, time, &state) } else { None };
        let method = if system.is_damped() { &Method::RADAU } else { &Method::GAUSS };
        midpoint.map_or_else(
            || Self::Implicit(Box::new(Collocation::new(method, system, time, state, FIRST_STEP))),
            |midpoint| Self::Midpoint(Box::new(midpoint)),
        )
    }

    pub(super) fn state(&self) -> &[f64] {
        match self {
            Self::Implicit(steps) => &steps.state,
            Self::Midpoint(midpoint) => &midpoint.state,
        }
    }

    pub(super) fn time(&self) -> f64 {
        match self {
            Self::Implicit(steps) => steps.time,
            Self::Midpoint(midpoint) => midpoint.time,
        }
    }

    /// The time without the rounding of steps.
    pub(super) fn set_time(&mut self, time: f64) {
        match self {
            Self::Implicit(steps) => steps.time = time,
            Self::Midpoint(midpoint) => midpoint.time = time,
        }
    }

    pub(super) fn work(&self) -> Work {
        match self {
            Self::Implicit(steps) => steps.work,
            Self::Midpoint(midpoint) => midpoint.work,
        }
    }

    /// The system now.
    pub(super) fn snapshot(&self, system: &System) -> Snapshot {
        system.snapshot(self.time(), self.state())
    }

    /// The system now, or within the last step.
    pub(super) fn last_snapshot(&self) -> &Snapshot {
        match self {
            Self::Implicit(steps) => &steps.memories[3],
            Self::Midpoint(midpoint) => &midpoint.at,
        }
    }

    /// One step, not beyond `until` [s].
    pub(super) fn advance(&mut self, system: &mut System<'a>, until: f64) -> Result<Spent, Stalled> {
        let steps = match self {
            Self::Implicit(steps) => steps,
            Self::Midpoint(midpoint) => return midpoint.advance(system, until),
        };
        let step = steps.advance(system, until)?;
        let mut spent = Spent::default();
        // Snapshots of the stages are those before the last change of Newton's method.
        let times = steps.method.stages.map(|share| steps.time + (share - 1.0) * step.length);
        let looks = times.iter().any(|time| system.has_power(*time));
        for ((state, at), time) in step.stages.iter().zip(&mut steps.memories).zip(times) {
            if looks {
                system.look(time, state, at);
            }
        }
        for ((weight, state), at) in steps.method.weights.iter().zip(&step.stages).zip(&steps.memories) {
            let [given, lost] = system.powers(at, state);
            spent.given += weight * step.length * given;
            spent.lost += weight * step.length * lost;
            spent.kinetic = spent.kinetic.max(system.kinetic(at, state));
        }
        system.turn(&mut steps.state);
        Ok(spent)
    }
}
