//! The report of a calibration: residuals before and after, parameters, correlations.

use crate::page::elements::{STYLE, cell, inert, numeric, table};
use cdpr_calibration::{CalibrationSummary, Fit, ParameterSummary, arrows};
use cdpr_robot::{Robot, shown};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::fmt::Write;

/// Content security policy: styles of the page itself, and nothing else.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// Side of a square drawing [px].
const SIDE: f64 = 420.0;

/// Length of the longest arrow, as a share of the drawing.
const LONGEST: f64 = 0.18;

/// Parameters in the map of correlations at most.
const MOST_CORRELATED: usize = 80;

/// Writes the report of a calibration as the text of an HTML file, which needs no other file and no script.
pub fn calibration_report(robot: &Robot, summary: &CalibrationSummary, found: &Fit) -> String {
    let body = html! {
        (head(robot, summary, found))
        section id="residuals" {
            h2 { "Residuals" }
            (by_sensor(summary))
            (in_space(found))
            (outliers(summary))
        }
        section id="parameters" {
            h2 { "Parameters" }
            (parameters(summary))
            (unidentifiable(summary))
        }
        section id="correlations" {
            h2 { "Correlations of what is left" }
            (correlations(found))
        }
    };
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy"
                    content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="generator" content={ "cdpr " (summary.version) };
                title { "Calibration of " (shown(&summary.robot)) }
                style { (PreEscaped(STYLE)) }
            }
            body { div.page { main id="content" {
                (inert(&body))
                footer { "Written by cdpr " (summary.version) "." }
            } } }
        }
    };
    page.into_string()
}

fn head(robot: &Robot, summary: &CalibrationSummary, found: &Fit) -> Markup {
    let millimetres = |std: Option<f64>| numeric(std.map(|std| 1e3 * std), 3);
    html! {
        header {
            h1 { "Calibration of " (shown(&summary.robot)) }
            p { (summary.rows) " rows, " (found.estimates.len()) " unknowns, " (robot.cables.len())
                " cables; chi-square " (numeric(summary.chi_square, 5)) " with " (summary.degrees_of_freedom)
                " degrees of freedom"
                @if let Some(p) = summary.p_value { ", probability of a greater one " (numeric(p, 2)) } "." }
            p { "Standard deviation of a coordinate of the position at these poses: "
                (millimetres(summary.position_std_before)) " mm before, "
                (millimetres(summary.position_std_after)) " mm after." }
            @for warning in &summary.warnings { p.note { (warning) } }
        }
    }
}

fn by_sensor(summary: &CalibrationSummary) -> Markup {
    let row = |(name, of): (&&str, &cdpr_calibration::SensorSummary)| {
        vec![
            cell(*name),
            cell(of.count.to_string()),
            numeric(of.rms_before, 3),
            numeric(of.rms_after, 3),
            numeric(of.standardized_rms_after, 3),
            numeric(of.rms_predicted, 3),
            cell(of.unit),
        ]
    };
    let head =
        ["sensor", "numbers", "rms before", "rms after", "after, in std of the noise", "predicted", "unit"];
    table("Measured less modelled", &head, &summary.residuals.iter().map(row).collect::<Vec<_>>())
}

/// Arrows from the modelled towards the measured position, before and after, from above and from the front.
fn in_space(found: &Fit) -> Markup {
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
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIDE} {SIDE}\" width=\"{SIDE}\">\
         <rect width=\"{SIDE}\" height=\"{SIDE}\" fill=\"white\"/>"
    );
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

fn outliers(summary: &CalibrationSummary) -> Markup {
    let row = |of: &cdpr_calibration::OutlierSummary| {
        vec![
            cell(of.line.to_string()),
            cell(&of.column),
            numeric(of.difference, 4),
            numeric(of.standard_deviations, 3),
        ]
    };
    html! {
        @if !summary.outliers.is_empty() {
            (table("Numbers far from the model", &["line", "column", "difference", "in std of the noise"],
                &summary.outliers.iter().map(row).collect::<Vec<_>>()))
        }
    }
}

fn parameters(summary: &CalibrationSummary) -> Markup {
    let row = |(name, of): (&String, &ParameterSummary)| {
        vec![
            cell(name),
            numeric(of.before, 7),
            numeric(of.after, 7),
            numeric(of.std, 3),
            numeric(of.prior_std, 3),
            numeric(of.moved_by_prior_std, 3),
            cell(if of.identifiable { "yes" } else { "no" }),
            cell(of.unit),
        ]
    };
    let head =
        ["parameter", "before", "after", "std", "std before", "moved by std before", "identifiable", "unit"];
    let rows: Vec<_> = summary.parameters.iter().chain(&summary.sensors).map(row).collect();
    table("Parameters before and after", &head, &rows)
}

fn unidentifiable(summary: &CalibrationSummary) -> Markup {
    html! {
        @if !summary.not_identifiable.is_empty() {
            p { "The data do not tell these combinations:" }
            ul {
                @for combination in &summary.not_identifiable {
                    li { @for (name, weight) in combination.iter().take(6) {
                        (format!("{weight:+.2} ")) (name) " "
                    } }
                }
            }
        }
    }
}

fn correlations(found: &Fit) -> Markup {
    let n = found.estimates.len().min(MOST_CORRELATED);
    let side = SIDE / n.max(1) as f64;
    let std: Vec<f64> = (0..n).map(|k| found.covariance[(k, k)].max(0.0).sqrt()).collect();
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIDE} {SIDE}\" width=\"{SIDE}\">\
         <rect width=\"{SIDE}\" height=\"{SIDE}\" fill=\"white\"/>"
    );
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
