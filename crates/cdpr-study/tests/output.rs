//! Studies of other outputs than the deflection.

use cdpr_dynamics::Swing;
use cdpr_robot::{Deviations, Parameter, ParameterLayout, Pose};
use cdpr_sensitivity::SampleDesign;
use cdpr_statics::free_coordinates::free_solutions;
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::{
    DirectProblem, DirectStart, Load, StaticsError, WantedPose, deflection, inverse, set_point_lengths,
};
use cdpr_study::{
    InputMeasures, Measured, Sampling, SensitivitySpec, SensitivitySummary, Session, Study, StudyError,
    analyse, compute_surface, observe, observe_into,
};
use serde_json::{Value, json};
use std::path::Path;

const OBSERVATIONS: usize = 40;

/// A study of a robot at a level pose, whose cables, masses, points and tensions deviate.
pub(crate) fn study(robot: &str, position: [f64; 3], output: &str) -> Value {
    let mut study = json!({
        "format": "cdpr-study/1", "name": "outputs", "robot": format!("../robots/{robot}.json"),
        "payload": 30.0, "output": output, "seed": 5, "replicates": 2, "bootstrap_resamples": 5,
        "confidence": 0.9,
        "error_models": { "all": {
            "mass": { "law": { "uniform": { "min": -4.0, "max": 4.0 } } },
            "youngs_modulus": { "law": { "uniform": { "min": -3e9, "max": 3e9 } } },
            "b": { "law": { "uniform": { "min": -0.02, "max": 0.02 } } },
            "dt": { "law": { "uniform": { "min": -20.0, "max": 20.0 } } },
        } },
        "samplings": {
            "point": {
                "title": "At a point", "pose": { "position": position }, "error_model": "all",
                "observations": OBSERVATIONS
            }
        },
        "surfaces": {
            "plane": {
                "title": "Over two", "pose": { "position": position },
                "x": { "parameter": "mass", "min": -4.0, "max": 4.0, "points": 3 },
                "y": { "parameter": "b1.x", "min": -0.02, "max": 0.02, "points": 2 }
            }
        }
    });
    if output == "amplitude" {
        study["amplitude"] = json!({ "frequency": 2.0, "drag": 0.5, "marker": [0.1, -0.2, 0.3] });
    }
    study
}

pub(crate) fn opened(study: &Value) -> Result<Study, StudyError> {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/output.json"));
    Study::from_json(&study.to_string(), path)
}

/// CoGiRo, and CAROCA with an inertia.
pub(crate) fn of_two_robots(output: &str) -> [Study; 2] {
    let mut caroca = opened(&study("caroca", [0.3, -0.2, 1.75], "stiffness")).unwrap();
    let robots = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/robots/caroca.json"));
    let mut robot: Value = serde_json::from_str(&std::fs::read_to_string(robots).unwrap()).unwrap();
    robot["platform"]["inertia"] = json!([[30.0, 1.0, 0.0], [1.0, 40.0, 0.0], [0.0, 0.0, 50.0]]);
    caroca.robot = cdpr_robot::Robot::from_json(&robot.to_string()).unwrap();
    let cogiro = opened(&study("cogiro", [1.0, 0.5, 2.0], output)).unwrap();
    (caroca.file.output, caroca.file.amplitude) = (cogiro.file.output, cogiro.file.amplitude);
    [cogiro, caroca]
}

/// Deviations of all parameters, and what was observed.
pub(crate) fn observed(sampling: &Sampling) -> Vec<(Vec<f64>, Measured)> {
    let mut found = Vec::new();
    observe_into(sampling, &Session::in_memory(), Clone::clone, |part| {
        let inputs = sampling.design.inputs().len();
        for (row, outcome) in part.rows.chunks_exact(inputs).zip(part.outcomes) {
            found.push((sampling.errors.deviations(row).values().to_vec(), outcome.unwrap()));
        }
        Ok(())
    })
    .unwrap();
    assert_eq!(found.len(), OBSERVATIONS);
    found
}

pub(crate) fn same(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() < tolerance * expected.abs(), "{found} and not {expected}");
}

#[test]
fn a_frequency_and_a_stiffness_are_those_of_the_deflected_robot() {
    for output in ["frequency", "stiffness"] {
        for study in of_two_robots(output) {
            let sampling = study.sampling("point").unwrap();
            for (deviations, measured) in observed(&sampling).iter().step_by(7) {
                let deviating = study.robot.perturbed(deviations).unwrap();
                let offsets = &deviating.tension_offsets;
                assert!(offsets.iter().all(|offset| *offset != 0.0));
                let lengths = set_point_lengths(
                    &deviating.robot,
                    WantedPose::at(&sampling.pose).tension_offsets(offsets),
                )
                .unwrap();
                let problem = DirectProblem::new(&deviating.robot, &lengths, &sampling.load).unwrap();
                let rest = problem.direct(DirectStart::Pose(&sampling.pose)).unwrap();
                // Rotations are measured by a length of the nominal robot: one that deviates changes nothing.
                let nominal = problem.with_characteristic_length(study.robot.platform_size());
                let expected = match output {
                    "frequency" => Swing::new(&problem, &rest.equilibrium).unwrap().lowest,
                    _ => nominal.stability(&rest.equilibrium).unwrap().least_stiffness(),
                };
                same(measured.value(), expected, 3e-6);
            }
        }
    }
}

#[test]
fn the_nominal_stiffness_without_offsets_is_nearly_that_of_the_wanted_pose() {
    for study in of_two_robots("stiffness") {
        let sampling = study.sampling("point").unwrap();
        let at_pose = stiffness_at(&study.robot, sampling.pose, &sampling.load).unwrap();
        // The payload moves the platform by a millimetre, and the tensions of another distribution hold it.
        same(sampling.nominal_value, at_pose.stability.least_stiffness(), 0.2);
        let values: Vec<f64> = observed(&sampling).iter().map(|(_, measured)| measured.value()).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        same(mean, sampling.nominal_value, 0.1);
    }
}

#[test]
fn a_position_error_is_where_the_direct_model_puts_the_robot_with_nominal_lengths() {
    for mut study in of_two_robots("position") {
        study.file.error_models["all"].shift_remove("dt");
        let sampling = study.sampling("point").unwrap();
        assert_eq!(sampling.nominal_value, 0.0);
        let lengths = inverse(&study.robot, &sampling.pose, &Load::none()).unwrap().lengths;
        for (deviations, measured) in observed(&sampling).iter().step_by(7) {
            let deviating = study.robot.perturbed(deviations).unwrap().robot;
            let problem = DirectProblem::new(&deviating, &lengths, &Load::none()).unwrap();
            let rest = problem.direct(DirectStart::Pose(&sampling.pose)).unwrap().equilibrium.pose;
            let away = 1e3 * (rest.position - sampling.pose.position).norm();
            assert!((measured.value() - away).abs() < 1e-6, "{} and not {away}", measured.value());
            assert!(away > 0.1);
        }
    }
}

#[test]
fn slopes_of_a_position_error_are_its_central_differences() {
    for study in of_two_robots("position") {
        let sampling = study.sampling("point").unwrap();
        let observer = &sampling.observer;
        let mut deviations = observed(&sampling)[3].0.clone();
        let at =
            |deviations: &[f64]| observer.displaced(&study.robot.perturbed(deviations).unwrap()).unwrap();
        let perturbed = study.robot.perturbed(&deviations).unwrap();
        let (displaced, slopes) = observer.displaced_slopes(&perturbed, &sampling.errors).unwrap();
        assert!((displaced - at(&deviations)).norm() < 1e-12);
        let parameters = Parameter::of(&study.robot);
        let steps = [("mass", 1e-2), ("youngs_modulus", 1e7), ("b3.y", 1e-5), ("a2.x", 1e-5), ("dt4", 1e-2)];
        for (name, step) in steps {
            let column = parameters.iter().position(|one| one.to_string() == name).unwrap();
            let middle = deviations[column];
            let [after, before] = [step, -step].map(|step| {
                deviations[column] = middle + step;
                at(&deviations)
            });
            deviations[column] = middle;
            let (slope, difference) = (slopes.column(column), (after - before) / (2.0 * step));
            assert!((slope - difference).norm() < 1e-5 * slope.norm() + 1e-13 / step, "{name}: {slope}");
        }
    }
}

#[test]
fn every_output_has_the_same_numbers_on_one_and_two_threads() {
    for output in ["position", "frequency", "platform_frequency", "amplitude", "stiffness"] {
        for study in of_two_robots(output) {
            let on = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| {
                    let surface = study.surface("plane").unwrap();
                    let values = compute_surface(&surface, &|_| ()).by_kind().values;
                    (observed(&study.sampling("point").unwrap()), values)
                })
            };
            let (one, two) = (on(1), on(2));
            assert_eq!(one, two);
            assert!(one.1.iter().all(Result::is_ok) && one.1[0] != one.1[5], "{:?}", one.1);
        }
    }
}

pub(crate) fn small_measures() -> SensitivitySpec {
    let spec = json!({
        "observations": 40, "saltelli_blocks": 64, "bootstrap_resamples": 10, "morris_blocks": 24,
        "derivative_points": 40, "expansion": { "max_degree": 2, "norm": 0.75, "interactions": 2 }
    });
    serde_json::from_value(spec).unwrap()
}

/// The methods that are left out.
fn left_out(found: &SensitivitySummary) -> Vec<&str> {
    // A doubt about intervals leaves nothing out.
    let is_doubt = |note: &&String| note.ends_with("the intervals are an indication only");
    let notes = found.notes.iter().filter(|note| !is_doubt(note));
    notes.filter_map(|note| Some(note.split_once(':')?.0)).collect()
}

#[test]
fn every_output_has_measures_by_derivatives_and_a_nominal_position_has_none() {
    for (output, without) in [("frequency", &[][..]), ("stiffness", &[]), ("position", &["derivatives"])] {
        for mut study in of_two_robots(output) {
            // Fewer inputs than observations.
            study.file.error_models["all"].shift_remove("b");
            study.file.sensitivity = Some(small_measures());
            let sampling = study.sampling("point").unwrap();
            let session = Session::in_memory();
            let tally = cdpr_study::observe(&sampling, &session).unwrap();
            let summary = analyse(&sampling, &tally, &session).unwrap();
            // Cables may take much part in the motion of a frequency, and of nothing else.
            let is_of_cables =
                |note: &&String| output == "frequency" && note.contains("of the energy of this motion");
            let others = summary.notes.iter().filter(|note| !is_of_cables(note)).count();
            assert_eq!((summary.output, others), (study.file.output, 0), "{:?}", summary.notes);
            assert_eq!(summary.signed_effects.len(), sampling.design.inputs().len());
            let sensitivity = summary.sensitivity.unwrap();
            assert_eq!(left_out(&sensitivity), without, "{:?}", sensitivity.notes);
            let told = |note: &String| {
                note.contains("has no derivative") || note.ends_with("the intervals are an indication only")
            };
            assert!(sensitivity.notes.iter().all(told));
            let known = ["t_student", "regression", "rank_regression", "morris", "expansion", "sobol"];
            assert!(known.iter().all(|method| sensitivity.methods.contains_key(*method)));
            // The linear model of the derivatives and that of the regression name the same greatest share.
            let greatest = |of: fn(&InputMeasures) -> Option<f64>| {
                let shares = sensitivity.inputs.iter().filter_map(|input| Some((&input.input, of(input)?)));
                shares.max_by(|one, other| one.1.total_cmp(&other.1)).map(|(name, _)| name)
            };
            if without.is_empty() {
                assert_eq!(sensitivity.methods["dgsm"].failed, 0);
                assert_eq!(
                    greatest(|input| input.derivative_share),
                    greatest(|input| input.regression_share)
                );
            }
        }
    }
}

#[test]
fn what_an_output_cannot_be_of_is_refused_with_field_and_value() {
    let refused = |study: &Value| opened(study).unwrap_err().to_string();
    let error = refused(&study("caroca", [0.0, 0.0, 1.75], "speed"));
    for word in ["output", "speed", "`deflection`", "`position`", "`frequency`", "`stiffness`"] {
        assert!(error.contains(word), "{error}");
    }
    let error = refused(&study("caroca", [0.0, 0.0, 1.75], "frequency"));
    assert!(error.contains("output is frequency: expected a robot with `platform.inertia`"), "{error}");
}

#[test]
fn a_study_of_the_position_needs_no_payload_and_its_values_depend_on_none() {
    let values = |payload: Option<f64>| {
        let mut study = study("cogiro", [1.0, 0.5, 2.0], "position");
        match payload {
            Some(payload) => study["payload"] = json!(payload),
            None => drop(study.as_object_mut().unwrap().remove("payload")),
        }
        let study = opened(&study).unwrap();
        observe(&study.sampling("point").unwrap(), &Session::in_memory()).unwrap().first_values
    };
    assert_eq!(values(None), values(Some(30.0)));
    let mut none = study("cogiro", [1.0, 0.5, 2.0], "deflection");
    none.as_object_mut().unwrap().remove("payload");
    let error = opened(&none).unwrap_err().to_string();
    assert!(error.contains("payload is 0: expected a finite mass above zero [kg]"), "{error}");
    assert!(error.contains("output position needs none"), "{error}");
}

#[test]
fn the_hash_of_a_study_depends_on_its_output_and_not_on_naming_the_deflection() {
    let hash = |study: &Value| opened(study).unwrap().hash().unwrap();
    let named = study("cogiro", [1.0, 0.5, 2.0], "deflection");
    let mut unnamed = named.clone();
    unnamed.as_object_mut().unwrap().remove("output");
    assert_eq!(hash(&named), hash(&unnamed));
    assert_ne!(hash(&named), hash(&study("cogiro", [1.0, 0.5, 2.0], "stiffness")));
}

#[test]
fn a_robot_that_fails_has_no_output_and_a_reason() {
    let study = opened(&study("cogiro", [1.0, 0.5, 2.0], "frequency")).unwrap();
    let (sampling, layout) = (study.sampling("point").unwrap(), ParameterLayout::of(&study.robot));
    let [mut two, one] = [2, 1].map(|rows| Deviations::zeros(&layout, rows));
    two.rows_mut().next().unwrap()[layout.mass()] = 1e6;
    let [heavy, nominal] = sampling.observer.observe(&two).try_into().unwrap();
    let [alone] = sampling.observer.observe(&one).try_into().unwrap();
    assert!(matches!(heavy, Err(StaticsError::NoTensions { .. })), "{heavy:?}");
    let (value, bits) = (nominal.unwrap().value(), alone.unwrap().value().to_bits());
    assert!(value.to_bits() == bits && (value / sampling.nominal_value - 1.0).abs() < 1e-12);
    assert_eq!(sampling.pose, Pose::at(1.0, 0.5, 2.0));
}

/// Studies of GRAB, and of every second cable of CoGiRo, with free coordinates.
pub(crate) fn of_four_cables(output: &str) -> [Study; 2] {
    let mut cogiro = study("cogiro", [1.0, -0.3, 2.0], output);
    cogiro["samplings"]["point"]["free"] = json!(["roll", "yaw"]);
    let mut grab = study("grab", [1.2795, -0.1915, -0.9192], output);
    grab["payload"] = json!(0.1);
    grab["error_models"]["all"] = json!({
        "mass": { "law": { "uniform": { "min": -0.1, "max": 0.1 } } },
        "cog": { "law": { "uniform": { "min": -0.003, "max": 0.003 } } },
        "a": { "law": { "uniform": { "min": -0.002, "max": 0.002 } } },
    });
    grab["samplings"]["point"]["free"] = json!(["roll", "pitch"]);
    grab["samplings"]["point"]["pose"]["rpy_deg"] = json!([0.0, 0.0, 7.8]);
    let folder = tempfile::tempdir().unwrap();
    let robots = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/robots"));
    [(cogiro, "cogiro.json", &[1, 3, 5, 7]), (grab, "grab.json", &[0, 1, 2, 3])].map(
        |(mut study, name, kept)| {
            let text = std::fs::read_to_string(robots.join(name)).unwrap();
            let mut robot: Value = serde_json::from_str(&text).unwrap();
            robot["cables"] = kept.map(|i: usize| robot["cables"][i].clone()).to_vec().into();
            std::fs::write(folder.path().join(name), robot.to_string()).unwrap();
            study["robot"] = json!(name);
            study["surfaces"] = json!({});
            Study::from_json(&study.to_string(), &folder.path().join("study.json")).unwrap()
        },
    )
}

#[test]
fn a_robot_with_four_cables_keeps_the_held_coordinates_and_finds_the_others() {
    for study in of_four_cables("deflection") {
        let sampling = study.sampling("point").unwrap();
        let free = &study.file.samplings["point"].free;
        let mut tilted = 0.0_f64;
        for (deviations, measured) in observed(&sampling).iter().step_by(9) {
            let deviating = study.robot.perturbed(deviations).unwrap();
            // A search through all solutions, from the level pose.
            let rest =
                free_solutions(&deviating.robot, WantedPose::at(&sampling.pose).free(free), &Load::none())
                    .unwrap()
                    .first;
            let held = rest.equilibrium.pose;
            assert!((held.position - sampling.pose.position).norm() < 1e-12);
            tilted = tilted.max(held.rotation.angle_to(&sampling.pose.rotation));
            let offsets = &deviating.tension_offsets;
            let expected = deflection(
                &deviating.robot,
                WantedPose::at(&sampling.pose).free(free).tension_offsets(offsets),
                &sampling.load,
            );
            let difference = measured.value() - 1e3 * expected.unwrap().magnitude();
            assert!(difference.abs() < 1e-7 * measured.value().max(1.0), "{difference} mm");
        }
        assert!(tilted > 1e-3, "{tilted}");
    }
}

#[test]
fn measures_with_free_coordinates_have_exact_derivatives() {
    for (output, without) in [("deflection", &[][..]), ("position", &["derivatives"])] {
        for mut study in of_four_cables(output) {
            study.file.error_models["all"].retain(|name, _| !["a", "b"].contains(&name.as_str()));
            study.file.sensitivity = Some(small_measures());
            let sampling = study.sampling("point").unwrap();
            let session = Session::in_memory();
            let tally = cdpr_study::observe(&sampling, &session).unwrap();
            let found = analyse(&sampling, &tally, &session).unwrap().sensitivity.unwrap();
            assert_eq!(left_out(&found), without, "{}: {:?}", study.robot.name, found.notes);
            assert_eq!(found.methods["dgsm"].failed, 0);
        }
    }
}

#[test]
fn free_coordinates_that_do_not_fit_the_robot_are_refused() {
    let refused = |study: &Value| opened(study).unwrap_err().to_string();
    let mut file = study("grab", [1.2795, -0.1915, -0.9192], "deflection");
    for free in [json!([]), json!(["roll"]), json!(["roll", "roll"])] {
        file["samplings"]["point"]["free"] = free;
        let error = refused(&file);
        assert!(error.contains("samplings.point.free is ["), "{error}");
        assert!(error.contains("expected 2 different"), "{error}");
    }
    let mut eight = study("cogiro", [1.0, 0.5, 2.0], "deflection");
    eight["surfaces"]["plane"]["free"] = json!(["z"]);
    let error = refused(&eight);
    assert!(error.contains("surfaces.plane.free is [z]: expected 0 different"), "{error}");
}
