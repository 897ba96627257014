//! The robot with its sagging cables at the poses of a study, in a parallel projection to scale.

use crate::drawing::axis::{Axis as Scale, extent};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{
    self, Area, BLUE, DrawingError, GREEN, GREY, HEIGHT, MARGIN, ORANGE, Pen, SMALL, VERMILLION, font, pixel,
    px,
};
use crate::error::ReportError;
use crate::scene::{Scene, State};
use crate::text::{load_words, number};
use cdpr_robot::Axis;
use cdpr_study::Study;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// Direction of the viewer: angle from the x axis around z, and angle above the horizon [rad].
const AZIMUTH: f64 = -1.05;
const ELEVATION: f64 = 0.42;
/// Colours of the poses that are drawn.
const COLORS: [RGBColor; 4] = [BLUE, VERMILLION, GREEN, ORANGE];
const FRAME: Pen = Pen { color: GREY, width: 1.2, dash: None };
/// Length of the axes of the base frame, as a share of the smallest side of the frame.
const AXES: f64 = 0.15;
/// Room around the robot for the numbers of cables and the scales of the frame [px].
const ROOM: f64 = 40.0;
/// Distance of the ticks of a scale, at least, and length of a tick [px].
const TICKS: f64 = 44.0;
const TICK: f64 = 5.0;

/// Draws the robot of a study under its load at the first four poses of the study.
///
/// # Errors
/// [`ReportError::Empty`] if the nominal robot has feasible tensions at no pose.
pub fn robot_view(study: &Study, sheet: Sheet) -> Result<String, ReportError> {
    let scene = Scene::new(study).map_err(|error| ReportError::Drawing { reason: error.to_string() })?;
    let poses: Vec<_> = scene.poses.iter().zip(COLORS).collect();
    if poses.is_empty() {
        return Err(ReportError::Empty { what: "no pose is held" });
    }
    let projection = Projection::of(&scene, [sheet.width(), sheet.height(0.0, HEIGHT)]);
    let size = projection.size;
    let tensions = poses.iter().flat_map(|(pose, _)| pose.loaded.cables.iter().map(|cable| cable.tension));
    let Range { start: least, end: greatest } = extent(tensions);
    let sag = poses.iter().map(|(pose, _)| pose.loaded.greatest_sag_mm()).fold(0.0, f64::max);
    let heading = Heading {
        title: &format!("{} under {}, to scale", study.robot.name, load_words(&study.file.load())),
        lines: &[format!(
            "tensions at the platform {} N to {} N; cables sag by {} mm at most",
            number(least, 0),
            number(greatest, 0),
            number(sag, 1)
        )],
        key: &poses
            .iter()
            .map(|(pose, color)| (pose.name.clone(), Pen::solid(*color, 2.0)))
            .collect::<Vec<_>>(),
    };
    style::figure([size[0], heading.height(sheet) + size[1]], |area| {
        let area = heading.draw(sheet, area)?;
        projection.frame(&area, &scene)?;
        poses.iter().try_for_each(|(pose, color)| projection.state(&area, &pose.loaded, *color))?;
        projection.scales(&area, &scene)?;
        projection.numbers(&area, &scene)
    })
}

/// Projection from the base frame to pixels.
struct Projection {
    /// Pixels per metre.
    scale: f64,
    /// Projected point [m] at the middle of the picture.
    middle: (f64, f64),
    /// Width and height of the picture [px].
    size: [f64; 2],
    /// Length of the axes of the base frame [m].
    axes: f64,
}

/// Projects a point to its coordinates to the right and upwards in the picture [m].
fn seen([x, y, z]: [f64; 3]) -> (f64, f64) {
    let ((sin, cos), (sin_up, cos_up)) = (AZIMUTH.sin_cos(), ELEVATION.sin_cos());
    (y * cos - x * sin, z * cos_up - (x * cos + y * sin) * sin_up)
}

impl Projection {
    /// Makes a projection in which the whole scene fits, in a picture of this width and at most this height.
    fn of(scene: &Scene, most: [f64; 2]) -> Self {
        let feet = scene.exits.iter().map(|exit| [exit[0], exit[1], scene.floor]);
        let cables = scene.poses.iter().flat_map(|pose| &pose.loaded.cables);
        let cables = cables.flat_map(|cable| cable.points.iter().copied());
        let all: Vec<_> = scene.exits.iter().copied().chain(feet).chain(cables).map(seen).collect();
        let Range { start: left, end: right } = extent(all.iter().map(|point| point.0));
        let Range { start: low, end: high } = extent(all.iter().map(|point| point.1));
        let around = 2.0 * (ROOM + MARGIN);
        let room = most.map(|size| size - around);
        let scale = (room[0] / (right - left)).min(room[1] / (high - low));
        Self {
            scale,
            middle: (0.5 * (left + right), 0.5 * (low + high)),
            size: [most[0], scale * (high - low) + around],
            axes: AXES * (right - left).min(high - low),
        }
    }

    fn projected(&self, point: [f64; 3]) -> (f64, f64) {
        let (right, up) = seen(point);
        let [width, height] = self.size;
        (0.5 * width + self.scale * (right - self.middle.0), 0.5 * height - self.scale * (up - self.middle.1))
    }

    fn line(
        &self,
        area: &Area,
        pen: Pen,
        points: impl Iterator<Item = [f64; 3]>,
    ) -> Result<(), DrawingError> {
        pen.draw(area, points.map(|point| pixel(self.projected(point))).collect())
    }

    fn dot(&self, area: &Area, point: [f64; 3], color: RGBColor) -> Result<(), DrawingError> {
        area.draw(&Circle::new(pixel(self.projected(point)), px(2.6) as u32, color.filled()))
    }

    /// Draws posts from the floor to the exit points, beams between these, and the axes of the base frame.
    fn frame(&self, area: &Area, scene: &Scene) -> Result<(), DrawingError> {
        let foot = |[x, y, _]: [f64; 3]| [x, y, scene.floor];
        for ring in &scene.rings {
            let corner = |i: usize| scene.exits[ring[i % ring.len()]];
            for i in 0..ring.len() {
                self.line(area, FRAME, [foot(corner(i)), corner(i), corner(i + 1)].into_iter())?;
                self.line(area, FRAME, [foot(corner(i)), foot(corner(i + 1))].into_iter())?;
            }
        }
        scene.exits.iter().try_for_each(|exit| self.dot(area, *exit, BLACK))?;
        for axis in Axis::ALL {
            let mut end = [0.0; 3];
            end[axis.index()] = self.axes;
            self.line(area, Pen::solid(BLACK, 1.2), [[0.0; 3], end].into_iter())?;
            let (x, y) = self.projected(end);
            let style = font(SMALL).pos(Pos::new(HPos::Left, VPos::Center));
            area.draw_text(axis.letter(), &style, pixel((x + 3.0, y - 4.0)))?;
        }
        Ok(())
    }

    /// Draws the number of each cable at its exit point, away from the middle of the picture.
    fn numbers(&self, area: &Area, scene: &Scene) -> Result<(), DrawingError> {
        let mut placed: Vec<(f64, f64)> = Vec::new();
        for (number, exit) in scene.exits.iter().enumerate() {
            let (x, y) = self.projected(*exit);
            let side = if x < 0.5 * self.size[0] { -1.0 } else { 1.0 };
            let mut at = (x + side * 8.0, y - 12.0);
            // Exits one behind the other have their numbers one above the other.
            while placed.iter().any(|other| (other.0 - at.0).abs() < 14.0 && (other.1 - at.1).abs() < SMALL) {
                at.1 -= SMALL;
            }
            placed.push(at);
            let style = font(SMALL).pos(Pos::new(HPos::Center, VPos::Center));
            area.draw_text(&(number + 1).to_string(), &style, pixel(at))?;
        }
        Ok(())
    }

    /// Draws a scale in metres along each side of the box of the frame, outside of it.
    fn scales(&self, area: &Area, scene: &Scene) -> Result<(), DrawingError> {
        let ranges = [0, 1, 2].map(|axis| extent(scene.exits.iter().map(|exit| exit[axis])));
        let [x, y, z] = ranges;
        let z = scene.floor.min(z.start)..z.end;
        // The sides that nothing of the box hides: in front, at the right, and at the left.
        let sides = [
            (x.clone(), [0.0, y.start, z.start]),
            (y.clone(), [x.end, 0.0, z.start]),
            (z, [x.start, y.start, 0.0]),
        ];
        let middle = (0.5 * self.size[0], 0.5 * self.size[1]);
        for (axis, (range, corner)) in Axis::ALL.into_iter().zip(sides) {
            let point = |value: f64| {
                let mut point = corner;
                point[axis.index()] = value;
                self.projected(point)
            };
            let (first, last) = (point(range.start), point(range.end));
            let (across, up) = (last.0 - first.0, last.1 - first.1);
            let length = across.hypot(up);
            if length < 0.5 * TICKS {
                continue;
            }
            // At right angles to the side, away from the middle of the picture.
            let (mut out, half) =
                ((-up / length, across / length), (0.5 * (first.0 + last.0), 0.5 * (first.1 + last.1)));
            if out.0 * (half.0 - middle.0) + out.1 * (half.1 - middle.1) < 0.0 {
                out = (-out.0, -out.1);
            }
            let away = |(x, y): (f64, f64), by: f64| (x + by * out.0, y + by * out.1);
            let most = ((length / TICKS) as usize).clamp(2, 6);
            let mut scale = Scale::numbers(range.clone(), most, "");
            // One tick is no scale.
            for more in most + 1..=6 {
                if scale.ticks.len() > 1 {
                    break;
                }
                scale = Scale::numbers(range.clone(), more, "");
            }
            Pen::solid(BLACK, 0.8).draw(area, [first, last].map(pixel).to_vec())?;
            let style = font(SMALL).pos(Pos::new(HPos::Center, VPos::Center));
            for (value, name) in &scale.ticks {
                let foot = point(*value);
                Pen::solid(BLACK, 0.8).draw(area, [foot, away(foot, TICK)].map(pixel).to_vec())?;
                area.draw_text(name, &style, pixel(away(foot, 3.0 * TICK)))?;
            }
            let label = format!("{} [m]", axis.letter());
            area.draw_text(&label, &style, pixel(away(half, 3.0 * TICK + 1.3 * SMALL)))?;
        }
        Ok(())
    }

    /// Draws the cables, and the platform as the outline of its anchor points.
    fn state(&self, area: &Area, state: &State, color: RGBColor) -> Result<(), DrawingError> {
        for cable in &state.cables {
            if !cable.wheel.is_empty() {
                self.line(area, FRAME, cable.wheel.iter().copied())?;
            }
            self.line(area, Pen::solid(color, 1.1), cable.points.iter().copied())?;
        }
        let outline = outline(state.anchors.iter().map(|anchor| self.projected(*anchor)).collect());
        let pixels: Vec<_> = outline.into_iter().map(pixel).collect();
        area.draw(&Polygon::new(pixels, color.mix(0.35)))?;
        state.anchors.iter().try_for_each(|anchor| self.dot(area, *anchor, color))
    }
}

/// Convex hull in the plane (A. M. Andrew, *Another efficient algorithm for convex hulls in two dimensions*,
/// 1979).
fn outline(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
    let half = |points: &mut dyn Iterator<Item = (f64, f64)>| {
        let mut chain: Vec<(f64, f64)> = Vec::new();
        for point in points {
            let is_left_turn = |a: (f64, f64), b: (f64, f64)| {
                (b.0 - a.0) * (point.1 - a.1) - (b.1 - a.1) * (point.0 - a.0) > 0.0
            };
            while let [.., a, b] = chain[..]
                && !is_left_turn(a, b)
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_study_is_drawn_with_its_frame_cables_and_platforms() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json");
        let svg = robot_view(&Study::open(path.as_ref()).unwrap(), Sheet::SCREEN).unwrap();
        let count = |what: &str| svg.matches(what).count();
        // Exit points, and the anchor points of two poses, each with a platform.
        assert_eq!((count("<circle"), count("<polygon")), (8 + 2 * 8, 2));
        // Frame, axes, cables, key, and scales with their ticks, which have numbers.
        let paths = svg.split(" d=\"").skip(1).filter_map(|rest| rest.split('"').next());
        let lines: usize = paths.map(|path| path.matches('m').count()).sum();
        let texts: Vec<&str> =
            svg.split("<text ").skip(1).map(|rest| rest.split(['>', '<']).nth(1).unwrap().trim()).collect();
        let others = ["CAROCA", "tensions", "(", "x", "y", "z"];
        let numbers = texts.iter().filter(|text| others.iter().all(|other| !text.starts_with(other))).count();
        let ticks = numbers - 8;
        assert!(ticks >= 6, "{texts:?}");
        assert_eq!(lines, 2 * 8 + 3 + 2 * 8 + 2 + 3 + ticks);
        for text in ["1", "8", "x [m]", "y [m]", "z [m]"] {
            assert!(texts.contains(&text), "{text}: {texts:?}");
        }
        for words in ["CAROCA under 50 kg", "(0, 0, 1.75) m", "sag by"] {
            assert!(svg.contains(words), "{words}");
        }
    }

    #[test]
    fn an_outline_leaves_out_what_is_within() {
        let square = vec![(0.0, 0.0), (1.0, 1.0), (0.4, 0.5), (1.0, 0.0), (0.0, 1.0)];
        assert_eq!(outline(square), [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    }
}
