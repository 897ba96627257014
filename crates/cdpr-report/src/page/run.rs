//! Failed observations, notes and timings of the run, and how to repeat it.

use crate::page::elements::{Section, cell, numeric, table};
use crate::page::glance::samplings;
use crate::text;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use cdpr_study::{Results, Timings};
use maud::{Markup, html};

pub(crate) fn observations(results: &Results) -> Section {
    let studies = &results.summary.studies;
    let failed: Vec<Vec<Markup>> = studies
        .iter()
        .flat_map(|(name, study)| study.failed().iter().map(move |(kind, count)| (name, study, kind, *count)))
        .filter(|(.., count)| *count > 0)
        .map(|(name, study, kind, count)| {
            let share = 100.0 * count as f64 / study.observations().max(1) as f64;
            let words = kind.replace('_', " ");
            vec![
                cell(name),
                cell(words),
                cell(count.to_string()),
                html! { span.number { (text::digits(share, 2)) " %" } },
            ]
        })
        .collect();
    let notes: Vec<(&str, &str)> = samplings(&results.summary)
        .flat_map(|(name, sampling)| {
            let measures = sampling.sensitivity.iter().flat_map(|found| &found.notes);
            sampling.notes.iter().chain(measures).map(move |note| (name, note.as_str()))
        })
        .collect();
    let body = html! {
        @if failed.is_empty() { p { "No observation failed." } }
        @else {
            p { "A failed observation is counted by kind, and the table of the observations gives its \
                reason. No statistic includes it." }
            (table("Failed observations", &["Setting", "Kind", "Number", "Share"], &failed))
        }
        @if !notes.is_empty() {
            h3 { "Notes" }
            ul { @for (name, note) in &notes { li { code { (name) } ": " (note) } } }
        }
        @if let Some(timings) = &results.timings { (times(timings)) }
    };
    Section::new("observations", "Failed observations, notes, timings", body)
}

fn times(timings: &Timings) -> Markup {
    let methods = timings.sensitivity.iter().flat_map(|(name, methods)| {
        methods
            .iter()
            .map(move |(method, seconds)| (format!("{name}: {}", method.replace('_', " ")), *seconds))
    });
    let parts = timings.seconds.iter().map(|(name, seconds)| (name.clone(), *seconds));
    let rows: Vec<Vec<Markup>> = parts
        .chain(methods)
        .chain([("in total".to_owned(), timings.all)])
        .map(|(name, seconds)| vec![cell(name), numeric(seconds, 3)])
        .collect();
    html! {
        h3 { "Timings" }
        (table(&format!("Wall time on {} threads", timings.threads), &["Part", "Time [s]"], &rows))
    }
}

pub(crate) fn again(results: &Results) -> Section {
    let (summary, robot) = (&results.summary, &results.study.file.robot);
    let body = html! {
        p { "The same version, study, robot and seed give the same numbers on any number of threads." }
        pre { code { "cdpr study run study.json --out results" } }
        dl.facts {
            dt { "Version" } dd { "cdpr " (summary.version) }
            @if !summary.hash.is_empty() { dt { "Hash of the study" } dd { (summary.hash) } }
            dt { "Seed" } dd { (summary.seed) }
            dt { "Files" } dd { "study.json, and next to it " (robot) }
        }
        (file("study.json", &results.study_json))
        (file(robot, &results.robot_json))
    };
    Section::new("again", "Run it again", body)
}

/// A file that can be unfolded or saved.
fn file(name: &str, text: &str) -> Markup {
    let address = format!("data:application/json;base64,{}", BASE64_STANDARD.encode(text));
    html! {
        details {
            summary { (name) }
            p { a download=(name) href=(address) { "Save " (name) } }
            pre tabindex="0" { code { (text) } }
        }
    }
}
