//! `cdpr explore`: the page holds the robot and names its file as commands take it.

use crate::common::{Bench, answered, cdpr, cdpr_in, data_path, json_file};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

/// What the script of a page reads.
fn held(page: &Path) -> Value {
    let page = std::fs::read_to_string(page).unwrap();
    let (_, rest) = page.split_once("<script type=\"application/json\" id=\"data\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn a_page_of_a_robot_a_study_or_results_names_the_file_of_the_robot() {
    let bench = Bench::new("caroca.json", |study| {
        study["samplings"].as_object_mut().unwrap().shift_remove("geometrical");
        study["surfaces"] = serde_json::json!({});
        for sampling in study["samplings"].as_object_mut().unwrap().values_mut() {
            sampling["observations"] = serde_json::json!(64);
        }
    });
    bench.run("results", &[]);
    let folder = bench.path("");
    let inputs = [
        ("robot.json", "robot.json", false),
        ("cogiro", "cogiro", false),
        ("study.json", "robot.json", true),
        ("results", "results/robot.json", true),
    ];
    for (input, file, has_study) in inputs {
        answered(cdpr_in(&folder, &["explore", input, "--out", "page.html", "--overwrite"]));
        let held = held(&bench.path("page.html"));
        assert_eq!(held["file"], file, "{input}");
        assert_eq!(held["study"].is_object(), has_study, "{input}");
        answered(cdpr_in(&folder, &["robot", "check", file]));
    }
}

#[test]
fn a_study_at_many_poses_alone_is_explored_with_assumed_tolerances() {
    let folder = TempDir::new().unwrap();
    let mut study = json_file(data_path("studies/caroca.json"));
    study["robot"] = data_path("robots/cogiro.json").into();
    study["surfaces"] = serde_json::json!({});
    let samplings = study["samplings"].as_object_mut().unwrap();
    samplings.retain(|name, _| name == "mechanical");
    let sampling = samplings["mechanical"].as_object_mut().unwrap();
    sampling.shift_remove("pose");
    sampling.insert(
        "poses".into(),
        serde_json::json!({"list": [{"position": [0, 0, 2]}, {"position": [1, 0, 2]}]}),
    );
    let [file, page] = ["study.json", "page.html"].map(|name| folder.path().join(name));
    std::fs::write(&file, study.to_string()).unwrap();
    answered(cdpr(&["explore", file.to_str().unwrap(), "--out", page.to_str().unwrap()]));
    assert_eq!(held(&page)["study"], Value::Null);
}
