//! A row of a table of measurements.

use crate::campaign::{Noise, Quantity, Reading, Row, STD_EXPECTED, is_std};
use crate::error::CalibrationError;
use crate::sensor_error::size;
use crate::table::columns::{Column, Named};
use cdpr_robot::{Axis, Robot, Rotation3, rotation_of, short, visible};
use cdpr_statics::Load;

/// The noise that is stated for all rows.
pub(super) struct Stated {
    pub(super) stds: Noise,
    pub(super) covariances: Vec<(Quantity, Quantity, f64)>,
    /// Greatest tension of the table [N], a scale for tensions without noise.
    pub(super) greatest_tension: f64,
}

impl Stated {
    /// Standard deviation of a quantity without noise.
    fn exact(&self, quantity: Quantity, robot: &Robot) -> f64 {
        Noise::exact(quantity, size(robot), self.greatest_tension)
    }
}

/// The greatest tension of a table [N]; where all are zero the weight of the platform, or 1 N.
pub(super) fn greatest_tension(cells: &[(usize, Vec<Option<f64>>)], columns: &[Named], robot: &Robot) -> f64 {
    let of_row = |(_, row): &(usize, Vec<Option<f64>>)| {
        let tension = |(named, cell): (&Named, &Option<f64>)| match named.column {
            Column::Reading(Quantity::Tension(..)) if !named.is_std => cell.map(|value| value * named.factor),
            _ => None,
        };
        columns.iter().zip(row).filter_map(tension).fold(0.0, |most: f64, tension| most.max(tension.abs()))
    };
    let weight = robot.platform.mass * robot.gravity.magnitude();
    let scales = [cells.iter().map(of_row).fold(0.0, f64::max), weight];
    scales.into_iter().find(|scale| *scale > 0.0).unwrap_or(1.0)
}

/// A row by its cells.
pub(super) fn row(
    line: usize,
    cells: &[Option<f64>],
    columns: &[Named],
    robot: &Robot,
    noise: &Stated,
) -> Result<Row, CalibrationError> {
    let values = columns.iter().zip(cells).map(|(named, cell)| Some((*cell)? * named.factor)).collect();
    let cells = Cells { line, columns, values, robot, noise };
    let mut row = Row::new(line, cells.load());
    row.mass = cells.mass()?;
    if let Some(lengths) = cells.lengths()? {
        row.lengths = Some(lengths);
        row.length_std = cells.length_stds()?;
    }
    row.rotation = cells.rotation()?;
    if row.rotation.is_some() {
        for quantity in Axis::ALL.map(Quantity::Rotation) {
            row.readings.push(cells.reading(quantity, 0.0)?);
        }
    }
    cells.add_other_readings(&mut row)?;
    cells.add_covariances(&mut row)?;
    Ok(row)
}

/// The cells of a row.
struct Cells<'a> {
    line: usize,
    columns: &'a [Named],
    /// Value of each column, SI units.
    values: Vec<Option<f64>>,
    robot: &'a Robot,
    noise: &'a Stated,
}

impl Cells<'_> {
    /// The value of a column, or of its standard deviation, with the column.
    fn find(&self, column: Column, is_std: bool) -> Option<(f64, &Named)> {
        let found = self.columns.iter().position(|named| named.column == column && named.is_std == is_std)?;
        Some((self.values[found]?, &self.columns[found]))
    }

    fn value(&self, column: Column) -> Option<f64> {
        self.find(column, false).map(|(value, _)| value)
    }

    /// The columns that have a value in this row.
    fn given(&self) -> impl Iterator<Item = (&Named, f64)> {
        self.columns.iter().zip(&self.values).filter_map(|(named, value)| Some((named, (*value)?)))
    }

    fn refused(&self, named: &Named, value: f64, expected: impl Into<String>) -> CalibrationError {
        CalibrationError::Cell {
            line: self.line,
            column: named.name.clone(),
            value: value.to_string(),
            expected: expected.into(),
        }
    }

    fn incomplete(&self, reason: impl Into<String>) -> CalibrationError {
        CalibrationError::Incomplete { line: self.line, reason: reason.into() }
    }

    /// Standard deviation of a quantity: that of the row, else that of all rows, if either is stated.
    fn std_of(&self, quantity: Quantity) -> Result<Option<f64>, CalibrationError> {
        match self.find(Column::Reading(quantity), true) {
            Some((std, _)) if is_std(std) => Ok(Some(std)),
            Some((std, named)) => Err(self.refused(named, std, STD_EXPECTED)),
            None => Ok(self.noise.stds.of(quantity)),
        }
    }

    fn reading(&self, quantity: Quantity, value: f64) -> Result<Reading, CalibrationError> {
        let std = self.std_of(quantity)?.unwrap_or_else(|| self.noise.exact(quantity, self.robot));
        Ok(Reading { quantity, value, std })
    }

    fn load(&self) -> Load {
        let of = |column| self.value(column).unwrap_or(0.0);
        let mut load = Load::payload(of(Column::Payload));
        for k in 0..3 {
            load.wrench.force[k] = of(Column::Wrench(k));
            load.wrench.moment[k] = of(Column::Wrench(3 + k));
        }
        load
    }

    fn mass(&self) -> Result<Option<f64>, CalibrationError> {
        let mass = match self.find(Column::Mass, false) {
            Some((mass, named)) if mass <= 0.0 => {
                return Err(self.refused(named, mass, "a mass above zero [kg]"));
            }
            found => found.map(|(mass, _)| mass),
        };
        let whole = mass.unwrap_or(self.robot.platform.mass);
        match self.find(Column::Payload, false) {
            Some((payload, named)) if payload <= -whole => {
                let expected = format!("a payload above -{} kg, the platform's mass", short(whole));
                Err(self.refused(named, payload, expected))
            }
            _ => Ok(mass),
        }
    }

    /// The lengths of all cables, if they are measured.
    fn lengths(&self) -> Result<Option<Vec<f64>>, CalibrationError> {
        let cell = |i| self.find(Column::Reading(Quantity::Length(i)), false);
        let cells: Vec<_> = (0..self.robot.cables.len()).map(cell).collect();
        if cells.iter().all(Option::is_none) {
            return Ok(None);
        }
        let size = size(self.robot);
        let checked = |(i, cell): (usize, Option<(f64, &Named)>)| match cell {
            None => {
                Err(self.incomplete(format!("column l{}_m is empty: expected all lengths, or none", i + 1)))
            }
            Some((value, named)) if value.abs() > LONGEST * size => Err(self.refused(
                named,
                value,
                format!("a length in m; the robot is {} m wide", visible(size, 3)),
            )),
            Some((value, _)) => Ok(value),
        };
        cells.into_iter().enumerate().map(checked).collect::<Result<_, _>>().map(Some)
    }

    /// Standard deviations of all lengths, zero where they are exact. Where some have noise, the exact ones
    /// have hardly any.
    fn length_stds(&self) -> Result<Vec<f64>, CalibrationError> {
        let std = |i| Ok(self.std_of(Quantity::Length(i))?.unwrap_or(0.0));
        let mut stds: Vec<f64> =
            (0..self.robot.cables.len()).map(std).collect::<Result<_, CalibrationError>>()?;
        if stds.iter().any(|std| *std > 0.0) {
            let exact = self.noise.exact(Quantity::Length(0), self.robot);
            stds.iter_mut().filter(|std| **std == 0.0).for_each(|std| *std = exact);
        }
        Ok(stds)
    }

    /// The orientation by its quaternion. The names of its columns state the order.
    fn rotation(&self) -> Result<Option<Rotation3<f64>>, CalibrationError> {
        let cells: Vec<_> = (0..4).filter_map(|k| self.find(Column::Quaternion(k), false)).collect();
        match cells[..] {
            [] => Ok(None),
            [(w, named), (x, _), (y, _), (z, _)] => {
                rotation_of([w, x, y, z]).map(Some).map_err(|error| self.refused(named, w, error.to_string()))
            }
            _ => Err(self.incomplete("a part of qw, qx, qy, qz is empty: expected all or none")),
        }
    }

    /// What is measured besides lengths and quaternions.
    fn add_other_readings(&self, row: &mut Row) -> Result<(), CalibrationError> {
        let size = size(self.robot);
        for (named, value) in self.given() {
            let Column::Reading(quantity) = named.column else { continue };
            if named.is_std || matches!(quantity, Quantity::Length(_)) {
                continue;
            }
            let is_length =
                matches!(quantity, Quantity::Position(_) | Quantity::Marker(..) | Quantity::Displacement(_));
            if is_length && (value - anywhere(self.robot, quantity)).abs() > FARTHEST * size {
                let expected = format!("a place in m; the robot is {} m wide", visible(size, 3));
                return Err(self.refused(named, value, expected));
            }
            if matches!(quantity, Quantity::Angle(_)) && value.abs() > std::f64::consts::TAU {
                return Err(self.refused(named, value, "an angle of at most a full turn"));
            }
            row.readings.push(self.reading(quantity, value)?);
        }
        Ok(())
    }

    /// The covariances of the row, then those of all rows.
    fn add_covariances(&self, row: &mut Row) -> Result<(), CalibrationError> {
        for (named, value) in self.given() {
            if let Column::Covariance(one, other) = named.column {
                row.covariances.push((one, other, value));
            }
        }
        for (one, other, value) in &self.noise.covariances {
            if !row.covariances.iter().any(|of| (of.0, of.1) == (*one, *other)) {
                row.covariances.push((*one, *other, *value));
            }
        }
        if row.is_covariance_valid() {
            return Ok(());
        }
        Err(self.incomplete(
            "the covariances make no positive definite matrix with the standard deviations: expected each \
             below the product of its two",
        ))
    }
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
