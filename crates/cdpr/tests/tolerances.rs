//! `cdpr study tolerances` as a user meets it.

use crate::common::{cdpr, data_path, data_text, text, unwrapped};
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::process::{Command, Output, Stdio};

fn tolerances(arguments: &[&str]) -> Output {
    let study = data_path("studies/caroca.json");
    cdpr(&[&["study", "tolerances", &study, "--sampling", "mechanical"], arguments].concat())
}

#[test]
fn the_budget_is_printed_as_a_table_and_as_json() {
    let text = text(tolerances(&["--limit", "deflection_mm<1.4", "--observations", "2000"]).stdout);
    let modulus = text.lines().find(|line| line.contains("\u{2502} youngs_modulus")).unwrap();
    assert!(modulus.contains("99.45") && text.starts_with("For 95 % below 1.4 mm, tighten "), "{text}");
    assert!(modulus.contains(" Pa "), "{text}");

    let json =
        tolerances(&["--limit", "deflection_mm<1.4", "--costs", "youngs_modulus=3", "--format", "json"]);
    let json: Value = serde_json::from_slice(&json.stdout).unwrap();
    let tightest = &json["tolerances"][0];
    assert_eq!(
        (tightest["name"].as_str().unwrap(), tightest["cost"].as_f64().unwrap()),
        ("youngs_modulus", 3.0)
    );
    assert!(json["tightened"]["quantile_mm"]["low"].as_f64().unwrap() <= 1.4);
    assert!(json["tightened"]["within"]["value"].as_f64() > json["now"]["within"]["value"].as_f64());
}

#[test]
fn what_is_wrong_is_named_and_the_exit_code_is_not_zero() {
    for (arguments, words) in [
        (&["--limit", "deflection_mm<1.2"][..], "limit is 1.2 mm: expected one that tolerances reach"),
        (&["--limit", "deflection_mm<-1"], "limit is -1: expected a positive finite number"),
        (&["--limit", "deflection_mm<1.4", "--quantile", "2"], "quantile is 2: expected a share"),
        (
            &["--limit", "deflection_mm<1.4", "--costs", "z=2"],
            "costs is z: expected one of the tolerances mass, linear_density",
        ),
        (&["--limit", "position_error_mm<far"], "`far` is not a finite number"),
        (&["--limit", "1.4"], "expected COLUMN<VALUE"),
        (&["--limit", "magnitude_mm<1.4"], "expected deflection_mm or position_error_mm < a number"),
    ] {
        let output = tolerances(arguments);
        let message = unwrapped(output.stderr);
        assert!(!output.status.success() && message.contains(words), "{message}");
    }
}

#[test]
fn the_quantity_of_the_limit_decides_whatever_the_output_of_the_study_is() {
    let folder = tempfile::tempdir().unwrap();
    let run = |output: &str, options: &[&str]| {
        let mut study: Value = serde_json::from_str(&data_text("studies/caroca.json")).unwrap();
        study["output"] = output.into();
        study["robot"] = data_path("robots/caroca.json").into();
        let path = folder.path().join("study.json");
        std::fs::write(&path, study.to_string()).unwrap();
        let study =
            ["study", "tolerances", path.to_str().unwrap(), "--sampling", "geometrical", "--format", "json"];
        cdpr(&[&study, options].concat())
    };
    let limit = ["--limit", "position_error_mm<30", "--observations", "500"];
    let of_position = run("position", &limit);
    let json: Value = serde_json::from_slice(&of_position.stdout).unwrap();
    assert_eq!(json["of"], "position");
    assert!(json["now"]["quantile_mm"]["value"].as_f64().unwrap() > 10.0, "{json}");
    let named = run("stiffness", &limit);
    assert_eq!(text(named.stdout), text(of_position.stdout));
}

#[test]
fn the_only_sampling_of_a_study_needs_no_name_and_several_are_named() {
    let limit = ["--limit", "deflection_mm<1.4", "--observations", "200"];
    let mut study: Value = serde_json::from_str(&data_text("studies/caroca.json")).unwrap();
    study["robot"] = data_path("robots/caroca.json").into();
    let samplings = study["samplings"].as_object().unwrap().clone();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.json");
    let run =
        |more: &[&str]| cdpr(&[&["study", "tolerances", path.to_str().unwrap()], &limit[..], more].concat());
    std::fs::write(&path, study.to_string()).unwrap();
    let several = run(&[]);
    let message = unwrapped(several.stderr);
    assert_eq!(several.status.code(), Some(2), "{message}");
    assert!(message.contains("expected --sampling with one of mechanical, "), "{message}");
    study["samplings"] = serde_json::json!({"mechanical": samplings["mechanical"]});
    study.as_object_mut().unwrap().remove("surfaces");
    std::fs::write(&path, study.to_string()).unwrap();
    let one = run(&[]);
    assert!(one.status.success(), "{}", unwrapped(one.stderr));
    assert_eq!(one.stdout, run(&["--sampling", "mechanical"]).stdout);
}

#[test]
fn a_study_that_is_not_there_is_named_without_the_error_model() {
    let given = "nowhere/study.json:table_4";
    let at = ["derivatives", "caroca", "--pose", "0,0,1.75", "--payload", "5", "--uncertainty", given];
    let output = cdpr(&at);
    let message = unwrapped(output.stderr);
    assert!(message.starts_with("error: cannot read nowhere/study.json: "), "{message}");
}

#[test]
fn the_error_model_of_another_robot_is_refused() {
    let (robot, study) = (data_path("robots/cogiro.json"), data_path("studies/caroca.json"));
    let other = data_path("robots/grab.json");
    for robot in [&other, &robot] {
        let at = ["derivatives", robot, "--pose", "0,0,1", "--payload", "5"];
        let output = cdpr(&[&at[..], &["--uncertainty", &format!("{study}:table_4")]].concat());
        let message = unwrapped(output.stderr);
        let refused = message.contains("whose parameters are not those of");
        // CoGiRo has eight cables as CAROCA has, and the same parameters.
        assert_eq!(refused, robot == &other, "{message}");
    }
}

/// What takes minutes.
const LONG: [&str; 4] = ["--limit", "deflection_mm<1.4", "--observations", "16777216"];

#[test]
fn a_long_search_writes_a_line_of_progress_to_a_log() {
    let study = data_path("studies/caroca.json");
    let mut command = Command::new(env!("CARGO_BIN_EXE_cdpr"));
    command.args(["study", "tolerances", &study, "--sampling", "mechanical"]).args(LONG);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
    let first = lines.next();
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(first.unwrap().unwrap(), "looking for the tolerances, 5 s");
}

#[test]
fn tolerances_under_which_many_robots_with_few_cables_have_no_rest_are_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let given = ["four-cables", "--free", "roll,pitch", "--pose", "0.5,0.3,2"];
    let template = cdpr(&[&["study", "new"], &given[..]].concat());
    let mut study: Value = serde_json::from_slice(&template.stdout).unwrap();
    let errors = study["error_models"]["tolerances"].as_object_mut().unwrap();
    for entry in ["a", "b", "cog"] {
        let law = &mut errors[entry]["law"]["uniform"];
        for end in ["min", "max"] {
            law[end] = (10.0 * law[end].as_f64().unwrap()).into();
        }
    }
    let path = folder.path().join("study.json");
    std::fs::write(&path, study.to_string()).unwrap();
    let output = cdpr(&[
        "study",
        "tolerances",
        path.to_str().unwrap(),
        "--sampling",
        "all",
        "--limit",
        "deflection_mm<5",
    ]);
    let message = unwrapped(output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    // Of the first 64 of 4096 robots, 40 % have no rest.
    assert!(message.contains("of 64 robots with these tolerances"), "{message}");
    assert!(message.contains("expected tighter tolerances, or a pose"), "{message}");
    // The first reason is that of a robot next to the nominal one: no other rest was looked for.
    assert!(message.contains("no rest with these coordinates was found next to the known one"), "{message}");
}
