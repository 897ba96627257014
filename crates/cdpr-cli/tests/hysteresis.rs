//! `cdpr hysteresis` as a user meets it.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use serde_json::Value;
use std::process::{Command, Output};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data");

fn hysteresis(more: &[&str]) -> Output {
    let (robot, record) =
        (format!("{DATA}/robots/caroca.json"), format!("{DATA}/cables/caroca-4mm-record.csv"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_cdpr"));
    command.args(["hysteresis", &robot, "--record", &record, "--length", "1", "--pose", "0,0,1.75"]);
    command.args(more).output().unwrap()
}

#[test]
fn the_cycle_of_the_paper_s_payload_ends_below_where_it_began() {
    let folder = tempfile::tempdir().unwrap();
    let figure = folder.path().join("cycle.svg");
    let more = ["--payload", "50", "--format", "json", "--figure"];
    let output = hysteresis(&[&more[..], &[figure.to_str().unwrap()]].concat());
    assert!(
        output.status.success() && output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let number = |path: &str| found.pointer(path).and_then(Value::as_f64).unwrap();
    let (down, stays) = (number("/deflection_mm/2"), number("/residual_mm/2"));
    assert!(down < stays && stays < 0.0, "{down} {stays}");
    let (given, lost) = (number("/payload_work_j"), number("/dissipated_j"));
    assert!(given > 0.0 && (given / lost - 1.0).abs() < 1e-3, "{given} {lost}");
    for i in 0..8 {
        // Between the moduli over 5-10 % of the breaking force, where the tensions lie.
        assert!((number(&format!("/cables/{i}/modulus_gpa")) - 83.2).abs() < 1e-6);
    }
    assert!(std::fs::read_to_string(figure).unwrap().contains("payload [kg]"));
}

#[test]
fn a_loop_that_gives_energy_is_said_to_do_so() {
    let output = hysteresis(&["--payload", "50", "--unloading", "same-tension"]);
    assert!(output.status.success());
    let warning = String::from_utf8(output.stderr).unwrap();
    assert!(warning.contains("runs the wrong way round"), "{warning}");
}

#[test]
fn a_payload_or_length_that_is_none_is_refused() {
    let refused = hysteresis(&["--payload", "-1"]);
    assert!(!refused.status.success() && refused.stdout.is_empty());
    assert!(
        String::from_utf8(refused.stderr)
            .unwrap()
            .contains("payload is -1: expected a finite, positive mass")
    );
    let refused = hysteresis(&["--payload", "50", "--length", "0"]);
    assert!(!refused.status.success());
}
