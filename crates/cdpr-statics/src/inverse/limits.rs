//! Limits of the tensions at the platform, where the inverse model has its unknowns.
//!
//! A greatest tension at the exit point leaves the one at the platform that the cable's weight over the
//! difference in height adds to it, (C26) of `cdpr_cable`: it depends on the pose and not on the sag. With a
//! pulley the height is that above the leave point, which moves a little with the tension.

use crate::equations::Ends;
use crate::error::StaticsError;
use cdpr_robot::{CableEnd, Pose, Robot, TensionLimits};

/// The limits of every cable's tension at the platform, which stands at `pose`.
///
/// # Errors
/// [`StaticsError::ExitLimit`] where the greatest tension at an exit point leaves less than the least one at
/// the platform; [`StaticsError::Cable`] where the weight of a cable on a pulley demands more than either.
pub fn limits_at(robot: &Robot, pose: &Pose) -> Result<Vec<TensionLimits>, StaticsError> {
    let at_platform = |i: usize| {
        let limits = robot.limits(i);
        match robot.max_at(i) {
            CableEnd::Anchor => Ok(limits),
            CableEnd::Exit => below_exit(robot, pose, i, limits),
        }
    };
    (0..robot.cables.len()).map(at_platform).collect()
}

fn below_exit(
    robot: &Robot,
    pose: &Pose,
    index: usize,
    TensionLimits { min, max: exit }: TensionLimits,
) -> Result<TensionLimits, StaticsError> {
    const MAX_ITERATIONS: usize = 50;
    let ends = Ends::of(robot, pose, index);
    let allowed = |height: f64| ends.cable.tension_above(exit, height).unwrap_or(0.0);
    let mut height = ends.end.z;
    let mut max = allowed(height);
    if ends.cable.guide.is_some_and(|guide| guide.radius > 0.0) {
        for _ in 0..MAX_ITERATIONS {
            // A limit below the least tension is no tension that the cable has.
            height = ends.end.z - ends.leave_height(max.max(min)).map_err(StaticsError::cable(index))?;
            let before = std::mem::replace(&mut max, allowed(height));
            if (max - before).abs() <= 1e-14 * max {
                break;
            }
        }
    }
    if max < min {
        return Err(StaticsError::ExitLimit { index, exit, depth: -height, max, min });
    }
    Ok(TensionLimits { min, max })
}
