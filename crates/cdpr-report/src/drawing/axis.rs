//! Charts and their axes.

use crate::drawing::style::{
    Area, CHARACTER, DrawingError, LINE_HEIGHT, MARGIN, TEXT, X_AXIS, font, px, width_of,
};
use crate::text::{number, superscript};
use plotters::coord::ranged1d::{BoldPoints, KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::ops::Range;

pub(crate) type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Axis, Axis>>;

/// Grid lines of a chart, at the ticks of one axis.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Grid {
    None,
    /// At the ticks of the vertical axis.
    Horizontal,
    /// At the ticks of the horizontal axis.
    Vertical,
}

/// Draws both axes of a chart and returns it, ready for its data.
pub(crate) fn chart<'a>(area: &Area<'a>, x: &Axis, y: &Axis, grid: Grid) -> Result<Chart<'a>, DrawingError> {
    let x = &x.fitted(width_of(area) - y.room() - 2.0 * MARGIN);
    let mut chart = ChartBuilder::on(area)
        .margin(px(MARGIN))
        .margin_top(px(4.0))
        .x_label_area_size(px(if x.label.is_empty() { X_AXIS - LINE_HEIGHT } else { X_AXIS }))
        .y_label_area_size(px(y.room()))
        .build_cartesian_2d(x.clone(), y.clone())?;
    let mut mesh = chart.configure_mesh();
    mesh.x_desc(&x.label)
        .y_desc(&y.label)
        .label_style(font(TEXT))
        .axis_desc_style(font(TEXT))
        .set_all_tick_mark_size(px(4.0))
        .axis_style(BLACK.stroke_width(px(1.0) as u32))
        .bold_line_style(RGBColor(0xE0, 0xE0, 0xE0).stroke_width(px(0.8) as u32))
        .light_line_style(TRANSPARENT);
    if grid != Grid::Vertical {
        mesh.disable_x_mesh();
    }
    if grid != Grid::Horizontal {
        mesh.disable_y_mesh();
    }
    mesh.draw()?;
    Ok(chart)
}

/// Axis with its range, its ticks with their texts, and its label.
#[derive(Clone)]
pub(crate) struct Axis {
    pub range: Range<f64>,
    pub ticks: Vec<(f64, String)>,
    pub label: String,
    /// Most ticks at round values, and the power of ten of the label; `None` for ticks that are given.
    round: Option<(usize, i32)>,
}

/// Sizes beyond which an axis has a power of ten in its label.
const PLAIN: Range<f64> = 1e-3..1e7;
/// Room between the texts of ticks below a chart [px].
const BETWEEN: f64 = 10.0;

impl Axis {
    /// Makes an axis of numbers with at most `most` ticks at round values. An empty range is widened, also
    /// one that is empty up to rounding. Numbers that are very small or very large have a common power of ten,
    /// which is in the label.
    pub(crate) fn numbers(range: Range<f64>, most: usize, label: impl Into<String>) -> Self {
        let size = range.start.abs().max(range.end.abs());
        let half = match range.end - range.start > 1e-9 * size {
            true => 0.0,
            false if size > 0.0 => 1e-3 * size,
            false => 0.5,
        };
        let range = range.start - half..range.end + half;
        let size = range.start.abs().max(range.end.abs());
        let power = if PLAIN.contains(&size) { 0 } else { 3 * (size.log10() / 3.0).floor() as i32 };
        let label = if power == 0 { label.into() } else { with_power(&label.into(), power) };
        let ticks = round_ticks(&range, most, power);
        Self { range, ticks, label, round: Some((most, power)) }
    }

    /// Makes an axis with these ticks.
    pub(crate) fn given(range: Range<f64>, ticks: Vec<(f64, String)>, label: impl Into<String>) -> Self {
        Self { range, ticks, label: label.into(), round: None }
    }

    /// Makes an axis of names at 1, 2, ...
    pub(crate) fn names(names: impl Iterator<Item = String>, label: impl Into<String>) -> Self {
        let ticks: Vec<_> = names.enumerate().map(|(i, name)| ((i + 1) as f64, name)).collect();
        Self::given(0.5..ticks.len() as f64 + 0.5, ticks, label)
    }

    /// The same with as many of its round values as have room for their texts below a chart of this width
    /// [px].
    fn fitted(&self, width: f64) -> Self {
        let mut fitted = self.clone();
        let Some((most, power)) = self.round else { return fitted };
        let room = |(_, text): &(f64, String)| BETWEEN + CHARACTER * TEXT * text.chars().count() as f64;
        for most in (2..most).rev() {
            if fitted.ticks.iter().map(room).sum::<f64>() <= width {
                break;
            }
            fitted.ticks = round_ticks(&self.range, most, power);
        }
        fitted
    }

    /// Width of the axis beside a chart [px].
    pub(crate) fn room(&self) -> f64 {
        let longest = self.ticks.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0);
        let label = if self.label.is_empty() { 0.0 } else { LINE_HEIGHT };
        12.0 + CHARACTER * TEXT * longest as f64 + label
    }
}

/// At most this number of round values with their texts, in units of a power of ten.
fn round_ticks(range: &Range<f64>, most: usize, power: i32) -> Vec<(f64, String)> {
    let unit = 10.0_f64.powi(power);
    let values = RangedCoordf64::from(range.start / unit..range.end / unit).key_points(BoldPoints(most));
    let step = values.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    // Of one tick the value has the decimals.
    let step = if step.is_finite() { step } else { values.first().copied().unwrap_or(0.0) };
    // Steps are 1, 2, 2.5 or 5 times a power of ten.
    let decimals = (0..12).find(|&d| is_whole(step * 10.0_f64.powi(d))).unwrap_or(3) as usize;
    values.into_iter().map(|value| (value * unit, number(value, decimals))).collect()
}

/// A label whose unit has a power of ten, as in `payload [10⁻⁶ kg]`.
fn with_power(label: &str, power: i32) -> String {
    let power = format!("10{}", superscript(power));
    match label.rsplit_once('[') {
        Some((name, unit)) if unit != "-]" => format!("{name}[{power} {unit}"),
        Some((name, _)) => format!("{name}[{power}]"),
        None => format!("{label} [{power}]"),
    }
}

/// The linear scale of plotters, with the ticks of the axis and their texts.
impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        RangedCoordf64::from(self.range.clone()).map(value, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.iter().map(|(value, _)| *value).collect()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        self.ticks.iter().find(|(tick, _)| tick == value).map(|(_, text)| text.clone()).unwrap_or_default()
    }
}

/// Range from the least to the greatest of some values.
pub(crate) fn extent(values: impl Iterator<Item = f64>) -> Range<f64> {
    values.fold(f64::INFINITY..f64::NEG_INFINITY, |range, value| range.start.min(value)..range.end.max(value))
}

/// Whether a value is whole up to rounding.
fn is_whole(value: f64) -> bool {
    (value - value.round()).abs() < 1e-6 * value.abs().max(1e-3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn very_small_and_large_numbers_have_a_common_power_in_the_label() {
        let axis = Axis::numbers(0.0..1.7e-5, 9, "payload [kg]");
        let texts: Vec<&str> = axis.ticks.iter().map(|(_, text)| text.as_str()).collect();
        assert_eq!(axis.label, "payload [10\u{207b}\u{2076} kg]");
        assert!(texts.contains(&"10") && texts.iter().all(|text| text.len() <= 2), "{texts:?}");
        assert!(axis.ticks.iter().all(|(value, _)| axis.range.contains(value)));
        assert_eq!(Axis::numbers(0.0..3e7, 5, "ratio [-]").label, "ratio [10\u{2076}]");
        assert_eq!(Axis::numbers(0.0..0.5, 5, "payload [kg]").label, "payload [kg]");
    }

    #[test]
    fn a_narrow_chart_has_fewer_ticks() {
        let axis = Axis::numbers(0.0..12_345.0, 9, "tension [N]");
        let (broad, narrow) = (axis.fitted(600.0), axis.fitted(150.0));
        assert_eq!(broad.ticks.len(), axis.ticks.len());
        assert!(narrow.ticks.len() < axis.ticks.len() && narrow.ticks.len() > 1, "{}", narrow.ticks.len());
    }
}
