//! Natural slips on the command line, with what was probably meant.

use crate::program::arguments::numbers;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};
use std::ffi::{OsStr, OsString};

/// Commands that are called otherwise.
const COMMANDS: [(&str, &str); 25] = [
    ("forward", "cdpr direct"),
    ("degm", "cdpr direct"),
    ("iegm", "cdpr inverse"),
    ("ik", "cdpr inverse"),
    ("fk", "cdpr direct"),
    ("displacement", "cdpr deflection"),
    ("frequencies", "cdpr modes"),
    ("payload", "cdpr capacity"),
    ("map", "cdpr workspace"),
    ("explorer", "cdpr explore"),
    ("robots", "cdpr robot list"),
    ("cables", "cdpr robot list"),
    ("info", "cdpr robot show"),
    ("validate", "cdpr robot check"),
    ("convert", "cdpr robot import"),
    ("resume", "cdpr study run --resume"),
    ("sensitivity", "cdpr study run"),
    ("init", "cdpr study new"),
    ("template", "cdpr study new"),
    ("throughput", "cargo xtask throughput"),
    ("robustness", "cargo xtask robustness"),
    ("calibration", "cdpr calibrate"),
    ("linear-density", "cdpr cable density"),
    ("sag", "cdpr cable catenary"),
    ("completion", "cdpr completions"),
];

/// Options that are called otherwise, or that another place gives.
const OPTIONS: [(&str, &str); 57] = [
    ("--robot", "the robot is the first argument, without an option"),
    (
        "--study",
        "the error model of a study is `--uncertainty STUDY:NAME`; a study to run is the first argument",
    ),
    ("--json", "JSON is printed with `--format json`"),
    ("--csv", "CSV is printed with `--format csv`"),
    ("--output", "results go where `--out` says"),
    ("--samples", "the number of observations is `--observations N`"),
    ("-n", "the number of observations is `--observations N`"),
    ("--jobs", "the number of threads is `--threads N`"),
    ("-j", "the number of threads is `--threads N`"),
    ("--cores", "the number of threads is `--threads N`"),
    ("--continue", "an interrupted study goes on with `--resume`"),
    ("--force", "results that exist are replaced with `--overwrite`"),
    ("--seed", "the seed is the field `seed` of the study file"),
    ("--replicates", "replicates are the field `replicates` of the study file"),
    ("--position", "the place of the platform is `--pose x,y,z`"),
    ("--start", "the start of the search is `--pose x,y,z`"),
    ("--rotation", "a rotation is `--rpy roll,pitch,yaw` [degrees]"),
    ("--load", "a load is `--payload` [kg], `--force fx,fy,fz` [N] or `--moment mx,my,mz` [N m]"),
    ("--mass", "a mass on the platform is `--payload` [kg]; its own is in the robot file"),
    ("--poses", "one pose is `--pose x,y,z`"),
    ("--certificate", "the proof of an equilibrium is requested with `--with certificate`"),
    ("--plane", "a plane is `--region z=1.75`"),
    ("--box", "a box is `--region -2:2:9,-1:1:5,1:2:3`"),
    ("--grid", "a region has its numbers of points, `--region -2:2:9,-1:1:5,1.75`"),
    ("--error-model", "the error model of a study is `--uncertainty STUDY:NAME`"),
    ("--model", "an error model is `--uncertainty FILE`"),
    ("--errors", "an error model is `--uncertainty FILE`"),
    ("--wrenches", "a table of wrenches is `--wrench FILE`"),
    ("--wrench-box", "a box of wrenches has ranges, `--wrench=-50:50,-50:50,-50:50,0,0,0`"),
    ("--tilt", "the tilt is computed with `--with tilt`"),
    ("--capacity", "the capacity is computed with `--with capacity`"),
    ("--distances", "the distances are computed with `--with distances`"),
    ("--boundary", "the boundary is computed with `--with boundary`"),
    ("--draw", "the number of layers that are drawn is `--with layers=N`"),
    ("--loops", "cables in loops are allowed with `--with loops`"),
    ("--record", "a record is `--law FILE --length M`"),
    ("--unloading", "the unloading at the same tensions is `--with same-tension`"),
    ("--steps", "the number of steps is `--with steps=N`"),
    ("--weight", "a cable is its name, or `weight=N/m,stiffness=N`"),
    ("--stiffness", "a cable is its name, or `weight=N/m,stiffness=N`"),
    ("--mass-error", "errors are `--errors mass=KG,length=M`"),
    ("--length-error", "errors are `--errors length=M`"),
    ("--force-error", "errors are `--errors force=N,elongation=M`"),
    ("--elongation-error", "errors are `--errors force=N,elongation=M`"),
    ("--section-error", "errors are `--errors section=M2`"),
    ("--measurements", "the measurements are the second argument, without an option"),
    ("--choose", "the number of poses is `--number N`"),
    ("--accuracy", "the accuracy is `--limit 'position_error_mm<0.1'`"),
    ("--of", "the quantity is that of the limit, `--limit 'position_error_mm<1'`"),
    ("--loss", "the loss is `--with loss=huber`"),
    ("--starts", "the number of starts is `--with starts=N`"),
    ("--folds", "the number of folds is `--with folds=N`"),
    ("--only-identifiable", "it is `--with only-identifiable`"),
    ("--confidence", "the confidence of the intervals is `--with confidence=0.95`"),
    ("--level", "the confidence of the intervals is `--with confidence=0.95`"),
    ("--workspace", "the folder of the workspace is the second argument, without an option"),
    ("--cable-set", "a cable set of CASPR is `FILE:SET`"),
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
        ("--payload", ["study", ..]) => {
            Some("the payload is the field `payload` of the study file".to_owned())
        }
        ("--payload", ["robot", "check", ..]) => {
            Some("`robot check` takes no load: `cdpr deflection` and `cdpr stiffness` do".to_owned())
        }
        ("--robot", ["study", "run" | "tolerances", ..]) => {
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
