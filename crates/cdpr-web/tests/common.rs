//! Robots that differ, and the questions that a page asks about them.

use cdpr_web::Live;
use serde_json::{Value, json};

/// Names and files: eight cables without and with weight that matters, very large, prestressed, four cables,
/// a point mass in a plane, pulleys.
pub(crate) fn robots() -> Vec<(&'static str, String)> {
    let names = ["caroca", "cogiro", "fast", "ipanema-3", "four-cables", "grab", "acrobot"];
    let read = |name: &str| {
        let path = format!("{}/../../data/robots/{name}.json", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(path).unwrap()
    };
    let mut robots: Vec<_> = names.map(|name| (name, read(name))).into();
    let mut led: Value = serde_json::from_str(&robots[0].1).unwrap();
    for cable in led["cables"].as_array_mut().unwrap() {
        cable["pulley"] = json!({"radius": 0.045, "axis": [0, 0, 1]});
        cable["lead"] = json!(1.0);
    }
    robots.push(("caroca with pulleys", led.to_string()));
    robots
}

pub(crate) fn ask(live: &mut Live, question: &Value) -> Value {
    serde_json::from_str(&live.ask(&question.to_string())).unwrap()
}

/// A question of each kind; the answers of the first ones give what the later ones need.
pub(crate) fn questions(live: &mut Live) -> Vec<Value> {
    let described = ask(live, &json!({"describe": {}}))["ok"].clone();
    let (pose, free) = (&described["start"]["pose"], &described["free"]);
    let load = json!({"payload": described["start"]["payload"]});
    let hold = json!({"hold": {"pose": pose, "load": load, "free": free}});
    let held = ask(live, &hold)["ok"].clone();
    let (lengths, start) = (&held["lengths"], &held["unloaded"]["pose"]);
    let longer: Vec<f64> = lengths
        .as_array()
        .unwrap()
        .iter()
        .enumerate()
        .map(|(i, length)| length.as_f64().unwrap() * if i == 0 { 1.0005 } else { 1.0 })
        .collect();
    let mut study = described["study"].clone();
    study["replicates"] = json!(2);
    let few = !free.as_array().unwrap().is_empty();
    study["samplings"]["all"]["observations"] = json!(if few { 8 } else { 256 });
    let position = |k: usize| pose[k].as_f64().unwrap();
    let across = |k: usize| json!([position(k) - 0.2, position(k) + 0.2, 3]);
    let slice = json!({"normal": "z", "at": pose[2], "quaternion": [1, 0, 0, 0], "u": across(0), "v": across(1),
                       "rows": [0, 3], "load": load, "free": free});
    vec![
        json!({"describe": {}}),
        hold,
        json!({"stand": {"lengths": lengths, "load": load, "start": start}}),
        json!({"wind": {"lengths": [lengths, longer], "load": [load, load], "start": start}}),
        json!({"modes": {"lengths": lengths, "load": load, "start": start}}),
        json!({"study": {"text": study}}),
        json!({"observe": {"replicate": 0}}),
        json!({"observe": {"replicate": 1}}),
        json!({"table": {}}),
        json!({"slice": slice}),
    ]
}

/// The greatest difference of two answers, and where it is: of a number relative to the greatest of its list
/// and to one; infinite where they are not alike.
pub(crate) fn farthest(one: &Value, other: &Value) -> (f64, String) {
    let worst = |found: Vec<(f64, String)>| {
        found
            .into_iter()
            .fold((0.0, String::new()), |worst, next| if next.0 > worst.0 { next } else { worst })
    };
    match (one, other) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
            ((a - b).abs() / a.abs().max(1.0), String::new())
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => worst(
            a.iter()
                .zip(b)
                .enumerate()
                .map(|(i, (a, b))| {
                    let (distance, place) = farthest(a, b);
                    (distance, format!("[{i}]{place}"))
                })
                .collect(),
        ),
        // Residuals are rounding.
        (Value::Object(a), Value::Object(_)) if a.contains_key("closure") => (0.0, String::new()),
        // Motions of nearly equal stiffness or frequency turn into each other with rounding.
        (Value::Object(a), Value::Object(b)) if a.contains_key("translation") => {
            let own = ["stiffness", "frequency"].into_iter().find(|key| a.contains_key(*key));
            own.map_or((f64::INFINITY, String::new()), |key| farthest(&a[key], &b[key]))
        }
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => worst(
            a.iter()
                .map(|(key, a)| {
                    let (distance, place) = farthest(a, &b[key]);
                    let distance = distance / amplified(key);
                    (distance, format!(".{key}{place}"))
                })
                .collect(),
        ),
        (a, b) if a == b => (0.0, String::new()),
        (a, b) => (f64::INFINITY, format!(": {a} and {b}")),
    }
}

/// By how much the rounding of poses and lengths may be larger in a field: in millimetres, in the tensions of
/// an optimum, and in differences of nearly equal numbers, such as effects and the least of eigenvalues.
fn amplified(key: &str) -> f64 {
    match key {
        "effects" | "least_stiffness" | "softest" | "motions" | "frequencies" => 1e5,
        "summary" => 1e3,
        _ if key.ends_with("_mm") => 1e3,
        _ if key.contains("tension") => 10.0,
        _ => 1.0,
    }
}
