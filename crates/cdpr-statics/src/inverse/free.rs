//! The inverse model of a robot with fewer cables than free motions.
//!
//! n cables prescribe n of the m coordinates of a pose. The others are free: they are unknowns besides the
//! lengths, and the balance of the free motions is as many equations,
//!
//! ```text
//! F(σ, q) = sum w_i(σ_i, q) + w_ex(q) = 0,      n chord forces σ_i,      m - n free coordinates q      (I6)
//! ```
//!
//! (I6) may have several solutions, and not all are wanted. Straight cables without weight are solved first,
//! from many starts (`straight`), and each of their roots is followed to the cables as they are (`search`),
//! in steps of their weight where they sag much. The search then goes on from cables that sag. Only *sound*
//! solutions are taken: all tensions within their limits, no cable a loop or below the ground (`sound`). A
//! solution with infinitely many others next to it is refused (`unique`). Each solution is an equilibrium for
//! its lengths, and the stiffness with these lengths fixed says whether it is stable.

mod nearby;
mod roots;
mod search;
mod solution;
mod sound;
mod straight;
mod unique;

use super::problem::InverseProblem;
use super::{PoseLengths, inverse_at, refuse_offsets};
use crate::error::StaticsError;
use crate::out_of_limits::out_of_limits;
use crate::problem::DirectProblem;
use crate::state::{Load, WantedPose};
use cdpr_cable::LONGEST_TAUT;
use cdpr_robot::{Coordinate, Robot};
pub(crate) use nearby::FreeBranch;
pub use nearby::rest_near;
use roots::Roots;
use search::{Outcome, Point, Search, Unknowns};
pub use solution::{FreeSolution, FreeSolutions};
pub use sound::LONGEST;
use sound::{Loops, longest};

/// All lengths that were found with which the platform rests under its weight and `load` at a pose whose free
/// coordinates start from those of the wanted one.
///
/// A robot with n cables for m free motions has m - n free coordinates; with a cable for every free motion
/// no coordinate is free, and the one solution is that of [`crate::inverse`]. No cable is longer than
/// [`LONGEST`] chords, unless loops are wanted, and none is below [`Robot::ground_z`].
///
/// ```
/// use cdpr_robot::{Coordinate, Pose, Robot};
/// use cdpr_statics::{Load, WantedPose};
/// use cdpr_statics::free_coordinates::free_solutions;
///
/// let mut robot = Robot::from_library("cogiro")?;
/// robot.cables = [1, 3, 5, 7].map(|i| robot.cables[i].clone()).to_vec();
/// let wanted = WantedPose::at(&Pose::at(1.0, -0.3, 2.0)).free(&[Coordinate::Roll, Coordinate::Yaw]);
/// let found = free_solutions(&robot, wanted, &Load::none())?.first;
/// assert!(found.stability.is_stable() && found.residual.force < 1e-8);
/// assert_eq!(found.equilibrium.pose.position.z, 2.0);
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
///
/// # Errors
/// - [`StaticsError::FreeCoordinates`] where the free coordinates are not m - n.
/// - [`StaticsError::NoRest`] where no such solution was found; it says what the nearest one lacks.
/// - [`StaticsError::NotUnique`] where infinitely many lengths or tensions hold the platform.
/// - [`StaticsError::Invalid`] for a coordinate that is named twice or constrained, for a pose or load that
///   is not finite, and for offsets of tension set-points.
pub fn free_solutions<'a>(
    robot: &Robot,
    wanted: impl Into<WantedPose<'a>>,
    load: &Load,
) -> Result<FreeSolutions, StaticsError> {
    solutions(robot, &refuse_offsets(wanted.into())?, load)
}

fn solutions(robot: &Robot, wanted: &WantedPose, load: &Load) -> Result<FreeSolutions, StaticsError> {
    let WantedPose { pose, free, loops, tension_reference, .. } = wanted;
    check_free(robot, free)?;
    if free.is_empty() {
        let found = inverse_at(robot, pose, load, *tension_reference)?;
        let first = FreeSolution::new(robot, load, found.lengths, found.equilibrium, found.iterations)?;
        return Ok(FreeSolutions { first, others: Vec::new() });
    }
    let search = Search::new(robot, pose, load, free)?;
    let loops = if *loops { Loops::Allowed } else { Loops::Refused };
    let found = Roots::new(&search, loops).all()?;
    let FreeSolution { lengths, equilibrium, .. } = &found.first;
    DirectProblem::new(robot, lengths, load)?.check_strains(equilibrium)?;
    Ok(found)
}

/// As many coordinates are free as cables are missing, each of them once and none that is constrained.
fn check_free(robot: &Robot, free: &[Coordinate]) -> Result<(), StaticsError> {
    let (cables, freedoms) = (robot.cables.len(), robot.freedoms());
    if free.len() != freedoms.count().saturating_sub(cables) {
        return Err(StaticsError::FreeCoordinates { cables, freedoms: freedoms.count(), named: free.len() });
    }
    for (k, coordinate) in free.iter().enumerate() {
        let refused = |expected: &str| StaticsError::invalid("free".to_owned(), coordinate, expected);
        if free[..k].contains(coordinate) {
            return Err(refused("each coordinate once"));
        }
        if !freedoms.contains(coordinate.component()) {
            return Err(refused("a coordinate that is not constrained"));
        }
    }
    Ok(())
}

/// A stable solution nearer to the given pose than this, in radians and relative to the longest span, is
/// taken for the nearest.
pub(crate) const NEXT_TO_POSE: f64 = 0.03;

/// What a solution next to given coordinates decides.
enum Nearby {
    /// It is sound, taut, stable and so close that no other needs to be looked for.
    Solution(Box<FreeSolution>),
    /// It is as close, but out of limits, a loop, below the ground or unstable.
    Refused(StaticsError),
    /// Nothing: it is far away, or a cable of it is paid out far.
    Open,
}

impl Nearby {
    /// The solution; `None` where nothing is decided.
    fn solution(self) -> Result<Option<FreeSolution>, StaticsError> {
        match self {
            Self::Solution(found) => Ok(Some(*found)),
            Self::Refused(error) => Err(error),
            Self::Open => Ok(None),
        }
    }
}

impl Search<'_> {
    /// The solution that the search leads to from the given coordinates, if it is one to return.
    fn near_pose(&self) -> Result<Option<FreeSolution>, StaticsError> {
        let changes = vec![0.0; self.free.len()];
        let chord_forces = self.straight_forces(&changes);
        let Outcome::Found(point, unknowns, iterations) = self.descend(Unknowns { changes, chord_forces })
        else {
            return Ok(None);
        };
        let Nearby::Solution(found) = self.decided(point, iterations, NEXT_TO_POSE)? else { return Ok(None) };
        self.check_unique(&unknowns)?;
        Ok(Some(*found))
    }

    /// What a solution decides that is no farther than `reach` from the given coordinates.
    fn decided(&self, point: Point, iterations: usize, reach: f64) -> Result<Nearby, StaticsError> {
        let InverseProblem { robot, pose, load, .. } = self.problem;
        if self.distance(pose, &point.found.equilibrium.pose) > reach {
            return Ok(Nearby::Open);
        }
        if let Some(nearest) = Loops::Refused.fault(robot, &point.found) {
            return Ok(Nearby::Refused(StaticsError::NoRest { starts: 1, nearest }));
        }
        let PoseLengths { lengths, equilibrium } = point.found;
        let is_taut =
            longest(robot, &lengths, &equilibrium).is_some_and(|(_, chords)| chords <= LONGEST_TAUT);
        let is_within = out_of_limits(robot, &lengths, &[&equilibrium]).is_empty();
        if !(is_taut && is_within) {
            return Ok(Nearby::Open);
        }
        let found = FreeSolution::new(robot, load, lengths, equilibrium, iterations)?;
        if found.stability.is_stable() {
            return Ok(Nearby::Solution(Box::new(found)));
        }
        let least_stiffness = found.stability.least_stiffness();
        let pose = Box::new(found.equilibrium.pose);
        Ok(Nearby::Refused(StaticsError::Unstable { pose, least_stiffness }))
    }
}

/// Unstrained lengths that hold the platform where its free coordinates are found: those of
/// [`free_solutions`]. A stable solution close to the given pose is taken without a search for others.
///
/// # Errors
/// Those of [`free_solutions`].
pub(crate) fn rest(robot: &Robot, wanted: &WantedPose, load: &Load) -> Result<FreeSolution, StaticsError> {
    check_free(robot, wanted.free)?;
    let found = match Search::new(robot, &wanted.pose, load, wanted.free)?.near_pose()? {
        Some(found) => found,
        None => solutions(robot, wanted, load)?.first,
    };
    DirectProblem::new(robot, &found.lengths, load)?.check_strains(&found.equilibrium)?;
    Ok(found)
}

/// The lengths of [`crate::inverse`].
///
/// # Errors
/// Those of [`crate::inverse`].
pub(crate) fn lengths_at(
    robot: &Robot,
    wanted: &WantedPose,
    load: &Load,
) -> Result<PoseLengths, StaticsError> {
    if wanted.free.is_empty() {
        let found = inverse_at(robot, &wanted.pose, load, wanted.tension_reference)?;
        return Ok(PoseLengths { lengths: found.lengths, equilibrium: found.equilibrium });
    }
    let FreeSolution { lengths, equilibrium, .. } = rest(robot, wanted, load)?;
    Ok(PoseLengths { lengths, equilibrium })
}
