//! Tensions, deflection, stiffness and frequency along a path of poses, with bands of uncertainty.

use crate::drawing::axis::{Axis, Grid, chart, extent};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{
    self, Area, BLUE, DrawingError, GREY, MARGIN, ORANGE, Pen, SMALL, VERMILLION, X_AXIS, font, px,
};
use crate::error::ReportError;
use crate::text::{beyond_rounding, digits};
use cdpr_assess::{Bands, PathPose};
use cdpr_robot::{Robot, shown};
use cdpr_statics::Load;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// Half width of the bands, in standard deviations.
const WIDTHS: f64 = 2.0;
/// Height of the plot of each quantity [px], at most.
const PLOT: f64 = 180.0;
const JUMP: Pen = Pen { color: VERMILLION, width: 1.2, dash: Some(6.0) };
const LIMIT: Pen = Pen { color: BLACK, width: 1.0, dash: Some(3.0) };
const CURVE: Pen = Pen::solid(BLUE, 1.4);

/// A value with its standard deviation, if it has one, at each pose; `None` where a pose is not held.
type Curve = Vec<Option<(f64, Option<f64>)>>;

/// A quantity of the path.
struct Quantity {
    label: &'static str,
    curves: Vec<Curve>,
    /// Values that the quantity is compared with.
    limits: Vec<f64>,
}

/// Draws what a robot does along a path: `None` stands for a pose that is not held. Bands are two standard
/// deviations wide to either side.
///
/// # Errors
/// [`ReportError::Empty`] if no pose is held, [`ReportError::Invalid`] for a value that is not finite.
pub fn path_view(
    robot: &Robot,
    load: &Load,
    poses: &[Option<PathPose>],
    sheet: Sheet,
) -> Result<String, ReportError> {
    if !poses.iter().any(Option::is_some) {
        return Err(ReportError::Empty { what: "no pose of the path is held" });
    }
    let quantities = quantities(robot, load, poses)?;
    let count =
        |wanted: &dyn Fn(&PathPose) -> bool| poses.iter().flatten().filter(|pose| wanted(pose)).count();
    let (jumps, slack) = (count(&|pose| pose.jump), count(&is_slack));
    let lost = poses.iter().filter(|pose| pose.is_none()).count();
    let vectors = [("force", load.wrench.force, "N"), ("moment", load.wrench.moment, "N m")];
    let others = vectors.into_iter().filter(|(_, vector, _)| vector.norm() > 0.0);
    let others: String = others
        .map(|(name, vector, unit)| {
            let [x, y, z] = vector.map(|component| digits(component, 4)).into();
            format!(", {name} ({x}, {y}, {z}) {unit}")
        })
        .collect();
    let line = format!(
        "payload {} kg{others}; {jumps} jumps, {slack} poses with slack cables, {lost} not held",
        digits(load.payload, 4),
    );
    let mut key = vec![("value".to_owned(), CURVE)];
    if poses.iter().flatten().any(|pose| pose.bands.is_some()) {
        key.push(("two standard deviations".to_owned(), Pen::bar(RGBColor(0xB2, 0xD4, 0xE8))));
    }
    key.push(("limits".to_owned(), LIMIT));
    for (is_there, name, pen) in [
        (jumps > 0, "jump of the lengths", JUMP),
        (slack > 0, "slack cable", Pen::bar(ORANGE)),
        (lost > 0, "not held", Pen::bar(GREY)),
    ] {
        if is_there {
            key.push((name.to_owned(), pen));
        }
    }
    let title = format!("{} along a path of {} poses", shown(&robot.name), poses.len());
    let heading = Heading { title: &title, lines: &[line], key: &key };
    let height =
        heading.height(sheet) + quantities.len() as f64 * (sheet.plot_height(PLOT) + X_AXIS + 2.0 * MARGIN);
    style::figure([sheet.width(), height], |area| {
        let plots = heading.draw(sheet, area)?.split_evenly((quantities.len(), 1));
        plots.iter().zip(&quantities).try_for_each(|(area, quantity)| quantity.draw(area, poses, sheet))
    })
}

fn is_slack(pose: &PathPose) -> bool {
    !pose.deflection.loaded.report.slack.is_empty()
}

fn quantities(robot: &Robot, load: &Load, poses: &[Option<PathPose>]) -> Result<Vec<Quantity>, ReportError> {
    type Value<'a> = &'a dyn Fn(&PathPose) -> Option<(f64, Option<f64>)>;
    let curve = |field: &'static str, value: Value| -> Result<Curve, ReportError> {
        let at = |pose: &Option<PathPose>| {
            let found = pose.as_ref().and_then(value);
            found.map(|(value, std)| Ok((ReportError::finite(field, value)?, std))).transpose()
        };
        poses.iter().map(at).collect()
    };
    fn of(bands: Option<&Bands>, std: impl Fn(&Bands) -> Option<f64>) -> Option<f64> {
        bands.and_then(std).filter(|std| std.is_finite())
    }
    let cables = 0..robot.cables.len();
    let tension = |i: usize| {
        let value = move |pose: &PathPose| {
            Some((pose.tensions[i], of(pose.bands.as_ref(), |bands| Some(bands.tensions[i]))))
        };
        curve("tensions", &value)
    };
    let limits = cables.clone().flat_map(|i| [robot.limits(i).min, robot.limits(i).max]);
    let mut limits: Vec<f64> = limits.collect();
    limits.sort_by(f64::total_cmp);
    limits.dedup();
    let tensions =
        Quantity { label: "tensions [N]", curves: cables.map(tension).collect::<Result<_, _>>()?, limits };
    let one = |label, curve| Quantity { label, curves: vec![curve], limits: Vec::new() };
    let mut all = vec![tensions];
    if *load != Load::none() {
        let magnitude = |pose: &PathPose| {
            let std = of(pose.bands.as_ref(), |bands| Some(1e3 * bands.magnitude?));
            Some((beyond_rounding(1e3 * pose.deflection.magnitude()), std))
        };
        all.push(one("|dp| [mm]", curve("deflection", &magnitude)?));
    }
    let stiffness = |pose: &PathPose| {
        let std = of(pose.bands.as_ref(), |bands| bands.least_stiffness);
        Some((pose.deflection.loaded.stability.least_stiffness(), std))
    };
    all.push(one("least stiffness [N/m]", curve("least_stiffness", &stiffness)?));
    if poses.iter().flatten().any(|pose| pose.swing.is_some()) {
        let frequency = |pose: &PathPose| {
            Some((pose.swing?.platform, of(pose.bands.as_ref(), |bands| bands.platform_frequency)))
        };
        all.push(one("frequency of the platform [Hz]", curve("platform_frequency", &frequency)?));
    }
    Ok(all)
}

impl Quantity {
    /// The range of the values with their bands, and of the limits that are near.
    fn range(&self) -> Range<f64> {
        let ends = |(value, std): &(f64, Option<f64>)| {
            let half = WIDTHS * std.unwrap_or(0.0);
            [value - half, value + half]
        };
        let values = extent(self.curves.iter().flatten().flatten().flat_map(ends));
        let room = 0.25 * (values.end - values.start);
        let near =
            self.limits.iter().filter(|limit| (values.start - room..values.end + room).contains(limit));
        let all = extent([values.start, values.end].into_iter().chain(near.copied()));
        let room = 0.04 * (all.end - all.start);
        all.start - room..all.end + room
    }

    /// The numbers of the curves, from 1, and where they stand: at the last points, but not on each other.
    fn numbers(&self, apart: f64) -> Vec<(usize, (f64, f64))> {
        let last = |curve: &Curve| {
            let (k, point) = curve.iter().enumerate().rev().find_map(|(k, point)| Some((k, (*point)?)))?;
            Some(((k + 1) as f64, point.0))
        };
        let curves = self.curves.iter().enumerate();
        let mut ends: Vec<_> = curves.filter_map(|(i, curve)| Some((i + 1, last(curve)?))).collect();
        ends.sort_by(|one, other| one.1.1.total_cmp(&other.1.1));
        let middle = |ends: &[(usize, (f64, f64))]| {
            ends.iter().map(|end| end.1.1).sum::<f64>() / ends.len().max(1) as f64
        };
        let before = middle(&ends);
        for k in 1..ends.len() {
            ends[k].1.1 = ends[k].1.1.max(ends[k - 1].1.1 + apart);
        }
        let moved = middle(&ends) - before;
        ends.iter_mut().for_each(|end| end.1.1 -= moved);
        ends
    }

    fn draw(&self, area: &Area, poses: &[Option<PathPose>], sheet: Sheet) -> Result<(), DrawingError> {
        let x = Axis::numbers(0.5..poses.len() as f64 + 0.5, poses.len().min(10), "pose");
        let y = Axis::numbers(self.range(), 5, self.label);
        let (bottom, top) = (y.range.start, y.range.end);
        let chart = chart(area, &x, &y, Grid::Horizontal)?;
        let plot = chart.plotting_area();
        for (k, pose) in poses.iter().enumerate() {
            let at = (k + 1) as f64;
            if pose.is_none() {
                let beside = [(at - 0.5, bottom), (at + 0.5, top)];
                plot.draw(&Rectangle::new(beside, GREY.mix(0.6).filled()))?;
            }
        }
        for curve in &self.curves {
            for held in held_stretches(curve) {
                let band: Vec<_> =
                    held.iter().filter_map(|(x, v, std)| Some((*x, *v, WIDTHS * (*std)?))).collect();
                let edge = band.iter().map(|(x, v, half)| (*x, v + half));
                let back = band.iter().rev().map(|(x, v, half)| (*x, v - half));
                plot.draw(&Polygon::new(edge.chain(back).collect::<Vec<_>>(), BLUE.mix(0.25).filled()))?;
                CURVE.draw(plot, held.iter().map(|(x, v, _)| (*x, *v)).collect())?;
                if let [(x, v, _)] = held[..] {
                    plot.draw(&Circle::new((x, v), px(2.0), BLUE.filled()))?;
                }
            }
        }
        if self.curves.len() > 1 {
            let apart = SMALL / sheet.plot_height(PLOT) * (top - bottom);
            for (number, (x, y)) in self.numbers(apart) {
                let style = font(SMALL).pos(Pos::new(HPos::Left, VPos::Center));
                plot.draw(&Text::new(format!("\u{a0}{number}"), (x, y), style))?;
            }
        }
        for limit in self.limits.iter().filter(|limit| y.range.contains(limit)) {
            LIMIT.draw(plot, vec![(x.range.start, *limit), (x.range.end, *limit)])?;
        }
        for (k, pose) in poses.iter().enumerate() {
            let at = (k + 1) as f64;
            let Some(pose) = pose else { continue };
            if pose.jump {
                JUMP.draw(plot, vec![(at - 0.5, bottom), (at - 0.5, top)])?;
            }
            if is_slack(pose) {
                let mark = [(at - 0.5, bottom), (at + 0.5, bottom + 0.03 * (top - bottom))];
                plot.draw(&Rectangle::new(mark, ORANGE.filled()))?;
            }
        }
        Ok(())
    }
}

/// The parts of a curve without a gap: pose, value and standard deviation.
fn held_stretches(curve: &Curve) -> Vec<Vec<(f64, f64, Option<f64>)>> {
    let mut stretches = vec![Vec::new()];
    for (k, point) in curve.iter().enumerate() {
        match (point, stretches.last_mut()) {
            (Some((value, std)), Some(last)) => last.push(((k + 1) as f64, *value, *std)),
            _ => stretches.push(Vec::new()),
        }
    }
    stretches.retain(|stretch| !stretch.is_empty());
    stretches
}
