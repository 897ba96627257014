//! Direct elasto-geometrical model (DEGM): the pose for given unstrained lengths.

use crate::equations::residual;
use crate::error::StaticsError;
use crate::model::{Equilibrium, Load, Model};
use crate::newton::{Converged, newton};
use crate::trust_region::{cables_at, minimise};
use cdpr_robot::{Pose, Robot, Vector2};

/// Where the search begins.
#[derive(Clone, Copy, Debug)]
pub enum Start<'a> {
    /// At a pose; the cables are first brought into equilibrium there.
    Pose(&'a Pose),
    /// At a pose with cable forces that need not fit it: an equilibrium nearby.
    Near(&'a Equilibrium),
}

/// How an equilibrium was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Newton's method on the `6 + 2n` equations.
    Newton,
    /// Trust region on the potential, ended by Newton's method.
    TrustRegion,
}

/// What stays open in the original `6 + 2n` equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// Largest distance between the end of a cable and its anchor point [m].
    pub closure: f64,
    /// Open force on the platform [N].
    pub force: f64,
    /// Open moment about P [N m].
    pub moment: f64,
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

/// A stable equilibrium of the platform.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectSolution {
    /// Pose and cable forces.
    pub equilibrium: Equilibrium,
    /// How it was found, with residuals.
    pub report: Report,
}

/// A stable equilibrium for the unstrained lengths `lengths` [m] and a load, near the start where Newton's method converges,
/// else downhill of it.
///
/// # Errors
/// [`StaticsError::Invalid`] for lengths, loads or a start that are none; [`StaticsError::DirectNotConverged`] with the best
/// pose found. The start is never returned as an answer.
pub fn direct(
    robot: &Robot,
    lengths: &[f64],
    load: &Load,
    start: Start,
) -> Result<DirectSolution, StaticsError> {
    let model = Model::new(robot, lengths, load)?;
    let pose = match start {
        Start::Pose(pose) => pose,
        Start::Near(equilibrium) => &equilibrium.pose,
    };
    if let Start::Near(Equilibrium { cable_forces, .. }) = start
        && cable_forces.len() != model.cables()
    {
        return Err(StaticsError::Invalid {
            field: "start.cable_forces".to_owned(),
            value: format!("a list of {}", cable_forces.len()),
            expected: format!("one force for each of the {} cables", model.cables()),
        });
    }
    if !pose.is_finite() {
        return Err(StaticsError::Invalid {
            field: "start".to_owned(),
            value: format!("{:?}", pose.position.as_slice()),
            expected: "a finite pose".to_owned(),
        });
    }
    let equilibrium = match start {
        Start::Near(equilibrium) => equilibrium.clone(),
        Start::Pose(pose) => cables_at(&model, pose)?,
    };
    if let Some(converged) = newton(&model, equilibrium) {
        return Ok(solution(&model, converged, Method::Newton));
    }
    Ok(solution(&model, minimise(&model, pose)?, Method::TrustRegion))
}

fn solution(model: &Model, converged: Converged, method: Method) -> DirectSolution {
    let Converged { equilibrium, iterations, residual } = converged;
    let slack = (0..model.cables())
        .filter(|i| model.lengths[*i] >= model.span(&equilibrium.pose, *i).end.norm())
        .collect();
    DirectSolution { equilibrium, report: Report { method, iterations, residual, slack } }
}

impl Residual {
    pub(crate) fn of(model: &Model, equilibrium: &Equilibrium) -> Self {
        let r = residual(model, equilibrium);
        let closure = (0..model.cables()).map(|i| r.fixed_rows::<2>(6 + 2 * i).norm()).fold(0.0, f64::max);
        Self { closure, force: r.fixed_rows::<3>(0).norm(), moment: r.fixed_rows::<3>(3).norm() }
    }

    /// Whether what is open is explained by rounding: the closure by that of lengths and coordinates, the wrench by that of
    /// the tensions and the load.
    pub(crate) fn is_rounding(&self, model: &Model, equilibrium: &Equilibrium) -> bool {
        let tensions: f64 = equilibrium.cable_forces.iter().map(Vector2::norm).sum();
        let load = model.load.total(model.robot, &equilibrium.pose);
        let forces = tensions + load.force.norm() + load.moment.norm() / model.arm();
        let far = |i: usize| equilibrium.pose.position.norm() + model.robot.cables[i].exit_point.norm();
        let coordinates = (0..model.cables()).map(far).fold(0.0, f64::max);
        self.closure <= 1e-13 * model.size() + 4.0 * f64::EPSILON * coordinates
            && self.force + self.moment / model.arm() <= 1e-12 * forces
    }
}
