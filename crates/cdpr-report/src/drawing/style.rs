//! Style of all figures: size, fonts, colours, lines.

use crate::drawing::compact::compact;
use crate::error::ReportError;
use cdpr_robot::shown_lines;
use plotters::coord::{CoordTranslate, Shift};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(crate) type DrawingError = DrawingAreaErrorKind<std::io::Error>;

/// Greatest height of a figure of one chart [px].
pub(crate) const HEIGHT: f64 = 450.0;
/// Height of a horizontal axis with its label below a chart [px].
pub(crate) const X_AXIS: f64 = 42.0;
/// Margin around a figure [px].
pub(crate) const MARGIN: f64 = 14.0;

// Colours of M. Okabe, K. Ito, *Color universal design* (2008).
pub(crate) const ORANGE: RGBColor = RGBColor(0xE6, 0x9F, 0x00);
pub(crate) const GREEN: RGBColor = RGBColor(0x00, 0x9E, 0x73);
pub(crate) const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xB2);
pub(crate) const VERMILLION: RGBColor = RGBColor(0xD5, 0x5E, 0x00);
/// Colour of values that could not be computed, or whose interval contains zero.
pub(crate) const GREY: RGBColor = RGBColor(0xB0, 0xB0, 0xB0);

/// Size of the letters [px].
pub(crate) const TEXT: f64 = 12.0;
/// Size of the smallest letters [px], which have 7 points where the others have 8.
pub(crate) const SMALL: f64 = 10.5;
pub(crate) const LINE_HEIGHT: f64 = 20.0;
/// Mean width of a character over the size of its font. It is an upper estimate, because the font of the
/// reader is unknown.
pub(crate) const CHARACTER: f64 = 0.58;
/// The font of all texts of a figure.
const FONT: &str = "font-family=\"sans-serif\"";
/// Units per pixel. plotters rounds coordinates to integers, which therefore count tenths of a pixel.
const UNITS: f64 = 10.0;

/// Converts pixels to the integers that plotters takes.
pub(crate) fn px(pixels: f64) -> i32 {
    (pixels * UNITS).round() as i32
}

/// Converts a position in pixels to the integers that plotters takes.
pub(crate) fn pixel((x, y): (f64, f64)) -> (i32, i32) {
    (px(x), px(y))
}

/// Colour, width and dashes of a line.
#[derive(Clone, Copy)]
pub(crate) struct Pen {
    pub color: RGBColor,
    /// Width [px].
    pub width: f64,
    /// Length of a dash [px], or `None` for a solid line.
    pub dash: Option<f64>,
}

impl Pen {
    pub(crate) const fn solid(color: RGBColor, width: f64) -> Self {
        Self { color, width, dash: None }
    }

    /// Pen that stands for filled bars in a key.
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

/// Draws a figure of this width and height [px] and returns its SVG text, in which no character of a name is obeyed.
pub(crate) fn figure(
    [width, height]: [f64; 2],
    draw: impl FnOnce(&Area) -> Result<(), DrawingError>,
) -> Result<String, ReportError> {
    let (width_units, height_units) = (px(width), px(height));
    let mut svg = String::new();
    {
        let backend = SVGBackend::with_string(&mut svg, (width_units as u32, height_units as u32));
        let area = backend.into_drawing_area();
        let drawn = area.fill(&WHITE).and_then(|()| draw(&area)).and_then(|()| area.present());
        drawn.map_err(|error| ReportError::Drawing { reason: error.to_string() })?;
    }
    // The view box stays in tenths of a pixel, but the size is in pixels.
    let drawn = format!("width=\"{width_units}\" height=\"{height_units}\"");
    // What is so without being said, a fifth of a figure; in texts these marks are escaped.
    let mut svg = shown_lines(&svg).replace(" opacity=\"1\"", "").replace(" stroke=\"none\"/>", "/>");
    svg = svg.replace(&format!(" {FONT}"), "");
    let size = format!("width=\"{width}\" height=\"{height}\" {FONT}");
    Ok(compact(&svg.replacen(&drawn, &size, 1)))
}

/// Width of an area [px].
pub(crate) fn width_of(area: &Area) -> f64 {
    f64::from(area.dim_in_pixel().0) / UNITS
}

/// Writes text from (x, y) [px] to the right, centred on its height. Text that is too long is made smaller.
pub(crate) fn text(area: &Area, text: &str, size: f64, (x, y): (f64, f64)) -> Result<(), DrawingError> {
    let room = (width_of(area) - MARGIN - x) / (CHARACTER * text.chars().count().max(1) as f64);
    area.draw_text(text, &font(size.min(room)).pos(Pos::new(HPos::Left, VPos::Center)), (px(x), px(y)))
}

/// Sans-serif font of this size [px].
pub(crate) fn font(size: f64) -> TextStyle<'static> {
    // The SVG backend divides the size by 1.24.
    ("sans-serif", 1.24 * size * UNITS).into_font().color(&BLACK)
}
