//! Drawings of a calibration: arrows, maps, residuals against place, correlations.

use crate::page::elements::numeric;
use cdpr_calibration::{Fit, UncertaintyMap, arrows};
use maud::{Markup, PreEscaped, html};
use std::fmt::Write;

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
    let views = [("from above", [0, 1]), ("from the front", [0, 2])];
    html! {
        @for (name, axes) in views {
            figure {
                div.drawing role="img" aria-label={ "Residuals of the position " (name) } {
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
    let range = |k: usize| {
        let of = |pick: fn(f64, f64) -> f64, from| arrows.iter().map(|(at, ..)| at[k]).fold(from, pick);
        (of(f64::min, f64::INFINITY), of(f64::max, f64::NEG_INFINITY))
    };
    let ((least_u, most_u), (least_v, most_v)) = (range(u), range(v));
    let extent = (most_u - least_u).max(most_v - least_v).max(1e-9);
    let room = 0.5 * (1.0 - 1.0 / (1.0 + 2.0 * LONGEST));
    let scale = SIDE * (1.0 - 2.0 * room) / extent;
    let per_residual = if longest > 0.0 { SIDE * LONGEST / longest } else { 0.0 };
    let x = |value: f64| SIDE * room + scale * (value - least_u);
    let y = |value: f64| SIDE * (1.0 - room) - scale * (value - least_v);
    let mut svg = square();
    for (at, before, after) in arrows {
        let (px, py) = (x(at[u]), y(at[v]));
        for (residual, color) in [(before, "#d55e00"), (after, "#0072b2")] {
            let (ex, ey) = (px + per_residual * residual[u], py - per_residual * residual[v]);
            // Writing to a string cannot fail.
            let _ = write!(
                svg,
                "<line x1=\"{px:.1}\" y1=\"{py:.1}\" x2=\"{ex:.1}\" y2=\"{ey:.1}\" stroke=\"{color}\" \
                 stroke-width=\"1.5\"/><circle cx=\"{ex:.1}\" cy=\"{ey:.1}\" r=\"2\" fill=\"{color}\"/>"
            );
        }
    }
    svg + "</svg>"
}

/// The opening of a square drawing.
fn square() -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIDE} {SIDE}\" width=\"{SIDE}\">\
         <rect width=\"{SIDE}\" height=\"{SIDE}\" fill=\"white\"/>"
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
                    div.drawing role="img" aria-label={ "Standard deviation of the position, " (name) } {
                        (PreEscaped(squares(map, values, most)))
                    }
                    figcaption {
                        "Standard deviation of a coordinate of the position " (name) ", at "
                        (numeric(map.z, 3)) " m: white is 0, the darkest " (numeric(1e3 * most, 3))
                        " mm; no colour where the level platform is not held."
                    }
                }
            }
        }
    }
}

fn squares(map: &UncertaintyMap, values: &[Option<f64>], most: f64) -> String {
    let (width, height) = (SIDE / map.x.len() as f64, SIDE / map.y.len() as f64);
    let mut svg = square();
    for (k, value) in values.iter().enumerate() {
        let Some(value) = value else { continue };
        let (column, row) = (k % map.x.len(), k / map.x.len());
        let (x, y) = (column as f64 * width, SIDE - (row + 1) as f64 * height);
        // Writing to a string cannot fail.
        let _ = write!(
            svg,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"#0072b2\" \
             fill-opacity=\"{:.2}\"><title>({:.2}, {:.2}) m: {:.4} mm</title></rect>",
            value / most,
            map.x[column],
            map.y[row],
            1e3 * value
        );
    }
    svg + "</svg>"
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
            @let least = places.iter().copied().fold(f64::INFINITY, f64::min);
            @let greatest = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            @if greatest > least {
                figure {
                    div.drawing role="img" aria-label={ "Residuals against " (name) } {
                        (PreEscaped(points(found, places, [least, greatest], most)))
                    }
                    figcaption {
                        "Residuals against " (name) ", from " (numeric(least, 3)) " to " (numeric(greatest, 3))
                        "; the frame is " (numeric(most, 3)) " standard deviations of the noise high on both sides."
                    }
                }
            }
        }
    }
}

fn points(found: &Fit, places: &[f64], [least, greatest]: [f64; 2], most: f64) -> String {
    let mut svg = square();
    let middle = 0.5 * SIDE;
    let _ = write!(svg, "<line x1=\"0\" y1=\"{middle}\" x2=\"{SIDE}\" y2=\"{middle}\" stroke=\"#999\"/>");
    for of in &found.after {
        let x = SIDE * (0.02 + 0.96 * (places[of.row] - least) / (greatest - least));
        let y = middle - 0.48 * SIDE * of.standardized() / most;
        let _ = write!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"1.6\" fill=\"#0072b2\"/>");
    }
    svg + "</svg>"
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
            let color = if correlation > 0.0 { "#0072b2" } else { "#d55e00" };
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
            div.drawing role="img" aria-label="Correlations of the unknowns" { (PreEscaped(svg + "</svg>")) }
            figcaption {
                "Correlations of the first " (n) " unknowns in the order of the table: blue is positive."
            }
        }
    }
}
