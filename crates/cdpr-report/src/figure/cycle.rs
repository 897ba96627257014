//! A load cycle as lines: Fig. 3 of the paper, and the cycle of a platform on such cables.

use crate::drawing::axis::{Axis, Grid, chart, extent};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{self, BLUE, GREEN, HEIGHT, ORANGE, Pen, VERMILLION};
use crate::error::ReportError;
use plotters::prelude::*;
use std::ops::Range;

const PENS: [Pen; 4] = [
    Pen::solid(BLUE, 2.0),
    Pen { color: VERMILLION, width: 2.0, dash: Some(8.0) },
    Pen { color: GREEN, width: 2.0, dash: Some(4.0) },
    Pen { color: ORANGE, width: 2.0, dash: Some(2.5) },
];

/// Load cycle with its labels.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle<'a> {
    /// Title of the figure.
    pub title: &'a str,
    /// Lines of text below the title.
    pub lines: &'a [String],
    /// Label of the horizontal axis, with its unit.
    pub x: &'a str,
    /// Label of the vertical axis, with its unit.
    pub y: &'a str,
    /// Branches: loading, unloading.
    pub branches: &'a [CycleBranch],
}

/// CycleBranch of a load cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleBranch {
    /// Name in the key of the figure.
    pub name: String,
    /// Points, in the units of the two axes.
    pub points: Vec<(f64, f64)>,
}

/// Draws the branches of a cycle as lines with a dot at each point.
///
/// # Errors
/// [`ReportError::Empty`] without points, [`ReportError::Invalid`] for a point that is not finite or for
/// more than four branches.
pub fn cycle(cycle: &Cycle, sheet: Sheet) -> Result<String, ReportError> {
    let points = || cycle.branches.iter().flat_map(|branch| &branch.points);
    if points().next().is_none() {
        return Err(ReportError::Empty { what: "a cycle without points" });
    }
    if cycle.branches.len() > PENS.len() {
        return Err(ReportError::invalid("branches", &cycle.branches.len(), "4 branches at most"));
    }
    for CycleBranch { name, points } in cycle.branches {
        for (x, y) in points {
            ReportError::finite(&format!("{name}, horizontal"), *x)?;
            ReportError::finite(&format!("{name}, vertical"), *y)?;
        }
    }
    let range = |value: fn(&(f64, f64)) -> f64| {
        let Range { start, end } = extent(points().map(value));
        let margin = 0.05 * (end - start);
        start - margin..end + margin
    };
    let x = Axis::numbers(range(|point| point.0), 9, cycle.x);
    let y = Axis::numbers(range(|point| point.1), 7, cycle.y);
    let key: Vec<_> =
        cycle.branches.iter().zip(PENS).map(|(branch, pen)| (branch.name.clone(), pen)).collect();
    let heading = Heading { title: cycle.title, lines: cycle.lines, key: &key };
    style::figure([sheet.width(), sheet.height(heading.height(sheet), HEIGHT)], |area| {
        let chart = chart(&heading.draw(sheet, area)?, &x, &y, Grid::Horizontal)?;
        let plot = chart.plotting_area();
        for (CycleBranch { points, .. }, pen) in cycle.branches.iter().zip(PENS) {
            pen.draw(plot, points.clone())?;
            for point in points {
                plot.draw(&Circle::new(*point, style::px(2.5), pen.color.filled()))?;
            }
        }
        Ok(())
    })
}
