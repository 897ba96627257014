//! Map of names over a plane, each name with its colour.

use crate::drawing::heading::Heading;
use crate::drawing::plane::{Paint, Plane};
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{BLUE, GREEN, Pen};
use crate::error::ReportError;
use cdpr_robot::Robot;
use plotters::style::RGBColor;
use std::cmp::Reverse;

/// Colours of the most frequent names, and the colour of all others. The colours of the frame and of poses
/// that are not held are not among them.
const COLORS: [RGBColor; 5] =
    [BLUE, RGBColor(0x56, 0xB4, 0xE9), GREEN, RGBColor(0xF0, 0xE4, 0x42), RGBColor(0xCC, 0x79, 0xA7)];
const OTHERS: RGBColor = RGBColor(0x50, 0x50, 0x50);

/// Draws a name at each position of a plane. The most frequent names have colours of their own, and positions
/// without a name are hatched.
pub(crate) fn name_map(
    plane: &Plane,
    robot: &Robot,
    title: &str,
    line: String,
    at: &[Option<&str>],
    sheet: Sheet,
) -> Result<String, ReportError> {
    let mut names: Vec<(&str, usize)> = Vec::new();
    for name in at.iter().copied().flatten() {
        match names.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => names.push((name, 1)),
        }
    }
    names.sort_by_key(|(name, count)| (Reverse(*count), *name));
    let color = |name: &str| {
        names.iter().zip(COLORS).find(|((known, _), _)| *known == name).map_or(OTHERS, |(_, color)| color)
    };
    let colors = at.iter().map(|name| name.map(color)).collect();
    let mut key = plane.key();
    key.extend(names.iter().zip(COLORS).map(|((name, _), color)| ((*name).to_owned(), Pen::bar(color))));
    if names.len() > COLORS.len() {
        key.push((format!("{} others", names.len() - COLORS.len()), Pen::bar(OTHERS)));
    }
    let heading = Heading { title, lines: &[line], key: &key };
    plane.figure(robot, &heading, &Paint::Colors(plane.cells()?, colors), |cell| at[cell].is_none(), sheet)
}
