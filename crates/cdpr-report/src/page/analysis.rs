//! The report of the analysis of a table: what each output says, with scatter plots and a cobweb.

mod drawings;

use crate::page::analysis::drawings::{cobweb, scatter};
use crate::page::elements::{Document, Section, cell, numeric, table};
use crate::text;
use cdpr_robot::{counted, shown};
use cdpr_sensitivity::{Estimate, LeadingInputs, LevelMean, WassersteinBures, is_resolved};
use cdpr_study::{Analysis, Dependence, GivenTable, InputAnalysis, TableAnalysis, VectorAnalysis};
use maud::{Markup, html};

/// Inputs with a scatter plot, and axes of a cobweb, at most.
const DRAWN: usize = 9;

/// Writes the report of an analysis as the text of an HTML file, which needs no other file and no script.
///
/// The table is the one that was analysed.
pub fn analysis_report(table: &GivenTable, found: &TableAnalysis) -> String {
    let name = std::path::Path::new(&found.table).file_name().map(|name| name.to_string_lossy().into_owned());
    let title = format!("Analysis of {}", shown(&name.unwrap_or_else(|| found.table.clone())));
    let output = |(number, (name, analysis)): (usize, (&String, &Analysis))| {
        Section::new(format!("output{}", number + 1), name, of_output(table, name, analysis))
    };
    let mut sections: Vec<Section> = found.outputs.iter().enumerate().map(output).collect();
    if let Some(vector) = &found.vector {
        let title = format!("Vector ({})", vector.columns.join(", "));
        sections.push(Section::new("vector", title, of_vector(vector)));
    }
    let version = env!("CARGO_PKG_VERSION");
    Document { title: &title, version, header: header(&title, found), sections, live: None }.write()
}

fn header(title: &str, found: &TableAnalysis) -> Markup {
    html! {
        header {
            h1 { (title) }
            p {
                (counted(found.rows, "row")) ", " (counted(found.inputs.len(), "input")) ", "
                (counted(found.outputs.len(), "output"))
                @if found.left_out > 0 {
                    "; " (counted(found.left_out, "row")) @if found.left_out == 1 { " is" } @else { " are" }
                    " left out: an input has no value"
                }
                "."
                @if !found.unused.is_empty() { " Not analysed: " (found.unused.join(", ")) "." }
            }
            @for question in &found.questions { p.note { "Question: " (question) "." } }
            @if found.bad_cells > 0 {
                p.note {
                    (counted(found.bad_cells, "cell")) @if found.bad_cells == 1 { " has" } @else { " have" }
                    " no number"
                    @for bad in &found.first_bad_cells {
                        "; row " (bad.row) ", " code { (bad.column) }
                    }
                    "."
                }
            }
        }
    }
}

fn of_output(table: &GivenTable, name: &str, analysis: &Analysis) -> Markup {
    html! {
        (verdict(analysis))
        (summary(name, analysis))
        (measures(analysis))
        @if analysis.limit.is_some() { (at_limit(analysis)) }
        @for note in &analysis.notes { p.note { (note) "." } }
        @let drawn = LeadingInputs::order(analysis).into_iter().take(DRAWN).collect::<Vec<_>>();
        @if let Some(y) = column(table, name) {
            @for input in &drawn {
                @if let Some(x) = column(table, &input.input) { (scatter(&input.input, x, name, y, analysis)) }
            }
            @let axes = drawn.iter().map(|input| input.input.as_str());
            @let axes = axes.filter_map(|axis| Some((axis, column(table, axis)?)));
            (cobweb(&axes.collect::<Vec<_>>(), (name, y), analysis))
        }
    }
}

fn column<'a>(table: &'a GivenTable, name: &str) -> Option<&'a [f64]> {
    table.columns.iter().find(|column| column.name == name).map(|column| column.values.as_slice())
}

fn summary(name: &str, analysis: &Analysis) -> Markup {
    let of = &analysis.summary;
    let [low, median, high] = analysis.quantiles;
    let head = ["values", "failed", "mean", "deviation", "least", "5 %", "median", "95 %", "greatest"];
    let numbers = [of.mean, of.std, of.min, low, median, high, of.max];
    let row: Vec<Markup> = [cell(of.count.to_string()), cell(of.failed.to_string())]
        .into_iter()
        .chain(numbers.map(|value| numeric(value, 5)))
        .collect();
    html! {
        (table(&format!("Values of {name}"), &head, &[row]))
        @if let Some(fit) = analysis.best_fit { p { "Law of the values: " (fit) "." } }
    }
}

/// The verdict, what was found of its conditions, and the levels of words.
fn verdict(analysis: &Analysis) -> Markup {
    let verdict = &analysis.verdict;
    let head = ["level", "rows", "mean"];
    let LeadingInputs { rows: leading, captions } = LeadingInputs::of(analysis);
    let leading: Vec<Vec<Markup>> = leading.iter().map(|row| row.iter().map(cell).collect()).collect();
    html! {
        @for sentence in &verdict.sentences { p { (text::capital(sentence)) "." } }
        @if !leading.is_empty() {
            (table(&text::capital(&captions.join(". ")), &LeadingInputs::HEADER, &leading))
        }
        p {
            (counted(verdict.tests, "test")) " of all inputs and measures, corrected together: one or more \
             false certainties in 5 % of all tables at most."
        }
        @for condition in &verdict.conditions {
            p.note { @if condition.is_question() { "Question: " } (condition.text) "." }
        }
        @for input in analysis.inputs.iter().filter(|input| !input.levels.is_empty()) {
            @let row = |of: &LevelMean| vec![cell(&of.level), cell(of.rows.to_string()), numeric(of.mean, 4)];
            @let rows = input.levels.iter().map(row).collect::<Vec<_>>();
            (table(&format!("Levels of {}", input.input), &head, &rows))
        }
    }
}

fn of_vector(vector: &VectorAnalysis) -> Markup {
    let row = |(input, of): (&String, &WassersteinBures)| -> Vec<Markup> {
        let known = |of: &Estimate| is_resolved(of.value, [of.low, of.high]);
        let index = if known(&of.index) { numeric(of.index.value, 3) } else { cell("not resolved") };
        let means = if known(&of.means) { numeric(of.means.value, 3) } else { cell("not resolved") };
        vec![cell(input), index, numeric(of.index.low, 3), numeric(of.index.high, 3), means]
    };
    let rows: Vec<_> = vector.bures.iter().map(row).collect();
    let head = ["input", "Wasserstein-Bures", "from", "to", "of which by the means"];
    table(
        "How much each input moves the law of the vector (0: not at all, 1: it alone determines it)",
        &head,
        &rows,
    )
}

fn measures(analysis: &Analysis) -> Markup {
    let head = [
        "input",
        "effect",
        "t",
        "SRC",
        "SRRC",
        "S by ranks [%]",
        "S, expansion",
        "T, expansion",
        "HSIC R\u{b2}",
        "p",
        "PAWN",
        "noise",
        "\u{3b4}",
        "at least",
        "noise",
    ];
    let row = |input: &&InputAnalysis| {
        vec![
            cell(&input.input),
            numeric(input.half.map(|half| half.effect), 3),
            numeric(input.half.and_then(|half| half.student), 3),
            numeric(input.standardized, 3),
            numeric(input.rank_standardized, 3),
            input.first.map_or_else(|| numeric(None, 3), |first| cell(first.percent())),
            numeric(input.shares.map(|shares| shares.closed), 3),
            numeric(input.shares.map(|shares| shares.total), 3),
            numeric(input.dependence.map(|dependence| dependence.r_squared), 3),
            p_value(input.dependence),
            numeric(input.pawn.map(|pawn| pawn.median), 3),
            numeric(input.pawn.map(|pawn| pawn.noise), 2),
            numeric(input.delta.map(|delta| delta.delta), 3),
            numeric(input.delta.map(|delta| delta.at_least), 2),
            numeric(input.delta.map(|delta| delta.noise), 2),
        ]
    };
    let rows: Vec<Vec<Markup>> = LeadingInputs::order(analysis).iter().map(row).collect();
    let percent = |share: f64| text::digits(100.0 * share, 3);
    html! {
        (table("Measures of each input", &head, &rows))
        p {
            @if let Some(share) = analysis.r_squared {
                "A linear model explains " (percent(share)) " % of the variance. "
            }
            @if let Some(expansion) = &analysis.expansion {
                "The polynomial model has " (expansion.terms.len()) " terms up to the degree "
                    (expansion.degree) " and does not predict " (percent(expansion.leave_one_out)) " %. "
            }
            "An effect is the mean of the upper half of an input's values less that of the lower half. Values \
             below the noise next to them are as large without an effect in one table of twenty."
        }
    }
}

fn p_value(dependence: Option<Dependence>) -> Markup {
    match dependence {
        Some(Dependence { p_value, .. }) if p_value < 1e-4 => cell("< 0.0001"),
        Some(Dependence { p_value, .. }) => numeric(p_value, 2),
        None => numeric(None, 2),
    }
}

fn at_limit(analysis: &Analysis) -> Markup {
    let Some(failures) = &analysis.limit else { return html! {} };
    let head = ["input", "target R\u{b2}", "p", "conditional R\u{b2}", "p", "place of the failures"];
    let row = |input: &&InputAnalysis| {
        let at = input.limit?;
        Some(vec![
            cell(&input.input),
            numeric(at.target.r_squared, 3),
            p_value(Some(at.target)),
            numeric(at.conditional.map(|dependence| dependence.r_squared), 3),
            p_value(at.conditional),
            numeric(at.place, 2),
        ])
    };
    let mut inputs: Vec<&InputAnalysis> = analysis.inputs.iter().collect();
    let strength = |input: &InputAnalysis| input.limit.map_or(0.0, |at| at.target.r_squared);
    inputs.sort_by(|one, other| strength(other).total_cmp(&strength(one)));
    let rows: Vec<Vec<Markup>> = inputs.iter().filter_map(row).collect();
    html! {
        p {
            (counted(failures.count, "value")) @if failures.count == 1 { " fails" } @else { " fail" }
            " the limit (" (text::fields(&failures.limit)) "): "
            (text::digits(100.0 * failures.share.value, 3)) " %, with 95 % confidence between "
            (text::digits(100.0 * failures.share.low, 3)) " % and "
            (text::digits(100.0 * failures.share.high, 3)) " % for independent rows."
        }
        @if !rows.is_empty() {
            (table("What makes the limit fail", &head, &rows))
            p { "The place is the share of all values of an input below the median of those that fail: 0.5 \
                 without a relation, near 1 where large values fail." }
        }
    }
}
