//! `cdpr calibrate` as a user meets it.

use crate::common::{answered, cdpr, data_path, text, unwrapped};
use crate::safety::point_mass;
use serde_json::Value;
use std::process::Output;
use tempfile::TempDir;

const UNCERTAINTY: [&str; 2] = ["--uncertainty", "a=0.002,b=0.002,youngs_modulus=5e9,mass=1,dt=5,b1.x=0.01"];
const NOISE: [&str; 2] = ["--noise", "position=1e-4,rotation=1e-4"];

fn run(arguments: &[&str]) -> Output {
    cdpr(&[&["calibrate", "identify", &data_path("robots/caroca.json")], arguments].concat())
}

#[test]
fn a_grid_of_poses_tells_geometry_but_no_offset_of_a_tension() {
    let arguments = [&["--region=-2:2:3,-1:1:3,1:9:2"][..], &UNCERTAINTY, &NOISE].concat();
    let output = run(&[&arguments[..], &["--number", "4", "--format", "json"]].concat());
    let json: Value = serde_json::from_str(&answered(output)).unwrap();
    assert_eq!((json["poses"].as_u64(), json["refused"]["infeasible_tension"].as_u64()), (Some(9), Some(9)));
    let unidentifiable: Vec<_> =
        json["unidentifiable"].as_array().unwrap().iter().map(|part| &part["weights"][0][0]).collect();
    assert!((1..=8).all(|i| unidentifiable.contains(&&Value::from(format!("dt{i}")))), "{unidentifiable:?}");
    assert_eq!(json["identifiable"].as_array().unwrap().len() + unidentifiable.len(), 58);
    let left = |name: &str| json["remaining"][name].as_f64().unwrap();
    assert!((left("dt1") - 1.0).abs() < 1e-9 && left("b1.x") < 0.5);
    assert_eq!(json["best_poses"].as_array().unwrap().len(), 4);
    assert_eq!(json["best_poses"][0]["pose"].as_array().unwrap().len(), 7);

    let short = text(run(&arguments).stdout);
    assert!(
        short.starts_with("CAROCA: 9 poses identify 48 of 58 combinations of the parameters, "),
        "{short}"
    );
    let text = text(run(&[&arguments[..], &["--details"]].concat()).stdout);
    for words in ["9 poses left out: infeasible tension", "+1.00 dt8", "adds [bit]"] {
        assert!(text.contains(words), "{words}: {text}");
        assert!(short.contains(words) || words == "+1.00 dt8", "{words}: {short}");
    }
}

#[test]
fn a_file_of_poses_is_read_line_by_line() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("poses.csv");
    let arguments = ["--poses", path.to_str().unwrap(), "--format", "json"];
    let arguments = [&arguments[..], &UNCERTAINTY, &["--noise", "length=1e-3,tension=5"]].concat();
    std::fs::write(&path, "0,0,1.75,1,0,0,0\n\n1,0.5,2,0.99,0,0,0.1\n").unwrap();
    let json: Value = serde_json::from_slice(&run(&arguments).stdout).unwrap();
    assert_eq!(json["poses"], 2);
    // One reflector.
    let position = ["--poses", path.to_str().unwrap(), "--noise", "position=1e-4", "--format", "json"];
    let reflector: Value =
        serde_json::from_str(&answered(run(&[&position[..], &UNCERTAINTY].concat()))).unwrap();
    assert_eq!(reflector["identifiable"].as_array().unwrap().len(), 6);
    std::fs::write(&path, "0,0,1.75\n1,0.5\n").unwrap();
    let error = unwrapped(run(&arguments).stderr);
    assert!(
        error.starts_with("error: --poses ")
            && error.contains("line 2: 2 cells: expected 3, as many as in line 1"),
        "{error}"
    );
}

#[test]
fn the_position_is_the_whole_pose_of_a_point_mass() {
    // A mass m below a cable: with a length l it hangs lower by g l/EA for each kg. With s its standard
    // deviation of 1 kg over the noise, 1/sqrt(1 + s^2) of this deviation is left.
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &[[0.0, 0.0, 5.0]], true);
    let identify = |noise: &str| {
        let at = ["calibrate", "identify", &robot, "--region", "0,0,2", "--free", "x", "--format", "json"];
        cdpr(&[&at[..], &["--uncertainty", "mass=1", "--noise", noise]].concat())
    };
    let found: Value = serde_json::from_str(&answered(identify("position=1e-3"))).unwrap();
    let signal: f64 = 9.81 * 3.0 / 1e4 / 1e-3;
    let left = found["remaining"]["mass"].as_f64().unwrap();
    assert!((left * (1.0 + signal * signal).sqrt() - 1.0).abs() < 0.03, "{left}");
    let refused = unwrapped(identify("position=1e-3,rotation=1e-3").stderr);
    assert!(refused.contains("--noise rotation is 0.001: expected no such noise: a point mass"), "{refused}");
}

#[test]
fn bad_input_is_named_with_what_would_be_right() {
    let grid = "--region=0:1:2,0:1:2,1:2:2";
    for (arguments, words) in [
        (vec![NOISE[0], NOISE[1], UNCERTAINTY[0], UNCERTAINTY[1]], "required"),
        (
            vec!["--region=0:1", NOISE[0], NOISE[1], UNCERTAINTY[0], UNCERTAINTY[1]],
            "expected a plane, z=1.75, or x, y and z",
        ),
        (
            vec![grid, NOISE[0], NOISE[1], "--uncertainty", "c=1"],
            "uncertainty of c is 1: expected a positive standard deviation of mass",
        ),
        (vec![grid, NOISE[0], NOISE[1], "--uncertainty", "a"], "`a`: expected name=number"),
        (
            vec![grid, NOISE[0], "rotation=1e-4", UNCERTAINTY[0], UNCERTAINTY[1]],
            "--noise rotation is 0.0001: expected position, too",
        ),
        (
            vec![grid, NOISE[0], "force=1", UNCERTAINTY[0], UNCERTAINTY[1]],
            "--noise force is 1: expected one of position",
        ),
        (
            vec![grid, NOISE[0], "lengths=0", UNCERTAINTY[0], UNCERTAINTY[1]],
            "error: --noise lengths is 0: expected a standard deviation from 1e-15",
        ),
        (
            vec![grid, "--poses", "x", NOISE[0], NOISE[1], UNCERTAINTY[0], UNCERTAINTY[1]],
            "cannot be used with",
        ),
        (
            vec!["--poses", "nowhere", NOISE[0], NOISE[1], UNCERTAINTY[0], UNCERTAINTY[1]],
            "error: cannot read nowhere: No such file",
        ),
    ] {
        let output = run(&arguments);
        let text = unwrapped(output.stderr);
        assert_ne!(output.status.code(), Some(0), "{text}");
        assert!(text.contains(words) && !text.contains("panicked"), "`{words}` is not in: {text}");
    }
}

/// The tensions are those of another program, `data/reference/friction.py`, for friction 0.05 and bearing
/// 0.02.
#[test]
fn a_load_cycle_identifies_the_sum_of_the_coefficients_of_friction() {
    let table = data_path("calibration/expo2015-lucia-load-cycle.csv");
    let given = ["calibrate", "pulleys", "expo2015-lucia", &table, "--pose", "0.2,0.1,2"];
    let found: Value =
        serde_json::from_str(&answered(cdpr(&[&given[..], &["--format", "json"]].concat()))).unwrap();
    let number = |path: &str| found.pointer(path).and_then(Value::as_f64).unwrap();
    assert!(found["friction"].is_null() && found["bearing"].is_null());
    let exact = 0.05 * number("/combination/0") + 0.02 * number("/combination/1");
    assert!((number("/combined/value") - exact).abs() < 0.01 * exact, "{exact} {found}");
    assert!(
        number("/rms_n/1") < 0.02 * number("/rms_n/0") && found["readings"].as_array().unwrap().len() == 48
    );
    let said = text(cdpr(&[&given[..], &["--details"]].concat()).stdout).replace('\n', " ");
    assert!(
        said.contains("to first order these measurements identify this sum alone")
            && said.contains("0 sticks"),
        "{said}"
    );
    let wheels = found["cables"].as_array().unwrap();
    assert_eq!(
        wheels.iter().map(|of| of["slipping"].as_u64().unwrap()).filter(|slipping| *slipping > 0).count(),
        6
    );
    // Without pulleys, and without the pose
    let refused = cdpr(&["calibrate", "pulleys", "caroca", &table, "--pose", "0,0,1.75"]);
    assert_eq!(refused.status.code(), Some(1));
    let said = unwrapped(refused.stderr);
    assert!(said.contains("load-cycle.csv: pulley is missing at every cable"), "{said}");
    let refused = cdpr(&given[..4]);
    assert!(
        unwrapped(refused.stderr)
            .contains("pose is missing: expected that of the platform under the first load")
    );
}

/// Sets that grow pose by pose need a seventh, and on the average the eight are more exact than at worst.
#[test]
fn a_plan_is_compared_with_the_accuracy_that_is_wanted_of_it() {
    let region = ["--region=-2:2:4,-1:1:3,1:2.5:3", "--work=-1:1:2,-1:1:2,1.5:2:2"];
    let plan = |number: &str, criterion: &str, limit: &str| {
        let caroca = data_path("robots/caroca.json");
        let known = ["--uncertainty", "a=0.002,b=0.003", NOISE[0], "position=1e-4,rotation=1e-4,length=2e-4"];
        let (criterion, limit) = (format!("criterion={criterion}"), format!("position_error_mm<{limit}"));
        let wanted = ["--with", &criterion, "--number", number, "--limit", &limit];
        let output = cdpr(&[&["calibrate", "plan", &caroca], &region[..], &known, &wanted].concat());
        answered(output).replace('\n', " ")
    };
    let six = plan("6", "mean-position", "0.15");
    assert!(
        six.starts_with("CAROCA reaches the accuracy with 6 poses. 6 poses of CAROCA leave 0.123 mm"),
        "{six}"
    );
    let eight = plan("8", "mean-position", "0.15");
    assert!(
        eight.starts_with("CAROCA reaches the accuracy with 6 poses. 8 poses of CAROCA leave"),
        "{eight}"
    );
    let worst = plan("8", "worst-position", "0.132");
    let words =
        "CAROCA does not reach the accuracy with 8 poses. 8 poses of CAROCA leave 0.133 mm at worst (";
    assert!(worst.starts_with(words), "{worst}");
}

#[test]
fn a_block_of_two_pulleys_is_one_cause() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("errors.json");
    let law = r#"{ "normal": { "mean": 0, "std": 0.003 } }"#;
    let parameters = r#"{ "b1.z": 1, "b2.z": 1 }"#;
    let block =
        format!(r#"{{ "block": {{ "law": {law}, "parameters": {parameters} }}, "a": {{ "law": {law} }} }}"#);
    std::fs::write(&path, block).unwrap();
    let arguments =
        ["--region=-2:2:3,-1:1:3,1.5", "--uncertainty", path.to_str().unwrap(), "--format", "json"];
    let found: Value = serde_json::from_str(&answered(run(&[&arguments[..], &NOISE].concat()))).unwrap();
    let parts = |name: &str| found[name].as_array().unwrap().clone();
    let combinations = [parts("identifiable"), parts("unidentifiable")].concat();
    assert_eq!(combinations.len(), 25);
    let names = combinations.iter().flat_map(|part| part["weights"].as_array().unwrap());
    let names: Vec<&str> = names.map(|pair| pair[0].as_str().unwrap()).collect();
    assert!(names.contains(&"block") && !names.contains(&"b1.z"), "{names:?}");
    // Level poses do not separate the block from a1.z and a2.z: a third of its variance is left, of two exit
    // points that do not depend on each other it would be half.
    let left = |name: &str| found["remaining"][name].as_f64().unwrap();
    assert!((left("b1.z") - (1.0f64 / 3.0).sqrt()).abs() < 0.01, "{found}");
    assert!((left("b1.z") - left("b2.z")).abs() < 1e-12, "{found}");
}

#[test]
fn a_simulation_says_which_poses_have_no_row() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("out.csv").display().to_string();
    let simulate = |region: &str, more: &[&str]| {
        let known = ["--uncertainty", "a=0.002", NOISE[0], NOISE[1], "--seed", "1", "--overwrite"];
        cdpr(&[&["calibrate", "simulate", "cogiro", region, "--out", &out][..], &known, more].concat())
    };
    let output = simulate("--region=-9:9:3,0,2", &[]);
    assert_eq!(output.status.code(), Some(3));
    let said = text(output.stdout);
    assert!(said.contains("out.csv: 1 row at 1 of 3 poses\n"), "{said}");
    assert!(said.contains("left out, not held by the robot of the file: poses 1, 3"), "{said}");
    let json: Value =
        serde_json::from_slice(&simulate("--region=-9:9:3,0,2", &["--format", "json"]).stdout).unwrap();
    assert_eq!(json["left_out"], serde_json::json!([1, 3]));
    let none = simulate("--region=8:9:2,0,2", &[]);
    assert_eq!(none.status.code(), Some(1));
    assert!(unwrapped(none.stderr).contains("holds none of the candidate poses"));
}
