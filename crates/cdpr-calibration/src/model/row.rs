//! The state of a row: where it begins, and how it follows the unknowns.
//!
//! With stiff cables a change of a length by millimetres makes cables slack, and a slack cable shows no
//! tension to return by. A row is therefore moved in its pose and its tensions, which change smoothly with
//! everything: the step predicts both, and the lengths follow from them. Where a cable's own weight decides
//! its shape, its length is moved instead.

use crate::campaign::{Quantity, Row};
use crate::error::CalibrationError;
use crate::model::{Model, RowAt, RowState};
use crate::sensor_error::SensorError;
use cdpr_robot::{Axis, CableEnd, Pose, Robot, Rotation3, UnitQuaternion, Vector3};
use cdpr_statics::{
    DirectProblem, DirectStart, Equilibrium, Load, PoseLengths, StaticsError, inverse, lengths_for_tensions,
    rough_pose,
};
use nalgebra::DVector;

/// A cable with this many times its own weight as tension is moved by its tension.
const TAUT: f64 = 5.0;

/// Share of a tension that a step leaves at least, while it is above [`SMALL`] of the greatest.
const LEAST_LEFT: f64 = 0.1;

/// Share of the greatest tension below which a cable may lose all of its own in one step.
const SMALL: f64 = 1e-2;

/// Tension of a cable between taut and slack, over the greatest: far above rounding, and without effect.
const HARDLY_TAUT: f64 = 1e-7;

/// The tension of a cable between taut and slack [N]. A cable without weight has a kink there, at which a row
/// may be at its best: its derivatives are those of the taut cable.
fn hardly_taut(tensions: &[f64]) -> f64 {
    HARDLY_TAUT * tensions.iter().copied().fold(0.0, f64::max)
}

impl RowState {
    /// Cables with hardly any tension whose lengths were read as shorter yet.
    pub(crate) fn between_taut_and_slack(&self) -> Vec<usize> {
        let tensions = self.loaded.tensions();
        let least = 2.0 * hardly_taut(&tensions);
        let is = |i: &usize| self.errors[*i] <= 0.0 && tensions[*i] > 0.0 && tensions[*i] <= least;
        (0..self.errors.len()).filter(is).collect()
    }
}

impl Model<'_> {
    /// The state of a row where the search begins: at the lengths that were read or, where the robot does
    /// not rest with them, with taut cables. With cables that are all a little too long nothing holds the
    /// platform in a plane.
    pub(crate) fn begin(&self, row: &Row, x: &[f64]) -> Result<RowState, CalibrationError> {
        self.as_read(row, x).or_else(|error| {
            let taut = || {
                let robot = self.deviating(x).ok()?;
                let rough = || Some(self.rough(&robot, &self.lengths(&self.unplaced(row, &robot).ok()?, x)));
                self.taut(row, x, &self.pose_in_base(row).or_else(rough)?).ok()
            };
            taut().ok_or(error)
        })
    }

    /// The state of a row with the lengths that were read, without errors.
    pub(crate) fn as_read(&self, row: &Row, x: &[f64]) -> Result<RowState, CalibrationError> {
        let robot = self.deviating(x).map_err(CalibrationError::row(row.line))?;
        let state = self.unplaced(row, &robot)?;
        let lengths = self.lengths(&state, x);
        let placed = |near: &Pose| self.placed(row, &robot, state.clone(), &lengths, DirectStart::Pose(near));
        let measured = self.pose_in_base(row).and_then(|near| placed(&near).ok());
        measured
            .map_or_else(|| placed(&self.rough(&robot, &lengths)), Ok)
            .map_err(CalibrationError::row(row.line))
    }

    /// The state of a row whose lengths have errors, at the tensions that were measured or, without them,
    /// those of the inverse model.
    pub(crate) fn taut(&self, row: &Row, x: &[f64], near: &Pose) -> Result<RowState, CalibrationError> {
        let at = CalibrationError::row(row.line);
        let robot = self.deviating(x).map_err(&at)?;
        let state = self.unplaced(row, &robot)?;
        if state.errors.is_empty() {
            let reason = "its lengths are exact: they cannot follow from tensions".to_owned();
            return Err(CalibrationError::Incomplete { line: row.line, reason });
        }
        let measured = |i: usize| {
            let ends = [CableEnd::Anchor, CableEnd::Exit];
            let read = ends.into_iter().find_map(|end| row.value(Quantity::Tension(i, end)))?;
            let tension = (read - self.of(SensorError::TensionBias, i, x))
                / (1.0 + self.of(SensorError::TensionGain, i, x));
            (tension > 0.0).then_some(tension)
        };
        let tensions: Option<Vec<f64>> = (0..robot.cables.len()).map(measured).collect();
        let tensions = match tensions {
            Some(tensions) => tensions,
            None => inverse(&robot, near, &self.load(row, &robot)).map_err(&at)?.tensions,
        };
        let held = lengths_for_tensions(&robot, near, &tensions).map_err(&at)?;
        self.rested(row, &robot, x, state, held).map_err(&at)
    }

    /// A row without its equilibrium.
    fn unplaced(&self, row: &Row, robot: &Robot) -> Result<RowState, CalibrationError> {
        let n = robot.cables.len();
        let (read, errors) = match &row.lengths {
            Some(read) => {
                let noisy = row.length_std.iter().any(|std| *std > 0.0);
                (read.clone(), if noisy { vec![0.0; n] } else { Vec::new() })
            }
            None => {
                let Some(pose) = self.measured_pose(row) else {
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
                let held = held_lengths(robot, &pose).map_err(CalibrationError::row(row.line))?;
                (held, vec![0.0; n])
            }
        };
        let nowhere = Equilibrium { pose: Pose::at(0.0, 0.0, 0.0), cable_forces: Vec::new() };
        let is_displaced = row.readings.iter().any(|of| matches!(of.quantity, Quantity::Displacement(_)));
        let unloaded = is_displaced.then(|| nowhere.clone());
        Ok(RowState { errors, ..RowState::new(read, nowhere, unloaded) })
    }

    /// The state at rest with these lengths.
    fn placed(
        &self,
        row: &Row,
        robot: &Robot,
        mut state: RowState,
        lengths: &[f64],
        start: DirectStart,
    ) -> Result<RowState, StaticsError> {
        let rest = |load: &Load, start: DirectStart| {
            let problem = DirectProblem::new(robot, lengths, load)?;
            problem.direct(start).map(|found| found.equilibrium)
        };
        state.loaded = rest(&self.load(row, robot), start)?;
        if let Some(before) = &state.unloaded {
            let load = self.without_load(row, robot);
            let is_new = before.cable_forces.is_empty();
            let near = if is_new { DirectStart::Pose(&state.loaded.pose) } else { DirectStart::Near(before) };
            state.unloaded = Some(rest(&load, near)?);
        }
        Ok(state)
    }

    /// The state at rest with the lengths of a pose that need not be in balance; the errors of its lengths
    /// follow from them.
    fn rested(
        &self,
        row: &Row,
        robot: &Robot,
        x: &[f64],
        mut state: RowState,
        held: PoseLengths,
    ) -> Result<RowState, StaticsError> {
        let exact = self.readings(&held.lengths, x);
        state.errors = state.read.iter().zip(exact).map(|(read, exact)| read - exact).collect();
        self.placed(row, robot, state, &held.lengths, DirectStart::Near(&held.equilibrium))
    }

    /// The pose that is measured, level where only the position is.
    pub(crate) fn measured_pose(&self, row: &Row) -> Option<Pose> {
        let of_plane = |axis: Axis| self.plane.filter(|(k, _)| *k == axis.index()).map(|(_, at)| at);
        let [x, y, z] = Axis::ALL.map(|axis| row.value(Quantity::Position(axis)).or_else(|| of_plane(axis)));
        let angle = |k| row.value(Quantity::Angle(k)).unwrap_or(0.0);
        let rotation =
            row.rotation.unwrap_or_else(|| Rotation3::from_euler_angles(angle(0), angle(1), angle(2)));
        Some(Pose { position: Vector3::new(x?, y?, z?), rotation })
    }

    /// The same, unless it is in the frame of an unknown tracker, where it is of no help. What the robot
    /// cannot do is left out: a planar robot stays in its plane, and a point mass does not rotate.
    fn pose_in_base(&self, row: &Row) -> Option<Pose> {
        let pose = self.measured_pose(row).filter(|_| self.unknowns.sensor(SensorError::Frame).is_none())?;
        Some(self.in_plane(pose))
    }

    /// The pose that the lengths alone lead to.
    pub(crate) fn by_lengths(&self, row: &Row, x: &[f64]) -> Result<Pose, CalibrationError> {
        let at = CalibrationError::row(row.line);
        let robot = self.deviating(x).map_err(&at)?;
        let state = self.unplaced(row, &robot)?;
        let lengths = self.lengths(&state, x);
        let start = self.rough(&robot, &lengths);
        let state = self.placed(row, &robot, state, &lengths, DirectStart::Pose(&start)).map_err(&at)?;
        Ok(*state.pose())
    }

    fn rough(&self, robot: &Robot, lengths: &[f64]) -> Pose {
        self.in_plane(rough_pose(robot, lengths))
    }

    fn in_plane(&self, mut pose: Pose) -> Pose {
        let freedoms = self.robot.freedoms();
        if freedoms.are_all() {
            return pose;
        }
        if let Some((normal, at)) = self.plane {
            pose.position[normal] = at;
        }
        let turn = UnitQuaternion::from_rotation_matrix(&pose.rotation).scaled_axis();
        let free = Vector3::from_fn(|k, _| if freedoms.contains(3 + k) { turn[k] } else { 0.0 });
        pose.rotation = Rotation3::new(free);
        pose
    }

    /// Follows a row to other unknowns, with these errors of its lengths.
    pub(crate) fn follow(
        &self,
        at: &RowAt,
        from: &RowState,
        errors: Vec<f64>,
    ) -> Result<RowState, StaticsError> {
        let state = RowState { errors, ..from.clone() };
        let lengths = self.lengths(&state, &at.shared.x);
        self.placed(at.row, at.robot, state, &lengths, DirectStart::Near(&from.loaded))
    }

    /// Follows a row to other unknowns by a predicted change of its pose (dp, dφ) and of its tensions; cables
    /// that are not taut get the lengths that these errors give, but no more than hardly any tension. `None`
    /// where there is no length to follow.
    pub(crate) fn follow_tensions(
        &self,
        at: &RowAt,
        from: &RowState,
        errors: &[f64],
        change: &DVector<f64>,
    ) -> Option<RowState> {
        let (robot, x) = (at.robot, &at.shared.x[..]);
        let before = self.lengths(from, x);
        let tensions = from.loaded.tensions();
        let weight = |i: usize| before[i] * robot.cable(i).weight_per_length;
        let is_taut = |i: usize| tensions[i] > 0.0 && tensions[i] > TAUT * weight(i);
        if errors.is_empty() || !(0..tensions.len()).any(is_taut) {
            return None;
        }
        let motion = |k: usize| Vector3::new(change[k], change[k + 1], change[k + 2]);
        let pose = from.loaded.pose.moved(motion(0), motion(3));
        let least = hardly_taut(&tensions);
        let floor = |tension: f64| {
            if tension * HARDLY_TAUT > SMALL * least { LEAST_LEFT * tension } else { least }
        };
        let moved: Vec<f64> =
            (0..tensions.len()).map(|i| (tensions[i] + change[6 + i]).max(floor(tensions[i]))).collect();
        let mut held = lengths_for_tensions(robot, &pose, &moved).ok()?;
        let state = RowState { errors: errors.to_vec(), ..from.clone() };
        // A cable without weight does not become taut by more than that.
        let is_slack = |i: usize, length: f64| weight(i) > least || length > held.lengths[i];
        let slack: Vec<(usize, f64)> = self.lengths(&state, x).into_iter().enumerate().collect();
        let slack = slack.into_iter().filter(|(i, length)| !is_taut(*i) && is_slack(*i, *length));
        for (i, length) in slack.collect::<Vec<_>>() {
            held.lengths[i] = length;
            held.equilibrium.cable_forces[i] = from.loaded.cable_forces[i];
        }
        self.rested(at.row, robot, x, state, held).ok()
    }
}

/// Unstrained lengths that hold a robot at a pose [m] or, where it has too few cables for that, those whose
/// tensions carry its weight together.
pub(crate) fn held_lengths(robot: &Robot, pose: &Pose) -> Result<Vec<f64>, StaticsError> {
    if robot.is_fully_actuated() {
        return inverse(robot, pose, &Load::none()).map(|held| held.lengths);
    }
    let n = robot.cables.len();
    let each = robot.weight(pose, 0.0).force.norm() / n as f64;
    lengths_for_tensions(robot, pose, &vec![each; n]).map(|held| held.lengths)
}
