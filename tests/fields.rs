//! docs/fields.md: the fields of all files, from the schemas in docs. `INSTA_UPDATE=always` writes it.

use crate::data_files::root;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Files, in the order of the page.
const FILES: [&str; 7] = ["robot", "cable", "law", "study", "errors", "events", "design"];

const HEAD: &str = "# Fields of all files

This page is made of the [schemas](formats.md), and a test compares it. The sections below a file have the
objects in it; an object of several files is shown once. [Files](formats.md) has explanations and examples.
*Needed*: `yes`, or the value of a field that is left out, where there is one.
";

fn list<'a>(schema: &'a Value, key: &str) -> impl Iterator<Item = &'a Value> {
    schema[key].as_array().into_iter().flatten()
}

/// A description in one line of a table.
fn described(schema: &Value) -> String {
    let text = schema["description"].as_str().unwrap_or_default();
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

/// Fields of an object in a line: their names, and the names in these.
fn inline(schema: &Value) -> String {
    let field = |(name, of): (&String, &Value)| match of["properties"].is_object() {
        true => format!("`{name}` ({})", inline(of)),
        false => format!("`{name}`: {}", kind(of)),
    };
    schema["properties"].as_object().into_iter().flatten().map(field).collect::<Vec<_>>().join(", ")
}

/// What values a schema allows; `null` says no more than that the field may be left out.
fn kind(schema: &Value) -> String {
    if let Some(name) = schema["$ref"].as_str().and_then(|target| target.rsplit('/').next()) {
        return format!("[{name}](#{})", name.to_lowercase());
    }
    if !schema["const"].is_null() {
        return format!("`{}`", schema["const"]);
    }
    let several = list(schema, "anyOf").chain(list(schema, "oneOf")).map(kind);
    let several: Vec<String> = several.filter(|kind| !kind.is_empty()).collect();
    if !several.is_empty() {
        return several.join(" or ");
    }
    let types = list(schema, "type").chain([&schema["type"]]).filter_map(Value::as_str);
    let one = |name: &str| match name {
        "null" => String::new(),
        "array" if !schema["items"].is_object() => "list".to_owned(),
        "array" => match (schema["minItems"].as_u64(), schema["maxItems"].as_u64()) {
            (Some(least), Some(most)) if least == most => {
                format!("list of {least}: {}", kind(&schema["items"]))
            }
            _ => format!("list: {}", kind(&schema["items"])),
        },
        "object" if schema["properties"].is_object() => inline(schema),
        "object" if schema["additionalProperties"].is_object() => {
            format!("for each name: {}", kind(&schema["additionalProperties"]))
        }
        other => other.to_owned(),
    };
    let types: Vec<String> = types.map(one).filter(|kind| !kind.is_empty()).collect();
    types.join(" or ")
}

/// The table of an object, of the values to choose from, or the sentence on a list.
fn table(page: &mut String, schema: &Value) {
    let about = described(schema);
    if !about.is_empty() {
        write!(page, "\n{about}\n").unwrap();
    }
    if let Some(fields) = schema["properties"].as_object() {
        page.push_str("\n| field | value | needed | what it is |\n|---|---|---|---|\n");
        for (name, of) in fields {
            let is_needed = list(schema, "required").any(|needed| needed == name);
            let needed = match &of["default"] {
                _ if is_needed => "yes".to_owned(),
                Value::Null => String::new(),
                value => format!("`{value}`"),
            };
            writeln!(page, "| `{name}` | {} | {needed} | {} |", kind(of), described(of)).unwrap();
        }
        return;
    }
    let several: Vec<&Value> = list(schema, "oneOf").chain(list(schema, "anyOf")).collect();
    if several.is_empty() {
        write!(page, "\nA {}.\n", kind(schema)).unwrap();
        return;
    }
    page.push_str("\n| value | what it is |\n|---|---|\n");
    for of in several {
        writeln!(page, "| {} | {} |", kind(of), described(of)).unwrap();
    }
}

#[test]
fn the_page_of_fields_is_that_of_the_schemas() {
    let (mut page, mut shown) = (HEAD.to_owned(), BTreeSet::new());
    for file in FILES {
        let path = root().join(format!("docs/schemas/cdpr-{file}-1.schema.json"));
        let schema: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        write!(page, "\n## {}\n", schema["title"].as_str().unwrap()).unwrap();
        table(&mut page, &schema);
        for (name, of) in schema["$defs"].as_object().into_iter().flatten() {
            if shown.insert(name.clone()) {
                write!(page, "\n### {name}\n").unwrap();
                table(&mut page, of);
            }
        }
    }
    let path = root().join("docs/fields.md");
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        std::fs::write(&path, &page).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == page, "docs/fields.md is not that of the schemas: run: cargo xtask schemas");
}
