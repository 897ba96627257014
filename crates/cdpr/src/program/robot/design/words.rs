//! Words for the objectives, the work and the values of a design.

use cdpr_assess::{Goal, Over};
use cdpr_robot::{counted, significant};

/// What an output is, with its unit, at the head of a column.
pub(super) fn titled(output: Goal) -> String {
    match output.unit() {
        "" => output.noun().to_owned(),
        unit => format!("{} [{unit}]", output.noun()),
    }
}

/// What is as good as possible, in words.
pub(super) fn noun(over: Over, output: Goal, poses: usize) -> String {
    let of = match (over, output) {
        (_, Goal::Length | Goal::Cost) => "",
        (Over::Mean, Goal::Tension) if poses > 1 => "mean greatest ",
        (_, Goal::Tension) => "greatest ",
        (Over::Mean, Goal::Stiffness) if poses > 1 => "mean lowest ",
        (_, Goal::Stiffness) => "lowest ",
        _ if poses == 1 => "",
        (Over::Mean, _) => "mean ",
        (Over::Worst, Goal::Frequency | Goal::PlatformFrequency) => "lowest ",
        (Over::Worst, _) => "greatest ",
    };
    format!("{of}{}", output.noun())
}

/// A value with six digits, without zeros at its end.
pub(super) fn value(value: f64) -> String {
    let text = significant(value, 6);
    match text.contains('.') && !text.contains('e') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// `3 starts`, or `3 configurations`, or `3 starts in each of 4 configurations`.
pub(super) fn tried(starts: usize, configurations: usize) -> String {
    match (starts, configurations) {
        (0, count) => counted(count, "configuration"),
        (starts, 1) => counted(starts, "start"),
        (starts, count) => {
            format!("{} in each of {}", counted(starts, "start"), counted(count, "configuration"))
        }
    }
}

/// What a robot has to do.
pub(super) const WITHIN: &str = "all poses within the limits";

/// The work of a search.
pub(super) fn evaluations(count: usize) -> String {
    format!("{} of a robot at all poses", counted(count, "evaluation"))
}
