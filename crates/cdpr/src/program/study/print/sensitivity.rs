//! The measures of sensitivity of a sampling on the terminal.

use crate::program::output::wide_table;
use cdpr_robot::Parameter;
use cdpr_study::{InputMeasures, MEASURES, Measure, Output, Quantity, SensitivitySummary, is_resolved};

/// Number of leading inputs in the table.
const MOST: usize = 10;

/// Columns of the bounds by derivatives.
const BRACKETS: [&str; 2] = ["first within", "total within"];

/// Prints inputs and groups of them, methods, and what the methods agree on.
pub(crate) fn print(heading: &str, output: Output, found: &SensitivitySummary) {
    println!("{heading}");
    print_inputs(output, found);
    print_groups(output, found);
    print_methods(found);
    let agreement = &found.agreement;
    let agreed = if agreement.inputs.is_empty() { "none".to_owned() } else { agreement.inputs.join(", ") };
    println!("above zero and among the first {} of every measure: {agreed}", agreement.first);
    for note in &found.notes {
        // A measure that is in the table has intervals in doubt; the others are not there.
        let is_there = note.split_once(':').is_some_and(|(name, _)| found.methods.contains_key(name));
        println!("{}: {note}", if is_there { "note" } else { "left out" });
    }
    println!();
}

fn print_inputs(output: Output, found: &SensitivitySummary) {
    let (unit, per_unit) = output.fine_unit();
    let measured = |measure: &Measure| found.inputs.iter().any(|input| (measure.value)(input).is_some());
    let measures: Vec<Measure> = MEASURES.into_iter().filter(measured).collect();
    let bracketed = found.inputs.iter().any(|input| input.total_bracket().is_some());
    let brackets: &[&str] = if bracketed { &BRACKETS } else { &[] };
    let labels = measures.iter().map(|measure| measure.label).chain(brackets.iter().copied());
    let mut rows = wide_table(&["input"].into_iter().chain(labels).collect::<Vec<_>>());
    for input in found.leading().into_iter().take(MOST) {
        let cell = |measure: &Measure| match (measure.quantity, (measure.interval)(input)) {
            (Quantity::Index, _) => number((measure.value)(input), 1.0, 2),
            (Quantity::Change, _) => number((measure.value)(input), per_unit, 2),
            (Quantity::Share | Quantity::Bound, None) => percent((measure.value)(input)),
            (Quantity::Share | Quantity::Bound, Some(ends)) => interval((measure.value)(input), ends),
        };
        let ends = [input.first_bracket(), input.total_bracket()].map(bracket);
        let ends = ends.into_iter().take(brackets.len());
        rows.add_row([input.input.clone()].into_iter().chain(measures.iter().map(cell)).chain(ends));
    }
    for (group, sums) in &found.sums {
        let parts = || found.inputs.iter().filter(|input| is_part(&input.input, group));
        let is_known = |measure: &Measure| {
            let open = |input: &InputMeasures| {
                let ends = (measure.interval)(input);
                ends.zip((measure.value)(input)).is_some_and(|(ends, value)| !is_resolved(value, ends))
            };
            !parts().any(open)
        };
        let sum = |measure: &Measure| percent(sums.get(measure.name).copied().filter(|_| is_known(measure)));
        rows.add_row([format!("sum of {group}")].into_iter().chain(measures.iter().map(sum)));
    }
    println!("{rows}");
    println!(
        "not resolved: the interval is wider than the value; a sum with such a part is blank; signed effect, Morris \u{b5}* and \u{3c3} [{unit}]; \
         t-Student [-]; all others in % of the variance, \
         first order unless total; DGSM a bound on the total; within: bounds on both sides by derivatives, \
         each with the confidence of the study; vector: of the {}",
        found.vector
    );
}

/// Whether an input is among those of a sum: `all`, a group of parameters, or what is no parameter.
fn is_part(input: &str, group: &str) -> bool {
    let own = input.parse::<Parameter>().ok().map(|parameter| parameter.group());
    group == "all" || own.map_or_else(|| ["weather", "shared"].contains(&group), |own| own == group)
}

/// Groups of the study, and how many directions of the inputs matter.
fn print_groups(output: Output, found: &SensitivitySummary) {
    let (unit, per_unit) = output.fine_unit();
    if !found.groups.is_empty() {
        let morris = format!("Morris \u{b5}* [{unit}]");
        let mut rows =
            wide_table(&["group", "inputs", morris.as_str(), "Sobol' first [%]", "Sobol' total [%]"]);
        for group in &found.groups {
            let index = |value, low: Option<f64>, high: Option<f64>| {
                low.zip(high).map_or_else(String::new, |(low, high)| interval(value, [low, high]))
            };
            rows.add_row([
                group.group.clone(),
                group.inputs.len().to_string(),
                number(group.morris_mean_absolute, per_unit, 2),
                index(group.sobol_first, group.sobol_first_low, group.sobol_first_high),
                index(group.sobol_total, group.sobol_total_low, group.sobol_total_high),
            ]);
        }
        println!("{rows}");
    }
    if let Some(space) = &found.subspace {
        let needed = |[found, low, high]: [usize; 3]| format!("{found} ({low} to {high})");
        println!(
            "directions of {} inputs with 90 % of the mean square slope: {}, with 99 %: {}",
            space.first.len(),
            needed(space.needed_90),
            needed(space.needed_99)
        );
    }
}

fn print_methods(found: &SensitivitySummary) {
    let mut rows = wide_table(&[
        "method",
        "observations",
        "failed",
        "seconds",
        "R\u{b2} [%]",
        "leave-one-out error [%]",
    ]);
    for (name, method) in &found.methods {
        rows.add_row([
            (*name).to_owned(),
            method.observations.to_string(),
            match method.failed_blocks {
                Some(blocks) => format!("{} in {blocks} blocks", method.failed),
                None => method.failed.to_string(),
            },
            format!("{:.3}", method.seconds),
            percent(method.r_squared),
            percent(method.leave_one_out),
        ]);
    }
    println!("{rows}");
    let agreement = &found.agreement;
    let Some((last, correlations)) = agreement.measures.last().zip(agreement.rank_correlation.last()) else {
        return;
    };
    let cells = agreement.measures.iter().zip(correlations).map(|(name, correlation)| {
        format!("{name} {}", correlation.map_or("none".to_owned(), |value| format!("{value:.2}")))
    });
    println!("rank correlation with {last}: {}", cells.collect::<Vec<_>>().join(", "));
}

fn number(value: Option<f64>, factor: f64, decimals: usize) -> String {
    value.map_or_else(String::new, |value| format!("{:.decimals$}", factor * value))
}

fn percent(share: Option<f64>) -> String {
    number(share, 100.0, 2)
}

/// A value with half the width of its interval; without it where the interval is wider than the value.
fn interval(value: Option<f64>, ends: [f64; 2]) -> String {
    match value {
        Some(value) if is_resolved(value, ends) => {
            format!("{} \u{b1} {}", percent(Some(value)), percent(Some(0.5 * (ends[1] - ends[0]))))
        }
        Some(_) => "not resolved".to_owned(),
        None => String::new(),
    }
}

fn bracket(ends: Option<[f64; 2]>) -> String {
    ends.map_or_else(String::new, |ends| ends.map(|end| percent(Some(end))).join(" .. "))
}
