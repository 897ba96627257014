//! Published figures beside the computed ones.

use crate::page::elements::{Section, cell, table};
use crate::text;
use cdpr_study::{ComparisonRow, ComparisonSpec, Summary, Value, Verdict};
use maud::{Markup, html};

/// Section of the comparison. A study without published figures has none.
pub(crate) fn section(summary: &Summary) -> Option<Section> {
    if summary.comparison.is_empty() {
        return None;
    }
    let rows: Vec<Vec<Markup>> = summary.comparison.iter().map(row).collect();
    let count = |verdict: Verdict| summary.comparison.iter().filter(|row| row.verdict == verdict).count();
    let (missed, open) = (count(Verdict::NotReproduced), count(Verdict::Undecided));
    let head = ["Figure", "Quantity", "Published", "Computed", "Unit", "Difference", "Verdict"];
    let body = html! {
        p {
            (count(Verdict::Reproduced)) " of " (rows.len()) " published figures are reproduced, " (missed)
                " are not" @if open > 0 { ", " (open) " undecided" } ". "
            "A number is reproduced if it differs from the published one by at most half of its last digit \
                plus 1 %. A word is "
            "reproduced if it is the same, a law only if the observations decide on it. Points are ranked by \
                the largest t-Student index of their coordinates. \"Nearly equal\" "
            "means that the largest is at most 1.5 times the smallest."
        }
        (table("Published and computed figures", &head, &rows))
    };
    Some(Section::new("comparison", "Beside the published figures", body))
}

fn row(row: &ComparisonRow) -> Vec<Markup> {
    let value = |value: &Value, said: fn(f64, usize) -> String| match value {
        Value::Number(number) => html! { span.number { (said(*number, 4)) } },
        Value::Text(text) => cell(text),
    };
    let difference = match (&row.paper, &row.computed) {
        (Value::Number(paper), Value::Number(computed)) if *paper != 0.0 => {
            let share = 100.0 * (computed - paper) / paper.abs();
            format!("{}{} %", if share > 0.0 { "+" } else { "" }, text::digits(share, 2))
        }
        _ => String::new(),
    };
    let class = match row.verdict {
        Verdict::Reproduced => "verdict yes",
        Verdict::NotReproduced => "verdict no",
        Verdict::Undecided => "verdict",
    };
    vec![
        cell(&row.figure),
        html! { (row.quantity) span.detail { (row.study) } @if let Some(note) = &row.note { span.detail {
        (note) } } },
        value(&row.paper, text::digits),
        value(&row.computed, text::figures),
        cell(&row.unit),
        html! { span.number { (difference) } },
        html! { span class=(class) { (row.verdict) } },
    ]
}

/// Sentence on the published figures with which statistics are compared, such as `The published counterpart
/// is Fig. 4a.`. It is empty without such figures.
pub(crate) fn counterpart(rows: &[ComparisonSpec], is_meant: impl Fn(&ComparisonSpec) -> bool) -> String {
    let mut figures: Vec<&str> = Vec::new();
    for row in rows.iter().filter(|row| is_meant(row)) {
        if row.figure.starts_with(|c: char| c.is_ascii_digit()) && !figures.contains(&row.figure.as_str()) {
            figures.push(&row.figure);
        }
    }
    if figures.is_empty() {
        String::new()
    } else {
        format!(" The published counterpart is Fig. {}.", figures.join(", "))
    }
}
