//! Drawings of a calibration: arrows, maps, residuals against place, correlations.

use crate::drawing::axis::extent;
use crate::page::elements::numeric;
use crate::page::plot::{BLUE, Plot, RED};
use crate::text::beyond_rounding;
use cdpr_calibration::{Fit, UncertaintyMap, arrows};
use cdpr_robot::Plane;
use maud::{Markup, PreEscaped, html};
use std::fmt::Write;
use std::ops::Range;

/// Side of a square drawing [px].
const SIDE: f64 = 420.0;

/// Length of the longest arrow, as a share of the drawing.
const LONGEST: f64 = 0.18;

/// Parameters in the map of correlations at most.
const MOST_CORRELATED: usize = 80;

/// Arrows from the modelled towards the measured position, before and after, from above and from the front.
pub(super) fn in_space(found: &Fit) -> Markup {
    let arrows = arrows(found);
    if arrows.is_empty() {
        return html! {};
    }
    let norm = |v: &[f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let longest = arrows.iter().map(|(_, before, _)| norm(before)).fold(0.0, f64::max);
    let longest = 1e-3 * beyond_rounding(1e3 * longest);
    let views = match found.robot.plane {
        None => vec![("from above", [0, 1]), ("from the front", [0, 2])],
        Some(Plane::Xy) => vec![("in the plane of the robot", [0, 1])],
        Some(Plane::Xz) => vec![("in the plane of the robot", [0, 2])],
        Some(Plane::Yz) => vec![("in the plane of the robot", [1, 2])],
    };
    html! {
        @for (name, axes) in views {
            figure {
                div.drawing.small role="img" aria-label={ "Residuals of the position " (name) } {
                    (PreEscaped(arrow_view(&arrows, axes, longest)))
                }
                figcaption {
                    "Measured less modelled " (name) ": before (red), after (blue). The longest before is "
                    (numeric(1e3 * longest, 3)) " mm."
                }
            }
        }
    }
}

type Arrow = ([f64; 3], [f64; 3], [f64; 3]);

fn arrow_view(arrows: &[Arrow], [u, v]: [usize; 2], longest: f64) -> String {
    let range = |k: usize| extent(arrows.iter().map(|(at, ..)| at[k]));
    let (across, up) = (range(u), range(v));
    // Both axes have one scale, with room for the arrows.
    let half = 0.5 * (across.end - across.start).max(up.end - up.start).max(1e-9) * (1.0 + 2.0 * LONGEST);
    let widened = |range: Range<f64>| {
        let middle = 0.5 * (range.start + range.end);
        middle - half..middle + half
    };
    let names = ["x [m]", "y [m]", "z [m]"];
    let mut plot = Plot::new([SIDE, SIDE], (names[u], widened(across)), (names[v], widened(up)));
    let per_residual = if longest > 0.0 { SIDE * LONGEST / longest } else { 0.0 };
    for (at, before, after) in arrows {
        let (px, py) = (plot.x(at[u]), plot.y(at[v]));
        for (residual, color) in [(before, RED), (after, BLUE)] {
            let (ex, ey) = (px + per_residual * residual[u], py - per_residual * residual[v]);
            plot.line([px, py, ex, ey], color);
            plot.add(format_args!("<circle cx=\"{ex:.1}\" cy=\"{ey:.1}\" r=\"2\" fill=\"{color}\"/>"));
        }
    }
    plot.finish()
}

/// The opening of a square drawing.
fn square() -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIDE} {SIDE}\" width=\"{SIDE}\">\
         <rect width=\"{SIDE}\" height=\"{SIDE}\" fill=\"#FFFFFF\"/>"
    )
}

/// Standard deviation of the position over the plane of the measured poses, before and after.
pub(super) fn workspace(map: &UncertaintyMap) -> Markup {
    let whole = |values: &[Option<f64>]| values.iter().flatten().copied().fold(0.0, f64::max);
    html! {
        @for (name, values) in [("before", &map.before), ("after", &map.after)] {
            @let most = whole(values);
            @if most > 0.0 {
                figure {
                    div.drawing.small role="img" aria-label={ "Standard deviation of the position, " (name) } {
                        (PreEscaped(squares(map, values, most)))
                    }
                    figcaption {
                        "Standard deviation of a coordinate of the position " (name) ", at "
                        (map.axes[2]) " = " (numeric(map.at, 3)) " m: no colour is 0, the strongest " (numeric(1e3 * most, 3))
                        " mm; left out where the level platform is not held."
                    }
                }
            }
        }
    }
}

fn squares(map: &UncertaintyMap, values: &[Option<f64>], most: f64) -> String {
    let edges = |values: &[f64]| {
        let Range { start, end } = extent(values.iter().copied());
        let half = 0.5 * (end - start) / (values.len().max(2) - 1) as f64;
        start - half..end + half
    };
    let (across, up) = (edges(&map.columns), edges(&map.rows));
    let [u, v] = [0, 1].map(|k| format!("{} [m]", map.axes[k]));
    let mut plot = Plot::new([SIDE, SIDE], (&u, across.clone()), (&v, up.clone()));
    let width = (plot.x(across.end) - plot.x(across.start)) / map.columns.len() as f64;
    let height = (plot.y(up.start) - plot.y(up.end)) / map.rows.len() as f64;
    for (k, value) in values.iter().enumerate() {
        let Some(value) = value else { continue };
        let (at_x, at_y) = (map.columns[k % map.columns.len()], map.rows[k / map.columns.len()]);
        let (x, y) = (plot.x(at_x) - 0.5 * width, plot.y(at_y) - 0.5 * height);
        plot.add(format_args!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"{BLUE}\" \
             fill-opacity=\"{:.2}\"><title>({at_x:.2}, {at_y:.2}) m: {:.4} mm</title></rect>",
            value / most,
            1e3 * value
        ));
    }
    plot.finish()
}

/// Residuals in standard deviations of their noise against coordinates of the pose and against the load.
pub(super) fn against(found: &Fit) -> Markup {
    let coordinate = |k: usize| found.poses.iter().map(|pose| pose.position[k]).collect::<Vec<f64>>();
    let of = [
        ("x [m]", coordinate(0)),
        ("y [m]", coordinate(1)),
        ("z [m]", coordinate(2)),
        ("payload [kg]", found.payloads.clone()),
    ];
    let most = found.after.iter().map(|of| of.standardized().abs()).fold(3.0, f64::max);
    html! {
        @for (name, places) in &of {
            @let range = extent(places.iter().copied());
            @if range.end > range.start {
                figure {
                    div.drawing.small role="img" aria-label={ "Residuals against " (name) } {
                        (PreEscaped(points(found, (name, range), places, most)))
                    }
                    figcaption {
                        "Residuals against " (name) ", in standard deviations of the noise."
                    }
                }
            }
        }
    }
}

fn points(found: &Fit, place: (&str, Range<f64>), places: &[f64], most: f64) -> String {
    let mut plot = Plot::new([SIDE, 0.6 * SIDE], place, ("residual [std]", -most..most));
    for of in &found.after {
        let (x, y) = (plot.x(places[of.row]), plot.y(of.standardized()));
        plot.add(format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"1.6\" fill=\"{BLUE}\"/>"));
    }
    plot.finish()
}

pub(super) fn correlations(found: &Fit) -> Markup {
    let n = found.estimates.len().min(MOST_CORRELATED);
    let side = SIDE / n.max(1) as f64;
    let std: Vec<f64> = (0..n).map(|k| found.covariance[(k, k)].max(0.0).sqrt()).collect();
    let mut svg = square();
    for i in 0..n {
        for j in 0..n {
            let product = std[i] * std[j];
            let correlation = if product > 0.0 { found.covariance[(i, j)] / product } else { 0.0 };
            if correlation.abs() < 0.02 {
                continue;
            }
            let color = if correlation > 0.0 { BLUE } else { RED };
            let _ = write!(
                svg,
                "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{side:.2}\" height=\"{side:.2}\" fill=\"{color}\" \
                 fill-opacity=\"{:.2}\"><title>{}, {}: {correlation:.2}</title></rect>",
                j as f64 * side,
                i as f64 * side,
                correlation.abs(),
                found.estimates[i].name,
                found.estimates[j].name
            );
        }
    }
    html! {
        figure {
            div.drawing.small role="img" aria-label="Correlations of the unknowns" { (PreEscaped(svg + "</svg>")) }
            figcaption {
                "Correlations of the first " (n) " unknowns in the order of the table: blue is positive."
            }
        }
    }
}
