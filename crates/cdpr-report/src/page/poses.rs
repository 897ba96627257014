//! Samplings at several poses: maps over the workspace, extremes, and the dominant parameters.
//!
//! One section shows all poses of a sampling. The table beside the report has one row per pose.

use crate::page::elements::{Section, cell, figure, numeric, table};
use crate::page::glance;
use crate::parameters;
use crate::text;
use cdpr_study::{Extremes, Figure, HELD, Output, PosesSummary, Results};
use maud::{Markup, html};

/// Number of dominant parameters that are listed.
const LEADING: usize = 12;

pub(crate) fn section(results: &Results, figures: &[Figure]) -> Option<Section> {
    let all: Vec<_> =
        glance::poses(&results.summary).filter(|(name, _)| results.poses.contains_key(*name)).collect();
    let body = html! {
        @for (name, summary) in &all {
            h3 { (summary.title) }
            p { (held(summary)) " The table " code { (name) ".csv" } " has one row per pose." }
            @let maps = maps_of(name, figures);
            @if maps.is_empty() { p.note { "There are no maps, because the poses form no plane or box." } }
            @for map in maps {
                @let file = format!("{name}_{map}");
                @let alt = format!("Map of the workspace, {}, of {name}", map.replace('_', " "));
                @let drawn = figure(&file, &alt, figures, &caption(map, summary.output));
                // A box has many layers, which are folded away.
                @if map.contains("_z") { details { summary { (file) } (drawn) } } @else { (drawn) }
            }
            (extremes(summary))
            (dominant(summary))
        }
    };
    (!all.is_empty()).then(|| Section::new("workspace", "Over the workspace", body))
}

/// Names of the maps of a sampling: the part of their file names after its own name.
fn maps_of<'a>(name: &str, figures: &'a [Figure]) -> Vec<&'a str> {
    let behind = |figure: &'a Figure| figure.name.strip_prefix(name)?.strip_prefix('_');
    let is_map = |map: &&str| matches!(map.split('_').next(), Some("mean" | "std" | "dominant"));
    figures.iter().filter_map(behind).filter(is_map).collect()
}

/// Number of poses that the nominal robot holds, and the reasons why it does not hold others.
pub(crate) fn held(summary: &PosesSummary) -> String {
    let others = summary.status.iter().filter(|(status, _)| *status != HELD);
    let others: Vec<_> =
        others.map(|(status, count)| format!("{count} {}", status.replace('_', " "))).collect();
    let why = if others.is_empty() { String::new() } else { format!("; not held: {}", others.join(", ")) };
    format!("The nominal robot holds {} of {} poses{why}.", summary.held(), summary.poses)
}

fn caption(map: &str, output: Output) -> Markup {
    let of_output =
        |statistic| format!("{statistic} of the {} over the observations at each pose.", output.label());
    let words = match map.split('_').next() {
        Some("mean") => of_output("Mean"),
        Some("std") => of_output("Standard deviation"),
        _ => "The parameter with the largest t-Student index at each pose.".to_owned(),
    };
    html! { (words) " Grey, hatched positions: the nominal robot does not hold the pose." }
}

fn extremes(summary: &PosesSummary) -> Markup {
    let row = |words: &str, extremes: &Option<Extremes>| {
        let Extremes { min, min_at, max, max_at } = (*extremes)?;
        Some(vec![
            cell(words),
            numeric(min, 4),
            cell(text::point(&min_at)),
            numeric(max, 4),
            cell(text::point(&max_at)),
        ])
    };
    let rows: Vec<_> =
        [row("Mean", &summary.mean), row("Standard deviation", &summary.std)].into_iter().flatten().collect();
    let [least, greatest] = ["Least", "Greatest"].map(|name| format!("{name} [{}]", summary.output.unit()));
    let head = ["Over the poses held", &least, "at [m]", &greatest, "at [m]"];
    let caption = format!("Extremes of the {} over the poses", summary.output.short());
    html! { @if !rows.is_empty() { (table(&caption, &head, &rows)) } }
}

fn dominant(summary: &PosesSummary) -> Markup {
    let mut names: Vec<_> = summary.dominant.iter().collect();
    names.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    let row = |(name, count): (&String, &usize)| {
        let share = 100.0 * *count as f64 / summary.held().max(1) as f64;
        vec![
            cell(parameters::symbol(name)),
            cell(count.to_string()),
            html! { span.number { (text::digits(share, 3)) " %" } },
        ]
    };
    let rows: Vec<_> = names.into_iter().take(LEADING).map(row).collect();
    let caption = "Parameters with the largest t-Student index, by the number of poses";
    html! { @if !rows.is_empty() { (table(caption, &["Parameter", "Poses", "Share"], &rows)) } }
}
