//! The stored module against the models of this program, in Node: what `cargo xtask web` has made answers as
//! the native models do.
//!
//! `.ci/run` runs this test by its name; a plain `cargo test` leaves it out, because it needs Node.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use cdpr_web::Live;
use common::{farthest, questions, robots};
use serde_json::{Value, json};
use std::io::Write;
use std::process::{Command, Stdio};

/// Answers differ by rounding: `libm` of the browser's module rounds sines and logarithms otherwise.
const ROUNDING: f64 = 1e-12;

/// The answers of the stored module, in Node.
fn in_node(robot: &str, questions: &[Value]) -> Vec<Value> {
    let here = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/ask.mjs");
    let mut node = Command::new("node")
        .arg(here)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("Node has to be installed for this test");
    let asked = json!({"robot": robot, "asks": questions}).to_string();
    node.stdin.take().unwrap().write_all(asked.as_bytes()).unwrap();
    let output = node.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn the_stored_module_answers_as_the_native_models() {
    let mut wrong = Vec::new();
    for (name, robot) in robots() {
        let mut live = Live::new(&robot).unwrap();
        let asked = questions(&mut live);
        let native: Vec<Value> =
            asked.iter().map(|ask| serde_json::from_str(&live.ask(&ask.to_string())).unwrap()).collect();
        let found = in_node(&robot, &asked);
        for ((ask, native), found) in asked.iter().zip(&native).zip(&found) {
            let (distance, place) = farthest(native, found);
            let kind = ask.as_object().unwrap().keys().next().unwrap();
            println!("{name}, {kind}: {distance:.1e} {place}");
            if distance > ROUNDING {
                wrong.push(format!("{name}, {kind}, {place}: {distance:e}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
