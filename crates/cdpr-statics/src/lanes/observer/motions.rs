//! Observations with the rotation of the platform under the load.

use super::{Answers, Batch, Observation, Observed, Observer, read};
use crate::error::StaticsError;
use crate::lanes::chain::observe;
use crate::lanes::level::LevelFrame;
use crate::lanes::observer::rows::Rows;
use crate::lanes::reason::ScalarReason;
use cdpr_number::dense::Lanes3;
use cdpr_number::lanes::{Lanes, MAX_LANES, Simd, WithSimd, dispatch};
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
        dispatch(MotionBatch(batch))
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

/// Rows of deviations for the lanes, whose rotations are asked for.
struct MotionBatch<'a>(Batch<'a>);

impl WithSimd for MotionBatch<'_> {
    type Output = Vec<Result<ObservationMotion, ScalarReason>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Batch { observer: Observer { robot, pose, load, layout, nominal, .. }, deviations } = self.0;
        let parameters = layout.count();
        let nominal = match nominal {
            Ok(nominal) => nominal,
            Err(why) => return vec![Err(*why); deviations.len() / parameters],
        };
        let mut found = Vec::with_capacity(deviations.len() / parameters);
        for rows in deviations.chunks(Lanes::<S>::COUNT * parameters) {
            let count = rows.len() / parameters;
            let rows = Rows::new(simd, rows, layout);
            let mut answers = Answers::none();
            for axes in nominal.axes() {
                let (mut start, level, valid) = rows.robots(robot, pose, load, nominal, *axes);
                if valid[1].any() {
                    start.robots.frame.extend(rows.frame(pose, level.as_ref()));
                    let (outcome, _) = observe(&mut start, &nominal.shared, false);
                    let frames = outcome.frames.each_ref().map(|of| in_base(of, level.as_ref()));
                    let observed = read(&outcome, level.as_ref(), valid, nominal);
                    let moved = from_fn(|lane| with_rotation(observed[lane], &frames, lane));
                    answers.assign(valid[1], moved);
                }
                if answers.are_complete() {
                    break;
                }
            }
            found.extend(answers.take(count));
        }
        found
    }
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
