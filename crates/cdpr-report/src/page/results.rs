//! Sections with the results of a study: distributions, surfaces, effects, measures of sensitivity.

use crate::draw::LEADING;
use crate::page::elements::{Section, cell, figure, numeric, table};
use crate::page::glance::{samplings, surfaces as all_surfaces};
use crate::parameters;
use crate::text;
use cdpr_study::{
    Evidence, Figure, FitSummary, InputMeasures, MEASURES, Measure, Output, Quantity, Results,
    SamplingSummary, SensitivitySummary, is_resolved,
};
use maud::{Markup, html};

/// Histograms of all samplings with their fitted laws.
pub(crate) fn distributions(results: &Results, figures: &[Figure]) -> Option<Section> {
    let all: Vec<_> = samplings(&results.summary).collect();
    let body = html! {
        @for (name, sampling) in &all {
            h3 { (sampling.title) }
            @let (label, short) = (sampling.output.label(), sampling.output.short());
            @let alt = format!("Histogram of the {label} of {name} with fitted laws");
            (figure(name, &alt, figures, &html! {
                "Density of the " (label) " over " (sampling.observations)
                " observations, with the laws that fit best by Akaike's criterion. The dashed line is the "
                (short) " of the nominal robot."
            }))
            (fits(sampling))
        }
    };
    (!all.is_empty()).then(|| {
        let title = format!("Distribution of the {}", results.study.file.output.noun());
        Section::new("distributions", title, body)
    })
}

/// Table of the laws that were fitted to a sampling.
fn fits(sampling: &SamplingSummary) -> Markup {
    let least = sampling.fits.iter().map(|fit| fit.aic).fold(f64::INFINITY, f64::min);
    let row = |fit: &FitSummary| -> Vec<Markup> {
        let best = sampling.best_fit.filter(|best| best.family == fit.law);
        let verdict = match best.map(|best| best.evidence) {
            Some(Evidence::Decided) => html! { " " span.verdict.yes { "decided" } },
            Some(Evidence::Undecided) => html! { " (undecided)" },
            Some(Evidence::Rejected) => html! { " (best of those tried, and rejected)" },
            None => html! {},
        };
        let fields = text::fields(&fit.parameters);
        let parameters = fields.split_once(": ").map_or(fields.as_str(), |(_, values)| values);
        vec![
            html! { (fit.law) (verdict) },
            cell(parameters.replace('_', " ")),
            numeric(fit.probability, 3),
            numeric(fit.aic - least, 4),
            numeric(fit.ks, 3),
            html! { @if fit.p_is_bound { "\u{2264} " } (numeric(fit.p_value, 3)) },
        ]
    };
    let rows: Vec<_> = sampling.fits.iter().map(row).collect();
    let caption = "Fitted laws and the probability of each family. A law is decided on if its \
                   probability is at least 0.95 and p above 0.05, and rejected if p is not. p comes from a \
                   parametric bootstrap. Both are only indications, because Sobol' points are not \
                   independent.";
    let parameters = format!("Parameters [{}]", sampling.output.unit());
    let head = ["Law", &parameters, "Probability", "AIC above the least", "Kolmogorov-Smirnov distance", "p"];
    html! { @if !rows.is_empty() { (table(caption, &head, &rows)) } }
}

/// The output over two parameters, as heat maps with contour lines.
pub(crate) fn surfaces(results: &Results, figures: &[Figure]) -> Option<Section> {
    let all: Vec<_> =
        all_surfaces(&results.summary).filter(|(name, _)| results.surfaces.contains_key(*name)).collect();
    let body = html! {
        @for (name, summary) in &all {
            h3 { (summary.title) }
            @let [x, y] = &summary.parameters;
            @let alt = format!("Heat map of the {} over {x} and {y}", summary.output.short());
            (figure(name, &alt, figures, &html! {
                (text::capital(&summary.output.axis())) " over " (parameters::symbol(x)) " and "
                (parameters::symbol(y)) "; all other parameters are nominal."
            }))
        }
    };
    (!all.is_empty()).then(|| Section::new("surfaces", "Two parameters at a time", body))
}

/// Effects of the coordinates of the anchor and exit points.
pub(crate) fn points(results: &Results, figures: &[Figure]) -> Option<Section> {
    let kinds = [("anchor_points", "anchor"), ("exit_points", "exit")];
    let drawn: Vec<Markup> = kinds
        .into_iter()
        .filter_map(|(name, kind)| {
            if !figures.iter().any(|figure| figure.name == name) {
                return None;
            }
            let alt = format!("t-Student index of each coordinate of the {kind} points, in the plan view");
            let caption = html! {
                "Effect of the coordinates of the " (kind) " points on the "
                (results.study.file.output.short()) ", as t-Student index of x, y and z. The bars stand at "
                "the position of the point in the plan view. \u{d7} marks the "
                "platform's reference point P. The larger the index, the more the coordinate matters."
            };
            Some(figure(name, &alt, figures, &caption))
        })
        .collect();
    let body = html! { @for figure in &drawn { (figure) } };
    (!drawn.is_empty()).then(|| Section::new("points", "Anchor and exit points", body))
}

/// Signed effects of all samplings that have them.
pub(crate) fn effects(results: &Results, figures: &[Figure]) -> Option<Section> {
    let with: Vec<_> = samplings(&results.summary).filter(|(_, s)| !s.signed_effects.is_empty()).collect();
    let body = html! {
        @for (name, sampling) in &with {
            @let alt = format!("Bars of the largest signed effects of {name} with their intervals");
            (figure(&format!("{name}_effects"), &alt, figures, &html! {
                "Signed effects [" (sampling.output.unit()) "]: change of the mean " (sampling.output.short())
                " from the lower to the upper half of a "
                "parameter's range. Lines are intervals of " (text::digits(100.0 * sampling.confidence, 4))
                " % confidence. Bars are grey where the interval contains zero."
            }))
        }
    };
    (!with.is_empty()).then(|| Section::new("effects", "Signed effects", body))
}

/// Measures of sensitivity of all samplings that have them.
pub(crate) fn measures(results: &Results, figures: &[Figure]) -> Option<Section> {
    let with: Vec<_> = samplings(&results.summary)
        .filter_map(|(name, s)| Some((name, s, s.sensitivity.as_ref()?)))
        .collect();
    let body = html! {
        @for (name, sampling, found) in &with {
            h3 { (sampling.title) }
            @let short = sampling.output.short();
            @let shares = format!("Shares of the variance of the {short}");
            @let alt = format!("{shares} of {name} by each measure of sensitivity");
            (figure(&format!("{name}_sensitivity"), &alt, figures, &html! {
                "Shares of the leading parameters in the variance of the " (short) " [%] by each measure. "
                "Lines are confidence intervals."
            }))
            (side_by_side(found, sampling.output))
        }
    };
    (!with.is_empty()).then(|| Section::new("measures", "Measures of sensitivity", body))
}

/// Measures of the study's vector that stand beside those that rank.
const OF_VECTOR: [&str; 2] = ["vector_total", "bures"];

/// Table of the leading parameters with a column for each measure that ranks them, and those of the vector.
fn side_by_side(found: &SensitivitySummary, output: Output) -> Markup {
    let measured = |measure: &&Measure| found.inputs.iter().any(|input| (measure.value)(input).is_some());
    let measures: Vec<&Measure> = MEASURES
        .iter()
        .filter(|measure| measure.ranks || OF_VECTOR.contains(&measure.name))
        .filter(measured)
        .collect();
    let label = |measure: &&Measure| match measure.quantity {
        Quantity::Change => format!("{} [{}]", measure.label, output.unit()),
        _ => measure.label.to_owned(),
    };
    let labels: Vec<String> = measures.iter().map(label).collect();
    let bracketed = found.inputs.iter().any(|input| input.total_bracket().is_some());
    let bounds: &[&str] = if bracketed { &["total at least", "total at most"] } else { &[] };
    let labels = labels.iter().map(String::as_str).chain(bounds.iter().copied());
    let head: Vec<&str> = ["Parameter"].into_iter().chain(labels).collect();
    let row = |input: &InputMeasures| -> Vec<Markup> {
        let value = |measure: &&Measure| match ((measure.value)(input), (measure.interval)(input)) {
            (Some(value), Some(ends)) if !is_resolved(value, ends) => cell("not resolved"),
            (value, _) => numeric(value, 3),
        };
        let values = measures.iter().map(value);
        let ends = [input.total_lower_low, input.total_upper_high].map(|end| numeric(end, 3));
        let ends = ends.into_iter().take(bounds.len());
        [cell(parameters::symbol(&input.input))].into_iter().chain(values).chain(ends).collect()
    };
    let rows: Vec<_> = found.leading().into_iter().take(LEADING).map(row).collect();
    let agreed: Vec<&str> = found.agreement.inputs.iter().map(|name| parameters::symbol(name)).collect();
    let of_vector = match measures.iter().any(|measure| OF_VECTOR.contains(&measure.name)) {
        true => {
            format!(" Vector total and Wasserstein-Bures, which is no share, are of the {}.", found.vector)
        }
        false => String::new(),
    };
    let caption = format!(
        "The leading parameters by each measure. Numbers without a unit are shares of the variance.{of_vector}"
    );
    html! {
        (table(&caption, &head, &rows))
        @if !agreed.is_empty() {
            p { "All measures put " (agreed.join(", ")) " among their " (found.agreement.first) " largest." }
        }
    }
}
