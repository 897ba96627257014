//! What a sensor reads, with its derivatives.

use crate::campaign::{Quantity, Row};
use crate::model::{Model, RowState, Shared};
use crate::unknowns::SensorError;
use cdpr_robot::{
    Axis, CableEnd, Coordinate, Matrix6xX, Pose, Robot, Rotation3, TiltAxis, UnitQuaternion, Vector3, Vector6,
};
use cdpr_statics::Equilibrium;
use cdpr_statics::derivatives::ForceDerivatives;
use nalgebra::{Matrix3, RowDVector};

/// Derivatives of what is read by everything it may depend on.
pub(super) struct Slopes {
    /// By the inputs of the models and the lengths.
    pub(super) models: RowDVector<f64>,
    /// By errors of sensors.
    pub(super) sensors: Vec<(usize, f64)>,
}

impl Model<'_> {
    /// A quantity as the sensor would read it, with its slopes; of a rotation the vector from the measured
    /// one, with the opposite sign.
    #[allow(clippy::too_many_arguments)]
    pub(super) fn read(
        &self,
        quantity: Quantity,
        row: &Row,
        robot: &Robot,
        at: &Shared,
        state: &RowState,
        lengths: &[f64],
        slopes: &ForceDerivatives,
        unloaded: Option<&(&Equilibrium, ForceDerivatives)>,
    ) -> (f64, Slopes) {
        let (pose, x) = (&state.loaded.pose, &at.x[..]);
        let of_pose = |per_motion: Vector6<f64>, matrix: &Matrix6xX<f64>| per_motion.transpose() * matrix;
        let none = |models| Slopes { models, sensors: Vec::new() };
        match quantity {
            Quantity::Position(axis) => self.place(at, pose, Vector3::zeros(), None, axis, slopes),
            Quantity::Marker(marker, axis) => {
                let mut place = self.unknowns.markers.get(marker).copied().unwrap_or_else(Vector3::zeros);
                let first = self.unknowns.sensor(SensorError::Markers).map(|first| first + 3 * marker);
                if let Some(first) = first {
                    place += Vector3::new(x[first], x[first + 1], x[first + 2]);
                }
                self.place(at, pose, place, first, axis, slopes)
            }
            Quantity::Rotation(axis) => {
                let measured = row.rotation.unwrap_or_else(Rotation3::identity);
                let relative = measured * (at.frame * pose.rotation).inverse();
                let vector = UnitQuaternion::from_rotation_matrix(&relative).scaled_axis();
                // log(exp(r) exp(-dφ)) = r - J⁻¹ dφ, and J⁻¹ Q turns (dφ) of the base frame.
                let slope = inverse_of_right(&vector).row(axis.index()).into_owned();
                let in_base = slope * at.frame.matrix();
                let per_motion = Vector6::new(0.0, 0.0, 0.0, in_base[0], in_base[1], in_base[2]);
                let mut sensors = Vec::new();
                if let Some(first) = self.unknowns.sensor(SensorError::Frame) {
                    sensors.extend((0..3).map(|k| (first + 3 + k, slope[k])));
                }
                (-vector[axis.index()], Slopes { models: of_pose(per_motion, &slopes.pose), sensors })
            }
            Quantity::Angle(k) => {
                let rotation = at.frame * pose.rotation;
                let (roll, pitch, yaw) = rotation.euler_angles();
                let columns = Coordinate::ALL.map(|coordinate| coordinate.motion(yaw, pitch));
                let turns =
                    Matrix3::from_columns(&[3, 4, 5].map(|c| columns[c].fixed_rows::<3>(3).into_owned()));
                let slope = turns.try_inverse().unwrap_or_else(Matrix3::zeros).row(k).into_owned();
                let in_base = slope * at.frame.matrix();
                let per_motion = Vector6::new(0.0, 0.0, 0.0, in_base[0], in_base[1], in_base[2]);
                let mut sensors: Vec<_> = self.slope(SensorError::AngleOffset, k, 1.0).into_iter().collect();
                if let Some(first) = self.unknowns.sensor(SensorError::Frame) {
                    sensors.extend((0..3).map(|c| (first + 3 + c, slope[c])));
                }
                let value = [roll, pitch, yaw][k] + self.of(SensorError::AngleOffset, k, x);
                (value, Slopes { models: of_pose(per_motion, &slopes.pose), sensors })
            }
            Quantity::Displacement(axis) => {
                let Some((rest, at_rest)) = unloaded else {
                    return (0.0, none(RowDVector::zeros(slopes.pose.ncols())));
                };
                let turned = at.frame.matrix().row(axis.index()).into_owned();
                let moved = pose.position - rest.pose.position;
                let per_motion = Vector6::new(turned[0], turned[1], turned[2], 0.0, 0.0, 0.0);
                let models = of_pose(per_motion, &slopes.pose) - of_pose(per_motion, &at_rest.pose);
                let scale = 1.0 + self.of(SensorError::FrameScale, 0, x);
                let mut sensors: Vec<_> =
                    self.slope(SensorError::FrameScale, 0, (turned * moved)[0]).into_iter().collect();
                if let Some(first) = self.unknowns.sensor(SensorError::Frame) {
                    let seen = at.frame * moved;
                    sensors.extend(
                        (0..3).map(|c| {
                            (first + 3 + c, scale * Vector3::ith(c, 1.0).cross(&seen)[axis.index()])
                        }),
                    );
                }
                (scale * (turned * moved)[0], Slopes { models: models * scale, sensors })
            }
            Quantity::Tension(i, end) => {
                let (tension, models) = match end {
                    CableEnd::Anchor => {
                        let force = slopes.forces[i];
                        let direction = force.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
                        (force.norm(), direction.transpose() * slopes.per_input.fixed_rows::<3>(3 * i))
                    }
                    CableEnd::Exit => {
                        let pull = self.pull(robot, i, lengths, slopes);
                        let direction = pull.force.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
                        (pull.force.norm(), direction.transpose() * pull.slopes)
                    }
                };
                let gain = 1.0 + self.of(SensorError::TensionGain, i, x);
                let sensors = [
                    self.slope(SensorError::TensionBias, i, 1.0),
                    self.slope(SensorError::TensionGain, i, tension),
                ];
                let value = gain * tension + self.of(SensorError::TensionBias, i, x);
                let models =
                    RowDVector::from_iterator(models.ncols(), models.iter().map(|slope| gain * slope));
                (value, Slopes { models, sensors: sensors.into_iter().flatten().collect() })
            }
            Quantity::Swivel(i) => {
                let pull = self.pull(robot, i, lengths, slopes);
                let Some(pulley) = &self.robot.cables[i].pulley else {
                    return (0.0, none(RowDVector::zeros(slopes.pose.ncols())));
                };
                let [u, v] = TiltAxis::ALL.map(|axis| axis.of(pulley));
                let (along, across) = (u.dot(&pull.force), v.dot(&pull.force));
                let per_force = (v * along - u * across) / (along * along + across * across);
                let models = per_force.transpose() * pull.slopes;
                let value = across.atan2(along) + self.of(SensorError::SwivelOffset, i, x);
                let models = RowDVector::from_iterator(models.ncols(), models.iter().copied());
                let sensors = self.slope(SensorError::SwivelOffset, i, 1.0).into_iter().collect();
                (value, Slopes { models, sensors })
            }
            Quantity::Length(_) => (0.0, none(RowDVector::zeros(slopes.pose.ncols()))),
        }
    }

    /// A coordinate of a place on the platform in the frame of the tracker.
    fn place(
        &self,
        at: &Shared,
        pose: &Pose,
        place: Vector3<f64>,
        unknown: Option<usize>,
        axis: Axis,
        slopes: &ForceDerivatives,
    ) -> (f64, Slopes) {
        let (x, k) = (&at.x[..], axis.index());
        let arm = pose.rotation * place;
        let scale = 1.0 + self.of(SensorError::FrameScale, 0, x);
        let row = at.frame.matrix().row(k) * scale;
        let seen = at.frame * (pose.position + arm);
        let turned = arm.cross(&row.transpose());
        let per_motion = Vector6::new(row[0], row[1], row[2], turned[0], turned[1], turned[2]);
        let mut value = scale * seen[k] + at.origin[k];
        let mut sensors: Vec<_> = self.slope(SensorError::FrameScale, 0, seen[k]).into_iter().collect();
        if let Some(first) = self.unknowns.sensor(SensorError::Frame) {
            value += x[first + k];
            sensors.push((first + k, 1.0));
            sensors.extend((0..3).map(|c| (first + 3 + c, scale * Vector3::ith(c, 1.0).cross(&seen)[k])));
        }
        if let Some(first) = unknown {
            let per_place = row * pose.rotation.matrix();
            sensors.extend((0..3).map(|c| (first + c, per_place[c])));
        }
        (value, Slopes { models: per_motion.transpose() * &slopes.pose, sensors })
    }
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
