//! An equilibrium as an answer, with the report of how it was found.

use crate::direct::newton::Converged;
use crate::direct::stability::Stability;
use crate::direct::trust_region::minimise;
use crate::error::StaticsError;
use crate::model::Model;
use crate::state::{Equilibrium, Residual};
use cdpr_robot::Pose;

/// How an equilibrium was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Newton's method on the `6 + 2n` equations.
    Newton,
    /// Trust region on the potential, ended by Newton's method.
    TrustRegion,
    /// The equilibrium without the load's moment, followed while the moment was raised.
    Continuation,
}

/// How an answer was found and how good it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The method that found it.
    pub method: Method,
    /// Iterations made by that method.
    pub iterations: usize,
    /// Residuals of all equations.
    pub residual: Residual,
    /// Cables (from 0) whose unstrained length exceeds the distance of their points: they carry little but their own weight.
    pub slack: Vec<usize>,
}

/// An equilibrium of the platform.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectSolution {
    /// Pose and cable forces.
    pub equilibrium: Equilibrium,
    /// How it was found, with residuals.
    pub report: Report,
    /// Whether it holds, and how far it is from losing hold.
    pub stability: Stability,
}

/// A strain beyond which a linear, small-strain cable describes nothing: steel and fibre ropes break at less.
pub(crate) const MAX_STRAIN: f64 = 0.1;

/// The minimum of the potential downhill of a pose.
pub(crate) fn descend(model: &Model, pose: &Pose) -> Result<DirectSolution, StaticsError> {
    solution(model, minimise(model, pose)?, Method::TrustRegion)
}

pub(crate) fn solution(
    model: &Model,
    converged: Converged,
    method: Method,
) -> Result<DirectSolution, StaticsError> {
    let Converged { equilibrium, iterations, residual, stability, .. } = converged;
    let mut slack = Vec::new();
    for (i, force) in equilibrium.cable_forces.iter().enumerate() {
        let (length, chord) = (model.lengths[i], model.span(&equilibrium.pose, i).end.norm());
        let catenary = model.catenary(i, *force);
        let tension = catenary.anchor_tension().max(catenary.exit_tension());
        let strain = model.cable(i).strain(tension);
        if strain > MAX_STRAIN {
            return Err(StaticsError::Overstrained { index: i, length, distance: chord, strain });
        }
        if length >= chord {
            slack.push(i);
        }
    }
    Ok(DirectSolution { equilibrium, report: Report { method, iterations, residual, slack }, stability })
}
