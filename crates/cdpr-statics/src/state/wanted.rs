//! A pose that a robot shall take, as the models are given it.

use cdpr_robot::{Coordinate, Pose, Robot};
use smallvec::SmallVec;

/// A pose that a robot shall take under the platform's own weight or a load, and how its cables hold it.
///
/// ```
/// use cdpr_robot::{Coordinate, Pose};
/// use cdpr_statics::WantedPose;
///
/// let pose = Pose::at(1.0, -0.3, 2.0);
/// let free = [Coordinate::Roll, Coordinate::Yaw];
/// let wanted = WantedPose::at(&pose).free(&free);
/// assert_eq!((wanted.pose, wanted.free.len(), wanted.tension_offsets.len()), (pose, 2, 0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WantedPose<'a> {
    /// The pose; its free coordinates are where a search for them starts.
    pub pose: Pose,
    /// Coordinates of the pose that the robot finds itself: as many as it lacks cables for its free motions,
    /// and none for a robot with a cable for each.
    pub free: &'a [Coordinate],
    /// Whether cables of any length are taken where coordinates are free: a loop that hangs on its ends may
    /// hold a platform, too. Otherwise none is longer than [`crate::free_coordinates::LONGEST`] chords.
    pub loops: bool,
    /// Offset of the tension set-point of every cable [N]; empty for none.
    ///
    /// Set-points are the tensions of the inverse model; with their offsets they are kept within the limits,
    /// and the cables get the lengths for them. Only models that set these lengths take offsets.
    pub tension_offsets: &'a [f64],
    /// Tensions [N], one for each cable, to which those of the inverse model are as near as possible; `None`
    /// for the robot's own, which are zero unless it states them. With free coordinates the balance leaves no
    /// choice of the tensions, and they do not act.
    pub tension_reference: Option<&'a [f64]>,
}

impl<'a> WantedPose<'a> {
    /// The whole of a pose, without offsets, with the robot's own reference of the tensions.
    pub fn at(pose: &Pose) -> Self {
        Self { pose: *pose, free: &[], loops: false, tension_offsets: &[], tension_reference: None }
    }

    /// With coordinates that the robot finds itself.
    #[must_use]
    pub fn free(self, free: &'a [Coordinate]) -> Self {
        Self { free, ..self }
    }

    /// With cables of any length.
    #[must_use]
    pub fn with_loops(self) -> Self {
        Self { loops: true, ..self }
    }

    /// With an offset of the tension set-point of every cable [N].
    #[must_use]
    pub fn tension_offsets(self, tension_offsets: &'a [f64]) -> Self {
        Self { tension_offsets, ..self }
    }

    /// With tensions [N] that are preferred.
    #[must_use]
    pub fn tension_reference(self, tension_reference: &'a [f64]) -> Self {
        Self { tension_reference: Some(tension_reference), ..self }
    }

    /// An offset for every cable [N].
    pub(crate) fn offsets_of(&self, robot: &Robot) -> SmallVec<[f64; 16]> {
        match self.tension_offsets {
            [] => SmallVec::from_elem(0.0, robot.cables.len()),
            given => SmallVec::from_slice(given),
        }
    }
}

impl From<&Pose> for WantedPose<'_> {
    fn from(pose: &Pose) -> Self {
        Self::at(pose)
    }
}

impl From<Pose> for WantedPose<'_> {
    fn from(pose: Pose) -> Self {
        Self::at(&pose)
    }
}

/// What a model is given: one wanted pose, for which it has one result, or a slice of poses, for which it has
/// a list of them.
pub trait Wanted {
    /// One `T`, or one for each pose.
    type Results<T>;

    /// The result of `one`, or those of `many`.
    #[doc(hidden)]
    fn results<T>(
        self,
        one: impl Fn(&WantedPose) -> T,
        many: impl FnOnce(&[Pose]) -> Vec<T>,
    ) -> Self::Results<T>;
}

impl Wanted for WantedPose<'_> {
    type Results<T> = T;

    fn results<T>(self, one: impl Fn(&WantedPose) -> T, _: impl FnOnce(&[Pose]) -> Vec<T>) -> T {
        one(&self)
    }
}

impl Wanted for &Pose {
    type Results<T> = T;

    fn results<T>(self, one: impl Fn(&WantedPose) -> T, _: impl FnOnce(&[Pose]) -> Vec<T>) -> T {
        one(&WantedPose::at(self))
    }
}

macro_rules! many_poses {
    ($([$($kind:tt)*] $poses:ty),+) => {$(
        impl<$($kind)*> Wanted for $poses {
            type Results<T> = Vec<T>;

            fn results<T>(self, _: impl Fn(&WantedPose) -> T, many: impl FnOnce(&[Pose]) -> Vec<T>) -> Vec<T> {
                many(self)
            }
        }
    )+};
}

many_poses!([] &[Pose], [const N: usize] &[Pose; N], [] &Vec<Pose>);

/// The results at poses one after the other.
pub(crate) fn one_by_one<W: Wanted, T>(wanted: W, one: impl Fn(&WantedPose) -> T) -> W::Results<T> {
    wanted.results(&one, |poses| poses.iter().map(|pose| one(&WantedPose::at(pose))).collect())
}
