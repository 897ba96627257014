//! Drawings of an analysis: an output against an input, and rows as lines across all axes.

use crate::drawing::axis::extent;
use crate::page::plot::{BLACK, BLUE, Plot, RED};
use crate::text::digits;
use cdpr_robot::{shown, shown_lines};
use cdpr_study::Analysis;
use maud::{Markup, PreEscaped, html};
use std::fmt::Write;

/// Width and height of a drawing [px].
const WIDTH: f64 = 420.0;
const HEIGHT: f64 = 260.0;
/// Rows that are drawn at most, at equal distances in the table.
const POINTS: usize = 2000;
const LINES: usize = 300;
/// Parts of equal numbers of rows, whose means are joined.
const PARTS: usize = 20;

/// Output against input: a dot a row, red where the limit fails, and the means over parts of the rows.
pub(super) fn scatter(input: &str, x: &[f64], output: &str, y: &[f64], analysis: &Analysis) -> Markup {
    let mut rows: Vec<(f64, f64)> =
        x.iter().copied().zip(y.iter().copied()).filter(|(x, y)| x.is_finite() && y.is_finite()).collect();
    if rows.is_empty() {
        return html! {};
    }
    let (across, up) = (extent(rows.iter().map(|row| row.0)), extent(rows.iter().map(|row| row.1)));
    let mut plot = Plot::new([WIDTH, HEIGHT], (&shown(input), across), (&shown(output), up));
    for &(x, y) in rows.iter().step_by(rows.len().div_ceil(POINTS).max(1)) {
        let (px, py) = (plot.x(x), plot.y(y));
        let color = if fails(analysis, y) { RED } else { BLUE };
        plot.add(format_args!(
            "<circle cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"1.5\" fill=\"{color}\" fill-opacity=\"0.5\"/>"
        ));
    }
    rows.sort_by(|one, other| one.0.total_cmp(&other.0));
    let means = rows.chunks(rows.len().div_ceil(PARTS).max(1)).map(|part| {
        let size = part.len() as f64;
        let sum = part.iter().fold((0.0, 0.0), |sum, row| (sum.0 + row.0, sum.1 + row.1));
        (plot.x(sum.0 / size), plot.y(sum.1 / size))
    });
    let line: Vec<String> = means.map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    plot.add(format_args!(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{BLACK}\" stroke-width=\"2\"/>",
        line.join(" ")
    ));
    html! {
        figure {
            div.drawing.small role="img" aria-label={ (output) " against " (input) } { (PreEscaped(plot.finish())) }
            figcaption {
                (output) " against " (input) "; the line joins means of " (PARTS) " parts of the rows."
                @if analysis.limit.is_some() { " Red: the limit fails." }
            }
        }
    }
}

/// Rows as lines across the axes of inputs and, at the right, of the output: red where the limit fails, or in
/// the uppermost tenth of the outputs.
pub(super) fn cobweb(inputs: &[(&str, &[f64])], output: (&str, &[f64]), analysis: &Analysis) -> Markup {
    if inputs.len() < 2 {
        return html! {};
    }
    let axes: Vec<(&str, &[f64])> = inputs.iter().copied().chain([output]).collect();
    let scales: Vec<Scale> = axes.iter().map(|(_, values)| Scale::of(values.iter().copied())).collect();
    let mut sorted: Vec<f64> = output.1.iter().copied().filter(|y| y.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let upper = sorted[sorted.len() * 9 / 10];
    let is_red = |y: f64| if analysis.limit.is_some() { fails(analysis, y) } else { y >= upper };
    let whole: Vec<usize> = (0..output.1.len())
        .filter(|&row| axes.iter().all(|(_, values)| values.get(row).is_some_and(|value| value.is_finite())))
        .collect();
    let mut drawn: Vec<usize> = whole.iter().copied().step_by(whole.len().div_ceil(LINES).max(1)).collect();
    // Red lines lie above.
    drawn.sort_by_key(|&row| is_red(output.1[row]));
    let (wide, step) = (WIDTH * 1.6, WIDTH * 1.6 / axes.len() as f64);
    let at = |axis: usize| step * (axis as f64 + 0.5);
    let room = 30.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {wide} {}\" width=\"{wide}\">\
         <rect width=\"{wide}\" height=\"{}\" fill=\"#FFFFFF\"/>",
        HEIGHT + room,
        HEIGHT + room
    );
    for row in drawn {
        let (color, opacity) = if is_red(output.1[row]) { (RED, 0.6) } else { (BLUE, 0.15) };
        let points: Vec<String> = axes
            .iter()
            .zip(&scales)
            .enumerate()
            .map(|(axis, ((_, values), scale))| {
                format!("{:.1},{:.1}", at(axis), HEIGHT * (1.0 - scale.share(values[row])))
            })
            .collect();
        let _ = write!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-opacity=\"{opacity}\"/>",
            points.join(" ")
        );
    }
    for (axis, (name, _)) in axes.iter().enumerate() {
        let _ = write!(
            svg,
            "<line x1=\"{x:.1}\" y1=\"0\" x2=\"{x:.1}\" y2=\"{HEIGHT}\" stroke=\"{BLACK}\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"11\" font-family=\"sans-serif\" \
             text-anchor=\"middle\" fill=\"{BLACK}\">{}</text>",
            HEIGHT + 18.0,
            html! { (shown_lines(name)) }.0,
            x = at(axis)
        );
    }
    html! {
        figure {
            div.drawing role="img" aria-label={ "Rows across the leading inputs and " (output.0) } {
                (PreEscaped(svg + "</svg>"))
            }
            figcaption {
                "Each line is a row, from the least value of an axis (below) to its greatest; red: "
                @if analysis.limit.is_some() { "the limit fails." } @else {
                    (output.0) " is " (digits(upper, 4)) " or more."
                }
            }
        }
    }
}

fn fails(analysis: &Analysis, y: f64) -> bool {
    analysis.limit.is_some_and(|failures| !failures.limit.holds(y))
}

/// Places of values between their least and greatest.
struct Scale {
    low: f64,
    high: f64,
}

impl Scale {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let range = extent(values.filter(|value| value.is_finite()));
        Self { low: range.start, high: range.end }
    }

    /// From 0.02 to 0.98.
    fn share(&self, value: f64) -> f64 {
        let range = self.high - self.low;
        if range > 0.0 { 0.02 + 0.96 * (value - self.low) / range } else { 0.5 }
    }
}
