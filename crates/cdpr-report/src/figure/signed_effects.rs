//! Largest signed effects with their intervals.

use crate::drawing::axis::{Axis, Grid, chart};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{self, BLUE, GREY, MARGIN, Pen, X_AXIS};
use crate::error::ReportError;
use cdpr_study::{SamplingSummary, SignedEffect};
use plotters::prelude::*;

/// Height of a row [px].
const ROW: f64 = 18.0;
/// Height of a bar and of the ends of its interval. The distance between rows is 1.
const BAR: f64 = 0.66;
const CAP: f64 = 0.3;

/// Draws the `most` largest signed effects as horizontal bars with their intervals, the largest on top.
///
/// Bars are grey if the interval contains zero.
///
/// # Errors
/// [`ReportError::Empty`] for a study without replicates or if `most` is zero, [`ReportError::Invalid`] for a
/// value that is not finite.
pub fn signed_effects(summary: &SamplingSummary, most: usize, sheet: Sheet) -> Result<String, ReportError> {
    let mut effects: Vec<(&String, &SignedEffect)> = summary.signed_effects.iter().collect();
    let output = summary.output;
    let field = output.named("signed_effects_mm");
    for (name, effect) in &effects {
        for value in [effect.effect, effect.low, effect.high] {
            ReportError::finite(&format!("{field}.{name}"), value)?;
        }
    }
    effects.sort_by(|one, other| other.1.effect.abs().total_cmp(&one.1.effect.abs()));
    effects.truncate(most);
    // The largest effect is on top.
    effects.reverse();
    if effects.is_empty() {
        return Err(ReportError::Empty { what: "signed_effects_mm" });
    }

    let ends = || effects.iter().flat_map(|(_, effect)| [effect.effect, effect.low, effect.high]);
    let (low, high) = (ends().fold(0.0, f64::min), ends().fold(0.0, f64::max));
    let margin = 0.05 * (high - low);
    let label = match sheet.is_narrow() {
        true => format!("signed effect [{}]", output.unit()),
        false => format!("signed effect on the {}", output.axis()),
    };
    let x = Axis::numbers(low - margin..high + margin, 9, label);
    let y = Axis::names(effects.iter().map(|(name, _)| (*name).clone()), "");
    let unclear = effects.iter().any(|(_, effect)| contains_zero(effect));
    let key = [("effect".to_owned(), Pen::bar(BLUE)), ("interval contains zero".to_owned(), Pen::bar(GREY))];
    let heading = Heading {
        title: &summary.title,
        lines: &[
            format!(
                "signed effect: mean of the {} over the upper half of a parameter's range minus that over \
                    the lower half",
                output.short()
            ),
            format!(
                "{} of {} parameters; intervals of {} % confidence from {} replicates",
                effects.len(),
                summary.signed_effects.len(),
                (1e3 * summary.confidence).round() / 10.0,
                summary.replicates
            ),
        ],
        key: if unclear { &key } else { &[] },
    };
    let height = heading.height(sheet) + ROW * effects.len() as f64 + X_AXIS + MARGIN + 4.0;
    style::figure([sheet.width(), height], |area| {
        let chart = chart(&heading.draw(sheet, area)?, &x, &y, Grid::Vertical)?;
        let plot = chart.plotting_area();
        for (row, &(_, interval)) in effects.iter().enumerate() {
            let y = (row + 1) as f64;
            let color = if contains_zero(interval) { GREY } else { BLUE };
            let &SignedEffect { effect, low, high } = interval;
            plot.draw(&Rectangle::new([(0.0, y - 0.5 * BAR), (effect, y + 0.5 * BAR)], color.filled()))?;
            let pen = Pen::solid(BLACK, 1.0);
            pen.draw(plot, vec![(low, y), (high, y)])?;
            for end in [low, high] {
                pen.draw(plot, vec![(end, y - 0.5 * CAP), (end, y + 0.5 * CAP)])?;
            }
        }
        Pen::solid(BLACK, 1.0).draw(plot, vec![(0.0, y.range.start), (0.0, y.range.end)])
    })
}

fn contains_zero(effect: &SignedEffect) -> bool {
    effect.low <= 0.0 && effect.high >= 0.0
}
