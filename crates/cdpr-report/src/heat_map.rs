//! What a robot does over a plane of its workspace.

use crate::color_map::{COLOR_BAR, ColorMap, Nodes};
use crate::error::ReportError;
use crate::style::{
    self, Axis, DrawingError, GREY, Grid, Heading, MARGIN, ORANGE, Pen, VERMILLION, X_AXIS, number, px,
};
use cdpr_robot::{Axis as Direction, Robot};
use cdpr_study::{WorkspaceRow, WorkspaceSummary, frame, letter};
use plotters::prelude::*;
use std::ops::Range;

/// What is drawn over the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapQuantity {
    /// |dp| under the load.
    Deflection,
    /// Stiffness of the softest motion.
    LeastStiffness,
    /// Greatest tension of any cable, without and with the load.
    GreatestTension,
}

impl MapQuantity {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Deflection, Self::LeastStiffness, Self::GreatestTension];

    /// Name of its figure file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Deflection => "deflection",
            Self::LeastStiffness => "least_stiffness",
            Self::GreatestTension => "greatest_tension",
        }
    }

    /// Words for the title, label of the colour bar, unit.
    fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Deflection => ("static deflection", "|dp|", "mm"),
            Self::LeastStiffness => ("stiffness of the softest motion", "least stiffness", "kN/m"),
            Self::GreatestTension => ("greatest tension", "greatest tension", "N"),
        }
    }

    /// In the unit of the label.
    fn value(self, row: &WorkspaceRow) -> Option<f64> {
        match self {
            Self::Deflection => row.rms_mm,
            Self::LeastStiffness => row.least_stiffness.map(|stiffness| 1e-3 * stiffness),
            Self::GreatestTension => row.greatest_tension,
        }
    }
}

/// Room around the map for the frame, as a share of its extent.
const ROOM: f64 = 0.04;
/// Heights of the map [px]; both axes have the same scale between them.
const HEIGHTS: Range<f64> = 160.0..760.0;

/// Heat map of a quantity over a plane, with the exit points and the rectangle around them. Hatched is where the platform is not held
/// (grey) or the load takes a tension out of its limits (coloured).
///
/// # Errors
/// [`ReportError::Invalid`] for a workspace that is no plane, [`ReportError::Empty`] where the platform is held nowhere.
pub fn heat_map(
    robot: &Robot,
    summary: &WorkspaceSummary,
    quantity: MapQuantity,
) -> Result<String, ReportError> {
    let grid = &summary.grid;
    let Some(normal) = grid.normal() else {
        return Err(ReportError::invalid("grid", &summary.rows.len(), "one place along one axis: a plane"));
    };
    let [u, v] = match normal {
        Direction::X => [Direction::Y, Direction::Z],
        Direction::Y => [Direction::X, Direction::Z],
        Direction::Z => [Direction::X, Direction::Y],
    };
    let nodes = |axis| Nodes::new("grid", format!("{} [m]", letter(axis)), grid.axis(axis).places());
    let (words, label, unit) = quantity.words();
    let values = summary.rows.iter().map(|row| quantity.value(row)).collect();
    let map = ColorMap::new((nodes(u)?, nodes(v)?), values, quantity.name(), &format!("{label} [{unit}]"))?;
    let hatched = |place: usize| summary.rows[place].status != "held";
    let held = (0..summary.rows.len()).filter(|place| !hatched(*place)).count();

    let (x, y) = (widened(&map.x), widened(&map.y));
    let width = style::WIDTH - COLOR_BAR - y.room() - 2.0 * MARGIN;
    let ratio = (y.range.end - y.range.start) / (x.range.end - x.range.start);
    let height = (width * ratio).clamp(HEIGHTS.start, HEIGHTS.end);
    let frame_pen = Pen { color: VERMILLION, width: 1.5, dash: Some(6.0) };
    let key = [
        ("frame of the exit points".to_owned(), frame_pen),
        ("exit points".to_owned(), Pen::bar(ORANGE)),
        ("not held".to_owned(), Pen::bar(GREY)),
    ];
    let heading = Heading {
        title: &format!(
            "{}: {words} at {} = {} m, payload {} kg",
            summary.robot,
            letter(normal),
            grid.axis(normal).min,
            summary.payload
        ),
        lines: &[format!(
            "{} {unit} to {} {unit}; {held} of {} positions held with all tensions within limits, the others are hatched",
            number(map.least, 3),
            number(map.greatest, 3),
            summary.rows.len()
        )],
        key: &key,
    };
    style::figure(heading.height() + 4.0 + height + X_AXIS + MARGIN, |area| {
        let (left, right) = heading.draw(area)?.split_horizontally(px(style::WIDTH - COLOR_BAR));
        let chart = style::chart(&left, &x, &y, Grid::None)?;
        let plot = chart.plotting_area();
        map.draw(plot)?;
        map.hatch(plot, hatched)?;
        draw_frame(plot, robot, [(u, &x.range), (v, &y.range)], frame_pen)?;
        map.draw_color_bar(&right)
    })
}

fn widened(nodes: &Nodes) -> Axis {
    let Range { start, end } = nodes.range();
    let room = ROOM * (end - start);
    Axis::numbers(start - room..end + room, 8, &nodes.label)
}

/// The rectangle around the exit points and the points, as far as they lie in the figure.
fn draw_frame<C>(
    plot: &DrawingArea<SVGBackend, C>,
    robot: &Robot,
    [(u, u_range), (v, v_range)]: [(Direction, &Range<f64>); 2],
    pen: Pen,
) -> Result<(), DrawingError>
where
    C: plotters::coord::CoordTranslate<From = (f64, f64)>,
{
    let frame = frame(robot);
    let ([u_low, u_high], [v_low, v_high]) = (frame[u as usize], frame[v as usize]);
    let clamped =
        |low: f64, high: f64, range: &Range<f64>| [low, high].map(|end| end.clamp(range.start, range.end));
    let [left, right] = clamped(u_low, u_high, u_range);
    let [bottom, top] = clamped(v_low, v_high, v_range);
    for place in [u_low, u_high].into_iter().filter(|place| u_range.contains(place)) {
        pen.draw(plot, vec![(place, bottom), (place, top)])?;
    }
    for place in [v_low, v_high].into_iter().filter(|place| v_range.contains(place)) {
        pen.draw(plot, vec![(left, place), (right, place)])?;
    }
    for cable in &robot.cables {
        let point = (cable.exit_point[u as usize], cable.exit_point[v as usize]);
        if u_range.contains(&point.0) && v_range.contains(&point.1) {
            plot.draw(&Circle::new(point, px(4.5), ORANGE.filled()))?;
        }
    }
    Ok(())
}
