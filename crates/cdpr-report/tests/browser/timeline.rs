//! A trajectory in the explorer: its tensions are those of the native model, and it plays.

use crate::common::data;
use crate::fields::caroca;
use crate::page::Page;
use cdpr_web::Live;
use serde_json::{Value, json};

/// Poses of the table, as many as the page asks for.
const POSES: usize = 130;

/// Position [m] at a row of the table.
fn place(row: usize) -> [f64; 3] {
    let share = row as f64 / (POSES - 1) as f64;
    [1.5 * share, -0.8 * share, 1.75 + 0.6 * share]
}

/// A table with semicolons, millimetres and decimal commas.
fn table() -> String {
    let row = |row: usize| {
        let [x, y, z] = place(row);
        format!("{};{:.3};{:.3};{:.3}", row as f64 / 10.0, 1e3 * x, 1e3 * y, 1e3 * z).replace('.', ",")
    };
    let rows: Vec<String> = (0..POSES).map(row).collect();
    format!("t_s;x_mm;y_mm;z_mm\n{}\n", rows.join("\n"))
}

fn paste(page: &mut Page, text: &str) {
    page.evaluate(&format!(
        "(() => {{ const area = document.querySelector('textarea'); area.closest('details').open = true; \
         area.value = {}; area.dispatchEvent(new Event('change')); }})()",
        json!(text)
    ));
}

/// The position in the fields, the time, and the sentence about the trajectory.
const SHOWN: &str = r#"(() => ({
  position: ["x", "y", "z"].map((name) => Number(field(name).input.value)),
  time: Number(document.querySelector(".clock").textContent.split(" ")[0]),
  plays: document.querySelector(".play").textContent.includes("Pause"),
  words: document.querySelector(".timeline .hint").textContent,
}))()"#;

#[test]
fn tensions_along_a_trajectory_are_those_of_the_native_model() {
    let (mut page, _) = caroca();
    paste(&mut page, &table());
    page.wait_for(&format!("({SHOWN}).words.startsWith('{POSES} poses; ')"));
    let mut live = Live::new(&data("robots/caroca.json").to_string()).unwrap();
    let (mut least, mut greatest) = (f64::INFINITY, 0.0_f64);
    for row in 0..POSES {
        let [x, y, z] = place(row).map(|value| (1e6 * value).round() / 1e6);
        let ask = json!({"hold": {"pose": [x, y, z, 1, 0, 0, 0], "load": {"payload": 18}}});
        let answer: Value = serde_json::from_str(&live.ask(&ask.to_string())).unwrap();
        for cable in answer["ok"]["loaded"]["cables"].as_array().unwrap() {
            let tension = cable["tension"].as_f64().unwrap();
            (least, greatest) = (least.min(tension), greatest.max(tension));
        }
    }
    let words = page.evaluate(SHOWN)["words"].as_str().unwrap().to_owned();
    let numbers: Vec<f64> = words.split([' ', ';']).filter_map(|word| word.parse().ok()).collect();
    for (found, expected) in numbers[1..3].iter().zip([least, greatest]) {
        assert!((found / expected - 1.0).abs() < 0.006, "{words}: {least} to {greatest}");
    }
    // A line for each cable, and the view still most of the window.
    let lines = page.evaluate("document.querySelectorAll('.track path').length");
    assert_eq!(lines, 8);
    let window = json!({"width": 1440, "height": 900, "deviceScaleFactor": 1, "mobile": false});
    page.call("Emulation.setDeviceMetricsOverride", window);
    page.wait_for("innerHeight === 900");
    let share = "(() => { const { width, height } = document.querySelector('.picture') \
        .getBoundingClientRect(); return width * height / (innerWidth * innerHeight); })()";
    assert!(page.evaluate(share).as_f64().unwrap() > 0.5);
}

#[test]
fn a_trajectory_plays_and_is_scrubbed_and_its_numbers_follow() {
    let (mut page, mut deflection) = caroca();
    paste(&mut page, "x,y,z,t\n0,0,1.75,0\n0,0,2.75,4\n");
    page.wait_for(&format!("({SHOWN}).words.startsWith('121 poses; ')"));
    page.evaluate("document.querySelector('.play').click()");
    // While it plays, what is observed is of the state before, and says so.
    let stale = "document.querySelector('.charts').classList.contains('stale')";
    page.wait_for(&format!("({SHOWN}).time > 0.3 && ({SHOWN}).plays && {stale}"));
    page.evaluate("document.querySelector('.play').click()");
    page.wait_for(&format!("!({SHOWN}).plays && !{stale}"));
    let shown = page.evaluate(SHOWN);
    let [z, time] = [&shown["position"][2], &shown["time"]].map(|value| value.as_f64().unwrap());
    assert!((z - 1.75 - 0.25 * time).abs() < 3e-3, "{shown}");
    // Scrubbed to its middle.
    let middle = page.evaluate(
        "(() => { const { left, top, width } = document.querySelector('.track').getBoundingClientRect(); \
         return [left + 46 + (width - 54) / 2, top + 30]; })()",
    );
    let [x, y] = [0, 1].map(|k| middle[k].as_f64().unwrap());
    page.mouse("mousePressed", x, y);
    page.mouse("mouseReleased", x, y);
    page.wait_for(&format!("Math.abs(({SHOWN}).time - 2) < 0.02"));
    let z = page.evaluate(SHOWN)["position"][2].as_f64().unwrap();
    assert!((z - 2.25).abs() < 5e-3, "{z}");
    let numbers = "document.querySelector('.numbers').textContent";
    page.wait_for(&format!("{numbers}.startsWith('deflection{}')", deflection(z)));
    // The end of the drag is a step of undo, and the table another.
    for _ in 0..3 {
        page.press("z", 2);
    }
    page.wait_for("document.querySelector('.timeline').hidden");
}

#[test]
fn points_drawn_in_the_view_make_a_trajectory() {
    let (mut page, _) = caroca();
    page.evaluate("document.querySelector('.stagebar input[value=draw]').click()");
    let middle = page.evaluate(
        "(() => { const { left, top, width, height } = document.querySelector('.surface') \
         .getBoundingClientRect(); return [left + width / 2, top + height / 2]; })()",
    );
    let [x, y] = [0, 1].map(|k| middle[k].as_f64().unwrap());
    for step in [60.0, -50.0] {
        page.mouse("mousePressed", x + step, y + 40.0);
        page.mouse("mouseReleased", x + step, y + 40.0);
    }
    page.wait_for("!document.querySelector('.timeline').hidden");
    let saved = r#"(() => {
      const hash = location.hash.split("state=")[1] ?? "";
      return hash ? JSON.parse(atob(hash.replaceAll("-", "+").replaceAll("_", "/"))).trajectory ?? [] : [];
    })()"#;
    page.wait_for(&format!("{saved}.length === 3"));
    let rows = page.evaluate(saved);
    // From where the platform was, at its height, at times that follow from the speed.
    assert_eq!(rows[0], json!([0, 0, 0, 1.75, 0, 0, 0]));
    for k in 1..3 {
        assert_eq!(rows[k][3], 1.75);
        assert!(rows[k][0].as_f64().unwrap() > rows[k - 1][0].as_f64().unwrap(), "{rows}");
    }
}
