//! Title of the page, its main figures, and the overview of all parts of the study.

use crate::page::elements::{cell, numeric, table};
use crate::parameters;
use crate::text::{self, wrench_words};
use cdpr_study::{
    MATTERS, Output, Overview, PartVerdict, PosesSummary, RecommendedIndex, Results, SamplingSummary,
    Standing, StudySummary, Summary, SurfaceSummary,
};
use maud::{Markup, html};

/// Largest number of dominant parameters, and the least share of the largest t-Student index that one has.
const DOMINANT: usize = 3;
const LEAST: f64 = 0.25;

pub(crate) fn header(results: &Results) -> Markup {
    let (summary, output) = (&results.summary, results.study.file.output);
    let at_one: usize = samplings(summary).map(|(_, sampling)| sampling.observations).sum();
    let observations = at_one + poses(summary).map(|(_, poses)| poses.observations).sum::<usize>();
    html! {
        header {
            p.kicker { (kicker(output)) " of a cable-driven parallel robot" }
            h1 { (summary.study) }
            p.lead {
                (question(summary, output))
                @if observations > 0 {
                    ", and how the uncertain parameters change that: " (observations) " observations at "
                    (summary.studies.len()) " setting" @if summary.studies.len() != 1 { "s" }
                }
                "."
            }
            @for (name, part) in &summary.studies { (verdict(name, part)) }
            (cards(summary, output))
            (overview(summary, output))
        }
    }
}

/// The answer of a part of the study, and the recommended measure of its leading inputs.
fn verdict(name: &str, part: &StudySummary) -> Markup {
    let PartVerdict { sentences, recommendation } = part.verdict();
    html! {
        h3 { (part.title()) span.detail { (name) } }
        @for sentence in sentences { p { (sentence) } }
        @if let Some(recommendation) = recommendation {
            @let row = |of: &RecommendedIndex| -> Vec<Markup> {
                vec![cell(parameters::symbol(&of.input)), cell(recommendation.cell(of))]
            };
            @let rows = recommendation.leading().iter().map(row).collect::<Vec<_>>();
            (table(&text::capital(&recommendation.caption()), &["Parameter", "Share, or index"], &rows))
        }
    }
}

fn kicker(output: Output) -> &'static str {
    match output {
        Output::Deflection => "Static deflection",
        Output::Position => "Position error",
        Output::Frequency | Output::PlatformFrequency => "Natural frequency",
        Output::Amplitude => "Amplitude",
        Output::Stiffness => "Stiffness",
    }
}

/// What the study asks.
fn question(summary: &Summary, output: Output) -> String {
    let (robot, load) = (&summary.robot, summary.load());
    let payload = text::digits(load.payload, 4);
    let added = (load.payload > 0.0).then(|| format!("{payload} kg are added to it"));
    let borne = wrench_words(&load).map(|words| format!("it bears {words}"));
    match output {
        Output::Deflection => {
            let when: Vec<_> = [added, borne].into_iter().flatten().collect();
            format!("How far the platform of {robot} moves when {}", when.join(" and "))
        }
        Output::Position => {
            format!(
                "How far from its place the platform of {robot} stands with the lengths of the nominal robot"
            )
        }
        Output::Frequency | Output::PlatformFrequency | Output::Amplitude | Output::Stiffness => {
            let loaded = added.map(|_| format!(" with {payload} kg added to it")).unwrap_or_default();
            let borne = borne.map(|words| format!("; {words}")).unwrap_or_default();
            format!("The {} of the platform of {robot}{loaded}{borne}", output.label())
        }
    }
}

/// Samplings at one pose of a summary.
pub(crate) fn samplings(summary: &Summary) -> impl Iterator<Item = (&str, &SamplingSummary)> {
    summary.studies.iter().filter_map(|(name, study)| match study {
        StudySummary::Sampling(sampling) => Some((name.as_str(), sampling.as_ref())),
        StudySummary::Surface(_) | StudySummary::Poses(_) => None,
    })
}

/// Surfaces of a summary.
pub(crate) fn surfaces(summary: &Summary) -> impl Iterator<Item = (&str, &SurfaceSummary)> {
    summary.studies.iter().filter_map(|(name, study)| match study {
        StudySummary::Surface(surface) => Some((name.as_str(), surface)),
        StudySummary::Sampling(_) | StudySummary::Poses(_) => None,
    })
}

/// Samplings at several poses of a summary.
pub(crate) fn poses(summary: &Summary) -> impl Iterator<Item = (&str, &PosesSummary)> {
    summary.studies.iter().filter_map(|(name, study)| match study {
        StudySummary::Poses(poses) => Some((name.as_str(), poses)),
        StudySummary::Sampling(_) | StudySummary::Surface(_) => None,
    })
}

/// Dominant parameters, the first one first, and how that is known: those that matter for certain, by the
/// largest t-Student index where no bounds say so.
fn dominant(sampling: &SamplingSummary) -> (Vec<&str>, String) {
    let recommendation = sampling.verdict.recommendation.as_ref();
    let bounded = recommendation.filter(|of| of.inputs.iter().any(|input| input.standing.is_some()));
    if let Some(bounded) = bounded {
        let mut matter = bounded.with(Standing::Matters);
        matter.truncate(DOMINANT);
        return (matter, format!("above {} % of the variance", 100.0 * MATTERS));
    }
    let mut effects: Vec<_> = sampling.t_student.iter().map(|(name, t)| (name.as_str(), *t)).collect();
    effects.sort_by(|one, other| other.1.total_cmp(&one.1));
    effects.truncate(DOMINANT);
    let least = effects.first().map_or(0.0, |largest| LEAST * largest.1);
    effects.retain(|effect| effect.1 > 0.0 && effect.1 >= least);
    let indices: Vec<_> = effects.iter().map(|effect| text::figures(effect.1, 3)).collect();
    (effects.into_iter().map(|effect| effect.0).collect(), format!("t = {}", indices.join(", ")))
}

/// The symbols of some parameters.
fn symbols(names: &[&str]) -> String {
    names.iter().map(|name| parameters::symbol(name)).collect::<Vec<_>>().join(", ")
}

fn cards(summary: &Summary, output: Output) -> Markup {
    let first = samplings(summary).next();
    let surface = surfaces(summary).next();
    let (nominal, unit) = (format!("Nominal {}", output.noun()), output.unit());
    let failed: usize = summary.studies.values().flat_map(|study| study.failed().values()).sum();
    html! {
        dl.cards {
            @if let Some(values) = first.and_then(|(_, sampling)| sampling.values) {
                (card(&nominal, &text::figures(values.nominal, 4), unit,
                    &first.map_or_else(String::new, |(name, _)| name.to_owned())))
                (card("Mean \u{b1} std. deviation",
                    &format!("{} \u{b1} {}", text::figures(values.mean, 4), text::figures(values.std, 2)),
                    unit,
                    &format!("{} to {} {unit}", text::figures(values.min, 4), text::figures(values.max, 4))))
            } @else if let Some((name, surface)) = surface {
                (card(&nominal, &text::figures(surface.values.nominal, 4), unit, name))
            }
            @if let Some((_, sampling)) = first {
                @let (names, known_by) = dominant(sampling);
                @if !names.is_empty() { (card("Dominant parameters", &symbols(&names), "", &known_by)) }
            }
            (card("Failed observations", &failed.to_string(), "", "counted, in no statistic"))
        }
    }
}

fn card(name: &str, value: &str, unit: &str, note: &str) -> Markup {
    html! {
        div.card {
            dt { (name) }
            dd { span.value { (value) } " " span.unit { (unit) } span.detail { (note) } }
        }
    }
}

/// Overview with one row per sampling and surface.
fn overview(summary: &Summary, output: Output) -> Markup {
    let rows: Vec<Vec<Markup>> = summary
        .studies
        .iter()
        .map(|(name, study)| {
            let title = html! { (study.title()) span.detail { (name) } };
            let Overview { nominal, mean, std, min, max, .. } = study.overview();
            let (law, leading) = match study {
                StudySummary::Sampling(sampling) => {
                    let law = sampling.best_fit.map_or_else(String::new, |fit| fit.to_string());
                    (law, symbols(&dominant(sampling).0))
                }
                StudySummary::Surface(surface) => {
                    let over = surface.parameters.each_ref().map(|name| parameters::symbol(name)).join(", ");
                    (String::new(), format!("over {over}"))
                }
                StudySummary::Poses(poses) => {
                    (String::new(), format!("means at {} of {} poses", poses.held(), poses.poses))
                }
            };
            let mut row = vec![title];
            row.extend([nominal, mean].map(|value| numeric(value, 4)));
            row.push(numeric(std, 3));
            row.extend([min, max].map(|value| numeric(value, 4)));
            row.extend([cell(law), cell(leading)]);
            row
        })
        .collect();
    let head = ["Setting", "Nominal", "Mean", "Std. dev.", "Least", "Greatest", "Law", "Dominant"];
    let more = match output {
        Output::Deflection => ": the length of the displacement of the platform",
        _ => "",
    };
    table(&text::capital(&format!("{}{more}", output.axis())), &head, &rows)
}
