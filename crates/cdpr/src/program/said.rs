//! How much is said on the standard error: `--quiet` and `--verbose`.

use cdpr_robot::{Robot, shown};
use std::fmt;
use std::sync::OnceLock;

/// The name of the robot that the answer is about.
static ROBOT: OnceLock<String> = OnceLock::new();

/// Remembers the name of the robot that the answer is about.
pub(crate) fn about(name: &str) {
    // A command is about one robot, the first one.
    let _ = ROBOT.set(shown(name).into_owned());
}

/// The name of the robot that the answer is about, as it is shown; empty where there is no robot.
pub(crate) fn robot() -> &'static str {
    ROBOT.get().map_or("", String::as_str)
}

/// How much is said.
static SAID: OnceLock<Said> = OnceLock::new();

/// How much is said besides answers, questions, warnings and errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Said {
    /// No progress, no notes.
    Less,
    Usual,
    /// Also what is read, and how long the command takes.
    More,
}

/// Sets how much is said.
pub(crate) fn say(said: Said) {
    // It is set once, at the beginning.
    let _ = SAID.set(said);
}

/// Whether what is said at least at this setting is said.
pub(crate) fn is_said(least: Said) -> bool {
    let said = *SAID.get().unwrap_or(&Said::Usual);
    said != Said::Less && (said == Said::More || least == Said::Usual)
}

/// Says something that `--quiet` leaves out.
pub(crate) fn note(text: fmt::Arguments) {
    if is_said(Said::Usual) {
        eprintln!("note: {text}");
    }
}

/// Says something that only `--verbose` asks for.
pub(crate) fn detail(text: fmt::Arguments) {
    if is_said(Said::More) {
        eprintln!("{text}");
    }
}

/// Why maps and paths of a robot have no frequencies, if it is so.
pub(crate) fn missing_frequencies(robot: &Robot) -> Option<&'static str> {
    let reason = "no frequencies: the robot has no `platform.inertia`, and only `modes` assumes one";
    robot.lacks_inertia().then_some(reason)
}
