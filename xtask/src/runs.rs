//! `data/evidence/runs.json`: date, machine and commit of the last run of what takes long.

use crate::cargo::{Outcome, machine, read_json, root, write};
use serde_json::{Value, json};

/// Notes that these cases or tables were measured now.
pub(crate) fn note<'a>(names: impl Iterator<Item = &'a str>) -> Outcome {
    let path = root().join("data/evidence/runs.json");
    let runs = if path.exists() { read_json(&path)? } else { json!({}) };
    write(&path, &format!("{:#}\n", noted(runs, names, &machine())))
}

/// The runs with these, sorted by name.
fn noted<'a>(runs: Value, names: impl Iterator<Item = &'a str>, run: &str) -> Value {
    let mut all: Vec<(String, Value)> = runs.as_object().cloned().unwrap_or_default().into_iter().collect();
    for name in names {
        all.retain(|(known, _)| known != name);
        all.push((name.to_owned(), json!(run)));
    }
    all.sort_by(|one, other| one.0.cmp(&other.0));
    Value::Object(all.into_iter().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_run_of_a_name_is_kept_and_names_are_sorted() {
        let runs = noted(json!({"b": "first", "c": "first"}), ["b", "a"].into_iter(), "second");
        assert_eq!(runs.to_string(), r#"{"a":"second","b":"second","c":"first"}"#);
    }
}
