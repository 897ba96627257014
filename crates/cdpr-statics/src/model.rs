//! The direct problem: a robot with its unstrained lengths and a load, checked.

use crate::error::StaticsError;
use crate::state::Load;
use cdpr_cable::{Cable, Catenary};
use cdpr_robot::{Robot, Vector2};

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

impl Load {
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
