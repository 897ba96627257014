//! The RMS over two parameters: Fig. 4b and 4c of the paper.

use crate::error::ReportError;
use crate::style::{
    self, Area, Axis, DrawingError, GREY, Grid, HEIGHT, Heading, MARGIN, Pen, X_AXIS, number, px,
};
use cdpr_robot::Parameter;
use cdpr_study::{SurfaceResult, SurfaceSummary};
use plotters::prelude::*;

/// Room of the colour bar with its axis [px].
const COLOR_BAR: f64 = 96.0;
const COLORS: usize = 128;

/// Heat map of the RMS with contour lines at the ticks of its colour bar. A cell that failed is grey and struck through.
///
/// # Errors
/// [`ReportError::Empty`] if every cell failed, [`ReportError::Invalid`] for a grid that is none, an unknown parameter, or a
/// value that is not finite.
pub fn surface<E>(summary: &SurfaceSummary, result: &SurfaceResult<E>) -> Result<String, ReportError> {
    let map = Map::new(summary, result)?;
    let failed = map.rms.iter().filter(|rms| rms.is_none()).count();
    let key = [("failed".to_owned(), Pen::bar(GREY))];
    let heading = Heading {
        title: &summary.title,
        lines: &[format!(
            "RMS of the static deflection: min {} mm, max {} mm, nominal {} mm; {} grid points, {failed} failed",
            number(map.least, 4),
            number(map.greatest, 4),
            number(ReportError::finite("rms_mm.nominal", summary.rms_mm.nominal)?, 4),
            map.rms.len(),
        )],
        key: if failed == 0 { &[] } else { &key },
    };
    let (x, y) = (map.x.axis(), map.y.axis());
    style::figure(HEIGHT, |area| {
        let width = px(style::WIDTH - COLOR_BAR);
        let (left, right) = heading.draw(area)?.split_horizontally(width);
        let chart = style::chart(&left, &x, &y, Grid::None)?;
        map.draw(chart.plotting_area())?;
        map.draw_color_bar(&right)
    })
}

/// Label of a parameter's axis, and what turns SI units into the unit that it names.
pub(crate) fn axis_of(name: &str) -> Result<(String, f64), ReportError> {
    let parameter: Parameter =
        name.parse().map_err(|_| ReportError::invalid("parameters", &name, "a parameter of a robot"))?;
    Ok(match parameter {
        Parameter::YoungsModulus => ("Young's modulus E [GPa]".to_owned(), 1e-9),
        Parameter::LinearDensity => ("linear density \u{3c1} [kg/m]".to_owned(), 1.0),
        Parameter::Mass => ("mass of the platform m [kg]".to_owned(), 1.0),
        Parameter::AnchorPoint(..) => (format!("anchor point, {name} [m]"), 1.0),
        Parameter::ExitPoint(..) => (format!("exit point, {name} [m]"), 1.0),
        Parameter::CenterOfMass(_) => (format!("centre of mass, {name} [m]"), 1.0),
        Parameter::TensionOffset(_) => (format!("offset of the tension set-point, {name} [N]"), 1.0),
    })
}

/// One axis of the grid, in the unit that its label names.
struct Nodes {
    label: String,
    values: Vec<f64>,
}

impl Nodes {
    fn new(field: &str, name: &str, values: &[f64]) -> Result<Self, ReportError> {
        let (label, scale) = axis_of(name)?;
        let ascending = values.windows(2).all(|pair| pair[0] < pair[1]);
        if values.len() < 2 || !ascending || !(values[values.len() - 1] - values[0]).is_finite() {
            return Err(ReportError::invalid(field, &format!("{values:?}"), "two or more ascending values"));
        }
        Ok(Self { label, values: values.iter().map(|value| scale * value).collect() })
    }

    /// Edge between the cells of node `k - 1` and `k`: halfway between them; the cells at both ends stop at their nodes.
    fn edge(&self, k: usize) -> f64 {
        let last = self.values.len() - 1;
        0.5 * (self.values[k.saturating_sub(1)] + self.values[k.min(last)])
    }

    /// A pixel or two past that edge, but not past the last one.
    fn past_edge(&self, k: usize) -> f64 {
        let (first, last) = (self.edge(0), self.edge(self.values.len()));
        last.min(self.edge(k) + 4e-3 * (last - first))
    }

    fn axis(&self) -> Axis {
        Axis::numbers(self.edge(0)..self.edge(self.values.len()), 8, &self.label)
    }
}

struct Map {
    x: Nodes,
    y: Nodes,
    /// RMS [mm] of node i, j in place `i * y.len() + j`; none where it failed.
    rms: Vec<Option<f64>>,
    least: f64,
    greatest: f64,
    /// Axis of the colour bar.
    color_axis: Axis,
}

impl Map {
    fn new<E>(summary: &SurfaceSummary, result: &SurfaceResult<E>) -> Result<Self, ReportError> {
        let x = Nodes::new("x", &summary.parameters[0], &result.x)?;
        let y = Nodes::new("y", &summary.parameters[1], &result.y)?;
        if result.rms_mm.len() != x.values.len() * y.values.len() {
            return Err(ReportError::invalid("rms_mm", &result.rms_mm.len(), "one value a grid point"));
        }
        let rms: Vec<Option<f64>> = result.rms_mm.iter().map(|rms| rms.as_ref().ok().copied()).collect();
        let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
        for &value in rms.iter().flatten() {
            ReportError::finite("rms_mm", value)?;
            (least, greatest) = (least.min(value), greatest.max(value));
        }
        if least > greatest {
            return Err(ReportError::Empty { what: "every point of the surface failed" });
        }
        let color_axis = Axis::numbers(least..greatest, 9, "RMS [mm]");
        Ok(Self { x, y, rms, least, greatest, color_axis })
    }

    fn draw<C>(&self, plot: &DrawingArea<SVGBackend, C>) -> Result<(), DrawingError>
    where
        C: plotters::coord::CoordTranslate<From = (f64, f64)>,
    {
        let (columns, rows) = (self.x.values.len(), self.y.values.len());
        for i in 0..columns {
            for j in 0..rows {
                let rms = self.rms[i * rows + j];
                let from = (self.x.edge(i), self.y.edge(j));
                let to = (self.x.edge(i + 1), self.y.edge(j + 1));
                // Each cell reaches a pixel or two below the ones drawn after it, lest the white between them show.
                let below = (self.x.past_edge(i + 1), self.y.past_edge(j + 1));
                plot.draw(&Rectangle::new([from, below], rms.map_or(GREY, |rms| self.color(rms)).filled()))?;
                if rms.is_none() {
                    Pen::solid(BLACK, 0.5).draw(plot, vec![from, to])?;
                }
            }
        }
        for (level, _) in &self.color_axis.ticks {
            for segment in self.contour(*level) {
                Pen::solid(self.line_color(*level), 0.8).draw(plot, segment.to_vec())?;
            }
        }
        Ok(())
    }

    fn draw_color_bar(&self, area: &Area) -> Result<(), DrawingError> {
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
        for (level, _) in &axis.ticks {
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

    /// Place of a value on the colour bar, 0 to 1.
    fn place(&self, rms: f64) -> f64 {
        let range = &self.color_axis.range;
        ((rms - range.start) / (range.end - range.start)).clamp(0.0, 1.0)
    }

    fn color(&self, rms: f64) -> RGBColor {
        ViridisRGB::get_color(self.place(rms))
    }

    /// White on the dark half of viridis, black on the bright one; both by a hair, so that a page that swaps black and white for
    /// dark surroundings leaves lines on viridis as they are.
    fn line_color(&self, rms: f64) -> RGBColor {
        if self.place(rms) < 0.5 { RGBColor(254, 254, 254) } else { RGBColor(1, 1, 1) }
    }

    /// Segments of the line where the RMS, interpolated along the edges of the grid, is `level` (marching squares).
    fn contour(&self, level: f64) -> Vec<[(f64, f64); 2]> {
        let (x, y) = (&self.x.values, &self.y.values);
        let mut segments = Vec::new();
        for i in 0..x.len() - 1 {
            for j in 0..y.len() - 1 {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                let Some(heights) = corners
                    .iter()
                    .map(|&(i, j)| self.rms[i * y.len() + j].map(|rms| rms - level))
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
