//! Map in colour of a value over a grid of two quantities, with contour lines and a colour bar.

use crate::drawing::axis::{Axis, extent};
use crate::drawing::decades::Decades;
use crate::drawing::style::{self, Area, DrawingError, GREY, MARGIN, Pen, X_AXIS, px};
use crate::error::ReportError;
use crate::text::digits;
use plotters::prelude::*;
use std::ops::Range;

/// Width of the colours of a colour bar [px].
const COLOR_BAR: f64 = 26.0;
const COLORS: usize = 128;
/// Values that differ by a smaller share of their size are equal.
const EVEN: f64 = 1e-9;
/// Least distance between hatching lines along an axis [px].
const HATCH: f64 = 8.0;

/// Nodes of the grid along one axis, in the unit of its label.
pub(crate) struct Nodes {
    pub(crate) label: String,
    values: Vec<f64>,
}

impl Nodes {
    /// Checks that there are two or more ascending values.
    pub(crate) fn new(field: &str, label: String, values: Vec<f64>) -> Result<Self, ReportError> {
        let ascending = values.windows(2).all(|pair| pair[0] < pair[1]);
        if values.len() < 2 || !ascending || !(values[values.len() - 1] - values[0]).is_finite() {
            return Err(ReportError::invalid(field, &format!("{values:?}"), "two or more ascending values"));
        }
        Ok(Self { label, values })
    }

    /// Edge between the cells of nodes `k - 1` and `k`, halfway between them. The outer cells end at their
    /// nodes.
    fn edge(&self, k: usize) -> f64 {
        let last = self.values.len() - 1;
        0.5 * (self.values[k.saturating_sub(1)] + self.values[k.min(last)])
    }

    /// One or two pixels beyond that edge, but not beyond the last one.
    fn past_edge(&self, k: usize) -> f64 {
        let (first, last) = (self.edge(0), self.edge(self.values.len()));
        last.min(self.edge(k) + 4e-3 * (last - first))
    }

    /// Range from the first to the last value.
    pub(crate) fn range(&self) -> Range<f64> {
        self.edge(0)..self.edge(self.values.len())
    }

    pub(crate) fn axis(&self) -> Axis {
        Axis::numbers(self.range(), 8, &self.label)
    }
}

/// Cells of a grid. The cell of node i, j has index `i * y.len() + j`.
pub(crate) struct Cells {
    pub(crate) x: Nodes,
    pub(crate) y: Nodes,
}

/// Values over a grid, which colours show.
pub(crate) struct ColorMap {
    pub(crate) cells: Cells,
    /// Value of each cell, or `None` for a cell without a value.
    pub(crate) values: Vec<Option<f64>>,
    pub(crate) least: f64,
    pub(crate) greatest: f64,
    /// Whether colours are by powers of ten.
    pub(crate) by_decades: bool,
    /// Whether all values are equal, up to rounding: one colour and one tick.
    is_even: bool,
    /// Axis of the colour bar.
    color_axis: Axis,
}

impl Cells {
    pub(crate) fn count(&self) -> usize {
        self.x.values.len() * self.y.values.len()
    }

    /// Draws all cells. Those without a colour are grey.
    pub(crate) fn draw<C>(
        &self,
        plot: &DrawingArea<SVGBackend, C>,
        color: impl Fn(usize) -> Option<RGBColor>,
    ) -> Result<(), DrawingError>
    where
        C: plotters::coord::CoordTranslate<From = (f64, f64)>,
    {
        let rows = self.y.values.len();
        for cell in 0..self.count() {
            let (i, j) = (cell / rows, cell % rows);
            let from = (self.x.edge(i), self.y.edge(j));
            // Each cell overlaps those drawn after it by one or two pixels, so that no white shows between
            // them.
            let below = (self.x.past_edge(i + 1), self.y.past_edge(j + 1));
            plot.draw(&Rectangle::new([from, below], color(cell).unwrap_or(GREY).filled()))?;
        }
        Ok(())
    }

    /// Hatches the cells for which `hatched` holds, by diagonals at a distance of a few pixels.
    pub(crate) fn hatch<C>(
        &self,
        plot: &DrawingArea<SVGBackend, C>,
        hatched: impl Fn(usize) -> bool,
    ) -> Result<(), DrawingError>
    where
        C: plotters::coord::CoordTranslate<From = (f64, f64)>,
    {
        let (columns, rows) = (self.x.values.len(), self.y.values.len());
        let (width, height) = plot.dim_in_pixel();
        let among = |count: usize, size: u32| (f64::from(px(HATCH)) * count as f64 / f64::from(size)).ceil();
        let every = among(columns, width).max(among(rows, height)) as usize;
        for cell in (0..columns * rows).filter(|cell| hatched(*cell)) {
            let (i, j) = (cell / rows, cell % rows);
            if i % every == j % every {
                let from = (self.x.edge(i), self.y.edge(j));
                let to = (self.x.edge(i + 1), self.y.edge(j + 1));
                Pen::solid(BLACK, 0.5).draw(plot, vec![from, to])?;
            }
        }
        Ok(())
    }
}

impl ColorMap {
    /// Makes a map. `field` names the values in errors, and `label` names them on the colour bar.
    pub(crate) fn new(
        cells: Cells,
        values: Vec<Option<f64>>,
        field: &str,
        label: &str,
    ) -> Result<Self, ReportError> {
        if values.len() != cells.count() {
            return Err(ReportError::invalid(field, &values.len(), "one value a grid point"));
        }
        values.iter().flatten().try_for_each(|value| ReportError::finite(field, *value).map(|_| ()))?;
        let Range { start: least, end: greatest } = extent(values.iter().copied().flatten());
        if least > greatest {
            return Err(ReportError::Empty { what: "no point of the grid has a value" });
        }
        let is_even = greatest - least <= EVEN * least.abs().max(greatest.abs());
        let mut color_axis = Axis::numbers(least..greatest, 9, label);
        if is_even {
            let middle = 0.5 * (least + greatest);
            color_axis = Axis::given(color_axis.range, vec![(middle, digits(middle, 4))], label);
        }
        Ok(Self { cells, values, least, greatest, by_decades: false, is_even, color_axis })
    }

    /// The same with colours by powers of ten, if the values range over them.
    pub(crate) fn by_decades(mut self) -> Self {
        let Some(scale) = Decades::of(self.values.iter().copied().flatten()) else { return self };
        self.values.iter_mut().flatten().for_each(|value| *value = scale.place(*value));
        let range = scale.place(self.least)..scale.place(self.greatest);
        let ticks = scale.ticks(self.least..self.greatest);
        self.color_axis = Axis::given(range, ticks, self.color_axis.label);
        self.by_decades = true;
        self
    }

    /// Width of the colour bar with its axis [px].
    pub(crate) fn bar_width(&self) -> f64 {
        COLOR_BAR + self.color_axis.room() + MARGIN
    }

    /// Draws all cells, and contour lines at the ticks of the colour bar. A cell without a value is grey.
    pub(crate) fn draw<C>(&self, plot: &DrawingArea<SVGBackend, C>) -> Result<(), DrawingError>
    where
        C: plotters::coord::CoordTranslate<From = (f64, f64)>,
    {
        self.cells.draw(plot, |cell| self.values[cell].map(|value| self.color(value)))?;
        for (level, _) in self.levels() {
            for segment in self.contour(*level) {
                Pen::solid(self.line_color(*level), 0.8).draw(plot, segment.to_vec())?;
            }
        }
        Ok(())
    }

    /// Draws the colour bar.
    pub(crate) fn draw_color_bar(&self, area: &Area) -> Result<(), DrawingError> {
        let axis = &self.color_axis;
        let mut chart = ChartBuilder::on(area)
            .margin_top(px(4.0))
            .margin_right(px(MARGIN))
            .margin_bottom(px(MARGIN + X_AXIS))
            .right_y_label_area_size(px(axis.room()))
            .build_cartesian_2d(0.0..1.0, axis.clone())?;
        let (low, high) = (axis.range.start, axis.range.end);
        let value = |k: usize| low + (high - low) * k as f64 / COLORS as f64;
        for k in 0..COLORS {
            let color = self.color(0.5 * (value(k) + value(k + 1)));
            chart.plotting_area().draw(&Rectangle::new([(0.0, value(k)), (1.0, high)], color.filled()))?;
        }
        for (level, _) in self.levels() {
            Pen::solid(self.line_color(*level), 0.8)
                .draw(chart.plotting_area(), vec![(0.0, *level), (1.0, *level)])?;
        }
        chart
            .configure_mesh()
            .disable_mesh()
            .y_desc(&axis.label)
            .label_style(style::font(style::TEXT))
            .axis_desc_style(style::font(style::TEXT))
            .set_all_tick_mark_size(px(4.0))
            .axis_style(BLACK.stroke_width(px(1.0) as u32))
            .draw()
    }

    /// Levels of the contour lines with their texts; values that are equal have none.
    fn levels(&self) -> &[(f64, String)] {
        if self.is_even { &[] } else { &self.color_axis.ticks }
    }

    /// Position of a value on the colour bar, 0 to 1; that of its middle where all values are equal.
    fn position(&self, value: f64) -> f64 {
        if self.is_even {
            return 0.5;
        }
        let range = &self.color_axis.range;
        ((value - range.start) / (range.end - range.start)).clamp(0.0, 1.0)
    }

    fn color(&self, value: f64) -> RGBColor {
        ViridisRGB::get_color(self.position(value))
    }

    /// Colour of a contour line: white on the dark half of viridis, black on the bright half.
    ///
    /// Both differ by one unit from pure white and black. A dark page swaps these two, but leaves contour
    /// lines unchanged.
    fn line_color(&self, value: f64) -> RGBColor {
        if self.position(value) < 0.5 { RGBColor(254, 254, 254) } else { RGBColor(1, 1, 1) }
    }

    /// Segments of the contour line at `level`, by marching squares: values are interpolated along the edges
    /// of the grid.
    fn contour(&self, level: f64) -> Vec<[(f64, f64); 2]> {
        let (x, y) = (&self.cells.x.values, &self.cells.y.values);
        let mut segments = Vec::new();
        for i in 0..x.len() - 1 {
            for j in 0..y.len() - 1 {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                let Some(heights) = corners
                    .iter()
                    .map(|&(i, j)| self.values[i * y.len() + j].map(|value| value - level))
                    .collect::<Option<Vec<f64>>>()
                else {
                    continue;
                };
                let crossings: Vec<(f64, f64)> = (0..4)
                    .filter_map(|k| {
                        let next = (k + 1) % 4;
                        let (h, h_next) = (heights[k], heights[next]);
                        let ((i, j), (i_next, j_next)) = (corners[k], corners[next]);
                        let t = h / (h - h_next);
                        ((h < 0.0) != (h_next < 0.0))
                            .then(|| (x[i] + t * (x[i_next] - x[i]), y[j] + t * (y[j_next] - y[j])))
                    })
                    .collect();
                segments.extend(crossings.chunks_exact(2).map(|ends| [ends[0], ends[1]]));
            }
        }
        segments
    }
}
