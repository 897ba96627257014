//! Amplitudes over the frequency, on a logarithmic scale.

use crate::drawing::axis::{Axis, Grid, chart, extent};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{self, BLUE, GREEN, HEIGHT, ORANGE, Pen, VERMILLION};
use crate::error::ReportError;

const PENS: [Pen; 4] = [
    Pen::solid(BLUE, 1.6),
    Pen { color: VERMILLION, width: 1.2, dash: Some(8.0) },
    Pen { color: GREEN, width: 1.2, dash: Some(4.0) },
    Pen { color: ORANGE, width: 1.2, dash: Some(2.5) },
];

/// Amplitudes by the frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Amplitudes<'a> {
    /// Title of the figure.
    pub title: &'a str,
    /// Lines of text below the title.
    pub lines: &'a [String],
    /// Label of the vertical axis, with its unit.
    pub y: &'a str,
    /// Name of each curve, with frequencies [Hz] and amplitudes.
    pub curves: &'a [(String, Vec<(f64, f64)>)],
}

/// Draws amplitudes by the frequency. Those of zero are left out.
///
/// # Errors
/// [`ReportError::Empty`] without points, [`ReportError::Invalid`] for a point that is not finite or for more
/// than four curves.
pub fn amplitudes(given: &Amplitudes, sheet: Sheet) -> Result<String, ReportError> {
    if given.curves.len() > PENS.len() {
        return Err(ReportError::invalid("curves", &given.curves.len(), "4 curves at most"));
    }
    let mut curves = Vec::new();
    for (name, points) in given.curves {
        let mut logarithms = Vec::new();
        for (frequency, amplitude) in points.iter().filter(|(_, amplitude)| *amplitude > 0.0) {
            let logarithm = ReportError::finite(name, amplitude.log10())?;
            logarithms.push((ReportError::finite(name, *frequency)?, logarithm));
        }
        curves.push(logarithms);
    }
    let points = || curves.iter().flatten();
    if points().next().is_none() {
        return Err(ReportError::Empty { what: "amplitudes without points" });
    }
    let x = Axis::numbers(extent(points().map(|point| point.0)), 10, "frequency [Hz]");
    let range = extent(points().map(|point| point.1));
    let (first, last) = (range.start.floor() as i32, range.end.ceil() as i32);
    let last = last.max(first + 1);
    let ticks = (first..=last).map(|power| (f64::from(power), format!("1e{power}"))).collect();
    let y = Axis::given(f64::from(first)..f64::from(last), ticks, given.y);
    let key: Vec<_> = given.curves.iter().zip(PENS).map(|((name, _), pen)| (name.clone(), pen)).collect();
    let heading = Heading { title: given.title, lines: given.lines, key: &key };
    style::figure([sheet.width(), sheet.height(heading.height(sheet), HEIGHT)], |area| {
        let chart = chart(&heading.draw(sheet, area)?, &x, &y, Grid::Horizontal)?;
        curves.iter().zip(PENS).try_for_each(|(curve, pen)| pen.draw(chart.plotting_area(), curve.clone()))
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn amplitudes_are_drawn_by_powers_of_ten_and_refused_without_points() {
        let points = vec![(0.0, 2e-4), (1.0, 0.0), (2.0, 3e-2)];
        let curves = [("worst".to_owned(), points)];
        let given = Amplitudes { title: "shaken", lines: &[], y: "amplitude [mm/N]", curves: &curves };
        let svg = amplitudes(&given, Sheet::SCREEN).unwrap();
        for text in ["1e-4", "1e-1", "frequency [Hz]", "amplitude [mm/N]", "worst"] {
            assert!(svg.contains(text), "{text}");
        }
        let none = [("worst".to_owned(), vec![(1.0, 0.0)])];
        assert!(amplitudes(&Amplitudes { curves: &none, ..given.clone() }, Sheet::SCREEN).is_err());
        let invalid = [("worst".to_owned(), vec![(1.0, f64::INFINITY)])];
        assert!(amplitudes(&Amplitudes { curves: &invalid, ..given }, Sheet::SCREEN).is_err());
    }
}
