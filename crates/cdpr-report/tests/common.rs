//! Small studies with their folders of results.

use cdpr_study::{
    Existing, IndexMap, Results, Session, Study, StudySummary, Summary, SurfaceSummary, Timings, analyse,
    begin, compute_surface, observe, write_summary, write_surface, write_timings,
};
use serde_json::{Value, json};
use std::path::Path;

pub(crate) fn data(file: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(file);
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// CAROCA's study, or what `change` makes of it, with few observations and all measures of sensitivity.
pub(crate) fn caroca(change: impl FnOnce(&mut Value, &mut Value)) -> Results {
    let (mut study, mut robot) = (data("studies/caroca.json"), data("robots/caroca.json"));
    study["replicates"] = json!(2);
    study["bootstrap_resamples"] = json!(20);
    study["sensitivity"] = json!({
        "observations": 200, "saltelli_blocks": 32, "morris_blocks": 4, "derivative_points": 4,
        "expansion": {"max_degree": 1, "norm": 1.0, "interactions": 1}
    });
    for sampling in study["samplings"].as_object_mut().unwrap().values_mut() {
        sampling["observations"] = json!(400);
    }
    for surface in study["surfaces"].as_object_mut().unwrap().values_mut() {
        surface["x"]["points"] = json!(13);
        surface["y"]["points"] = json!(11);
    }
    change(&mut study, &mut robot);
    run(study, &robot)
}

/// A sampling of CoGiRo, without surfaces or published figures.
pub(crate) fn cogiro() -> Results {
    let pose = json!({"position": [1.0, -0.5, 1.5], "quaternion": [0.996, 0.0, 0.0, 0.0872]});
    caroca(|study, robot| {
        *robot = data("robots/cogiro.json");
        study["name"] = json!("Static deflection of CoGiRo");
        study["samplings"] = json!({"all": {
            "title": "All parameters", "pose": pose, "error_model": "table_4", "observations": 200
        }});
        for field in ["surfaces", "sensitivity", "source"] {
            study.as_object_mut().unwrap().remove(field);
        }
        study["replicates"] = json!(0);
    })
}

/// Runs a study and reads its folder back.
fn run(mut study: Value, robot: &Value) -> Results {
    let folder = tempfile::TempDir::new().unwrap();
    study["robot"] = json!("robot.json");
    std::fs::write(folder.path().join("robot.json"), robot.to_string()).unwrap();
    let study = Study::from_json(&study.to_string(), &folder.path().join("study.json")).unwrap();
    let out = folder.path().join("results");
    let blocks = begin(&out, &study, Existing::Refuse).unwrap();
    let owned = blocks.results().unwrap();
    let (mut studies, session) = (IndexMap::new(), Session::in_memory());
    for name in study.file.samplings.keys() {
        let sampling = study.sampling(name).unwrap();
        let summary = analyse(&sampling, &observe(&sampling, &session).unwrap(), &session).unwrap();
        studies.insert(name.clone(), StudySummary::Sampling(Box::new(summary)));
    }
    for name in study.file.surfaces.keys() {
        let surface = study.surface(name).unwrap();
        let result = compute_surface(&surface, &|_| ());
        write_surface(owned, &surface, &result).unwrap();
        studies.insert(name.clone(), StudySummary::Surface(SurfaceSummary::new(&surface, &result)));
    }
    let summary = Summary::new(&study, studies).unwrap();
    write_summary(owned, &summary).unwrap();
    let seconds = study.file.samplings.keys().map(|name| (name.clone(), 0.25)).collect();
    write_timings(owned, &Timings { threads: 2, seconds, all: 0.8, ..Timings::default() }).unwrap();
    drop(blocks);
    let results = Results::read(&out).unwrap();
    // Wall times are not in the file.
    let in_file = |summary: &Summary| serde_json::to_value(summary).unwrap();
    assert_eq!(in_file(&results.summary), in_file(&summary));
    results
}
