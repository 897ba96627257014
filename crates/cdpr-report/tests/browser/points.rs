//! Exit and anchor points under a real pointer.

use crate::fields::caroca;
use crate::page::Page;
use serde_json::{Value, json};

/// The chosen point: its numbers in the panel, and the pixel at which the view shows it.
const CHOSEN: &str = r#"(() => {
  const label = document.querySelector(".name.chosen");
  const [x, y] = label.style.transform.match(/-?[\d.]+/g).map(Number);
  const { left, top } = document.querySelector(".surface").getBoundingClientRect();
  const place = ["x", "y", "z"].map((axis) => Number(field(`point ${axis}`).input.value));
  return { place, pixel: [left + x - 12, top + y + 34], text: label.textContent };
})()"#;

/// The changed points in the address.
const SAVED: &str = r#"(() => {
  const hash = location.hash.split("state=")[1] ?? "";
  const saved = hash ? JSON.parse(atob(hash.replaceAll("-", "+").replaceAll("_", "/"))) : {};
  return saved.changes?.points ?? null;
})()"#;

fn choose(page: &mut Page, name: &str) -> Value {
    page.evaluate(&format!(
        "(() => {{ document.querySelector('.stagebar input[value=points]').click(); \
         const list = [...document.querySelectorAll('.field select')] \
         .find((one) => one.querySelector('option[value={name}]')); \
         list.closest('details').open = true; list.value = '{name}'; \
         list.dispatchEvent(new Event('change')); }})()"
    ));
    page.wait_for(&format!("document.querySelector('.name.chosen').textContent.startsWith('{name} ')"));
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
    page.evaluate(CHOSEN)
}

fn drag(page: &mut Page, chosen: &Value, by: [f64; 2]) {
    let [x, y] = [0, 1].map(|k| chosen["pixel"][k].as_f64().unwrap());
    page.mouse("mouseMoved", x, y);
    page.mouse("mousePressed", x, y);
    for step in 1..=5 {
        page.mouse("mouseMoved", x + by[0] * f64::from(step) / 5.0, y + by[1] * f64::from(step) / 5.0);
    }
    page.mouse("mouseReleased", x + by[0], y + by[1]);
}

#[test]
fn a_point_that_is_dragged_changes_the_robot_until_it_is_undone() {
    let (mut page, _) = caroca();
    let numbers = "document.querySelector('.numbers').textContent.split('least')[0]";
    for (name, by) in [("b2", [-40.0, 25.0]), ("a5", [12.0, -9.0])] {
        let begin = page.evaluate(numbers);
        let chosen = choose(&mut page, name);
        drag(&mut page, &chosen, by);
        // The mark goes where the hand goes, and the address follows.
        let [x, y] = [0, 1].map(|k| chosen["pixel"][k].as_f64().unwrap() + by[k]);
        page.wait_for(&format!(
            "(() => {{ const {{ pixel, place }} = {CHOSEN}; \
             return Math.hypot(pixel[0] - {x}, pixel[1] - {y}) < 4 \
             && JSON.stringify(({SAVED})?.{name}) === JSON.stringify(place); }})()"
        ));
        assert_ne!(page.evaluate(CHOSEN)["place"], chosen["place"], "{name}");
        page.wait_for(&format!("{numbers} !== {begin}"));
        page.press("z", 2);
        page.wait_for(&format!("{numbers} === {begin} && ({SAVED}) === null"));
        assert_eq!(page.evaluate(CHOSEN)["place"], chosen["place"], "{name}");
    }
    // A point that is typed is the same.
    choose(&mut page, "b1");
    page.evaluate("enter('point z')");
    page.write("2,9");
    page.press("Enter", 0);
    page.wait_for(&format!("({SAVED})?.b1?.[2] === 2.9"));
    assert_eq!(page.evaluate(SAVED)["b1"][2], json!(2.9));
}
