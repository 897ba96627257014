//! What came out: distributions, surfaces, effects, measures of sensitivity.

use crate::draw::LEADING;
use crate::page::comparison;
use crate::page::elements::{Section, cell, figure, numeric, svg, table};
use crate::page::glance::{samplings, surfaces as all_surfaces};
use crate::parameters::{self, axis_of};
use crate::text;
use cdpr_study::{
    Figure, InputMeasures, MEASURES, Measure, Quantity, Results, SamplingSummary, SensitivitySummary,
    Statistic,
};
use maud::{Markup, PreEscaped, html};
use serde::Serialize;

/// A surface for the page's script.
#[derive(Serialize)]
pub(crate) struct SpaceSurface {
    name: String,
    x: Vec<f64>,
    y: Vec<f64>,
    /// RMS [mm], one row a value of y.
    z: Vec<Vec<Option<f64>>>,
    labels: [String; 2],
}

/// All surfaces that can be drawn in space.
pub(crate) fn in_space(results: &Results) -> Vec<SpaceSurface> {
    let drawn = all_surfaces(&results.summary).filter_map(|(name, summary)| {
        let result = results.surfaces.get(name)?;
        let (x_label, x_scale) = axis_of(&summary.parameters[0]).ok()?;
        let (y_label, y_scale) = axis_of(&summary.parameters[1]).ok()?;
        let rows = result.y.len();
        let row = |j: usize| {
            result.rms_mm.iter().skip(j).step_by(rows).map(|rms| rms.as_ref().ok().copied()).collect()
        };
        Some(SpaceSurface {
            name: name.to_owned(),
            x: result.x.iter().map(|value| x_scale * value).collect(),
            y: result.y.iter().map(|value| y_scale * value).collect(),
            z: (0..rows).map(row).collect(),
            labels: [x_label, y_label],
        })
    });
    drawn.collect()
}

/// The published counterpart of a distribution or surface.
fn beside(results: &Results, name: &str) -> String {
    use Statistic::{AnchorPointEquality, DominantAnchorPoints, DominantExitPoints, ExitPointEquality};
    let of_points = [AnchorPointEquality, DominantAnchorPoints, DominantExitPoints, ExitPointEquality];
    comparison::counterpart(&results.study.file.comparison, |row| {
        row.study == name && !of_points.contains(&row.statistic)
    })
}

pub(crate) fn distributions(results: &Results, figures: &[Figure]) -> Option<Section> {
    let all: Vec<_> = samplings(&results.summary).collect();
    let body = html! {
        @for (name, sampling) in &all {
            h3 { (sampling.title) }
            @let alt = format!("Histogram of the RMS of the static deflection of {name} with fitted laws");
            (figure(name, &alt, figures, &html! {
                "Density of the RMS of the static deflection over " (sampling.observations) " observations, with the laws that "
                "fit best by Akaike's criterion; dashed: the nominal robot." (beside(results, name))
            }))
            (fits(sampling))
        }
    };
    (!all.is_empty()).then(|| Section::new("distributions", "Distribution of the deflection", body))
}

fn fits(sampling: &SamplingSummary) -> Markup {
    let least = sampling.fits.iter().map(|fit| fit.aic).fold(f64::INFINITY, f64::min);
    let rows: Vec<Vec<Markup>> = sampling
        .fits
        .iter()
        .map(|fit| {
            let law = html! { (fit.law) @if Some(fit.law) == sampling.best_fit { " " span.verdict.yes { "preferred" } } };
            let parameters = text::fields(&fit.parameters);
            let parameters = parameters.split_once(": ").map_or(parameters.clone(), |(_, values)| values.to_owned());
            vec![law, cell(parameters.replace('_', " ")), numeric(fit.aic - least, 4), numeric(fit.ks, 3), numeric(fit.p_value, 3)]
        })
        .collect();
    let head = ["Law", "Parameters [mm]", "AIC above the least", "Kolmogorov-Smirnov distance", "p"];
    html! { @if !rows.is_empty() { (table("Fitted laws; p by parametric bootstrap, on Sobol points an indication", &head, &rows)) } }
}

pub(crate) fn surfaces(results: &Results, figures: &[Figure]) -> Option<Section> {
    let all: Vec<_> =
        all_surfaces(&results.summary).filter(|(name, _)| results.surfaces.contains_key(*name)).collect();
    let body = html! {
        @for (name, summary) in &all {
            h3 { (summary.title) }
            @match svg(figures, name) {
                Err(error) => p.note { "No figure " code { (name) } ": " (error) "." },
                Ok(svg) => {
                    figure id={ "figure-" (name) } data-surface=(name) {
                        div.switch role="group" aria-label="Show as" {
                            button type="button" data-show="space" aria-pressed="false" { "Surface in space" }
                            button type="button" data-show="map" aria-pressed="true" { "Heat map" }
                        }
                        div.plot.space id={ "plot-" (name) } role="img" tabindex="0"
                            aria-label={ "Surface of the RMS over " (summary.parameters[0]) " and " (summary.parameters[1]) } hidden {}
                        div.drawing.map role="img" tabindex="0"
                            aria-label={ "Heat map of the RMS over " (summary.parameters[0]) " and " (summary.parameters[1]) } { (PreEscaped(svg)) }
                        figcaption {
                            "RMS of the static deflection [mm] over " (parameters::symbol(&summary.parameters[0])) " and "
                            (parameters::symbol(&summary.parameters[1])) ", all other parameters nominal." (beside(results, name)) " "
                            span.file { "File: " (name) ".svg" }
                        }
                    }
                }
            }
        }
    };
    (!all.is_empty()).then(|| Section::new("surfaces", "Two parameters at a time", body))
}

pub(crate) fn points(results: &Results, figures: &[Figure]) -> Option<Section> {
    let kinds = [
        ("anchor_points", "anchor", [Statistic::AnchorPointEquality, Statistic::DominantAnchorPoints]),
        ("exit_points", "exit", [Statistic::ExitPointEquality, Statistic::DominantExitPoints]),
    ];
    let drawn: Vec<Markup> = kinds
        .into_iter()
        .filter_map(|(name, kind, statistics)| {
            if !figures.iter().any(|figure| figure.name == name) {
                return None;
            }
            let alt = format!("Bars of the t-Student index of each coordinate of the {kind} points, in the plan of the robot");
            let caption = html! {
                "Effect of the coordinates of the " (kind) " points on the RMS: t-Student index of x, y and z, each at the place of the "
                "point seen from above. \u{d7} marks the platform's reference point P. The larger the index, the more the coordinate matters."
                (comparison::counterpart(&results.study.file.comparison, |row| statistics.contains(&row.statistic)))
            };
            Some(figure(name, &alt, figures, &caption))
        })
        .collect();
    let body = html! { @for figure in &drawn { (figure) } };
    (!drawn.is_empty()).then(|| Section::new("points", "Anchor and exit points", body))
}

pub(crate) fn effects(results: &Results, figures: &[Figure]) -> Option<Section> {
    let with: Vec<_> = samplings(&results.summary).filter(|(_, s)| !s.signed_effects_mm.is_empty()).collect();
    let body = html! {
        @for (name, sampling) in &with {
            @let alt = format!("Bars of the largest signed effects of {name} with their intervals");
            (figure(&format!("{name}_effects"), &alt, figures, &html! {
                "Signed effects [mm]: how much the mean RMS changes from the lower to the upper half of a parameter's range. Lines are "
                "intervals of " (text::digits(100.0 * sampling.confidence, 4))
                " % confidence; grey bars: the interval contains zero."
            }))
        }
    };
    (!with.is_empty()).then(|| Section::new("effects", "Signed effects", body))
}

pub(crate) fn measures(results: &Results, figures: &[Figure]) -> Option<Section> {
    let with: Vec<_> = samplings(&results.summary)
        .filter_map(|(name, s)| Some((name, s, s.sensitivity.as_ref()?)))
        .collect();
    let body = html! {
        @for (name, sampling, found) in &with {
            h3 { (sampling.title) }
            @let alt = format!("Shares of the variance of the RMS of {name} by each measure of sensitivity");
            (figure(&format!("{name}_sensitivity"), &alt, figures, &html! {
                "Shares of the variance of the RMS [%] that the leading parameters have by each measure; lines are intervals."
            }))
            (side_by_side(found))
        }
    };
    (!with.is_empty()).then(|| Section::new("measures", "Measures of sensitivity", body))
}

fn side_by_side(found: &SensitivitySummary) -> Markup {
    let measured = |measure: &&Measure| found.inputs.iter().any(|input| (measure.value)(input).is_some());
    let measures: Vec<&Measure> = MEASURES.iter().filter(|measure| measure.ranks).filter(measured).collect();
    let label = |measure: &&Measure| match measure.quantity {
        Quantity::Change => format!("{} [mm]", measure.label),
        _ => measure.label.to_owned(),
    };
    let labels: Vec<String> = measures.iter().map(label).collect();
    let head: Vec<&str> = ["Parameter"].into_iter().chain(labels.iter().map(String::as_str)).collect();
    let row = |input: &InputMeasures| -> Vec<Markup> {
        let values = measures.iter().map(|measure| numeric((measure.value)(input), 3));
        [cell(parameters::symbol(&input.input))].into_iter().chain(values).collect()
    };
    let rows: Vec<_> = found.leading().into_iter().take(LEADING).map(row).collect();
    let agreed: Vec<&str> = found.agreement.inputs.iter().map(|name| parameters::symbol(name)).collect();
    html! {
        (table("The leading parameters by each measure; without a unit: shares of the variance", &head, &rows))
        @if !agreed.is_empty() {
            p { "All measures put " (agreed.join(", ")) " among their " (found.agreement.first) " largest." }
        }
    }
}
