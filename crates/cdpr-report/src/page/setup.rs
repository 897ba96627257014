//! The study: robot, settings, poses, error models.

use crate::page::elements::{Section, cell, table};
use crate::parameters;
use crate::text;
use cdpr_robot::{
    CableEnd, NamedReference, Parameter, Robot, TensionDistribution, TensionLimits, TensionReference,
};
use cdpr_study::{
    GridSpec, IndexMap, InputSpec, PoseSpec, PosesSpec, Results, StudySummary, WeatherQuantity, WeatherSpec,
};
use maud::{Markup, html};

pub(crate) fn section(results: &Results) -> Section {
    let body = html! {
        (settings(results))
        (parts(results))
        @for (name, model) in &results.study.file.error_models { (error_model(results, name, model)) }
    };
    Section::new("study", "The study", body)
}

fn settings(results: &Results) -> Markup {
    let (file, robot) = (&results.study.file, &results.study.robot);
    let cable = &robot.cables[0].properties;
    html! {
        @if let Some(source) = &file.source { p { (source) } }
        dl.facts {
            dt { "Robot" }
            dd { (robot.name) ", " (robot.cables.len()) " cables, platform of "
                (text::digits(robot.platform.mass, 5)) " kg"
                @if let Some(source) = &robot.provenance.source { span.detail { (source) } } }
            dt { "Cable 1" }
            dd { "E = " (text::digits(1e-9 * cable.youngs_modulus, 4)) " GPa, section "
                (text::digits(1e6 * cable.section, 4))
                " mm\u{b2}, " (text::digits(1e3 * cable.linear_density, 4)) " g/m" }
            dt { "Tension limits" }
            dd { (tension_limits(robot)) }
            @if let Some(reference) = &robot.tension_reference {
                dt { "Tensions preferred" }
                dd { (tension_reference(reference)) }
            }
            @if robot.distribution == TensionDistribution::LeastTwoNorm {
                dt { "Tensions chosen" }
                dd { "of least 2-norm" }
            }
            @if file.payload > 0.0 {
                dt { "Load" }
                dd { (text::digits(file.payload, 5)) " kg added at the platform's centre of mass" }
            }
            @if let Some(words) = text::wrench_words(&file.load()) {
                dt { "Wrench" }
                dd { (words) ", in the base frame" }
            }
            @if let Some(weather) = &file.weather {
                dt { "Weather" }
                dd { "after the load, on winches that stand still: " (weather_words(weather)) }
            }
            dt { "Design" }
            dd { "all uncertain parameters at once, at points of Sobol's sequence" }
            dt { "Intervals" }
            dd {
                @if file.replicates == 0 { "none: no replicates" }
                @else { (text::digits(100.0 * file.confidence, 4)) " % confidence from " (file.replicates)
                    " scrambled replicates" }
                "; p-values from " (file.bootstrap_resamples) " resamples"
            }
            dt { "Seed" }
            dd { (file.seed) }
        }
    }
}

/// The fields of the weather that are given, as the study file has them.
fn weather_words(weather: &WeatherSpec) -> String {
    let fields = serde_json::to_value(weather).unwrap_or_default();
    let fields = fields.as_object().into_iter().flatten();
    let words: Vec<_> = fields.map(|(name, value)| format!("{name} {value}")).collect();
    if words.is_empty() { "none but the deviations".to_owned() } else { words.join(", ") }
}

/// Least and greatest tension, as ranges where cables have their own.
fn tension_limits(robot: &Robot) -> String {
    let range = |of: fn(&TensionLimits) -> f64| {
        let values = || (0..robot.cables.len()).map(|i| of(&robot.limits(i)));
        let [low, high] = [values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max)];
        let digits = |value: f64| text::digits(value, 5);
        if low == high {
            digits(low)
        } else {
            format!("{} \u{2013} {} (by cable)", digits(low), digits(high))
        }
    };
    let at_exit = (0..robot.cables.len()).filter(|i| robot.max_at(*i) == CableEnd::Exit).count();
    let end = match at_exit {
        0 => "",
        count if count == robot.cables.len() => ", greatest tension at the exit point",
        _ => ", greatest tension of some cables at the exit point",
    };
    format!("{} N to {} N{end}", range(|limits| limits.min), range(|limits| limits.max))
}

fn tension_reference(reference: &TensionReference) -> String {
    match reference {
        TensionReference::All(tension) => format!("{} N in every cable", text::digits(*tension, 5)),
        TensionReference::Each(tensions) => {
            let each: Vec<_> = tensions.iter().map(|tension| text::digits(*tension, 5)).collect();
            format!("{} N", each.join(", "))
        }
        TensionReference::Named(NamedReference::Mid) => "the middle of the limits".to_owned(),
    }
}

fn parts(results: &Results) -> Markup {
    let file = &results.study.file;
    let pose = |pose: &PoseSpec| {
        let is_rotated = pose.quaternion[1..].iter().any(|component| *component != 0.0);
        html! { span.number { (text::point(&pose.position)) }
        @if is_rotated { span.detail { "quaternion " (text::point(&pose.quaternion)) } } }
    };
    let mut rows = Vec::new();
    for (name, sampling) in &file.samplings {
        let found = results.summary.studies.get(name);
        let count = found.map_or(sampling.observations, StudySummary::observations);
        let moduli = found.and_then(|found| match found {
            StudySummary::Sampling(sampling) => sampling.operating_moduli_gpa,
            _ => None,
        });
        let pose = match (&sampling.pose, &sampling.poses) {
            (Some(one), _) => pose(one),
            (None, Some(PosesSpec::List(list))) => cell(format!("{} poses", list.len())),
            (None, Some(PosesSpec::Grid(GridSpec { x, y, z }))) => {
                let ends = [x, y, z].map(|axis| {
                    let ends = [axis.min, axis.max].map(|end| text::digits(end, 5));
                    if axis.points == 1 { ends[0].clone() } else { ends.join(" \u{2026} ") }
                });
                let [x, y, z] = [x, y, z].map(|axis| axis.points);
                html! { "(" (ends.join(", ")) ")" span.detail { "grid of " (x) " \u{d7} " (y) " \u{d7} " (z) }
                }
            }
            (None, None) => cell(""),
        };
        rows.push(vec![
            html! { (sampling.title) span.detail { (name) } },
            pose,
            html! { "error model " code { (sampling.error_model) }
            @if let Some([least, greatest]) = moduli {
                span.detail { "E at the operating point " (text::digits(least, 4)) " to "
                    (text::digits(greatest, 4)) " GPa" }
            } },
            cell(format!("{count} observations")),
        ]);
    }
    for (name, surface) in &file.surfaces {
        let axes = [&surface.x, &surface.y].map(|axis| parameters::symbol(&axis.parameter)).join(" and ");
        rows.push(vec![
            html! { (surface.title) span.detail { (name) } },
            pose(&surface.pose),
            cell(format!("{axes} alone, all others nominal")),
            cell(format!("{} \u{d7} {} grid points", surface.x.points, surface.y.points)),
        ]);
    }
    table("Settings", &["Setting", "Position of the platform [m]", "Uncertain", "Size"], &rows)
}

fn error_model(results: &Results, name: &str, model: &IndexMap<String, InputSpec>) -> Markup {
    let parameters = Parameter::of(&results.study.robot);
    // The entry of a parameter takes precedence over that of its group.
    let of_entry = |key: &str| -> Vec<&Parameter> {
        let is_of = |parameter: &&Parameter| {
            let own = parameter.to_string();
            own == key || (parameter.group() == key && !model.contains_key(&own))
        };
        parameters.iter().filter(is_of).collect()
    };
    let count = |key: &String, spec: &InputSpec| {
        let single = spec.parameters.is_some() || WeatherQuantity::named(key).is_some();
        if single { 1 } else { of_entry(key).len() }
    };
    let rows: Vec<Vec<Markup>> = model
        .iter()
        .map(|(key, spec)| {
            let of = of_entry(key);
            let tied = spec.parameters.as_ref().map(tied);
            let measured = spec.parameters.as_ref().and_then(|shared| shared.keys().next()).unwrap_or(key);
            let (unit, scale) = if text::is_scaled(&spec.law) {
                parameters::reading_unit(measured)
            } else {
                let of_weather = WeatherQuantity::named(key).map(WeatherQuantity::unit);
                (of.first().map(|parameter| parameter.unit()).or(of_weather).unwrap_or(""), 1.0)
            };
            vec![
                html! { (parameters::parameter(key)) span.detail { (tied.as_ref().unwrap_or(key)) } },
                cell(count(key, spec).to_string()),
                html! { (text::law(&spec.law, scale))
                @if spec.operating_point.is_some() {
                    span.detail { "from the modulus at the operating point" }
                } },
                cell(text::steps(spec.steps.as_ref(), scale)),
                cell(unit),
            ]
        })
        .collect();
    let inputs: usize = model.iter().map(|(key, spec)| count(key, spec)).sum();
    let caption = format!("Error model {name}: deviations from the nominal values, {inputs} inputs");
    table(&caption, &["Parameter", "Inputs", "Law of the deviation", "Steps", "Unit"], &rows)
}

/// Words for a cause of several parameters, such as `added to b1.x, b3.x`.
fn tied(parameters: &IndexMap<String, f64>) -> String {
    let term = |(name, factor): (&String, &f64)| match factor {
        1.0 => name.clone(),
        factor => format!("{} {name}", text::digits(*factor, 4)),
    };
    format!("added to {}", parameters.iter().map(term).collect::<Vec<_>>().join(", "))
}
