//! Every kind of report has the style of all: as wide as its window lets it, in the light and in the dark.

use crate::common;
use crate::page::{Page, chromium, screenshots};
use cdpr_report::{analysis_report, report};
use cdpr_sensitivity::Analyser;
use cdpr_study::{TableRequest, analyse_table, open_table};
use serde_json::json;
use std::path::{Path, PathBuf};

/// The reports of an analysis and of a study.
fn reports() -> [PathBuf; 2] {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/tables/ishigami.csv");
    let table = open_table(&path, None).unwrap();
    let request = TableRequest {
        inputs: Vec::new(),
        outputs: vec!["y".to_owned()],
        limits: Vec::new(),
        vector: Vec::new(),
        analyser: Analyser::new(1),
    };
    let analysis = analysis_report(&table, &analyse_table(&table, &request).unwrap());
    let study = report(&common::cogiro()).unwrap();
    [("kind-analysis", analysis), ("kind-study", study)].map(|(name, text)| {
        let path = screenshots().join(format!("{name}.html"));
        std::fs::write(&path, text).unwrap();
        path
    })
}

/// Width of the text, how far the page scrolls sideways, and the grounds of all drawings.
const SEEN: &str = "(() => { \
    const grounds = [...document.querySelectorAll('.drawing svg > rect:first-of-type')]; \
    return { \
    width: document.querySelector('main').getBoundingClientRect().width, \
    overflow: document.documentElement.scrollWidth - document.documentElement.clientWidth, \
    contents: document.querySelectorAll('nav a').length, \
    sections: document.querySelectorAll('main > section').length, \
    grounds: [...new Set(grounds.map((one) => getComputedStyle(one).fill))], \
    paper: getComputedStyle(document.body).backgroundColor }; })()";

#[test]
fn every_kind_of_report_has_the_width_of_its_window_and_its_colours() {
    let mut page = Page::open(chromium());
    for file in reports() {
        page.events.clear();
        for (width, least) in [(390, 340.0), (1000, 900.0), (1440, 850.0), (1920, 850.0)] {
            for scheme in ["light", "dark"] {
                page.surround(width, scheme);
                page.show(&file);
                let seen = page.evaluate(SEEN);
                let name = format!("{} at {width} px, {scheme}", file.display());
                assert!(seen["width"].as_f64().unwrap() > least, "{name}: {seen}");
                assert_eq!(seen["overflow"], 0, "{name}");
                // A list of the sections, and of the beginning.
                let sections = seen["sections"].as_u64().unwrap();
                assert!(sections > 0 && seen["contents"] == json!(sections + 1), "{name}: {seen}");
                assert_eq!(seen["grounds"], json!([seen["paper"]]), "{name}");
            }
        }
        assert_eq!(page.complaints(&file), [""; 0]);
    }
}
