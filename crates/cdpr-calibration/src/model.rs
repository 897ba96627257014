//! What the sensors would read, and how that depends on the unknowns.
//!
//! The model of a row is the direct model: the robot with its deviations, the lengths that the winches give
//! and the load make the platform rest at a pose, with a force in every cable. With the errors of the sensors
//!
//! ```text
//! L_i = (l_i - o_i - e_i)/(1 + κ_i)       length l read by a winch, offset o, scale κ, noise e       (R1)
//! y   = (1 + σ) Q (p + R m) + q           place of P (m = 0) or of a marker m, in the tracker's frame
//! t   = (1 + γ_i) |F_i| + β_i             load cell of cable i
//! ```
//!
//! Where lengths have noise, their errors e are unknowns of the row with the residual e/std. Where lengths
//! are not measured at all, they are unknowns of the row without residual.

pub(crate) mod compare;
pub(crate) mod held;
pub(crate) mod kink;
pub(crate) mod read;
pub(crate) mod row;
mod tilt;

use crate::campaign::Row;
use crate::model::held::plane_of;
use crate::sensor_error::SensorError;
use crate::unknowns::Unknowns;
use cdpr_robot::{ParameterLayout, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{Equilibrium, Load, StaticsError};

/// What is sought in all rows.
#[derive(Clone, Debug)]
pub(crate) struct Shared {
    /// The unknowns of all rows.
    pub(crate) x: Vec<f64>,
    /// Q: from the base frame to the frame of the tracker.
    pub(crate) frame: Rotation3<f64>,
    /// q where the search began [m].
    pub(crate) origin: Vector3<f64>,
}

/// Where the search stands.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(crate) shared: Shared,
    pub(crate) rows: Vec<RowState>,
}

/// The state of a row.
#[derive(Clone, Debug)]
pub(crate) struct RowState {
    /// Lengths that the winches read or, where they read none, that the search began with [m].
    pub(super) read: Vec<f64>,
    /// e_i [m]; empty where lengths are exact.
    pub(super) errors: Vec<f64>,
    pub(super) loaded: Equilibrium,
    /// Without the load, where a displacement is measured.
    pub(super) unloaded: Option<Equilibrium>,
}

impl RowState {
    /// A row of a robot at rest with the lengths that the winches read.
    pub(crate) fn new(read: Vec<f64>, loaded: Equilibrium, unloaded: Option<Equilibrium>) -> Self {
        Self { read, errors: Vec::new(), loaded, unloaded }
    }

    /// Unknowns of the row.
    pub(crate) fn own(&self) -> &[f64] {
        &self.errors
    }

    /// The pose under the load.
    pub(crate) fn pose(&self) -> &Pose {
        &self.loaded.pose
    }
}

/// A row with all that its state depends on.
#[derive(Clone, Copy)]
pub(crate) struct RowAt<'a> {
    pub(crate) row: &'a Row,
    pub(crate) shared: &'a Shared,
    pub(crate) robot: &'a Robot,
}

/// The model of a campaign.
pub(crate) struct Model<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) unknowns: &'a Unknowns,
    pub(super) layout: ParameterLayout,
    /// Of a planar robot, the axis at right angles to its plane and where P lies along it [m].
    plane: Option<(usize, f64)>,
}

impl<'a> Model<'a> {
    pub(crate) fn new(robot: &'a Robot, unknowns: &'a Unknowns, rows: &[Row]) -> Self {
        let plane = plane_of(robot, unknowns, rows);
        Self { robot, unknowns, layout: ParameterLayout::of(robot), plane }
    }

    /// The same with other unknowns.
    pub(crate) fn seeking<'b>(&self, unknowns: &'b Unknowns) -> Model<'b>
    where
        'a: 'b,
    {
        Model { robot: self.robot, unknowns, layout: ParameterLayout::of(self.robot), plane: self.plane }
    }

    /// The robot with its deviations.
    pub(crate) fn deviating(&self, x: &[f64]) -> Result<Robot, StaticsError> {
        let deviations = self.unknowns.deviations(self.layout.count(), x);
        Ok(self.robot.perturbed(&deviations)?.robot)
    }

    pub(super) fn of(&self, error: SensorError, k: usize, x: &[f64]) -> f64 {
        self.unknowns.sensor(error).map_or(0.0, |first| x[first + k])
    }

    /// Equation (R1).
    pub(super) fn lengths(&self, row: &RowState, x: &[f64]) -> Vec<f64> {
        let length = |(i, read): (usize, &f64)| {
            let error = row.errors.get(i).copied().unwrap_or(0.0);
            (read - self.of(SensorError::LengthOffset, i, x) - error)
                / (1.0 + self.of(SensorError::DrumScale, i, x))
        };
        row.read.iter().enumerate().map(length).collect()
    }

    /// What the winches read of these lengths [m], (R1) without noise.
    pub(crate) fn readings(&self, lengths: &[f64], x: &[f64]) -> Vec<f64> {
        let read = |(i, length): (usize, &f64)| {
            self.of(SensorError::LengthOffset, i, x) + (1.0 + self.of(SensorError::DrumScale, i, x)) * length
        };
        lengths.iter().enumerate().map(read).collect()
    }

    pub(crate) fn load(&self, row: &Row, robot: &Robot) -> Load {
        let payload = row.load.payload + row.mass.map_or(0.0, |mass| mass - robot.platform.mass);
        Load { payload, ..row.load }
    }

    pub(super) fn without_load(&self, row: &Row, robot: &Robot) -> Load {
        let mass = row.mass.map_or(0.0, |mass| mass - robot.platform.mass);
        Load::payload(mass)
    }
}
