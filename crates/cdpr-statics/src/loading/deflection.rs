//! Static deflection under a load, Eq. (4): the difference of two equilibria.
//!
//! The inverse model gives the unstrained lengths for a wanted pose under the platform's own weight. Offsets
//! of the tension set-points change those lengths. Then the direct model runs without and with the load, and
//! the deflection is `dp = p_loaded - p_unloaded`.

use crate::direct::{DirectSolution, DirectStart, follow_load};
use crate::equations::FORCES;
use crate::error::StaticsError;
use crate::inverse::{InverseSolution, PoseLengths, inverse_at, lengths_at, lengths_for_tensions, limits_at};
use crate::problem::{DirectProblem, Unstable};
use crate::state::{Equilibrium, Load, Wanted, WantedPose, one_by_one, rounding_of_closure};
use cdpr_robot::{Pose, Robot, TensionLimits, Vector3, Vector6, Wrench};
use cdpr_tension::offset;

/// The platform without and with a load, on the same cable lengths.
#[derive(Clone, Debug, PartialEq)]
pub struct Deflection {
    /// Unstrained lengths [m].
    pub lengths: Vec<f64>,
    /// Equilibrium under the platform's own weight.
    pub unloaded: DirectSolution,
    /// Equilibrium with the load added.
    pub loaded: DirectSolution,
}

impl Deflection {
    /// dp = p_loaded - p_unloaded [m], Eq. (4).
    pub fn displacement(&self) -> Vector3<f64> {
        // Eq. (4)
        self.loaded.equilibrium.pose.position - self.unloaded.equilibrium.pose.position
    }

    /// The motion of the platform under the load [m, rad]: dp, and the rotation vector in the base frame.
    pub fn motion(&self) -> Vector6<f64> {
        self.unloaded.equilibrium.pose.motion_to(&self.loaded.equilibrium.pose)
    }

    /// Euclidean norm of dp [m], which the paper calls the RMS of the static deflection.
    pub fn magnitude(&self) -> f64 {
        self.displacement().norm()
    }

    /// Error of the displacement [m] by rounding: what the closure and the balance of both equilibria may
    /// leave open. A shorter displacement cannot be distinguished from zero.
    pub fn rounding(&self, robot: &Robot) -> f64 {
        let size = self.lengths.iter().copied().fold(0.0, f64::max);
        let exits = robot.cables.iter().map(|cable| cable.exit_point.norm()).fold(0.0, f64::max);
        let of = |DirectSolution { equilibrium, stability, .. }: &DirectSolution| {
            // The load is as great as the cables' forces at most.
            let forces = 2.0 * equilibrium.tensions().iter().sum::<f64>();
            let coordinates = equilibrium.pose.position.norm() + exits;
            rounding_of_closure(size, coordinates) + FORCES * forces / stability.least_stiffness()
        };
        of(&self.unloaded) + of(&self.loaded)
    }

    /// The displacement dp [m] that the stiffness at the unloaded pose predicts for `load`.
    ///
    /// # Errors
    /// As [`DirectProblem::linearize`].
    pub fn small_displacement(&self, robot: &Robot, load: &Load) -> Result<Vector3<f64>, StaticsError> {
        let problem = DirectProblem::new(robot, &self.lengths, &Load::none())?;
        let linearization = problem.linearize(&self.unloaded.equilibrium)?;
        let pose = &self.unloaded.equilibrium.pose;
        let added = load.total(robot, pose).to_vector() - Load::none().total(robot, pose).to_vector();
        Ok(linearization.displacement(&Wrench::from_vector(&added)).fixed_rows::<3>(0).into())
    }
}

/// The lengths for the tension set-points of a whole pose.
pub(crate) struct SetPointLengths {
    /// The inverse model under the platform's own weight.
    pub(crate) wanted: InverseSolution,
    /// Limits of the tensions at the platform.
    pub(crate) limits: Vec<TensionLimits>,
    /// The lengths that give the tensions after the offsets, within the limits, and the pose with the cables'
    /// forces; not in balance unless all offsets are zero.
    pub(crate) offset: PoseLengths,
}

/// Deflection under `load` at a wanted pose or at each of many.
///
/// The inverse model sets the lengths for the wanted pose under the platform's own weight, with the offsets
/// of the set-points. With free coordinates, set-points that are not offset are not kept within the limits.
///
/// # Errors
/// Those of [`crate::inverse`] and of [`deflection_from`].
pub fn deflection<W: Wanted>(
    robot: &Robot,
    wanted: W,
    load: &Load,
) -> W::Results<Result<Deflection, StaticsError>> {
    one_by_one(wanted, |wanted| {
        let PoseLengths { lengths, equilibrium } = set_lengths(robot, wanted)?;
        deflection_from(robot, lengths, load, &equilibrium)
    })
}

/// A rest without and with the offsets of tension set-points.
pub(crate) fn lengths_at_rest(
    robot: &Robot,
    tension_offsets: &[f64],
    rest: PoseLengths,
) -> Result<(PoseLengths, PoseLengths), StaticsError> {
    check_offsets(robot, tension_offsets)?;
    if tension_offsets.iter().all(|offset| *offset == 0.0) {
        return Ok((rest.clone(), rest));
    }
    let pose = rest.equilibrium.pose;
    let limits = limits_at(robot, &pose)?;
    let set_points = offset(&rest.equilibrium.tensions(), tension_offsets, &limits);
    let with_offsets = lengths_for_tensions(robot, &pose, &set_points)?;
    Ok((rest, with_offsets))
}

/// Unstrained lengths [m] that give offset tension set-points while the platform is fixed at a wanted pose,
/// or, with free coordinates, where it rests.
///
/// The set-points are the tensions of the inverse model under the platform's own weight plus the offsets,
/// kept within the limits. Once released, the platform stands elsewhere.
///
/// # Errors
/// Those of [`crate::inverse`].
pub fn set_point_lengths<'a>(
    robot: &Robot,
    wanted: impl Into<WantedPose<'a>>,
) -> Result<Vec<f64>, StaticsError> {
    Ok(set_lengths(robot, &wanted.into())?.lengths)
}

/// The lengths for a wanted pose, with its offsets.
fn set_lengths(robot: &Robot, wanted: &WantedPose) -> Result<PoseLengths, StaticsError> {
    let offsets = wanted.offsets_of(robot);
    if !wanted.free.is_empty() {
        return Ok(lengths_at_rest(robot, &offsets, lengths_at(robot, wanted, &Load::none())?)?.1);
    }
    Ok(SetPointLengths::new(robot, wanted, &offsets)?.offset)
}

impl SetPointLengths {
    /// Those of the whole of a wanted pose.
    pub(crate) fn new(
        robot: &Robot,
        wanted: &WantedPose,
        tension_offsets: &[f64],
    ) -> Result<Self, StaticsError> {
        check_offsets(robot, tension_offsets)?;
        let WantedPose { pose, tension_reference, .. } = wanted;
        let found = inverse_at(robot, pose, &Load::none(), *tension_reference)?;
        Self::from(robot, pose, tension_offsets, found)
    }

    /// Those of `pose` with the solution of the inverse model at hand.
    pub(crate) fn from(
        robot: &Robot,
        pose: &Pose,
        tension_offsets: &[f64],
        wanted: InverseSolution,
    ) -> Result<Self, StaticsError> {
        check_offsets(robot, tension_offsets)?;
        let limits = limits_at(robot, pose)?;
        let set_points = offset(&wanted.tensions, tension_offsets, &limits);
        let offset = lengths_for_tensions(robot, pose, &set_points)?;
        Ok(Self { wanted, limits, offset })
    }
}

fn check_offsets(robot: &Robot, tension_offsets: &[f64]) -> Result<(), StaticsError> {
    StaticsError::one_per_cable("tension_offsets", tension_offsets, robot.cables.len())?;
    match tension_offsets.iter().enumerate().find(|(_, offset)| !offset.is_finite()) {
        None => Ok(()),
        Some((i, offset)) => {
            Err(StaticsError::invalid(format!("tension_offsets[{i}]"), offset, "a finite offset [N]"))
        }
    }
}

/// Deflection under `load` for given unstrained lengths [m]: the equilibrium without the load is searched
/// from `start`, and the one with it is what that becomes while the load is raised.
///
/// # Errors
/// [`StaticsError::Unstable`] where the equilibrium without the load is unstable, from which the platform
/// would fall elsewhere; those of the direct model and of [`follow_load`].
pub fn deflection_from(
    robot: &Robot,
    lengths: Vec<f64>,
    load: &Load,
    start: &Equilibrium,
) -> Result<Deflection, StaticsError> {
    let unloaded = DirectProblem::new(robot, &lengths, &Load::none())?
        .with_unstable(Unstable::Refused)
        .direct(DirectStart::Near(start))?;
    let loaded = follow_load(robot, &lengths, (&Load::none(), &unloaded), load)?;
    Ok(Deflection { lengths, unloaded, loaded })
}
