//! The direct problem: a robot with unstrained lengths and a load, validated.

use crate::error::StaticsError;
use crate::state::{Equilibrium, Load};
use cdpr_cable::{Cable, Catenary};
use cdpr_robot::{Robot, RobotCable, Vector2, visible};

/// A robot whose cables have given unstrained lengths, under a load: what the direct model solves.
///
/// ```
/// use cdpr_robot::{Pose, Robot};
/// use cdpr_statics::{DirectProblem, DirectStart, Load, inverse};
///
/// let robot = Robot::from_library("caroca")?;
/// let wanted = inverse(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none())?;
/// let problem = DirectProblem::new(&robot, &wanted.lengths, &Load::payload(50.0))?;
/// let found = problem.direct(DirectStart::Near(&wanted.equilibrium))?;
/// assert!(problem.certify(&found)?.position < 1e-12); // [m]
/// let stiffness = problem.linearize(&found.equilibrium)?.symmetric_stiffness();
/// assert!(stiffness.symmetric_eigenvalues().min() > 0.0);
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DirectProblem<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) lengths: &'a [f64],
    pub(crate) load: Load,
    /// ℓ where it is not that of this robot [m].
    pub(crate) length_of_rotations: Option<f64>,
    pub(crate) unstable: Unstable,
}

/// What becomes of an unstable equilibrium to which Newton's method converges, such as a platform that
/// balances like an upright pendulum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unstable {
    /// It is left for the stable one downhill, to which the platform falls.
    #[default]
    Left,
    /// It is a solution, too.
    Accepted,
    /// It is an error: [`StaticsError::Unstable`].
    Refused,
}

impl<'a> DirectProblem<'a> {
    /// The problem of a robot with these unstrained lengths [m] and this load.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless there is one finite, positive length for each cable and the load is
    /// finite.
    pub fn new(robot: &'a Robot, lengths: &'a [f64], load: &Load) -> Result<Self, StaticsError> {
        StaticsError::one_per_cable("lengths", lengths, robot.cables.len())?;
        for (i, length) in lengths.iter().enumerate() {
            if !(length.is_finite() && *length > 0.0) {
                let expected = "a finite, positive unstrained length [m]";
                return Err(StaticsError::invalid(format!("lengths[{i}]"), length, expected));
            }
        }
        load.validate()?;
        Ok(Self { robot, lengths, load: *load, length_of_rotations: None, unstable: Unstable::Left })
    }

    /// The same problem with this characteristic length ℓ [m]. For robots that deviate from a nominal one it
    /// is that of the nominal robot: a constant by which rotations are measured does not deviate.
    #[must_use]
    pub fn with_characteristic_length(self, length: f64) -> Self {
        Self { length_of_rotations: Some(length), ..self }
    }

    /// The same problem with unstable equilibria left, accepted or refused.
    #[must_use]
    pub fn with_unstable(self, unstable: Unstable) -> Self {
        Self { unstable, ..self }
    }

    /// Unstrained lengths [m].
    pub fn lengths(&self) -> &'a [f64] {
        self.lengths
    }

    /// The robot.
    pub fn robot(&self) -> &'a Robot {
        self.robot
    }

    /// The load.
    pub fn load(&self) -> Load {
        self.load
    }

    /// Number of cables n.
    pub(crate) fn cables(&self) -> usize {
        self.lengths.len()
    }

    #[inline]
    pub(crate) fn cable(&self, i: usize) -> Cable<'a> {
        self.robot.cable(i)
    }

    /// Cable i in the shape that the force (fx, fz) [N] gives it.
    #[inline]
    pub(crate) fn catenary(&self, i: usize, force: Vector2<f64>) -> Catenary<'a> {
        Catenary { cable: self.cable(i), unstrained_length: self.lengths[i], force }
    }

    /// The longest cable [m]: what errors of position are compared with.
    pub(crate) fn size(&self) -> f64 {
        self.lengths.iter().fold(0.0, |size: f64, length| size.max(*length))
    }

    /// Length ℓ [m] that makes rotations comparable with translations, see
    /// [`crate::Stability::characteristic_length`].
    pub(crate) fn characteristic_length(&self) -> f64 {
        let own = || self.robot.platform_size().max(1e-3 * self.size());
        self.length_of_rotations.unwrap_or_else(own)
    }

    /// Checks that an equilibrium has a finite pose and one finite force for each cable.
    pub(crate) fn check(&self, field: &str, equilibrium: &Equilibrium) -> Result<(), StaticsError> {
        let Equilibrium { pose, cable_forces } = equilibrium;
        StaticsError::finite_pose(field, pose)?;
        if cable_forces.len() != self.cables() {
            return Err(StaticsError::invalid(
                format!("{field}.cable_forces"),
                format!("a list of {}", cable_forces.len()),
                format!("one force for each of the {} cables", self.cables()),
            ));
        }
        match cable_forces.iter().position(|force| !(force.x.is_finite() && force.y.is_finite())) {
            None => Ok(()),
            Some(i) => Err(StaticsError::invalid(
                format!("{field}.cable_forces[{i}]"),
                format!("{:?}", cable_forces[i].as_slice()),
                "finite components [N]",
            )),
        }
    }
}

/// All cables longer than this many widths of a robot would let the platform hang far below it; lengths in mm
/// are a thousand times too long.
const LONGEST: f64 = 30.0;

/// Greatest length of a cable by its unstrained length.
const MOST_STRETCH: f64 = 1.1;

/// Questions lengths [m] that are all so much longer than the robot is wide that they must be in another
/// unit. Cables whose exits are near to each other may be that long: in mm they would not reach the platform.
///
/// # Errors
/// [`StaticsError::Invalid`] with what the shortest would be if it were in mm.
pub fn check_lengths(robot: &Robot, lengths: &[f64]) -> Result<(), StaticsError> {
    let first = &robot.cables[0];
    let away = |cable: &RobotCable| (cable.exit_point - first.exit_point).norm();
    let wide = robot.cables.iter().map(away).fold(robot.platform_size(), f64::max);
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let reach_in_mm = || {
        let reach = |length: f64| 1e-3 * MOST_STRETCH * length;
        let arm = |cable: &RobotCable| (cable.anchor_point - first.anchor_point).norm();
        let join = |(cable, length): (&RobotCable, &f64)| {
            away(cable) <= reach(lengths[0]) + reach(*length) + arm(cable)
        };
        robot.cables.iter().any(|cable| away(cable) > 0.0) && robot.cables.iter().zip(lengths).all(join)
    };
    if shortest.is_finite() && shortest > LONGEST * wide && reach_in_mm() {
        return Err(StaticsError::invalid(
            "lengths".to_owned(),
            format!("{lengths:?}"),
            format!(
                "lengths in m for a robot that is {} m wide: {shortest} mm is {}",
                visible(wide, 3),
                shortest / 1000.0
            ),
        ));
    }
    Ok(())
}

impl Load {
    /// The largest payload [kg], force [N] and moment [N m], positive or negative: cables of no material bear
    /// more, and next to it rounding hides all other forces.
    pub const LARGEST: f64 = 1e12;

    pub(crate) fn validate(&self) -> Result<(), StaticsError> {
        let is_load = |value: f64| value.abs() <= Self::LARGEST;
        if !is_load(self.payload) {
            let expected = format!("a mass from -{0:e} to {0:e} kg", Self::LARGEST);
            return Err(StaticsError::invalid("load.payload".to_owned(), self.payload, expected));
        }
        match self.wrench.to_vector().iter().find(|component| !is_load(**component)) {
            Some(component) => {
                let expected = format!("components from -{0:e} to {0:e} [N, N m]", Self::LARGEST);
                Err(StaticsError::invalid("load.wrench".to_owned(), component, expected))
            }
            None => Ok(()),
        }
    }
}
