//! The report in a browser.

use crate::common;
use crate::explorer::lead_over_pulleys;
use crate::page::{Page, chromium, screenshots};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Where the camera of the robot is, from its target.
const EYE: &str = "(() => { const { camera, orbit } = document.getElementById('plot-robot').robot.view; \
    return camera.position.clone().sub(orbit.target).toArray(); })()";

/// Heights of all points of cables that are drawn.
const HEIGHTS: &str = "(() => { const { object } = document.getElementById('plot-robot').robot.view.cables.lines; \
    const { array } = object.geometry.attributes.instanceStart.data; \
    return [...array.slice(0, 6 * object.geometry.instanceCount)].filter((_, k) => k % 3 === 2); })()";

fn write_report(folder: &Path, name: &str, results: &cdpr_study::Results) -> PathBuf {
    let path = folder.join(name).with_extension("html");
    std::fs::write(&path, cdpr_report::report(results).unwrap()).unwrap();
    path
}

#[test]
fn the_report_is_whole_quiet_and_turns_in_a_browser() {
    let folder = screenshots();
    let results = common::caroca(|study, _| {
        study["samplings"].as_object_mut().unwrap().shift_remove("geometrical").unwrap();
    });
    let file = write_report(&folder, "caroca", &results);
    let mut page = Page::open(chromium());

    is_whole_in_each_width_and_scheme(&mut page, &folder, &file);
    page.surround(1400, "light");
    page.show(&file);
    turns_by_mouse_and_keys(&mut page);
    stretches_the_sag(&mut page);

    assert_eq!(page.complaints(&file), [""; 0]);

    let other = write_report(&folder, "cogiro", &common::cogiro());
    page.events.clear();
    page.show(&other);
    page.photograph(&folder, "cogiro-1400-light");
    assert_eq!(page.complaints(&other), [""; 0]);
}

fn is_whole_in_each_width_and_scheme(page: &mut Page, folder: &Path, file: &Path) {
    for (width, scheme) in [(1400, "light"), (1400, "dark"), (400, "dark"), (400, "light")] {
        page.surround(width, scheme);
        // Opened in the light or in the dark, the other comes while it is open.
        if (width == 1400) == (scheme == "light") {
            page.show(file);
        }
        page.photograph(folder, &format!("caroca-{width}-{scheme}"));
        let sizes = page.evaluate(
            "[...document.querySelectorAll('figure')].map((figure) => [figure.id, \
             ...['.drawing:not([hidden]) svg', '.plot:not([hidden])'] \
             .map((part) => figure.querySelector(part)).filter((part) => part) \
             .map((part) => part.getBoundingClientRect()) \
             .map(({ width, height }) => Math.min(width, height))])",
        );
        let sizes = sizes.as_array().unwrap();
        // The robot, three figures a sampling, two surfaces, anchor and exit points.
        assert_eq!(sizes.len(), 1 + 3 * 2 + 2 + 2, "{sizes:?}");
        assert!(sizes.iter().all(|figure| figure[1].as_f64().unwrap_or(0.0) > 100.0), "{sizes:?}");
        let overflow =
            page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth");
        assert_eq!(overflow, 0, "the page scrolls sideways at {width} px");
        let dark = page.evaluate("getComputedStyle(document.body).backgroundColor") != "rgb(255, 255, 255)";
        assert_eq!(dark, scheme == "dark");
    }
}

fn turns_by_mouse_and_keys(page: &mut Page) {
    page.evaluate(
        "document.getElementById('plot-robot').scrollIntoView({behavior: 'instant', block: 'center'})",
    );
    page.wait_for("document.getElementById('plot-robot').dataset.drawn");
    let before = page.evaluate(EYE);
    let middle = page.evaluate(
        "(() => { const { x, y, width, height } = document.getElementById('plot-robot') \
         .getBoundingClientRect(); return [x + width / 2, y + height / 2]; })()",
    );
    let (x, y) = (middle[0].as_f64().unwrap(), middle[1].as_f64().unwrap());
    page.mouse("mousePressed", x, y);
    for step in 1..=6 {
        page.mouse("mouseMoved", x + 25.0 * f64::from(step), y);
    }
    page.mouse("mouseReleased", x + 150.0, y);
    page.wait_for(&format!("JSON.stringify({EYE}) !== '{before}'"));
    let turned = page.evaluate(EYE);
    let length = |eye: &Value| (0..3).map(|i| eye[i].as_f64().unwrap().powi(2)).sum::<f64>().sqrt();
    assert!(
        (length(&turned) / length(&before) - 1.0).abs() < 0.02,
        "turned, not zoomed: {before} to {turned}"
    );
    // Keys turn it, too.
    page.evaluate(
        "document.getElementById('plot-robot') \
         .dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft' }))",
    );
    page.wait_for(&format!("JSON.stringify({EYE}) !== '{turned}'"));
}

fn sets_the_sag(page: &mut Page, step: u32) {
    page.evaluate(&format!(
        "(() => {{ const sag = document.getElementById('sag'); sag.value = {step}; \
         sag.dispatchEvent(new Event('input', {{ bubbles: true }})); }})()"
    ));
}

/// The control of the sag redraws the robot and says what it stretches; it begins with the true sag.
fn stretches_the_sag(page: &mut Page) {
    let sum = format!("{HEIGHTS}.reduce((sum, z) => sum + z, 0)");
    let factor = "document.getElementById('sag-times').textContent";
    assert_eq!(page.evaluate(factor), "\u{d7}1 (true)");
    let drawn = page.evaluate(&sum).as_f64().unwrap();
    sets_the_sag(page, 6);
    assert_eq!(page.evaluate(factor), "\u{d7}100");
    assert!(page.evaluate(&sum).as_f64().unwrap() < drawn, "a cable that sags more is lower");
}

#[test]
fn a_cable_lies_on_its_pulley_however_large_its_sag_is_drawn() {
    let results = common::caroca(|study, robot| {
        lead_over_pulleys(robot);
        let all = study["samplings"].as_object_mut().unwrap();
        let rest: Vec<_> = all.keys().skip(1).cloned().collect();
        rest.iter().for_each(|name| drop(all.shift_remove(name)));
        for field in ["surfaces", "sensitivity"] {
            study.as_object_mut().unwrap().remove(field);
        }
        study["replicates"] = json!(0);
    });
    let exits = results.study.robot.cables.iter().map(|cable| cable.exit_point.z);
    let highest = exits.fold(f64::NEG_INFINITY, f64::max);
    let file = write_report(&screenshots(), "caroca-pulleys", &results);
    let mut page = Page::open(chromium());
    page.surround(1400, "light");
    page.show(&file);
    page.evaluate("document.getElementById('plot-robot').scrollIntoView({behavior: 'instant'})");
    page.wait_for("document.getElementById('plot-robot').dataset.drawn");
    sets_the_sag(&mut page, 6);
    let range = page.evaluate(&format!("(() => {{ const z = {HEIGHTS}; return Math.max(...z); }})()"));
    // A wheel of this radius is at or above its exit point; nothing sags upwards.
    assert!(range.as_f64().unwrap() < highest + 0.1, "{range} m, exit points up to {highest} m");
    page.picture(&screenshots(), "caroca-pulleys");
}

/// Deflection, rotation and tensions on screen.
const ON_SCREEN: &str =
    "(document.querySelector('#live-robot .numbers')?.textContent ?? '').split('least stiffness')[0]";

#[test]
fn the_robot_of_a_report_moves_and_goes_on_where_it_was_left() {
    let folder = screenshots();
    let mut page = Page::open(chromium());
    for (name, results) in [("caroca-live", common::caroca(|_, _| ())), ("cogiro-live", common::cogiro())] {
        let file = write_report(&folder, name, &results);
        let size = std::fs::metadata(&file).unwrap().len();
        println!("{name}: {size} bytes");
        assert!(size < 2_500_000);
        page.events.clear();
        page.surround(1400, "light");
        page.show(&file);
        page.evaluate("document.getElementById('live-open').click()");
        page.wait_for("document.querySelector('#live-robot canvas')");
        // The numbers of the report's own robot at its pose, by the module.
        let nominal = results.study.nominal(&results.study.sampling_names().next().unwrap()).unwrap();
        let expected = format!("{:.3}", 1e3 * nominal.deflection.magnitude());
        page.wait_for(&format!("({ON_SCREEN}).includes('{expected}')"));
        for (width, scheme) in [(1400, "dark"), (390, "light"), (1400, "light")] {
            page.surround(width, scheme);
            page.picture(&folder, &format!("{name}-{width}-{scheme}"));
        }
        let before = page.evaluate(ON_SCREEN);
        page.evaluate(
            "document.querySelector('#live-robot .surface').dispatchEvent(\
             new KeyboardEvent('keydown', { key: 'ArrowRight', bubbles: true }))",
        );
        page.wait_for(&format!("({ON_SCREEN}) !== {before}"));
        let moved = page.evaluate(ON_SCREEN);
        page.evaluate("document.getElementById('live-close').click()");
        page.wait_for("!document.querySelector('#live-robot canvas')");
        page.evaluate("document.getElementById('live-open').click()");
        page.wait_for(&format!("({ON_SCREEN}) === {moved}"));
        assert_eq!(page.complaints(&file), [""; 0]);
    }
}
