//! The same physics described twice has the same answer: other frames, other notations, other rates.

use crate::common::{cdpr, cdpr_in, data_path, text, unwrapped};
use serde_json::{Value, json};
use tempfile::TempDir;

/// A robot of the library whose exit points are moved.
fn moved(name: &str, exit: impl Fn([f64; 3]) -> [f64; 3]) -> Value {
    let file = std::fs::read_to_string(data_path(&format!("robots/{name}.json"))).unwrap();
    let mut robot: Value = serde_json::from_str(&file).unwrap();
    for cable in robot["cables"].as_array_mut().unwrap() {
        let point = [0, 1, 2].map(|k| cable["exit_point"][k].as_f64().unwrap());
        cable["exit_point"] = json!(exit(point));
    }
    robot
}

fn written(folder: &TempDir, robot: &Value) -> String {
    let path = folder.path().join("robot.json");
    std::fs::write(&path, robot.to_string()).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn no_ground_is_assumed_where_the_platform_was_before() {
    let folder = TempDir::new().unwrap();
    // The base frame of GRAB lies at its exit points.
    let higher = written(&folder, &moved("grab", |[x, y, z]| [x, y, z + 2.0]));
    for (robot, z) in [("grab", "-0.9192"), (&higher, "1.0808")] {
        let pose = format!("1.2795,-0.1915,{z}");
        let found = cdpr(&["safety", robot, "--pose", &pose, "--rpy", "0,-3.1,7.8", "--free", "roll,pitch"]);
        assert_eq!(found.status.code(), Some(0), "{robot}: {}", text(found.stdout));
        assert!(text(found.stdout).contains("comes to rest on its other cables"));
    }
}

#[test]
fn a_platform_that_turns_over_is_not_said_to_be_borne() {
    let found = cdpr(&["safety", "caroca", "--pose", "2,1,2", "--format", "json"]);
    assert_eq!(found.status.code(), Some(3));
    let answer: Value = serde_json::from_str(&text(found.stdout)).unwrap();
    let over = |k: usize| answer["broken"][k]["turns_over"].as_bool().unwrap();
    assert!(over(3) && !over(0) && answer["broken"][3]["turned_deg"].as_f64().unwrap() > 90.0);
    let said = text(cdpr(&["safety", "caroca", "--pose", "2,1,2"]).stdout).replace('\n', " ");
    assert!(said.contains("whether it bears every break is not known; without cable 4 the platform turns"));
}

#[test]
fn answers_of_a_platform_that_is_turned_half_round_go_on_into_the_next_command() {
    let folder = TempDir::new().unwrap();
    let (sin, cos) = 170.0_f64.to_radians().sin_cos();
    let robot = written(&folder, &moved("caroca", |[x, y, z]| [cos * x - sin * y, sin * x + cos * y, z]));
    std::fs::write(
        folder.path().join("poses.csv"),
        "x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n0,0,1.75,0,0,170\n",
    )
    .unwrap();
    let held = cdpr(&[
        "inverse",
        &robot,
        "--poses",
        &folder.path().join("poses.csv").display().to_string(),
        "--format",
        "json",
    ]);
    std::fs::write(folder.path().join("held.jsonl"), &held.stdout).unwrap();
    let found = cdpr_in(folder.path(), &["direct", &robot, "--from", "held.jsonl"]);
    assert_eq!(found.status.code(), Some(0), "{}", unwrapped(found.stderr));
}

#[test]
fn a_wind_that_grows_with_height_needs_a_level_base() {
    let folder = TempDir::new().unwrap();
    let mut robot = moved("cogiro", |point| point);
    robot["gravity"] = json!([0.9, 0.0, -9.76]);
    let robot = written(&folder, &robot);
    let windy = |more: &[&str]| {
        cdpr(&[&["deflection", &robot, "--pose", "0,0,2", "--wind", "15,4,0"], more].concat())
    };
    assert_eq!(windy(&[]).status.code(), Some(0));
    let refused = windy(&["--with", "wind_profile=0.3:10"]);
    assert_eq!(refused.status.code(), Some(1));
    let said = unwrapped(refused.stderr);
    assert!(said.contains("wind_profile is a tilted base frame: expected a wind that is the same"), "{said}");
}

#[test]
fn the_deviation_of_a_move_does_not_depend_on_its_set_points() {
    let poses = data_path("poses/one-metre.csv");
    let deviation = |rate: u32| {
        let with = format!("seconds=1.5,residual=0.2,rate={rate}");
        let found = cdpr(&["path", "cogiro", "--poses", &poses, "--with", &with, "--format", "json"]);
        let answer: Value = serde_json::from_str(&text(found.stdout)).unwrap();
        answer["residual"]["deviation_m"].as_f64().unwrap()
    };
    let [few, many] = [50, 400].map(deviation);
    assert!((few / many - 1.0).abs() < 0.01, "{few} {many}");
}

#[test]
fn a_move_says_when_a_tension_passes_its_limit() {
    let folder = TempDir::new().unwrap();
    let file = format!("{}/../../docs/how-to/loads/stadium.json", env!("CARGO_MANIFEST_DIR"));
    let mut robot: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    robot["tension_limits"]["max"] = json!(500.0);
    let robot = written(&folder, &robot);
    std::fs::write(folder.path().join("way.csv"), "x_m,y_m,z_m\n-20,5,12\n20,5,12\n").unwrap();
    let with = ["--with", "seconds=6,profile=polynomial,rate=20"];
    let planned = cdpr_in(folder.path(), &[&["path", &robot, "--poses", "way.csv"], &with[..]].concat());
    assert_eq!(planned.status.code(), Some(3));
    let said = text(planned.stdout).replace('\n', " ");
    // The way is symmetric, and cables 3 and 4 are, too: the camera speeds up and slows down alike.
    assert!(said.contains("cables 3, 4: tension up to 548.22"), "{said}");
    assert!(said.contains("This is in cable 3 at 1.4") && said.contains(", in cable 4 at 4.5"), "{said}");
}

#[test]
fn a_motion_that_strains_cables_beyond_the_models_is_questioned() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("e.json"), r#"[{"t": 0, "force": [0, 0, -2e6]}]"#).unwrap();
    let call = ["simulate", "cogiro", "--pose", "0,0,2", "--events", "e.json", "--until", "0.02"];
    let found = cdpr_in(folder.path(), &call);
    assert_eq!(found.status.code(), Some(3));
    let said = unwrapped(found.stderr);
    assert!(said.contains("is strained by") && said.contains("the models are valid up to 10 %"), "{said}");
}
