//! Causes that act on several parameters at once.

use cdpr_robot::{Parameter, Pulley, Robot, Vector3, deviations};
use cdpr_sensitivity::SampleDesign;
use cdpr_study::{SensitivitySpec, Session, Study, StudyError, Truncation, measure, observe, template};
use serde_json::{Value, json};
use std::path::Path;

fn study(model: Value) -> Result<Study, StudyError> {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json"));
    let mut file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    file["replicates"] = json!(0);
    file["surfaces"] = json!({});
    file["error_models"] = json!({ "model": model });
    file["samplings"] = json!({ "blocks": {
        "title": "Pulley blocks", "pose": {"position": [0.5, 0.2, 1.75]},
        "error_model": "model", "observations": 1024,
    }});
    Study::from_json(&file.to_string(), path)
}

fn uniform(half: f64) -> Value {
    json!({ "uniform": { "min": -half, "max": half } })
}

/// An error of both points, and one of each.
fn two_points_of_a_block() -> Value {
    json!({
        "b1.z": { "law": uniform(0.01) },
        "b2.z": { "law": uniform(0.01) },
        "block": { "law": uniform(0.02), "parameters": { "b1.z": 1.0, "b2.z": 1.0 } },
        "tilt": { "law": uniform(0.001), "parameters": { "b1.z": 5.0, "b2.z": -5.0 } },
    })
}

#[test]
fn a_cause_moves_all_its_parameters_beside_their_own_deviations() {
    let study = study(two_points_of_a_block()).unwrap();
    let sampling = study.sampling("blocks").unwrap();
    let (robot, errors) = (sampling.robot, sampling.errors);
    let names: Vec<&str> = errors.inputs.iter().map(|input| input.name.as_str()).collect();
    assert_eq!(names, ["b1.z", "b2.z", "block", "tilt"]);
    let expected = [("b1.z", 0.001 + 0.01 + 0.0005), ("b2.z", 0.002 + 0.01 - 0.0005)];
    let moved = errors.deviations(&[0.001, 0.002, 0.01, 0.0001]);
    for (one, other) in moved.values().iter().zip(deviations(robot, &expected).unwrap()) {
        assert!((one - other).abs() < 1e-17);
    }
    let mut slopes = vec![0.0; errors.parameters()];
    let given = deviations(robot, &[("b1.z", 3.0), ("b2.z", 1.0)]).unwrap();
    for (slope, deviation) in slopes.iter_mut().zip(given) {
        *slope = deviation;
    }
    assert_eq!(errors.gradient(&slopes), [3.0, 1.0, 4.0, 10.0]);
    assert_eq!((errors.group(0), errors.group(2)), ("b", "b"));
}

#[test]
fn what_two_points_share_correlates_them_by_its_part_of_their_variance() {
    let mut model = two_points_of_a_block();
    model.as_object_mut().unwrap().remove("tilt");
    let study = study(model).unwrap();
    let sampling = study.sampling("blocks").unwrap();
    let mut rows = vec![0.0; 3 * 1024];
    sampling.design.rows(0, &mut rows).unwrap();
    let moved = sampling.errors.deviations(&rows);
    let columns: Vec<usize> =
        sampling.errors.terms.iter().filter(|term| term.input == 2).map(|term| term.parameter).collect();
    let column = |index: usize| moved.rows().map(move |row| row[index]);
    let product = |i, j| column(i).zip(column(j)).map(|(a, b)| a * b).sum::<f64>();
    let (i, j) = (columns[0], columns[1]);
    let correlation = product(i, j) / (product(i, i) * product(j, j)).sqrt();
    // 0.02² / (0.02² + 0.01²).
    assert!((correlation - 0.8).abs() < 2e-3, "{correlation}");
}

#[test]
fn a_cause_has_measures_of_its_own_that_agree() {
    let study = study(two_points_of_a_block()).unwrap();
    let sampling = study.sampling("blocks").unwrap();
    let session = Session::in_memory();
    let tally = observe(&sampling, &session).unwrap();
    assert_eq!(tally.failed.values().sum::<usize>(), 0);
    let spec = SensitivitySpec {
        observations: 1024,
        saltelli_blocks: 256,
        bootstrap_resamples: 200,
        morris_blocks: 32,
        morris_levels: None,
        derivative_points: 40,
        shapley_walks: 0,
        bures_observations: 0,
        vector: cdpr_study::VectorOutput::Displacement,
        gradient_expansion: false,
        expansion: Truncation { max_degree: 2, norm: 1.0, interactions: 2 },
    };
    let found = measure(&sampling, &spec, &tally, &session).unwrap();
    assert_eq!(found.notes, [""; 0]);
    for input in &found.inputs {
        let (low, high) = (input.sobol_first_low.unwrap(), input.sobol_first_high.unwrap());
        let share = input.derivative_share.unwrap();
        assert!(low - 0.01 <= share && share <= high + 0.01, "{input:?}");
        assert!((input.expansion_first.unwrap() - share).abs() < 0.02, "{input:?}");
    }
    assert_eq!(found.sums.keys().collect::<Vec<_>>(), ["b", "all"]);
}

#[test]
fn an_invalid_cause_is_named() {
    let message = |key: &str, parameters: Value| {
        study(json!({ key: { "law": uniform(0.01), "parameters": parameters } })).unwrap_err().to_string()
    };
    for (key, parameters, field) in [
        ("block", json!({}), "error_models.model.block.parameters is empty: expected a parameter"),
        ("block", json!({"b9.z": 1.0}), "error_models.model.block.parameters is b9.z: expected a parameter"),
        (
            "block",
            json!({"b1.z": 0.0}),
            "error_models.model.block.parameters.b1.z is 0: expected a finite factor",
        ),
        ("b", json!({"b1.z": 1.0}), "error_models.model.b is b: expected a name of letters"),
        ("b1.z", json!({"b1.z": 1.0}), "error_models.model.b1.z is b1.z: expected a name of letters"),
        ("two words", json!({"b1.z": 1.0}), "error_models.model.two words is two words: expected a name"),
    ] {
        let message = message(key, parameters);
        assert!(message.contains(field), "{message}");
    }
    let unknown = study(json!({ "block": { "law": uniform(0.01) } })).unwrap_err().to_string();
    assert!(unknown.contains("or an entry with `parameters`"), "{unknown}");
}

#[test]
fn a_template_has_a_law_for_every_parameter_of_the_robot() {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/robots/caroca.json"));
    let mut robot = Robot::from_json(&std::fs::read_to_string(path).unwrap()).unwrap();
    for guided in [false, true] {
        if guided {
            robot.gravity = Vector3::new(0.3, 0.0, -9.8).into();
            for cable in &mut robot.cables {
                cable.pulley = Some(Pulley { radius: 0.045, axis: Vector3::z() });
                cable.lead = 3.0;
            }
        }
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("robot.json"), robot.to_json()).unwrap();
        let text = template(&robot, "robot.json", None, None, &[]).unwrap();
        let study = Study::from_json(&text, &folder.path().join("study.json")).unwrap();
        let sampling = study.sampling("all").unwrap();
        assert_eq!(sampling.errors.inputs.len(), Parameter::of(&robot).len());
        let names: Vec<_> = sampling.errors.inputs.iter().map(|input| input.name.clone()).collect();
        assert_eq!(names.contains(&"tilt8.v".to_owned()), guided);
        let mut rows = vec![0.0; 8 * sampling.errors.inputs.len()];
        sampling.design.rows(0, &mut rows).unwrap();
        for found in sampling.observer.observe(&sampling.errors.deviations(&rows)) {
            found.unwrap();
        }
    }
}

#[test]
fn a_template_stays_above_the_floor() {
    let mut robot = Robot::from_library("cogiro").unwrap();
    for height in [3.0, 4.0, 8.0] {
        robot.cables.iter_mut().for_each(|cable| cable.exit_point.z = height);
        let text = template(&robot, "robot.json", None, None, &[]).unwrap();
        let file: Value = serde_json::from_str(&text).unwrap();
        let z = file["samplings"]["all"]["pose"]["position"][2].as_f64().unwrap();
        assert!(robot.floor() <= z && z < height, "{height} m: {z} m, floor {} m", robot.floor());
    }
}

/// In three steps, a law of ±0.8 of the mass has a deviation of 57 % of it, and 46 % without steps.
#[test]
fn the_deviation_that_is_doubted_is_that_of_the_steps() {
    let entry = |half: f64| json!({ "law": uniform(half) });
    let mass = study(json!({ "mass": entry(0.1) })).unwrap().robot.platform.mass;
    let half = 0.8 * mass;
    let mut stepped = entry(half);
    stepped["steps"] = json!({ "nearest": { "step": half } });
    let doubted = |entry: Value| study(json!({ "mass": entry })).unwrap().doubts().len();
    assert_eq!(doubted(entry(half)) + 1, doubted(stepped));
}
