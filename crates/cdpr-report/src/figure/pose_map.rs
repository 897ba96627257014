//! Maps of a sampling over a plane or the layers of a box: mean and standard deviation of the output, and the
//! parameter that matters most.

use crate::drawing::color_map::ColorMap;
use crate::drawing::heading::Heading;
use crate::drawing::name_map::name_map;
use crate::drawing::plane::{Paint, Plane};
use crate::drawing::sheet::Sheet;
use crate::error::ReportError;
use crate::text::digits;
use cdpr_robot::Robot;
use cdpr_study::{PoseRow, PosesSummary};

/// A map with its name.
#[derive(Debug)]
pub struct NamedMap {
    /// Name, which is part of the name of its file.
    pub name: String,
    /// The map as SVG, or the reason why it cannot be drawn.
    pub svg: Result<String, ReportError>,
}

/// A map as SVG.
type Drawn = Result<String, ReportError>;

/// Draws all maps of a sampling at the poses of a grid. They are named `mean`, `std` and `dominant`, with
/// `_z00`, ... for the layers of a box.
///
/// A position is grey and hatched where the nominal robot does not hold the pose, or where too few
/// observations have succeeded. A list of poses and a line have no map.
pub fn pose_maps(robot: &Robot, summary: &PosesSummary, rows: &[PoseRow], sheet: Sheet) -> Vec<NamedMap> {
    let planes = summary.grid.as_ref().map(Plane::of).unwrap_or_default();
    let maps = planes.iter().flat_map(|plane| {
        let layer = plane.suffix();
        let rows: Option<Vec<&PoseRow>> = plane.positions.iter().map(|index| rows.get(*index)).collect();
        let named = |name, draw: fn(&Plane, &Robot, &PosesSummary, &[&PoseRow], Sheet) -> Drawn| {
            let rows = rows.as_ref().ok_or(ReportError::Empty { what: "a pose of the grid has no row" });
            let svg = rows.and_then(|rows| draw(plane, robot, summary, rows, sheet));
            NamedMap { name: format!("{name}{layer}"), svg }
        };
        [named("mean", mean), named("std", deviation), named("dominant", dominant)]
    });
    maps.collect()
}

fn mean(plane: &Plane, robot: &Robot, summary: &PosesSummary, rows: &[&PoseRow], sheet: Sheet) -> Drawn {
    let words = format!("mean {}", summary.output.short());
    let numbers = Numbers { words, label: "mean", value: |row| row.mean };
    numbers.draw(plane, robot, summary, rows, sheet)
}

fn deviation(plane: &Plane, robot: &Robot, summary: &PosesSummary, rows: &[&PoseRow], sheet: Sheet) -> Drawn {
    let words = format!("standard deviation of the {}", summary.output.short());
    let numbers = Numbers { words, label: "standard deviation", value: |row| row.std };
    numbers.draw(plane, robot, summary, rows, sheet)
}

/// A number of each pose: what it is called in the title and on the colour bar.
struct Numbers {
    words: String,
    label: &'static str,
    value: fn(&PoseRow) -> Option<f64>,
}

impl Numbers {
    fn draw(
        &self,
        plane: &Plane,
        robot: &Robot,
        PosesSummary { title, output, .. }: &PosesSummary,
        rows: &[&PoseRow],
        sheet: Sheet,
    ) -> Drawn {
        let Self { words, label, value } = self;
        let unit = output.unit();
        let values = rows.iter().map(|row| value(row)).collect();
        let map = ColorMap::new(plane.cells()?, values, label, &format!("{label} [{unit}]"))?.by_decades();
        let heading = Heading {
            title: &format!("{title}: {words} at {}", plane.words()),
            lines: &[format!(
                "{} {unit} to {} {unit}{}; {}",
                digits(map.least, 4),
                digits(map.greatest, 4),
                if map.by_decades { ", colours by powers of ten" } else { "" },
                counted(rows, |row| value(row).is_some())
            )],
            key: &plane.key(),
        };
        let hatched = |index: usize| value(rows[index]).is_none();
        plane.figure(robot, &heading, &Paint::Values(map), hatched, sheet)
    }
}

fn dominant(plane: &Plane, robot: &Robot, summary: &PosesSummary, rows: &[&PoseRow], sheet: Sheet) -> Drawn {
    let what = "parameter with the largest t-Student index";
    let title = format!("{}: {what} at {}", summary.title, plane.words());
    let names: Vec<_> = rows.iter().map(|row| row.dominant.as_deref()).collect();
    name_map(plane, robot, &title, counted(rows, |row| row.dominant.is_some()), &names, sheet)
}

fn counted(rows: &[&PoseRow], shown: impl Fn(&PoseRow) -> bool) -> String {
    let count = rows.iter().filter(|row| shown(row)).count();
    format!("{count} of {} poses, the others are hatched", rows.len())
}
