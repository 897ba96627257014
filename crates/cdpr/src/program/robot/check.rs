//! `cdpr robot check`: everything about a robot file that is odd and yet no error.

use crate::program::arguments::{Preference, Printing, RobotArgument};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, patiently, print_sentence};
use cdpr_assess::{Finding, Severity, inspect};
use cdpr_robot::{counted, numbered, shown};

/// The robot file.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    preference: Preference,
    #[command(flatten)]
    printing: Printing,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let robot = settings.preference.open_robot_in_any_unit(settings.robot.path())?;
    let findings = patiently("inspecting the robot", || inspect(&robot));
    let warnings = findings.iter().filter(|finding| finding.severity == Severity::Warning).count();
    settings.printing.format().print(&findings, |findings| {
        let [warned, notes] = [(warnings, "warning"), (findings.len() - warnings, "note")]
            .map(|(count, word)| if count > 0 { counted(count, word) } else { format!("no {word}s") });
        let cables = counted(robot.cables.len(), "cable");
        print_sentence(&format!("{}: {cables}, {warned}, {notes}.", shown(&robot.name)));
        // Warnings first.
        let is_note = |finding: &&Finding| finding.severity != Severity::Warning;
        let (noted, warned): (Vec<_>, Vec<_>) = findings.iter().partition(is_note);
        for Finding { severity, field, value, why, remedy } in warned.into_iter().chain(noted) {
            print_sentence(&format!("{severity}: {} is {value}: {why}", numbered(field)));
            print_sentence(&format!("remedy: {remedy}"));
        }
    })?;
    Ok(if warnings > 0 { Ending::SomethingWrong } else { Ending::Well })
}
