//! A row of a table of measurements.

use crate::campaign::{Noise, Quantity, Reading, Row, STD_EXPECTED, is_std};
use crate::error::CalibrationError;
use crate::table::columns::{Column, Named};
use cdpr_robot::{Axis, Robot, rotation_in_order};
use cdpr_statics::Load;

/// The noise that is stated for all rows.
pub(super) struct Stated {
    pub(super) stds: Noise,
    pub(super) covariances: Vec<(Quantity, Quantity, f64)>,
}

/// A row by its cells.
pub(super) fn row(
    line: usize,
    cells: &[Option<f64>],
    columns: &[Named],
    robot: &Robot,
    noise: &Stated,
) -> Result<Row, CalibrationError> {
    let cell_error = |named: &Named, value: &str, expected: &str| CalibrationError::Cell {
        line,
        column: named.name.clone(),
        value: value.to_owned(),
        expected: expected.to_owned(),
    };
    let values: Vec<Option<f64>> =
        columns.iter().zip(cells).map(|(named, cell)| Some((*cell)? * named.factor)).collect();
    let find = |column: Column, is_std: bool| {
        let found = columns.iter().position(|named| named.column == column && named.is_std == is_std)?;
        values[found].map(|value| (value, &columns[found]))
    };
    let std_of = |quantity: Quantity| -> Result<Option<f64>, CalibrationError> {
        match find(Column::Reading(quantity), true) {
            Some((std, _)) if is_std(std) => Ok(Some(std)),
            Some((std, named)) => Err(cell_error(named, &std.to_string(), STD_EXPECTED)),
            None => Ok(noise.stds.of(quantity)),
        }
    };
    let mut load = Load::none();
    load.payload = find(Column::Payload, false).map_or(0.0, |(value, _)| value);
    for k in 0..3 {
        load.wrench.force[k] = find(Column::Wrench(k), false).map_or(0.0, |(value, _)| value);
        load.wrench.moment[k] = find(Column::Wrench(3 + k), false).map_or(0.0, |(value, _)| value);
    }
    let mut row = Row::new(line, load);
    row.mass = find(Column::Mass, false).map(|(value, _)| value);
    if let Some((mass, named)) = find(Column::Mass, false).filter(|(mass, _)| *mass <= 0.0) {
        return Err(cell_error(named, &mass.to_string(), "a mass above zero [kg]"));
    }
    // Lengths
    let lengths: Vec<_> =
        (0..robot.cables.len()).map(|i| find(Column::Reading(Quantity::Length(i)), false)).collect();
    let given = lengths.iter().flatten().count();
    if given > 0 {
        if let Some(i) = lengths.iter().position(Option::is_none) {
            let reason = format!("column l{}_m is empty: expected all lengths, or none", i + 1);
            return Err(CalibrationError::Incomplete { line, reason });
        }
        let values: Vec<f64> = lengths.iter().flatten().map(|(value, _)| *value).collect();
        let widest = LONGEST * crate::unknowns::size(robot);
        for (value, named) in lengths.iter().flatten() {
            if value.abs() > widest {
                let expected = format!("a length in m; the robot is {:.3} m wide", widest / LONGEST);
                return Err(cell_error(named, &value.to_string(), &expected));
            }
        }
        row.lengths = Some(values);
        let std = |i| std_of(Quantity::Length(i));
        let stds: Vec<_> = (0..robot.cables.len()).map(std).collect::<Result<_, _>>()?;
        row.length_std = stds.into_iter().map(|std| std.unwrap_or(0.0)).collect();
        if row.length_std.contains(&0.0) {
            let exact = Noise::exact(Quantity::Length(0));
            let noisy = row.length_std.iter().any(|std| *std > 0.0);
            row.length_std.iter_mut().filter(|std| noisy && **std == 0.0).for_each(|std| *std = exact);
        }
    }
    // Orientation
    let quaternion: Vec<_> = (0..4).filter_map(|k| find(Column::Quaternion(k), false)).collect();
    match quaternion[..] {
        [] => {}
        [(w, named), (x, _), (y, _), (z, _)] => {
            let rotation = rotation_in_order([w, x, y, z])
                .map_err(|error| cell_error(named, &w.to_string(), &error.to_string()))?;
            row.rotation = Some(rotation);
            for axis in Axis::ALL {
                let quantity = Quantity::Rotation(axis);
                let std = std_of(quantity)?.unwrap_or(Noise::exact(quantity));
                row.readings.push(Reading { quantity, value: 0.0, std });
            }
        }
        _ => {
            let reason = "a part of qw, qx, qy, qz is empty: expected all or none".to_owned();
            return Err(CalibrationError::Incomplete { line, reason });
        }
    }
    // Everything else
    for (named, value) in columns.iter().zip(&values) {
        let (Column::Reading(quantity), Some(value), false) = (named.column, value, named.is_std) else {
            continue;
        };
        let far = FARTHEST * crate::unknowns::size(robot);
        let is_length =
            matches!(quantity, Quantity::Position(_) | Quantity::Marker(..) | Quantity::Displacement(_));
        if is_length && (value - anywhere(robot, quantity)).abs() > far {
            let expected = format!("a place in m; the robot is {:.3} m wide", far / FARTHEST);
            return Err(cell_error(named, &value.to_string(), &expected));
        }
        if matches!(quantity, Quantity::Angle(_)) && value.abs() > std::f64::consts::TAU {
            return Err(cell_error(named, &value.to_string(), "an angle of at most a full turn"));
        }
        if !matches!(quantity, Quantity::Length(_)) {
            let std = std_of(quantity)?.unwrap_or(Noise::exact(quantity));
            row.readings.push(Reading { quantity, value: *value, std });
        }
    }
    // Covariances: those of the row, then those of all rows
    for (named, value) in columns.iter().zip(&values) {
        if let (Column::Covariance(one, other), Some(value)) = (named.column, value) {
            row.covariances.push((one, other, *value));
        }
    }
    for (one, other, value) in &noise.covariances {
        let is_same = |of: &(Quantity, Quantity, f64)| (of.0, of.1) == (*one, *other);
        if !row.covariances.iter().any(is_same) {
            row.covariances.push((*one, *other, *value));
        }
    }
    if !row.is_covariance_valid() {
        let reason = "the covariances make no positive definite matrix with the standard deviations: \
                      expected each below the product of its two";
        return Err(CalibrationError::Incomplete { line, reason: reason.to_owned() });
    }
    Ok(row)
}

/// Lengths of so many widths of a robot must be in another unit.
const LONGEST: f64 = 30.0;

/// Places so many widths away must be in another unit; a tracker may stand beside the robot.
const FARTHEST: f64 = 30.0;

/// A coordinate within the robot, for a place in its base frame.
fn anywhere(robot: &Robot, quantity: Quantity) -> f64 {
    match quantity {
        Quantity::Position(axis) | Quantity::Marker(_, axis) => robot.cables[0].exit_point[axis.index()],
        _ => 0.0,
    }
}
