//! `cdpr check`: everything about a robot file that is odd and yet no error.

use crate::arguments::{Format, Preference};
use crate::error::ProgramError;
use crate::output::{Ending, patiently};
use cdpr_assess::{Finding, Severity, inspect};
use cdpr_robot::{counted, numbered, shown};
use std::path::PathBuf;

/// The robot file.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Robot file (JSON, `cdpr-robot/1`).
    robot: PathBuf,
    #[command(flatten)]
    preference: Preference,
    /// How the findings are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let robot = settings.preference.open_robot_in_any_unit(&settings.robot)?;
    let findings = patiently("inspecting the robot", || inspect(&robot));
    let warnings = findings.iter().filter(|finding| finding.severity == Severity::Warning).count();
    settings.format.print(&findings, |findings| {
        for Finding { severity, field, value, why, remedy } in findings {
            println!("{severity}: {} is {value}: {why}", numbered(field));
            println!("    remedy: {remedy}");
        }
        println!(
            "{}: {}, {}, {}",
            shown(&robot.name),
            counted(robot.cables.len(), "cable"),
            counted(warnings, "warning"),
            counted(findings.len() - warnings, "note")
        );
    })?;
    Ok(if warnings > 0 { Ending::SomethingWrong } else { Ending::Well })
}
