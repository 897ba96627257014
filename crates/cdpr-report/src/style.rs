//! What all figures share: size, fonts, colours, heading, key, axes.

use crate::error::ReportError;
use plotters::coord::ranged1d::{BoldPoints, KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::coord::{CoordTranslate, Shift};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(crate) type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Axis, Axis>>;
pub(crate) type DrawingError = DrawingAreaErrorKind<std::io::Error>;

/// Width of a figure [px].
pub(crate) const WIDTH: f64 = 700.0;
/// Height of a figure of one chart [px].
pub(crate) const HEIGHT: f64 = 450.0;
/// Room of a horizontal axis with its label below a chart [px].
pub(crate) const X_AXIS: f64 = 42.0;
/// Margin around a figure [px].
pub(crate) const MARGIN: f64 = 14.0;

// M. Okabe, K. Ito, Color universal design (2008).
pub(crate) const ORANGE: RGBColor = RGBColor(0xE6, 0x9F, 0x00);
pub(crate) const GREEN: RGBColor = RGBColor(0x00, 0x9E, 0x73);
pub(crate) const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xB2);
pub(crate) const VERMILLION: RGBColor = RGBColor(0xD5, 0x5E, 0x00);
/// What could not be computed, or cannot be told from zero.
pub(crate) const GREY: RGBColor = RGBColor(0xB0, 0xB0, 0xB0);

const TITLE: f64 = 15.0;
pub(crate) const TEXT: f64 = 12.0;
/// Text of a key that is smaller is hard to read.
const SMALL: f64 = 9.0;
const LINE_HEIGHT: f64 = 20.0;
/// Line of an entry of a key, gap to its name, and both with the gap to the next entry [px].
const KEY_LINE: f64 = 24.0;
const KEY_GAP: f64 = 5.0;
const KEY_ENTRY: f64 = KEY_LINE + KEY_GAP + 12.0;
/// Mean width of a character over the size of its font, on the safe side: the fonts that will show the figure are unknown.
const CHARACTER: f64 = 0.58;
/// plotters rounds coordinates to integers: they count tenths of a pixel.
const UNITS: f64 = 10.0;

/// Pixels in the integers that plotters takes.
pub(crate) fn px(pixels: f64) -> i32 {
    (pixels * UNITS).round() as i32
}

/// A line's look.
#[derive(Clone, Copy)]
pub(crate) struct Pen {
    pub color: RGBColor,
    /// Width [px].
    pub width: f64,
    /// Length of a dash [px]; none for a solid line.
    pub dash: Option<f64>,
}

impl Pen {
    pub(crate) const fn solid(color: RGBColor, width: f64) -> Self {
        Self { color, width, dash: None }
    }

    /// What stands for filled bars in a key.
    pub(crate) const fn bar(color: RGBColor) -> Self {
        Self::solid(color, 9.0)
    }

    /// Draws a line through `points`.
    pub(crate) fn draw<C: CoordTranslate>(
        self,
        area: &DrawingArea<SVGBackend, C>,
        points: Vec<C::From>,
    ) -> Result<(), DrawingError>
    where
        C::From: Clone,
    {
        let style = self.color.stroke_width(px(self.width) as u32);
        match self.dash {
            None => area.draw(&PathElement::new(points, style)),
            Some(dash) => area.draw(&DashedPathElement::new(points, px(dash), px(0.7 * dash), style)),
        }
    }
}

/// Draws a figure of this height [px].
pub(crate) fn figure(
    height: f64,
    draw: impl FnOnce(&Area) -> Result<(), DrawingError>,
) -> Result<String, ReportError> {
    let (width_units, height_units) = (px(WIDTH), px(height));
    let mut svg = String::new();
    {
        let backend = SVGBackend::with_string(&mut svg, (width_units as u32, height_units as u32));
        let area = backend.into_drawing_area();
        let drawn = area.fill(&WHITE).and_then(|()| draw(&area)).and_then(|()| area.present());
        drawn.map_err(|error| ReportError::Drawing { reason: error.to_string() })?;
    }
    // The view box stays in tenths of a pixel; the size is in pixels.
    let drawn = format!("width=\"{width_units}\" height=\"{height_units}\"");
    Ok(svg.replacen(&drawn, &format!("width=\"{WIDTH}\" height=\"{height}\""), 1))
}

/// What stands above the charts.
pub(crate) struct Heading<'a> {
    pub title: &'a str,
    /// Lines below the title.
    pub lines: &'a [String],
    /// Names of the lines and bars; none for no key.
    pub key: &'a [(String, Pen)],
}

impl Heading<'_> {
    /// Height [px].
    pub(crate) fn height(&self) -> f64 {
        let rows = 1 + self.lines.len() + self.key_rows().count();
        MARGIN + LINE_HEIGHT * rows as f64 + 4.0
    }

    /// Draws the heading; what is left of the area.
    pub(crate) fn draw<'a>(&self, area: &Area<'a>) -> Result<Area<'a>, DrawingError> {
        let (head, rest) = area.split_vertically(px(self.height()));
        let mut y = MARGIN + 0.5 * LINE_HEIGHT;
        text(&head, self.title, TITLE, (MARGIN, y))?;
        for line in self.lines {
            y += LINE_HEIGHT;
            text(&head, line, TEXT, (MARGIN, y))?;
        }
        for row in self.key_rows() {
            y += LINE_HEIGHT;
            let size = key_size(row);
            let mut x = MARGIN;
            for (name, pen) in row {
                pen.draw(&head, vec![(px(x), px(y)), (px(x + KEY_LINE), px(y))])?;
                text(&head, name, size, (x + KEY_LINE + KEY_GAP, y))?;
                x += KEY_ENTRY + CHARACTER * size * name.chars().count() as f64;
            }
        }
        Ok(rest)
    }

    /// The key in one row, or in two where its text would be too small.
    fn key_rows(&self) -> impl Iterator<Item = &[(String, Pen)]> {
        let rows = if key_size(self.key) < SMALL { 2 } else { 1 };
        self.key.chunks(self.key.len().div_ceil(rows).max(1))
    }
}

/// Size of the text of a row of a key.
fn key_size(row: &[(String, Pen)]) -> f64 {
    let characters: usize = row.iter().map(|(name, _)| name.chars().count()).sum();
    let room = WIDTH - 2.0 * MARGIN - KEY_ENTRY * row.len() as f64;
    TEXT.min(room / (CHARACTER * characters as f64))
}

/// Writes text from (x, y) [px] to the right, centred on its height; smaller if it is too long.
pub(crate) fn text(area: &Area, text: &str, size: f64, (x, y): (f64, f64)) -> Result<(), DrawingError> {
    let room = (WIDTH - MARGIN - x) / (CHARACTER * text.chars().count().max(1) as f64);
    area.draw_text(text, &font(size.min(room)).pos(Pos::new(HPos::Left, VPos::Center)), (px(x), px(y)))
}

/// Sans-serif of this size [px].
pub(crate) fn font(size: f64) -> TextStyle<'static> {
    // The SVG backend divides the size by 1.24.
    ("sans-serif", 1.24 * size * UNITS).into_font().color(&BLACK)
}

/// Lines across a chart at the ticks of one axis.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Grid {
    None,
    /// At the ticks of the vertical axis.
    Horizontal,
    /// At the ticks of the horizontal axis.
    Vertical,
}

/// A chart with both axes drawn, ready for its data.
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

/// An axis: its range, what stands at which tick, and its label.
#[derive(Clone)]
pub(crate) struct Axis {
    pub range: Range<f64>,
    pub ticks: Vec<(f64, String)>,
    pub label: String,
}

impl Axis {
    /// An axis of numbers, with at most `most` ticks at round values. A range that is none but for rounding is widened.
    pub(crate) fn numbers(range: Range<f64>, most: usize, label: impl Into<String>) -> Self {
        let size = range.start.abs().max(range.end.abs());
        let half = if range.end - range.start > 1e-9 * size { 0.0 } else { 1e-3 * size.max(1.0) };
        let range = range.start - half..range.end + half;
        let places = RangedCoordf64::from(range.clone()).key_points(BoldPoints(most));
        let step = places.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
        // Steps are 1, 2, 2.5 or 5 times a power of ten.
        let decimals = (0..12).find(|&d| is_whole(step * 10.0_f64.powi(d))).unwrap_or(3) as usize;
        let ticks = places.into_iter().map(|place| (place, number(place, decimals))).collect();
        Self { range, ticks, label: label.into() }
    }

    /// An axis of names at 1, 2, ...
    pub(crate) fn names(names: impl Iterator<Item = String>, label: impl Into<String>) -> Self {
        let ticks: Vec<_> = names.enumerate().map(|(i, name)| ((i + 1) as f64, name)).collect();
        Self { range: 0.5..ticks.len() as f64 + 0.5, ticks, label: label.into() }
    }

    /// Width that the axis needs beside a chart [px].
    pub(crate) fn room(&self) -> f64 {
        let longest = self.ticks.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0);
        let label = if self.label.is_empty() { 0.0 } else { LINE_HEIGHT };
        12.0 + CHARACTER * TEXT * longest as f64 + label
    }
}

/// The linear scale of plotters with ticks and their texts as given.
impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        RangedCoordf64::from(self.range.clone()).map(value, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.iter().map(|(place, _)| *place).collect()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, place: &f64) -> String {
        self.ticks.iter().find(|(tick, _)| tick == place).map(|(_, text)| text.clone()).unwrap_or_default()
    }
}

/// The number with so many decimals, with a true minus sign.
pub(crate) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.contains(|c: char| ('1'..='9').contains(&c)) => format!("\u{2212}{digits}"),
        Some(zero) => zero.to_owned(),
        None => text,
    }
}

fn is_whole(value: f64) -> bool {
    (value - value.round()).abs() < 1e-6 * value.abs().max(1e-3)
}
