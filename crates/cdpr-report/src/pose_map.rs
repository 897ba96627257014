//! What the observations of a sampling say over a plane or the layers of a box: mean and standard deviation of the RMS, and the parameter
//! that matters most.

use crate::color_map::ColorMap;
use crate::error::ReportError;
use crate::plane::{self, Paint, Plane};
use crate::style::{BLUE, GREEN, Heading, Pen, number};
use cdpr_robot::Robot;
use cdpr_study::{PoseRow, PosesSummary};
use plotters::style::RGBColor;
use std::cmp::Reverse;

/// Parameters with a colour of their own, and that of all others; those of the frame and of what is not held are left out.
const COLORS: [RGBColor; 5] =
    [BLUE, RGBColor(0x56, 0xB4, 0xE9), GREEN, RGBColor(0xF0, 0xE4, 0x42), RGBColor(0xCC, 0x79, 0xA7)];
const OTHERS: RGBColor = RGBColor(0x50, 0x50, 0x50);

/// A map by its name, `mean`, `std` or `dominant`, with `_z00`, ... for the layers of a box; or why it cannot be drawn.
pub type PoseMap = (String, Result<String, ReportError>);

/// All maps of a sampling at the poses of a grid. Grey and hatched is where there is nothing to show: the nominal robot does not hold the
/// pose, or hardly any observation has succeeded. A list of poses, or a line, has no map.
pub fn pose_maps(robot: &Robot, summary: &PosesSummary, rows: &[PoseRow]) -> Vec<PoseMap> {
    let planes = summary.grid.as_ref().map(Plane::of).unwrap_or_default();
    let maps = planes.iter().flat_map(|plane| {
        let layer = plane.layer.map(|layer| format!("_z{layer:02}")).unwrap_or_default();
        let rows: Option<Vec<&PoseRow>> = plane.positions.iter().map(|place| rows.get(*place)).collect();
        let drawn = |draw: fn(&Plane, &Robot, &str, &[&PoseRow]) -> Result<String, ReportError>| {
            let rows = rows.as_ref().ok_or(ReportError::Empty { what: "a pose of the grid has no row" })?;
            draw(plane, robot, &summary.title, rows)
        };
        [
            (format!("mean{layer}"), drawn(mean)),
            (format!("std{layer}"), drawn(deviation)),
            (format!("dominant{layer}"), drawn(dominant)),
        ]
    });
    maps.collect()
}

fn mean(plane: &Plane, robot: &Robot, title: &str, rows: &[&PoseRow]) -> Result<String, ReportError> {
    numbers(plane, robot, title, ("mean RMS", "mean"), rows, |row| row.mean_mm)
}

fn deviation(plane: &Plane, robot: &Robot, title: &str, rows: &[&PoseRow]) -> Result<String, ReportError> {
    numbers(plane, robot, title, ("standard deviation of the RMS", "standard deviation"), rows, |row| {
        row.std_mm
    })
}

fn numbers(
    plane: &Plane,
    robot: &Robot,
    title: &str,
    (words, label): (&str, &str),
    rows: &[&PoseRow],
    value: fn(&PoseRow) -> Option<f64>,
) -> Result<String, ReportError> {
    let values = rows.iter().map(|row| value(row)).collect();
    let map = ColorMap::new(plane.cells()?, values, label, &format!("{label} [mm]"))?;
    let heading = Heading {
        title: &format!("{title}: {words} at {}", plane.words()),
        lines: &[format!(
            "{} mm to {} mm; {}",
            number(map.least, 3),
            number(map.greatest, 3),
            counted(rows, |row| value(row).is_some())
        )],
        key: &plane::key(),
    };
    plane.figure(robot, &heading, &Paint::Values(map), |place| value(rows[place]).is_none())
}

fn dominant(plane: &Plane, robot: &Robot, title: &str, rows: &[&PoseRow]) -> Result<String, ReportError> {
    let mut names: Vec<(&str, usize)> = Vec::new();
    for name in rows.iter().filter_map(|row| row.dominant.as_deref()) {
        match names.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => names.push((name, 1)),
        }
    }
    names.sort_by_key(|(name, count)| (Reverse(*count), *name));
    let color = |name: &str| {
        names.iter().zip(COLORS).find(|((known, _), _)| *known == name).map_or(OTHERS, |(_, color)| color)
    };
    let colors = rows.iter().map(|row| row.dominant.as_deref().map(color)).collect();
    let mut key: Vec<_> = plane::key().into();
    key.extend(names.iter().zip(COLORS).map(|((name, _), color)| ((*name).to_owned(), Pen::bar(color))));
    if names.len() > COLORS.len() {
        key.push((format!("{} others", names.len() - COLORS.len()), Pen::bar(OTHERS)));
    }
    let heading = Heading {
        title: &format!("{title}: parameter with the largest t-Student index at {}", plane.words()),
        lines: &[counted(rows, |row| row.dominant.is_some())],
        key: &key,
    };
    plane.figure(robot, &heading, &Paint::Colors(plane.cells()?, colors), |place| {
        rows[place].dominant.is_none()
    })
}

fn counted(rows: &[&PoseRow], shown: impl Fn(&PoseRow) -> bool) -> String {
    let count = rows.iter().filter(|row| shown(row)).count();
    format!("{count} of {} poses, the others are hatched", rows.len())
}
