//! Whether lengths and poses of a table belong together: columns that were swapped.

use crate::campaign::{Quantity, Row};
use crate::error::CalibrationError;
use crate::unknowns::size;
use cdpr_robot::{Axis, Pose, Robot, Vector3};

/// A misfit of a column above this share of the robot's size is looked into.
const FAR: f64 = 0.05;

/// Two columns are swapped if this share of the misfit is left after they are swapped back.
const LEFT: f64 = 0.2;

/// Compares the lengths with the distances of the points at the measured poses. Sag, pulleys and the errors
/// that are sought change these by far less than swapped columns.
///
/// # Errors
/// [`CalibrationError::Column`] naming two columns that fit far better the other way round.
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
    // Misfit of column i with cable j, with the coordinates of the position in this order.
    let misfit = |i: usize, j: usize, order: [usize; 3]| {
        let square = |(position, row, lengths): &(Vector3<f64>, &Row, &Vec<f64>)| {
            let position = Vector3::from(order.map(|k| position[k]));
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
    let whole = |order| (0..n).map(|i| misfit(i, i, order)).sum::<f64>() / n as f64;
    let now = whole(own);
    if now > far {
        for (one, other) in [(0, 1), (0, 2), (1, 2)] {
            let mut order = own;
            order.swap(one, other);
            if whole(order) < LEFT * now {
                let name = |k: usize| Quantity::Position(Axis::ALL[k]).to_string();
                return named(name(one), name(other));
            }
        }
    }
    for i in 0..n {
        for j in i + 1..n {
            let (before, after) =
                (misfit(i, i, own) + misfit(j, j, own), misfit(i, j, own) + misfit(j, i, own));
            // All columns must fit then: a coordinate with the wrong sign makes those of a symmetric robot
            // look swapped in pairs.
            let rest = n as f64 * now - before;
            if before > 2.0 * far && rest + after < LEFT * before {
                return named(Quantity::Length(i).to_string(), Quantity::Length(j).to_string());
            }
        }
    }
    Ok(())
}
