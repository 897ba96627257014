//! JSON text to data, with line and column of what is wrong.

use serde::de::{Deserialize, DeserializeOwned, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::de::StrRead;
use serde_json::value::RawValue;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Where a JSON text differs from what was expected: a missing, misspelt or mistyped field, or no JSON.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}, column {column}: {}: {message}", numbered(field))]
pub struct JsonError {
    /// Path of the field, such as `cables[2].exit_point`; `the whole text` if no field in particular is
    /// wrong.
    pub field: String,
    /// Line in the text, from 1.
    pub line: usize,
    /// Column in that line.
    pub column: usize,
    /// What was found and what was expected.
    pub message: String,
}

impl JsonError {
    fn new(field: String, error: &serde_json::Error, text: &str) -> Self {
        // serde_json ends its message with line and column, which are fields of their own here.
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or_default();
        // Without a name for the last step, the field is the one that contains it.
        let field = field.trim_end_matches('?').trim_end_matches('.');
        let place = (error.line(), error.column());
        let (place, message) = match missing_comma(text, place, message) {
            Some(end) => (end, "a comma is missing here".to_owned()),
            None => (place, slip(text, place, message).unwrap_or_else(|| plain(message, field))),
        };
        let (line, column) = place;
        let field = if field.is_empty() { "the whole text" } else { field }.to_owned();
        Self { field, line, column, message }
    }
}

/// The message of serde_json without the names of Rust's types.
fn plain(message: &str, field: &str) -> String {
    match message {
        "expected value" => {
            return "expected a JSON value of this field's kind; NaN, Infinity and bare words are not JSON"
                .to_owned();
        }
        "number out of range" => return "number out of range, expected a finite number".to_owned(),
        "EOF while parsing a value" => return "the text ends where a JSON value is expected".to_owned(),
        "key must be a string" => return "expected a name in double quotes".to_owned(),
        "trailing characters" if !field.is_empty() => return "expected the end of the list here".to_owned(),
        _ => {}
    }
    let message = message
        .replace("EOF while parsing", "the text ends within")
        .replace("expected f64", "expected a number")
        .replace("expected usize", COUNT)
        .replace("expected u64", COUNT);
    let (before, behind) = message.split_once("expected struct ").unwrap_or((&message, ""));
    let behind = behind.trim_start_matches(char::is_alphanumeric);
    let message = if before.len() < message.len() {
        format!("{before}expected an object {{..}}{behind}")
    } else {
        message
    };
    let is_matrix = field.ends_with(']') && message.ends_with("expected an array of length 3");
    if is_matrix {
        return message + "; a diagonal matrix is [[a, 0, 0], [0, b, 0], [0, 0, c]]";
    }
    let home = home(&message, field).map(|home| format!("; {home}"));
    message + &home.unwrap_or_default()
}

/// Where a field of a robot file belongs that is one level too high.
fn home(message: &str, field: &str) -> Option<&'static str> {
    let name = message.strip_prefix("unknown field `")?.split('`').next()?;
    let in_cables = field.starts_with("cables[");
    let is_robot = in_cables || message.contains("`platform`") && message.contains("`cables`");
    match name {
        "mass" | "center_of_mass" | "inertia" | "point" if is_robot => Some("it is a field of `platform`"),
        "linear_density" | "section" | "diameter" | "youngs_modulus" | "breaking_force" if in_cables => {
            Some("the properties of one cable are in its `cable`")
        }
        "linear_density" | "section" | "diameter" | "youngs_modulus" | "breaking_force" if is_robot => {
            Some("the properties of all cables are in `cable`")
        }
        "min" | "max" | "max_at" if is_robot => Some("it is a field of `tension_limits`"),
        "exit_point" | "anchor_point" if is_robot && !in_cables => Some("each entry of `cables` has its own"),
        _ => None,
    }
}

/// What counts and seeds are.
const COUNT: &str = "expected a whole number, 0 to 1.8e19";

/// Line and column behind a value that lacks its comma, if it is the next value that was not expected. The
/// next value is often on another line.
fn missing_comma(text: &str, (line, column): (usize, usize), message: &str) -> Option<(usize, usize)> {
    let start: usize = text.split_inclusive('\n').take(line.checked_sub(1)?).map(str::len).sum();
    let (before, next) = text.split_at_checked(start + column.checked_sub(1)?)?;
    let begins_value = next.starts_with(|c: char| c.is_ascii_digit() || "\"[{-".contains(c))
        || ["true", "false", "null"].iter().any(|word| next.starts_with(word));
    if !message.starts_with("expected `,` or") || !begins_value {
        return None;
    }
    let before = before.trim_end();
    let last = before.rsplit('\n').next()?;
    Some((before.matches('\n').count() + 1, last.len() + 1))
}

/// A natural slip at a place of a text: a comment, a comma too many, a decimal comma.
fn slip(text: &str, (line, column): (usize, usize), message: &str) -> Option<String> {
    let row = text.lines().nth(line.checked_sub(1)?)?;
    let (before, at) = row.split_at_checked(column.checked_sub(1)?)?;
    let before = before.trim_end();
    if at.starts_with("//") || at.starts_with("/*") || at.starts_with('#') {
        return Some("a comment, which JSON does not have: remove it".to_owned());
    }
    if at.starts_with(',') && before.ends_with(',') {
        return Some("two commas in a row: remove one".to_owned());
    }
    if message == "trailing comma" {
        return Some("a comma before a closing bracket: remove it".to_owned());
    }
    // What JSON takes for a name may be the decimals of the number before, what it takes for a value too many
    // follows from those of a number in the same list.
    let (whole, decimals) = match message {
        "key must be a string" => number_around(before.strip_suffix(',')?, at)?,
        "trailing characters" => decimal_comma_in(list_around(text, line, column)?)?,
        _ => return None,
    };
    Some(format!("{whole},{decimals} has a decimal comma: expected a point, {whole}.{decimals}"))
}

/// The whole number at the end of one text and the digits at the beginning of the next.
fn number_around<'a>(before: &'a str, behind: &'a str) -> Option<(&'a str, &'a str)> {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let start = before.len() - before.bytes().rev().take_while(u8::is_ascii_digit).count();
    let decimals = &behind[..digits(behind)];
    let is_fraction = before[..start].ends_with('.');
    let signed = start - usize::from(before[..start].ends_with('-'));
    (start < before.len() && !decimals.is_empty() && !is_fraction).then(|| (&before[signed..], decimals))
}

/// The first number with a decimal comma in a list that has commas between its values, too: those have a
/// blank behind them. Where all commas look alike, none is blamed.
fn decimal_comma_in(list: &str) -> Option<(&str, &str)> {
    let mut commas = list.match_indices(',').map(|(at, _)| (&list[..at], &list[at + 1..]));
    let is_between = |(_, behind): &(&str, &str)| behind.starts_with(char::is_whitespace);
    commas.clone().any(|comma| is_between(&comma)).then_some(())?;
    commas.find_map(|(before, behind)| number_around(before, behind))
}

/// The inside of the innermost list around a place of a text, up to the first bracket that follows.
fn list_around(text: &str, line: usize, column: usize) -> Option<&str> {
    let start: usize = text.split_inclusive('\n').take(line.checked_sub(1)?).map(str::len).sum();
    let (before, behind) = text.split_at_checked(start + column.checked_sub(1)?)?;
    let open = before.rfind(['[', ']', '{', '}', '"']).filter(|open| before[*open..].starts_with('['))?;
    let end = behind.find(['[', ']', '{', '}', '"']).unwrap_or(behind.len());
    Some(&text[open + 1..before.len() + end])
}

/// The path of a field with the number of its cable: fields count from 0, names such as `a1.x` from 1.
pub fn numbered(field: &str) -> String {
    let index = field.strip_prefix("cables[").and_then(|rest| rest.split_once(']')?.0.parse::<usize>().ok());
    index.map_or_else(|| field.to_owned(), |index| format!("cable {}, {field}", index + 1))
}

/// Reads a value from JSON text, all of it.
///
/// # Errors
/// [`JsonError`] with field, line and column.
pub fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, JsonError> {
    let (value, mut deserializer) = read(text)?;
    // Text after the value is refused: half a file may have been pasted behind another.
    deserializer.end().map_err(|error| JsonError::new(".".to_owned(), &error, text))?;
    // Structs refuse a second entry of the same name. Maps would keep the last one.
    read::<DistinctKeys>(text)?;
    Ok(value)
}

/// Reads the value with which a text begins.
fn read<T: DeserializeOwned>(text: &str) -> Result<(T, serde_json::Deserializer<StrRead<'_>>), JsonError> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let field = error.path().to_string();
        JsonError::new(field, &error.into_inner(), text)
    })?;
    Ok((value, deserializer))
}

/// Any JSON value in which no map has the same key twice.
struct DistinctKeys;

impl<'de> Deserialize<'de> for DistinctKeys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Self)
    }
}

impl<'de> Visitor<'de> for DistinctKeys {
    type Value = Self;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self, A::Error> {
        let mut keys = BTreeSet::new();
        while let Some(key) = map.next_key::<String>()? {
            if keys.contains(&key) {
                return Err(A::Error::custom(format!("duplicate field `{key}`")));
            }
            keys.insert(key);
            map.next_value::<Self>()?;
        }
        Ok(self)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self, A::Error> {
        while list.next_element::<Self>()?.is_some() {}
        Ok(self)
    }

    fn visit_bool<E>(self, _: bool) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_i64<E>(self, _: i64) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_u64<E>(self, _: u64) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_f64<E>(self, _: f64) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_str<E>(self, _: &str) -> Result<Self, E> {
        Ok(self)
    }

    fn visit_unit<E>(self) -> Result<Self, E> {
        Ok(self)
    }
}

/// Line and column, both from 1, of the value of a field such as `cables[2].exit_point[0]` in a JSON text.
///
/// For a missing field they are those of the value that would contain it.
pub fn place_of(text: &str, field: &str) -> Option<(usize, usize)> {
    let mut value: &RawValue = serde_json::from_str(text).ok()?;
    for key in field.split(['.', '[', ']']).filter(|key| !key.is_empty()) {
        let inner = match key.parse::<usize>() {
            Ok(index) => serde_json::from_str::<Vec<&RawValue>>(value.get())
                .ok()
                .and_then(|list| list.get(index).copied()),
            Err(_) => serde_json::from_str::<BTreeMap<String, &RawValue>>(value.get())
                .ok()
                .and_then(|map| map.get(key).copied()),
        };
        let Some(inner) = inner else { break };
        value = inner;
    }
    // The value borrows from the text, so that its position is a difference of addresses.
    let before = text.get(..value.get().as_ptr() as usize - text.as_ptr() as usize)?;
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    Some((before.matches('\n').count() + 1, before[line_start..].chars().count() + 1))
}

#[cfg(test)]
mod tests {
    use super::{from_json, place_of};
    use std::collections::BTreeMap;

    #[test]
    fn a_map_with_a_key_twice_is_refused_as_a_struct_is() {
        let read = |text| from_json::<BTreeMap<String, BTreeMap<String, f64>>>(text);
        assert!(read(r#"{"a": {"x": 1, "y": -2}, "b": {"x": 1.5}}"#).is_ok());
        let error = read("{\"a\": {\"x\": 1,\n  \"x\": 1}}").unwrap_err();
        assert_eq!((error.field.as_str(), error.line), ("a", 2));
        assert_eq!(error.message, "duplicate field `x`");
        assert_eq!(read(r#"{"a": {}, "\u0061": {}}"#).unwrap_err().message, "duplicate field `a`");
    }

    #[test]
    fn slips_of_those_who_type_json_have_their_cause_and_remedy() {
        let read = |text| from_json::<BTreeMap<String, [f64; 2]>>(text).unwrap_err().message;
        for (text, words) in [
            ("{\n// mass\n\"a\": [1, 2]}", "a comment, which JSON does not have: remove it"),
            ("{\"a\": [1, 2] # mass\n}", "a comment, which JSON does not have: remove it"),
            ("{\"a\": [1, 2],, \"b\": [1, 2]}", "two commas in a row: remove one"),
            ("{\"a\": [1, 2],}", "a comma before a closing bracket: remove it"),
            ("{\"a\": [-1,5, 2]}", "-1,5 has a decimal comma: expected a point, -1.5"),
            ("{a: [1, 2]}", "expected a name in double quotes"),
            ("{\"a\": [1 2]}", "a comma is missing here"),
            ("{\"a\": [1; 2]}", "expected `,` or `]`"),
            ("{\"a\": [1, 2, 3]}", "expected the end of the list here"),
        ] {
            assert_eq!(read(text), words, "{text}");
        }
        let of_number = from_json::<BTreeMap<String, f64>>("{\"mass\": 180,25, \"b\": 2}").unwrap_err();
        assert_eq!(of_number.message, "180,25 has a decimal comma: expected a point, 180.25");
        // Correct values on the line of another fault are not blamed.
        let cables = "{\"exit\": [[1,2],[3,4]], ";
        for (end, words) in [
            ("mass: 3}", "expected a name in double quotes"),
            ("\"mass\": [[2,5, 3]]}", "2,5 has a decimal comma: expected a point, 2.5"),
            ("\"mass\": [[2,5,3]]}", "expected the end of the list here"),
            ("\"mass\": [[2.5,5, 3]]}", "expected the end of the list here"),
            ("\"mass\": [[2, 5\n, 3]]}", "expected the end of the list here"),
            ("\"mass\": [[2, 5]], 5}", "expected a name in double quotes"),
        ] {
            let text = format!("{cables}{end}");
            let error = from_json::<BTreeMap<String, Vec<[f64; 2]>>>(&text).unwrap_err();
            assert_eq!(error.message, words, "{text}");
        }
        let of_count = |text| from_json::<u64>(text).unwrap_err().message;
        assert_eq!(of_count("-1"), "invalid value: integer `-1`, expected a whole number, 0 to 1.8e19");
        assert_eq!(
            of_count("1.5"),
            "invalid type: floating point `1.5`, expected a whole number, 0 to 1.8e19"
        );
        assert_eq!(super::numbered("cables[7].lead"), "cable 8, cables[7].lead");
    }

    #[test]
    fn a_missing_comma_is_placed_behind_the_value_that_lacks_it() {
        for (text, place) in [
            ("{\n  \"a\": [1, 2]\n\n  \"b\": [3, 4]\n}", (2, 14)),
            ("{\"a\": [1, 2], \"b\": [3 \r\n 4]}", (1, 22)),
            ("{\"a\": [-1.5e3\n-4]}", (1, 14)),
        ] {
            let error = from_json::<BTreeMap<String, Vec<f64>>>(text).unwrap_err();
            let found = (error.message.as_str(), (error.line, error.column));
            assert_eq!(found, ("a comma is missing here", place), "{text}");
        }
    }

    #[test]
    fn a_value_is_found_where_it_stands_and_a_missing_one_where_it_should() {
        let text = "{\n  \"mass\": 180,\n  \"cables\": [{\"exit\": [1, 2]},\n    {\"exit\": [3, -4]}]}\n";
        for (field, place) in [
            ("mass", (2, 11)),
            ("cables[1].exit[1]", (4, 18)),
            ("cables[0].anchor", (3, 14)),
            ("cables[*].exit", (3, 13)),
            ("cables[2]", (3, 13)),
            ("nothing.at.all", (1, 1)),
        ] {
            assert_eq!(place_of(text, field), Some(place), "{field}");
        }
        assert_eq!(place_of("{", "mass"), None);
    }
}
