//! The analysis of a table on the terminal.

use crate::program::output::{print_sentence, table, wide_table};
use cdpr_robot::{counted, significant};
use cdpr_study::{
    Analysis, Dependence, Estimate, InputAnalysis, LeadingInputs, LevelMean, LimitFailures, OutputLimit,
    TableAnalysis, VectorAnalysis, is_resolved,
};

/// Inputs in a table on the terminal.
const MOST: usize = 20;

/// Inputs in the table of the answer.
const LEADING: usize = 5;

/// Prints what each output says, and what is odd about the table.
pub(in crate::program::study) fn print(found: &TableAnalysis) {
    for (name, analysis) in &found.outputs {
        print_answer(name, analysis);
        println!();
    }
    found.vector.iter().for_each(print_vector);
    print_table(found);
}

/// Which inputs matter, the values, and the leading inputs.
fn print_answer(name: &str, analysis: &Analysis) {
    let verdict = &analysis.verdict;
    let mut before = format!("{name}: ");
    if let Some(failures) = analysis.limit {
        print_sentence(&(std::mem::take(&mut before) + &of_limit(&failures)));
    }
    verdict.sentences.iter().for_each(|sentence| print_sentence(&(std::mem::take(&mut before) + sentence)));
    let of = &analysis.summary;
    let [mean, std, min, max] = [of.mean, of.std, of.min, of.max].map(number);
    let values = counted(of.count, "value");
    print_sentence(&format!("mean {mean}, std {std}, range {min} to {max}; {values}, {} failed", of.failed));
    for condition in &verdict.conditions {
        print_sentence(&format!(
            "{}: {}",
            if condition.is_question() { "question" } else { "note" },
            condition.text
        ));
    }
    print_leading(analysis);
    if analysis.limit.is_some() {
        print_causes(analysis);
    }
}

/// The leading inputs by their first-order shares, and the test that finds each.
fn print_leading(analysis: &Analysis) {
    let LeadingInputs { rows, captions } = LeadingInputs::of(analysis);
    if !rows.is_empty() {
        let mut lines = table(&LeadingInputs::HEADER);
        lines.add_rows(rows);
        println!("{lines}");
    }
    captions.iter().for_each(|caption| print_sentence(caption));
}

/// What makes the limit fail.
fn print_causes(analysis: &Analysis) {
    let strength = |input: &InputAnalysis| input.limit.map_or(0.0, |at| at.target.r_squared);
    let mut rows = table(&["related to the failures", "target R\u{b2}", "p"]);
    let causes = leading(analysis, strength).into_iter();
    for (input, at) in causes.filter_map(|input| Some((input, input.limit?))).take(LEADING) {
        rows.add_row([input.input.clone(), format!("{:.3}", at.target.r_squared), p_value(Some(at.target))]);
    }
    if rows.row_count() > 0 {
        println!("{rows}\np of each input alone, not corrected for the number of inputs");
    }
}

/// Rows, inputs, outputs, and what of the table is not analysed.
fn print_table(found: &TableAnalysis) {
    println!(
        "{}: {}, {}, {}",
        found.table,
        counted(found.rows, "row"),
        counted(found.inputs.len(), "input"),
        counted(found.outputs.len(), "output")
    );
    if found.left_out > 0 {
        let are = if found.left_out == 1 { "is" } else { "are" };
        println!("{} {are} left out: an input has no value", counted(found.left_out, "row"));
    }
    if !found.unused.is_empty() {
        println!("not analysed: {}", found.unused.join(", "));
    }
    for question in &found.questions {
        println!("question: {question}");
    }
    for bad in &found.first_bad_cells {
        let text = if bad.text.trim().is_empty() { "empty" } else { &bad.text };
        println!("no number: row {}, column {}: {text}", bad.row, bad.column);
    }
    let more = found.bad_cells - found.first_bad_cells.len();
    if more > 0 {
        println!("no number: {} more", counted(more, "cell"));
    }
}

/// Prints all measures of all inputs.
pub(in crate::program::study) fn print_details(found: &TableAnalysis) {
    for (name, analysis) in &found.outputs {
        println!();
        print_summary(name, analysis);
        print_inputs(analysis);
        print_limit(analysis);
        for note in &analysis.notes {
            println!("note: {note}");
        }
    }
}

/// Inputs by their index, the greatest first.
fn print_vector(vector: &VectorAnalysis) {
    print_sentence(&format!(
        "({}): how much an input moves the law of this vector",
        vector.columns.join(", ")
    ));
    let mut leading: Vec<_> = vector.bures.iter().collect();
    leading.sort_by(|one, other| other.1.index.value.total_cmp(&one.1.index.value));
    let mut rows = table(&["input", "Wasserstein-Bures", "of which by the means"]);
    let cell = |of: &Estimate| match is_resolved(of.value, [of.low, of.high]) {
        true => format!("{:.3} \u{b1} {:.3}", of.value, 0.5 * of.width()),
        false => "not resolved".to_owned(),
    };
    for (input, of) in leading.into_iter().take(MOST) {
        rows.add_row([input.clone(), cell(&of.index), cell(&of.means)]);
    }
    println!("{rows}\n");
}

fn print_summary(name: &str, analysis: &Analysis) {
    let of = &analysis.summary;
    let [low, median, high] = analysis.quantiles.map(number);
    println!(
        "{name}: {}, {} failed; mean {}, std {}; 5 % {low}, median {median}, 95 % {high}; {} to {}",
        counted(of.count, "value"),
        of.failed,
        number(of.mean),
        number(of.std),
        number(of.min),
        number(of.max)
    );
    if let Some(fit) = analysis.best_fit {
        println!("law: {fit}");
    }
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let linear = analysis.r_squared.zip(analysis.rank_r_squared);
    if let Some((values, ranks)) = linear {
        // Rounding may be below zero.
        let [values, ranks] = [values, ranks].map(|share| percent(share.max(0.0)));
        println!("R\u{b2} of a linear model: {values}, of ranks {ranks}");
    }
    if let Some(expansion) = &analysis.expansion {
        println!(
            "polynomial model: {} up to degree {}, error {} of the variance",
            counted(expansion.terms.len(), "term"),
            expansion.degree,
            percent(expansion.leave_one_out)
        );
    }
}

/// Inputs by what a function says of them, the greatest first.
fn leading(analysis: &Analysis, of: impl Fn(&InputAnalysis) -> f64) -> Vec<&InputAnalysis> {
    let mut inputs: Vec<&InputAnalysis> = analysis.inputs.iter().collect();
    inputs.sort_by(|one, other| of(other).total_cmp(&of(one)));
    inputs
}

fn print_inputs(analysis: &Analysis) {
    let header = [
        "input",
        "effect",
        "t",
        "SRC",
        "SRRC",
        "S ranks [%]",
        "S, T poly. [%]",
        "HSIC R\u{b2}",
        "p",
        "PAWN",
        "\u{3b4}, at least",
    ];
    let mut rows = wide_table(&header);
    let leading = LeadingInputs::order(analysis);
    let two = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.2}"));
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    for input in leading.iter().take(MOST) {
        let first = input.first.map(|first| first.percent());
        let shares = input.shares.map(|of| format!("{}, {}", percent(of.closed), percent(of.total)));
        let over = |value: f64, noise: f64| {
            if value > noise { format!("{value:.3}") } else { format!("({value:.3})") }
        };
        rows.add_row([
            input.input.clone(),
            input.half.map_or_else(String::new, |half| number(half.effect)),
            input.half.and_then(|half| half.student).map_or_else(String::new, |t| format!("{t:.1}")),
            two(input.standardized),
            two(input.rank_standardized),
            first.unwrap_or_default(),
            shares.unwrap_or_default(),
            input.dependence.map_or_else(String::new, |dependence| format!("{:.3}", dependence.r_squared)),
            p_value(input.dependence),
            input.pawn.map_or_else(String::new, |pawn| over(pawn.median, pawn.noise)),
            input.delta.map_or_else(String::new, |delta| {
                format!("{}, {:.3}", over(delta.delta, delta.noise), delta.at_least)
            }),
        ]);
    }
    println!("{rows}");
    if leading.len() > MOST {
        let more = leading.len() - MOST;
        let are = if more == 1 { "is" } else { "are" };
        println!(
            "{more} more {} {are} in --format json and --out",
            if more == 1 { "input" } else { "inputs" }
        );
    }
    println!("in brackets: as large without an effect in one table of twenty");
    for input in leading.iter().take(MOST).filter(|input| !input.levels.is_empty()) {
        let level =
            |of: &LevelMean| format!("{} {} ({})", of.level, number(of.mean), counted(of.rows, "row"));
        let levels: Vec<String> = input.levels.iter().take(MOST).map(level).collect();
        let more = if input.levels.len() > MOST { ", ..." } else { "" };
        println!("means of {}: {}{more}", input.input, levels.join(", "));
    }
}

/// How often a limit fails.
fn of_limit(failures: &LimitFailures) -> String {
    let (sign, value) = match failures.limit {
        OutputLimit::Below(value) => ("<", value),
        OutputLimit::AtMost(value) => ("<=", value),
        OutputLimit::Above(value) => (">", value),
        OutputLimit::AtLeast(value) => (">=", value),
    };
    format!(
        "limit {sign} {value}: {} of {} {}, {:.2} % ({:.2} % to {:.2} %)",
        failures.count,
        counted(failures.rows, "value"),
        if failures.count == 1 { "fails" } else { "fail" },
        100.0 * failures.share.value,
        100.0 * failures.share.low,
        100.0 * failures.share.high
    )
}

/// What makes a limit fail, all measures.
fn print_limit(analysis: &Analysis) {
    let strength = |input: &InputAnalysis| input.limit.map_or(0.0, |at| at.target.r_squared);
    let mut rows =
        wide_table(&["input", "target R\u{b2}", "p", "conditional R\u{b2}", "p", "place of the failures"]);
    let mut any = false;
    for input in leading(analysis, strength).into_iter().take(MOST) {
        let Some(at) = input.limit else { continue };
        any = true;
        let conditional = at.conditional.map(|dependence| format!("{:.3}", dependence.r_squared));
        rows.add_row([
            input.input.clone(),
            format!("{:.3}", at.target.r_squared),
            p_value(Some(at.target)),
            conditional.unwrap_or_default(),
            p_value(at.conditional),
            at.place.map_or_else(String::new, |place| format!("{place:.2}")),
        ]);
    }
    if any {
        println!("{rows}");
        println!(
            "target: what makes the limit fail; conditional: what moves the values that fail; place: share of \
             all values below the median of those that fail"
        );
    }
}

fn p_value(dependence: Option<Dependence>) -> String {
    match dependence {
        None => String::new(),
        Some(Dependence { p_value, .. }) if p_value < 1e-4 => "< 1e-4".to_owned(),
        Some(Dependence { p_value, .. }) => format!("{p_value:.4}"),
    }
}

/// Four significant digits.
fn number(value: f64) -> String {
    significant(value, 4)
}
