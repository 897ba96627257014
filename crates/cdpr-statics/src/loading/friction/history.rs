//! Equilibria whose wheels remember the tension of their winches.

use super::wheel::{PulleyFriction, PulleyState};
use crate::direct::{DirectSolution, DirectStart};
use crate::error::StaticsError;
use crate::problem::{DirectProblem, Unstable};
use crate::state::{Equilibrium, Load};
use cdpr_robot::Robot;
use nalgebra::{DMatrix, DVector};

/// Iterations of the lengths that friction changes.
const MAX_ITERATIONS: usize = 100;

/// Change of a length over the longest one at which the iteration ends.
const SAME_LENGTH: f64 = 4.0 * f64::EPSILON;

/// The same where rounding of the tensions lets it become no smaller.
const NEAR_LENGTH: f64 = 1e-12;

/// The pulleys of a robot along a load history.
#[derive(Debug)]
pub(crate) struct Wheels {
    friction: PulleyFriction,
    /// Approximation of `-dx/dF` for the lengths x = Δ and their residual F, by Broyden's updates.
    inverse: DMatrix<f64>,
}

impl Wheels {
    /// Those of a robot; `None` without friction.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for coefficients that are out of their ranges, and for a robot without
    /// pulleys.
    pub(crate) fn new(robot: &Robot, friction: PulleyFriction) -> Result<Option<Self>, StaticsError> {
        friction.validate()?;
        if friction.is_none() { Ok(None) } else { Self::on_pulleys(robot, friction).map(Some) }
    }

    /// Those of a robot, also without friction.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a robot without pulleys.
    pub(crate) fn on_pulleys(robot: &Robot, friction: PulleyFriction) -> Result<Self, StaticsError> {
        let wheels = robot.cables.iter().filter_map(|cable| cable.pulley);
        if wheels.filter(|pulley| pulley.radius > 0.0).count() == 0 {
            let (field, value) = match friction {
                PulleyFriction { friction, .. } if friction > 0.0 => ("friction", friction),
                PulleyFriction { bearing, .. } => ("bearing", bearing),
            };
            let expected =
                "zero for a robot without pulleys, or a `pulley` of one of its cables with a radius";
            return Err(StaticsError::invalid(field.to_owned(), value, expected));
        }
        let n = robot.cables.len();
        Ok(Self { friction, inverse: DMatrix::identity(n, n) })
    }

    /// The pulleys before a history: no slip, and the same tension on both sides.
    pub(crate) fn begin(
        &self,
        robot: &Robot,
        lengths: &[f64],
        equilibrium: &Equilibrium,
    ) -> Result<Vec<PulleyState>, StaticsError> {
        self.states(robot, lengths, equilibrium, None)
    }

    /// The equilibrium with friction near `found`, which has the lengths of the states `before`: the next one
    /// of a history. `lengths` [m] are those at the winches.
    pub(crate) fn next(
        &mut self,
        robot: &Robot,
        lengths: &[f64],
        load: &Load,
        mut found: DirectSolution,
        before: &[PulleyState],
    ) -> Result<(DirectSolution, Vec<PulleyState>), StaticsError> {
        let size = lengths.iter().copied().fold(0.0, f64::max);
        let mut longer = DVector::from_iterator(before.len(), before.iter().map(|state| state.longer));
        let mut last: Option<[DVector<f64>; 2]> = None;
        for _ in 0..MAX_ITERATIONS {
            let free: Vec<f64> = lengths.iter().zip(&longer).map(|(length, more)| length + more).collect();
            if last.is_some() {
                let problem = DirectProblem::new(robot, &free, load)?.with_unstable(Unstable::Refused);
                found = problem.direct(DirectStart::Near(&found.equilibrium))?;
            }
            let states = self.states(robot, &free, &found.equilibrium, Some(before))?;
            let open = DVector::from_fn(before.len(), |i, _| states[i].longer - longer[i]);
            let is_stalled = last.as_ref().is_some_and(|[_, last]| open.amax() > 0.5 * last.amax());
            if open.amax() <= SAME_LENGTH * size || is_stalled && open.amax() <= NEAR_LENGTH * size {
                return Ok((found, states));
            }
            if let Some([step, last]) = last {
                self.update(&step, &(&open - last));
            }
            let step = &self.inverse * &open;
            longer += &step;
            last = Some([step, open]);
        }
        let pose = Box::new(found.equilibrium.pose);
        let residual = found.report.residual;
        Err(StaticsError::DirectNotConverged { iterations: MAX_ITERATIONS, pose, residual })
    }

    /// Broyden's update (C. G. Broyden, *A class of methods for solving nonlinear simultaneous equations*,
    /// Mathematics of Computation 19, 1965) for a step that has changed the residual by `change`.
    fn update(&mut self, step: &DVector<f64>, change: &DVector<f64>) {
        let seen = &self.inverse * change;
        let along = step.dot(&seen);
        if along.abs() > 1e-3 * step.norm_squared() {
            let row = step.transpose() * &self.inverse;
            self.inverse -= (step + seen) * row / along;
        }
    }

    fn states(
        &self,
        robot: &Robot,
        lengths: &[f64],
        equilibrium: &Equilibrium,
        before: Option<&[PulleyState]>,
    ) -> Result<Vec<PulleyState>, StaticsError> {
        let problem = DirectProblem::new(robot, lengths, &Load::none())?;
        let forces = equilibrium.cable_forces.iter().enumerate();
        let states = forces.map(|(i, force)| {
            let catenary = problem.catenary_at(&equilibrium.pose, i, *force);
            self.friction.state(&catenary, before.map(|before| before[i].winch_tension))
        });
        Ok(states.collect())
    }
}
