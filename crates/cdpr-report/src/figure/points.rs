//! Effects of the coordinates of anchor and exit points, in the plan of the robot: Fig. 5b and 5c of the
//! paper.

use crate::drawing::axis::{Axis, extent};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{
    self, Area, BLUE, DrawingError, GREEN, GREY, MARGIN, ORANGE, Pen, SMALL, pixel, text,
};
use crate::error::ReportError;
use crate::text::number;
use cdpr_robot::{Axis as Coordinate, Parameter, Pose, Robot, Vector3};
use cdpr_study::Output;
use cdpr_study::SamplingSummary;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// Names and colours of the bars of x, y and z.
const COORDINATES: [(&str, RGBColor); 3] = [("x", BLUE), ("y", ORANGE), ("z", GREEN)];
/// Height of a line of the title of a panel [px].
const PANEL_TITLE: f64 = 22.0;
/// Height of the longest bar, width of a bar, and size of the bars of a point with their names [px].
const LONGEST: f64 = 62.0;
const BAR: f64 = 9.0;
const ROOM: (f64, f64) = (35.0, 90.0);
/// Largest indices that are listed, the height of their lines and the width of the list [px].
const LISTED: usize = 8;
const LINE: f64 = 15.0;
const LIST: f64 = 84.0;

/// Kind of points of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// Anchor points `A_i` on the platform.
    Anchor,
    /// Exit points `B_i` on the frame.
    Exit,
}

impl Points {
    /// Name of the points in text.
    pub(crate) fn kind(self) -> &'static str {
        match self {
            Self::Anchor => "anchor points",
            Self::Exit => "exit points",
        }
    }

    /// Index of the point and coordinate of a parameter, if it is a coordinate of such a point.
    fn coordinate(self, parameter: &str) -> Option<(usize, Coordinate)> {
        match (self, parameter.parse().ok()?) {
            (Self::Anchor, Parameter::AnchorPoint(i, axis)) | (Self::Exit, Parameter::ExitPoint(i, axis)) => {
                Some((i, axis))
            }
            _ => None,
        }
    }

    fn letter(self) -> char {
        match self {
            Self::Anchor => 'A',
            Self::Exit => 'B',
        }
    }
}

/// A sampling with its name in the study.
#[derive(Clone, Copy, Debug)]
pub struct NamedSampling<'a> {
    /// Name of the sampling.
    pub name: &'a str,
    /// Its summary.
    pub summary: &'a SamplingSummary,
}

/// Draws the t-Student index of each coordinate of each anchor or exit point as bars in the plan of the
/// robot.
///
/// The bars of a point stand at its position, seen from above. There is one panel per sampling, with its name
/// and title, and all panels have the same scale. Points whose bars would cover each other are drawn side by
/// side.
///
/// # Errors
/// [`ReportError::Empty`] if no sampling has such a coordinate among its parameters, [`ReportError::Invalid`]
/// for an index that is not finite or of a point that the robot does not have, and for an invalid pose.
pub fn point_effects(
    robot: &Robot,
    samplings: &[NamedSampling],
    points: Points,
    sheet: Sheet,
) -> Result<String, ReportError> {
    let panels: Vec<Panel> =
        samplings.iter().map(|sampling| Panel::new(robot, sampling, points)).collect::<Result<_, _>>()?;
    if panels.iter().all(|panel| panel.effects.is_empty()) {
        return Err(ReportError::Empty { what: "t_student has no coordinate of these points" });
    }
    let greatest = panels.iter().flat_map(|panel| &panel.effects).map(|effect| effect.t).fold(0.0, f64::max);
    let scale = Axis::numbers(0.0..if greatest > 0.0 { greatest } else { 1.0 }, 5, "");
    let output = samplings.first().map_or(Output::Deflection, |sampling| sampling.summary.output);
    let kind = format!("{} {}\u{1d62}", points.kind(), points.letter());
    let heading = Heading {
        title: &format!("Effect of the coordinates of the {kind} on the {}", output.label()),
        lines: &[
            "t-Student index [-] of each coordinate, at the point's position in the plan; figures: the \
            largest of a point"
                .to_owned(),
        ],
        key: &COORDINATES.map(|(name, color)| (name.to_owned(), Pen::bar(color))),
    };
    let titles = |panel: &Panel| sheet.lines_of(&panel.title, style::TEXT);
    let lines = panels.iter().map(|panel| titles(panel).len()).max().unwrap_or(1);
    let places = Places::new(sheet, lines);
    let size = [sheet.width(), heading.height(sheet) + places.height * panels.len() as f64];
    style::figure(size, |area| {
        let areas = heading.draw(sheet, area)?.split_evenly((panels.len(), 1));
        areas.iter().zip(&panels).try_for_each(|(area, panel)| {
            for (line, (title, size)) in titles(panel).iter().enumerate() {
                text(area, title, *size, (MARGIN, PANEL_TITLE * (line as f64 + 0.5)))?;
            }
            panel.draw(area, points.letter(), &scale, &places)
        })
    })
}

/// Where the parts of a panel are [px].
struct Places {
    height: f64,
    /// Ranges of the plan in which the feet of the bars lie.
    plan: [(f64, f64); 2],
    /// Foot of the scale.
    scale: (f64, f64),
    /// Left end of the first line of the list.
    list: (f64, f64),
    /// Left end of the lines with the extent of the plan.
    extent: (f64, f64),
}

impl Places {
    /// Scale and list are at the right of the plan, or below it where the figure is narrow. `lines` is the
    /// number of lines of the longest title.
    fn new(sheet: Sheet, lines: usize) -> Self {
        let width = sheet.width();
        let top = PANEL_TITLE * (lines - 1) as f64;
        let (upper, lower) = (top + 98.0, top + 252.0);
        if sheet.is_narrow() {
            let below = lower + 40.0;
            return Self {
                height: below + LINE * (LISTED + 3) as f64 + MARGIN,
                plan: [(30.0, width - 30.0), (upper, lower)],
                scale: (0.2 * width, below + LONGEST),
                list: (0.45 * width, below),
                extent: (MARGIN, below + LINE * (LISTED + 1) as f64 + 0.5 * LINE),
            };
        }
        let foot = upper + 20.0;
        Self {
            height: lower + 34.0,
            plan: [(30.0, width - 250.0), (upper, lower)],
            scale: (width - 180.0, foot),
            list: (width - 140.0, foot - LONGEST),
            extent: (width - 212.0, lower - 22.0),
        }
    }
}

/// The t-Student index of a coordinate of a point.
#[derive(Clone, Copy)]
struct Effect {
    /// Number of the point.
    point: usize,
    /// 0 to 2 for x, y, z.
    coordinate: usize,
    /// The index [-].
    t: f64,
}

/// Panel of one sampling.
struct Panel {
    title: String,
    /// Reference point P and the other points in the plan [m].
    center: [f64; 2],
    positions: Vec<[f64; 2]>,
    /// Effects of the coordinates that are uncertain.
    effects: Vec<Effect>,
}

impl Panel {
    fn new(
        robot: &Robot,
        NamedSampling { name, summary }: &NamedSampling,
        points: Points,
    ) -> Result<Self, ReportError> {
        let pose =
            Pose::with_quaternion(Vector3::from(summary.pose), summary.quaternion).ok_or_else(|| {
                ReportError::invalid("quaternion", &format!("{:?}", summary.quaternion), "a rotation")
            })?;
        let position = |i: usize| {
            let point = match points {
                Points::Anchor => robot.anchor_arm(&pose, i) + pose.position,
                Points::Exit => robot.cables[i].exit_point,
            };
            [point.x, point.y]
        };
        let mut effects = Vec::new();
        for (parameter, &t) in &summary.t_student {
            if let Some((point, coordinate)) = points.coordinate(parameter) {
                let field = format!("t_student.{parameter}");
                let t = ReportError::finite(&field, t)?;
                if point >= robot.cables.len() {
                    return Err(ReportError::invalid(field, &t, "a point of the robot"));
                }
                effects.push(Effect { point, coordinate: coordinate as usize, t });
            }
        }
        Ok(Self {
            title: format!("{name}: {}", summary.title),
            center: [pose.position.x, pose.position.y],
            positions: (0..robot.cables.len()).map(position).collect(),
            effects,
        })
    }

    fn draw(&self, area: &Area, letter: char, scale: &Axis, places: &Places) -> Result<(), DrawingError> {
        let plan = Plan::new(&self.positions, self.center, places.plan);
        let outline: Vec<(i32, i32)> = plan.outline(&self.positions).into_iter().map(pixel).collect();
        Pen::solid(GREY, 0.8).draw(area, outline)?;
        let (x, y) = plan.pixels(self.center);
        for (dx, dy) in [(4.0, 4.0), (4.0, -4.0)] {
            Pen::solid(GREY, 1.2).draw(area, vec![pixel((x - dx, y - dy)), pixel((x + dx, y + dy))])?;
        }
        centred(area, "P", (x, y + 11.0))?;

        let height = |t: f64| LONGEST * t / scale.range.end;
        for (point, foot) in plan.feet(&self.positions).into_iter().enumerate() {
            Pen::solid(GREY, 0.8).draw(area, vec![pixel(plan.pixels(self.positions[point])), pixel(foot)])?;
            let own = || self.effects.iter().filter(|effect| effect.point == point);
            for &Effect { coordinate, t, .. } in own() {
                let left = foot.0 + BAR * (coordinate as f64 - 1.5);
                let corners = [pixel((left, foot.1 - height(t))), pixel((left + BAR - 1.0, foot.1))];
                area.draw(&Rectangle::new(corners, COORDINATES[coordinate].1.filled()))?;
            }
            let (left, right) = (foot.0 - 1.5 * BAR - 1.0, foot.0 + 1.5 * BAR);
            Pen::solid(BLACK, 0.8).draw(area, vec![pixel((left, foot.1)), pixel((right, foot.1))])?;
            centred(area, &format!("{letter}{}", point + 1), (foot.0, foot.1 + 8.0))?;
            if let Some(largest) = own().map(|effect| effect.t).reduce(f64::max) {
                centred(area, &number(largest, 1), (foot.0, foot.1 - height(largest) - 7.0))?;
            }
        }
        self.draw_scale(area, scale, places)?;
        self.draw_largest(area, letter, places.list)
    }

    /// Draws the scale of the bars, and the extent of the plan.
    fn draw_scale(&self, area: &Area, scale: &Axis, places: &Places) -> Result<(), DrawingError> {
        let (x, foot) = places.scale;
        let height = |t: f64| foot - LONGEST * t / scale.range.end;
        Pen::solid(BLACK, 0.8).draw(area, vec![pixel((x, foot)), pixel((x, height(scale.range.end)))])?;
        for (tick, name) in &scale.ticks {
            Pen::solid(BLACK, 0.8)
                .draw(area, vec![pixel((x - 4.0, height(*tick))), pixel((x, height(*tick)))])?;
            let end = style::font(SMALL).pos(Pos::new(HPos::Right, VPos::Center));
            area.draw_text(name, &end, pixel((x - 7.0, height(*tick))))?;
        }
        centred(area, "t [-]", (x, foot + 10.0))?;
        let bounds = |axis: usize| {
            let Range { start, end } = extent(self.positions.iter().map(|position| position[axis]));
            [start, end].map(|end| number(end, 2)).join(" to ")
        };
        for (line, axis) in ["x", "y"].iter().enumerate() {
            let position = (places.extent.0, places.extent.1 + LINE * line as f64);
            text(area, &format!("plan: {axis} from {} m", bounds(line)), SMALL, position)?;
        }
        Ok(())
    }

    /// Lists the coordinates with the largest index.
    fn draw_largest(&self, area: &Area, letter: char, list: (f64, f64)) -> Result<(), DrawingError> {
        let mut effects = self.effects.clone();
        effects.sort_by(|one, other| other.t.total_cmp(&one.t));
        let (left, top) = list;
        text(area, "largest", SMALL, (left, top))?;
        for (row, &Effect { point, coordinate, t }) in effects.iter().take(LISTED).enumerate() {
            let y = top + LINE * (row + 1) as f64;
            let name = format!("{letter}{} {}", point + 1, COORDINATES[coordinate].0);
            text(area, &name, SMALL, (left, y))?;
            let end = style::font(SMALL).pos(Pos::new(HPos::Right, VPos::Center));
            area.draw_text(&number(t, 2), &end, pixel((left + LIST, y)))?;
        }
        Ok(())
    }
}

/// Projection from metres in the plan to pixels.
struct Plan {
    scale: f64,
    middle: [f64; 2],
    /// [`Places::plan`].
    ranges: [(f64, f64); 2],
}

impl Plan {
    fn new(positions: &[[f64; 2]], center: [f64; 2], ranges: [(f64, f64); 2]) -> Self {
        let [x, y] =
            [0, 1].map(|axis| extent(positions.iter().chain([&center]).map(|position| position[axis])));
        let room = |axis: usize, range: &Range<f64>| {
            (ranges[axis].1 - ranges[axis].0) / (range.end - range.start).max(1e-9)
        };
        // The factor leaves room for the bars of points at the left and right edge.
        let scale = (0.8 * room(0, &x)).min(room(1, &y));
        Self { scale, middle: [x, y].map(|range| 0.5 * (range.start + range.end)), ranges }
    }

    fn pixels(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        let middle = self.ranges.map(|(low, high)| 0.5 * (low + high));
        (middle[0] + self.scale * (x - self.middle[0]), middle[1] - self.scale * (y - self.middle[1]))
    }

    /// Closed line through all points in the order of their angle around their middle.
    fn outline(&self, positions: &[[f64; 2]]) -> Vec<(f64, f64)> {
        let middle = [0, 1].map(|axis| {
            positions.iter().map(|position| position[axis]).sum::<f64>() / positions.len() as f64
        });
        let angle = |position: &[f64; 2]| (position[1] - middle[1]).atan2(position[0] - middle[0]);
        let mut corners = positions.to_vec();
        corners.sort_by(|one, other| angle(one).total_cmp(&angle(other)));
        corners.extend(corners.first().copied());
        corners.into_iter().map(|position| self.pixels(position)).collect()
    }

    /// Feet of the bars of each point: at its position, or in a row with points whose bars would cover them.
    fn feet(&self, positions: &[[f64; 2]]) -> Vec<(f64, f64)> {
        let (first, last) = self.ranges[0];
        let step = ROOM.0.min((last - first) / positions.len() as f64);
        let mut rows: Vec<Vec<usize>> = (0..positions.len()).map(|point| vec![point]).collect();
        let middle = |row: &[usize]| {
            let sum = row
                .iter()
                .map(|point| self.pixels(positions[*point]))
                .fold((0.0, 0.0), |sum, position| (sum.0 + position.0, sum.1 + position.1));
            (sum.0 / row.len() as f64, sum.1 / row.len() as f64)
        };
        let covered = |one: &[usize], other: &[usize]| {
            let (a, b) = (middle(one), middle(other));
            (a.0 - b.0).abs() < 0.5 * step * (one.len() + other.len()) as f64 - 1e-6
                && (a.1 - b.1).abs() < ROOM.1
        };
        while let Some((i, j)) = (0..rows.len())
            .flat_map(|j| (0..j).map(move |i| (i, j)))
            .find(|&(i, j)| covered(&rows[i], &rows[j]))
        {
            let joined = rows.remove(j);
            rows[i].extend(joined);
        }
        let mut feet = vec![(0.0, 0.0); positions.len()];
        for row in &mut rows {
            // The bars are in the order of the points, from left to right.
            row.sort_by(|one, other| {
                positions[*one][0].total_cmp(&positions[*other][0]).then(one.cmp(other))
            });
            let half = 0.5 * step * row.len() as f64;
            let (x, y) = middle(row);
            let left = x.clamp(first - 10.0 + half, last + 10.0 - half) - half;
            for (k, point) in row.iter().enumerate() {
                feet[*point] = (left + step * (k as f64 + 0.5), y);
            }
        }
        feet
    }
}

fn centred(area: &Area, text: &str, position: (f64, f64)) -> Result<(), DrawingError> {
    area.draw_text(text, &style::font(SMALL).pos(Pos::new(HPos::Center, VPos::Center)), pixel(position))
}
