//! The report in a browser.

use crate::common;
use crate::explorer::lead_over_pulleys;
use crate::page::{Page, chromium, screenshots};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

const EYE: &str = "(() => { const robot = document.getElementById('plot-robot'); \
    const { x, y, z } = robot._fullLayout.scene._scene.getCamera().eye; \
     return [x, y, z]; })()";

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

    page.evaluate("document.querySelector('[data-surface=surface_E_rho] [data-show=map]').click()");
    assert_eq!(page.evaluate("document.getElementById('plot-surface_E_rho').hidden"), true);
    let map = "document.querySelector('[data-surface=surface_E_rho] .map svg') \
        .getBoundingClientRect().height > 100";
    assert_eq!(page.evaluate(map), true);
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

/// The control of the sag redraws the robot and says what it stretches.
fn stretches_the_sag(page: &mut Page) {
    let heights = "document.getElementById('plot-robot').data \
        .find((trace) => trace.line?.colorscale).z.reduce((sum, z) => sum + z, 0)";
    let stretched = page.evaluate(heights).as_f64().unwrap();
    page.evaluate(
        "(() => { const sag = document.getElementById('sag'); sag.value = 0; \
         sag.dispatchEvent(new Event('input', { bubbles: true })); })()",
    );
    assert!(
        page.evaluate(heights).as_f64().unwrap() > stretched,
        "the true sag is less than the stretched one"
    );
    assert_eq!(page.evaluate("document.getElementById('sag-times').textContent"), "\u{d7}1 (true)");
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
    let drawn = "document.getElementById('plot-robot').data.find((trace) => trace.line?.colorscale).z";
    let range = page.evaluate(&format!("[Math.min(...{drawn}), Math.max(...{drawn})]"));
    let stretched = page.evaluate("document.getElementById('sag-times').textContent");
    assert_ne!(stretched, "\u{d7}1 (true)");
    // A wheel of this radius is beside or above its exit point; nothing sags upwards.
    assert!(range[1].as_f64().unwrap() < highest + 0.1, "{range} beside {highest}, sag {stretched}");
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
        assert!(size < 3_500_000);
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
