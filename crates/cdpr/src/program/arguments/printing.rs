//! How an answer is printed, and where it goes.

use crate::program::arguments::endings;
use crate::program::error::ProgramError;
use crate::program::output;
use crate::program::questions;
use cdpr_study::{IfExists, check_replaceable, is_not_finite, write_file};
use serde::Serialize;
use serde_json::Value;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

/// How the results are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// Sentences and tables.
    Text,
    /// One line of JSON, numbers to the last bit.
    Json,
    /// CSV: a row for each entry of a list; of another answer a line for each number, with its name.
    Csv,
}

impl Format {
    /// Prints an answer as one line of JSON, as CSV, or as `text` does.
    pub(crate) fn print<T: Serialize>(self, answer: &T, text: impl FnOnce(&T)) -> serde_json::Result<()> {
        match self {
            Self::Json => println!("{}", questions::added_to(serde_json::to_string(answer)?)?),
            Self::Csv => {
                let rows = rows(&serde_json::to_value(answer)?);
                // Without entries there are no names.
                rows.iter().filter(|row| !row.is_empty()).for_each(|row| print_record(row));
            }
            Self::Text => text(answer),
        }
        Ok(())
    }
}

/// The answer as records of CSV, names first.
fn rows(answer: &Value) -> Vec<Vec<String>> {
    let Value::Array(entries) = answer else {
        let pairs = flat("", answer).into_iter().map(|(name, text)| vec![name, text]);
        return [vec!["name".to_owned(), "value".to_owned()]].into_iter().chain(pairs).collect();
    };
    let entries: Vec<Vec<(String, String)>> = entries.iter().map(|entry| flat("", entry)).collect();
    let mut names: Vec<String> = Vec::new();
    for (name, _) in entries.iter().flatten() {
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    let cell = |entry: &[(String, String)], name: &String| {
        entry.iter().find(|(own, _)| own == name).map(|(_, text)| text.clone()).unwrap_or_default()
    };
    let rows = entries.iter().map(|entry| names.iter().map(|name| cell(entry, name)).collect());
    let rows: Vec<Vec<String>> = rows.collect();
    [names].into_iter().chain(rows).collect()
}

/// The values of an answer with their names: fields behind points, entries of lists by their numbers from 1.
fn flat(name: &str, value: &Value) -> Vec<(String, String)> {
    let below = |key: &str| if name.is_empty() { key.to_owned() } else { format!("{name}.{key}") };
    match value {
        Value::Object(fields) => fields.iter().flat_map(|(key, value)| flat(&below(key), value)).collect(),
        Value::Array(list) => {
            list.iter().enumerate().flat_map(|(k, value)| flat(&below(&(k + 1).to_string()), value)).collect()
        }
        Value::Null => vec![(name.to_owned(), String::new())],
        Value::String(text) => vec![(name.to_owned(), text.clone())],
        other => vec![(name.to_owned(), other.to_string())],
    }
}

/// Prints a line of CSV; what is not finite is left out.
pub(crate) fn print_record<T: AsRef<str>>(cells: &[T]) {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let cell = |cell: &T| if is_not_finite(cell.as_ref()) { String::new() } else { cell.as_ref().to_owned() };
    // Writing to memory cannot fail.
    let _ = writer.write_record(cells.iter().map(cell));
    let line = writer.into_inner().unwrap_or_default();
    println!("{}", String::from_utf8_lossy(&line).trim_end_matches('\n'));
}

/// How and where an answer is printed.
#[derive(clap::Args)]
pub(crate) struct Printing {
    /// How the answer is printed; without it as the ending of --out says, .json or .csv, else as text.
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// File for the answer, which is printed if left out.
    #[arg(short, long, value_name = "FILE", value_parser = endings::any())]
    out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) overwrite: Overwrite,
}

impl Printing {
    /// The file for a table, where --out names one and nothing else is to be printed as CSV.
    pub(crate) fn table_file(&self) -> Option<&Path> {
        let is_csv = |path: &Path| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
        self.out.as_deref().filter(|path| is_csv(path) && self.format.is_none())
    }

    /// Whether a reader at a terminal gets the answer as text.
    pub(crate) fn is_brief(&self) -> bool {
        !self.is_to_file() && self.format() == Format::Text && io::stdout().is_terminal()
    }

    /// Whether the answer goes to a file.
    pub(crate) fn is_to_file(&self) -> bool {
        self.out.as_deref().is_some_and(|path| path.as_os_str() != "-")
    }

    /// Prints an answer that has a table of numbers: as CSV, or in a file for a table, the table alone; in
    /// JSON `whole` has its rows.
    pub(crate) fn with_table<T: Serialize>(
        &self,
        columns: &[String],
        rows: Vec<Vec<f64>>,
        whole: impl FnOnce(Vec<Vec<f64>>) -> T,
        text: impl Fn(),
    ) -> Result<(), ProgramError> {
        let cells = |row: &Vec<f64>| row.iter().map(|cell| format!("{cell:?}")).collect::<Vec<_>>();
        if let Some(path) = self.table_file() {
            let mut writer = csv::Writer::from_writer(Vec::new());
            // Writing to memory cannot fail.
            let _ = writer.write_record(columns);
            rows.iter().for_each(|row| drop(writer.write_record(cells(row))));
            self.overwrite.write(path, writer.into_inner().unwrap_or_default())?;
            text();
            return Ok(());
        }
        match self.format() {
            Format::Csv => {
                print_record(columns);
                rows.iter().for_each(|row| print_record(&cells(row)));
            }
            format => {
                let listed = if format == Format::Json { rows } else { Vec::new() };
                format.print(&whole(listed), |_| text())?;
            }
        }
        Ok(())
    }

    /// The format, once the answer is directed to its file.
    pub(crate) fn format(&self) -> Format {
        let ending = self.out.as_deref().and_then(Path::extension).and_then(|ending| ending.to_str());
        let by_name = match ending.map(str::to_ascii_lowercase).as_deref() {
            Some("json") => Format::Json,
            Some("csv") => Format::Csv,
            _ => Format::Text,
        };
        if let Some(out) = &self.out {
            output::print_to(out, self.overwrite.if_exists());
        }
        self.format.unwrap_or(by_name)
    }
}

/// What becomes of files and results that are there already.
#[derive(clap::Args)]
pub(crate) struct Overwrite {
    /// Replace the file, or the results in the folder, that are there already.
    #[arg(long)]
    overwrite: bool,
}

impl Overwrite {
    /// What becomes of them.
    pub(crate) fn if_exists(&self) -> IfExists {
        IfExists::overwriting(self.overwrite)
    }

    /// Whether they are to be replaced.
    pub(crate) fn is_wanted(&self) -> bool {
        self.overwrite
    }

    /// Writes a file of the user's choice.
    pub(crate) fn write(&self, path: &Path, content: impl AsRef<[u8]>) -> Result<(), ProgramError> {
        self.write_all(&[(path, content)])
    }

    /// Writes files of the user's choice: all of them, or none where one must not be replaced.
    pub(crate) fn write_all<C: AsRef<[u8]>>(&self, files: &[(&Path, C)]) -> Result<(), ProgramError> {
        files.iter().try_for_each(|(path, content)| check_replaceable(path, content, self.if_exists()))?;
        Ok(files.iter().try_for_each(|(path, content)| write_file(path, content, self.if_exists()))?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn an_answer_is_a_table_of_its_entries_or_of_its_numbers() {
        let rows = |value: Value| rows(&value).iter().map(|row| row.join(",")).collect::<Vec<_>>();
        let list = json!([{"a": 1.5, "b": {"c": [2, 3]}}, {"a": null, "d": "x"}]);
        assert_eq!(rows(list), ["a,b.c.1,b.c.2,d", "1.5,2,3,", ",,,x"]);
        assert_eq!(rows(json!({"a": 1, "b": [true]})), ["name,value", "a,1", "b.1,true"]);
    }
}
