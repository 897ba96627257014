//! Quantities over the time: motion of the platform, tensions.

use crate::drawing::axis::{Axis, Grid, chart, extent};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{self, Area, BLUE, DrawingError, GREEN, MARGIN, ORANGE, Pen, VERMILLION, X_AXIS};
use crate::error::ReportError;
use plotters::prelude::BLACK;

/// Height of the plot of each quantity [px], at most.
const PLOT: f64 = 190.0;
/// Most points of a curve that are drawn.
const POINTS: usize = 2000;
/// Most curves of a quantity that have pens of their own.
const PENS: usize = 15;

/// A quantity with several curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// Label with the unit.
    pub label: String,
    /// Name of each curve, with times [s] and values.
    pub curves: Vec<(String, Vec<(f64, f64)>)>,
}

/// Draws quantities over the time, one below the other. Curves of the same number have the same pen.
///
/// # Errors
/// [`ReportError::Empty`] without points, [`ReportError::Invalid`] for a point that is not finite.
pub fn over_time(
    title: &str,
    lines: &[String],
    quantities: &[Quantity],
    sheet: Sheet,
) -> Result<String, ReportError> {
    let all = || quantities.iter().flat_map(|quantity| &quantity.curves);
    for (name, points) in all() {
        for (time, value) in points {
            ReportError::finite(name, *time)?;
            ReportError::finite(name, *value)?;
        }
    }
    if quantities.iter().any(|quantity| quantity.curves.iter().all(|(_, points)| points.is_empty())) {
        return Err(ReportError::Empty { what: "a motion without points" });
    }
    let most = quantities.iter().map(|quantity| quantity.curves.len()).max().unwrap_or(0);
    let key: Vec<_> = (0..most.min(PENS)).map(|k| (names(quantities, k), pen(k))).collect();
    let heading = Heading { title, lines, key: &key };
    let height =
        heading.height(sheet) + quantities.len() as f64 * (sheet.plot_height(PLOT) + X_AXIS + 2.0 * MARGIN);
    style::figure([sheet.width(), height], |area| {
        let plots = heading.draw(sheet, area)?.split_evenly((quantities.len(), 1));
        plots.iter().zip(quantities).try_for_each(|(area, quantity)| draw(area, quantity))
    })
}

/// The names of the curves with a number, each once.
fn names(quantities: &[Quantity], k: usize) -> String {
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in quantities.iter().filter_map(|quantity| quantity.curves.get(k)) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    names.join(", ")
}

/// The pen of a curve: five colours, solid, with long and with short dashes, then again.
fn pen(k: usize) -> Pen {
    let color = [BLUE, VERMILLION, GREEN, ORANGE, BLACK][k % 5];
    Pen { color, width: 1.2, dash: [None, Some(8.0), Some(3.0)][k / 5 % 3] }
}

fn draw(area: &Area, quantity: &Quantity) -> Result<(), DrawingError> {
    let points = || quantity.curves.iter().flat_map(|(_, points)| points);
    let x = Axis::numbers(extent(points().map(|point| point.0)), 10, "time [s]");
    let range = extent(points().map(|point| point.1));
    let room = 0.04 * (range.end - range.start);
    let y = Axis::numbers(range.start - room..range.end + room, 5, quantity.label.clone());
    let chart = chart(area, &x, &y, Grid::Horizontal)?;
    let curves = quantity.curves.iter().enumerate();
    curves.into_iter().try_for_each(|(k, (_, points))| pen(k).draw(chart.plotting_area(), thinned(points)))
}

/// The least and the greatest point of each of equal parts, in their order.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if points.len() <= POINTS {
        return points.to_vec();
    }
    let part = points.len().div_ceil(POINTS / 2);
    let ends = |points: &[(f64, f64)]| {
        let by_value = |one: &&(f64, f64), other: &&(f64, f64)| one.1.total_cmp(&other.1);
        let mut ends: Vec<_> = points.iter().min_by(by_value).into_iter().copied().collect();
        ends.extend(points.iter().max_by(by_value));
        ends.sort_by(|one, other| one.0.total_cmp(&other.0));
        ends
    };
    points.chunks(part).flat_map(ends).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn quantities_are_drawn_over_the_time_with_one_key() {
        let curve = |name: &str, factor: f64| {
            (name.to_owned(), (0..50).map(|k| (0.1 * f64::from(k), factor * f64::from(k))).collect())
        };
        let place = Quantity { label: "place [mm]".to_owned(), curves: vec![curve("x", 1.0)] };
        let curves = (1..=8).map(|k| curve(&format!("cable {k}"), f64::from(k))).collect();
        let tensions = Quantity { label: "tension [N]".to_owned(), curves };
        let svg = over_time("falls", &[], &[place.clone(), tensions], Sheet::SCREEN).unwrap();
        for text in ["x, cable 1", "cable 8", "time [s]", "place [mm]", "tension [N]", "falls"] {
            assert!(svg.contains(text), "{text}");
        }
        let none = Quantity { curves: vec![("x".to_owned(), Vec::new())], ..place.clone() };
        assert!(over_time("", &[], &[none], Sheet::SCREEN).is_err());
        let invalid = Quantity { curves: vec![("x".to_owned(), vec![(0.0, f64::NAN)])], ..place };
        assert!(over_time("", &[], &[invalid], Sheet::SCREEN).is_err());
    }

    #[test]
    fn a_long_series_keeps_its_extremes() {
        let points: Vec<_> = (0..100_000).map(|k| (f64::from(k), f64::from(k % 997))).collect();
        let thin = thinned(&points);
        assert!(thin.len() <= POINTS && thin.windows(2).all(|pair| pair[0].0 <= pair[1].0));
        for k in [0.0, 996.0] {
            assert!(thin.iter().any(|point| point.1 == k), "{k}");
        }
    }
}
