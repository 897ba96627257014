//! What all models share: loads, equilibria, and a cable in space.

use crate::error::StaticsError;
use cdpr_cable::{Cable, Catenary};
use cdpr_robot::{Pose, Robot, Vector2, Vector3, Wrench};

/// What acts on the platform besides its own weight and the cables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Mass added at the platform's centre of mass [kg].
    pub payload: f64,
    /// Wrench of constant components in the base frame, about P [N, N m].
    pub wrench: Wrench,
}

impl Load {
    /// Nothing but the platform's own weight.
    pub fn none() -> Self {
        Self { payload: 0.0, wrench: Wrench::zero() }
    }

    /// A mass [kg] added at the platform's centre of mass.
    pub fn payload(mass: f64) -> Self {
        Self { payload: mass, ..Self::none() }
    }

    /// Force and moment [N, N m].
    pub fn wrench(wrench: Wrench) -> Self {
        Self { wrench, ..Self::none() }
    }

    /// All that acts on the platform but the cables: weight and load, about P [N, N m].
    pub(crate) fn total(&self, robot: &Robot, pose: &Pose) -> Wrench {
        robot.weight(pose, self.payload) + self.wrench
    }

    pub(crate) fn validate(&self) -> Result<(), StaticsError> {
        let invalid = |field: &str, value: f64, expected: &str| {
            Err(StaticsError::Invalid {
                field: format!("load.{field}"),
                value: value.to_string(),
                expected: expected.to_owned(),
            })
        };
        if !self.payload.is_finite() {
            return invalid("payload", self.payload, "a finite mass [kg]");
        }
        match self.wrench.to_vector().iter().find(|component| !component.is_finite()) {
            Some(component) => invalid("wrench", *component, "finite components [N, N m]"),
            None => Ok(()),
        }
    }
}

/// A pose with the force on every cable at its anchor point.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// Pose of the platform.
    pub pose: Pose,
    /// Force `(fx, fz)` on each cable at A, in the cable's vertical plane [N]; the platform receives the opposite.
    pub cable_forces: Vec<Vector2<f64>>,
}

impl Equilibrium {
    /// Tension of every cable at the platform [N].
    pub fn tensions(&self) -> Vec<f64> {
        self.cable_forces.iter().map(Vector2::norm).collect()
    }
}

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

/// A robot with wound-out cables and a load: the direct problem.
pub(crate) struct Model<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) lengths: &'a [f64],
    pub(crate) load: &'a Load,
}

impl<'a> Model<'a> {
    pub(crate) fn new(robot: &'a Robot, lengths: &'a [f64], load: &'a Load) -> Result<Self, StaticsError> {
        StaticsError::one_per_cable("lengths", lengths, robot.cables.len())?;
        for (i, length) in lengths.iter().enumerate() {
            if !(length.is_finite() && *length > 0.0) {
                return Err(StaticsError::Invalid {
                    field: format!("lengths[{i}]"),
                    value: length.to_string(),
                    expected: "a finite, positive unstrained length [m]".to_owned(),
                });
            }
        }
        load.validate()?;
        Ok(Self { robot, lengths, load })
    }

    pub(crate) fn cables(&self) -> usize {
        self.lengths.len()
    }

    pub(crate) fn cable(&self, i: usize) -> Cable<'a> {
        self.robot.cable(i)
    }

    pub(crate) fn span(&self, pose: &Pose, i: usize) -> Span {
        Span::new(self.robot.span(pose, i))
    }

    /// The same, for a known arm `R a_i`.
    pub(crate) fn span_at(&self, pose: &Pose, i: usize, arm: &Vector3<f64>) -> Span {
        Span::new(pose.position + arm - self.robot.cables[i].exit_point)
    }

    pub(crate) fn catenary(&self, i: usize, force: Vector2<f64>) -> Catenary<'a> {
        Catenary { cable: self.cable(i), unstrained_length: self.lengths[i], force }
    }

    /// A length of the robot's own size, to measure errors of position by [m].
    pub(crate) fn size(&self) -> f64 {
        self.lengths.iter().fold(0.0, |size: f64, length| size.max(*length))
    }

    /// Length that makes rotations comparable with translations [m].
    pub(crate) fn arm(&self) -> f64 {
        self.robot.platform_size().max(1e-3 * self.size())
    }
}
