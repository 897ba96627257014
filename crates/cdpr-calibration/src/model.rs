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
mod pull;
mod read;

use crate::campaign::{Quantity, Row};
use crate::error::CalibrationError;
use crate::unknowns::{SensorError, Unknowns};
use cdpr_robot::{Axis, ParameterLayout, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{
    DirectProblem, Equilibrium, Load, Start, StaticsError, inverse, lengths_for_tensions, rough_pose,
};

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
    /// Unknowns of the row.
    pub(crate) fn own(&self) -> &[f64] {
        &self.errors
    }

    /// The pose under the load.
    pub(crate) fn pose(&self) -> &Pose {
        &self.loaded.pose
    }
}

/// The model of a campaign.
pub(crate) struct Model<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) unknowns: &'a Unknowns,
    pub(super) layout: ParameterLayout,
}

impl<'a> Model<'a> {
    pub(crate) fn new(robot: &'a Robot, unknowns: &'a Unknowns) -> Self {
        Self { robot, unknowns, layout: ParameterLayout::of(robot) }
    }

    /// The robot with its deviations.
    pub(crate) fn deviating(&self, x: &[f64]) -> Result<Robot, StaticsError> {
        let deviations = self.unknowns.deviations(self.layout.count(), x);
        Ok(self.robot.perturbed(&deviations)?.robot)
    }

    pub(super) fn of(&self, error: SensorError, k: usize, x: &[f64]) -> f64 {
        self.unknowns.sensor(error).map_or(0.0, |first| x[first + k])
    }

    pub(super) fn slope(&self, error: SensorError, k: usize, value: f64) -> Option<(usize, f64)> {
        self.unknowns.sensor(error).map(|first| (first + k, value))
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

    pub(super) fn load(&self, row: &Row, robot: &Robot) -> Load {
        let payload = row.load.payload + row.mass.map_or(0.0, |mass| mass - robot.platform.mass);
        Load { payload, ..row.load }
    }

    pub(super) fn without_load(&self, row: &Row, robot: &Robot) -> Load {
        let mass = row.mass.map_or(0.0, |mass| mass - robot.platform.mass);
        Load::payload(mass)
    }

    /// The state of a row where the search begins.
    pub(crate) fn begin(&self, row: &Row, x: &[f64]) -> Result<RowState, CalibrationError> {
        let at = CalibrationError::row(row.line);
        let robot = self.deviating(x).map_err(&at)?;
        let load = self.load(row, &robot);
        let measured = self.measured_pose(row);
        let is_displaced = row.readings.iter().any(|of| matches!(of.quantity, Quantity::Displacement(_)));
        let n = robot.cables.len();
        let (read, errors) = match &row.lengths {
            Some(read) => {
                let noisy = row.length_std.iter().any(|std| *std > 0.0);
                (read.clone(), if noisy { vec![0.0; n] } else { Vec::new() })
            }
            None => {
                let Some(pose) = measured else {
                    let reason = "neither lengths nor a pose are measured: expected one of them";
                    return Err(CalibrationError::Incomplete { line: row.line, reason: reason.to_owned() });
                };
                if row.readings.len() < n {
                    let reason = format!(
                        "{} numbers are measured for {n} lengths that are not: expected the lengths l1_m.., \
                         or more numbers",
                        row.readings.len()
                    );
                    return Err(CalibrationError::Incomplete { line: row.line, reason });
                }
                // The load bears on lengths that were found without it.
                (held_lengths(&robot, &pose).map_err(&at)?, vec![0.0; n])
            }
        };
        let nowhere = Equilibrium { pose: Pose::at(0.0, 0.0, 0.0), cable_forces: Vec::new() };
        let mut state = RowState { read, errors, loaded: nowhere, unloaded: None };
        let lengths = self.lengths(&state, x);
        let found = |load: &Load, near: Option<&Pose>| -> Result<Equilibrium, StaticsError> {
            let problem = DirectProblem::new(&robot, &lengths, load)?;
            let rough = rough_pose(&robot, &lengths);
            let first = near.map(|pose| problem.direct(Start::Pose(pose)));
            match first {
                Some(Ok(found)) => Ok(found.equilibrium),
                _ => problem.direct(Start::Pose(&rough)).map(|found| found.equilibrium),
            }
        };
        // In the frame of an unknown tracker the measured pose is of no help.
        let near = measured.filter(|_| self.unknowns.sensor(SensorError::Frame).is_none());
        state.loaded = found(&load, near.as_ref()).map_err(&at)?;
        if is_displaced {
            let near = state.loaded.pose;
            state.unloaded = Some(found(&self.without_load(row, &robot), Some(&near)).map_err(&at)?);
        }
        Ok(state)
    }

    /// The pose that is measured, level where only the position is.
    pub(crate) fn measured_pose(&self, row: &Row) -> Option<Pose> {
        let coordinate = |axis| row.value(Quantity::Position(axis));
        let [x, y, z] = Axis::ALL.map(coordinate);
        let angle = |k| row.value(Quantity::Angle(k)).unwrap_or(0.0);
        let rotation =
            row.rotation.unwrap_or_else(|| Rotation3::from_euler_angles(angle(0), angle(1), angle(2)));
        Some(Pose { position: Vector3::new(x?, y?, z?), rotation })
    }

    /// Follows a row to other unknowns.
    pub(crate) fn follow(
        &self,
        row: &Row,
        from: &RowState,
        robot: &Robot,
        x: &[f64],
        errors: Vec<f64>,
    ) -> Result<RowState, StaticsError> {
        let mut state = RowState { errors, ..from.clone() };
        let lengths = self.lengths(&state, x);
        let rest = |load: &Load, near: &Equilibrium| {
            let problem = DirectProblem::new(robot, &lengths, load)?;
            problem.direct(Start::Near(near)).map(|found| found.equilibrium)
        };
        state.loaded = rest(&self.load(row, robot), &from.loaded)?;
        if let Some(unloaded) = &from.unloaded {
            state.unloaded = Some(rest(&self.without_load(row, robot), unloaded)?);
        }
        Ok(state)
    }
}

/// Unstrained lengths that hold a robot at a pose [m] or, where it has too few cables for that, those whose
/// tensions carry its weight together.
pub(crate) fn held_lengths(robot: &Robot, pose: &Pose) -> Result<Vec<f64>, StaticsError> {
    if robot.is_fully_actuated() {
        return inverse(robot, pose, &Load::none(), None).map(|held| held.lengths);
    }
    let n = robot.cables.len();
    let each = robot.weight(pose, 0.0).force.norm() / n as f64;
    lengths_for_tensions(robot, pose, &vec![each; n]).map(|held| held.lengths)
}
