//! The modulus of a study from the law of the cables at the tensions of pose and load.

use cdpr_robot::Robot;
use cdpr_sensitivity::Law;
use cdpr_statics::hysteresis::Unloading;
use cdpr_study::{CableLaw, Session, Study, StudyError, analyse, observe, open_law};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(name)
}

fn law() -> CableLaw {
    open_law(&data("cables/caroca-4mm-law.json")).unwrap()
}

/// The study of the repository, its entry of the modulus changed.
fn study(change: impl Fn(&mut Value)) -> Result<Study, StudyError> {
    let path = data("studies/caroca-operating-point.json");
    let mut file: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    change(&mut file);
    Study::from_json(&serde_json::to_string_pretty(&file).unwrap(), &path)
}

fn modulus(file: &mut Value) -> &mut Value {
    &mut file["error_models"]["operating_point"]["youngs_modulus"]
}

/// Ends of the modulus' deviation [GPa].
fn range(study: &Study, sampling: &str) -> [f64; 2] {
    let errors = study.sampling(sampling).unwrap().errors;
    let input = errors.inputs.iter().find(|input| input.name == "youngs_modulus").unwrap();
    let Law::Uniform { min, max } = input.law else { panic!("{:?}", input.law) };
    [min, max].map(|end| end / 1e9)
}

#[test]
fn the_range_is_that_of_both_ways_at_the_tensions_of_pose_and_load() {
    let study = study(|_| ()).unwrap();
    // All tensions lie between 5 and 10 % of the breaking force: 83.2 GPa loading, 82.3 GPa unloading, of
    // 102.2 GPa.
    let [low, high] = range(&study, "geometrical");
    assert!(
        (low - (82.3 - 102.2 - 2.0)).abs() < 1e-6 && (high - (83.2 - 102.2 + 2.0)).abs() < 1e-6,
        "{low} {high}"
    );
    // Far from the middle tensions are as different as the pieces of the law.
    let moduli = study.sampling("geometrical_asymmetric").unwrap().operating_moduli.unwrap();
    assert!(moduli[0] < 60e9 && moduli[1] > 100e9, "{moduli:?}");
}

#[test]
fn without_a_way_back_the_range_is_that_of_the_measurement() {
    let loading_only = |file: &mut Value| {
        modulus(file)["operating_point"].as_object_mut().unwrap().remove("unloading");
    };
    let [low, high] = range(&study(loading_only).unwrap(), "geometrical");
    assert!((high - low - 4.0).abs() < 1e-9 && (0.5 * (low + high) - (83.2 - 102.2)).abs() < 1e-6);
}

#[test]
fn a_secant_spans_the_pieces_between_two_tensions() {
    let kinked = |file: &mut Value| {
        modulus(file)["operating_point"] = json!({ "section": 1.2566370614e-5, "loading": [
            { "tension": 0, "modulus": 60e9 }, { "tension": 650, "modulus": 90e9 } ] });
    };
    let study = study(kinked).unwrap();
    let sampling = study.sampling("geometrical").unwrap();
    let [from, to] = [&sampling.nominal.unloaded, &sampling.nominal.loaded].map(|s| s.equilibrium.tensions());
    let secants = (0..8).map(|i| (to[i] - from[i]) / ((650.0 - from[i]) / 60e9 + (to[i] - 650.0) / 90e9));
    let least = secants.clone().fold(f64::INFINITY, f64::min);
    let greatest = secants.fold(0.0, f64::max);
    let moduli = sampling.operating_moduli.unwrap();
    assert!(
        (moduli[0] / least - 1.0).abs() < 1e-12 && (moduli[1] / greatest - 1.0).abs() < 1e-12,
        "{moduli:?}"
    );
    let summary =
        analyse(&sampling, &observe(&sampling, &Session::in_memory()).unwrap(), &Session::in_memory());
    assert!((summary.unwrap().operating_moduli_gpa.unwrap()[0] - 1e-9 * least).abs() < 1e-9);
}

#[test]
fn an_invalid_operating_point_is_named() {
    let message = |change: &dyn Fn(&mut Value)| study(change).unwrap_err().to_string();
    for (message, words) in [
        (
            message(&|file| modulus(file)["law"] = json!({ "normal": { "mean": 0.0, "std": 1e9 } })),
            "youngs_modulus.law is Normal { mean: 0.0, std: 1e9 }: expected a uniform law",
        ),
        (
            message(&|file| {
                let point = modulus(file)["operating_point"].clone();
                file["error_models"]["operating_point"]["mass"]["operating_point"] = point;
            }),
            "mass.operating_point is given: expected an operating point of `youngs_modulus` alone",
        ),
        (
            message(&|file| modulus(file)["operating_point"]["loading"][2]["tension"] = json!(100)),
            "youngs_modulus.operating_point.loading[2].tension is 100: expected tensions that grow",
        ),
        (
            message(&|file| {
                modulus(file)["operating_point"]["unloading"]["segments"][1]["modulus"] = json!(0);
            }),
            "operating_point.unloading.segments[1].modulus is 0: expected a finite, positive modulus",
        ),
        (
            message(&|file| modulus(file)["operating_point"]["section"] = json!(-1.0)),
            "operating_point.section is -1: expected a finite, positive section",
        ),
        (
            message(&|file| modulus(file)["operating_point"]["loading"] = json!([])),
            "operating_point.loading is empty: expected one segment at least",
        ),
        (
            message(&|file| file["robot"] = json!("../robots/caroca-law.json")),
            "operating_point is given: expected a robot with linear cables",
        ),
    ] {
        assert!(message.contains(words) && message.contains("(line "), "{message}");
    }
    let refused = study(|_| ()).unwrap().tolerances("operating_point").unwrap_err().to_string();
    assert!(
        refused.contains("youngs_modulus.operating_point is given: expected an error model without"),
        "{refused}"
    );
}

#[test]
fn a_cable_of_another_section_has_the_same_moduli_at_the_same_stress() {
    let robot = Robot::from_json(&std::fs::read_to_string(data("robots/caroca.json")).unwrap()).unwrap();
    let mut thick = robot.cables[0].properties.clone();
    let curves = |cable: &_| law().curves(cable, Unloading::TurningPoint).unwrap();
    let one = curves(&thick);
    thick.section *= 2.0;
    let double = curves(&thick);
    assert_eq!(double.turning_tension, 2.0 * one.turning_tension);
    for tension in [0.0, 400.0, 700.0, 2500.0] {
        assert_eq!(double.loading.ratio(2.0 * tension), one.loading.ratio(tension));
        // The same strain under twice the tension.
        let strains =
            [double.unloading.scaled_strain(2.0 * tension), 2.0 * one.unloading.scaled_strain(tension)];
        assert!((strains[0] - strains[1]).abs() <= 1e-12 * strains[1]);
    }
}

#[test]
fn the_law_files_of_the_repository_are_those_of_the_record() {
    let record = cdpr_study::open_record(&data("cables/caroca-4mm-record.csv")).unwrap();
    let (written, made) = (law(), CableLaw::of_record(&record, 1.0, 1.2566370614e-5).unwrap());
    let robot = Robot::from_json(&std::fs::read_to_string(data("robots/caroca-law.json")).unwrap()).unwrap();
    let of_robot = robot.cables[7].properties.law.clone().unwrap();
    let ways = [
        (&written.loading, &made.loading),
        (&written.unloading.as_ref().unwrap().segments, &made.unloading.as_ref().unwrap().segments),
    ];
    for (written, made) in ways {
        assert_eq!(written.len(), made.len());
        for (one, other) in written.iter().zip(made) {
            assert!(one.tension == other.tension && (one.modulus / other.modulus - 1.0).abs() < 1e-5);
        }
    }
    for (segment, of_robot) in written.loading.iter().zip(of_robot.segments()) {
        assert!((segment.modulus / (of_robot.ratio * 1.022e11) - 1.0).abs() < 1e-12);
    }
}
