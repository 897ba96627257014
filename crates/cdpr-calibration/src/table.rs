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
//! | `std_` before one of these | its standard deviation in this row |
//!
//! Lengths may be in `m` or `mm`, angles in `deg` or `rad`, forces in `n` or `kn`.

use crate::campaign::{Noise, Quantity, Reading, Row};
use crate::error::CalibrationError;
use cdpr_robot::{Axis, CableEnd, Robot, from_json, rotation_in_order};
use cdpr_statics::Load;
use csv::{ReaderBuilder, StringRecord, Trim};
use serde::Deserialize;
use std::collections::BTreeMap;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Column {
    Reading(Quantity),
    /// Component of a quaternion (w, x, y, z).
    Quaternion(usize),
    Payload,
    Mass,
    /// Component of the load: force, then moment.
    Wrench(usize),
}

/// A column with the factor to SI units.
#[derive(Clone, Debug)]
struct Named {
    name: String,
    column: Column,
    factor: f64,
    /// Whether it is the standard deviation of the quantity.
    is_std: bool,
}

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
    rows: Vec<BTreeMap<String, f64>>,
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
        let cell = |row: &BTreeMap<String, f64>, name| row.get(name).map(f64::to_string).unwrap_or_default();
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
    let noise = Noise::named(&noise)?;
    let rows: Vec<Row> = cells
        .iter()
        .map(|(line, cells): &(usize, Vec<String>)| row(*line, cells, &columns, robot, &noise))
        .collect::<Result<_, _>>()?;
    if rows.is_empty() {
        return Err(CalibrationError::invalid("measurements", "empty", "a row for each pose below a header"));
    }
    let is_stated = |named: &Named| match named.column {
        Column::Reading(Quantity::Length(_)) => false,
        Column::Reading(quantity) => named.is_std || noise.of(quantity).is_some(),
        Column::Quaternion(_) => noise.rotation.is_some(),
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

fn columns(header: &[String], robot: &Robot) -> Result<Vec<Named>, CalibrationError> {
    let mut columns: Vec<Named> = Vec::new();
    for name in header {
        let wrong =
            |expected: &str| CalibrationError::Column { column: name.clone(), expected: expected.to_owned() };
        let expected = "a name such as x_m, qw, roll_deg, l1_m, t1_n, t1_winch_n, marker1_x_m, dx_m, \
                        swivel1_deg, payload_kg, mass_kg, fx_n, mx_nm or std_x_m";
        let (is_std, base) = name.strip_prefix("std_").map_or((false, name.as_str()), |base| (true, base));
        let (column, factor) = column(&base.to_ascii_lowercase()).ok_or_else(|| wrong(expected))?;
        let cable = match column {
            Column::Reading(Quantity::Length(i) | Quantity::Tension(i, _) | Quantity::Swivel(i)) => Some(i),
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
        if columns.iter().any(|other| other.column == column && other.is_std == is_std) {
            return Err(wrong("each quantity once"));
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

/// A column by its name without `std_`.
fn column(name: &str) -> Option<(Column, f64)> {
    if let Some(k) = ["qw", "qx", "qy", "qz"].iter().position(|own| *own == name) {
        return Some((Column::Quaternion(k), 1.0));
    }
    let (base, unit) = name.rsplit_once('_')?;
    let length = match unit {
        "m" => Some(1.0),
        "mm" => Some(1e-3),
        _ => None,
    };
    let force = match unit {
        "n" => Some(1.0),
        "kn" => Some(1e3),
        _ => None,
    };
    let angle = match unit {
        "rad" => Some(1.0),
        "deg" => Some(1f64.to_radians()),
        _ => None,
    };
    let axis = |letter: &str| Axis::from_letter(letter);
    let numbered = |word: &str| base.strip_prefix(word)?.parse::<usize>().ok()?.checked_sub(1);
    let of = |quantity: Quantity, factor: Option<f64>| Some((Column::Reading(quantity), factor?));
    if let Some(axis) = axis(base) {
        return of(Quantity::Position(axis), length);
    }
    if let Some(k) = ["roll", "pitch", "yaw"].iter().position(|own| *own == base) {
        return of(Quantity::Angle(k), angle);
    }
    if let Some(axis) = base.strip_prefix('d').and_then(axis) {
        return of(Quantity::Displacement(axis), length);
    }
    if let Some(axis) = base.strip_prefix('f').and_then(axis) {
        return Some((Column::Wrench(axis.index()), force?));
    }
    if let Some(axis) = base.strip_prefix('m').and_then(axis) {
        return (unit == "nm").then_some((Column::Wrench(3 + axis.index()), 1.0));
    }
    if unit == "kg" {
        let column = match base {
            "payload" => Column::Payload,
            "mass" => Column::Mass,
            _ => return None,
        };
        return Some((column, 1.0));
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

fn row(
    line: usize,
    cells: &[String],
    columns: &[Named],
    robot: &Robot,
    noise: &Noise,
) -> Result<Row, CalibrationError> {
    let cell_error = |named: &Named, value: &str, expected: &str| CalibrationError::Cell {
        line,
        column: named.name.clone(),
        value: value.to_owned(),
        expected: expected.to_owned(),
    };
    let mut values: Vec<Option<f64>> = Vec::with_capacity(columns.len());
    for (named, text) in columns.iter().zip(cells) {
        let value = match text.as_str() {
            "" => None,
            text => {
                let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
                Some(number.ok_or_else(|| cell_error(named, text, "a finite number, or an empty cell"))?)
            }
        };
        values.push(value.map(|value| value * named.factor));
    }
    let find = |column: Column, is_std: bool| {
        let found = columns.iter().position(|named| named.column == column && named.is_std == is_std)?;
        values[found].map(|value| (value, &columns[found]))
    };
    let std_of = |quantity: Quantity| -> Result<Option<f64>, CalibrationError> {
        match find(Column::Reading(quantity), true) {
            Some((std, _)) if std > 0.0 => Ok(Some(std)),
            Some((std, named)) => Err(cell_error(named, &std.to_string(), "a positive standard deviation")),
            None => Ok(noise.of(quantity)),
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
            let std = noise.rotation.unwrap_or(Noise::exact(Quantity::Rotation(Axis::X)));
            let reading = |axis| Reading { quantity: Quantity::Rotation(axis), value: 0.0, std };
            row.readings.extend(Axis::ALL.map(reading));
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
