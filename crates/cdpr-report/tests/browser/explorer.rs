//! The explorer in a browser: its answers are those of the native models, and it is whole and quiet.

use crate::common::data;
use crate::page::{Page, chromium, screenshots};
use cdpr_report::{Explored, explorer};
use cdpr_web::Live;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Poses on a path.
const POSES: usize = 200;

/// Robots that differ: eight cables, weight that matters, very large, four cables, pulleys.
fn robots() -> Vec<(&'static str, Value)> {
    let mut robots: Vec<_> =
        ["caroca", "cogiro", "fast", "grab"].map(|name| (name, data(&format!("robots/{name}.json")))).into();
    let mut led = robots[0].1.clone();
    lead_over_pulleys(&mut led);
    robots.push(("caroca-pulleys", led));
    robots
}

/// Leads all cables of a robot over pulleys.
pub(crate) fn lead_over_pulleys(robot: &mut Value) {
    for cable in robot["cables"].as_array_mut().unwrap() {
        cable["pulley"] = json!({"radius": 0.045, "axis": [0, 0, 1]});
        cable["lead"] = json!(1.0);
    }
}

pub(crate) fn write_page(name: &str, robot: &Value) -> PathBuf {
    let (file, text) = (format!("{name}.json"), robot.to_string());
    let explored = Explored { name, file: &file, robot: &text, study: None };
    let path = screenshots().join(format!("explorer-{name}.html"));
    std::fs::write(&path, explorer(&explored, "0").unwrap()).unwrap();
    path
}

/// Poses from the first one on, along a line of a tenth of the platform's way to the middle of its cables.
fn path(described: &Value) -> Vec<Value> {
    let start = described["start"]["pose"].as_array().unwrap();
    let exits = described["exits"].as_array().unwrap();
    let reach = exits.iter().map(|exit| exit[0].as_f64().unwrap().abs()).fold(0.0, f64::max);
    let pose = |k: usize| {
        let mut pose = start.clone();
        pose[0] = json!(pose[0].as_f64().unwrap() + 0.05 * reach * k as f64 / POSES as f64);
        let load = json!({"payload": described["start"]["payload"]});
        json!({"hold": {"pose": pose, "load": load, "free": described["free"]}})
    };
    (0..POSES).map(pose).collect()
}

/// Asks a worker of its own in the page, with the module that the page has; the answers and its time [ms].
const ASK: &str = r#"(asks) => new Promise(async (done, failed) => {
  const text = (id) => document.getElementById(id).textContent;
  const module = await WebAssembly.compile(await packed.bytes("module"));
  const worker = new Worker(URL.createObjectURL(new Blob([text("worker")], { type: "text/javascript" })));
  worker.onmessage = ({ data }) => {
    if (data.broken) failed(data.broken);
    else if (data.answers) done(data);
    else worker.postMessage({ id: 1, version: 1, robot: JSON.stringify(JSON.parse(text("data")).robot), asks });
  };
  worker.postMessage({ module });
})"#;

/// The worst difference of two numbers, relative to one and to the number.
fn difference(one: &Value, other: &Value) -> f64 {
    let (one, other) = (one.as_f64().unwrap(), other.as_f64().unwrap());
    (one - other).abs() / one.abs().max(1.0)
}

#[test]
fn the_explorer_answers_as_the_program_and_is_quiet() {
    let mut page = Page::open(chromium());
    for (name, robot) in robots() {
        let file = write_page(name, &robot);
        page.events.clear();
        page.surround(1400, "light");
        page.show(&file);
        page.wait_for("document.querySelector('#explorer .numbers')?.textContent.match(/mm|µm/) != null");
        println!("{name}: numbers after {:.0} ms", page.evaluate("performance.now()").as_f64().unwrap());
        let mut live = Live::new(&robot.to_string()).unwrap();
        let native = |live: &mut Live, ask: &Value| -> Value {
            serde_json::from_str(&live.ask(&ask.to_string())).unwrap()
        };
        let described = native(&mut live, &json!({"describe": {}}))["ok"].clone();
        let asks = path(&described);
        let answered = page.evaluate(&format!("({ASK})({})", json!(asks)));
        for (ask, found) in asks.iter().zip(answered["answers"].as_array().unwrap()) {
            let expected = native(&mut live, ask);
            assert_eq!(found["error"], expected["error"], "{name}: {ask}");
            if expected["ok"].is_null() {
                continue;
            }
            let [found, expected] = [&found["ok"], &expected["ok"]];
            for k in 0..3 {
                assert!(
                    difference(&expected["displacement"][k], &found["displacement"][k]) < 1e-12,
                    "{name}"
                );
            }
            assert!(difference(&expected["rms"], &found["rms"]) < 1e-12, "{name}");
        }
        println!("{name}: {:.2} ms a pose", answered["milliseconds"].as_f64().unwrap() / POSES as f64);
        if described["free"].as_array().unwrap().is_empty() {
            // Five replicates of 2048 observations in each of two workers.
            let asks = |first: usize| -> Value {
                let replicates = (first..first + 5).map(|k| json!({"observe": {"replicate": k}}));
                [json!({"study": {"text": described["study"]}})].into_iter().chain(replicates).collect()
            };
            if name != "caroca-pulleys" {
                let both = format!("Promise.all([({ASK})({}), ({ASK})({})])", asks(1), asks(6));
                let observed = page.evaluate(&both);
                let times = [0, 1].map(|worker| {
                    let answered = &observed[worker];
                    assert!(answered["answers"][5]["ok"]["summary"]["mean"].is_f64(), "{name}");
                    answered["milliseconds"].as_f64().unwrap()
                });
                println!("{name}: {:.0} ms for 20480 observations in two workers", times[0].max(times[1]));
            }
        }
        for (width, scheme) in [(1400, "light"), (1400, "dark"), (390, "light")] {
            page.surround(width, scheme);
            page.photograph(&screenshots(), &format!("explorer-{name}-{width}-{scheme}"));
            let overflow =
                page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth");
            assert_eq!(overflow, 0, "{name} scrolls sideways at {width} px");
        }
        assert_eq!(page.complaints(&file), [""; 0]);
        let size = std::fs::metadata(&file).unwrap().len();
        println!("{name}: {size} bytes");
        assert!(size < 3_000_000);
    }
}
