//! Whether lengths and poses of a table belong together: columns that were swapped, a column in another unit
//! or with another sign, a row of another robot.

use crate::campaign::{Quantity, Row};
use crate::error::CalibrationError;
use crate::unknowns::size;
use cdpr_robot::{Axis, Pose, Robot, Vector3};

/// A misfit of a column above this share of the robot's size is looked into.
const FAR: f64 = 0.05;

/// A misfit above this share of the robot's size is more than sag and tolerances make.
const SEEN: f64 = 0.01;

/// Coordinates as they are.
const SIGNS: [f64; 3] = [1.0; 3];

/// A length this share of the robot's size away from the distance of its points is of another row or robot.
const ELSEWHERE: f64 = 0.25;

/// Two columns are swapped if this share of the misfit is left after they are swapped back.
const LEFT: f64 = 0.2;

/// Lengths must be positive where winches count from zero.
///
/// # Errors
/// [`CalibrationError::Cell`] naming line and column.
pub(crate) fn check_signs(rows: &[Row]) -> Result<(), CalibrationError> {
    for row in rows {
        let mut lengths = row.lengths.iter().flatten().enumerate();
        if let Some((i, length)) = lengths.find(|(_, length)| **length <= 0.0) {
            let expected = "a length above zero, or offsets of the winches that are sought, length_offset";
            return Err(cell(row, i, *length, expected.to_owned()));
        }
    }
    Ok(())
}

fn cell(row: &Row, cable: usize, length: f64, expected: String) -> CalibrationError {
    let column = Quantity::Length(cable).to_string();
    CalibrationError::Cell { line: row.line, column, value: length.to_string(), expected }
}

/// Compares the lengths with the distances of the points at the measured poses. Sag, pulleys and the errors
/// that are sought change these by far less than swapped columns.
///
/// # Errors
/// [`CalibrationError::Column`] naming two columns that fit far better the other way round, one that does
/// with the other sign, or one that fits nowhere; [`CalibrationError::Cell`] for a row that stands out in
/// this way.
pub(crate) fn check_columns(robot: &Robot, rows: &[Row]) -> Result<(), CalibrationError> {
    let measured: Vec<(Vector3<f64>, &Row, &Vec<f64>)> = rows
        .iter()
        .filter_map(|row| {
            let [x, y, z] = Axis::ALL.map(|axis| row.value(Quantity::Position(axis)));
            Some((Vector3::new(x?, y?, z?), row, row.lengths.as_ref()?))
        })
        .collect();
    if measured.is_empty() {
        return Ok(());
    }
    let n = robot.cables.len();
    // Misfit of column i with cable j, with the coordinates of the position in this order and with these
    // signs.
    let misfit = |i: usize, j: usize, order: [usize; 3], sign: [f64; 3]| {
        let square = |(position, row, lengths): &(Vector3<f64>, &Row, &Vec<f64>)| {
            let position = Vector3::from(order.map(|k| sign[k] * position[k]));
            let rotation = row.rotation.unwrap_or_else(cdpr_robot::Rotation3::identity);
            let distance = robot.span(&Pose { position, rotation }, j).norm();
            (lengths[i] - distance).powi(2)
        };
        (measured.iter().map(square).sum::<f64>() / measured.len() as f64).sqrt()
    };
    let far = FAR * size(robot);
    let named = |one: String, other: String| {
        let expected = "them the other way round: lengths and positions would then fit";
        Err(CalibrationError::Column { column: format!("{one} and {other}"), expected: expected.to_owned() })
    };
    let own = [0, 1, 2];
    let whole = |order, sign| (0..n).map(|i| misfit(i, i, order, sign)).sum::<f64>() / n as f64;
    let now = whole(own, SIGNS);
    for k in own.iter().filter(|_| now > SEEN * size(robot)) {
        let mut sign = SIGNS;
        sign[*k] = -1.0;
        if whole(own, sign) < LEFT * now {
            let column = Quantity::Position(Axis::ALL[*k]).to_string();
            let expected = "the other sign: lengths and positions would then fit".to_owned();
            return Err(CalibrationError::Column { column, expected });
        }
    }
    if now > far {
        for (one, other) in [(0, 1), (0, 2), (1, 2)] {
            let mut order = own;
            order.swap(one, other);
            if whole(order, SIGNS) < LEFT * now {
                let name = |k: usize| Quantity::Position(Axis::ALL[k]).to_string();
                return named(name(one), name(other));
            }
        }
    }
    for i in 0..n {
        for j in i + 1..n {
            let of = |i, j| misfit(i, j, own, SIGNS);
            let (before, after) = (of(i, i) + of(j, j), of(i, j) + of(j, i));
            // All columns must fit then: a coordinate with the wrong sign makes those of a symmetric robot
            // look swapped in pairs.
            let rest = n as f64 * now - before;
            if before > 2.0 * far && rest + after < LEFT * before {
                return named(Quantity::Length(i).to_string(), Quantity::Length(j).to_string());
            }
        }
    }
    // What most rows and columns have, one must have, too.
    let distance = |(position, row, _): &(Vector3<f64>, &Row, &Vec<f64>), i: usize| {
        let rotation = row.rotation.unwrap_or_else(cdpr_robot::Rotation3::identity);
        robot.span(&Pose { position: *position, rotation }, i).norm()
    };
    let off = |of: &(Vector3<f64>, &Row, &Vec<f64>), i: usize| (of.2[i] - distance(of, i)).abs();
    let usual: Vec<f64> = (0..n).map(|i| median(measured.iter().map(|of| off(of, i)).collect())).collect();
    let elsewhere = ELSEWHERE * size(robot);
    if median(usual.clone()) > far {
        return Ok(());
    }
    if let Some(i) = usual.iter().position(|of| *of > elsewhere) {
        let [read, expected] = [measured[0].2[i], distance(&measured[0], i)];
        let expected = format!(
            "lengths near the distances of its points at the measured poses, {expected:.4} m in place of \
             {read:.4} m in line {}: its unit or its cable may be another",
            measured[0].1.line
        );
        return Err(CalibrationError::Column { column: Quantity::Length(i).to_string(), expected });
    }
    for of in &measured {
        let farthest = (0..n).max_by(|i, j| off(of, *i).total_cmp(&off(of, *j)));
        if let Some(i) = farthest.filter(|i| off(of, *i) > elsewhere) {
            let expected = format!(
                "about {:.4} m, the distance of its points at the measured pose: the row may be of another \
                 pose or robot",
                distance(of, i)
            );
            return Err(cell(of.1, i, of.2[i], expected));
        }
    }
    Ok(())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
