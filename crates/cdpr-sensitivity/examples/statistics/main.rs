//! Measures the estimators of this crate: how often they are right, and how far off they are.
//!
//! ```text
//! cargo run --release -p cdpr-sensitivity --example statistics -- choice
//! ```
#![allow(clippy::print_stdout)]

mod brackets;
mod choice;
mod expansions;
mod functions;
mod given;
mod indices;
mod measures;

use cdpr_sensitivity::SensitivityError;

/// Prints a table of this many studies.
type Table = fn(u64) -> Result<(), SensitivityError>;

fn main() -> Result<(), SensitivityError> {
    let tables: [(&str, Table); 6] = [
        ("choice", choice::table),
        ("indices", indices::table),
        ("expansions", expansions::table),
        ("given", given::table),
        ("brackets", brackets::table),
        ("measures", measures::table),
    ];
    let mut arguments = std::env::args().skip(1);
    let (name, count) = (arguments.next(), arguments.next());
    let Some((_, table)) = tables.iter().find(|(table, _)| Some(*table) == name.as_deref()) else {
        println!("statistics TABLE [STUDIES], TABLE one of {:?}", tables.map(|(table, _)| table));
        return Ok(());
    };
    table(count.and_then(|count| count.parse().ok()).unwrap_or(1000))
}
