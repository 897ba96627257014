//! Bad input of `cdpr study run`: refused with file, field, value and remedy.

use crate::study_run::{bench, refusal};
use serde_json::{Value, json};

/// Spoils one value of the robot or the study and expects the message to hold all the given words.
pub(crate) fn refused(spoil: impl Fn(&mut Value, &mut Value), words: &[&str]) {
    let bench = bench();
    let (mut robot, mut study) = (bench.json("robot.json"), bench.json("study.json"));
    spoil(&mut robot, &mut study);
    bench.change("robot.json", |content| *content = robot);
    bench.change("study.json", |content| *content = study);
    let message = refusal(&bench, &[]);
    for word in words {
        assert!(message.contains(word), "`{word}` is not in: {message}");
    }
    assert!(!bench.path("out").exists(), "nothing is made for a study that cannot run");
}

#[test]
fn bad_robots_are_refused_with_file_field_value_and_remedy() {
    let file = "error: robot.json: ";
    refused(
        |r, _| r["platform"] = json!({"center_of_mass": [0, 0, 0]}),
        &[file, "line", "platform: missing field `mass`"],
    );
    refused(
        |r, _| r["platform"]["mas"] = json!(1),
        &[file, "platform.mas: unknown field `mas`", "expected one of `mass`, `center_of_mass`"],
    );
    refused(
        |r, _| r["gravity"] = json!(null),
        &[file, "gravity: expected a number [m/s²] or a vector of three"],
    );
    refused(
        |r, _| r["cables"].as_array_mut().unwrap().truncate(0),
        &[file, "cables is an empty list", "at least one cable"],
    );
    refused(|r, _| r["cables"][3] = r["cables"][1].clone(), &[file, "cables[3] is coincident", "cable 2"]);
    refused(
        |r, _| r["cable"]["section"] = json!(-1e-5),
        &[file, "cable.section is -0.00001", "positive section [m²]"],
    );
    refused(
        |r, _| r["tension_limits"]["min"] = json!(20000),
        &[file, "tension_limits.max is 10290", "above tension_limits.min"],
    );
    refused(
        |r, _| r["cables"][0]["exit_point"] = json!([1, 2]),
        &[file, "cables[0].exit_point: invalid length 2"],
    );
}

#[test]
fn bad_studies_are_refused_with_file_field_value_and_remedy() {
    let file = "error: study.json: ";
    refused(|_, s| s["payload"] = json!(-5), &[file, "payload is -5", "above zero [kg]"]);
    refused(|_, s| s["samplngs"] = json!({}), &[file, "unknown field `samplngs`", "expected one of"]);
    refused(|_, s| s["format"] = json!("cdpr-study/7"), &[file, "format is cdpr-study/7", "cdpr-study/1"]);
    refused(|_, s| s["replicates"] = json!(1), &[file, "replicates is 1", "2 to 10000"]);
    refused(|_, s| s["confidence"] = json!(95), &[file, "confidence is 95", "above 0, at most 0.999999"]);
    refused(
        |_, s| s["samplings"]["mechanical"]["error_model"] = json!("table_5"),
        &[file, "samplings.mechanical.error_model is table_5", "one of table_3, table_4"],
    );
    refused(
        |_, s| s["error_models"]["table_3"]["masss"] = s["error_models"]["table_3"]["mass"].clone(),
        &[file, "masss", "a parameter"],
    );
    refused(
        |_, s| s["error_models"]["table_3"]["mass"]["law"] = json!({"uniform": {"min": 1.0, "max": -1.0}}),
        &[file, "error_models.table_3", "mass", "max"],
    );
    refused(
        |_, s| s["surfaces"]["surface_E_rho"]["x"]["points"] = json!(1),
        &[file, "surfaces.surface_E_rho.x.points is 1", "at least 2"],
    );
    for points in [10_001, u64::MAX] {
        refused(
            |_, s| s["surfaces"]["surface_E_rho"]["x"]["points"] = json!(points),
            &[file, &format!("surfaces.surface_E_rho.x.points is {points}"), "at most 10000"],
        );
    }
    refused(
        |_, s| s["samplings"]["geometrical"]["pose"]["position"] = json!([0, 0, 5]),
        &[
            file,
            "samplings.geometrical.pose.position is [0.0, 0.0, 5.0]",
            "no tensions between 1 N and 10290 N balance the wrench",
        ],
    );
    refused(|_, s| s["robot"] = json!("nowhere.json"), &["error: cannot read nowhere.json: No such file"]);
}

#[test]
fn bad_arguments_are_refused() {
    let bench = bench();
    assert!(refusal(&bench, &["--observations", "1"]).contains("expected a count, 3 to 1e10"));
    assert!(
        refusal(&bench, &["--observations", "many"]).contains("invalid value 'many' for '--observations")
    );
    assert!(refusal(&bench, &["--threads", "0"]).contains("0 is not in 1"));
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_anything_runs() {
    let bench = bench();
    std::fs::write(bench.path("out"), "a file").unwrap();
    assert!(refusal(&bench, &[]).starts_with("error: cannot write out: "));
}

#[test]
fn a_study_with_errors_in_a_file_is_refused_at_the_place_in_its_own_text() {
    let with_file = |change: &dyn Fn(&mut Value)| {
        let bench = bench();
        let tolerances = serde_json::to_string(&json!({"mass": {"law": {"normal": {"mean": 0, "std": 1}}}}));
        std::fs::write(bench.path("tolerances.json"), tolerances.unwrap()).unwrap();
        bench.change("study.json", |study| {
            for model in study["error_models"].as_object_mut().unwrap().values_mut() {
                *model = json!({"file": "tolerances.json"});
            }
            change(study);
        });
        let text = std::fs::read_to_string(bench.path("study.json")).unwrap();
        (refusal(&bench, &[]), text)
    };
    let (message, _) = with_file(&|study| drop(study.as_object_mut().unwrap().remove("payload")));
    assert!(message.contains("payload is 0: expected a finite mass above zero [kg]"), "{message}");
    let (message, text) = with_file(&|study| study["payload"] = json!(-1));
    let line = text.lines().position(|line| line.contains("\"payload\"")).unwrap() + 1;
    assert!(message.contains("payload is -1: expected a finite mass"), "{message}");
    assert!(message.contains(&format!("(line {line}, column ")), "{message}");
}
