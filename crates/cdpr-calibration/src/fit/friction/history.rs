//! A history of wheels in a table of measurements.
//!
//! The rows are one history, in their order. Where they have no position, the winches stand still at one pose
//! while the load changes, and a wheel slips or sticks by (F3); where they have positions, the winches drive
//! from row to row, and a wheel slips the way in which its cable runs. The first row is where the history
//! begins, and is not compared.
//!
//! The tension T0 at the wheel is that measured at the platform, brought to the leave point by what the cable
//! weighs. Without load cells there it is the model's. At one pose that is the whole history with (F4), from
//! tensions that are the nearest to those of the winches in the first row; where the winches drive, only
//! robots without a choice of tensions have one.

use crate::campaign::{Quantity, Row};
use crate::error::CalibrationError;
use crate::model::Model;
use crate::table::Measurements;
use crate::unknowns::Unknowns;
use cdpr_robot::{Axis, CableEnd, Coordinate, Pose, Robot, Vector3};
use cdpr_statics::hysteresis::{LoadHistory, PulleyFriction};
use cdpr_statics::{Load, WantedPose};
use serde::Serialize;

/// Change of a cable's length [m] up to which its winch has not moved.
const STANDS: f64 = 1e-4;

/// Times that tensions at the platform are corrected by the weight of the cables: it hardly depends on them.
const ROUNDS: usize = 3;

/// A tension at a winch as it is measured and as the model has it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WinchResidual {
    /// Line in the file, or number of the row.
    pub line: usize,
    /// Number of the cable, from 1.
    pub cable: usize,
    /// Tension at the platform's side of the wheel [N].
    pub platform_n: f64,
    /// Tension measured at the winch [N].
    pub measured_n: f64,
    /// Tension at the winch by the model [N].
    pub modelled_n: f64,
    /// 1 where cable runs towards the winch, -1 towards the platform, 0 where the wheel sticks.
    pub slip: i8,
}

/// Measurements as a history of wheels.
pub(super) struct History<'a> {
    robot: &'a Robot,
    rows: &'a [Row],
    loads: Vec<Load>,
    /// The pose of each row, or that of the first one alone.
    poses: Vec<Pose>,
    free: &'a [Coordinate],
    /// Tensions at the platform that the first row is nearest to [N], where the robot has a choice.
    reference: Option<Vec<f64>>,
    /// Cables that are compared.
    pub(super) cables: Vec<usize>,
    /// The wheels without friction, where their tensions at the platform do not depend on it.
    still: Option<Vec<State>>,
}

/// The wheels in a row.
pub(super) struct State {
    pub(super) wheels: Vec<Wheel>,
    /// Lengths [m].
    lengths: Vec<f64>,
    position: Vector3<f64>,
}

/// A cable on its wheel.
#[derive(Clone, Copy)]
pub(super) struct Wheel {
    /// Wrap [rad].
    pub(super) wrap: f64,
    /// Tension at the anchor point, where the cable leaves the wheel, and at the winch [N].
    anchor: f64,
    leave: f64,
    winch: f64,
    slip: f64,
}

impl<'a> History<'a> {
    pub(super) fn new(
        robot: &'a Robot,
        measured: &'a Measurements,
        pose: Option<&Pose>,
        free: &'a [Coordinate],
    ) -> Result<Self, CalibrationError> {
        let rows = &measured.rows[..];
        rows.iter().try_for_each(Row::check)?;
        let cables = compared(robot, rows)?;
        let unknowns = Unknowns::sought(robot, None, &["none"], &[])?;
        let model = Model::new(robot, &unknowns, rows);
        let poses = poses(&model, rows, pose)?;
        let loads: Vec<Load> = rows.iter().map(|row| model.load(row, robot)).collect();
        let of_platform =
            |i: &usize| rows.iter().any(|row| row.value(tension(*i, CableEnd::Anchor)).is_some());
        let mut history = Self { robot, rows, loads, poses, free, reference: None, cables, still: None };
        history.check(measured.noise_is_stated)?;
        history.reference = history.first_tensions()?;
        let measured: Vec<usize> = history.cables.iter().copied().filter(of_platform).collect();
        if !measured.is_empty() {
            history.cables = measured;
            let mut still = history.modelled(PulleyFriction::default())?;
            history.put_measured(&mut still)?;
            history.still = Some(still);
        } else if history.drives() {
            if robot.cables.len() > robot.freedoms().count() {
                let expected =
                    "tensions at the platform: a pose alone does not determine those of this robot";
                let column = format!("t{}_n is missing", history.cables[0] + 1);
                return Err(CalibrationError::Column { column, expected: expected.to_owned() });
            }
            history.still = Some(history.modelled(PulleyFriction::default())?);
        }
        Ok(history)
    }

    fn check(&self, noise_is_stated: bool) -> Result<(), CalibrationError> {
        if !self.drives() && self.loads.iter().all(|load| *load == self.loads[0]) {
            let expected = "two loads or more (payload_kg, mass_kg, fx_n ...), or the position of every row";
            let value = format!("{} in every row", self.loads[0].payload);
            return Err(CalibrationError::invalid("payload_kg", value, expected));
        }
        let displaced = Axis::ALL.map(Quantity::Displacement);
        let is_displaced = |row: &Row| displaced.iter().any(|of| row.value(*of).is_some());
        if self.rows.iter().any(is_displaced) && !noise_is_stated {
            let expected = "the noise of tensions and displacements, such as tension=1 and displacement=1e-5";
            return Err(CalibrationError::invalid("noise", "not stated", expected));
        }
        Ok(())
    }

    /// Whether the winches move between the rows.
    fn drives(&self) -> bool {
        self.poses.len() > 1
    }

    /// The tensions at the platform that belong to those of the winches in the first row, if all are read:
    /// less by what each cable weighs between its wheel and the platform.
    fn first_tensions(&self) -> Result<Option<Vec<f64>>, CalibrationError> {
        let n = self.robot.cables.len();
        let winch = |i: usize| self.rows[0].value(tension(i, CableEnd::Exit));
        let winches: Vec<f64> = (0..n).filter_map(winch).collect();
        if self.drives() || !self.free.is_empty() || winches.len() < n {
            return Ok(None);
        }
        let mut reference = winches.clone();
        for _ in 0..ROUNDS {
            let wanted = WantedPose::at(&self.poses[0]).tension_reference(&reference);
            let first = LoadHistory::begin(self.robot, wanted, &self.loads[0], PulleyFriction::default())
                .map_err(CalibrationError::row(self.rows[0].line))?;
            let anchors = first.now.solution.equilibrium.tensions();
            for (i, at) in first.now.pulleys.iter().enumerate() {
                reference[i] = winches[i] - (at.tension - anchors[i]);
            }
        }
        Ok(Some(reference))
    }

    /// The wheels of each row by the model alone.
    fn modelled(&self, friction: PulleyFriction) -> Result<Vec<State>, CalibrationError> {
        let begin = |k: usize| {
            let wanted = WantedPose::at(&self.poses[k]).free(self.free);
            let wanted = match &self.reference {
                Some(reference) => wanted.tension_reference(reference),
                None => wanted,
            };
            LoadHistory::begin(self.robot, wanted, &self.loads[k], friction)
        };
        let mut states = Vec::with_capacity(self.rows.len());
        let at = |k: usize| CalibrationError::row(self.rows[k].line);
        let mut history = begin(0).map_err(at(0))?;
        for (k, row) in self.rows.iter().enumerate() {
            if k > 0 && self.drives() {
                history = begin(k).map_err(at(k))?;
            } else if k > 0 {
                history.follow(&self.loads[k]).map_err(at(k))?;
            }
            let equilibrium = &history.now.solution.equilibrium;
            let wheels = history.now.pulleys.iter().zip(equilibrium.tensions()).map(|(of, anchor)| Wheel {
                wrap: of.wrap,
                anchor,
                leave: of.tension,
                winch: of.winch_tension,
                slip: of.slip,
            });
            states.push(State {
                wheels: wheels.collect(),
                lengths: row.lengths.clone().unwrap_or_else(|| history.lengths.clone()),
                position: equilibrium.pose.position,
            });
        }
        Ok(states)
    }

    /// Puts the tensions that are measured at the platform into the states.
    fn put_measured(&self, states: &mut [State]) -> Result<(), CalibrationError> {
        for (row, state) in self.rows.iter().zip(states) {
            for &i in &self.cables {
                let Some(measured) = row.value(tension(i, CableEnd::Anchor)) else {
                    let reason =
                        format!("column t{}_n is empty: expected a tension in every row, or in none", i + 1);
                    return Err(CalibrationError::Incomplete { line: row.line, reason });
                };
                let wheel = &mut state.wheels[i];
                wheel.leave += measured - wheel.anchor;
                wheel.anchor = measured;
            }
        }
        Ok(())
    }

    /// The wheels of each row with friction.
    pub(super) fn states(&self, friction: PulleyFriction) -> Result<Vec<State>, CalibrationError> {
        let Some(still) = &self.still else { return self.modelled(friction) };
        let mut states: Vec<State> = Vec::with_capacity(still.len());
        for (k, at) in still.iter().enumerate() {
            let mut wheels = at.wheels.clone();
            for &i in &self.cables {
                let wheel = &mut wheels[i];
                let [least, most] = [-1.0, 1.0].map(|slip| wheel.leave * friction.ratio(wheel.wrap, slip));
                let began = || self.rows[0].value(tension(i, CableEnd::Exit)).unwrap_or(wheel.leave);
                let before = states.last().map_or_else(began, |state: &State| state.wheels[i].winch);
                let paid_out = if k > 0 { at.lengths[i] - still[k - 1].lengths[i] } else { 0.0 };
                (wheel.winch, wheel.slip) = match paid_out {
                    _ if k == 0 => (before, 0.0),
                    longer if self.drives() && longer > STANDS => (least, -1.0),
                    longer if self.drives() && longer < -STANDS => (most, 1.0),
                    _ if before <= least => (least, -1.0),
                    _ if before >= most => (most, 1.0),
                    _ => (before, 0.0),
                };
            }
            states.push(State { wheels, lengths: at.lengths.clone(), position: at.position });
        }
        Ok(states)
    }

    /// The readings that are compared, at states.
    pub(super) fn readings(&self, states: &[State]) -> Vec<WinchResidual> {
        let rows = self.rows.iter().zip(states).skip(1);
        let of_row = rows.flat_map(|(row, state)| {
            self.cables.iter().filter_map(|&i| {
                let (wheel, measured_n) = (state.wheels[i], row.value(tension(i, CableEnd::Exit))?);
                Some(WinchResidual {
                    line: row.line,
                    cable: i + 1,
                    platform_n: wheel.leave,
                    measured_n,
                    modelled_n: wheel.winch,
                    slip: if wheel.slip.abs() == 1.0 { wheel.slip as i8 } else { 0 },
                })
            })
        });
        of_row.collect()
    }

    /// Measured less modelled tensions, then displacements in units of a tension with the same noise [N].
    pub(super) fn residuals(&self, friction: PulleyFriction) -> Result<Vec<f64>, CalibrationError> {
        let states = self.states(friction)?;
        let readings = self.readings(&states);
        let mut residuals: Vec<f64> = readings.iter().map(|of| of.measured_n - of.modelled_n).collect();
        if self.still.is_some() {
            return Ok(residuals);
        }
        let stds = self.rows.iter().flat_map(|row| &row.readings);
        let mut stds = stds.filter(|of| matches!(of.quantity, Quantity::Tension(..))).map(|of| of.std);
        let noise = stds.next().unwrap_or(1.0);
        for (row, state) in self.rows.iter().zip(&states).skip(1) {
            let moved = state.position - states[0].position;
            for reading in &row.readings {
                let Quantity::Displacement(axis) = reading.quantity else { continue };
                let before = self.rows[0].value(reading.quantity).unwrap_or(0.0);
                residuals.push((reading.value - before - moved[axis.index()]) * noise / reading.std);
            }
        }
        Ok(residuals)
    }
}

/// The tension of a cable at one of its ends.
fn tension(i: usize, end: CableEnd) -> Quantity {
    Quantity::Tension(i, end)
}

/// Cables with a pulley whose tension at the winch is measured.
fn compared(robot: &Robot, rows: &[Row]) -> Result<Vec<usize>, CalibrationError> {
    let n = robot.cables.len();
    let has_pulley = |i: &usize| robot.cables[*i].pulley.is_some_and(|pulley| pulley.radius > 0.0);
    let is_read = |i: &usize| rows.iter().any(|row| row.value(tension(*i, CableEnd::Exit)).is_some());
    let Some(first) = (0..n).find(has_pulley) else {
        let expected = "a robot with a `pulley` of one of its cables with a radius";
        return Err(CalibrationError::invalid("pulley", "missing at every cable", expected));
    };
    let cables: Vec<usize> = (0..n).filter(has_pulley).filter(is_read).collect();
    if cables.is_empty() {
        let expected = "tensions at the winches of cables with pulleys".to_owned();
        return Err(CalibrationError::Column {
            column: format!("t{}_winch_n is missing", first + 1),
            expected,
        });
    }
    Ok(cables)
}

/// The measured pose of each row, or the one that is given.
fn poses(model: &Model, rows: &[Row], given: Option<&Pose>) -> Result<Vec<Pose>, CalibrationError> {
    let has_position =
        |row: &Row| Axis::ALL.iter().any(|axis| row.value(Quantity::Position(*axis)).is_some());
    match (given, rows.iter().find(|row| has_position(row))) {
        (Some(pose), None) => Ok(vec![*pose]),
        (Some(_), Some(row)) => {
            let value = format!("given, and line {} has a position", row.line);
            Err(CalibrationError::invalid("pose", value, "one of them"))
        }
        (None, None) => {
            let expected = "that of the platform under the first load, or the position of every row";
            Err(CalibrationError::invalid("pose", "missing", expected))
        }
        (None, Some(_)) => {
            let of_row = |row: &Row| {
                let reason = "expected the position (x_m, y_m, z_m) of every row, or of none".to_owned();
                model.measured_pose(row).ok_or(CalibrationError::Incomplete { line: row.line, reason })
            };
            rows.iter().map(of_row).collect()
        }
    }
}
