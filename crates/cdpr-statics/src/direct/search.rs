//! Direct elasto-geometrical model (DEGM): the pose for given unstrained lengths.

use crate::direct::continuation::{Loss, LossKind, Path, Setting, follow_from};
use crate::direct::newton::newton;
use crate::direct::solution::{DirectSolution, Method, Report, descend, solution};
use crate::direct::stability::Stability;
use crate::direct::trust_region::cables_at;
use crate::error::StaticsError;
use crate::model::Model;
use crate::state::{Equilibrium, Load};
use cdpr_robot::{Matrix3, Pose, Robot, Rotation3, Vector3, Wrench};

/// Where the search begins.
#[derive(Clone, Copy, Debug)]
pub enum Start<'a> {
    /// At a pose; the cables are first brought into equilibrium there.
    Pose(&'a Pose),
    /// At a pose with cable forces that need not fit it: an equilibrium nearby.
    Near(&'a Equilibrium),
}

/// A stable equilibrium for the unstrained lengths `lengths` [m] and a load, near the start where Newton's method converges to
/// one, else downhill of the start. Without a moment the potential always has a minimum: the cables' elasticity bounds it from below.
///
/// # Errors
/// [`StaticsError::Invalid`] for lengths, loads or a start that are none; [`StaticsError::Overstrained`] where the equilibrium
/// strains a cable by more than 10 %; [`StaticsError::Indifferent`] where nothing determines the pose;
/// [`StaticsError::EquilibriumLost`] where none is found under the load's moment and the one without it disappears on the way;
/// [`StaticsError::DirectNotConverged`] with the last pose; [`StaticsError::Robot`] where it is the robot's values that are none.
/// The start is never returned as an answer.
pub fn direct(
    robot: &Robot,
    lengths: &[f64],
    load: &Load,
    start: Start,
) -> Result<DirectSolution, StaticsError> {
    search(&Model::new(robot, lengths, load)?, start, Stability::is_stable)
}

/// As [`direct`], but an unstable equilibrium is an answer, too, where Newton's method converges to one: a platform that balances like
/// a pendulum upside down.
///
/// # Errors
/// As [`direct`].
pub fn direct_any(
    robot: &Robot,
    lengths: &[f64],
    load: &Load,
    start: Start,
) -> Result<DirectSolution, StaticsError> {
    search(&Model::new(robot, lengths, load)?, start, |_| true)
}

/// A level pose to start from where none is known: where straight cables of these lengths [m] would hold a point. With `d_i` the exit
/// points from their middle and q the point from there, `L_i² = |d_i|² - 2 d_i·q + |q|²`; the differences of these equations, by
/// least squares, give q in the space that the exit points span, their mean what is left of |q|, taken downwards.
pub fn rough_pose(robot: &Robot, lengths: &[f64]) -> Pose {
    let n = robot.cables.len() as f64;
    let middle = robot.cables.iter().map(|cable| cable.exit_point).sum::<Vector3<f64>>() / n;
    let (mut scatter, mut moment, mut mean) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
    for (cable, length) in robot.cables.iter().zip(lengths) {
        let d = cable.exit_point - middle;
        let excess = length * length - d.norm_squared();
        scatter += d * d.transpose();
        moment += d * excess;
        mean += excess / n;
    }
    // Survey errors of exit points in one plane span no space.
    let inverse = scatter.pseudo_inverse(0.01 * scatter.trace()).unwrap_or_else(|_| Matrix3::zeros());
    let q = -0.5 * inverse * moment;
    let depth = (mean - q.norm_squared()).max(0.0).sqrt();
    Pose { position: middle + q - Vector3::z() * depth, rotation: Rotation3::identity() }
}

fn search(
    model: &Model,
    start: Start,
    accepted: impl Fn(&Stability) -> bool,
) -> Result<DirectSolution, StaticsError> {
    let start = checked(model, start)?;
    let pose = start.pose;
    match newton(model, start) {
        // A strained equilibrium far from the start need not be the one downhill.
        Some(converged) if accepted(&converged.stability) => {
            solution(model, converged, Method::Newton).or_else(|_| settle(model, &pose))
        }
        _ => settle(model, &pose),
    }
}

/// The start as a state of the model.
fn checked(model: &Model, start: Start) -> Result<Equilibrium, StaticsError> {
    let invalid = |field: &str, value: String, expected: String| {
        Err(StaticsError::Invalid { field: field.to_owned(), value, expected })
    };
    let pose = match start {
        Start::Pose(pose) => pose,
        Start::Near(equilibrium) => &equilibrium.pose,
    };
    if !pose.is_finite() {
        return invalid("start", format!("{:?}", pose.position.as_slice()), "a finite pose".to_owned());
    }
    match start {
        Start::Pose(pose) => cables_at(model, pose),
        Start::Near(equilibrium) if equilibrium.cable_forces.len() == model.cables() => {
            match equilibrium
                .cable_forces
                .iter()
                .position(|force| !(force.x.is_finite() && force.y.is_finite()))
            {
                None => Ok(equilibrium.clone()),
                Some(i) => invalid(
                    &format!("start.cable_forces[{i}]"),
                    format!("{:?}", equilibrium.cable_forces[i].as_slice()),
                    "finite components [N]".to_owned(),
                ),
            }
        }
        Start::Near(equilibrium) => invalid(
            "start.cable_forces",
            format!("a list of {}", equilibrium.cable_forces.len()),
            format!("one force for each of the {} cables", model.cables()),
        ),
    }
}

/// The stable equilibrium downhill of a pose. A moment has no potential: where it keeps the descent from ending, the equilibrium
/// without it is followed while the moment is raised.
fn settle(model: &Model, pose: &Pose) -> Result<DirectSolution, StaticsError> {
    let error = match descend(model, pose) {
        Err(error @ StaticsError::DirectNotConverged { .. }) => error,
        outcome => return outcome,
    };
    // Fields are public: what looks like a hard problem may be a robot that is none.
    model.robot.validate()?;
    let wrench = model.load.wrench;
    if wrench.moment == Vector3::zeros() {
        return Err(error);
    }
    let resting = Load { wrench: Wrench { moment: Vector3::zeros(), ..wrench }, ..*model.load };
    let without = Model { load: &resting, ..*model };
    let Ok(first) = descend(&without, pose) else { return Err(error) };
    let [from, to] =
        [&resting, model.load].map(|load| Setting { lengths: model.lengths.to_vec(), load: *load });
    let Path { mut steps, lost } = follow_from(model.robot, &from, &to, first)?;
    let iterations = steps.iter().map(|step| step.solution.report.iterations).sum();
    match (steps.pop(), lost) {
        (Some(last), None) => {
            let mut solution = last.solution;
            solution.report = Report { method: Method::Continuation, iterations, ..solution.report };
            Ok(solution)
        }
        (_, Some(Loss { kind: LossKind::Overstrained, after: Err(error), .. })) => Err(error),
        (_, Some(Loss { kind: LossKind::StepLimit, .. })) => Err(error),
        (_, Some(loss)) => Err(StaticsError::EquilibriumLost {
            share: loss.share,
            least_stiffness: loss.before.stability.least_stiffness(),
            pose: Box::new(loss.before.equilibrium.pose),
        }),
        (None, None) => Err(error),
    }
}
