//! A table of points with one cable in each line, with the separators and decimal marks of all tables.
//! Columns are found by meaning: `Exit X [mm]` is `exit_x`.

mod columns;

use crate::document::short;
use crate::draft::{Draft, DraftCable, Note, NoteKind};
use crate::error::ExchangeError;
use crate::read::points::columns::{Column, Meaning, NAMES, harmless, is_number, meaning};
use cdpr_robot::{CableProperties, Pulley, Vector3};
use cdpr_study::{Cells, Table, TableError};
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
/// [`ExchangeError::Table`]; [`ExchangeError::Value`] with file, line and column's name.
pub(crate) fn read(file: &str, text: &str) -> Result<Draft, ExchangeError> {
    let in_table = |source: TableError| ExchangeError::Table { file: file.to_owned(), source };
    let table = Table::read(text.as_bytes()).map_err(in_table)?;
    let mut draft = Draft::of_file(file, "");
    draft.source = format!("Imported from {file}, a table of points.");
    let first = table.header.unwrap_or(1);
    let columns = find_columns(&mut draft, (file, first), &table)?;
    let value = |line: usize, element: &str, value: &str, expected: &str| ExchangeError::Value {
        file: file.to_owned(),
        line,
        column: columns.get(element).map_or(1, |column| column.index + 1),
        element: element.to_owned(),
        value: value.to_owned(),
        expected: expected.to_owned(),
    };
    if let Some(missing) = POINTS.iter().find(|name| !columns.contains_key(*name)) {
        return Err(value(first, missing, "missing", &format!("the columns {}", POINTS.join(", "))));
    }
    let numbered = table.columns.iter().position(|column| is_number(&column.name));
    let mut before: Option<i64> = None;
    for (row, line) in table.lines.iter().copied().enumerate() {
        if let Some(index) = numbered {
            before = next_number(file, (row, index), &table, before)?;
        }
        let number = |name: &str| -> Result<Option<f64>, ExchangeError> {
            let Some(column) = columns.get(name) else { return Ok(None) };
            let own = &table.columns[column.index];
            let number = table.numbers(own).map_err(in_table)?[row];
            let blank = own.blanks.binary_search_by_key(&row, |blank| blank.row);
            match blank.map(|at| own.blanks[at].text.as_str()) {
                Ok("") => Ok(None),
                Ok(text) => Err(value(line, name, &format!("{:?}", short(text)), "a finite number")),
                Err(_) => Ok(Some(column.in_si(number))),
            }
        };
        let need = |name: &str| {
            let has = if columns.contains_key(name) { "empty" } else { "missing" };
            number(name)?.ok_or_else(|| value(line, name, has, "a finite number"))
        };
        let vector =
            |[x, y, z]: [&str; 3]| Ok::<_, ExchangeError>(Vector3::new(need(x)?, need(y)?, need(z)?));
        let radius = number("radius")?.filter(|radius| *radius != 0.0);
        let (diameter, breaking_force) = (number("diameter")?, number("breaking_force")?);
        let properties = match (number("section")?, number("linear_density")?, number("youngs_modulus")?) {
            (Some(section), Some(density), Some(modulus)) => Some(CableProperties {
                diameter,
                breaking_force,
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
            diameter,
            breaking_force,
            ..DraftCable::default()
        });
    }
    Ok(draft)
}

/// The number of a cable in a row and a column, refused where it does not follow that of the row before.
fn next_number(
    file: &str,
    (row, index): (usize, usize),
    table: &Table,
    before: Option<i64>,
) -> Result<Option<i64>, ExchangeError> {
    let column = &table.columns[index];
    let number = match column.cells() {
        Ok(Cells::Numbers(numbers)) => Some(numbers[row]).filter(|n| n.fract() == 0.0).map(|n| n as i64),
        Ok(Cells::Text(texts)) => texts[row].parse().ok(),
        Err(_) => None,
    };
    match (before.map(|before| before.saturating_add(1)), number) {
        (Some(next), Some(number)) if number != next => Err(ExchangeError::Value {
            file: file.to_owned(),
            line: table.lines[row],
            column: index + 1,
            element: column.name.clone(),
            value: number.to_string(),
            expected: format!("{next}: each cable once and in order, none left out"),
        }),
        _ => Ok(number),
    }
}

/// The columns of a header by their names in this program.
fn find_columns(
    draft: &mut Draft,
    (file, line): (&str, usize),
    table: &Table,
) -> Result<HashMap<&'static str, Column>, ExchangeError> {
    let mut columns: HashMap<&'static str, Column> = HashMap::new();
    let (mut ignored, mut unknown, mut by_letter) = (Vec::new(), Vec::new(), Vec::new());
    for (index, name) in table.columns.iter().map(|column| column.name.as_str()).enumerate() {
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
                line,
                column: index + 1,
                element: name.to_owned(),
                value: format!("a second column of {found}, after {:?}", table.columns[first.index].name),
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
            draft.notes.push(Note { kind, place: Some((file.to_owned(), line)), text });
        }
    };
    note(NoteKind::NoPlace, &ignored, "");
    note(NoteKind::Questioned, &unknown, ": not known and not imported");
    let said = ": a is read as the anchor point on the platform, b as the exit point; elsewhere a may be \
                on the frame";
    note(NoteKind::Questioned, &by_letter, said);
    Ok(columns)
}
