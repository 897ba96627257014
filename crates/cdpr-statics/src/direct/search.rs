//! Direct elasto-geometrical model (DEGM): the pose for given unstrained lengths.

use crate::direct::continuation::{Loss, LossKind, Setting, follow_from};
use crate::direct::newton::newton;
use crate::direct::solution::{DirectMethod, DirectSolution, descend, solution};
use crate::equations::{cables_at, to_base};
use crate::error::StaticsError;
use crate::problem::{DirectProblem, Unstable};
use crate::state::{Equilibrium, Load};
use cdpr_robot::{Matrix3, Pose, Robot, Rotation3, Vector3, Wrench};

/// Where the search starts.
#[derive(Clone, Copy, Debug)]
pub enum DirectStart<'a> {
    /// At a pose; the cables are first brought into equilibrium there.
    Pose(&'a Pose),
    /// At a pose with cable forces that need not fit it: an equilibrium nearby.
    Near(&'a Equilibrium),
    /// Released at rest at a pose: the stable equilibrium downhill of it, even where Newton's method would
    /// reach another one.
    Released(&'a Pose),
}

/// The stable equilibrium of a robot for unstrained lengths [m] and a load: [`DirectProblem::direct`] in one
/// call.
///
/// # Errors
/// [`StaticsError::Invalid`] unless there is one finite, positive length for each cable and the load is
/// finite; those of [`DirectProblem::direct`].
pub fn direct(
    robot: &Robot,
    lengths: &[f64],
    load: &Load,
    start: DirectStart,
) -> Result<DirectSolution, StaticsError> {
    DirectProblem::new(robot, lengths, load)?.direct(start)
}

impl DirectProblem<'_> {
    /// An equilibrium: the one that Newton's method converges to from the start, else a stable one downhill
    /// of the start. [`DirectProblem::with_unstable`] says what becomes of an unstable one; unless it is
    /// accepted, the equilibrium is stable.
    ///
    /// Without a moment in the load the potential always has a minimum, because the cables' elasticity bounds
    /// it from below. The start is never returned as a solution.
    ///
    /// # Errors
    /// - [`StaticsError::Invalid`] for a start that is not finite or has not one force for each cable.
    /// - [`StaticsError::Overstrained`] where the equilibrium strains a cable by more than 10 %.
    /// - [`StaticsError::Indifferent`] where nothing determines the pose.
    /// - [`StaticsError::EquilibriumLost`] where none is found under the load's moment, and the one without
    ///   it disappears while the moment is raised.
    /// - [`StaticsError::DirectNotConverged`] with the last pose.
    /// - [`StaticsError::Robot`] where the search fails because a value of the robot is invalid.
    /// - [`StaticsError::Unstable`] for an unstable equilibrium that is refused.
    pub fn direct(&self, start: DirectStart) -> Result<DirectSolution, StaticsError> {
        let released = matches!(start, DirectStart::Released(_));
        let start = checked(self, start)?;
        let pose = start.pose;
        let newtons = if released { None } else { newton(self, start) };
        let found = match newtons {
            // A strained equilibrium far from the start need not be the one downhill.
            Some(converged) if converged.stability.is_stable() || self.unstable != Unstable::Left => {
                solution(self, converged, DirectMethod::Newton).or_else(|_| settle(self, &pose))?
            }
            _ => settle(self, &pose)?,
        };
        if self.unstable == Unstable::Refused && !found.stability.is_stable() {
            let pose = Box::new(found.equilibrium.pose);
            return Err(StaticsError::Unstable { pose, least_stiffness: found.stability.least_stiffness() });
        }
        Ok(found)
    }
}

/// A level pose to start from where none is known: where straight cables of these lengths [m] would hold a
/// point.
///
/// With `d_i` the exit points seen from their middle and q the point seen from there,
/// `L_i² = |d_i|² - 2 d_i·q + |q|²`. The differences of these equations give q, by least squares, in the
/// space that the exit points span; their mean gives the rest of |q|, which points downwards. A planar robot
/// starts in its plane.
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
    // Exit points in one plane span no space, whatever the errors of their survey.
    let inverse = scatter.pseudo_inverse(0.01 * scatter.trace()).unwrap_or_else(|_| Matrix3::zeros());
    let q = -0.5 * inverse * moment;
    let depth = (mean - q.norm_squared()).max(0.0).sqrt();
    let up = to_base(robot.gravity.level(), [0.0, 0.0, 1.0]);
    let mut position = middle + q - Vector3::from(up) * depth;
    // A planar robot cannot leave its plane, and no search from elsewhere would bring it there.
    if let Some((normal, offset)) = robot.plane_offset() {
        position[normal] = offset;
    }
    Pose { position, rotation: Rotation3::identity() }
}

/// The start as an equilibrium to be found, validated.
fn checked(problem: &DirectProblem, start: DirectStart) -> Result<Equilibrium, StaticsError> {
    match start {
        DirectStart::Pose(pose) | DirectStart::Released(pose) => {
            StaticsError::finite_pose("start", pose)?;
            cables_at(problem, pose)
        }
        DirectStart::Near(equilibrium) => {
            problem.check("start", equilibrium)?;
            Ok(equilibrium.clone())
        }
    }
}

/// The stable equilibrium downhill of a pose.
///
/// A moment has no potential: where it keeps the descent from ending, the equilibrium without it is followed
/// while the moment is raised.
fn settle(problem: &DirectProblem, pose: &Pose) -> Result<DirectSolution, StaticsError> {
    let error = match descend(problem, pose) {
        Err(error @ StaticsError::DirectNotConverged { .. }) => error,
        outcome => return outcome,
    };
    // Fields are public: what looks like a hard problem may be an invalid robot.
    problem.robot.validate()?;
    let wrench = problem.load.wrench;
    if wrench.moment == Vector3::zeros() {
        return Err(error);
    }
    let resting = Load { wrench: Wrench { moment: Vector3::zeros(), ..wrench }, ..problem.load };
    let without = DirectProblem { load: resting, ..*problem };
    let Ok(first) = descend(&without, pose) else { return Err(error) };
    let [from, to] = [resting, problem.load].map(|load| Setting { lengths: problem.lengths.to_vec(), load });
    let iterations = first.report.iterations;
    match follow_from(problem.robot, &from, &to, first.clone())?.end(&first).map_err(|lost| *lost) {
        Ok(mut solution) => {
            solution.report.iterations += iterations;
            Ok(solution)
        }
        Err((Loss { kind: LossKind::Overstrained, after: Err(error), .. }, _)) => Err(error),
        Err((Loss { kind: LossKind::StepLimit, .. }, _)) => Err(error),
        Err((loss, _)) => Err(StaticsError::EquilibriumLost {
            share: loss.share,
            least_stiffness: loss.before.stability.least_stiffness(),
            pose: Box::new(loss.before.equilibrium.pose),
        }),
    }
}
