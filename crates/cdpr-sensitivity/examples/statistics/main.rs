//! Measures the estimators of this crate: how often they are right, and how far off they are.
//!
//! ```text
//! cargo run --release -p cdpr-sensitivity --example statistics -- choice
//! ```
#![allow(clippy::print_stdout)]

mod brackets;
mod choice;
mod exact;
mod functions;
mod given;
mod gradients;
#[path = "../../tests/known_tables.rs"]
#[allow(dead_code, clippy::unwrap_used)]
mod known_tables;
mod measures;
mod reliability;
mod tables;
#[cfg(feature = "faer")]
mod vectors;
mod verdicts;

use cdpr_sensitivity::SensitivityError;

/// Prints a table of this many studies. The text is a part of the names of functions, or of measures, where
/// the table takes one.
type Table = fn(u64, &str) -> Result<(), SensitivityError>;

fn main() -> Result<(), SensitivityError> {
    let tables: &[(&str, Table)] = &[
        ("choice", |studies, _| choice::table(studies)),
        ("given", |studies, _| given::table(studies)),
        ("levels", |studies, _| given::table_of_levels(studies)),
        ("verdicts", verdicts::table),
        ("brackets", |studies, _| brackets::table(studies)),
        ("gradients", gradients::table),
        ("measures", measures::table),
        ("reliability", reliability::table),
        #[cfg(feature = "faer")]
        ("vectors", |studies, _| vectors::table(studies)),
    ];
    let mut arguments = std::env::args().skip(1);
    let [name, count, part] = [(); 3].map(|()| arguments.next());
    let Some((_, table)) = tables.iter().find(|(table, _)| Some(*table) == name.as_deref()) else {
        let names: Vec<&str> = tables.iter().map(|(table, _)| *table).collect();
        println!("statistics TABLE [STUDIES [FUNCTION]], TABLE one of {names:?}");
        return Ok(());
    };
    table(count.and_then(|count| count.parse().ok()).unwrap_or(1000), &part.unwrap_or_default())
}
