//! The inertia of a platform compared with its mass and anchor points, as [`Gyration`] has them.

use super::{Findings, Severity};
use cdpr_robot::{plausible::Gyration, significant};

impl Findings<'_> {
    /// An inertia about ten times too large or too small.
    pub(super) fn inertia(&mut self) {
        // What is far out of bounds was named with its unit.
        if self.list.iter().any(|finding| finding.field == "platform.inertia") {
            return;
        }
        let Some(of) = Gyration::of(self.robot).filter(|of| !of.is_usual(1.0)) else { return };
        let what = match self.robot.plane {
            Some(_) => "the moment about the normal of the plane",
            None => "the sum of its diagonal",
        };
        let [low, high] = of.usual().map(|moment| significant(moment, 2));
        let text = |value: f64| significant(value, 4);
        self.add(
            Severity::Warning,
            "platform.inertia",
            format!("{} kg m\u{b2}, {what}", text(of.moment)),
            &format!(
                "with platform.mass, {} kg, it makes a radius of gyration of {} m; the anchor points are {} \
                 m from the centre of mass (root mean square)",
                text(self.robot.platform.mass),
                text(of.radius),
                text(of.distance)
            ),
            &format!("about the centre of mass, in kg m\u{b2}; {low} to {high} kg m\u{b2} are usual here"),
        );
    }
}
