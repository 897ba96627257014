//! Planes of positions in the base frame, and the maps over them.

use crate::drawing::axis::{Axis, Grid as Lines, chart, extent};
use crate::drawing::color_map::{Cells, ColorMap, Nodes};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{self, DrawingError, GREY, MARGIN, ORANGE, Pen, VERMILLION, X_AXIS, px};
use crate::error::ReportError;
use cdpr_assess::Boundary;
use cdpr_robot::{Axis as Direction, Robot, Vector3, frame};
use cdpr_study::Grid;
use plotters::prelude::*;
use std::ops::Range;

/// Margin around a map for the frame, as a share of its extent.
const ROOM: f64 = 0.04;
/// Least and greatest height of a map [px]. Between them both axes have the same scale.
const HEIGHTS: Range<f64> = 160.0..760.0;
/// Pen of the rectangle around the exit points.
const FRAME: Pen = Pen { color: VERMILLION, width: 1.5, dash: Some(6.0) };

/// Pen of the boundary, and that below it, which sets it off from dark colours. As contour lines, both differ
/// from pure black and white, which a dark page swaps.
const BOUNDARY: [Pen; 2] = [Pen::solid(RGBColor(254, 254, 254), 3.6), Pen::solid(RGBColor(1, 1, 1), 1.8)];

/// A line through places of the plane [m].
type Line = Vec<(f64, f64)>;

/// Plane of a grid of positions.
pub(crate) struct Plane {
    normal: Direction,
    /// Index of the plane along its normal, if the grid is a box.
    pub(crate) layer: Option<usize>,
    /// Coordinate of the plane along its normal [m].
    coordinate: f64,
    /// Axes of the plane with the coordinates of the positions [m].
    axes: [(Direction, Vec<f64>); 2],
    /// Indices of its positions in the grid. The second axis runs faster.
    pub(crate) positions: Vec<usize>,
    /// Lines of the boundary [m], and what it is called.
    boundary: Option<(Vec<Line>, &'static str)>,
}

/// Content of a map.
pub(crate) enum Paint {
    /// Values, with a colour bar.
    Values(ColorMap),
    /// One colour per cell, which the key explains.
    Colors(Cells, Vec<Option<RGBColor>>),
}

impl Plane {
    /// Planes of a grid: the grid itself if it is a plane, or the layers of a box from below. A line has
    /// none.
    pub(crate) fn of(grid: &Grid) -> Vec<Self> {
        let points = |axis| grid.axis(axis).points;
        let all = [Direction::X, Direction::Y, Direction::Z];
        let normal = match (grid.normal(), all.iter().all(|axis| points(*axis) > 1)) {
            (Some(normal), _) => normal,
            (None, true) => Direction::Z,
            (None, false) => return Vec::new(),
        };
        let [u, v] = match normal {
            Direction::X => [Direction::Y, Direction::Z],
            Direction::Y => [Direction::X, Direction::Z],
            Direction::Z => [Direction::X, Direction::Y],
        };
        // Difference between the indices of neighbours along an axis: z runs fastest, x slowest.
        let step = |axis| match axis {
            Direction::X => points(Direction::Y) * points(Direction::Z),
            Direction::Y => points(Direction::Z),
            Direction::Z => 1,
        };
        let layer = |(layer, coordinate): (usize, f64)| {
            let row =
                |i: usize| (0..points(v)).map(move |j| i * step(u) + j * step(v) + layer * step(normal));
            Self {
                normal,
                layer: (points(normal) > 1).then_some(layer),
                coordinate,
                axes: [u, v].map(|axis| (axis, grid.axis(axis).coordinates())),
                positions: (0..points(u)).flat_map(row).collect(),
                boundary: None,
            }
        };
        grid.axis(normal).coordinates().into_iter().enumerate().map(layer).collect()
    }

    /// The same with what a boundary of this name has in the plane.
    pub(crate) fn with_boundary(self, boundary: &Boundary, name: &'static str) -> Self {
        let [u, v] = self.axes.each_ref().map(|(axis, _)| *axis as usize);
        let seen = |point: &Vector3<f64>| (point[u], point[v]);
        let closed = |polygon: &Vec<Vector3<f64>>| -> Line {
            polygon.iter().chain(polygon.first()).map(seen).collect()
        };
        let polygons = boundary.polygons.iter().map(closed);
        // Triangles in the plane have no line: those of the lowest and the highest layer are cut within.
        let along = |triangle: &[Vector3<f64>; 3]| triangle.map(|point| point[self.normal as usize]);
        let Range { start, end } = extent(boundary.triangles.iter().flat_map(along));
        let within = 1e-6 * (end - start);
        let level = match (start..=end).contains(&self.coordinate) {
            true => self.coordinate.clamp(start + within, end - within),
            false => self.coordinate,
        };
        let cut = boundary.triangles.iter().filter_map(|triangle| self.cut(triangle, level));
        let lines = polygons.chain(cut.map(|ends| ends.each_ref().map(seen).to_vec())).collect();
        Self { boundary: Some((lines, name)), ..self }
    }

    /// Where a triangle crosses the plane at this coordinate.
    fn cut(&self, triangle: &[Vector3<f64>; 3], level: f64) -> Option<[Vector3<f64>; 2]> {
        let above = triangle.map(|point| point[self.normal as usize] - level);
        let crossing = |k: usize| {
            let next = (k + 1) % 3;
            let share = above[k] / (above[k] - above[next]);
            ((above[k] < 0.0) != (above[next] < 0.0))
                .then(|| triangle[k] + share * (triangle[next] - triangle[k]))
        };
        let mut crossings = (0..3).filter_map(crossing);
        Some([crossings.next()?, crossings.next()?])
    }

    /// Entries that the key of every map has.
    pub(crate) fn key(&self) -> Vec<(String, Pen)> {
        let all = [
            ("frame of the exit points", FRAME),
            ("exit points", Pen::bar(ORANGE)),
            ("not held", Pen::bar(GREY)),
        ];
        let boundary = self.boundary.iter().map(|(_, name)| (*name, BOUNDARY[1]));
        all.into_iter().chain(boundary).map(|(name, pen)| (name.to_owned(), pen)).collect()
    }

    /// Suffix of the file of a layer of a box, such as `_z00`.
    pub(crate) fn suffix(&self) -> String {
        self.layer.map(|layer| format!("_z{layer:02}")).unwrap_or_default()
    }

    /// Words such as `z = 1.75 m`.
    pub(crate) fn words(&self) -> String {
        format!("{} = {} m", self.normal, self.coordinate)
    }

    /// Cells of the map.
    pub(crate) fn cells(&self) -> Result<Cells, ReportError> {
        let nodes = |(axis, coordinates): &(Direction, Vec<f64>)| {
            Nodes::new("grid", format!("{axis} [m]"), coordinates.clone())
        };
        Ok(Cells { x: nodes(&self.axes[0])?, y: nodes(&self.axes[1])? })
    }

    /// Draws the map with the frame and the exit points. `hatched` decides by the index of a position in the
    /// map.
    pub(crate) fn figure(
        &self,
        robot: &Robot,
        heading: &Heading,
        paint: &Paint,
        hatched: impl Fn(usize) -> bool,
        sheet: Sheet,
    ) -> Result<String, ReportError> {
        let (cells, bar) = match paint {
            Paint::Values(map) => (&map.cells, map.bar_width()),
            Paint::Colors(cells, _) => (cells, 0.0),
        };
        let (x, y) = (widened(&cells.x), widened(&cells.y));
        let width = sheet.width() - bar - y.room() - 2.0 * MARGIN;
        let ratio = (y.range.end - y.range.start) / (x.range.end - x.range.start);
        let height = (width * ratio).clamp(HEIGHTS.start, HEIGHTS.end);
        let height = heading.height(sheet) + 4.0 + height + X_AXIS + MARGIN;
        style::figure([sheet.width(), height], |area| {
            let (left, right) = heading.draw(sheet, area)?.split_horizontally(px(sheet.width() - bar));
            let chart = chart(&left, &x, &y, Lines::None)?;
            let plot = chart.plotting_area();
            match paint {
                Paint::Values(map) => map.draw(plot)?,
                Paint::Colors(cells, colors) => cells.draw(plot, |cell| colors[cell])?,
            }
            cells.hatch(plot, hatched)?;
            self.draw_frame(plot, robot, &x.range, &y.range)?;
            for (line, pen) in self.boundary.iter().flat_map(|(lines, _)| BOUNDARY.map(|pen| (lines, pen))) {
                line.iter().try_for_each(|line| pen.draw(plot, line.clone()))?;
            }
            match paint {
                Paint::Values(map) => map.draw_color_bar(&right),
                Paint::Colors(..) => Ok(()),
            }
        })
    }

    /// Draws the exit points and the rectangle around them, as far as they lie in the figure.
    fn draw_frame<C>(
        &self,
        plot: &DrawingArea<SVGBackend, C>,
        robot: &Robot,
        u_range: &Range<f64>,
        v_range: &Range<f64>,
    ) -> Result<(), DrawingError>
    where
        C: plotters::coord::CoordTranslate<From = (f64, f64)>,
    {
        let frame = frame(robot);
        let [u, v] = self.axes.each_ref().map(|(axis, _)| *axis as usize);
        let ([u_low, u_high], [v_low, v_high]) = (frame[u], frame[v]);
        let clamped = |low: f64, high: f64, range: &Range<f64>| {
            [low, high].map(|end| end.clamp(range.start, range.end))
        };
        let [left, right] = clamped(u_low, u_high, u_range);
        let [bottom, top] = clamped(v_low, v_high, v_range);
        for edge in [u_low, u_high].into_iter().filter(|edge| u_range.contains(edge)) {
            FRAME.draw(plot, vec![(edge, bottom), (edge, top)])?;
        }
        for edge in [v_low, v_high].into_iter().filter(|edge| v_range.contains(edge)) {
            FRAME.draw(plot, vec![(left, edge), (right, edge)])?;
        }
        for cable in &robot.cables {
            let point = (cable.exit_point[u], cable.exit_point[v]);
            if u_range.contains(&point.0) && v_range.contains(&point.1) {
                plot.draw(&Circle::new(point, px(4.5), ORANGE.filled()))?;
            }
        }
        Ok(())
    }
}

/// Axis of a map, with margins.
fn widened(nodes: &Nodes) -> Axis {
    let Range { start, end } = nodes.range();
    let room = ROOM * (end - start);
    Axis::numbers(start - room..end + room, 8, &nodes.label)
}
