//! The columns of a table of measurements by their names.

use crate::campaign::{Quantity, Row};
use crate::error::CalibrationError;
use cdpr_robot::{Axis, CableEnd, Pose, Robot, Vector3};
use cdpr_study::{Dimension, Unit};

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Column {
    Reading(Quantity),
    /// Covariance of the noise of two quantities.
    Covariance(Quantity, Quantity),
    /// Component of a quaternion (w, x, y, z).
    Quaternion(usize),
    Payload,
    Mass,
    /// Component of the load: force, then moment.
    Wrench(usize),
}

impl Column {
    /// The columns of the known load.
    pub(super) const OF_LOADS: [Self; 8] = [
        Self::Payload,
        Self::Mass,
        Self::Wrench(0),
        Self::Wrench(1),
        Self::Wrench(2),
        Self::Wrench(3),
        Self::Wrench(4),
        Self::Wrench(5),
    ];

    /// Its name, in SI units.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Reading(quantity) => quantity.to_string(),
            Self::Covariance(one, other) => format!("cov_{one}_{other}"),
            Self::Quaternion(k) => QUATERNION[*k].to_owned(),
            Self::Payload => "payload_kg".to_owned(),
            Self::Mass => "mass_kg".to_owned(),
            Self::Wrench(k) => ["fx_n", "fy_n", "fz_n", "mx_nm", "my_nm", "mz_nm"][*k].to_owned(),
        }
    }

    /// Its number in a row, in SI units; `None` where the row has none.
    pub(super) fn value(&self, row: &Row) -> Option<f64> {
        match *self {
            Self::Reading(Quantity::Length(i)) => row.lengths.as_ref()?.get(i).copied(),
            Self::Reading(quantity) => row.value(quantity),
            Self::Covariance(one, other) => {
                row.covariances.iter().find(|of| (of.0, of.1) == (one, other)).map(|of| of.2)
            }
            Self::Quaternion(k) => {
                Some(Pose { position: Vector3::zeros(), rotation: row.rotation? }.quaternion()[k])
            }
            Self::Payload => Some(row.load.payload),
            Self::Mass => row.mass,
            Self::Wrench(k @ 0..3) => Some(row.load.wrench.force[k]),
            Self::Wrench(k) => Some(row.load.wrench.moment[k - 3]),
        }
    }

    /// Whether a row has more than the zero that a missing column means.
    pub(super) fn is_in(&self, row: &Row) -> bool {
        self.value(row).is_some_and(|value| value != 0.0)
    }
}

/// Names of the components (w, x, y, z).
const QUATERNION: [&str; 4] = ["qw", "qx", "qy", "qz"];

/// A column with the factor to SI units.
#[derive(Clone, Debug)]
pub(super) struct Named {
    pub(super) name: String,
    pub(super) column: Column,
    pub(super) factor: f64,
    /// Whether it is the standard deviation of the quantity.
    pub(super) is_std: bool,
}

/// The columns of a header.
pub(super) fn columns(header: &[String], robot: &Robot) -> Result<Vec<Named>, CalibrationError> {
    let mut columns: Vec<Named> = Vec::new();
    for name in header {
        let wrong =
            |expected: &str| CalibrationError::Column { column: name.clone(), expected: expected.to_owned() };
        let expected = "a name such as x_m, qw, roll_deg, l1_m, t1_n, t1_winch_n, marker1_x_m, dx_m, \
                        swivel1_deg, payload_kg, mass_kg, fx_n, mx_nm, std_x_m or cov_x_m_y_m";
        let (is_std, column, factor) = known(&name.to_lowercase()).ok_or_else(|| wrong(expected))?;
        if !is_std && matches!(column, Column::Reading(Quantity::Rotation(_))) {
            return Err(wrong("qw, qx, qy, qz; std_ and cov_ go before rx_rad"));
        }
        let cable = match column {
            Column::Reading(quantity) => quantity.cable(),
            Column::Covariance(one, other) => one.cable().max(other.cable()),
            _ => None,
        };
        let n = robot.cables.len();
        if cable.is_some_and(|i| i >= n) {
            return Err(wrong(&format!("one of the {n} cables of the robot")));
        }
        if let Column::Reading(Quantity::Swivel(i)) = column
            && robot.cables[i].pulley.is_none()
        {
            return Err(wrong("a cable with a pulley in the robot file"));
        }
        if is_std && !matches!(column, Column::Reading(_)) {
            return Err(wrong("a quantity that is measured behind std_"));
        }
        if let Some(other) = columns.iter().find(|other| other.column == column && other.is_std == is_std) {
            return Err(wrong(&format!("each quantity once; it is in column {}, too", other.name)));
        }
        columns.push(Named { name: name.clone(), column, factor, is_std });
    }
    let has = |column| columns.iter().any(|named| named.column == column && !named.is_std);
    let lengths: Vec<usize> =
        (0..robot.cables.len()).filter(|i| !has(Column::Reading(Quantity::Length(*i)))).collect();
    if let Some(missing) = lengths.first().filter(|_| lengths.len() < robot.cables.len()) {
        let expected = "lengths of all cables, or of none".to_owned();
        return Err(CalibrationError::Column { column: format!("l{}_m is missing", missing + 1), expected });
    }
    let quaternion = (0..4).filter(|k| has(Column::Quaternion(*k))).count();
    if !matches!(quaternion, 0 | 4) {
        let expected = "all of qw, qx, qy, qz".to_owned();
        return Err(CalibrationError::Column {
            column: "a part of the quaternion is missing".to_owned(),
            expected,
        });
    }
    Ok(columns)
}

/// Whether a name in small letters is that of a quantity.
pub(super) fn is_known(name: &str) -> bool {
    known(name).is_some()
}

/// Whether a name is that of a standard deviation, and what it is of.
fn known(name: &str) -> Option<(bool, Column, f64)> {
    let (is_std, base) = name.strip_prefix("std_").map_or((false, name), |base| (true, base));
    covariance(base).or_else(|| column(base)).map(|(column, factor)| (is_std, column, factor))
}

/// A covariance by its name, `cov_x_m_y_m`.
fn covariance(name: &str) -> Option<(Column, f64)> {
    let (one, other, factor) = covariance_of(name)?;
    Some((Column::Covariance(one, other), factor))
}

/// The two quantities of the name of a covariance, `cov_x_m_y_m`, and its factor to SI units. Of
/// `cov_y_m_x_m` they are in the same order: it is the same number. A quantity has no covariance with
/// itself.
pub(super) fn covariance_of(name: &str) -> Option<(Quantity, Quantity, f64)> {
    let pair = name.strip_prefix("cov_")?;
    pair.match_indices('_').find_map(|(at, _)| match (column(&pair[..at])?, column(&pair[at + 1..])?) {
        ((Column::Reading(one), by), (Column::Reading(other), per)) if one != other => {
            let (one, other) = if one.to_string() < other.to_string() { (one, other) } else { (other, one) };
            Some((one, other, by * per))
        }
        _ => None,
    })
}

/// A column by its name without `std_`.
fn column(name: &str) -> Option<(Column, f64)> {
    if let Some(k) = QUATERNION.iter().position(|own| *own == name) {
        return Some((Column::Quaternion(k), 1.0));
    }
    let (base, unit) = name.rsplit_once('_')?;
    let unit = Unit::of(unit)?;
    let factor = |dimension| (unit.dimension == dimension).then_some(unit.factor);
    let [length, force, angle] = [Dimension::Length, Dimension::Force, Dimension::Angle].map(factor);
    let axis = |letter: &str| Axis::from_letter(letter);
    let numbered = |word: &str| base.strip_prefix(word)?.parse::<usize>().ok()?.checked_sub(1);
    let of = |quantity: Quantity, factor: Option<f64>| Some((Column::Reading(quantity), factor?));
    if let Some(axis) = axis(base) {
        return of(Quantity::Position(axis), length);
    }
    if let Some(k) = ["roll", "pitch", "yaw"].iter().position(|own| *own == base) {
        return of(Quantity::Angle(k), angle);
    }
    if let Some(axis) = base.strip_prefix('r').and_then(axis) {
        return of(Quantity::Rotation(axis), angle);
    }
    if let Some(axis) = base.strip_prefix('d').and_then(axis) {
        return of(Quantity::Displacement(axis), length);
    }
    if let Some(axis) = base.strip_prefix('f').and_then(axis) {
        return Some((Column::Wrench(axis.index()), force?));
    }
    if let Some(axis) = base.strip_prefix('m').and_then(axis) {
        return Some((Column::Wrench(3 + axis.index()), factor(Dimension::Moment)?));
    }
    if let Some(mass) = factor(Dimension::Mass) {
        let column = match base {
            "payload" => Column::Payload,
            "mass" => Column::Mass,
            _ => return None,
        };
        return Some((column, mass));
    }
    if let Some(i) = base.strip_suffix("_winch").and_then(|base| base.strip_prefix('t')) {
        return of(Quantity::Tension(i.parse::<usize>().ok()?.checked_sub(1)?, CableEnd::Exit), force);
    }
    if let Some((marker, letter)) = base.split_once('_') {
        let k = marker.strip_prefix("marker")?.parse::<usize>().ok()?.checked_sub(1)?;
        return of(Quantity::Marker(k, axis(letter)?), length);
    }
    if let Some(i) = numbered("swivel") {
        return of(Quantity::Swivel(i), angle);
    }
    if let Some(i) = numbered("l") {
        return of(Quantity::Length(i), length);
    }
    of(Quantity::Tension(numbered("t")?, CableEnd::Anchor), force)
}
