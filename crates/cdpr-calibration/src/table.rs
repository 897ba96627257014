//! Tables of measurements: CSV with units in its header, or JSON with the same names.
//!
//! | columns | what they are |
//! |---|---|
//! | `x_m`, `y_m`, `z_m` | position of P |
//! | `qw`, `qx`, `qy`, `qz` or `roll_deg`, `pitch_deg`, `yaw_deg` | orientation; angles may be missing |
//! | `l1_m` ... | unstrained lengths, of all cables or of none |
//! | `t1_n` ..., `t1_winch_n` ... | tensions at the platform, at the exit points |
//! | `marker1_x_m` ... | markers on the platform |
//! | `dx_m`, `dy_m`, `dz_m` | displacement of P by the load |
//! | `swivel1_deg` ... | swivel angles of pulleys |
//! | `payload_kg`, `mass_kg`, `fx_n` ... `mz_nm` | known load: added mass, mass of the platform, wrench |
//! | `std_` before one of these | its standard deviation in this row; of an orientation `std_rx_rad` ... |
//! | `cov_x_m_y_m` | covariance of two of these in this row |
//!
//! The JSON form has the same names, and null for what was not measured. Units are those of tables
//! ([`cdpr_study::Unit`]), `x [mm]` is `x_mm`, and capitals do not matter. A column of texts or a time may
//! stand beside them.

mod columns;
mod row;

use crate::campaign::{Noise, Quantity, Row};
use crate::error::CalibrationError;
use crate::table::columns::{Column, Named, columns, covariance_of, is_known};
use crate::table::row::{Stated, greatest_tension, row};
use cdpr_robot::{CableEnd, Robot, from_json};
use cdpr_study::Table;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Measurements with what is known of their noise.
#[derive(Clone, Debug)]
pub struct Measurements {
    /// The rows.
    pub rows: Vec<Row>,
    /// Whether the noise of any column that is compared with the model is stated.
    pub noise_is_stated: bool,
    /// Markers that are measured.
    pub markers: usize,
    /// Names of columns in the file by those of [`Quantity`], where they differ: `x_mm` by `x_m`.
    pub names: BTreeMap<String, String>,
}

impl Measurements {
    /// A text with the names of columns as they are in the file.
    pub(crate) fn in_its_names(&self, text: &str) -> String {
        let is_apart = |c: char| !c.is_alphanumeric() && c != '_';
        let named = |part: &str| {
            let word = part.trim_end_matches(is_apart);
            match self.names.get(word) {
                Some(name) => format!("{name}{}", &part[word.len()..]),
                None => part.to_owned(),
            }
        };
        text.split_inclusive(is_apart).map(named).collect()
    }

    /// An error of a fit with the names of columns as they are in the file. The value of a cell is a length
    /// in m, whatever its column.
    pub(crate) fn name_columns(&self, error: CalibrationError) -> CalibrationError {
        match error {
            CalibrationError::Cell { line, column, value, expected } => CalibrationError::Cell {
                line,
                value: if self.names.contains_key(&column) { format!("{value} m") } else { value },
                column: self.in_its_names(&column),
                expected,
            },
            CalibrationError::Column { column, expected } => {
                CalibrationError::Column { column: self.in_its_names(&column), expected }
            }
            other => other,
        }
    }

    /// Tensions and swivel angles that no row has of a cable, though some have them of another: they count as
    /// not measured.
    pub fn not_measured(&self, robot: &Robot) -> Vec<Quantity> {
        let has = |quantity: &Quantity| self.rows.iter().any(|row| row.value(*quantity).is_some());
        let has_pulley = |quantity: &Quantity| match quantity {
            Quantity::Swivel(i) => robot.cables[*i].pulley.is_some(),
            _ => true,
        };
        let kinds: [fn(usize) -> Quantity; 3] = [
            |i| Quantity::Tension(i, CableEnd::Anchor),
            |i| Quantity::Tension(i, CableEnd::Exit),
            Quantity::Swivel,
        ];
        let missing = |of: fn(usize) -> Quantity| {
            let all = (0..robot.cables.len()).map(of).filter(has_pulley);
            let (there, missing): (Vec<_>, Vec<_>) = all.partition(has);
            if there.is_empty() { Vec::new() } else { missing }
        };
        kinds.into_iter().flat_map(missing).collect()
    }
}

/// The numbers of each row, with its line.
type Lines = Vec<(usize, Vec<Option<f64>>)>;

/// The JSON form: rows with the names of the columns, and the noise by sensor.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct JsonForm {
    format: String,
    #[serde(default)]
    noise: BTreeMap<String, f64>,
    rows: Vec<BTreeMap<String, Option<f64>>>,
}

/// Name and version of the JSON form.
pub const MEASUREMENTS_FORMAT: &str = "cdpr-measurements/1";

/// Reads measurements of a robot from the bytes of a file. `noise` holds where a row has no `std_` column; it
/// goes before what a JSON form says.
///
/// # Errors
/// [`CalibrationError::Column`] for a column that is unknown, twice or of a cable that the robot does not
/// have; [`CalibrationError::Table`] and [`CalibrationError::Cell`] naming line and column;
/// [`CalibrationError::Json`].
pub fn read_measurements(
    bytes: &[u8],
    robot: &Robot,
    noise: &[(String, f64)],
) -> Result<Measurements, CalibrationError> {
    let json = std::str::from_utf8(bytes).ok().filter(|text| text.trim_start().starts_with('{'));
    let (header, cells, noise): (_, Lines, _) = if let Some(text) = json {
        let form: JsonForm = from_json(text)?;
        if form.format != MEASUREMENTS_FORMAT {
            return Err(CalibrationError::invalid("format", form.format, MEASUREMENTS_FORMAT));
        }
        let mut names: Vec<String> = form.rows.iter().flat_map(|row| row.keys().cloned()).collect();
        names.sort();
        names.dedup();
        let cell = |row: &BTreeMap<String, Option<f64>>, name| row.get(name).copied().flatten();
        let cells = form.rows.iter().enumerate();
        let cells =
            cells.map(|(k, row)| (k + 1, names.iter().map(|name| cell(row, name)).collect())).collect();
        let mut all: Vec<(String, f64)> = form.noise.into_iter().collect();
        all.retain(|(name, _)| !noise.iter().any(|(own, _)| is_same_noise(own, name)));
        all.extend_from_slice(noise);
        (names, cells, all)
    } else {
        let (header, cells) = lines(bytes)?;
        (header, cells, noise.to_vec())
    };
    let columns = columns(&header, robot)?;
    let (covariances, stds): (Vec<_>, Vec<_>) =
        noise.into_iter().partition(|(name, _)| name.starts_with("cov_"));
    for (k, (name, value)) in covariances.iter().enumerate() {
        if let Some((before, _)) = covariances[..k].iter().find(|(before, _)| is_same_noise(before, name)) {
            let expected = format!("each covariance once; {before} is the same");
            return Err(CalibrationError::invalid(format!("noise {name}"), value, expected));
        }
    }
    let covariances = covariances.into_iter().map(|(name, value)| {
        let expected = "two different quantities that are measured, cov_x_m_y_m";
        let (one, other, factor) = covariance_of(&name)
            .ok_or_else(|| CalibrationError::invalid(format!("noise {name}"), value, expected))?;
        Ok((one, other, value * factor))
    });
    let covariances = covariances.collect::<Result<_, CalibrationError>>()?;
    let greatest_tension = greatest_tension(&cells, &columns, robot);
    let noise = Stated { stds: Noise::named(&stds)?, covariances, greatest_tension };
    let rows: Vec<Row> = cells
        .iter()
        .map(|(line, cells)| row(*line, cells, &columns, robot, &noise))
        .collect::<Result<_, _>>()?;
    if rows.is_empty() {
        return Err(CalibrationError::invalid("measurements", "empty", "a row for each pose below a header"));
    }
    let is_stated = |named: &Named| match named.column {
        Column::Reading(Quantity::Length(_)) => false,
        Column::Reading(quantity) => named.is_std || noise.stds.of(quantity).is_some(),
        Column::Quaternion(_) => noise.stds.rotation.is_some(),
        _ => false,
    };
    let markers = columns.iter().filter_map(|named| match named.column {
        Column::Reading(Quantity::Marker(k, _)) => Some(k + 1),
        _ => None,
    });
    let differs = |named: &&Named| !named.is_std && named.column.name() != named.name;
    let names = columns.iter().filter(differs).map(|named| (named.column.name(), named.name.clone()));
    Ok(Measurements {
        names: names.collect(),
        noise_is_stated: columns.iter().any(is_stated),
        markers: markers.max().unwrap_or(0),
        rows,
    })
}

/// Whether two names of noise mean the same: of a sensor, or of the covariance of two quantities.
fn is_same_noise(one: &str, other: &str) -> bool {
    match (covariance_of(one), covariance_of(other)) {
        (Some(one), Some(other)) => (one.0, one.1) == (other.0, other.1),
        _ => Noise::sensor(one) == Noise::sensor(other),
    }
}

/// Names, and each row with its line, of a table. Texts and a time may stand beside what is measured.
fn lines(bytes: &[u8]) -> Result<(Vec<String>, Lines), CalibrationError> {
    let table = Table::read(bytes)?;
    let mut names = Vec::new();
    let mut cells: Lines = table.lines.iter().map(|line| (*line, Vec::new())).collect();
    for column in &table.columns {
        let name = column.plain_name();
        if !is_known(&name) && column.is_aside() {
            continue;
        }
        let values = table.numbers(column)?;
        if let Some(infinite) = column.blanks.iter().find(|blank| !blank.text.is_empty()) {
            return Err(table.cell_error(infinite.row, column, "a finite number, or an empty cell").into());
        }
        for ((_, row), value) in cells.iter_mut().zip(values) {
            row.push(Some(*value).filter(|value| value.is_finite()));
        }
        names.push(name);
    }
    Ok((names, cells))
}

/// The rows as CSV, as [`read_measurements`] reads them; without standard deviations and covariances.
pub fn write_measurements(rows: &[Row]) -> (Vec<String>, Vec<Vec<String>>) {
    let cables = rows.iter().filter_map(|row| row.lengths.as_ref()).map(Vec::len).max().unwrap_or(0);
    let mut columns: Vec<Column> = (0..cables).map(|i| Column::Reading(Quantity::Length(i))).collect();
    for reading in rows.iter().flat_map(|row| &row.readings) {
        let column = Column::Reading(reading.quantity);
        if !columns.contains(&column) && !matches!(reading.quantity, Quantity::Rotation(_)) {
            columns.push(column);
        }
    }
    if rows.iter().any(|row| row.rotation.is_some()) {
        columns.extend((0..4).map(Column::Quaternion));
    }
    columns.extend(Column::OF_LOADS.into_iter().filter(|column| rows.iter().any(|row| column.is_in(row))));
    let line = |row: &Row| {
        let cell = |column: &Column| column.value(row).map(|value| value.to_string()).unwrap_or_default();
        columns.iter().map(cell).collect()
    };
    (columns.iter().map(Column::name).collect(), rows.iter().map(line).collect())
}
