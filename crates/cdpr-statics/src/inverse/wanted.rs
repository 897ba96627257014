//! What a model takes of a wanted pose.

use crate::error::StaticsError;
use crate::state::WantedPose;
use cdpr_robot::Pose;

/// A wanted pose without offsets.
///
/// # Errors
/// [`StaticsError::Invalid`] for offsets: they are of set-points, which this model does not set.
pub(crate) fn refuse_offsets(wanted: WantedPose) -> Result<WantedPose, StaticsError> {
    let expected = "none here: deflections, their derivatives and `set_point_lengths` take them";
    match wanted.tension_offsets {
        [] => Ok(wanted),
        given => Err(refusal("tension_offsets", given.len(), expected)),
    }
}

fn refusal(field: &str, given: usize, expected: &str) -> StaticsError {
    StaticsError::invalid(field.to_owned(), format!("a list of {given}"), expected)
}

/// A whole pose without offsets.
///
/// # Errors
/// Those of [`refuse_offsets`]; [`StaticsError::Invalid`] for free coordinates, which leave no choice of the
/// tensions.
pub(super) fn whole(wanted: WantedPose) -> Result<WantedPose, StaticsError> {
    let wanted = refuse_offsets(wanted)?;
    match wanted.free {
        [] => Ok(wanted),
        given => {
            let expected = "none here: it takes whole poses, at which tensions are chosen";
            Err(refusal("free", given.len(), expected))
        }
    }
}

/// A whole pose of which no more is wanted.
///
/// # Errors
/// Those of [`whole`]; [`StaticsError::Invalid`] for a reference of the tensions, which would not act.
pub(super) fn pose_alone(wanted: WantedPose) -> Result<Pose, StaticsError> {
    let WantedPose { pose, tension_reference, .. } = whole(wanted)?;
    match tension_reference {
        None => Ok(pose),
        Some(given) => Err(refusal("tension_reference", given.len(), "none here: no tensions are chosen")),
    }
}
