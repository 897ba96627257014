//! A file of one kind where another is expected: the message names both, and the command that takes it.

use crate::common::{cdpr_in, data_path, unwrapped};
use serde_json::json;
use std::path::Path;
use tempfile::TempDir;

/// A folder with one file of each kind.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    let copies = [
        ("robot.json", "robots/caroca.json"),
        ("study.json", "studies/caroca.json"),
        ("law.json", "cables/caroca-4mm-law.json"),
        ("record.csv", "cables/caroca-4mm-record.csv"),
        ("model.json", "calibration/caroca-tolerances.json"),
        ("poses.csv", "poses/caroca.csv"),
        ("yaml.yaml", "reference/exchange/caroca.yaml"),
    ];
    for (name, of) in copies {
        std::fs::copy(data_path(of), folder.path().join(name)).unwrap();
    }
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("measurements.json", &json!({"format": "cdpr-measurements/1", "rows": []}).to_string());
    write("broken-study.json", "{\"format\": \"cdpr-study/1\", \"robot\": \"caroca\",, }");
    write("page.html", "<!DOCTYPE html><title>page</title>");
    write("list.json", "[[0, 0, 1.75]]");
    folder
}

/// The message of a command, which must fail with code 1.
fn refused(folder: &Path, command: &str) -> String {
    let output = cdpr_in(folder, &command.split(' ').collect::<Vec<_>>());
    let message = unwrapped(output.stderr);
    assert!(output.status.code() == Some(1) && output.stdout.is_empty(), "{command}: {message}");
    message
}

#[test]
fn a_file_of_another_kind_is_named_with_the_command_that_takes_it() {
    let folder = folder();
    let at = "--pose 0,0,1.75";
    let modulus = "--breaking-force 10290 --section 1e-5 --length 1 --range 5-10";
    for (command, message) in [
        (
            "robot check study.json".to_owned(),
            "study.json is a study file: expected a robot file: `cdpr study run` takes it",
        ),
        (
            "robot check broken-study.json".to_owned(),
            "broken-study.json is a study file: expected a robot file: `cdpr study run` takes it",
        ),
        (
            "study run robot.json".to_owned(),
            "robot.json is a robot file: expected a study file: `cdpr study new`",
        ),
        (format!("inverse law.json {at}"), "law.json is a law file: expected a robot file: `cdpr hysteresis"),
        (
            format!("inverse poses.csv {at}"),
            "poses.csv is a table: expected a robot file: `cdpr robot import`",
        ),
        (
            format!("inverse yaml.yaml {at}"),
            "yaml.yaml is a file to import: expected a robot file: `cdpr robot import`",
        ),
        (format!("inverse page.html {at}"), "page.html is a file to import: expected a robot file"),
        (
            "inverse robot.json --poses robot.json".to_owned(),
            "robot.json is a robot file: expected a list of poses: `cdpr robot check` takes it",
        ),
        (
            "inverse robot.json --poses list.json".to_owned(),
            "--poses list.json, answer 1: it is no answer: expected a table, as --format csv prints it",
        ),
        ("analyse study.json".to_owned(), "study.json is a study file: expected a table: `cdpr study run`"),
        (
            "analyse measurements.json".to_owned(),
            "measurements.json is measurements: expected a table: `cdpr calibrate fit` takes it",
        ),
        (format!("cable modulus robot.json {modulus}"), "robot.json is a robot file: expected a record"),
        (
            format!("hysteresis robot.json {at} --payload 5 --law robot.json"),
            "robot.json is a robot file: expected a law file",
        ),
        (
            "direct robot.json --from study.json".to_owned(),
            "study.json is a study file: expected a file of cases",
        ),
        (
            "calibrate fit robot.json robot.json --noise length=1e-3 --out out".to_owned(),
            "robot.json is a robot file: expected measurements: `cdpr robot check` takes it",
        ),
        (
            "robot import robot.json".to_owned(),
            "robot.json is a robot file: expected a file to import: `cdpr robot check`",
        ),
        (
            "robot import poses.csv --cable robot.json".to_owned(),
            "robot.json is a robot file: expected a cable file: `cdpr robot check` takes it",
        ),
        ("study report study.json".to_owned(), "study.json is a file: expected a folder of results"),
        ("study status study.json".to_owned(), "study.json is a file: expected a folder of results"),
    ] {
        let said = refused(folder.path(), &command);
        assert!(said.contains(message), "{command}: {said}");
    }
}

#[test]
fn an_error_model_is_one_and_no_study_or_robot() {
    let folder = folder();
    let calibrate = "calibrate fit robot.json --noise length=1e-3 --out out poses.csv --uncertainty";
    let said = refused(folder.path(), &format!("{calibrate} robot.json"));
    assert!(
        said.contains("robot.json is a robot file: expected an error model: `cdpr robot check`"),
        "{said}"
    );
}
