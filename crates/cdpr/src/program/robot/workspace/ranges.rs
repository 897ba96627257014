//! What ranges over the positions of a map, and its details.

use crate::program::output::wide_table;
use cdpr_assess::{BoundarySummary, WorkspaceSummary};
use cdpr_robot::{decimal, decimals_of, shown, significant};
use cdpr_study::Extremes;
use std::collections::BTreeMap;

/// What ranges over the positions held.
pub(super) fn ranges(summary: &WorkspaceSummary) -> [(&'static str, Option<Extremes>); 20] {
    [
        ("|dp| [mm]", summary.magnitude_mm),
        ("least stiffness [N/m]", summary.least_stiffness_n_per_m),
        ("frequency of the platform [Hz]", summary.platform_frequency_hz),
        ("lowest natural frequency [Hz]", summary.lowest_frequency_hz),
        ("greatest tension [N]", summary.greatest_tension_n),
        ("least tension [N]", summary.least_tension_n),
        ("greatest tension, recomputed [N]", summary.recomputed_greatest_tension_n),
        ("greatest payload, recomputed [kg]", summary.payload_recomputed_kg),
        ("greatest payload, lengths kept [kg]", summary.payload_kept_kg),
        ("margin, recomputed [N]", summary.margin_recomputed_n),
        ("margin, lengths kept [N]", summary.margin_kept_n),
        ("distance of the nearest cables [mm]", summary.nearest_cables_mm),
        ("distance of cables and platform [mm]", summary.nearest_to_platform_mm),
        ("tilt in the worst direction [deg]", summary.tilt_deg),
        ("largest amplitude by a force [mm/N]", summary.amplitude_mm_per_n),
        ("largest amplitude by a winch [mm/mm]", summary.winch_mm_per_mm),
        ("displacement in the weather [mm]", summary.weather_moved_mm),
        ("greatest tension in the weather [N]", summary.weather_greatest_tension_n),
        ("greatest utilization", summary.utilization),
        ("motion after the worst break [mm]", summary.break_moved_mm),
    ]
}

pub(super) fn print_details(summary: &WorkspaceSummary) {
    println!("\n{}: {} positions, {}", shown(&summary.robot), summary.rows.len(), summary.conditions());
    let counts = |status: &BTreeMap<&str, usize>| {
        for (status, count) in status {
            println!("{count:8} {status}");
        }
    };
    if summary.is_loaded() {
        println!("with the lengths kept under the load:");
    }
    counts(&summary.status);
    if summary.too_much > 0 {
        let positions = summary.too_much;
        println!(
            "{positions:8} with tensions above tension_limits.max or a breaking force: see workspace.csv"
        );
    }
    if summary.is_loaded() {
        println!("with the tensions recomputed:");
    }
    counts(&summary.recomputed_status);
    // Without a load these are the counts above, unless they say more.
    let says_more = summary.left_out.keys().any(|why| !summary.status.contains_key(why.as_str()));
    if says_more || summary.is_loaded() && !summary.left_out.is_empty() {
        println!("left out{}:", if summary.is_loaded() { ", with the lengths kept" } else { "" });
        for (why, count) in &summary.left_out {
            println!("{count:8} {why}");
        }
    }
    let mut rows = wide_table(&["over the positions held", "least", "at [m]", "greatest", "at [m]"]);
    let position = |[x, y, z]: [f64; 3]| format!("{x:.3}, {y:.3}, {z:.3}");
    for (name, extremes) in ranges(summary) {
        if let Some(Extremes { min, min_at, max, max_at }) = extremes {
            let shown = |number| decimal(number, decimals_of([min, max], 4));
            rows.add_row([name.to_owned(), shown(min), position(min_at), shown(max), position(max_at)]);
        }
    }
    if rows.row_count() > 0 {
        println!("{rows}");
    }
    if let Some(BoundarySummary { way, measure, error, doubtful, unit, parts, evaluations }) =
        &summary.boundary
    {
        let (name, parts) = match *unit {
            "m2" => ("area", format!("{parts} polygons in boundary.csv")),
            _ => ("volume", format!("{parts} triangles in boundary.stl")),
        };
        println!(
            "{name} of the region held ({way}): {} {unit}, error {error:.1e}, in doubt {doubtful:.1e}; \
             {parts}; {evaluations} positions asked for",
            significant(*measure, 5)
        );
    }
    let mut dominant: Vec<_> = summary.dominant.iter().collect();
    dominant.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    for (name, count) in dominant.into_iter().take(5) {
        println!("{name} dominates the tolerance of |dp| at {count} positions");
    }
}
