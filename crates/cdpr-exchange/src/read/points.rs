//! A table of points: CSV with a cable a line.

use crate::draft::{Draft, DraftCable, Note, NoteKind};
use crate::error::ExchangeError;
use cdpr_robot::{CableProperties, Pulley, Vector3};
use std::collections::HashMap;

/// Columns that every table has.
const POINTS: [&str; 6] = ["exit_x", "exit_y", "exit_z", "anchor_x", "anchor_y", "anchor_z"];

/// Columns that a table may have.
const FURTHER: [&str; 9] = [
    "radius",
    "axis_x",
    "axis_y",
    "axis_z",
    "section",
    "linear_density",
    "youngs_modulus",
    "tension_min",
    "tension_max",
];

/// Reads a table.
///
/// # Errors
/// [`ExchangeError::Syntax`]; [`ExchangeError::Value`] with file, line and column's name.
pub(crate) fn read(file: &str, text: &str) -> Result<Draft, ExchangeError> {
    let syntax = |error: csv::Error| ExchangeError::Syntax {
        file: file.to_owned(),
        line: error.position().map_or(1, |position| position.line() as usize),
        column: 1,
        message: error.to_string(),
    };
    let stem = file.rsplit(['/', '\\']).next().unwrap_or("robot");
    let mut draft = Draft {
        name: stem.split('.').next().unwrap_or(stem).to_owned(),
        source: format!("Imported from {file}, a table of points."),
        ..Draft::default()
    };
    let mut table =
        csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(text.as_bytes());
    let header = table.headers().map_err(syntax)?.clone();
    let columns: HashMap<&str, usize> = header.iter().enumerate().map(|(i, name)| (name, i)).collect();
    let value = |line: usize, element: &str, value: &str, expected: &str| ExchangeError::Value {
        file: file.to_owned(),
        line,
        column: columns.get(element).map_or(1, |i| i + 1),
        element: element.to_owned(),
        value: value.to_owned(),
        expected: expected.to_owned(),
    };
    if let Some(missing) = POINTS.iter().find(|name| !columns.contains_key(*name)) {
        return Err(value(1, missing, "missing", &format!("the columns {}", POINTS.join(", "))));
    }
    for name in header.iter().filter(|name| !POINTS.contains(name) && !FURTHER.contains(name)) {
        let place = Some((file.to_owned(), 1));
        draft.notes.push(Note { kind: NoteKind::NoPlace, place, text: format!("column {name}") });
    }
    for row in table.records() {
        let row = row.map_err(syntax)?;
        let line = row.position().map_or(0, |position| position.line() as usize);
        let number = |name: &str| -> Result<Option<f64>, ExchangeError> {
            let Some(text) = columns.get(name).and_then(|i| row.get(*i)).filter(|text| !text.is_empty())
            else {
                return Ok(None);
            };
            let number = text.parse().ok().filter(|number: &f64| number.is_finite());
            number.map(Some).ok_or_else(|| value(line, name, &format!("{text:?}"), "a finite number"))
        };
        let need = |name: &str| number(name)?.ok_or_else(|| value(line, name, "empty", "a finite number"));
        let vector =
            |[x, y, z]: [&str; 3]| Ok::<_, ExchangeError>(Vector3::new(need(x)?, need(y)?, need(z)?));
        let radius = number("radius")?.filter(|radius| *radius != 0.0);
        let properties = match (number("section")?, number("linear_density")?, number("youngs_modulus")?) {
            (Some(section), Some(density), Some(modulus)) => {
                Some(CableProperties::linear(section, density, modulus))
            }
            (None, None, None) => None,
            _ => {
                return Err(value(
                    line,
                    "section",
                    "not complete",
                    "section, linear_density and youngs_modulus",
                ));
            }
        };
        draft.cables.push(DraftCable {
            exit_point: vector(["exit_x", "exit_y", "exit_z"])?,
            anchor_point: vector(["anchor_x", "anchor_y", "anchor_z"])?,
            pulley: match radius {
                Some(radius) => Some(Pulley { radius, axis: vector(["axis_x", "axis_y", "axis_z"])? }),
                None => None,
            },
            min: number("tension_min")?,
            max: number("tension_max")?,
            properties,
            stiffness: None,
        });
    }
    Ok(draft)
}
