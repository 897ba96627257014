//! Observations of displacements, with the rotation of the platform under the load or without.

use super::{Batch, InRows, Observation, Observed, Observer, read};
use crate::error::StaticsError;
use crate::lanes::chain::{Outcome, observe};
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

impl Observed for Observation {
    fn in_lanes(batch: Batch) -> Vec<Result<Self, ScalarReason>> {
        let found = dispatch(Displacements { batch, with_frames: false });
        found.into_iter().map(|found| Ok(found?.observation)).collect()
    }

    fn by_scalar_models(
        observer: &Observer,
        deviations: &[f64],
        why: ScalarReason,
    ) -> Result<Self, StaticsError> {
        Ok(Self::of(&observer.deflection(&observer.robot.perturbed(deviations)?)?, why))
    }
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

/// A batch whose displacements are observed, `with_frames` the rotations that belong to them, which are zero
/// otherwise.
struct Displacements<'a> {
    batch: Batch<'a>,
    with_frames: bool,
}

impl WithSimd for Displacements<'_> {
    type Output = Vec<Result<ObservationMotion, ScalarReason>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Batch { observer: Observer { robot, pose, load, layout, nominal, .. }, deviations } = self.batch;
        let parameters = layout.count();
        let count = deviations.len() / parameters;
        let nominal = match nominal {
            Ok(nominal) => nominal,
            Err(why) => return vec![Err(*why); count],
        };
        let mut found = Vec::with_capacity(count);
        for rows in deviations.chunks(Lanes::<S>::COUNT * parameters) {
            let count = rows.len() / parameters;
            let rows = Rows::new(simd, rows, layout);
            let mut observed = [None; MAX_LANES];
            for axes in nominal.axes() {
                let (mut start, level, valid) = rows.robots(robot, pose, load, nominal, *axes);
                let own = valid[1].to_array();
                if !(0..count).any(|lane| own[lane] && observed[lane].is_none()) {
                    continue;
                }
                if self.with_frames {
                    start.robots.frame.extend(rows.frame(pose, level.as_ref()));
                }
                let (outcome, _) = observe(&mut start, &nominal.shared, false);
                let read = with_rotations(&outcome, &InRows { level: level.as_ref(), valid, nominal });
                for lane in (0..count).filter(|lane| own[*lane]) {
                    observed[lane].get_or_insert(read[lane]);
                }
                if observed[..count].iter().all(Option::is_some) {
                    break;
                }
            }
            found.extend(observed.into_iter().take(count).flatten());
        }
        found
    }
}

/// The observation in each lane, with its rotation where the platforms have frames, or why it was left.
#[inline(always)]
fn with_rotations<S: Simd>(
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
