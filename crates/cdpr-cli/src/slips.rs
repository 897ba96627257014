//! Natural slips on the command line, with what was probably meant.

use crate::arguments::numbers;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};
use std::ffi::{OsStr, OsString};

/// Commands that are called otherwise, or stand elsewhere.
const COMMANDS: [(&str, &str); 10] = [
    ("forward", "cdpr direct"),
    ("degm", "cdpr direct"),
    ("iegm", "cdpr inverse"),
    ("displacement", "cdpr deflection"),
    ("validate", "cdpr check"),
    ("resume", "cdpr study run --resume"),
    ("sensitivity", "cdpr study run"),
    ("init", "cdpr study new"),
    ("template", "cdpr study new"),
    ("identify", "cdpr calibration identify"),
];

/// Options that are called otherwise, or that another place gives.
const OPTIONS: [(&str, &str); 19] = [
    ("--robot", "the robot file stands right behind the command, without an option"),
    ("--study", "the study file stands right behind the command, without an option"),
    ("--json", "JSON is printed with `--format json`"),
    ("--output", "results go where `--out` says"),
    ("-o", "results go where `--out` says"),
    ("--samples", "the number of observations is `--observations N`"),
    ("-n", "the number of observations is `--observations N`"),
    ("--jobs", "the number of threads is `--threads N`"),
    ("-j", "the number of threads is `--threads N`"),
    ("--cores", "the number of threads is `--threads N`"),
    ("--continue", "an interrupted study goes on with `--resume`"),
    ("--force", "results in a folder are replaced with `--overwrite`"),
    ("--seed", "the seed is the field `seed` of the study file"),
    ("--replicates", "replicates are the field `replicates` of the study file"),
    ("--position", "the place of the platform is `--pose x,y,z`"),
    ("--load", "a load is `--payload` [kg], `--force fx,fy,fz` [N] or `--moment mx,my,mz` [N m]"),
    ("--mass", "a mass on the platform is `--payload` [kg]; its own stands in the robot file"),
    ("--poses", "one pose is `--pose x,y,z`"),
    ("--certificate", "the proof of an equilibrium is asked for with `--certify`"),
];

/// The error with a hint, where the slip is known.
pub(crate) fn hinted(mut error: Error, command: &Command, arguments: &[String]) -> Error {
    if let Some(hint) = hint(&error, command, arguments) {
        error.remove(ContextKind::SuggestedSubcommand);
        error.remove(ContextKind::SuggestedArg);
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![hint.into()]));
    }
    error
}

fn hint(error: &Error, command: &Command, arguments: &[String]) -> Option<String> {
    let text = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.as_str()),
        _ => None,
    };
    if let Some(name) = text(ContextKind::InvalidSubcommand) {
        return called(name, command).map(|meant| format!("the command is `{meant}`"));
    }
    let unknown = error.kind() == ErrorKind::UnknownArgument;
    let argument = text(ContextKind::InvalidArg).filter(|_| unknown)?;
    let option = argument.split(['=', ' ']).next().unwrap_or_default();
    let within: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match (option, within.as_slice()) {
        ("--payload", ["study" | "tolerances", ..]) => {
            Some("the payload is the field `payload` of the study file".to_owned())
        }
        ("--payload", ["check", ..]) => {
            Some("`check` takes no load: `cdpr deflection` and `cdpr stiffness` do".to_owned())
        }
        ("--robot", ["study" | "tolerances", ..]) => {
            Some("the robot file is the field `robot` of the study file".to_owned())
        }
        _ if is_number(option) => Some("numbers follow their option, such as `--pose 0,0,1.75`".to_owned()),
        _ => {
            let known = OPTIONS.iter().find(|(slip, _)| *slip == option);
            known.map(|(_, hint)| (*hint).to_owned())
        }
    }
}

/// The arguments with numbers that stand apart behind an option as one: `--pose 0 0 2` is `--pose "0 0 2"`.
pub(crate) fn joined(arguments: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut joined: Vec<OsString> = Vec::new();
    // Whether numbers may go on: the last argument is an option, or its numbers.
    let mut is_open = false;
    for argument in arguments {
        let text = argument.to_str().unwrap_or_default();
        let is_option = text.starts_with("--") && text.len() > 2;
        match joined.last_mut().filter(|last| is_open && is_number(text) && has_numbers(last)) {
            Some(last) => {
                last.push(" ");
                last.push(&argument);
            }
            None => {
                is_open = is_option || is_open && is_number(text);
                joined.push(argument);
            }
        }
    }
    joined
}

/// Whether an argument has numbers, alone or behind `--option=`.
fn has_numbers(argument: &OsStr) -> bool {
    let text = argument.to_str().unwrap_or_default();
    let numbers =
        if text.starts_with("--") { text.split_once('=').map_or("", |(_, numbers)| numbers) } else { text };
    is_number(numbers)
}

/// Whether an argument is a number, or several.
fn is_number(text: &str) -> bool {
    numbers(text).is_ok()
        || text.len() > 1 && text.strip_suffix(',').is_some_and(|text| numbers(text).is_ok())
}

/// The command that was meant by a name.
fn called(name: &str, command: &Command) -> Option<String> {
    let has = |command: &Command, name: &str| command.get_subcommands().any(|inner| inner.get_name() == name);
    if has(command, name) {
        return Some(format!("cdpr {name}"));
    }
    let outer = command.get_subcommands().find(|outer| has(outer, name));
    outer
        .map(|outer| format!("cdpr {} {name}", outer.get_name()))
        .or_else(|| COMMANDS.iter().find(|(slip, _)| *slip == name).map(|(_, meant)| (*meant).to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_behind_an_option_are_one_argument() {
        for (given, expected) in [
            (
                &["cdpr", "inverse", "r", "--pose", "0", "-1", "2", "--rpy", "0", "0", "9"][..],
                "0 -1 2|--rpy|0 0 9",
            ),
            (&["--pose", "0,", "-1,", "2"], "0, -1, 2"),
            (&["--pose=0", "0", "2", "--payload", "5", "robot"], "--pose=0 0 2|--payload|5|robot"),
            (&["report", "2024", "2025"], "report|2024|2025"),
            (&["--steps", "2", "3x"], "2|3x"),
        ] {
            let found = joined(given.iter().map(OsString::from));
            let found: Vec<_> = found.iter().map(|one| one.to_str().unwrap()).collect();
            assert!(found.join("|").ends_with(expected), "{found:?}");
        }
    }
}
