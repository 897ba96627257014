//! Effects of the points' coordinates: Fig. 5b and 5c of the paper.

use crate::error::ReportError;
use crate::style::{self, Axis, BLUE, GREEN, Grid, Heading, MARGIN, ORANGE, Pen, text};
use cdpr_robot::{Axis as Coordinate, Parameter};
use cdpr_study::SamplingSummary;
use plotters::prelude::*;

/// Bars of x, y and z.
const COORDINATES: [(&str, RGBColor); 3] = [("x", BLUE), ("y", ORANGE), ("z", GREEN)];
/// Height of a panel with its title and axes [px].
const PANEL: f64 = 190.0;
const PANEL_TITLE: f64 = 22.0;
/// Width of a bar; points are 1 apart.
const BAR: f64 = 0.26;

/// Which points of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// Anchor points `A_i` on the platform.
    Anchor,
    /// Exit points `B_i` on the frame.
    Exit,
}

impl Points {
    /// Point, counted from 0, and coordinate that a parameter is.
    fn coordinate(self, parameter: &str) -> Option<(usize, Coordinate)> {
        match (self, parameter.parse().ok()?) {
            (Self::Anchor, Parameter::AnchorPoint(i, axis)) | (Self::Exit, Parameter::ExitPoint(i, axis)) => {
                Some((i, axis))
            }
            _ => None,
        }
    }
}

/// The t-Student index of each coordinate of each anchor or exit point as bars: one panel a sampling, headed by the given
/// name and the sampling's title, all with the same axes.
///
/// # Errors
/// [`ReportError::Empty`] if no sampling has such a coordinate among its parameters, [`ReportError::Invalid`] for an index
/// that is not finite.
pub fn point_effects(samplings: &[(&str, &SamplingSummary)], points: Points) -> Result<String, ReportError> {
    let mut panels = Vec::new();
    let (mut cables, mut greatest) = (0, 0.0_f64);
    for (name, summary) in samplings {
        let mut bars = Vec::new();
        for (parameter, &t) in &summary.t_student {
            if let Some((point, coordinate)) = points.coordinate(parameter) {
                let t = ReportError::finite(&format!("t_student.{parameter}"), t)?;
                (cables, greatest) = (cables.max(point + 1), greatest.max(t));
                bars.push((point, coordinate as usize, t));
            }
        }
        panels.push((format!("{name}: {}", summary.title), bars));
    }
    if cables == 0 {
        return Err(ReportError::Empty { what: "t_student has no coordinate of these points" });
    }
    let (letter, kind) = match points {
        Points::Anchor => ('A', "anchor"),
        Points::Exit => ('B', "exit"),
    };
    let x = Axis::names((1..=cables).map(|i| format!("{letter}{i}")), "");
    let y = Axis::numbers(0.0..if greatest > 0.0 { 1.06 * greatest } else { 1.0 }, 6, "t-Student index [-]");
    let heading = Heading {
        title: &format!("Effect of the coordinates of the {kind} points on the RMS of the static deflection"),
        lines: &[],
        key: &COORDINATES.map(|(name, color)| (name.to_owned(), Pen::bar(color))),
    };
    style::figure(heading.height() + PANEL * panels.len() as f64, |area| {
        let areas = heading.draw(area)?.split_evenly((panels.len(), 1));
        for (area, (title, bars)) in areas.iter().zip(&panels) {
            let (head, body) = area.split_vertically(style::px(PANEL_TITLE));
            text(&head, title, style::TEXT, (MARGIN, 0.5 * PANEL_TITLE))?;
            let chart = style::chart(&body, &x, &y, Grid::Horizontal)?;
            for &(point, coordinate, t) in bars {
                let left = (point + 1) as f64 + BAR * (coordinate as f64 - 1.5);
                let bar = [(left, 0.0), (left + BAR, t)];
                chart.plotting_area().draw(&Rectangle::new(bar, COORDINATES[coordinate].1.filled()))?;
            }
        }
        Ok(())
    })
}
