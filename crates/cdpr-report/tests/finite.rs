//! No result, table, figure or report has a number that is not finite, whatever is degenerate about a study
//! or a robot.

use crate::common::data;
use cdpr_assess::{
    Further, Protocol, ProtocolSummary, RobustnessSummary, Workspace, WorkspaceSummary, begin_robustness,
    begin_workspace, compute_workspace, run_robustness, write_robustness, write_workspace,
};
use cdpr_report::{Sheet, draw, found_poses, report_with, success_share, workspace_maps};
use cdpr_robot::{Robot, Rotation3, Vector3, Wrench};
use cdpr_statics::Load;
use cdpr_study::{
    ErrorModel, Existing, Grid, GridAxis, IfExists, REPORT_NAME, Run, Study, TableFormat, Watcher, begin,
    run, uncertainties,
};
use serde_json::{Value, json};
use std::path::Path;

/// Checks a text as it is written, or the debug text of results, in which absent numbers are told from NaN.
fn assert_finite(what: &str, text: &str) {
    let mut words = text.split(|c: char| !c.is_ascii_alphanumeric());
    let found = words.find(|word| ["nan", "inf", "infinity"].contains(&word.to_ascii_lowercase().as_str()));
    assert!(found.is_none(), "{what} has {found:?}");
}

fn assert_all_finite(what: &str, folder: &Path) {
    let mut files = 0;
    for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        // What the report carries packed is programs, as letters in any order; its data and figures are text.
        let is_program =
            |script: &str| script.starts_with(" type=\"text/plain\"") || script.contains("function(");
        let without_programs = text.split("<script").map(|part| match part.split_once("</script>") {
            Some((script, rest)) if is_program(script) => rest,
            _ => part,
        });
        let without_programs = without_programs.collect::<Vec<_>>().join("\n");
        let parts = without_programs.split('"').filter(|part| !part.starts_with("data:"));
        assert_finite(&format!("{what}: {}", path.display()), &parts.collect::<Vec<_>>().join("\n"));
        files += 1;
    }
    assert!(files > 4, "{what}: {files} files");
}

/// Runs a small study of CAROCA with all measures, as `change` makes it and its robot, and checks all that it
/// writes; returns its summary.
fn check(what: &str, change: &dyn Fn(&mut Value, &mut Value)) -> Value {
    let (mut study, mut robot) = (data("studies/caroca.json"), data("robots/caroca.json"));
    study["robot"] = json!("robot.json");
    study["replicates"] = json!(2);
    study["bootstrap_resamples"] = json!(5);
    study["sensitivity"] = json!({
        "observations": 60, "saltelli_blocks": 16, "morris_blocks": 4, "derivative_points": 4,
        "expansion": {"max_degree": 1, "norm": 1.0, "interactions": 1}
    });
    study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
    study["samplings"]["mechanical"]["observations"] = json!(60);
    study["surfaces"].as_object_mut().unwrap().retain(|name, _| name == "surface_E_rho");
    let mut poses = study["samplings"]["mechanical"].clone();
    poses.as_object_mut().unwrap().remove("pose");
    poses["observations"] = json!(5);
    // The last one is beyond the frame.
    let axis = |min: f64, max: f64| json!({"min": min, "max": max, "points": 2});
    let level = json!({"min": 1.75, "max": 1.75, "points": 1});
    poses["poses"] = json!({"grid": {"x": axis(0.0, 9.0), "y": axis(0.0, 0.5), "z": level}});
    study["samplings"]["poses"] = poses;
    for axis in ["x", "y"] {
        study["surfaces"]["surface_E_rho"][axis]["points"] = json!(3);
    }
    change(&mut study, &mut robot);
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(folder.path().join("robot.json"), robot.to_string()).unwrap();
    let study = Study::from_json(&study.to_string(), &folder.path().join("study.json"));
    let study = study.unwrap_or_else(|error| panic!("{what}: {error}"));
    let out = folder.path().join("results");
    let blocks = begin(&out, &study, Existing::Refuse).unwrap();
    let watcher = Watcher { begin: &|_| (), tick: &|_| (), warn: &|_| (), note: &|_| (), stop: &|| false };
    let Run { results, figures } = run(&study, &blocks, Some(TableFormat::Csv), &draw, watcher).unwrap();
    let page = report_with(&results, &figures, None).unwrap();
    blocks.results().unwrap().write(REPORT_NAME, page.as_bytes()).unwrap();
    assert_finite(what, &format!("{:?}", results.summary));
    assert_finite(what, &format!("{:?} {:?}", results.poses, results.surfaces));
    assert_all_finite(what, &out);
    serde_json::to_value(&results.summary.studies).unwrap()
}

/// The error model of the sampling is one parameter with this law.
fn only(study: &mut Value, parameter: &str, of: Value) {
    study["error_models"]["table_3"] = json!({});
    study["error_models"]["table_3"][parameter] = of;
}

#[test]
fn a_study_of_which_every_observation_fails_or_few_are_made() {
    let heavy = json!({"law": {"uniform": {"min": 1e6, "max": 2e6}}});
    let found = check("all fail", &|study, _| study["error_models"]["table_3"]["mass"] = heavy.clone());
    assert!(found["mechanical"]["magnitude_mm"].is_null());
    let half = json!({"law": {"uniform": {"min": -10.0, "max": 20000.0}}});
    let found = check("most fail", &|study, _| study["error_models"]["table_3"]["mass"] = half.clone());
    assert!(found["mechanical"]["failed"].as_object().unwrap().values().any(|count| *count != 0));
    check("three observations", &|study, _| {
        for name in ["mechanical", "poses"] {
            study["samplings"][name]["observations"] = json!(3);
        }
        study["sensitivity"]["observations"] = json!(3);
    });
}

#[test]
fn a_study_of_which_all_outputs_are_the_same() {
    let tiny = json!({"law": {"uniform": {"min": -1e-300, "max": 1e-300}}});
    let found = check("deviations below rounding", &|study, _| only(study, "mass", tiny.clone()));
    assert_eq!(found["mechanical"]["magnitude_mm"]["std"], json!(0.0));
    check("hardly any load", &|study, _| study["payload"] = json!(1e-300));
    check("a load below rounding", &|study, _| study["payload"] = json!(1e-9));
    check("one uncertain parameter", &|study, _| {
        only(study, "mass", json!({"law": {"uniform": {"min": -1.0, "max": 1.0}}}));
    });
}

#[test]
fn robots_that_are_odd_but_valid() {
    check("cables without weight", &|study, robot| {
        robot["cable"]["linear_density"] = json!(0.0);
        only(study, "mass", json!({"law": {"uniform": {"min": -1.0, "max": 1.0}}}));
        study["surfaces"] = json!({});
    });
    check("stiff cables", &|_, robot| robot["cable"]["youngs_modulus"] = json!(1e20));
    check("centre of mass at P", &|_, robot| robot["platform"]["center_of_mass"] = json!([0.0, 0.0, 0.0]));
    check("a light platform", &|study, robot| {
        robot["platform"]["mass"] = json!(1e-3);
        only(study, "youngs_modulus", json!({"law": {"uniform": {"min": -1e9, "max": 1e9}}}));
        study["samplings"].as_object_mut().unwrap().remove("poses");
        study["surfaces"] = json!({});
    });
}

#[test]
fn workspaces_of_which_nothing_is_held_or_without_load() {
    let robot = Robot::from_json(&data("robots/caroca.json").to_string()).unwrap();
    let tolerances = ErrorModel::normal(&robot, &uncertainties(&robot, &[("mass".to_owned(), 0.5)]).unwrap());
    let point = |min: f64, max: f64, points: usize| GridAxis { min, max, points };
    let near = [point(0.0, 0.5, 2), point(0.0, 0.5, 2), point(1.75, 1.75, 1)];
    let far = [point(50.0, 60.0, 2), point(0.0, 0.5, 2), point(1.75, 1.75, 1)];
    let sideways = Load { payload: 0.0, wrench: Wrench { force: Vector3::x(), moment: Vector3::zeros() } };
    for (what, [x, y, z], load) in [
        ("held", near, Load::payload(50.0)),
        ("without load", near, Load::none()),
        ("sideways", near, sideways),
        ("hardly any load", near, Load::payload(1e-300)),
        ("nothing held", far, Load::payload(50.0)),
    ] {
        let folder = tempfile::TempDir::new().unwrap();
        let owned = begin_workspace(folder.path(), IfExists::Refuse, &[]).unwrap();
        let grid = Grid::new([x, y, z]).unwrap();
        let tolerances = Some(&tolerances).filter(|_| load != Load::none());
        let workspace = Workspace {
            robot: &robot,
            grid,
            rotation: Rotation3::identity(),
            load,
            tolerances,
            free: &[],
            further: Further::default(),
        };
        let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
        let summary = WorkspaceSummary::new(&workspace, &poses);
        let maps = workspace_maps(&robot, &summary, None, usize::MAX, Sheet::SCREEN).into_iter();
        let maps: Vec<_> = maps.filter_map(|map| Some((map.name, map.svg.ok()?))).collect();
        write_workspace(&owned, &summary, &maps, None).unwrap();
        assert_finite(what, &format!("{summary:?}"));
        if !maps.is_empty() {
            assert_all_finite(what, folder.path());
        }
    }
}

#[test]
fn a_robustness_of_cables_of_any_stiffness() {
    let robot = Robot::from_json(&data("robots/cogiro.json").to_string()).unwrap();
    for modulus in [5e9, 35e9, 1e16] {
        let folder = tempfile::TempDir::new().unwrap();
        let owned = begin_robustness(folder.path(), IfExists::Refuse).unwrap();
        let mut protocol = Protocol::mahnke_caverly(1, 1);
        protocol.youngs_modulus = Some(modulus);
        let results = vec![run_robustness(&robot, &protocol, &|| ()).unwrap()];
        let protocols =
            results.iter().map(|r| (r.protocol.name.to_owned(), ProtocolSummary::new(r))).collect();
        let (robot, version) = (robot.name.clone(), String::new());
        let summary = RobustnessSummary { robot, version, protocols };
        let figures = [
            ("found_poses", found_poses(&results[0])),
            ("success_share", success_share(&summary.protocols[0])),
        ];
        let figures: Vec<_> =
            figures.into_iter().filter_map(|(name, svg)| Some((name.to_owned(), svg.ok()?))).collect();
        write_robustness(&owned, &summary, &results, &figures).unwrap();
        assert_finite("robustness", &format!("{summary:?}"));
        assert_all_finite(&format!("E = {modulus}"), folder.path());
    }
}
