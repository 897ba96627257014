//! The inertia of a platform compared with its mass and anchor points.
//!
//! With J, the inertia about the centre of mass of as many equal masses at the anchor points as there are
//! cables, of the mass of the platform together, `tr I / tr J` is the square of the radius of gyration over
//! the distance of the anchor points (mean of squares). It is 1/3 of a solid box with its anchors at the
//! corners, 1/5 of the ball inside it, and 1 of a shell with its anchors on it. Of a planar robot the moments
//! about the normal of its plane are compared alone, those of the points from their distances in the plane.

use super::{Findings, Severity};
use cdpr_robot::{RobotCable, significant};
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
        let normal = self.robot.plane.map(cdpr_robot::Plane::normal);
        let square = |cable: &RobotCable| {
            let mut apart = cable.anchor_point - platform.center_of_mass;
            normal.iter().for_each(|k| apart[*k] = 0.0);
            apart.norm_squared()
        };
        let squares = self.robot.cables.iter().map(square).sum::<f64>();
        let distance = (squares / self.robot.cables.len() as f64).sqrt();
        if distance < TOGETHER {
            return;
        }
        // A point has twice its moment in the trace.
        let (moment, times, what) = match normal {
            Some(k) => (inertia[(k, k)], 1.0, "the moment about the normal of the plane"),
            None => (inertia.trace(), 2.0, "the sum of its diagonal"),
        };
        let usual = times * platform.mass * distance * distance;
        if USUAL.contains(&(moment / usual)) {
            return;
        }
        let radius = (moment / times / platform.mass).sqrt();
        let [low, high] = [USUAL.start, USUAL.end].map(|ratio| significant(ratio * usual, 2));
        let text = |value: f64| significant(value, 4);
        self.add(
            Severity::Warning,
            "platform.inertia",
            format!("{} kg m\u{b2}, {what}", text(moment)),
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
