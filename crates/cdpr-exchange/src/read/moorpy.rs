//! Systems of MoorPy and MoorDyn: sections of lines of words. <https://github.com/NREL/MoorPy>
//!
//! One free body hangs on lines from fixed points; where there is no body, one free point does. `Diam` is the
//! diameter of a full section S, and E = EA/S. Position and unstrained lengths are those of a state.

use crate::document::{finite, short};
use crate::draft::{Draft, DraftCable, Note, NoteKind};
use crate::error::ExchangeError;
use cdpr_robot::{CableProperties, Matrix3, Vector3};
use std::collections::HashMap;
use std::f64::consts::PI;

/// Density of the water where the options do not have it [kg/m³].
const WATER: f64 = 1025.0;

/// Whether a text is such a system.
pub(crate) fn is_system(text: &str) -> bool {
    text.lines().any(|line| section(line) == Some(Section::LineTypes))
}

/// Sections that are known.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Section {
    LineTypes,
    RodTypes,
    Bodies,
    Rods,
    Points,
    Lines,
    Options,
    Outputs,
    /// Text before the first section, and after the last one.
    Text,
    Unknown,
}

/// The section that begins with a line, if one does.
fn section(line: &str) -> Option<Section> {
    if !line.contains("---") {
        return None;
    }
    let line = line.to_uppercase();
    let named = |names: &[&str]| names.iter().any(|name| line.contains(name));
    Some(match () {
        () if named(&["LINE TYPES", "LINE DICTIONARY"]) => Section::LineTypes,
        () if named(&["ROD TYPES", "ROD DICTIONARY"]) => Section::RodTypes,
        () if named(&["BODIES", "BODY"]) => Section::Bodies,
        () if named(&["RODS", "ROD LIST", "ROD PROPERTIES"]) => Section::Rods,
        () if named(&["POINT", "CONNECTION", "NODE PROPERTIES"]) => Section::Points,
        () if named(&["OPTIONS"]) => Section::Options,
        () if named(&["OUTPUT"]) => Section::Outputs,
        () if named(&["LINES", "LINE LIST", "LINE PROPERTIES"]) => Section::Lines,
        () if named(&["NEED THIS LINE", "INPUT FILE"]) || !line.contains(|c: char| c.is_alphabetic()) => {
            Section::Text
        }
        () => Section::Unknown,
    })
}

/// A line of a section.
struct Row<'a> {
    file: &'a str,
    line: usize,
    text: &'a str,
    words: Vec<&'a str>,
}

/// The rows of a section with the names of its columns.
#[derive(Default)]
struct Table<'a> {
    names: Vec<String>,
    rows: Vec<Row<'a>>,
}

impl<'a> Table<'a> {
    /// The word of a row in a column of one of these names, or else the `usual` one.
    fn word(&self, row: &Row<'a>, names: &[&str], usual: usize) -> Result<&'a str, ExchangeError> {
        let column = self.names.iter().position(|name| names.contains(&name.as_str())).unwrap_or(usual);
        row.words.get(column).copied().ok_or_else(|| row.error(names[0], "missing", "it to be there"))
    }

    fn number(&self, row: &Row<'a>, names: &[&str], usual: usize) -> Result<f64, ExchangeError> {
        let word = self.word(row, names, usual)?;
        finite(word).ok_or_else(|| row.error(names[0], word, "a finite number"))
    }

    fn vector(&self, row: &Row<'a>, names: [&str; 3], usual: usize) -> Result<Vector3<f64>, ExchangeError> {
        let [x, y, z] = [0, 1, 2].map(|i| self.number(row, &names[i..=i], usual + i));
        Ok(Vector3::new(x?, y?, z?))
    }

    /// Numbers with bars between them.
    fn list(&self, row: &Row<'a>, names: &[&str], usual: usize) -> Result<Vec<f64>, ExchangeError> {
        let word = self.word(row, names, usual)?;
        let numbers: Option<Vec<f64>> = word.split('|').map(finite).collect();
        let numbers = numbers.filter(|numbers| [1, 3].contains(&numbers.len()));
        numbers.ok_or_else(|| row.error(names[0], word, "one number, or three with bars between them"))
    }
}

impl Row<'_> {
    fn error(&self, element: &str, value: &str, expected: &str) -> ExchangeError {
        let offset = (value.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
        let column = if offset < self.text.len() { self.text[..offset].chars().count() + 1 } else { 1 };
        ExchangeError::Value {
            file: self.file.to_owned(),
            line: self.line,
            column,
            element: element.to_owned(),
            value: if value == "missing" { value.to_owned() } else { format!("{:?}", short(value)) },
            expected: expected.to_owned(),
        }
    }
}

/// Reads a system.
///
/// # Errors
/// [`ExchangeError::Value`] with file, line and column's name.
pub(crate) fn read(file: &str, text: &str) -> Result<Draft, ExchangeError> {
    let mut draft = Draft::of_file(file, "MoorPy or MoorDyn");
    let tables = tables(file, text);
    let empty = Table::default();
    let table = |section| tables.get(&section).unwrap_or(&empty);
    if let Some(rod) = table(Section::Rods).rows.first() {
        return Err(rod.error("rods", "a rod", "none: rods are not imported"));
    }
    let question = |draft: &mut Draft, row: &Row, text: String| {
        let place = Some((file.to_owned(), row.line));
        draft.notes.push(Note { kind: NoteKind::Questioned, place, text });
    };
    if let Some(row) = table(Section::Unknown).rows.first() {
        question(&mut draft, row, "a section of another kind: not known and not imported".to_owned());
    }
    let in_water = read_options(&mut draft, table(Section::Options))?;
    let types = line_types(table(Section::LineTypes))?;
    let stiff = |row: &&Row| {
        let bending = table(Section::LineTypes).word(row, &["ei"], 5).ok().and_then(finite);
        bending.is_some_and(|bending| bending != 0.0)
    };
    if let Some(row) = table(Section::LineTypes).rows.iter().find(stiff) {
        question(&mut draft, row, "EI: cables of a robot have no bending stiffness".to_owned());
    }
    let body = read_body(&mut draft, table(Section::Bodies))?;
    let points = read_points(&mut draft, table(Section::Points), body)?;
    let lines = table(Section::Lines);
    for row in &lines.rows {
        let name = lines.word(row, &["linetype", "type"], 1)?;
        let properties =
            types.get(name).ok_or_else(|| row.error("LineType", name, "a name of the line types"))?;
        let ends = [
            lines.word(row, &["attacha", "enda", "nodea", "nodeanch"], 2)?,
            lines.word(row, &["attachb", "endb", "nodeb", "nodefair"], 3)?,
        ];
        let mut exit_and_anchor = (None, None);
        for end in ends {
            let is_rod = end.starts_with(['r', 'R']);
            let point = number_of(end).filter(|_| !is_rod).and_then(|number| points.get(&number));
            match point {
                Some(Point::Fixed(position)) => exit_and_anchor.0 = Some(*position),
                Some(Point::OnBody(position)) => exit_and_anchor.1 = Some(*position),
                None => return Err(row.error("attachment", end, "the number of a point")),
            }
        }
        let (Some(exit_point), Some(anchor_point)) = exit_and_anchor else {
            return Err(row.error(
                "attachment",
                ends[0],
                "one end at a fixed point, the other one at the body",
            ));
        };
        draft.cables.push(DraftCable {
            exit_point,
            anchor_point,
            properties: Some(properties.clone()),
            ..DraftCable::default()
        });
    }
    if let (Some(density), Some(row)) = (in_water, lines.rows.first()) {
        let text = format!(
            "the lines hang in water of {density} kg/m³: cables and platform of the robot weigh as in air"
        );
        question(&mut draft, row, text);
    }
    let text = "the position of the body and the unstrained lengths, which are a state of the robot";
    draft.notes.push(Note { kind: NoteKind::NoPlace, place: None, text: text.to_owned() });
    Ok(draft)
}

fn tables<'a>(file: &'a str, text: &'a str) -> HashMap<Section, Table<'a>> {
    let mut tables: HashMap<Section, Table> = HashMap::new();
    // Lines of the names and units of columns that are to come.
    let (mut current, mut heading) = (Section::Text, 0);
    for (i, line) in text.lines().enumerate() {
        if let Some(next) = section(line) {
            heading = if next == Section::Options { 0 } else { 2 };
            current = next;
            continue;
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        if heading > 0 {
            if heading == 2 {
                let plain = |word: &&str| word.trim_end_matches('*').to_lowercase();
                tables.entry(current).or_default().names = words.iter().map(plain).collect();
            }
            heading -= 1;
        } else if !words.is_empty() && ![Section::Text, Section::Outputs].contains(&current) {
            tables.entry(current).or_default().rows.push(Row { file, line: i + 1, text: line, words });
        }
    }
    tables
}

/// Reads gravity, and returns the density of the water that is not none [kg/m³].
fn read_options(draft: &mut Draft, options: &Table) -> Result<Option<f64>, ExchangeError> {
    let mut density = WATER;
    for row in &options.rows {
        let [value, name, ..] = row.words[..] else { continue };
        let number = || finite(value).ok_or_else(|| row.error(name, value, "a finite number"));
        match name.to_lowercase().as_str() {
            "g" | "gravity" => draft.gravity = Some(Vector3::new(0.0, 0.0, -number()?)),
            "rho" | "wtrdnsty" => density = number()?,
            _ => {}
        }
    }
    Ok(Some(density).filter(|density| *density != 0.0))
}

fn line_types<'a>(types: &Table<'a>) -> Result<HashMap<&'a str, CableProperties>, ExchangeError> {
    let mut found = HashMap::new();
    for row in &types.rows {
        let name = types.word(row, &["typename", "name", "linetype"], 0)?;
        let positive = |names: &[&str], usual| {
            let number = types.number(row, names, usual)?;
            let word = types.word(row, names, usual)?;
            if number > 0.0 { Ok(number) } else { Err(row.error(names[0], word, "a positive number")) }
        };
        let diameter = positive(&["diam"], 1)?;
        let density = types.number(row, &["mass/m", "massden", "massdenair", "massdeninair"], 2)?;
        let (stiffness, section) = (positive(&["ea"], 3)?, PI / 4.0 * diameter * diameter);
        let properties = CableProperties {
            diameter: Some(diameter),
            ..CableProperties::linear(section, density, stiffness / section)
        };
        if found.insert(name, properties).is_some() {
            return Err(row.error("TypeName", name, "a name of one line type"));
        }
    }
    Ok(found)
}

/// Reads the body and returns its number; `None` without a body.
fn read_body(draft: &mut Draft, bodies: &Table) -> Result<Option<u64>, ExchangeError> {
    let [row] = &bodies.rows[..] else {
        let Some(second) = bodies.rows.get(1) else { return Ok(None) };
        return Err(second.error(
            "bodies",
            second.words[0],
            "one body: robots with several are not imported",
        ));
    };
    let id = bodies.word(row, &["id", "body", "bodyid"], 0)?;
    let kind = bodies.word(row, &["attachment", "type"], 1)?;
    if ["fix", "anchor"].iter().any(|fixed| kind.to_lowercase().contains(fixed)) {
        return Err(row.error("Attachment", kind, "Free or Coupled"));
    }
    draft.mass = Some(bodies.number(row, &["mass"], 8)?);
    draft.center_of_mass = Some(match bodies.list(row, &["cg"], 9)?[..] {
        [x, y, z] => Vector3::new(x, y, z),
        ref z => Vector3::new(0.0, 0.0, z[0]),
    });
    let moments = match bodies.list(row, &["i"], 10)?[..] {
        [xx, yy, zz] => Vector3::new(xx, yy, zz),
        ref all => Vector3::repeat(all[0]),
    };
    draft.inertia = Some(Matrix3::from_diagonal(&moments));
    number_of(id).map(Some).ok_or_else(|| row.error("ID", id, "a number"))
}

/// A point that a line ends at.
enum Point {
    /// In the base frame [m].
    Fixed(Vector3<f64>),
    /// In the frame of the body [m].
    OnBody(Vector3<f64>),
}

/// Reads the points; without a body the one that is free is a point mass.
fn read_points(
    draft: &mut Draft,
    table: &Table,
    body: Option<u64>,
) -> Result<HashMap<u64, Point>, ExchangeError> {
    let mut points = HashMap::new();
    for row in &table.rows {
        let id = table.word(row, &["id", "node", "point"], 0)?;
        let kind = table.word(row, &["attachment", "type"], 1)?;
        let position = table.vector(row, ["x", "y", "z"], 2)?;
        let named = |names: &[&str]| names.iter().any(|name| kind.to_lowercase().contains(name));
        let mass = table.number(row, &["mass", "m"], 5).unwrap_or(0.0);
        let point = if named(&["fix", "anch"]) {
            Point::Fixed(position)
        } else if named(&["body", "turbine"]) {
            if number_of(kind) != body || body.is_none() {
                return Err(row.error("Attachment", kind, "the body of the file"));
            }
            if mass != 0.0 {
                return Err(row.error("Mass", id, "0 kg at a point of the body: its mass is the body's"));
            }
            Point::OnBody(position)
        } else if body.is_none() && !draft.held_rotation {
            (draft.held_rotation, draft.mass) = (true, Some(mass).filter(|mass| *mass > 0.0));
            draft.center_of_mass = Some(Vector3::zeros());
            Point::OnBody(Vector3::zeros())
        } else {
            let expected =
                "Fixed, or Body with the number of the one body: other free points are not imported";
            return Err(row.error("Attachment", kind, expected));
        };
        let number = number_of(id).ok_or_else(|| row.error("ID", id, "a number"))?;
        if points.insert(number, point).is_some() {
            return Err(row.error("ID", id, "a number of one point"));
        }
    }
    Ok(points)
}

/// The number in a word such as `Body1` or `P3`.
fn number_of(word: &str) -> Option<u64> {
    word.trim_matches(|c: char| !c.is_ascii_digit()).parse().ok()
}
