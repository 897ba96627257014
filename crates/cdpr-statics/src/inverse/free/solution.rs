//! Solutions of the inverse model with free coordinates, as plain data.

use crate::direct::Stability;
use crate::error::StaticsError;
use crate::inverse::InverseSolution;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Residual};
use cdpr_robot::{Robot, Vector6};

/// Lengths with which the platform rests where some coordinates are those of a wanted pose.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeSolution {
    /// Unstrained length of every cable [m].
    pub lengths: Vec<f64>,
    /// Tension of every cable at the platform [N].
    pub tensions: Vec<f64>,
    /// The pose with the cables' forces.
    pub equilibrium: Equilibrium,
    /// Whether the platform stays there with these lengths.
    pub stability: Stability,
    /// Residuals of all equations.
    pub residual: Residual,
    /// Iterations of the search that found it.
    pub iterations: usize,
}

/// The solutions that were found.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeSolutions {
    /// The nearest to the given pose of the stable ones whose cables are taut; if none was found, the nearest
    /// of the stable ones. An unstable one is first only where no stable one was found, in or out of the
    /// limits, and if the platform is not turned over. All tensions are within their limits, no cable is a
    /// loop and none is below the ground.
    pub first: FreeSolution,
    /// The others, in the same order; those with tensions out of their limits and unstable ones that are
    /// turned over come last.
    pub others: Vec<FreeSolution>,
}

impl From<FreeSolution> for InverseSolution {
    fn from(found: FreeSolution) -> Self {
        let FreeSolution { lengths, tensions, equilibrium, residual, iterations, .. } = found;
        let active = vec![None; lengths.len()];
        let (multipliers, stationarity) = (Vector6::zeros(), 0.0);
        Self { lengths, tensions, active, multipliers, equilibrium, iterations, stationarity, residual }
    }
}

impl FreeSolution {
    pub(super) fn new(
        robot: &Robot,
        load: &Load,
        lengths: Vec<f64>,
        equilibrium: Equilibrium,
        iterations: usize,
    ) -> Result<Self, StaticsError> {
        let problem = DirectProblem::new(robot, &lengths, load)?;
        let hessian = problem.linearize(&equilibrium)?.symmetric_stiffness();
        Ok(Self {
            tensions: equilibrium.tensions(),
            stability: Stability::new(&problem, &equilibrium, &hessian),
            residual: Residual::of(&problem, &equilibrium),
            lengths,
            equilibrium,
            iterations,
        })
    }
}
