//! A table of points: CSV with a cable a line. Columns are found by meaning: `Exit X [mm]` is `exit_x`.

mod columns;

use crate::document::{finite, short};
use crate::draft::{Draft, DraftCable, Note, NoteKind};
use crate::error::ExchangeError;
use crate::read::points::columns::{Column, Meaning, NAMES, harmless, is_number, meaning};
use cdpr_robot::{CableProperties, Pulley, Vector3};
use std::collections::HashMap;

/// Columns that every table has.
const POINTS: [&str; 6] = ["exit_x", "exit_y", "exit_z", "anchor_x", "anchor_y", "anchor_z"];

/// Whether the first line of a text names columns of such a table.
pub(crate) fn is_table(text: &str) -> bool {
    let line = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#'));
    line.is_some_and(|line| {
        let mut names = line.split([',', ';', '\t']);
        line.contains([',', ';', '\t'])
            && names.any(|name| meaning(name).is_some_and(|m| POINTS.contains(&m.name)))
    })
}

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
    let mut draft = Draft::of_file(file, "");
    draft.source = format!("Imported from {file}, a table of points.");
    let mut table =
        csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(text.as_bytes());
    let header = table.headers().map_err(syntax)?.clone();
    if let (1, Some(other)) = (header.len(), header[0].chars().find(|c| [';', '\t'].contains(c))) {
        let message = format!("the separator is {other:?}: expected commas, and points in numbers");
        return Err(ExchangeError::Syntax { file: file.to_owned(), line: 1, column: 1, message });
    }
    let columns = find_columns(&mut draft, file, &header)?;
    let value = |line: usize, element: &str, value: &str, expected: &str| ExchangeError::Value {
        file: file.to_owned(),
        line,
        column: columns.get(element).map_or(1, |column| column.index + 1),
        element: element.to_owned(),
        value: value.to_owned(),
        expected: expected.to_owned(),
    };
    if let Some(missing) = POINTS.iter().find(|name| !columns.contains_key(*name)) {
        return Err(value(1, missing, "missing", &format!("the columns {}", POINTS.join(", "))));
    }
    let numbered = header.iter().position(is_number);
    let mut before: Option<i64> = None;
    for row in table.records() {
        let row = row.map_err(syntax)?;
        let line = row.position().map_or(0, |position| position.line() as usize);
        if let Some(index) = numbered {
            before = next_number(file, (line, index), &header, &row, before)?;
        }
        let number = |name: &str| -> Result<Option<f64>, ExchangeError> {
            let Some(column) = columns.get(name) else { return Ok(None) };
            let Some(text) = row.get(column.index).filter(|text| !text.is_empty()) else { return Ok(None) };
            let number = finite(text).map(|number| column.factor * number);
            number
                .map(Some)
                .ok_or_else(|| value(line, name, &format!("{:?}", short(text)), "a finite number"))
        };
        let need = |name: &str| number(name)?.ok_or_else(|| value(line, name, "empty", "a finite number"));
        let vector =
            |[x, y, z]: [&str; 3]| Ok::<_, ExchangeError>(Vector3::new(need(x)?, need(y)?, need(z)?));
        let radius = number("radius")?.filter(|radius| *radius != 0.0);
        let properties = match (number("section")?, number("linear_density")?, number("youngs_modulus")?) {
            (Some(section), Some(density), Some(modulus)) => Some(CableProperties {
                diameter: number("diameter")?,
                breaking_force: number("breaking_force")?,
                ..CableProperties::linear(section, density, modulus)
            }),
            (None, None, None) => None,
            _ => {
                let expected = "section, linear_density and youngs_modulus";
                return Err(value(line, "section", "not complete", expected));
            }
        };
        draft.cables.push(DraftCable {
            exit_point: vector(["exit_x", "exit_y", "exit_z"])?,
            anchor_point: vector(["anchor_x", "anchor_y", "anchor_z"])?,
            pulley: match radius {
                Some(radius) => Some(Pulley { radius, axis: vector(["axis_x", "axis_y", "axis_z"])? }),
                None => None,
            },
            lead: number("lead")?.unwrap_or(0.0),
            min: number("tension_min")?,
            max: number("tension_max")?,
            properties,
            ..DraftCable::default()
        });
    }
    Ok(draft)
}

/// The number of a cable in column `index`, refused where it does not follow that of the row before.
fn next_number(
    file: &str,
    (line, index): (usize, usize),
    header: &csv::StringRecord,
    row: &csv::StringRecord,
    before: Option<i64>,
) -> Result<Option<i64>, ExchangeError> {
    let number = row.get(index).and_then(|text| text.parse::<i64>().ok());
    match (before.map(|before| before.saturating_add(1)), number) {
        (Some(next), Some(number)) if number != next => Err(ExchangeError::Value {
            file: file.to_owned(),
            line,
            column: index + 1,
            element: header[index].to_owned(),
            value: number.to_string(),
            expected: format!("{next}: each cable once and in order, none left out"),
        }),
        _ => Ok(number),
    }
}

/// The columns of a header by their names in this program.
fn find_columns(
    draft: &mut Draft,
    file: &str,
    header: &csv::StringRecord,
) -> Result<HashMap<&'static str, Column>, ExchangeError> {
    let mut columns: HashMap<&'static str, Column> = HashMap::new();
    let (mut ignored, mut unknown, mut by_letter) = (Vec::new(), Vec::new(), Vec::new());
    for (index, name) in header.iter().enumerate() {
        let Some(Meaning { name: found, factor, is_letter }) = meaning(name) else {
            if harmless(name) { &mut ignored } else { &mut unknown }.push(short(name));
            continue;
        };
        if is_letter {
            by_letter.push(short(name));
        }
        if let Some(first) = columns.insert(found, Column { index, factor }) {
            return Err(ExchangeError::Value {
                file: file.to_owned(),
                line: 1,
                column: index + 1,
                element: name.to_owned(),
                value: format!("a second column of {found}, after {:?}", &header[first.index]),
                expected: "one".to_owned(),
            });
        }
    }
    let mut note = |kind: NoteKind, names: &[std::borrow::Cow<str>], said: &str| {
        if !names.is_empty() {
            let listed = names.iter().take(NAMES).cloned().collect::<Vec<_>>().join(", ");
            let more = names.len().saturating_sub(NAMES);
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            let columns = if names.len() == 1 { "column" } else { "columns" };
            let text = format!("{columns} {listed}{more}{said}");
            draft.notes.push(Note { kind, place: Some((file.to_owned(), 1)), text });
        }
    };
    note(NoteKind::NoPlace, &ignored, "");
    note(NoteKind::Questioned, &unknown, ": not known and not imported");
    let said = ": a is read as the anchor point on the platform, b as the exit point; elsewhere a may be \
                on the frame";
    note(NoteKind::Questioned, &by_letter, said);
    Ok(columns)
}
