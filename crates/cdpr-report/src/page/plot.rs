//! A plot of a page: a frame with numbers on both axes, in the colours that the page changes in the dark.

use crate::drawing::axis::Axis;
use maud::html;
use std::fmt::{Arguments, Write};
use std::ops::Range;

/// Blue and vermillion of Okabe and Ito, black, white and the grid, as all figures have them.
pub(crate) const BLUE: &str = "#0072B2";
pub(crate) const RED: &str = "#D55E00";
pub(crate) const BLACK: &str = "#000000";
const WHITE: &str = "#FFFFFF";
const GRID: &str = "#E0E0E0";

/// Room for the numbers and names of the axes [px]: at the left, at the right, above, below.
const ROOM: [f64; 4] = [64.0, 14.0, 8.0, 42.0];

/// Most numbers on an axis.
const TICKS: usize = 6;

/// A plot that is being drawn.
pub(crate) struct Plot {
    svg: String,
    size: [f64; 2],
    x: Axis,
    y: Axis,
}

impl Plot {
    /// A plot without data. The size of its frame is in pixels; a quantity is its name with its unit, and its
    /// range, which is widened a little, so that no mark is cut.
    pub(crate) fn new(size: [f64; 2], x: (&str, Range<f64>), y: (&str, Range<f64>)) -> Self {
        let axis = |(name, range): (&str, Range<f64>)| {
            let pad = 0.02 * (range.end - range.start);
            Axis::numbers(range.start - pad..range.end + pad, TICKS, name)
        };
        let mut plot = Self { svg: String::new(), size, x: axis(x), y: axis(y) };
        plot.open();
        plot
    }

    /// Opens the drawing with its grid and its axes.
    fn open(&mut self) {
        let [left, right, top, below] = ROOM;
        let [width, height] = [left + self.size[0] + right, top + self.size[1] + below];
        let (end, bottom) = (left + self.size[0], top + self.size[1]);
        self.add(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             font-family=\"sans-serif\" font-size=\"12\"><rect width=\"{width}\" height=\"{height}\" \
             fill=\"{WHITE}\"/>"
        ));
        for (value, text) in self.x.ticks.clone() {
            let x = self.x(value);
            self.line([x, top, x, bottom], GRID);
            self.text([x, bottom + 16.0], "middle", "", &text);
        }
        for (value, text) in self.y.ticks.clone() {
            let y = self.y(value);
            self.line([left, y, end, y], GRID);
            self.text([left - 6.0, y + 4.0], "end", "", &text);
        }
        self.line([left, bottom, end, bottom], BLACK);
        self.line([left, top, left, bottom], BLACK);
        let (x, y) = (self.x.label.clone(), self.y.label.clone());
        self.text([0.5 * (left + end), bottom + 35.0], "middle", "", &x);
        let middle = 0.5 * (top + bottom);
        self.text([14.0, middle], "middle", &format!(" transform=\"rotate(-90 14 {middle:.1})\""), &y);
    }

    /// Where a value is across the drawing [px].
    pub(crate) fn x(&self, value: f64) -> f64 {
        let Range { start, end } = self.x.range;
        ROOM[0] + self.size[0] * (value - start) / (end - start)
    }

    /// Where a value is down the drawing [px].
    pub(crate) fn y(&self, value: f64) -> f64 {
        let Range { start, end } = self.y.range;
        ROOM[2] + self.size[1] * (end - value) / (end - start)
    }

    /// A straight line between two places [px].
    pub(crate) fn line(&mut self, [x1, y1, x2, y2]: [f64; 4], color: &str) {
        self.add(format_args!(
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{color}\"/>"
        ));
    }

    fn text(&mut self, [x, y]: [f64; 2], anchor: &str, more: &str, text: &str) {
        let text = html! { (text) }.0;
        self.add(format_args!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"{BLACK}\"{more}>{text}</text>"
        ));
    }

    /// A part of the drawing.
    pub(crate) fn add(&mut self, part: Arguments) {
        // Writing to a string cannot fail.
        let _ = self.svg.write_fmt(part);
    }

    /// The drawing as SVG text.
    pub(crate) fn finish(self) -> String {
        self.svg + "</svg>"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_has_its_values_within_its_axes_and_their_names_as_text() {
        let plot = Plot::new([100.0, 50.0], ("a<b [m]", 1.0..3.0), ("y", -2.0..2.0));
        let [left, _, top, _] = ROOM;
        for value in [1.0, 2.0, 3.0] {
            assert!(plot.x(value) > left && plot.x(value) < left + 100.0, "{value}");
        }
        assert!(plot.y(2.0) > top && plot.y(2.0) < plot.y(-2.0) && plot.y(-2.0) < top + 50.0);
        assert!((plot.x(2.0) - left - 50.0).abs() < 1e-9);
        let svg = plot.finish();
        assert!(svg.contains(">a&lt;b [m]<") && svg.contains(">2<") && svg.contains("rotate(-90"));
    }
}
