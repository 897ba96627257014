//! Words for the objectives, the work, the values and the best robot of a design.

use cdpr_assess::{BestDesign, Crossings, Goal, Over, OwnStiffness};
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

/// Whether it is an optimum, by the residual of its conditions.
pub(super) fn optimum(output: Goal, best: &BestDesign) -> Option<String> {
    let residual = best.kkt_residual?;
    let known = best.gradient_error.filter(|error| error.is_finite());
    let by_differences = known.map_or_else(String::new, |error| {
        format!(", with derivatives by differences that are right to {}", significant(error, 1))
    });
    // A mean over the poses of what is the greatest at each has kinks of its own.
    let kinks = match output {
        Goal::Tension => ", where another cable becomes the one that is pulled most",
        Goal::Length | Goal::Cost => ", where a cable becomes longest at another pose",
        _ => "",
    };
    Some(match (best.optimal, best.gradient_error) {
        _ if !residual.is_finite() => {
            "It is where a start lies, and no optimum: no search leads on from there, because derivatives are \
             not known at all poses. `choices` instead of `bounds` need none."
                .to_owned()
        }
        (true, None) => "It is a local optimum: the KKT residual is below 1e-8.".to_owned(),
        (true, Some(_)) => {
            let precision = "the KKT residual is below 1e-6, with the error of derivatives by differences";
            format!("It is a local optimum: {precision}.")
        }
        (false, _) => format!(
            "The search ended before an optimum (KKT residual {}{by_differences}): derivatives jump there, \
             where a tension meets a limit{kinks}, or no step keeps all poses.",
            significant(residual, 1)
        ),
    })
}

/// The stiffness that other commands have of the robot.
pub(super) fn own(best: &BestDesign) -> Option<String> {
    let OwnStiffness { taken_length, own_length, stiffness } = best.own_stiffness?;
    let [taken, own, stiffness] = [taken_length, own_length, stiffness].map(|of| significant(of, 4));
    Some(format!(
        "Rotations count with {taken} m, the characteristic length of the robot as it is. That of the new \
         robot is {own} m, by which its lowest stiffness is {stiffness} N/m."
    ))
}

/// Which cables touch or cross.
pub(super) fn crossing(best: &BestDesign) -> Option<String> {
    let Crossings { pose, pairs } = best.crossings.as_ref()?;
    let pairs = pairs.iter().map(|[i, j]| format!("{} and {}", i + 1, j + 1)).collect::<Vec<_>>().join(", ");
    Some(format!(
        "Cables {pairs} touch or cross at pose {}: the search does not look at clearances.",
        pose + 1
    ))
}
