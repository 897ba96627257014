//! The explorer in windows of all sizes: the robot is most of the page, and nothing covers it.

use crate::fields::caroca;
use crate::page::Page;
use serde_json::{Value, json};

/// Windows: width, height [px], and the least share of the view in the window.
const WINDOWS: [(u32, u32, f64); 5] =
    [(1920, 1080, 0.6), (1440, 900, 0.6), (1000, 700, 0.45), (760, 480, 0.35), (390, 844, 0.4)];

fn resize(page: &mut Page, width: u32, height: u32) {
    let window = json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": false});
    page.call("Emulation.setDeviceMetricsOverride", window);
    let narrow = width < 760;
    page.wait_for(&format!(
        "innerWidth === {width} && document.querySelector('.cdprx').classList.contains('narrow') === {narrow}"
    ));
}

/// The share of the view in the window, of what is in the window.
const SHARE: &str = "(() => { const { left, right, top, bottom } = \
    document.querySelector('.picture').getBoundingClientRect(); \
    const inside = (from, to, end) => Math.max(0, Math.min(to, end) - Math.max(from, 0)); \
    return inside(left, right, innerWidth) * inside(top, bottom, innerHeight) / (innerWidth * innerHeight); \
    })()";

#[test]
fn the_view_is_most_of_a_window_wherever_the_panels_are_scrolled() {
    let (mut page, _) = caroca();
    for (width, height, least) in WINDOWS {
        resize(&mut page, width, height);
        for part in [0.0, 0.5, 1.0] {
            page.evaluate(&format!(
                "(() => {{ const list = document.querySelector('.panels'); \
                 list.scrollTop = {part} * list.scrollHeight; }})()"
            ));
            let share = page.evaluate(SHARE).as_f64().unwrap();
            assert!(share > least, "{width} x {height}: {share}");
        }
        let overflow = page.evaluate(
            "[document.documentElement.scrollWidth - innerWidth, \
             document.documentElement.scrollHeight - innerHeight, \
             document.querySelector('.panels').scrollWidth - document.querySelector('.panels').clientWidth]",
        );
        assert_eq!(overflow, json!([0, 0, 0]), "{width} x {height}");
    }
}

#[test]
fn messages_never_cover_the_view_nor_change_its_size() {
    let (mut page, _) = caroca();
    let size = "(() => { const { width, height } = document.querySelector('.picture') \
        .getBoundingClientRect(); return [width, height]; })()";
    // As many as a pose without tensions, a platform below the floor and old results have together.
    let messages = "(() => { const list = document.querySelector('.banners'); \
        list.querySelectorAll('.more').forEach((one) => one.remove()); \
        for (let k = 0; k < 9; k++) { const one = document.createElement('div'); \
        one.className = 'banner more'; \
        one.textContent = 'no tensions between 50 N and 15000.763 N hold the platform at this pose '.repeat(3); \
        list.append(one); } \
        const [a, b] = ['.picture', '.banners'].map((name) => \
        document.querySelector(name).getBoundingClientRect()); \
        const across = Math.min(a.right, b.right) - Math.max(a.left, b.left); \
        const along = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top); \
        return { covered: across > 0 && along > 0, shown: b.height > 20 && b.bottom <= innerHeight, \
        scrolls: list.scrollHeight > list.clientHeight }; })()";
    for (width, height, _) in WINDOWS {
        page.evaluate("document.querySelectorAll('.banner.more').forEach((one) => one.remove())");
        resize(&mut page, width, height);
        let before = page.evaluate(size);
        let found = page.evaluate(messages);
        assert_eq!(
            found,
            json!({"covered": false, "shown": true, "scrolls": true}),
            "{width} x {height}: {found}"
        );
        assert_eq!(page.evaluate(size), before, "{width} x {height}");
    }
}

#[test]
fn a_dark_page_is_printed_in_dark_on_white() {
    let (mut page, _) = caroca();
    let color = "document.querySelector('.chart text').getAttribute('fill')";
    page.wait_for("document.querySelector('.chart text')");
    let dark = page.evaluate(color);
    page.evaluate("dispatchEvent(new Event('beforeprint'))");
    assert_eq!([page.evaluate(color), dark.clone()], [json!("#59636e"), json!("#9aa5b1")]);
    // The middle of the sky, as it is printed.
    let sky = "[...document.querySelector('canvas.paper').getContext('2d').getImageData(9, 9, 1, 1).data]";
    assert!(page.evaluate(sky)[0].as_f64().unwrap() > 200.0);
    page.evaluate("dispatchEvent(new Event('afterprint'))");
    assert_eq!(page.evaluate(color), dark);
    assert_eq!(page.evaluate("document.querySelector('canvas.paper')"), Value::Null);
}
