//! Figures drawn again from a folder of results.

use cdpr_report::{Sheet, draw, figures};
use cdpr_study::{Existing, Results, Study, TableFormat, Watcher, begin};
use serde_json::json;

#[test]
fn figures_of_results_that_are_read_back_are_those_that_the_run_has_drawn() {
    let mut study = crate::common::data("studies/caroca.json");
    let axis = |min, max| json!({"min": min, "max": max, "points": 2});
    study["replicates"] = json!(2);
    study["bootstrap_resamples"] = json!(20);
    study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "geometrical");
    study["samplings"]["geometrical"]["observations"] = json!(100);
    study["samplings"]["plane"] = json!({
        "title": "Over a plane", "error_model": "table_4", "observations": 100,
        "poses": {"grid": {"x": axis(-1.0, 1.0), "y": axis(-0.5, 0.5),
                           "z": {"min": 1.75, "max": 1.75, "points": 1}}},
    });
    study["surfaces"].as_object_mut().unwrap().retain(|name, _| name == "surface_E_rho");
    for axis in ["x", "y"] {
        study["surfaces"]["surface_E_rho"][axis]["points"] = json!(3);
    }
    study["robot"] = json!("robot.json");

    let folder = tempfile::TempDir::new().unwrap();
    let robot = crate::common::data("robots/caroca.json");
    std::fs::write(folder.path().join("robot.json"), robot.to_string()).unwrap();
    let study = Study::from_json(&study.to_string(), &folder.path().join("study.json")).unwrap();
    let out = folder.path().join("results");
    let blocks = begin(&out, &study, Existing::Refuse).unwrap();
    let watcher = Watcher { begin: &|_| (), tick: &|_| (), warn: &|_| (), note: &|_| (), stop: &|| false };
    let run = cdpr_study::run(&study, &blocks, Some(TableFormat::None), &draw, watcher).unwrap();

    drop(blocks);
    let again = figures(&Results::read(&out).unwrap(), Sheet::SCREEN);
    let names: Vec<&str> = again.iter().map(|figure| figure.name.as_str()).collect();
    let expected = [
        "geometrical",
        "geometrical_effects",
        "plane_mean",
        "plane_std",
        "plane_dominant",
        "surface_E_rho",
        "anchor_points",
        "exit_points",
        "robot",
    ];
    assert_eq!(names, expected);
    assert!(again.iter().all(|figure| figure.svg.is_ok()), "{again:?}");
    assert_eq!(again, run.figures);
}
