//! The report of a calibration: residuals before and after, parameters, correlations.

mod drawings;

use crate::page::calibration::drawings::{against, correlations, in_space, workspace};
use crate::page::elements::{Document, Section, cell, numeric, table};
use cdpr_calibration::{CalibrationSummary, Fit, ParameterSummary};
use cdpr_robot::{Robot, shown};
use maud::{Markup, html};

/// Trends in the table at most.
const MOST_TRENDS: usize = 20;

/// Writes the report of a calibration as the text of an HTML file, which needs no other file and no script.
pub fn calibration_report(robot: &Robot, summary: &CalibrationSummary, found: &Fit) -> String {
    let residuals = html! {
        (by_sensor(summary))
        (in_space(found))
        (outliers(summary))
        h3 { "Against place and load" }
        (trends(summary))
        (against(found))
        (splits(summary))
    };
    let unknowns = html! { (parameters(summary)) (unidentifiable(summary)) };
    let map = summary.workspace.as_ref();
    let map = map.map(|map| Section::new("workspace", "Position over the workspace", workspace(map)));
    let sections = [
        Some(Section::new("residuals", "Residuals", residuals)),
        Some(Section::new("parameters", "Parameters", unknowns)),
        map,
        Some(Section::new("correlations", "Correlations of what is left", correlations(found))),
    ];
    let title = format!("Calibration of {}", shown(&summary.robot));
    let header = head(robot, summary, found);
    let sections = sections.into_iter().flatten().collect();
    Document { title: &title, version: summary.version, header, sections, live: None }.write()
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

fn trends(summary: &CalibrationSummary) -> Markup {
    let row = |of: &cdpr_calibration::Trend| {
        vec![
            cell(&of.column),
            cell(of.against),
            numeric(of.correlation, 2),
            numeric(of.standard_deviations, 3),
        ]
    };
    html! {
        @if !summary.trends.is_empty() {
            (table("Residuals that follow place or load", &["column", "against", "correlation", "in std"],
                &summary.trends.iter().take(MOST_TRENDS).map(row).collect::<Vec<_>>()))
        }
    }
}

fn splits(summary: &CalibrationSummary) -> Markup {
    let Some(first) = summary.splits.first() else { return html! {} };
    let sensors: Vec<&str> = first.ratio.keys().copied().collect();
    let head: Vec<&str> = std::iter::once("rows").chain(sensors.iter().copied()).collect();
    let row = |of: &cdpr_calibration::Split| {
        let ratios = sensors.iter().map(|sensor| numeric(of.ratio.get(sensor).copied(), 2));
        std::iter::once(cell(of.rows.to_string())).chain(ratios).collect::<Vec<_>>()
    };
    html! {
        p { "Variance of the mean over consecutive rows, over that of independent rows: far above 1 where errors \
            change slowly from row to row." }
        (table("Means of consecutive rows", &head, &summary.splits.iter().map(row).collect::<Vec<_>>()))
    }
}

fn parameters(summary: &CalibrationSummary) -> Markup {
    let row = |(name, of): (&String, &ParameterSummary)| {
        vec![
            cell(name),
            numeric(of.before, 7),
            numeric(of.after, 7),
            numeric(of.std, 3),
            numeric(of.std_of_data, 3),
            numeric(of.prior_std, 3),
            numeric(of.moved_by_prior_std, 3),
            cell(if of.identifiable { "yes" } else { "no" }),
            cell(of.unit),
        ]
    };
    let head = [
        "parameter",
        "before",
        "after",
        "std",
        "std by data alone",
        "std before",
        "moved by std before",
        "identifiable",
        "unit",
    ];
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
