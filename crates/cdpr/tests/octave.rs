//! The scripts for MATLAB and Octave print in Octave what docs/how-to/matlab.md shows.
//!
//! `.ci/run` runs this test by its name; a plain `cargo test` leaves it out, because it needs Octave.

#![allow(clippy::unwrap_used, clippy::expect_used)]

use std::path::Path;
use std::process::Command;

/// Runs a script of the folder of the page, and returns what it prints.
fn octave(script: &str) -> String {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/how-to");
    let run = format!("cdpr = '{}'; run('matlab/{script}')", env!("CARGO_BIN_EXE_cdpr"));
    let octave = Command::new("octave-cli").args(["--quiet", "--eval", &run]).current_dir(&docs).output();
    let octave = octave.expect("Octave has to be installed for this test");
    assert!(octave.status.success(), "{}", String::from_utf8_lossy(&octave.stderr));
    let printed = String::from_utf8(octave.stdout).unwrap();
    let page = std::fs::read_to_string(docs.join("matlab.md")).unwrap();
    assert!(page.contains(&format!("```\n\n```text\n{printed}```")), "docs/how-to/matlab.md: {printed}");
    printed
}

#[test]
fn octave_gets_the_lengths_of_a_table_of_poses() {
    let printed = octave("lengths.m");
    assert!(printed.lines().last().unwrap().ends_with("infeasible_tension"), "{printed}");
}

#[test]
fn octave_gets_the_positions_of_a_list_of_cases() {
    let printed = octave("direct.m");
    let answers: Vec<Vec<f64>> = printed
        .lines()
        .map(|line| line.trim_end_matches(" m").split(' ').map(|number| number.parse().unwrap()).collect())
        .collect();
    let lengths = ["4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44", "4.45,4.55,4.37,4.27,4.27,4.37,4.55,4.45"];
    assert_eq!(answers.len(), lengths.len());
    for (answer, lengths) in answers.iter().zip(lengths) {
        let direct = Command::new(env!("CARGO_BIN_EXE_cdpr"))
            .args(["direct", "caroca", "--force=0,0,-100", "--format", "json"])
            .arg(format!("--lengths={lengths}"))
            .output()
            .unwrap();
        let direct: serde_json::Value = serde_json::from_slice(&direct.stdout).unwrap();
        for (axis, printed) in answer.iter().enumerate() {
            let position = direct["position"][axis].as_f64().unwrap();
            assert!((printed - position).abs() <= 0.5e-6 * 1.000_001, "{printed} {position}");
        }
    }
}
