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
//! | `payload_kg`, `mass_kg`, `fx_n` ... `mz_nm` | the known load: added mass, mass of the platform, force, moment |
//! | `std_` before one of these | its standard deviation in this row; of an orientation `std_rx_rad` ... |
//! | `cov_x_m_y_m` | covariance of two of these in this row |
//!
//! The JSON form has the same names, and null for what was not measured. Lengths may be in `m` or `mm`,
//! angles in `deg` or `rad`, forces in `n` or `kn`.

mod columns;
mod row;

use crate::campaign::{Noise, Quantity, Row};
use crate::error::CalibrationError;
use crate::table::columns::{Column, Named, columns, covariance_of};
use crate::table::row::{Stated, row};
use cdpr_robot::{Robot, from_json};
use csv::{ReaderBuilder, StringRecord, Trim};
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
}

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

/// Reads measurements of a robot from the text of a file. `noise` holds where a row has no `std_` column; it
/// goes before what a JSON form says.
///
/// # Errors
/// [`CalibrationError::Column`] for a column that is unknown, twice or of a cable that the robot does not
/// have; [`CalibrationError::Cell`] naming line and column; [`CalibrationError::Json`].
pub fn read_measurements(
    text: &str,
    robot: &Robot,
    noise: &[(String, f64)],
) -> Result<Measurements, CalibrationError> {
    let (header, cells, noise) = if text.trim_start().starts_with('{') {
        let form: JsonForm = from_json(text)?;
        if form.format != MEASUREMENTS_FORMAT {
            return Err(CalibrationError::invalid("format", form.format, MEASUREMENTS_FORMAT));
        }
        let mut names: Vec<String> = form.rows.iter().flat_map(|row| row.keys().cloned()).collect();
        names.sort();
        names.dedup();
        let cell = |row: &BTreeMap<String, Option<f64>>, name| {
            row.get(name).copied().flatten().map(|number| number.to_string()).unwrap_or_default()
        };
        let cells = form.rows.iter().enumerate();
        let cells =
            cells.map(|(k, row)| (k + 1, names.iter().map(|name| cell(row, name)).collect())).collect();
        let mut all: Vec<(String, f64)> = form.noise.into_iter().collect();
        all.retain(|(name, _)| !noise.iter().any(|(own, _)| own == name));
        all.extend_from_slice(noise);
        (names, cells, all)
    } else {
        let (header, cells) = lines(text)?;
        (header, cells, noise.to_vec())
    };
    let columns = columns(&header, robot)?;
    let (covariances, stds): (Vec<_>, Vec<_>) =
        noise.into_iter().partition(|(name, _)| name.starts_with("cov_"));
    let covariances = covariances.into_iter().map(|(name, value)| {
        let expected = "two quantities that are measured, cov_x_m_y_m";
        let (one, other, factor) = covariance_of(&name)
            .ok_or_else(|| CalibrationError::invalid(format!("noise {name}"), value, expected))?;
        Ok((one, other, value * factor))
    });
    let covariances = covariances.collect::<Result<_, CalibrationError>>()?;
    let noise = Stated { stds: Noise::named(&stds)?, covariances };
    let rows: Vec<Row> = cells
        .iter()
        .map(|(line, cells): &(usize, Vec<String>)| row(*line, cells, &columns, robot, &noise))
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
    Ok(Measurements {
        noise_is_stated: columns.iter().any(is_stated),
        markers: markers.max().unwrap_or(0),
        rows,
    })
}

/// Header and lines of a CSV.
#[allow(clippy::type_complexity)]
fn lines(text: &str) -> Result<(Vec<String>, Vec<(usize, Vec<String>)>), CalibrationError> {
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let unread = |line, error: csv::Error| CalibrationError::Incomplete { line, reason: error.to_string() };
    let mut header: Option<Vec<String>> = None;
    let mut cells = Vec::new();
    let mut record = StringRecord::new();
    loop {
        let line = reader.position().line() as usize;
        if !reader.read_record(&mut record).map_err(|error| unread(line, error))? {
            break;
        }
        let line = record.position().map_or(line, |position| position.line() as usize);
        let values: Vec<String> = record.iter().map(str::to_owned).collect();
        if values.iter().all(String::is_empty) {
            continue;
        }
        let Some(names) = &header else {
            header = Some(values);
            continue;
        };
        if values.len() != names.len() {
            let reason = format!("{} cells: expected {}, one for each column", values.len(), names.len());
            return Err(CalibrationError::Incomplete { line, reason });
        }
        cells.push((line, values));
    }
    Ok((header.unwrap_or_default(), cells))
}

/// The rows as CSV, as [`read_measurements`] reads them.
pub fn write_measurements(rows: &[Row]) -> (Vec<String>, Vec<Vec<String>>) {
    let mut header: Vec<String> = Vec::new();
    let mut quantities: Vec<Quantity> = Vec::new();
    for reading in rows.iter().flat_map(|row| &row.readings) {
        if !quantities.contains(&reading.quantity) && !matches!(reading.quantity, Quantity::Rotation(_)) {
            quantities.push(reading.quantity);
        }
    }
    let rotated = rows.iter().any(|row| row.rotation.is_some());
    let cables = rows.iter().filter_map(|row| row.lengths.as_ref()).map(Vec::len).max().unwrap_or(0);
    let loaded = rows.iter().any(|row| row.load.payload != 0.0);
    header.extend((0..cables).map(|i| Quantity::Length(i).to_string()));
    header.extend(quantities.iter().map(ToString::to_string));
    if rotated {
        header.extend(["qw", "qx", "qy", "qz"].map(str::to_owned));
    }
    if loaded {
        header.push("payload_kg".to_owned());
    }
    let cell = |value: Option<f64>| value.map(|value| value.to_string()).unwrap_or_default();
    let line = |row: &Row| {
        let mut cells: Vec<String> =
            (0..cables).map(|i| cell(row.lengths.as_ref().map(|lengths| lengths[i]))).collect();
        cells.extend(quantities.iter().map(|quantity| cell(row.value(*quantity))));
        if rotated {
            let quaternion = row.rotation.map(|rotation| {
                cdpr_robot::Pose { position: cdpr_robot::Vector3::zeros(), rotation }.quaternion()
            });
            cells.extend((0..4).map(|k| cell(quaternion.map(|q| q[k]))));
        }
        if loaded {
            cells.push(row.load.payload.to_string());
        }
        cells
    };
    (header, rows.iter().map(line).collect())
}
