//! Charts and their axes.

use crate::drawing::style::{Area, CHARACTER, DrawingError, LINE_HEIGHT, MARGIN, TEXT, X_AXIS, font, px};
use crate::text::number;
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
}

impl Axis {
    /// Makes an axis of numbers with at most `most` ticks at round values. An empty range is widened, also
    /// one that is empty up to rounding.
    pub(crate) fn numbers(range: Range<f64>, most: usize, label: impl Into<String>) -> Self {
        let size = range.start.abs().max(range.end.abs());
        let half = if range.end - range.start > 1e-9 * size { 0.0 } else { 1e-3 * size.max(1.0) };
        let range = range.start - half..range.end + half;
        let values = RangedCoordf64::from(range.clone()).key_points(BoldPoints(most));
        let step = values.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
        // Steps are 1, 2, 2.5 or 5 times a power of ten.
        let decimals = (0..12).find(|&d| is_whole(step * 10.0_f64.powi(d))).unwrap_or(3) as usize;
        let ticks = values.into_iter().map(|value| (value, number(value, decimals))).collect();
        Self { range, ticks, label: label.into() }
    }

    /// Makes an axis of names at 1, 2, ...
    pub(crate) fn names(names: impl Iterator<Item = String>, label: impl Into<String>) -> Self {
        let ticks: Vec<_> = names.enumerate().map(|(i, name)| ((i + 1) as f64, name)).collect();
        Self { range: 0.5..ticks.len() as f64 + 0.5, ticks, label: label.into() }
    }

    /// Width of the axis beside a chart [px].
    pub(crate) fn room(&self) -> f64 {
        let longest = self.ticks.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0);
        let label = if self.label.is_empty() { 0.0 } else { LINE_HEIGHT };
        12.0 + CHARACTER * TEXT * longest as f64 + label
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
