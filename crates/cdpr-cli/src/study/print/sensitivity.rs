//! The measures of sensitivity of a sampling on the terminal.

use crate::output::table;
use cdpr_study::{InputMeasures, SensitivitySummary};

/// Number of leading inputs in the table.
const MOST: usize = 10;

/// Prints inputs and groups of them, methods, and what the methods agree on.
pub(crate) fn print(heading: &str, found: &SensitivitySummary) {
    println!("{heading}");
    print_inputs(found);
    print_methods(found);
    let agreement = &found.agreement;
    let agreed = if agreement.inputs.is_empty() { "none".to_owned() } else { agreement.inputs.join(", ") };
    println!("above zero and among the first {} of every measure: {agreed}", agreement.first);
    for note in &found.notes {
        println!("left out: {note}");
    }
    println!();
}

fn print_inputs(found: &SensitivitySummary) {
    let mut rows = table(&[
        "input",
        "t",
        "effect",
        "derivatives",
        "SRC\u{b2}",
        "rank SRC\u{b2}",
        "\u{b5}*",
        "\u{3c3}",
        "DGSM",
        "expansion S",
        "T",
        "Sobol' S",
        "Sobol' T",
    ]);
    for input in found.leading().into_iter().take(MOST) {
        let InputMeasures { sobol_first_low, sobol_first_high, sobol_total_low, sobol_total_high, .. } =
            *input;
        rows.add_row([
            input.input.clone(),
            number(input.t_student, 1.0, 2),
            number(input.signed_effect_mm, 1e3, 2),
            percent(input.derivative_share),
            percent(input.regression_share),
            percent(input.rank_regression_share),
            number(input.morris_mean_absolute_mm, 1e3, 2),
            number(input.morris_std_mm, 1e3, 2),
            percent(input.dgsm_total_bound),
            percent(input.expansion_first),
            percent(input.expansion_total),
            interval(input.sobol_first, sobol_first_low, sobol_first_high),
            interval(input.sobol_total, sobol_total_low, sobol_total_high),
        ]);
    }
    for (group, sums) in &found.sums {
        let sum = |name| percent(sums.get(name).copied());
        let none = String::new();
        rows.add_row([
            format!("sum of {group}"),
            none.clone(),
            none.clone(),
            sum("derivative_share"),
            sum("regression_share"),
            sum("rank_regression_share"),
            none.clone(),
            none.clone(),
            none,
            sum("expansion_first"),
            sum("expansion_total"),
            sum("sobol_first"),
            sum("sobol_total"),
        ]);
    }
    println!("{rows}");
    println!(
        "effect, Morris's \u{b5}* and \u{3c3} [\u{b5}m]; t [-]; all others in % of the variance, \
         DGSM a bound on T; S first order, T total"
    );
}

fn print_methods(found: &SensitivitySummary) {
    let mut rows =
        table(&["method", "observations", "failed", "seconds", "R\u{b2} [%]", "leave-one-out error [%]"]);
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

fn interval(value: Option<f64>, low: Option<f64>, high: Option<f64>) -> String {
    let half = high.zip(low).map(|(high, low)| 0.5 * (high - low));
    half.map_or_else(String::new, |half| format!("{} \u{b1} {}", percent(value), percent(Some(half))))
}
