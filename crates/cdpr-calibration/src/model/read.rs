//! What a sensor reads, with its derivatives.

use crate::campaign::Quantity;
use crate::model::{Model, RowAt, RowState};
use crate::sensor_error::SensorError;
use cdpr_robot::{
    Axis, CableEnd, Coordinate, Matrix6xX, Pose, Rotation3, TiltAxis, UnitQuaternion, Vector3, Vector6,
};
use cdpr_statics::derivatives::ForceDerivatives;
use cdpr_statics::{DirectProblem, Equilibrium, StaticsError};
use nalgebra::{Matrix3, RowDVector};

/// A row at a state, with the derivatives of the models there.
pub(crate) struct Observed<'a> {
    model: &'a Model<'a>,
    at: &'a RowAt<'a>,
    state: &'a RowState,
    pub(super) lengths: Vec<f64>,
    /// With the forces at the anchor points.
    anchors: ForceDerivatives,
    /// With those at the exit points, where something that is read depends on them.
    exits: Option<ForceDerivatives>,
    /// Without the load, where a displacement is read.
    unloaded: Option<(&'a Equilibrium, ForceDerivatives)>,
}

/// A number that a sensor reads, with its derivatives by everything it may depend on.
pub(crate) struct Read {
    pub(crate) value: f64,
    /// By the inputs of the models and the lengths.
    pub(super) models: RowDVector<f64>,
    /// By errors of sensors.
    pub(super) sensors: Vec<(usize, f64)>,
}

impl Model<'_> {
    /// The models at the state of a row.
    pub(crate) fn observed<'a>(
        &'a self,
        at: &'a RowAt,
        state: &'a RowState,
    ) -> Result<Observed<'a>, StaticsError> {
        let RowAt { row, shared, robot } = *at;
        let lengths = self.lengths(state, &shared.x);
        let problem = DirectProblem::new(robot, &lengths, &self.load(row, robot))?;
        let slopes = |problem: &DirectProblem, equilibrium: &Equilibrium, end: CableEnd| {
            let mut slopes = problem.force_derivatives(equilibrium, end)?;
            self.turn_tilts(robot, &mut slopes);
            Ok::<_, StaticsError>(slopes)
        };
        let is_at_exit =
            |of: Quantity| matches!(of, Quantity::Tension(_, CableEnd::Exit) | Quantity::Swivel(_));
        let exits = !robot.is_linear() || row.readings.iter().any(|reading| is_at_exit(reading.quantity));
        let exits = exits.then(|| slopes(&problem, &state.loaded, CableEnd::Exit)).transpose()?;
        let unloaded = state.unloaded.as_ref().map(|rest| {
            let problem = DirectProblem::new(robot, &lengths, &self.without_load(row, robot))?;
            Ok::<_, StaticsError>((rest, slopes(&problem, rest, CableEnd::Anchor)?))
        });
        let anchors = slopes(&problem, &state.loaded, CableEnd::Anchor)?;
        let unloaded = unloaded.transpose()?;
        Ok(Observed { model: self, at, state, lengths, anchors, exits, unloaded })
    }
}

impl Observed<'_> {
    /// A quantity as the sensor would read it; of a rotation the vector from the measured one, with the
    /// opposite sign.
    pub(crate) fn read(&self, quantity: Quantity) -> Read {
        match quantity {
            Quantity::Position(axis) => self.place(Vector3::zeros(), None, axis),
            Quantity::Marker(marker, axis) => self.marker(marker, axis),
            Quantity::Rotation(axis) => self.rotation(axis),
            Quantity::Angle(k) => self.angle(k),
            Quantity::Displacement(axis) => self.displacement(axis),
            Quantity::Tension(i, end) => self.load_cell(i, end),
            Quantity::Swivel(i) => self.swivel(i),
            Quantity::Length(_) => self.nothing(),
        }
    }

    /// Derivatives of the pose by the inputs of the models and the lengths.
    pub(super) fn motion(&self) -> &Matrix6xX<f64> {
        &self.anchors.pose
    }

    /// Tension of a cable at one of its ends [N], with its derivatives by the inputs of the models and the
    /// lengths; zero at an exit point where nothing is read.
    pub(super) fn tension(&self, i: usize, end: CableEnd) -> (f64, RowDVector<f64>) {
        let forces = if end.is_anchor() { Some(&self.anchors) } else { self.exits.as_ref() };
        let Some(forces) = forces else { return (0.0, self.nothing().models) };
        let force = forces.forces[i];
        let direction = force.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
        (force.norm(), direction.transpose() * forces.per_input.fixed_rows::<3>(3 * i))
    }

    fn pose(&self) -> &Pose {
        &self.state.loaded.pose
    }

    /// Number `k` of an error of the sensors.
    fn error(&self, error: SensorError, k: usize) -> f64 {
        self.model.of(error, k, &self.at.shared.x)
    }

    /// Derivatives by an error of the sensors, from its number `first` on, if it is sought.
    fn by(&self, error: SensorError, first: usize, slopes: &[f64]) -> Vec<(usize, f64)> {
        let start = self.model.unknowns.sensor(error);
        start.into_iter().flat_map(|start| (start + first..).zip(slopes.iter().copied())).collect()
    }

    fn nothing(&self) -> Read {
        Read { value: 0.0, models: RowDVector::zeros(self.motion().ncols()), sensors: Vec::new() }
    }

    /// A coordinate of a vector [m] of the base frame as the tracker sees it, its derivative by the vector,
    /// and those by the errors of the tracker.
    fn seen(&self, vector: Vector3<f64>, axis: Axis) -> (f64, Vector3<f64>, Vec<(usize, f64)>) {
        let (frame, unit) = (self.at.shared.frame, Vector3::ith(axis.index(), 1.0));
        let (seen, scale) = (frame * vector, 1.0 + self.error(SensorError::FrameScale, 0));
        let mut sensors = self.by(SensorError::FrameScale, 0, &[seen.dot(&unit)]);
        sensors.extend(self.by(SensorError::Frame, 3, (seen.cross(&unit) * scale).as_slice()));
        (scale * seen.dot(&unit), frame.inverse() * unit * scale, sensors)
    }

    /// A coordinate of a place on the platform in the frame of the tracker. `unknown` is the index of its
    /// first coordinate, if it is sought.
    fn place(&self, place: Vector3<f64>, unknown: Option<usize>, axis: Axis) -> Read {
        let (pose, k) = (self.pose(), axis.index());
        let arm = pose.rotation * place;
        let (seen, per_place, mut sensors) = self.seen(pose.position + arm, axis);
        sensors.extend(self.by(SensorError::Frame, k, &[1.0]));
        if let Some(first) = unknown {
            sensors.extend((first..).zip((pose.rotation.inverse() * per_place).iter().copied()));
        }
        let value = seen + self.at.shared.origin[k] + self.error(SensorError::Frame, k);
        Read { value, models: by_motion(per_place, arm.cross(&per_place), self.motion()), sensors }
    }

    fn marker(&self, marker: usize, axis: Axis) -> Read {
        let unknowns = self.model.unknowns;
        let thought = unknowns.markers.get(marker).copied().unwrap_or_else(Vector3::zeros);
        let moved = Vector3::from([0, 1, 2].map(|k| self.error(SensorError::Markers, 3 * marker + k)));
        let first = unknowns.sensor(SensorError::Markers).map(|first| first + 3 * marker);
        self.place(thought + moved, first, axis)
    }

    /// A number that changes by `per_turn` with a turn of the platform about the axes of the tracker.
    fn turned(&self, value: f64, per_turn: Vector3<f64>) -> Read {
        let in_base = self.at.shared.frame.inverse() * per_turn;
        Read {
            value,
            models: by_motion(Vector3::zeros(), in_base, self.motion()),
            sensors: self.by(SensorError::Frame, 3, per_turn.as_slice()),
        }
    }

    fn rotation(&self, axis: Axis) -> Read {
        let measured = self.at.row.rotation.unwrap_or_else(Rotation3::identity);
        let relative = measured * (self.at.shared.frame * self.pose().rotation).inverse();
        let vector = UnitQuaternion::from_rotation_matrix(&relative).scaled_axis();
        // log(exp(r) exp(-dφ)) = r - J⁻¹ dφ, and J⁻¹ Q turns (dφ) of the base frame.
        let slope = inverse_of_right(&vector).row(axis.index()).transpose();
        self.turned(-vector[axis.index()], slope)
    }

    fn angle(&self, k: usize) -> Read {
        let (roll, pitch, yaw) = (self.at.shared.frame * self.pose().rotation).euler_angles();
        let columns = Coordinate::ALL.map(|coordinate| coordinate.motion(yaw, pitch));
        let turns = Matrix3::from_columns(&[3, 4, 5].map(|c| columns[c].fixed_rows::<3>(3).into_owned()));
        let slope = turns.try_inverse().unwrap_or_else(Matrix3::zeros).row(k).transpose();
        let mut read = self.turned([roll, pitch, yaw][k] + self.error(SensorError::AngleOffset, k), slope);
        read.sensors.extend(self.by(SensorError::AngleOffset, k, &[1.0]));
        read
    }

    fn displacement(&self, axis: Axis) -> Read {
        let Some((rest, at_rest)) = &self.unloaded else { return self.nothing() };
        let moved = self.pose().position - rest.pose.position;
        let (value, per_place, sensors) = self.seen(moved, axis);
        let models = by_motion(per_place, Vector3::zeros(), &(self.motion() - &at_rest.pose));
        Read { value, models, sensors }
    }

    fn load_cell(&self, i: usize, end: CableEnd) -> Read {
        let (tension, models) = self.tension(i, end);
        let gain = 1.0 + self.error(SensorError::TensionGain, i);
        let mut sensors = self.by(SensorError::TensionBias, i, &[1.0]);
        sensors.extend(self.by(SensorError::TensionGain, i, &[tension]));
        let value = gain * tension + self.error(SensorError::TensionBias, i);
        Read { value, models: models * gain, sensors }
    }

    fn swivel(&self, i: usize) -> Read {
        let (Some(pulley), Some(exits)) = (&self.model.robot.cables[i].pulley, &self.exits) else {
            return self.nothing();
        };
        let [u, v] = TiltAxis::ALL.map(|axis| axis.of(pulley));
        let (along, across) = (u.dot(&exits.forces[i]), v.dot(&exits.forces[i]));
        let per_force = (v * along - u * across) / (along * along + across * across);
        Read {
            value: across.atan2(along) + self.error(SensorError::SwivelOffset, i),
            models: per_force.transpose() * exits.per_input.fixed_rows::<3>(3 * i),
            sensors: self.by(SensorError::SwivelOffset, i, &[1.0]),
        }
    }
}

/// Derivatives of a number that changes by these with a displacement and a turn of the platform.
fn by_motion(
    per_displacement: Vector3<f64>,
    per_turn: Vector3<f64>,
    motion: &Matrix6xX<f64>,
) -> RowDVector<f64> {
    let [[x, y, z], [a, b, c]] = [per_displacement, per_turn].map(<[f64; 3]>::from);
    Vector6::new(x, y, z, a, b, c).transpose() * motion
}

/// Inverse of the right Jacobian of rotations at the vector r.
pub(crate) fn inverse_of_right(r: &Vector3<f64>) -> Matrix3<f64> {
    let angle = r.norm();
    let cross = r.cross_matrix();
    let second = if angle < 1e-4 {
        1.0 / 12.0
    } else {
        1.0 / (angle * angle) - (1.0 + angle.cos()) / (2.0 * angle * angle.sin())
    };
    Matrix3::identity() + cross * 0.5 + cross * cross * second
}
