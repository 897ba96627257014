//! `cdpr hysteresis` as a user meets it.

use crate::common::{answered, cdpr, data_path, data_text, text, unwrapped};
use serde_json::Value;
use std::process::Output;

fn hysteresis(more: &[&str]) -> Output {
    let (robot, record) = (data_path("robots/caroca.json"), data_path("cables/caroca-4mm-record.csv"));
    let given = ["hysteresis", &robot, "--law", &record, "--length", "1", "--pose", "0,0,1.75"];
    cdpr(&[&given[..], more].concat())
}

#[test]
fn the_cycle_of_the_paper_s_payload_ends_below_where_it_began() {
    let folder = tempfile::tempdir().unwrap();
    let figure = folder.path().join("cycle.svg");
    let more = ["--payload", "50", "--format", "json", "--figure"];
    let output = hysteresis(&[&more[..], &[figure.to_str().unwrap()]].concat());
    let found: Value = serde_json::from_str(&answered(output)).unwrap();
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

fn json(arguments: &[&str]) -> Value {
    let common = ["--pose", "0,0,1.75", "--payload", "50", "--format", "json"];
    let output = cdpr(&[&["hysteresis"], arguments, &common].concat());
    assert!(output.status.success(), "{}", unwrapped(output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn down_and_left(found: &Value) -> [f64; 2] {
    ["/deflection_mm/2", "/residual_mm/2"].map(|path| found.pointer(path).and_then(Value::as_f64).unwrap())
}

#[test]
fn a_law_file_says_what_its_record_says() {
    let robot = data_path("robots/caroca.json");
    let of_record = json(&[&robot, "--law", &data_path("cables/caroca-4mm-record.csv"), "--length", "1"]);
    let of_law = json(&[&robot, "--law", &data_path("cables/caroca-4mm-law.json")]);
    for (one, other) in down_and_left(&of_record).into_iter().zip(down_and_left(&of_law)) {
        // Moduli of the file are rounded to six digits.
        assert!((one / other - 1.0).abs() < 1e-5, "{one} {other}");
    }
}

#[test]
fn the_laws_of_a_robot_file_lose_no_energy() {
    let found = json(&[&data_path("robots/caroca-law.json")]);
    let [down, left] = down_and_left(&found);
    assert!((down + 1.6317).abs() < 1e-4 && left.abs() < 1e-9, "{down} {left}");
    assert!(found["dissipated_j"].as_f64().unwrap().abs() < 1e-9);
}

#[test]
fn cables_of_other_moduli_follow_the_record_and_those_of_other_sections_its_stress() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.json");
    let file = path.to_str().unwrap();
    let mut robot: Value =
        serde_json::from_str(&std::fs::read_to_string(data_path("robots/caroca.json")).unwrap()).unwrap();
    let mut write = |change: &dyn Fn(&mut Value)| {
        let mut other = robot["cable"].clone();
        change(&mut other);
        robot["cables"][2]["cable"] = other;
        std::fs::write(&path, robot.to_string()).unwrap();
    };
    let record = ["--law", &data_path("cables/caroca-4mm-record.csv"), "--length", "1"];
    let even = json(&[&[data_path("robots/caroca.json").as_str()], &record[..]].concat());
    write(&|cable| cable["youngs_modulus"] = 0.5e11.into());
    let other_modulus = json(&[&[file], &record[..]].concat());
    for (one, other) in down_and_left(&even).into_iter().zip(down_and_left(&other_modulus)) {
        assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
    }
    write(&|cable| {
        cable["section"] = 2.4e-5.into();
        cable["diameter"] = 0.006.into();
        cable["linear_density"] = 0.19385.into();
    });
    let section = ["--section", "1.2566370614e-5"];
    let thicker = json(&[&[file], &record[..], &section].concat());
    let by_law = json(&[file, "--law", &data_path("cables/caroca-4mm-law.json")]);
    let ([down, _], [even, _], [by_law, _]) =
        (down_and_left(&thicker), down_and_left(&even), down_and_left(&by_law));
    assert!((down / by_law - 1.0).abs() < 1e-5 && down.abs() < 0.98 * even.abs(), "{down} {by_law} {even}");
    let arguments = [&["hysteresis", file], &record[..], &["--pose", "0,0,1.75", "--payload", "50"]].concat();
    let refused = cdpr(&arguments);
    assert!(unwrapped(refused.stderr).contains("differ in their section: expected --section"));
}

#[test]
fn a_cable_that_loses_no_energy_has_no_loop() {
    let arguments = ["hysteresis", "caroca-law", "--pose", "0,0,1.75", "--payload", "50"];
    let output = cdpr(&arguments);
    assert!(output.status.success() && output.stderr.is_empty(), "{}", unwrapped(output.stderr));
    let printed = text(output.stdout);
    assert!(!printed.contains("-0.0000"));
    assert!(printed.contains("tensions at the middle of each cable"), "{printed}");
}

#[test]
fn a_loop_that_gives_energy_is_said_to_do_so() {
    let output = hysteresis(&["--payload", "50", "--with", "same-tension"]);
    assert!(output.status.success());
    let warning = unwrapped(output.stderr);
    assert!(warning.contains("runs the wrong way round"), "{warning}");
    // Of a gram, only rounding is left of a loop.
    for unloading in [&[][..], &["--with", "same-tension"]] {
        let output = hysteresis(&[&["--payload", "1e-3"], unloading].concat());
        assert!(output.status.success() && output.stderr.is_empty(), "{}", unwrapped(output.stderr));
    }
}

#[test]
fn an_invalid_payload_or_length_is_refused() {
    let refused = hysteresis(&["--payload", "-1"]);
    assert!(!refused.status.success() && refused.stdout.is_empty());
    assert!(
        unwrapped(refused.stderr).contains("'-1' for '--payload <PAYLOAD>': expected a mass above zero [kg]")
    );
    let refused = hysteresis(&["--payload", "50", "--length", "0"]);
    assert!(!refused.status.success());
}

#[test]
fn a_platform_on_four_cables_needs_its_free_coordinates() {
    let law = data_path("cables/caroca-4mm-law.json");
    let given = ["hysteresis", "four-cables", "--law", &law, "--pose", "0.5,0.3,2", "--payload", "5"];
    let output = cdpr(&given);
    assert_eq!(output.status.code(), Some(1));
    assert!(unwrapped(output.stderr).contains("expected `--free` with as many names"));
    let output = cdpr(&[&given[..], &["--free", "roll,pitch", "--format", "json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", unwrapped(output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let [down, left] = down_and_left(&found);
    assert!(down < left && left < 0.0, "{down} {left}");
    let [given, lost] =
        ["payload_work_j", "dissipated_j"].map(|name| found.get(name).and_then(Value::as_f64).unwrap());
    assert!(given > 0.0 && (given / lost - 1.0).abs() < 1e-3, "{given} {lost}");
}

#[test]
fn a_platform_that_falls_in_its_load_cycle_has_an_answer_and_the_exit_code_3() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("top-heavy.json");
    let mut robot: Value = serde_json::from_str(&data_text("robots/four-cables.json")).unwrap();
    robot["platform"]["center_of_mass"][2] = 0.4.into();
    std::fs::write(&path, robot.to_string()).unwrap();
    let law = data_path("cables/caroca-4mm-law.json");
    let given = ["hysteresis", path.to_str().unwrap(), "--law", &law, "--pose", "0.5,0.3,2", "--free"];
    let given = [&given[..], &["roll,pitch", "--payload", "150", "--with", "steps=5"]].concat();
    let output = cdpr(&given);
    assert_eq!(output.status.code(), Some(3), "{}", unwrapped(output.stderr));
    assert!(text(output.stdout).contains("the platform falls from"));
    let output = cdpr(&[&given[..], &["--format", "json"]].concat());
    assert_eq!(output.status.code(), Some(3));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let error = &found["error"];
    assert_eq!(error["kind"], "branch_ends");
    let share = error["share"].as_f64().unwrap();
    assert!(0.0 < share && share < 1.0 && error["falls_from"].is_array(), "{found}");
}

#[test]
fn friction_of_pulleys_leaves_a_loop_and_two_tensions() {
    let robot = data_path("reference/robots/suspended-leads.json");
    let given = ["hysteresis", &robot, "--pose", "0,0,1.5", "--payload", "40", "--with"];
    let output = cdpr(&[&given[..], &["steps=5,friction=0.05,bearing=0.01", "--format", "json"]].concat());
    let found: Value = serde_json::from_str(&answered(output)).unwrap();
    let number = |path: &str| found.pointer(path).and_then(Value::as_f64).unwrap();
    assert_eq!([number("/pulleys/friction"), number("/pulleys/bearing")], [0.05, 0.01]);
    assert!(number("/residual_mm/2") < -0.01 && number("/pulleys/gap_mm") >= -number("/residual_mm/2"));
    assert!(number("/payload_work_j") > 0.0 && number("/dissipated_j").abs() < 1e-9);
    let [at_platform, at_winch] = ["platform", "winch"].map(|of| {
        let tension = |i: usize, k: usize| number(&format!("/pulleys/cables/{i}/{of}_tension_n/{k}"));
        (0..8).map(|i| [tension(i, 0), tension(i, 1), tension(i, 2)]).collect::<Vec<_>>()
    });
    for (platform, winch) in at_platform.iter().zip(&at_winch) {
        assert_eq!(platform[0], winch[0]);
        assert!((platform[1] - winch[1]).abs() <= number("/pulleys/greatest_difference_n"));
    }
    assert!(!found["pulleys"]["slipping"].as_array().unwrap().is_empty());
    let said = unwrapped(cdpr(&[&given[..], &["steps=5,friction=0.05"]].concat()).stdout);
    assert!(
        said.contains("N between winch and platform") && said.contains("the rest at the pulleys"),
        "{said}"
    );
    // One coefficient of zero is no friction.
    let none = answered(cdpr(&[&given[..], &["steps=5,friction=0"]].concat())).replace('\n', " ");
    assert!(!none.contains("winch") && none.contains("0.00000 mm are left"), "{none}");
}

#[test]
fn friction_without_pulleys_or_out_of_its_range_is_refused() {
    for (robot, with, said) in [
        ("ipanema-1", "friction=0.05", "friction is 0.05: expected zero for a robot without pulleys"),
        ("caroca", "bearing=0.01", "bearing is 0.01: expected zero for a robot without pulleys"),
        ("ipanema-3", "friction=-1", "friction is -1: expected a coefficient of pulleys from 0 to 1"),
        ("ipanema-3", "bearing=0.7", "bearing is 0.7: expected a coefficient of pulleys from 0 to 0.5"),
        ("ipanema-3", "friction", "expected friction=VALUE"),
    ] {
        let refused = cdpr(&["hysteresis", robot, "--pose", "0,0,1.5", "--payload", "5", "--with", with]);
        assert!(!refused.status.success() && refused.stdout.is_empty());
        let error = unwrapped(refused.stderr);
        assert!(error.contains(said), "{error}");
    }
}

#[test]
fn pulleys_without_friction_and_elastic_cables_leave_no_loop() {
    let found = json(&["caroca", "--with", "friction=0,bearing=0"]);
    let plain = ["deflection", "caroca", "--pose", "0,0,1.75", "--payload", "50", "--format", "json"];
    let plain: Value = serde_json::from_str(&answered(cdpr(&plain))).unwrap();
    let [down, left] = down_and_left(&found);
    let expected = plain["deflection_mm"][2].as_f64().unwrap();
    assert!((down / expected - 1.0).abs() < 1e-6 && left.abs() < 1e-9, "{down} {expected} {left}");
    let missing = unwrapped(cdpr(&["hysteresis", "caroca", "--pose", "0,0,1.75", "--payload", "50"]).stderr);
    assert!(missing.contains("or --with friction=MU for pulleys"), "{missing}");
}
