//! An equilibrium as a solution, with the report of how it was found.

use crate::direct::newton::Converged;
use crate::direct::stability::Stability;
use crate::direct::trust_region::minimize;
use crate::equations::end;
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Residual};
use cdpr_robot::Pose;
use std::fmt;
use std::str::FromStr;

/// How an equilibrium was found; its name is `newton`, `trust_region` or `continuation`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirectMethod {
    /// Newton's method on the `6 + 2n` equations.
    Newton,
    /// Trust region on the potential, ended by Newton's method.
    TrustRegion,
    /// The equilibrium without the load's moment, followed while the moment was raised.
    Continuation,
}

impl fmt::Display for DirectMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Newton => "newton",
            Self::TrustRegion => "trust_region",
            Self::Continuation => "continuation",
        })
    }
}

impl FromStr for DirectMethod {
    type Err = StaticsError;

    fn from_str(name: &str) -> Result<Self, StaticsError> {
        let methods = [Self::Newton, Self::TrustRegion, Self::Continuation];
        methods.into_iter().find(|method| method.to_string() == name).ok_or_else(|| {
            StaticsError::invalid("method".to_owned(), name, "newton, trust_region or continuation")
        })
    }
}

/// How a solution was found and how good it is.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectReport {
    /// The method that found it.
    pub method: DirectMethod,
    /// Iterations made by that method.
    pub iterations: usize,
    /// Residuals of all equations.
    pub residual: Residual,
    /// Indices of the slack cables, which carry next to nothing but their own weight:
    /// [`cdpr_cable::SLACK_BELOW_OWN_WEIGHTS`].
    pub slack: Vec<usize>,
    /// Indices of the cables whose length at rest `L (1 + ε(0))` is at least the distance of their points.
    /// They sag, and a load may let the platform stand at several places, however much they carry.
    pub longer_than_chord: Vec<usize>,
}

/// An equilibrium of the platform.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectSolution {
    /// Pose and cable forces.
    pub equilibrium: Equilibrium,
    /// How it was found, with residuals.
    pub report: DirectReport,
    /// Whether it is stable, and how far it is from becoming unstable.
    pub stability: Stability,
}

/// The minimum of the potential downhill of a pose.
pub(crate) fn descend(problem: &DirectProblem, pose: &Pose) -> Result<DirectSolution, StaticsError> {
    solution(problem, minimize(problem, pose)?, DirectMethod::TrustRegion)
}

pub(crate) fn solution(
    problem: &DirectProblem,
    converged: Converged,
    method: DirectMethod,
) -> Result<DirectSolution, StaticsError> {
    let Converged { equilibrium, iterations, residual, stability, .. } = converged;
    problem.check_strains(&equilibrium)?;
    let (mut slack, mut longer_than_chord) = (Vec::new(), Vec::new());
    for (i, force) in equilibrium.cable_forces.iter().enumerate() {
        let cable = problem.cable(i);
        let span = end(problem.robot, &equilibrium.pose, i);
        let catenary = problem.catenary_at(&equilibrium.pose, i, *force);
        if catenary.is_slack() {
            slack.push(i);
        }
        if catenary.length_at_rest() >= cable.straight_length_in_space(span) {
            longer_than_chord.push(i);
        }
    }
    let report = DirectReport { method, iterations, residual, slack, longer_than_chord };
    Ok(DirectSolution { equilibrium, report, stability })
}

impl DirectProblem<'_> {
    /// Refuses forces that strain a cable by more than the models are valid for.
    ///
    /// # Errors
    /// [`StaticsError::Overstrained`] for the first such cable.
    pub(crate) fn check_strains(&self, equilibrium: &Equilibrium) -> Result<(), StaticsError> {
        for (index, force) in equilibrium.cable_forces.iter().enumerate() {
            let (cable, length) = (self.cable(index), self.lengths[index]);
            let catenary = self.catenary_at(&equilibrium.pose, index, *force);
            let tension = catenary.anchor_tension().max(catenary.exit_tension());
            if let Some(strain) = cable.overstrain(tension) {
                let span = end(self.robot, &equilibrium.pose, index);
                let distance = cable.straight_length_in_space(span);
                return Err(StaticsError::Overstrained { index, length, distance, strain });
            }
        }
        Ok(())
    }
}
