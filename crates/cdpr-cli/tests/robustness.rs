//! `cdpr robustness` as a user meets it: results, and every kind of bad input.

use crate::common::{answered, cdpr_in, data_path, json_file, text};
use serde_json::Value;
use std::path::Path;
use std::process::Output;
use tempfile::TempDir;

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let robot = data_path("robots/cogiro.json");
    let given = if arguments.contains(&"--robot") { &[][..] } else { &["--robot", &robot] };
    cdpr_in(folder, &[&["robustness"], given, arguments].concat())
}

/// The summary without its times.
fn summary(folder: &Path) -> Value {
    let mut summary = json_file(folder.join("robustness.json"));
    for protocol in summary["protocols"].as_object_mut().unwrap().values_mut() {
        protocol["total"]["microseconds"].take();
        for row in protocol["rows"].as_array_mut().unwrap() {
            row["microseconds"].take();
        }
    }
    summary
}

#[test]
fn a_run_writes_a_table_figures_and_a_summary() {
    let folder = TempDir::new().unwrap();
    let output = run(folder.path(), &["--poses", "25", "--out", "out"]);
    // Progress is silent when not on a terminal.
    let text = answered(output);
    for words in ["E: 35 GPa; seed 2017", "25 poses of", "WireX", "22 of 30", "25 of 30", "results in out"] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let out = folder.path().join("out");
    let protocols = &summary(&out)["protocols"];
    for (name, solves) in [("mahnke_caverly", 25), ("thirty_poses", 60)] {
        let total = &protocols[name]["total"];
        assert_eq!(total["solves"], solves);
        assert_eq!(
            total["true_pose"].as_u64().unwrap() + total["other_equilibrium"].as_u64().unwrap(),
            solves
        );
    }
    assert_eq!(protocols["mahnke_caverly"]["rows"].as_array().unwrap().len(), 25);
    assert_eq!(protocols["mahnke_caverly"]["rows"][2]["angle_deg"], 20.0);
    let table = std::fs::read_to_string(out.join("solves.csv")).unwrap();
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!((header[0], header[5], header[26], header[33]), ("protocol", "true_x", "outcome", "us"));
    assert_eq!(lines.count(), 85);
    for figure in ["found_poses", "success_share"] {
        let svg = std::fs::read_to_string(out.join(format!("{figure}.svg"))).unwrap();
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{figure}");
    }
}

#[test]
fn the_same_seed_gives_the_same_results_and_another_one_others() {
    let folder = TempDir::new().unwrap();
    let run = |out: &str, seed| {
        let arguments = ["--poses", "5", "--modulus", "100e9", "--seed", seed, "--out", out];
        assert!(run(folder.path(), &arguments).status.success());
        summary(&folder.path().join(out))
    };
    let first = run("first", "1");
    assert_eq!(first["protocols"]["mahnke_caverly"]["youngs_modulus"], 100e9);
    assert_eq!(first, run("second", "1"));
    assert_ne!(first, run("third", "2"));
}

#[test]
fn bad_input_is_refused_before_anything_is_made() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("robot.json"), "{}").unwrap();
    for (arguments, words) in [
        (["--poses", "0"], "invalid value '0' for '--poses <POSES>': expected a count, 1 to 1000000"),
        (["--poses", "-1"], "unexpected argument"),
        (["--poses", "many"], "invalid value 'many' for '--poses"),
        (
            ["--modulus", "-35e9"],
            "error: youngs_modulus is -35000000000: expected a finite, positive modulus [Pa]",
        ),
        (["--modulus", "NaN"], "error: youngs_modulus is NaN: expected a finite, positive modulus"),
        (["--modulus", "inf"], "error: youngs_modulus is inf: expected a finite, positive modulus"),
        (["--seed", "x"], "invalid value 'x' for '--seed"),
        (["--robot", "nowhere.json"], "error: cannot read nowhere.json: No such file"),
        (["--robot", "robot.json"], "error: robot.json: "),
    ] {
        let output = run(folder.path(), &arguments);
        let text = text(output.stderr);
        assert_ne!(output.status.code(), Some(0), "{text}");
        assert!(text.contains(words) && !text.contains("panicked"), "`{words}` is not in: {text}");
    }
    assert!(!folder.path().join("robustness").exists());
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_anything_runs() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("out"), "a file").unwrap();
    let output = run(folder.path(), &["--out", "out"]);
    assert!(!output.status.success());
    assert!(text(output.stderr).starts_with("error: cannot write out: "));
}

#[test]
fn a_robot_with_few_cables_stands_in_its_own_room_and_beside_no_published_figures() {
    let folder = TempDir::new().unwrap();
    let given = ["--robot", "four-cables", "--free", "roll,pitch", "--poses", "5", "--out", "out"];
    // A slow machine reports its progress on the standard error.
    let output = run(folder.path(), &given);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(!text.contains("WireX") && text.contains("E: that of the file"), "{text}");
    let low = summary(&folder.path().join("out"))["protocols"]["thirty_poses"]["region_low"].clone();
    assert_ne!(low[0], -6.75);
    let region = ["--region=-1:1,-0.5:0.5,1:2"];
    let output = run(folder.path(), &[&given[..], &region, &["--overwrite"]].concat());
    assert!(output.status.success());
    let low = summary(&folder.path().join("out"))["protocols"]["thirty_poses"]["region_low"].clone();
    assert_eq!(low, serde_json::json!([-1.0, -0.5, 1.0]));
    let output = run(folder.path(), &["--region=1:-1,0:1,1:2"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("expected min:max of x, y and z"));
}
