//! Shares of the variance of the output by all measures of sensitivity that estimate them.

use crate::drawing::axis::{Axis, Grid, chart};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{self, BLUE, GREEN, GREY, MARGIN, ORANGE, Pen, VERMILLION, X_AXIS, px};
use crate::error::ReportError;
use crate::text::number;
use cdpr_study::{MEASURES, Measure, SamplingSummary, SensitivitySummary};
use plotters::prelude::*;

/// Measures that have a line of dots, from top to bottom, with its colour.
const LINES: [(&str, RGBColor); 6] = [
    ("derivative_share", BLUE),
    ("regression_share", ORANGE),
    ("rank_regression_share", GREEN),
    ("expansion_first", VERMILLION),
    ("sobol_first", BLACK),
    ("sobol_total", GREY),
];

/// Height of an input with all its lines [px].
const ROW: f64 = 44.0;
/// Distance between the lines of an input. The distance between inputs is 1.
const STEP: f64 = 0.14;
/// Radius of a dot [px].
const DOT: f64 = 2.6;
/// Least share drawn; smaller shares lie on the left edge.
const LEAST: f64 = 1e-4;

/// Draws the shares of the variance of the `most` leading inputs on a logarithmic axis.
///
/// There is one line per input and measure. Sobol' indices have their intervals.
///
/// # Errors
/// [`ReportError::Empty`] for a study without such measures or if `most` is zero, [`ReportError::Invalid`]
/// for a share that is not finite.
pub fn shares(summary: &SamplingSummary, most: usize, sheet: Sheet) -> Result<String, ReportError> {
    let Some(sensitivity) = &summary.sensitivity else {
        return Err(ReportError::Empty { what: "sensitivity" });
    };
    let mut inputs = sensitivity.leading();
    inputs.truncate(most);
    // The leading input is on top.
    inputs.reverse();
    let line = |(name, color): (&str, RGBColor)| {
        Some((*MEASURES.iter().find(|measure| measure.name == name)?, color))
    };
    let measured = |(measure, _): &(Measure, _)| inputs.iter().any(|input| (measure.value)(input).is_some());
    let lines: Vec<(Measure, RGBColor)> = LINES.into_iter().filter_map(line).filter(measured).collect();
    if lines.is_empty() {
        return Err(ReportError::Empty { what: "shares of the variance" });
    }
    let mut dots = Vec::new();
    for (row, input) in inputs.iter().enumerate() {
        for (line, (measure, color)) in lines.iter().enumerate() {
            let Some(value) = (measure.value)(input) else { continue };
            let field = format!("sensitivity.{}: {}", input.input, measure.label);
            let [low, high] = (measure.interval)(input).unwrap_or([value, value]);
            for value in [value, low, high] {
                ReportError::finite(&field, value)?;
            }
            let y = (row + 1) as f64 - STEP * (line as f64 - 0.5 * (lines.len() - 1) as f64);
            dots.push((y, *color, [low, value, high].map(|share| share.max(LEAST).log10())));
        }
    }
    let ticks = [0.0001, 0.001, 0.01, 0.1, 1.0].map(|share: f64| (share.log10(), percent(share))).to_vec();
    let label = match sheet.is_narrow() {
        true => "share of the variance [%]".to_owned(),
        false => format!("share of the variance of the {} [%]", summary.output.label()),
    };
    let rightmost = dots.iter().map(|(.., share)| share[2]).fold(0.0, f64::max);
    let x = Axis::given(LEAST.log10()..rightmost + 0.1, ticks, label);
    let y = Axis::names(inputs.iter().map(|input| input.input.clone()), "");
    let key: Vec<_> =
        lines.iter().map(|(measure, color)| (measure.label.to_owned(), Pen::bar(*color))).collect();
    let heading =
        Heading { title: &summary.title, lines: &subtitle(summary, sensitivity, inputs.len()), key: &key };
    let height = heading.height(sheet) + ROW * inputs.len() as f64 + X_AXIS + MARGIN + 4.0;
    style::figure([sheet.width(), height], |area| {
        let chart = chart(&heading.draw(sheet, area)?, &x, &y, Grid::Vertical)?;
        let plot = chart.plotting_area();
        for row in 1..inputs.len() {
            let between = row as f64 + 0.5;
            Pen::solid(GREY, 0.5).draw(plot, vec![(x.range.start, between), (x.range.end, between)])?;
        }
        for (y, color, [low, value, high]) in dots {
            Pen::solid(color, 1.2).draw(plot, vec![(low, y), (high, y)])?;
            plot.draw(&Circle::new((value, y), px(DOT), color.filled()))?;
        }
        Ok(())
    })
}

fn subtitle(summary: &SamplingSummary, sensitivity: &SensitivitySummary, shown: usize) -> Vec<String> {
    let all = sensitivity.inputs.len();
    let least = percent(LEAST);
    let confidence = number(100.0 * summary.confidence, 0);
    vec![
        format!("{shown} of {all} parameters; what is below {least} % lies on the left edge"),
        format!(
            "first-order shares by every measure, total Sobol' indices; lines: intervals of {confidence} % \
                confidence"
        ),
    ]
}

fn percent(share: f64) -> String {
    format!("{}", (1e4 * share).round() / 100.0)
}
