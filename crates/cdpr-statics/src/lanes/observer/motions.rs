//! Observations with the rotation of the platform under the load.

use super::{Batch, Displacements, InRows, Observation, Observed, Observer, read};
use crate::error::StaticsError;
use crate::lanes::chain::Outcome;
use crate::lanes::level::LevelFrame;
use crate::lanes::reason::ScalarReason;
use cdpr_number::dense::Lanes3;
use cdpr_number::lanes::{Lanes, MAX_LANES, Simd, dispatch};
use cdpr_robot::{Matrix3, Pose, Vector3, orthonormalized};
use smallvec::SmallVec;
use std::array::from_fn;

/// The deflection of one perturbed robot, with the rotation that belongs to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObservationMotion {
    /// The deflection.
    pub observation: Observation,
    /// Rotation vector from the unloaded to the loaded platform in the base frame [rad], as
    /// [`Pose::motion_to`].
    pub rotation: Vector3<f64>,
}

impl Observed for ObservationMotion {
    fn in_lanes(batch: Batch) -> Vec<Result<Self, ScalarReason>> {
        dispatch(Displacements { batch, with_frames: true })
    }

    fn by_scalar_models(
        observer: &Observer,
        deviations: &[f64],
        why: ScalarReason,
    ) -> Result<Self, StaticsError> {
        let found = observer.deflection(&observer.robot.perturbed(deviations)?)?;
        let rotation = found.motion().fixed_rows::<3>(3).into();
        Ok(Self { observation: Observation::of(&found, why), rotation })
    }
}

/// The observation in each lane, with its rotation where the platforms have frames, or why it was left.
#[inline(always)]
pub(super) fn with_rotations<S: Simd>(
    outcome: &Outcome<S>,
    of: &InRows<'_, S>,
) -> [Result<ObservationMotion, ScalarReason>; MAX_LANES] {
    let (observed, [frame, _]) = (read(outcome, of), &outcome.frames);
    if frame.is_empty() {
        let rotation = Vector3::zeros();
        return observed.map(|found| Ok(ObservationMotion { observation: found?, rotation }));
    }
    let frames = outcome.frames.each_ref().map(|frame| in_base(frame, of.level));
    from_fn(|lane| with_rotation(observed[lane], &frames, lane))
}

/// Adds the rotation in a lane from the first of the frames to the second one.
fn with_rotation(
    observed: Result<Observation, ScalarReason>,
    frames: &[Columns; 2],
    lane: usize,
) -> Result<ObservationMotion, ScalarReason> {
    let at = |frame: &Columns| {
        let rotation = Matrix3::from_fn(|row, column| frame[column][row][lane]);
        Pose { position: Vector3::zeros(), rotation: orthonormalized(&rotation) }
    };
    observed.map(|observation| {
        let rotation = at(&frames[0]).motion_to(&at(&frames[1])).fixed_rows::<3>(3).into();
        ObservationMotion { observation, rotation }
    })
}

/// The components of a platform frame in the base frame, by its columns, in each lane.
type Columns = SmallVec<[[[f64; MAX_LANES]; 3]; 3]>;

#[inline(always)]
fn in_base<S: Simd>(frame: &[Lanes3<S>], level: Option<&LevelFrame<S>>) -> Columns {
    let to_base = |column: &Lanes3<S>| level.map_or(*column, |level| level.to_base(column));
    frame.iter().map(|column| to_base(column).map(Lanes::to_array)).collect()
}
