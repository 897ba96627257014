//! `cargo xtask calibration PART`: how well calibrations do.
//!
//! The tests of `cdpr-calibration` print what they measure; with `CDPR_CAMPAIGNS` they run as many campaigns
//! as a table needs.

#![allow(clippy::print_stdout)]

mod circle;

use crate::cargo::{cargo_command, cdpr_command, root};
use std::process::{Command, ExitCode};

/// Parts that are tests: their name, the filter of the tests, campaigns unless the user says how many.
const TESTS: [(&str, &str, &str); 6] = [
    ("recovery", "recovery::the_truth_lies", "200"),
    ("troubles", "recovery::campaigns_with", "200"),
    ("wrong", "wrong_models::", "2"),
    ("sensors", "sensors::", "2"),
    ("speed", "speed::", "2"),
    ("scipy", "reference::", "2"),
];

/// Runs one part; `rest` are its name and its arguments.
pub(crate) fn run(rest: &[String]) -> ExitCode {
    let (Some(part), arguments) = (rest.first(), rest.get(1..).unwrap_or_default()) else {
        eprintln!(
            "error: expected a part: recovery, troubles, wrong, sensors, speed, scipy, campaigns, circle or irma4u"
        );
        return ExitCode::FAILURE;
    };
    if let Some((_, filter, campaigns)) = TESTS.iter().find(|(name, ..)| name == part) {
        let campaigns = arguments.first().map_or(*campaigns, String::as_str);
        return tests(filter, campaigns);
    }
    let done = match part.as_str() {
        "circle" => circle::run(),
        "irma4u" => irma4u(arguments),
        // Campaigns of each robot, those of them that SciPy calibrates, too, and names of robots.
        "campaigns" => script("campaigns.py", arguments),
        other => Err(format!("no part of calibration is called `{other}`")),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Runs tests on one thread, so that their times are those of one search at a time.
fn tests(filter: &str, campaigns: &str) -> ExitCode {
    let test = ["test", "-p", "cdpr-calibration", "--test", "integration", filter];
    let mut command = cargo_command(&[&test[..], &["--", "--nocapture", "--test-threads=1"]].concat());
    match command.env("CDPR_CAMPAIGNS", campaigns).status() {
        Ok(status) if status.success() => ExitCode::SUCCESS,
        _ => ExitCode::FAILURE,
    }
}

/// Residuals and poses of a user's copy of IRMA4U's campaigns.
fn irma4u(files: &[String]) -> Result<(), String> {
    if files.is_empty() {
        return Err(
            "expected files: ws_selfcalibration_27_final.mat ws_selfcalibration_8_final.mat".to_owned()
        );
    }
    script("irma4u.py", files)
}

/// Runs a script of data/reference, which calls the program.
fn script(name: &str, arguments: &[String]) -> Result<(), String> {
    let built = cdpr_command(&["--version"]).output();
    if !built.is_ok_and(|output| output.status.success()) {
        return Err("cannot build the program".to_owned());
    }
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let done = Command::new(&python)
        .arg(root().join("data/reference").join(name))
        .args(arguments)
        .env("CDPR", root().join("target/debug/cdpr"))
        .status();
    match done {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(format!("{name} has failed")),
        Err(error) => Err(format!("cannot start {python}: {error}")),
    }
}
