//! The inertia of a platform compared with its mass and anchor points.
//!
//! With J, the inertia about the centre of mass of as many equal masses at the anchor points as there are
//! cables, of the mass of the platform together, `tr I / tr J` is the square of the radius of gyration over
//! the distance of the anchor points (mean of squares). It is 1/3 of a solid box with its anchors at the
//! corners, 1/5 of the ball inside it, and 1 of a shell with its anchors on it.

use super::{Findings, Severity};
use cdpr_robot::significant;
use std::ops::Range;

/// Usual `tr I / tr J`: robots of the library have 0.38 to 1.04. A factor of ten leaves it.
const USUAL: Range<f64> = 0.11..3.0;

/// Anchor points nearer to the centre of mass than this [m] are in it.
const TOGETHER: f64 = 1e-6;

impl Findings<'_> {
    /// An inertia about ten times too large or too small.
    pub(super) fn inertia(&mut self) {
        let platform = &self.robot.platform;
        // What is far out of bounds was named with its unit.
        if platform.point || self.list.iter().any(|finding| finding.field == "platform.inertia") {
            return;
        }
        let Some(inertia) = platform.inertia else { return };
        let squares = self.robot.cables.iter();
        let squares = squares.map(|cable| (cable.anchor_point - platform.center_of_mass).norm_squared());
        let distance = (squares.sum::<f64>() / self.robot.cables.len() as f64).sqrt();
        if distance < TOGETHER {
            return;
        }
        let trace = inertia.trace();
        let usual = 2.0 * platform.mass * distance * distance;
        if USUAL.contains(&(trace / usual)) {
            return;
        }
        let radius = (0.5 * trace / platform.mass).sqrt();
        let [low, high] = [USUAL.start, USUAL.end].map(|ratio| significant(ratio * usual, 2));
        let text = |value: f64| significant(value, 4);
        self.add(
            Severity::Warning,
            "platform.inertia",
            format!("{} kg m\u{b2}, the sum of its diagonal", text(trace)),
            &format!(
                "with platform.mass, {} kg, it makes a radius of gyration of {} m; the anchor points are {} \
                 m from the centre of mass (root mean square)",
                text(platform.mass),
                text(radius),
                text(distance)
            ),
            &format!("about the centre of mass, in kg m\u{b2}; {low} to {high} kg m\u{b2} are usual here"),
        );
    }
}
