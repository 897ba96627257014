//! Contents of the report; hostile text stays text, and nothing is loaded from outside.

use cdpr_report::{
    NamedSampling, Points, Sheet, histogram, point_effects, report, shares, signed_effects, surface,
};
use cdpr_study::{Results, StudySummary};
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};

/// The page without the scripts and modules that it carries packed.
fn page(results: &Results) -> String {
    let mut html = report(results).unwrap();
    for id in ["explorer-script", "module"] {
        let start = html.find(&format!("<script type=\"text/plain\" id=\"{id}\">")).unwrap();
        let end = start + html[start..].find("</script>").unwrap();
        html.replace_range(start..end, "");
    }
    html
}

/// The value of each attribute of this name.
fn attributes<'a>(html: &'a str, name: &str) -> Vec<&'a str> {
    html.split(&format!(" {name}=\"")).skip(1).map(|rest| rest.split('"').next().unwrap()).collect()
}

#[test]
fn every_figure_of_the_study_is_in_the_report_with_the_bytes_of_its_file() {
    let results = crate::common::caroca(|_, _| ());
    let html = page(&results);
    let (mut samplings, mut drawn) = (Vec::new(), BTreeMap::new());
    for (name, study) in &results.summary.studies {
        match study {
            StudySummary::Sampling(sampling) => {
                drawn.insert(name.clone(), histogram(sampling, Sheet::SCREEN).unwrap());
                drawn.insert(format!("{name}_effects"), signed_effects(sampling, 20, Sheet::SCREEN).unwrap());
                drawn.insert(format!("{name}_sensitivity"), shares(sampling, 12, Sheet::SCREEN).unwrap());
                samplings.push(NamedSampling { name, summary: sampling });
            }
            StudySummary::Surface(summary) => {
                drawn.insert(name.clone(), surface(summary, &results.surfaces[name], Sheet::SCREEN).unwrap());
            }
            StudySummary::Poses(_) => unreachable!("CAROCA's study has none"),
        }
    }
    for (name, points) in [("anchor_points", Points::Anchor), ("exit_points", Points::Exit)] {
        drawn.insert(
            name.to_owned(),
            point_effects(&results.study.robot, &samplings, points, Sheet::SCREEN).unwrap(),
        );
    }
    for (name, svg) in &drawn {
        assert!(svg.starts_with("<svg") && html.contains(svg.as_str()), "{name}");
    }
    // Three figures of each sampling, two surfaces, both sets of points; the robot is drawn in space.
    assert_eq!(drawn.len(), 3 * 3 + 2 + 2);
    let named: BTreeSet<_> =
        attributes(&html, "id").into_iter().filter_map(|id| id.strip_prefix("figure-")).collect();
    assert_eq!(named, drawn.keys().map(String::as_str).chain(["robot"]).collect());
    assert!(html.contains("id=\"plot-robot\""));
}

#[test]
fn the_report_begins_with_the_verdict_and_says_how_to_run_the_study_again() {
    let results = crate::common::caroca(|_, _| ());
    let html = page(&results);
    let cards = html.find("class=\"cards\"").unwrap();
    for part in results.summary.studies.values() {
        for sentence in &part.verdict().sentences {
            assert!(html.find(sentence).unwrap() < cards, "{sentence}");
        }
    }
    for text in ["Seed", "2017", "cdpr study run study.json", "Wall time on 2 threads", "\u{b1}18", "GPa"] {
        assert!(html.contains(text), "{text}");
    }
}

#[test]
fn a_load_that_is_a_force_is_called_so() {
    let small = |change: &dyn Fn(&mut serde_json::Value)| {
        page(&crate::common::caroca(|study, _| {
            for field in ["surfaces", "sensitivity"] {
                study.as_object_mut().unwrap().remove(field);
            }
            let samplings = study["samplings"].as_object_mut().unwrap();
            samplings.retain(|_, of| of.get("pose").is_some());
            samplings.values_mut().for_each(|of| of["observations"] = json!(16));
            change(study);
        }))
    };
    let payload = small(&|_| ());
    assert!(payload.contains(" with payload") && payload.contains("Tension, payload [N]"));
    let force = small(&|study| {
        study["payload"] = json!(0);
        study["force"] = json!([0, 0, -500]);
    });
    assert!(force.contains(" with force") && force.contains("Tension, force [N]"));
    assert!(!force.contains("payload [N]") && !force.contains("with payload"));
}

#[test]
fn nothing_is_loaded_from_outside() {
    for results in [crate::common::caroca(|_, _| ()), crate::common::cogiro()] {
        let html = page(&results);
        assert!(attributes(&html, "src").is_empty());
        for address in attributes(&html, "href") {
            assert!(
                address.starts_with('#') || address.starts_with("data:application/json;base64,"),
                "{address}"
            );
        }
        assert!(!html.contains("url(") && !html.contains("@import"));
        assert!(html.contains("default-src 'none'; script-src 'sha256-"));
    }
}

#[test]
fn hostile_names_stay_text() {
    let hostile = "</script><script>alert('x')</script><img src=x onerror=alert(1)>";
    let results = crate::common::caroca(|study, robot| {
        study["name"] = json!(hostile);
        study["source"] = json!(hostile);
        study["samplings"]["mechanical"]["title"] = json!(hostile);
        study["surfaces"]["surface_E_rho"]["title"] = json!(hostile);
        robot["name"] = json!(hostile);
        robot["source"] = json!(hostile);
    });
    let html = page(&results);
    // The data, the worker, two packed files of which only the ends are left, and two scripts.
    assert_eq!(html.matches("<script").count(), 4);
    assert_eq!(html.matches("</script").count(), 6);
    assert!(!html.contains("<img"));
    assert!(html.contains("&lt;script&gt;alert"));
}

#[test]
fn control_and_bidirectional_characters_of_names_are_shown_in_figures_and_in_the_report() {
    let hostile = "a\u{1b}[2J\u{7}\u{202e}b & <c>";
    let results = crate::common::caroca(|study, robot| {
        study["name"] = json!(hostile);
        study["samplings"]["mechanical"]["title"] = json!(hostile);
        study["surfaces"]["surface_E_rho"]["title"] = json!(hostile);
        robot["name"] = json!(hostile);
    });
    let html = page(&results);
    assert!(!html.contains(['\u{1b}', '\u{7}', '\u{202e}']));
    let Some(StudySummary::Sampling(sampling)) = results.summary.studies.get("mechanical") else {
        panic!("no sampling")
    };
    let svg = histogram(sampling, Sheet::SCREEN).unwrap();
    // What XML 1.0 allows of control characters.
    assert!(!svg.contains(|c: char| c.is_control() && c != '\n'), "{svg}");
    for text in [&svg, &html] {
        assert!(text.contains("a\\u001b[2J\\u0007\\u202eb &amp; &lt;c&gt;"));
    }
}

#[test]
fn every_robot_and_every_part_of_a_study_has_a_report() {
    let html = page(&crate::common::cogiro());
    assert!(html.contains("CoGiRo") && html.contains("id=\"figure-all\""));
    for id in ["surfaces", "effects", "measures"] {
        assert!(!html.contains(&format!("<section id=\"{id}\"")), "{id}");
    }

    let nine = crate::common::caroca(|study, robot| {
        let cable = json!({"exit_point": [0.0, 2.0, 3.5], "anchor_point": [0.0, 0.15, 0.125]});
        robot["cables"].as_array_mut().unwrap().push(cable);
        study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "geometrical");
        study["surfaces"] = json!({});
    });
    assert!(page(&nine).contains("A9") && page(&nine).contains("9 cables"));

    let surfaces = page(&crate::common::caroca(|study, _| {
        study["samplings"] = json!({});
    }));
    assert!(
        surfaces.contains("id=\"figure-surface_rho_m\"")
            && !surfaces.contains("<section id=\"distributions\"")
    );
}

#[test]
fn the_reason_stands_in_the_place_of_a_figure_that_cannot_be_drawn() {
    let mut results = crate::common::cogiro();
    let Some(StudySummary::Sampling(sampling)) = results.summary.studies.get_mut("all") else {
        panic!("no sampling")
    };
    sampling.histogram = None;
    let html = page(&results);
    assert!(html.contains("No figure <code>all</code>: nothing to draw: histogram"));
}
