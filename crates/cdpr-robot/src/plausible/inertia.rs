//! The inertia of a platform compared with its mass and anchor points.
//!
//! With J, the inertia about the centre of mass of as many equal masses at the anchor points as there are
//! cables, of the mass of the platform together, `tr I / tr J` is the square of the radius of gyration over
//! the distance of the anchor points (mean of squares). It is 1/3 of a solid box with its anchors at the
//! corners, 1/5 of the ball inside it, and 1 of a shell with its anchors on it. Of a planar robot the moments
//! about the normal of its plane are compared alone, those of the points from their distances in the plane.

use crate::freedoms::Plane;
use crate::robot::{Robot, RobotCable};
use std::ops::Range;

/// Usual `tr I / tr J`: robots of the library have 0.38 to 1.04. A factor of ten leaves it.
const USUAL: Range<f64> = 0.11..3.0;

/// Anchor points nearer to the centre of mass than this [m] are in it.
const TOGETHER: f64 = 1e-6;

/// Inertia of a platform, and that of its mass at the anchor points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gyration {
    /// Moment about the normal of the plane of a planar robot, otherwise the sum of the diagonal [kg m²].
    pub moment: f64,
    /// The same of the mass of the platform at the anchor points [kg m²].
    pub of_anchors: f64,
    /// Radius of gyration [m].
    pub radius: f64,
    /// Distance of the anchor points from the centre of mass [m], the root of the mean of its squares.
    pub distance: f64,
}

impl Gyration {
    /// That of a robot; none of a point mass, without inertia and where all anchor points are the centre of
    /// mass.
    pub fn of(robot: &Robot) -> Option<Self> {
        let platform = &robot.platform;
        let inertia = platform.inertia.filter(|_| !platform.point)?;
        let normal = robot.plane.map(Plane::normal);
        let square = |cable: &RobotCable| {
            let mut apart = cable.anchor_point - platform.center_of_mass;
            normal.iter().for_each(|k| apart[*k] = 0.0);
            apart.norm_squared()
        };
        let squares = robot.cables.iter().map(square).sum::<f64>();
        let distance = (squares / robot.cables.len() as f64).sqrt();
        // A point has twice its moment in the trace.
        let (moment, times) = match normal {
            Some(k) => (inertia[(k, k)], 1.0),
            None => (inertia.trace(), 2.0),
        };
        let (of_anchors, radius) =
            (times * platform.mass * distance * distance, (moment / times / platform.mass).sqrt());
        (distance >= TOGETHER).then_some(Self { moment, of_anchors, radius, distance })
    }

    /// Whether `times` the inertia is usual of such a platform.
    pub fn is_usual(&self, times: f64) -> bool {
        USUAL.contains(&(times * self.moment / self.of_anchors))
    }

    /// Least and greatest usual moment [kg m²].
    pub fn usual(&self) -> [f64; 2] {
        [USUAL.start, USUAL.end].map(|ratio| ratio * self.of_anchors)
    }
}
