//! A cable between its two points in space.

use crate::model::Model;
use cdpr_robot::{Pose, Vector2, Vector3};

/// r_i in cylindrical coordinates about the exit point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    /// Horizontal unit vector from B towards A; the x axis if A is right above or below B.
    pub(crate) azimuth: Vector2<f64>,
    /// (horizontal distance h, height z) of A from B [m].
    pub(crate) end: Vector2<f64>,
}

impl Span {
    pub(crate) fn new(span: Vector3<f64>) -> Self {
        let h = span.xy().norm();
        let azimuth = if h > 0.0 { Vector2::new(span.x / h, span.y / h) } else { Vector2::x() };
        Self { azimuth, end: Vector2::new(h, span.z) }
    }

    /// A vector of the cable's plane in the base frame.
    pub(crate) fn lift(&self, in_plane: Vector2<f64>) -> Vector3<f64> {
        Vector3::new(in_plane.x * self.azimuth.x, in_plane.x * self.azimuth.y, in_plane.y)
    }

    /// The components of a base-frame vector in the cable's plane.
    pub(crate) fn project(&self, vector: &Vector3<f64>) -> Vector2<f64> {
        Vector2::new(vector.x * self.azimuth.x + vector.y * self.azimuth.y, vector.z)
    }
}

impl Model<'_> {
    pub(crate) fn span(&self, pose: &Pose, i: usize) -> Span {
        Span::new(self.robot.span(pose, i))
    }

    /// The same, for a known arm `R a_i`.
    pub(crate) fn span_at(&self, pose: &Pose, i: usize, arm: &Vector3<f64>) -> Span {
        Span::new(pose.position + arm - self.robot.cables[i].exit_point)
    }
}
