//! Limits of the tensions at the platform, where the inverse model has its unknowns.
//!
//! A greatest tension at the exit point leaves the one at the platform that the cable's weight over the
//! difference in height adds to it, (C26) of `cdpr_cable`: it depends on the pose and not on the sag. With a
//! pulley the height is that above the leave point, which moves a little with the tension.

use super::wanted::pose_alone;
use crate::equations::Ends;
use crate::error::StaticsError;
use crate::out_of_limits::allowed;
use crate::state::{Wanted, one_by_one};
use cdpr_cable::{LONGEST_TAUT, MAX_STRAIN};
use cdpr_robot::{CableEnd, Pose, Robot, TensionLimits};

/// The limits of every cable's tension at the platform, at a wanted pose or at each of many.
///
/// # Errors
/// [`StaticsError::Invalid`] for free coordinates, offsets or a reference of the tensions, which do not act;
/// [`StaticsError::ExitLimit`] where the greatest tension at an exit point leaves less than the least one at
/// the platform; [`StaticsError::Cable`] where the weight of a cable on a pulley demands more than either.
pub fn limits_at<W: Wanted>(
    robot: &Robot,
    wanted: W,
) -> W::Results<Result<Vec<TensionLimits>, StaticsError>> {
    one_by_one(wanted, |wanted| platform_limits(robot, &pose_alone(*wanted)?))
}

/// [`limits_at`] at one pose.
pub(super) fn platform_limits(robot: &Robot, pose: &Pose) -> Result<Vec<TensionLimits>, StaticsError> {
    let at_platform = |i: usize| {
        let limits = allowed(robot, i);
        match robot.max_at(i) {
            CableEnd::Anchor => Ok(limits),
            CableEnd::Exit => {
                let TensionLimits { min, max: exit } = limits;
                let (max, depth) = below_exit(robot, pose, i, limits)?;
                if max < min {
                    return Err(StaticsError::ExitLimit { index: i, exit, depth, max, min });
                }
                Ok(TensionLimits { min, max })
            }
        }
    };
    (0..robot.cables.len()).map(at_platform).collect()
}

/// The greatest tension of cable i at the platform [N] that strains it by no more than
/// [`cdpr_cable::MAX_STRAIN`] at either end; `None` where its limit allows no more than that.
///
/// # Errors
/// [`StaticsError::Cable`] where a cable on a pulley has no shape.
pub(super) fn strain_limit(
    robot: &Robot,
    pose: &Pose,
    i: usize,
    limits: TensionLimits,
) -> Result<Option<f64>, StaticsError> {
    /// Share that rounding of a strain may leave open.
    const WITHIN: f64 = 1.0 - 1e-12;
    let cable = robot.cable(i);
    if cable.overstrain(heaviest(robot, pose, i, limits)).is_none() {
        return Ok(None);
    }
    at_both_ends(robot, pose, i, limits, WITHIN * cable.tension(MAX_STRAIN))
}

/// The greatest tension of cable i at the platform [N] that does not break it at either end; `None` where its
/// limit allows no more than that.
///
/// # Errors
/// [`StaticsError::Cable`] where a cable on a pulley has no shape.
pub(super) fn breaking_limit(
    robot: &Robot,
    pose: &Pose,
    i: usize,
    limits: TensionLimits,
) -> Result<Option<f64>, StaticsError> {
    match robot.cables[i].properties.breaking_force {
        Some(force) if force < heaviest(robot, pose, i, limits) => {
            at_both_ends(robot, pose, i, limits, force)
        }
        _ => Ok(None),
    }
}

/// No less than the greatest tension of cable i at either end [N].
fn heaviest(robot: &Robot, pose: &Pose, i: usize, limits: TensionLimits) -> f64 {
    // No part of a cable is longer than this many chords.
    limits.max + LONGEST_TAUT * robot.cable(i).weight_per_length * robot.span(pose, i).norm()
}

/// The greatest tension at the platform [N] that is at most `greatest` at either end, if it is below the
/// limit.
fn at_both_ends(
    robot: &Robot,
    pose: &Pose,
    i: usize,
    TensionLimits { min, max }: TensionLimits,
    greatest: f64,
) -> Result<Option<f64>, StaticsError> {
    let (at_platform, _) = below_exit(robot, pose, i, TensionLimits { min, max: greatest })?;
    let greatest = greatest.min(at_platform);
    Ok((greatest < max).then_some(greatest))
}

/// The tension at the platform [N] where it is `max` at the exit point, and how far the platform's end is
/// below the leave point [m].
fn below_exit(
    robot: &Robot,
    pose: &Pose,
    index: usize,
    TensionLimits { min, max: exit }: TensionLimits,
) -> Result<(f64, f64), StaticsError> {
    const MAX_ITERATIONS: usize = 50;
    let ends = Ends::of(robot, pose, index);
    let allowed = |height: f64| ends.cable.tension_above(exit, height).unwrap_or(0.0);
    let mut height = ends.end.z;
    let mut max = allowed(height);
    if ends.cable.guide.is_some_and(|guide| guide.radius > 0.0) {
        for _ in 0..MAX_ITERATIONS {
            // A limit below the least tension is no tension that the cable has.
            let held = ends.at_tension(max.max(min)).map_err(StaticsError::cable(index))?;
            height = ends.end.z - held.in_space().in_plane().0.leave_point().y;
            let before = std::mem::replace(&mut max, allowed(height));
            if (max - before).abs() <= 1e-14 * max {
                break;
            }
        }
    }
    Ok((max, -height))
}
