//! Answers of robots that differ, against the models that they come from, and refusals.

use crate::common::{ask, farthest, questions, robots};
use cdpr_robot::{Pose, Robot};
use cdpr_statics::{Load, deflection};
use cdpr_web::Live;
use serde_json::{Value, json};

#[test]
fn every_kind_of_question_is_answered_by_robots_that_differ() {
    for (name, robot) in robots() {
        let mut live = Live::new(&robot).unwrap();
        for question in questions(&mut live) {
            let answer = ask(&mut live, &question);
            assert!(answer["ok"].is_object(), "{name}: {question}: {}", answer["error"]);
        }
    }
}

#[test]
fn a_deflection_is_that_of_the_model() {
    let (_, text) = robots().swap_remove(1);
    let robot = Robot::from_json(&text).unwrap();
    let expected = deflection(&robot, &Pose::at(1.0, -0.5, 1.5), &Load::payload(100.0)).unwrap();
    let question = json!({"hold": {"pose": [1.0, -0.5, 1.5, 1, 0, 0, 0], "load": {"payload": 100}}});
    let found = ask(&mut Live::new(&text).unwrap(), &question)["ok"].clone();
    assert_eq!(found["rms"].as_f64(), Some(expected.magnitude()));
    assert_eq!(found["lengths"], json!(expected.lengths));
    let residual = &expected.loaded.report.residual;
    assert_eq!(found["loaded"]["residual"]["force"].as_f64(), Some(residual.force));
}

#[test]
fn a_cable_wound_out_leads_where_the_same_lengths_are_found_directly() {
    let (_, text) = robots().swap_remove(0);
    let mut live = Live::new(&text).unwrap();
    let wind = questions(&mut live).swap_remove(3);
    let way = ask(&mut live, &wind)["ok"].clone();
    let given = &wind["wind"];
    let stand =
        json!({"stand": {"lengths": given["lengths"][1], "load": given["load"][1], "start": given["start"]}});
    let direct = ask(&mut live, &stand)["ok"].clone();
    assert_eq!(way["jumps"], json!([]));
    assert!(farthest(&way["state"]["pose"], &direct["pose"]).0 < 1e-9);
}

#[test]
fn a_platform_whose_cables_are_wound_far_jumps_or_says_why_not() {
    // One cable of the four is let out until the platform hangs on the others.
    let (_, text) = robots().into_iter().find(|(name, _)| *name == "cogiro").unwrap();
    let mut live = Live::new(&text).unwrap();
    let held = ask(&mut live, &json!({"hold": {"pose": [0, 0, 2, 1, 0, 0, 0]}}))["ok"].clone();
    let mut longer = held["lengths"].clone();
    longer[0] = json!(longer[0].as_f64().unwrap() * 1.3);
    let wind = json!({"wind": {"lengths": [held["lengths"], longer], "start": [0, 0, 2, 1, 0, 0, 0]}});
    let way = ask(&mut live, &wind)["ok"].clone();
    assert!(way["state"].is_object() || way["reason"].is_string(), "{way}");
    let slack = |state: &Value| state["cables"][0]["slack"] == json!(true);
    assert!(way["state"].is_null() || slack(&way["state"]));
}

#[test]
fn what_cannot_be_answered_says_why() {
    let mut live = Live::new(&robots().swap_remove(0).1).unwrap();
    let refused = |live: &mut Live, question: Value, kind: &str, words: &str| {
        let error = ask(live, &question)["error"].clone();
        let reason = error["reason"].as_str().unwrap_or_default();
        assert!(error["kind"] == kind && reason.contains(words), "{question}: {error}");
    };
    let far = json!({"hold": {"pose": [50, 0, 0, 1, 0, 0, 0]}});
    refused(&mut live, far, "infeasible_tension", "position");
    refused(&mut live, json!({"hold": {"pose": [0, 0, 1, 0, 0, 0, 0]}}), "invalid_input", "quaternion");
    refused(&mut live, json!({"hold": {}}), "invalid_question", "pose");
    refused(&mut live, json!({"dance": {}}), "invalid_question", "dance");
    refused(&mut live, json!({"observe": {"replicate": 1}}), "invalid_input", "study");
    let short = json!({"stand": {"lengths": [1, 2], "start": [0, 0, 1, 1, 0, 0, 0]}});
    refused(&mut live, short, "invalid_input", "lengths");
    let rows = json!({"normal": "z", "at": 1, "quaternion": [1, 0, 0, 0], "u": [0, 1, 2], "v": [0, 1, 2],
                      "rows": [0, 3]});
    refused(&mut live, json!({"slice": rows}), "invalid_input", "rows");
    assert!(Live::new("{}").is_err());
}

#[test]
fn a_table_has_the_inputs_and_outputs_of_every_observation() {
    let mut live = Live::new(&robots().swap_remove(0).1).unwrap();
    let mut study = ask(&mut live, &json!({"describe": {}}))["ok"]["study"].clone();
    study["samplings"]["all"]["observations"] = json!(64);
    ask(&mut live, &json!({"study": {"text": study}}));
    let observed = ask(&mut live, &json!({"observe": {"replicate": 0}}))["ok"].clone();
    let table = ask(&mut live, &json!({"table": {}}))["ok"].clone();
    assert_eq!(table["seed"], study["seed"]);
    assert_eq!(table["outputs"], json!(["dx_mm", "dy_mm", "dz_mm", "magnitude_mm"]));
    let inputs = table["inputs"].as_array().unwrap();
    assert!(inputs.contains(&json!({"name": "mass", "unit": "kg"})), "{inputs:?}");
    let rows = table["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 64);
    let sentence = observed["sentences"][0].as_str().unwrap();
    assert!(sentence.starts_with("Mean deflection ") && sentence.contains(" mm, range "), "{sentence}");
    for (row, value) in rows.iter().zip(observed["values_mm"].as_array().unwrap()) {
        assert_eq!(row["inputs"].as_array().unwrap().len(), inputs.len());
        assert_eq!(row["outputs_mm"][3], *value);
    }
    let masses: Vec<_> = rows.iter().map(|row| row["inputs"][0].as_f64().unwrap()).collect();
    assert!(masses.iter().any(|deviation| *deviation != masses[0]));
}

#[test]
fn robots_are_observed_on_kept_lengths_under_a_force() {
    let (_, text) = robots().swap_remove(0);
    let mut live = Live::new(&text).unwrap();
    let mut study = ask(&mut live, &json!({"describe": {}}))["ok"]["study"].clone();
    let load = json!({"payload": 20.0, "force": [30.0, 0.0, 0.0], "moment": [0.0, 4.0, 0.0]});
    let pose = json!([0.2, 0.1, 1.6, 1, 0, 0, 0]);
    let mut lengths = ask(&mut live, &json!({"hold": {"pose": pose}}))["ok"]["lengths"].clone();
    lengths[2] = json!(1.0002 * lengths[2].as_f64().unwrap());
    for part in ["payload", "force", "moment"] {
        study[part] = load[part].clone();
    }
    let sampling = &mut study["samplings"]["all"];
    (sampling["observations"], sampling["lengths"]) = (json!(16), lengths.clone());
    sampling["pose"] = json!({"position": [0.2, 0.1, 1.6]});
    study["error_models"]["tolerances"].as_object_mut().unwrap().shift_remove("dt");
    let set = ask(&mut live, &json!({"study": {"text": study}}));
    assert!(set["ok"].is_object(), "{set}");
    let observed = ask(&mut live, &json!({"observe": {"replicate": 0}}))["ok"].clone();
    let position = |live: &mut Live, load: &Value| {
        let stand = json!({"stand": {"lengths": lengths, "load": load, "start": pose}});
        let pose = ask(live, &stand)["ok"]["pose"].clone();
        [0, 1, 2].map(|k| pose[k].as_f64().unwrap())
    };
    let [loaded, alone] = [&load, &json!({})].map(|load| position(&mut live, load));
    let far = 1e3 * (0..3).map(|k| (loaded[k] - alone[k]).powi(2)).sum::<f64>().sqrt();
    assert!((observed["nominal_mm"].as_f64().unwrap() - far).abs() < 1e-7 * far, "{far}: {observed}");
    let values = observed["values_mm"].as_array().unwrap();
    let of = |value: &Value| value.as_f64().unwrap() / far;
    assert_eq!(values.len(), 16);
    assert!(values.iter().all(|value| (0.2..5.0).contains(&of(value))), "{far}: {values:?}");
    assert!(values.iter().any(|value| (of(value) - 1.0).abs() > 1e-3));
}

#[test]
fn a_cable_says_where_it_leaves_its_pulley() {
    for (name, robot) in robots() {
        let mut live = Live::new(&robot).unwrap();
        let hold = questions(&mut live).swap_remove(1);
        let held = ask(&mut live, &hold)["ok"].clone();
        for cable in held["loaded"]["cables"].as_array().unwrap() {
            let (points, free) = (cable["points"].as_array().unwrap(), cable["free"].as_u64().unwrap());
            let on_pulley = !cable["wheel"].as_array().unwrap().is_empty();
            assert_eq!(on_pulley, free > 0, "{name}");
            // The free cable begins on the wheel, as far from its middle as every point around it.
            let place = |points: &[Value], k: usize| [0, 1, 2].map(|c| points[3 * k + c].as_f64().unwrap());
            if let [wheel @ .., _, _, _] = cable["wheel"].as_array().unwrap().as_slice() {
                let count = wheel.len() / 3;
                let sum = (0..count)
                    .map(|k| place(wheel, k))
                    .fold([0.0; 3], |sum, p| [0, 1, 2].map(|c| sum[c] + p[c]));
                let far =
                    |p: [f64; 3]| (0..3).map(|c| (p[c] - sum[c] / count as f64).powi(2)).sum::<f64>().sqrt();
                let [leave, radius] = [far(place(points, free as usize)), far(place(wheel, 0))];
                assert!((leave - radius).abs() < 1e-9, "{name}: {leave} and {radius}");
            }
        }
    }
}

#[test]
fn a_slice_over_a_coordinate_that_is_free_is_refused() {
    let (_, text) = robots().into_iter().find(|(name, _)| *name == "four-cables").unwrap();
    let slice = json!({"slice": {"normal": "z", "at": 2, "quaternion": [1, 0, 0, 0], "u": [0.2, 0.4, 2],
        "v": [0.2, 0.4, 2], "rows": [0, 2], "free": ["x", "roll"]}});
    let error = ask(&mut Live::new(&text).unwrap(), &slice)["error"].clone();
    assert_eq!(error["kind"], json!("invalid_input"));
    assert!(error["reason"].as_str().unwrap().starts_with("free is x: expected coordinates"), "{error}");
}
