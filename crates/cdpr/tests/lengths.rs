//! Tables of lengths, and the poses of planar robots.

use crate::common::{answered, cdpr, text, unwrapped};
use serde_json::{Value, json};
use tempfile::TempDir;

fn put(folder: &TempDir, name: &str, content: &str) -> String {
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    path.display().to_string()
}

/// Rows of a table by the names of their columns.
fn rows(table: &str) -> Vec<std::collections::HashMap<String, String>> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let names = reader.headers().unwrap().clone();
    let row =
        |row: csv::StringRecord| names.iter().zip(&row).map(|(a, b)| (a.to_owned(), b.to_owned())).collect();
    reader.records().map(|one| row(one.unwrap())).collect()
}

#[test]
fn the_lengths_of_a_table_of_inverse_lead_back_to_its_poses() {
    let folder = TempDir::new().unwrap();
    let poses = put(
        &folder,
        "poses.csv",
        "x_m,y_m,z_m,yaw_deg,name\n0,0,1.75,0,one\n0,0,60,0,none\n0.5,-0.2,1.6,8,two\n",
    );
    let output = cdpr(&["inverse", "caroca", "--poses", &poses, "--payload", "20"]);
    assert_eq!(output.status.code(), Some(3));
    let lengths = put(&folder, "lengths.csv", &text(output.stdout));
    let back = |arguments: &[&str]| {
        let output = cdpr(&[&["direct", "caroca"], arguments].concat());
        assert_eq!(output.status.code(), Some(3), "{}", unwrapped(output.stderr));
        text(output.stdout)
    };
    let found = rows(&back(&["--lengths", &lengths, "--payload", "20", "--with", "certificate,starts=2"]));
    assert_eq!(found.len(), 3);
    for (row, name, at) in [(&found[0], "one", [0.0, 0.0, 1.75]), (&found[2], "two", [0.5, -0.2, 1.6])] {
        assert_eq!((row["name"].as_str(), row["status"].as_str()), (name, "held"));
        for (axis, wanted) in ["x_m", "y_m", "z_m"].iter().zip(at) {
            assert!((row[*axis].parse::<f64>().unwrap() - wanted).abs() < 1e-8, "{axis}: {}", row[*axis]);
            assert_eq!(row[&format!("given_{axis}")].parse::<f64>().unwrap(), wanted);
        }
        assert!(row["certificate_position_m"].parse::<f64>().unwrap() < 1e-9);
        // One of the starts of the first row leads to another stable place.
        assert_eq!(row["others"], if name == "one" { "1" } else { "0" });
        assert!(!row["tension_1_n"].is_empty() && !row["length_8_m"].is_empty());
    }
    assert_eq!((found[1]["x_m"].as_str(), found[1]["status"].as_str()), ("", "invalid_input"));
    assert!(found[1]["reason"].contains("lengths is missing"), "{}", found[1]["reason"]);
    // As `--from`, and in JSON.
    let json = back(&["--from", &lengths, "--format", "json"]);
    let lines: Vec<Value> = json.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((lines.len(), &lines[0]["given"]["name"]), (3, &json!("one")));
    assert_eq!((lines[0]["lengths"].as_array().unwrap().len(), &lines[0]["stable"]), (8, &json!(true)));
    assert_eq!(lines[1]["error"]["kind"], "invalid_input");
}

#[test]
fn a_table_that_has_no_lengths_is_refused_with_what_direct_takes() {
    let folder = TempDir::new().unwrap();
    for (content, words) in [
        ("x_m,y_m,z_m\n0,0,1\n", "no column length_1_m: expected the columns length_1_m to length_8_m"),
        ("length_1_m,length_9_m\n1,2\n", "column length_9_m: expected the columns length_1_m to length_8_m"),
        ("1,2,3\n", "3 columns: expected 8, the length of each cable [m]"),
    ] {
        let table = put(&folder, "table.csv", content);
        for option in ["--from", "--lengths"] {
            let output = cdpr(&["direct", "caroca", option, &table]);
            let error = unwrapped(output.stderr);
            assert!(error.contains(words) && !error.contains("analyse"), "{option}: {error}");
            assert_ne!(output.status.code(), Some(0));
        }
    }
}

/// A robot in the plane xz whose platform hangs 0.1 m before its exit points.
fn planar(folder: &TempDir) -> String {
    let cable = |[x, z]: [f64; 2]| {
        let anchor = [0.1 * (0.5 * x - 0.5), 0.1, 0.08 * (0.5 - 0.5 * z)];
        json!({"exit_point": [x, 0.5, z], "anchor_point": anchor})
    };
    let robot = json!({
        "format": "cdpr-robot/1", "name": "Wall", "plane": "xz", "gravity": 9.81,
        "platform": {"mass": 1.2, "center_of_mass": [0, 0, 0], "inertia": 0.003},
        "cable": {"diameter": 0.001, "youngs_modulus": 5e10, "linear_density": 0.0006},
        "tension_limits": {"min": 5, "max": 150},
        "cables": ([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(cable)),
    });
    put(folder, "robot.json", &robot.to_string())
}

#[test]
fn a_table_of_a_planar_robot_may_leave_out_what_is_out_of_the_plane() {
    let folder = TempDir::new().unwrap();
    let robot = planar(&folder);
    let whole = put(&folder, "whole.csv", "x_m,y_m,z_m\n1,0.4,1\n1.2,0.4,0.9\n");
    let of = |file: &str| answered(cdpr(&["inverse", &robot, "--poses", file]));
    let expected = of(&whole);
    for content in ["x_m,z_m\n1,1\n1.2,0.9\n", "1,1\n1.2,0.9\n"] {
        let file = put(&folder, "plane.csv", content);
        assert_eq!(of(&file), expected, "{content}");
    }
    // Only what is out of the plane may be missing.
    let short = put(&folder, "short.csv", "x_m,y_m\n1,0.4\n");
    let refused = cdpr(&["inverse", &robot, "--poses", &short]);
    assert_eq!(refused.status.code(), Some(1));
    for arguments in [
        ["inverse", &robot, "--pose", "1,0,1"],
        ["inverse", &robot, "--poses", &put(&folder, "off.csv", "x_m,y_m,z_m\n1,0.4,1\n1,0,1\n")],
    ] {
        let output = cdpr(&arguments);
        let said = unwrapped(output.stderr);
        assert!(said.contains("out of the plane xz of its cables, where y is 0.4 m"), "{said}");
        assert_eq!(output.status.code(), Some(3));
    }
    // One moment of inertia is enough.
    answered(cdpr(&["modes", &robot, "--pose", "1,0.4,1"]));
}

#[test]
fn an_answer_in_weather_is_refused_with_what_to_leave_out() {
    let folder = TempDir::new().unwrap();
    let blown = [
        "deflection",
        "caroca",
        "--pose",
        "0,0,1.75",
        "--payload",
        "5",
        "--wind",
        "0,15,0",
        "--format",
        "json",
    ];
    let case = put(&folder, "case.json", &answered(cdpr(&blown)));
    let output = cdpr(&["direct", "caroca", "--from", &case]);
    let error = unwrapped(output.stderr);
    assert!(error.contains("`direct` has no weather: without the field `in_weather`"), "{error}");
    assert_eq!(output.status.code(), Some(1));
}
