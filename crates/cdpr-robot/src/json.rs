//! JSON text to data, with line and column of what is wrong.

use serde::de::{Deserialize, DeserializeOwned, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::de::StrRead;
use serde_json::value::RawValue;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Where a JSON text differs from what was expected: a missing, misspelt or mistyped field, or no JSON.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}, column {column}: {field}: {message}")]
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
    fn new(field: String, error: &serde_json::Error) -> Self {
        // serde_json ends its message with line and column, which are fields of their own here.
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or_default();
        let message = match message {
            "expected value" => {
                "expected a JSON value of this field's kind; NaN, Infinity and bare words are not JSON"
                    .to_owned()
            }
            "number out of range" => "number out of range, expected a finite number".to_owned(),
            "EOF while parsing a value" => "the text ends where a JSON value is expected".to_owned(),
            // Types that have Rust's names.
            message => message
                .replace("EOF while parsing", "the text ends within")
                .replace("expected f64", "expected a number")
                .replace("expected usize", "expected a whole number"),
        };
        // Without a name for the last step, the field is the one that contains it.
        let field = field.trim_end_matches('?').trim_end_matches('.');
        let field = if field.is_empty() { "the whole text" } else { field }.to_owned();
        Self { field, line: error.line(), column: error.column(), message }
    }
}

/// Reads a value from JSON text, all of it.
///
/// # Errors
/// [`JsonError`] with field, line and column.
pub fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, JsonError> {
    let (value, mut deserializer) = read(text)?;
    // Text after the value is refused: half a file may have been pasted behind another.
    deserializer.end().map_err(|error| JsonError::new(".".to_owned(), &error))?;
    // Structs refuse a second entry of the same name. Maps would keep the last one.
    read::<DistinctKeys>(text)?;
    Ok(value)
}

/// Reads the value with which a text begins.
fn read<T: DeserializeOwned>(text: &str) -> Result<(T, serde_json::Deserializer<StrRead<'_>>), JsonError> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let field = error.path().to_string();
        JsonError::new(field, &error.into_inner())
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
