//! Arguments that are right one by one and wrong together, whatever the command is.

use crate::program::arguments::Format;
use crate::program::error::ProgramError;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Refuses the standard input as two files, and a file for the answer whose ending is that of another format.
pub(crate) fn check_together(program: &Command, found: &ArgMatches) -> Result<(), ProgramError> {
    let (mut command, mut found) = (program, found);
    while let Some((name, inner)) = found.subcommand() {
        let Some(below) = command.find_subcommand(name) else { break };
        (command, found) = (below, inner);
    }
    check_standard_input(command, found)?;
    check_ending(command, found)
}

/// The name of an argument for people, such as `--poses` or `ROBOT`.
fn name(argument: &Arg) -> String {
    match argument.get_long() {
        Some(long) => format!("--{long}"),
        None => argument.get_id().as_str().to_uppercase(),
    }
}

/// It is read once.
fn check_standard_input(command: &Command, found: &ArgMatches) -> Result<(), ProgramError> {
    // `-` is the standard output there.
    let inputs = command.get_arguments().filter(|argument| argument.get_id() != "out");
    let of = |argument: &Arg| {
        let given = found.try_get_raw(argument.get_id().as_str()).ok().flatten().into_iter().flatten();
        given.filter(|value| *value == OsStr::new("-")).map(|_| name(argument)).collect::<Vec<_>>()
    };
    let names: Vec<String> = inputs.flat_map(of).collect();
    if names.len() < 2 {
        return Ok(());
    }
    Err(ProgramError::Usage(format!(
        "{}: - is the standard input, which can be one of them: expected a file for each other",
        names.join(" and ")
    )))
}

/// A command without a usual format takes it from the ending of the name.
fn check_ending(command: &Command, found: &ArgMatches) -> Result<(), ProgramError> {
    let is_free = command
        .get_arguments()
        .any(|argument| argument.get_id() == "format" && argument.get_default_values().is_empty());
    let is_typed = found.try_contains_id("format").unwrap_or(false)
        && found.value_source("format") == Some(ValueSource::CommandLine);
    if !is_free || !is_typed {
        return Ok(());
    }
    let format = found.try_get_one::<Format>("format").ok().flatten();
    let out = found.try_get_one::<PathBuf>("out").ok().flatten();
    match format.zip(out).and_then(|(format, out)| refusal(*format, out)) {
        Some(refusal) => Err(ProgramError::Usage(refusal)),
        None => Ok(()),
    }
}

/// Why an answer in a format does not go into a file of this name.
fn refusal(format: Format, out: &Path) -> Option<String> {
    let of_ending = match out.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "json" => Format::Json,
        "csv" => Format::Csv,
        _ => return None,
    };
    let (typed, is, usual) = match format {
        Format::Text => ("text", "text", "txt"),
        Format::Json => ("json", "JSON", "json"),
        Format::Csv => ("csv", "CSV", "csv"),
    };
    (format != of_ending).then(|| {
        format!(
            "--out {}: the answer is {is} with --format {typed}: expected a name that ends in .{usual}, or \
             no --format, which the ending of the name says",
            out.display()
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_of_another_format_is_refused_and_that_of_any_text_is_not() {
        for (format, name, fits) in [
            (Format::Json, "a.csv", false),
            (Format::Json, "a.CSV", false),
            (Format::Csv, "a.json", false),
            (Format::Text, "a.json", false),
            (Format::Text, "a.csv", false),
            (Format::Json, "a.json", true),
            (Format::Csv, "a.csv", true),
            (Format::Csv, "a.txt", true),
            (Format::Json, "a.v2", true),
            (Format::Json, "csv", true),
            (Format::Json, "-", true),
        ] {
            assert_eq!(refusal(format, Path::new(name)).is_none(), fits, "{format:?} {name}");
        }
        let said = refusal(Format::Json, Path::new("a.csv")).unwrap();
        assert!(
            said.starts_with("--out a.csv: the answer is JSON with --format json: expected a name"),
            "{said}"
        );
    }
}
