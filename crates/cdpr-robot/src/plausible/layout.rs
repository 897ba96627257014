//! Doubts about where the points of a robot are.

use super::doubt::{Doubt, Doubts, four_digits, frame_size};
use crate::number::visible;
use crate::robot::Robot;
use std::ops::Range;

/// Sizes of robots, from the desk to the stadium [m].
pub const FRAME: Range<f64> = 0.05..1000.0;
/// Heights that differ by less than this share of their size are the same, but for surveying and mountings.
const SAME_HEIGHT: f64 = 0.1;
/// Heights below this share of the greatest one may be of either sign: a floor is not that even.
const SURVEYED: f64 = 0.05;

/// The size of the frame, and of the platform compared with it.
pub(super) fn sizes(robot: &Robot) -> Doubts {
    if robot.cables.len() == 1 {
        return Doubts::new();
    }
    let (size, platform) = (frame_size(robot), robot.platform_size());
    let doubt = if !FRAME.contains(&size) {
        Doubt::new(
            "cables[*].exit_point",
            format!("a frame of {} m", four_digits(size)),
            "hardly the size of a robot",
            "coordinates in m, not in mm",
        )
    } else if let Some(i) = astray(robot).filter(|_| platform > size) {
        Doubt::new(
            format!("cables[{i}].anchor_point"),
            format!("{:?} m", robot.cables[i].anchor_point.as_slice()),
            format!("far from all others, outside of the frame of {} m", visible(size, 3)),
            "a point of the platform in m, not in mm",
        )
    } else if platform > size {
        Doubt::new(
            "cables[*].anchor_point",
            format!("on average {} m from P", visible(platform, 3)),
            format!("a platform larger than its frame of {} m", visible(size, 3)),
            "anchor_point on the platform, exit_point on the base, both in m",
        )
    } else {
        return Doubts::new();
    };
    vec![doubt]
}

/// The one cable whose anchor point is farther from P than fifty times that of each other one.
fn astray(robot: &Robot) -> Option<usize> {
    let away = |i: &usize| robot.cables[*i].anchor_point.norm();
    let farthest = (0..robot.cables.len()).max_by(|i, j| away(i).total_cmp(&away(j)))?;
    let others = (0..robot.cables.len()).filter(|i| *i != farthest);
    let next = others.map(|i| away(&i)).fold(0.0, f64::max);
    (next > 0.0 && away(&farthest) > 50.0 * next).then_some(farthest)
}

/// One exit point below the base frame's origin, all others above it at its height: a lost sign. A single
/// cable that pulls down stands among the others, a lost sign at their edge.
pub(super) fn mirrored(robot: &Robot) -> Option<Doubt> {
    let heights: Vec<f64> = robot.cables.iter().map(|cable| cable.exit_point.z).collect();
    let n = heights.len();
    let other_sign = |sign: f64| {
        let mut of_sign = (0..n).filter(|i| heights[*i] * sign < 0.0);
        of_sign.next().filter(|_| of_sign.next().is_none())
    };
    let highest = heights.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
    let is_far = |i: &usize| heights[*i].abs() > SURVEYED * highest;
    let i = other_sign(1.0).or_else(|| other_sign(-1.0)).filter(|i| n >= 4 && is_far(i))?;
    let near = |j: usize| j != i && (heights[i] + heights[j]).abs() <= SAME_HEIGHT * heights[i].abs();
    let level = (0..n).filter(|j| *j != i).all(|j| heights[j] * heights[i] < 0.0) && (0..n).any(near);
    if !level || is_among(robot, i) {
        return None;
    }
    let point = robot.cables[i].exit_point;
    Some(Doubt::new(
        format!("cables[{i}].exit_point"),
        format!("{:?} m", point.as_slice()),
        "the only exit point on the other side of z = 0, and about as far from it as others",
        format!("z = {}", -point.z),
    ))
}

/// Whether exit point `i`, seen from above, lies among the others: no line through it has all of them on one
/// side.
fn is_among(robot: &Robot, i: usize) -> bool {
    let place = robot.cables[i].exit_point.xy();
    let others = robot.cables.iter().enumerate().filter(|(j, _)| *j != i);
    let mut angles: Vec<f64> = others
        .map(|(_, cable)| cable.exit_point.xy() - place)
        .filter(|apart| apart.norm() > 1e-9)
        .map(|apart| apart.y.atan2(apart.x))
        .collect();
    angles.sort_by(f64::total_cmp);
    let [Some(first), Some(last)] = [angles.first(), angles.last()] else { return true };
    let around = first + std::f64::consts::TAU - last;
    let widest = angles.windows(2).map(|pair| pair[1] - pair[0]).fold(around, f64::max);
    widest < std::f64::consts::PI * (1.0 - 1e-9)
}
