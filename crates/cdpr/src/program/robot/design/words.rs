//! What a design says.

use cdpr_assess::{ActiveDemand, BestDesign, Design, Goal, Over};
use cdpr_robot::{Robot, counted, shown, significant};

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

pub(super) fn none(robot: &Robot, found: &Design) -> String {
    let poses = if found.poses == 1 { "the pose".to_owned() } else { format!("all {} poses", found.poses) };
    let reason =
        found.reason.as_ref().map_or_else(String::new, |reason| format!(" The first one: {reason}."));
    let name = shown(&robot.name);
    format!(
        "{name}: no robot was found that holds {poses} within the limits, in {}.{reason}",
        tried(found.starts, found.configurations)
    )
}

/// What becomes of the objective, and of how many it is the best.
pub(super) fn verdict(robot: &Robot, found: &Design, best: &BestDesign) -> String {
    /// A smaller share is rounding, and no change.
    const NONE: f64 = 1e-9;
    let after = best.objective;
    let amount = |value| found.output.amount(&significant(value, 4));
    let becomes = match found.before {
        Some(before) if (after - before).abs() <= NONE * before.abs() => {
            format!("stays at {}", amount(after))
        }
        Some(before) => {
            let verb = if after < before { "falls" } else { "rises" };
            format!("{verb} from {} to {}", significant(before, 4), amount(after))
        }
        None => format!("becomes {}", amount(after)),
    };
    let all = if found.starts == 0 { ", all of them evaluated" } else { "" };
    format!(
        "{}: the {} {becomes} (best of {}{all}).",
        shown(&robot.name),
        noun(found.over, found.output, found.poses),
        tried(found.starts, found.configurations)
    )
}

/// What a robot has to do.
const WITHIN: &str = "all poses within the limits";

/// The work of a search.
pub(super) fn evaluations(count: usize) -> String {
    format!("{} of a robot at all poses", counted(count, "evaluation"))
}

/// How many starts or configurations lead where, and what the robot as it is lacks.
pub(super) fn ends(found: &Design, best: &BestDesign) -> String {
    let total = found.configurations * found.starts.max(1);
    let lost = total - found.feasible;
    let searches = if found.starts == 0 {
        format!("{} of {total} configurations hold {WITHIN}", found.feasible)
    } else {
        let elsewhere = found.feasible - best.same;
        let what = if found.configurations == 1 { "starts" } else { "searches" };
        let lost =
            if lost == 0 { String::new() } else { format!(", {lost} at no robot that holds {WITHIN}") };
        format!("{} of {total} {what} end there, {elsewhere} elsewhere{lost}", best.same)
    };
    let next = best.next_configuration.map_or_else(String::new, |next| {
        format!("; the next best configuration has {}", found.output.amount(&significant(next, 4)))
    });
    let before = match (found.before, found.feasible_before) {
        (_, true) => "",
        (Some(_), false) => " The robot as it is does not keep the limits.",
        (None, false) if found.output == Goal::Cost => {
            " The robot as it is does not hold all poses within the limits."
        }
        (None, false) => " The robot as it is does not hold all poses.",
    };
    let work =
        if found.starts == 0 { String::new() } else { format!("; {}", evaluations(found.evaluations)) };
    format!("{searches}{next}{work}.{before}")
}

/// Whether it is an optimum, by the residual of its conditions.
pub(super) fn optimum(best: &BestDesign) -> Option<String> {
    let residual = best.kkt_residual?;
    let known = best.gradient_error.filter(|error| error.is_finite());
    let by_differences = known.map_or_else(String::new, |error| {
        format!(", with derivatives by differences that are right to {}", significant(error, 1))
    });
    Some(match (best.optimal, best.gradient_error) {
        _ if !residual.is_finite() => {
            "It is where a start lies, and no optimum: no search leads on from there, because derivatives are not \
             known at all poses. `choices` in place of `bounds` need none."
                .to_owned()
        }
        (true, None) => "It is a local optimum: the KKT residual is below 1e-8.".to_owned(),
        (true, Some(_)) => {
            let precision = "the KKT residual is below 1e-6, with the error of derivatives by differences";
            format!("It is a local optimum: {precision}.")
        }
        (false, _) => format!(
            "The search ended before an optimum (KKT residual {}{by_differences}): derivatives jump there, where \
             a tension meets a limit, or no step keeps all poses.",
            significant(residual, 1)
        ),
    })
}

/// The demands that keep the objective from being better.
pub(super) fn demands(found: &Design, best: &BestDesign) -> Option<String> {
    const MOST: usize = 4;
    let gain = |of| format!("{} for 1 %", found.output.amount(&significant(of, 2)));
    let one = |ActiveDemand { pose, output, cable, per_percent }: &ActiveDemand| {
        let what = match (output, cable) {
            (Some(output), Some(cable)) => {
                format!("the limit of the {} of cable {}", output.noun(), cable + 1)
            }
            (Some(output), None) => format!("the limit of the {}", output.noun()),
            (None, cable) => format!("the greatest tension of cable {}", cable.unwrap_or(0) + 1),
        };
        format!("{what} at pose {} ({})", pose + 1, gain(*per_percent))
    };
    let mut active: Vec<&ActiveDemand> = best.active.iter().collect();
    active.sort_by(|a, b| b.per_percent.total_cmp(&a.per_percent));
    let mut named: Vec<String> = active.iter().take(MOST).map(|demand| one(demand)).collect();
    for (goal, rate) in [("cost", best.cost_per_percent), ("length", best.length_per_percent)] {
        named.extend(rate.map(|of| format!("the limit of the {goal} ({})", gain(of))));
    }
    let more = active.len().saturating_sub(MOST);
    let more = if more == 0 { String::new() } else { format!(", and {more} more") };
    (!named.is_empty()).then(|| format!("What keeps it from being better: {}{more}.", named.join(", ")))
}
