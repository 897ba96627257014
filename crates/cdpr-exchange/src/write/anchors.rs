//! A robot as a point on straight lines.
//!
//! Firmware computes the length of a line as the distance of a point P from an anchor. A platform that keeps
//! its rotation R has the same distances if each anchor is moved by the lever arm of its cable:
//!
//! ```text
//! |p + R a_i - b_i| = |p - (b_i - R a_i)|                                                           (FW1)
//! ```
//!
//! with anchor points a_i and exit points b_i, the span of Eq. (1).

use crate::error::ExchangeError;
use crate::write::scene::{check_from_points, unplaced};
use cdpr_robot::{Pose, Robot, Vector3, significant};
use cdpr_statics::{Load, inverse};

/// Where the lines of a robot end, for firmware that moves a point.
pub(crate) struct Anchors {
    /// b_i - R a_i of (FW1) [m].
    pub(crate) points: Vec<Vector3<f64>>,
    /// What was assumed, and what firmware has no place for.
    pub(crate) notes: Vec<String>,
}

impl Anchors {
    /// Those of a robot that is held at a pose. Pulleys and leads are refused: the distance is not the length
    /// with them.
    pub(crate) fn new(robot: &Robot, pose: &Pose) -> Result<Self, ExchangeError> {
        check_from_points(robot)?;
        let lengths = inverse(robot, pose, &Load::none())?.lengths;
        let points = anchors(robot, pose);
        let mut notes = unplaced(robot);
        if robot.cables.iter().any(|cable| cable.anchor_point.norm() > 0.0) {
            notes.push(
                "firmware moves a point: the platform has to keep the rotation of the pose, and the anchors \
                 are the exit points less the lever arms of the anchor points"
                    .to_owned(),
            );
        }
        let apart = |(point, length): (&Vector3<f64>, &f64)| ((pose.position - point).norm() - length).abs();
        let apart = points.iter().zip(&lengths).map(apart).fold(0.0, f64::max);
        notes.push(format!(
            "the lengths of firmware are distances: unstrained lengths, with stretch and sag, differ from \
             them by up to {} mm at this pose, and a correction table has them",
            significant(1e3 * apart, 3)
        ));
        Ok(Self { points, notes })
    }
}

/// b_i - R a_i of (FW1) [m].
pub(crate) fn anchors(robot: &Robot, pose: &Pose) -> Vec<Vector3<f64>> {
    (0..robot.cables.len()).map(|i| pose.position - robot.span(pose, i)).collect()
}

/// A number without an exponent, to six decimals: `E` is a parameter of its own in G-code.
pub(crate) fn fixed(value: f64) -> String {
    // A sum with zero has no sign where it is zero.
    let text = format!("{:.6}", (1e6 * value).round() / 1e6 + 0.0);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Millimetres of a number of metres.
pub(crate) fn millimetres(value: f64) -> String {
    fixed(1e3 * value)
}

/// `x:y:z` or another joint list of numbers.
pub(crate) fn joined(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(fixed).collect::<Vec<_>>().join(":")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_no_exponent_and_no_sign_of_zero() {
        let texts = [-0.0, 1e-9, -4e-7, 1e-6, -1234.5, 3.04e6, 1e12].map(fixed);
        assert_eq!(texts, ["0", "0", "0", "0.000001", "-1234.5", "3040000", "1000000000000"]);
        assert_eq!(joined([0.0, -2e3, 0.5]), "0:-2000:0.5");
        assert_eq!(millimetres(-0.0276), "-27.6");
    }
}
