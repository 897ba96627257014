//! `cdpr workspace` as a user meets it: the table, the summary, the maps.

use crate::common::{answered, cdpr_in, data, data_path, text};
use cdpr_robot::{Pose, Robot, Vector3, Wrench};
use cdpr_statics::{Load, deflection};
use serde_json::{Value, json};
use std::path::Path;
use tempfile::TempDir;

/// Standard output of a workspace of CAROCA that must succeed.
fn run(folder: &Path, arguments: &[&str]) -> String {
    answered(cdpr_in(folder, &[&["workspace", &data_path("robots/caroca.json")], arguments].concat()))
}

/// The files of a workspace, except the list of them and the lock.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = entries
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), std::fs::read(&path).unwrap()))
        .collect();
    files.retain(|(name, _)| !name.starts_with("cdpr-results."));
    files.sort();
    files
}

#[test]
fn a_plane_is_written_as_table_summary_and_maps_the_same_on_any_number_of_threads() {
    let folder = TempDir::new().unwrap();
    let place = ["--region", "::9,::7,1.75"];
    let load = ["--payload", "50", "--uncertainty", "a=0.002,youngs_modulus=5e9"];
    let run = |out: &[&str]| run(folder.path(), &[&place[..], &load, out].concat());
    let printed = run(&["--threads", "1", "--out", "one"]);
    let json = run(&["--threads", "2", "--out", "two", "--format", "json"]);
    let written = files(&folder.path().join("one"));
    assert_eq!(written, files(&folder.path().join("two")));
    let names: Vec<_> = written.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        names,
        [
            "deflection.svg",
            "dominant_tolerance.svg",
            "greatest_tension.svg",
            "greatest_tension_recomputed.svg",
            "least_stiffness.svg",
            "workspace.csv",
            "workspace.json"
        ]
    );
    assert!(printed.contains(" of 63 positions (") && printed.contains(", payload 50 kg"), "{printed}");

    let summary: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(summary, serde_json::from_slice::<Value>(&written[6].1).unwrap());
    assert_eq!(summary["uncertainties"].as_object().unwrap().len(), 25);
    let robot = Robot::from_json(&std::fs::read_to_string(data("robots/caroca.json")).unwrap()).unwrap();
    assert_eq!(summary["format"], "cdpr-workspace/2");
    let columns = &summary["columns"];
    let center = |name: &str| columns[name][31].as_f64().unwrap();
    let exact = deflection(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::payload(50.0)).unwrap();
    assert_eq!((center("x_m"), center("y_m")), (0.0, 0.0));
    assert!((center("magnitude_mm") - 1e3 * exact.magnitude()).abs() < 1e-11 * 1e3 * exact.magnitude());
    assert_eq!(
        (&columns["status"][31], &columns["dominant"][31]),
        (&"held".into(), &"youngs_modulus".into())
    );
    assert_eq!(columns.get("payload_recomputed_kg"), None, "what was not asked for has no column");
    assert!(columns.as_object().unwrap().values().all(|column| column.as_array().unwrap().len() == 63));
    assert_eq!(
        (&columns["status"][0], &columns["magnitude_mm"][0]),
        (&"infeasible_tension".into(), &Value::Null)
    );

    let table = text(written[5].1.clone());
    let lines: Vec<_> = table.lines().collect();
    assert_eq!(lines.len(), 64);
    assert!(lines[0].starts_with("x_m,y_m,z_m,status,least_tension_n,greatest_tension_n,dx_mm"));
    assert!(
        lines[32].starts_with("0,0,1.75,held,") || lines[32].starts_with("0.0,0.0,1.75,held,"),
        "{}",
        lines[32]
    );
    assert!(lines[1].contains("no tensions between 1 N and 10290 N"), "{}", lines[1]);
}

#[test]
fn a_box_has_maps_of_its_layers_and_a_study_may_give_the_tolerances() {
    let folder = TempDir::new().unwrap();
    let study = data("studies/caroca.json");
    let tolerances = format!("{}:table_3", study.display());
    let tolerances = ["--uncertainty", &tolerances, "--payload", "50"];
    let place = ["--region=-1:1:3,0:0:1,1:2:2", "--out", "out", "--format", "json"];
    let summary: Value =
        serde_json::from_str(&run(folder.path(), &[&place, &tolerances[..]].concat())).unwrap();
    assert_eq!(summary["columns"]["status"].as_array().unwrap().len(), 6);
    assert_eq!(summary["uncertainties"].as_object().unwrap().len(), 62);
    // A uniform law of half width 18 kg in steps of 0.05 kg: 719 values, and two at the ends of half weight.
    let std = 0.05 * (360.0_f64.powi(2) / 3.0 + 1.0 / 6.0).sqrt();
    assert!((summary["uncertainties"]["mass"].as_f64().unwrap() - std).abs() < 1e-11);
    assert_eq!(files(&folder.path().join("out")).len(), 7, "the box is a plane: y has one coordinate");
    run(folder.path(), &["--region=-1:1:2,0:1:2,1:2:2", "--payload", "50", "--out", "box"]);
    let names: Vec<_> = files(&folder.path().join("box")).into_iter().map(|(name, _)| name).collect();
    let layers = ["deflection", "greatest_tension_recomputed", "greatest_tension", "least_stiffness"]
        .map(|name| [format!("{name}_z00.svg"), format!("{name}_z01.svg")]);
    assert_eq!(names[..8], layers.concat());
    assert_eq!(names[8..], ["workspace.csv", "workspace.json"]);
    let printed = run(folder.path(), &["--region=-1:1:2,0:1:2,1:2:5", "--with", "layers=3", "--out", "high"]);
    assert!(printed.contains("3 of 5 layers are drawn: --with layers=5 draws all of them"), "{printed}");
    let names: Vec<_> = files(&folder.path().join("high")).into_iter().map(|(name, _)| name).collect();
    let layers = ["00", "02", "04"].map(|layer| format!("least_stiffness_z{layer}.svg"));
    assert!(layers.iter().all(|layer| names.contains(layer)) && names.len() == 3 * 2 + 2, "{names:?}");
}

#[test]
fn any_load_and_any_orientation_have_a_workspace_and_without_a_load_nothing_is_displaced() {
    let folder = TempDir::new().unwrap();
    let region = "--region=-0.5:0.5:3,-0.5:0.5:3,1.75:1.75:1";
    let summary = |arguments: &[&str]| {
        let arguments = [&[region, "--format", "json", "--out", "out", "--overwrite"], arguments].concat();
        serde_json::from_str::<Value>(&run(folder.path(), &arguments)).unwrap()
    };
    let yaw = format!("0,0,{}", 2.0 * 0.05_f64.atan().to_degrees());
    let turned = summary(&["--rpy", &yaw, "--force", "0,200,0", "--moment", "0,0,10"]);
    let robot = Robot::from_json(&std::fs::read_to_string(data("robots/caroca.json")).unwrap()).unwrap();
    let pose = Pose::with_quaternion(Vector3::new(0.0, 0.0, 1.75), [1.0, 0.0, 0.0, 0.05]).unwrap();
    let wrench = Wrench { force: Vector3::new(0.0, 200.0, 0.0), moment: Vector3::new(0.0, 0.0, 10.0) };
    let exact = deflection(&robot, &pose, &Load::wrench(wrench)).unwrap();
    let magnitude = turned["columns"]["magnitude_mm"][4].as_f64().unwrap();
    assert!((magnitude - 1e3 * exact.magnitude()).abs() < 1e-11 * magnitude);
    let map = std::fs::read_to_string(folder.path().join("out/deflection.svg")).unwrap();
    // The heading has two lines.
    let heading: Vec<&str> = map.lines().filter(|line| !line.starts_with('<')).take(2).collect();
    let heading = heading.join(" ");
    assert!(
        heading.contains("force (0, 200, 0) N, moment (0, 0, 10) N m, quaternion (0.9988, "),
        "{heading}"
    );

    // The map of the load goes, and a file of the user stays.
    std::fs::write(folder.path().join("out/mine.svg"), "mine").unwrap();
    let unloaded = summary(&[]);
    assert_eq!(
        (&unloaded["recomputed_status"], unloaded["columns"].get("recomputed_status")),
        (&json!({}), None)
    );
    assert_eq!((&unloaded["magnitude_mm"], unloaded["columns"].get("magnitude_mm")), (&Value::Null, None));
    assert!(unloaded["least_stiffness_n_per_m"]["min"].as_f64().unwrap() > 0.0);
    assert!(!folder.path().join("out/deflection.svg").exists());
    assert_eq!(std::fs::read(folder.path().join("out/mine.svg")).unwrap(), b"mine");
}

#[test]
fn amplitudes_of_a_shaken_platform_have_columns_a_map_and_their_conditions() {
    let folder = TempDir::new().unwrap();
    let region = ["--region=-2:2:3,-1:1:3,1.75", "--with", "amplitude=0:12,damping=1e-3,drag=0.5"];
    let run = |more: &[&str]| run(folder.path(), &[&region[..], more].concat());
    let printed = run(&["--out", "shaken", "--marker", "0.1,0,0"]).replace('\n', " ");
    for words in [
        "largest amplitude by a force [mm/N]",
        "largest amplitude by a winch [mm/mm]",
        "Amplitudes from 0 Hz to 12 Hz, damping of the cables: stretch 0.001 s, drag 0.5 1/s.",
        "that of a ball as large as the platform is assumed",
    ] {
        assert!(printed.contains(words), "{words}: {printed}");
    }
    let file = std::fs::read_to_string(folder.path().join("shaken/workspace.json")).unwrap();
    let summary: Value = serde_json::from_str(&file).unwrap();
    assert_eq!(summary["shaking"]["marker"], json!([0.1, 0.0, 0.0]));
    assert_eq!(summary["shaking"]["band_hz"], json!([0.0, 12.0]));
    let column = |name: &str| summary["columns"][name].as_array().unwrap().clone();
    let amplitudes: Vec<f64> = column("amplitude_mm_per_n").iter().filter_map(Value::as_f64).collect();
    let greatest = summary["amplitude_mm_per_n"]["max"].as_f64().unwrap();
    assert!(amplitudes.len() >= 3 && amplitudes.contains(&greatest), "{amplitudes:?} {greatest}");
    assert!(column("amplitude_at_hz").iter().filter_map(Value::as_f64).all(|at| (0.0..=12.0).contains(&at)));
    for (map, unit) in [("amplitude", "amplitude [mm/N]"), ("winch_amplitude", "amplitude [mm/mm]")] {
        let map = std::fs::read_to_string(folder.path().join(format!("shaken/{map}.svg"))).unwrap();
        assert!(map.contains(unit) && map.contains("shaken from 0 Hz to 12 Hz"), "{unit}");
    }
    // Another run without amplitudes takes the maps away.
    answered(cdpr_in(
        folder.path(),
        &["workspace", &data_path("robots/caroca.json"), region[0], "--out", "shaken", "--overwrite"],
    ));
    assert!(!folder.path().join("shaken/amplitude.svg").exists());
    for wrong in ["amplitude", "amplitude=0", "amplitude=5:1", "amplitude=x:1", "damping=1e-3", "drag=2"] {
        let refused = cdpr_in(
            folder.path(),
            &["workspace", &data_path("robots/caroca.json"), region[0], "--with", wrong, "--out", "no"],
        );
        assert!(matches!(refused.status.code(), Some(1 | 2)), "{wrong}");
        assert!(text(refused.stderr).contains("expected"), "{wrong}");
    }
}

#[test]
fn the_region_says_how_the_load_is_borne() {
    let folder = TempDir::new().unwrap();
    for (with, words) in
        [("boundary", "with tensions for the load"), ("boundary=kept", "with the lengths kept")]
    {
        let printed = run(
            folder.path(),
            &["--region=-1:1:3,-0.5:0.5:3,1.75", "--payload", "9", "--with", with, "--out", with],
        );
        assert!(printed.replace('\n', " ").contains(&format!("The region held {words} has ")), "{printed}");
    }
}
