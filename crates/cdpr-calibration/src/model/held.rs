//! Coordinates that the platform cannot change: those out of the plane of a planar robot, and the rotation of
//! a point mass.
//!
//! Sensors measure them, too, but what holds them decides what they are, and no parameter does. They are no
//! data about parameters, and a row counts without them. There are two exceptions: a tracker whose place is
//! sought sees them in its own frame, and where an offset of an inclinometer or the place of a marker is
//! sought, it shows in them.

use crate::campaign::{Quantity, Row};
use crate::sensor_error::SensorError;
use crate::unknowns::Unknowns;
use cdpr_robot::{Axis, Robot, Rotation3, UnitQuaternion, Vector3};
use std::borrow::Cow;

/// Of a planar robot, the axis at right angles to its plane and where P is along it [m]: the mean of what is
/// measured, else where its points are at one height.
pub(crate) fn plane_of(robot: &Robot, unknowns: &Unknowns, rows: &[Row]) -> Option<(usize, f64)> {
    let (normal, offset) = robot.plane_offset()?;
    let is_moved = unknowns.sensor(SensorError::Frame).is_some();
    let measured = rows.iter().filter_map(|row| row.value(Quantity::Position(Axis::ALL[normal])));
    let measured: Vec<f64> = measured.filter(|_| !is_moved).collect();
    let mean = measured.iter().sum::<f64>() / measured.len() as f64;
    Some((normal, if measured.is_empty() { offset } else { mean }))
}

/// Whether the platform cannot change a quantity, and no error of its sensor is sought.
fn is_held(robot: &Robot, unknowns: &Unknowns, quantity: Quantity) -> bool {
    let freedoms = robot.freedoms();
    let is_sought = |error| unknowns.sensor(error).is_some();
    if freedoms.are_all() || is_sought(SensorError::Frame) {
        return false;
    }
    match quantity {
        Quantity::Position(axis) | Quantity::Displacement(axis) => !freedoms.contains(axis.index()),
        Quantity::Marker(_, axis) => !freedoms.contains(axis.index()) && !is_sought(SensorError::Markers),
        Quantity::Rotation(axis) => !freedoms.contains(3 + axis.index()),
        Quantity::Angle(k) => !freedoms.contains(3 + k) && !is_sought(SensorError::AngleOffset),
        Quantity::Tension(..) | Quantity::Swivel(_) | Quantity::Length(_) => false,
    }
}

/// The rows without what the platform cannot change.
pub(crate) fn without_held<'a>(robot: &Robot, unknowns: &Unknowns, rows: &'a [Row]) -> Cow<'a, [Row]> {
    let is_held = |quantity| is_held(robot, unknowns, quantity);
    if !rows.iter().any(|row| row.readings.iter().any(|of| is_held(of.quantity))) {
        return Cow::Borrowed(rows);
    }
    let mut rows = rows.to_vec();
    rows.iter_mut().for_each(|row| row.readings.retain(|of| !is_held(of.quantity)));
    Cow::Owned(rows)
}

/// A number that is measured of what the platform cannot change.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HeldReading {
    /// The line of its row.
    pub(crate) line: usize,
    pub(crate) quantity: Quantity,
    /// How far it is from where the robot holds it, in the unit of the quantity.
    pub(crate) off: f64,
    /// The same in standard deviations of the noise.
    pub(crate) standard_deviations: f64,
}

/// The one of these numbers that is farthest, in standard deviations, from where the robot holds it.
pub(crate) fn farthest_held(robot: &Robot, unknowns: &Unknowns, rows: &[Row]) -> Option<HeldReading> {
    let at = plane_of(robot, unknowns, rows).map_or(0.0, |(_, at)| at);
    let of_row = |row: &Row| {
        let tilt = tilt(robot, row);
        let off = |quantity: Quantity, value: f64| match quantity {
            Quantity::Position(_) => value - at,
            Quantity::Marker(marker, axis) => {
                let place = unknowns.markers.get(marker).map_or(0.0, |place| place[axis.index()]);
                value - at - place
            }
            Quantity::Rotation(axis) => tilt[axis.index()],
            Quantity::Angle(k) => tilt[k],
            _ => value,
        };
        let held = row.readings.iter().filter(|of| is_held(robot, unknowns, of.quantity));
        let reading = |of: &crate::Reading| {
            let off = off(of.quantity, of.value);
            HeldReading {
                line: row.line,
                quantity: of.quantity,
                off,
                standard_deviations: off.abs() / of.std,
            }
        };
        held.map(reading).collect::<Vec<_>>()
    };
    let all = rows.iter().flat_map(of_row);
    all.max_by(|one, other| one.standard_deviations.total_cmp(&other.standard_deviations))
}

/// How a platform is measured to be turned [rad]: of a planar robot, how the normal of its plane is; else the
/// whole rotation vector.
fn tilt(robot: &Robot, row: &Row) -> Vector3<f64> {
    let angle = |k| row.value(Quantity::Angle(k)).unwrap_or(0.0);
    let euler = || Rotation3::from_euler_angles(angle(0), angle(1), angle(2));
    let rotation = row.rotation.unwrap_or_else(euler);
    match robot.plane {
        Some(plane) => {
            let normal = Vector3::ith(plane.normal(), 1.0);
            normal.cross(&(rotation * normal))
        }
        None => UnitQuaternion::from_rotation_matrix(&rotation).scaled_axis(),
    }
}
