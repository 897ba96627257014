//! Settings of the measures of sensitivity.

use crate::sensitivity::{SMALL, left_out, of_sampling, path, text};
use cdpr_robot::Robot;
use cdpr_study::{SensitivitySpec, Study, StudyError, template, template_cost};

#[test]
fn invalid_settings_are_refused_with_field_value_and_remedy() {
    let refusal = |from: &str, to: &str| {
        let text = text();
        assert!(text.contains(from));
        let error = Study::from_json(&text.replacen(from, to, 1), path()).unwrap_err();
        let StudyError::At { source, .. } = error else { panic!("no line and column: {error}") };
        assert!(matches!(*source, StudyError::Invalid { .. }), "{source}");
        source.to_string()
    };
    let blocks = refusal("\"saltelli_blocks\": 4096", "\"saltelli_blocks\": 15");
    assert!(blocks.ends_with("sensitivity.saltelli_blocks is 15: expected 0, or at least 16"), "{blocks}");
    let norm = refusal("\"norm\": 0.75", "\"norm\": 0.0");
    assert!(
        norm.ends_with("sensitivity.expansion.norm is 0: expected a number above 0, at most 1"),
        "{norm}"
    );
    let levels = refusal("\"morris_blocks\": 128", "\"morris_blocks\": 128, \"morris_levels\": 5");
    assert!(
        levels.ends_with("sensitivity.morris_levels is 5: expected an even number from 2 to 1024"),
        "{levels}"
    );
    let degree = refusal("\"max_degree\": 3", "\"max_degree\": 101");
    assert!(degree.ends_with("sensitivity.expansion.max_degree is 101: expected 1 to 100"), "{degree}");
}

#[test]
fn settings_left_out_are_those_of_the_data_file() {
    let spec = Study::open(path()).unwrap().file.sensitivity.unwrap();
    assert_eq!(spec, SensitivitySpec::default());
}

#[test]
fn fewer_observations_shorten_all_measures_and_an_extension_keeps_them() {
    let robot = Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap();
    let text = template(&robot, "cogiro", None, None, &[]).unwrap();
    let cost = template_cost(&robot);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.json");
    std::fs::write(&path, text).unwrap();
    let mut study = Study::open(&path).unwrap();
    let whole = study.file.sensitivity.unwrap();
    // What the template says of itself is what a run makes.
    let counts =
        cost.lines().skip(1).map(|line| line.split_whitespace().next().unwrap().parse::<usize>().unwrap());
    assert_eq!(counts.sum::<usize>(), study.all_observations().unwrap());
    study.set_observations(512).unwrap();
    let short = study.file.sensitivity.unwrap();
    assert_eq!((whole.saltelli_blocks, short.saltelli_blocks), (128, 32));
    assert_eq!((whole.morris_blocks, short.morris_blocks), (32, 8));
    // Exact derivatives take little time: 16 points would be too few for bounds.
    assert_eq!((whole.derivative_points, short.derivative_points), (256, 256));
    study.extend(4096).unwrap();
    assert_eq!(study.file.sensitivity, Some(short));
}

#[test]
fn no_blocks_of_saltelli_leave_sobol_indices_out_and_few_are_refused() {
    let found = of_sampling("mechanical", &SensitivitySpec { saltelli_blocks: 0, ..SMALL });
    assert!(!found.methods.contains_key("sobol") && found.methods.contains_key("morris"));
    assert_eq!(left_out(&found), Vec::<&str>::new());
    assert!(
        found.inputs.iter().all(|input| input.sobol_total.is_none() && input.morris_mean_absolute.is_some())
    );
    let mut study: serde_json::Value = serde_json::from_str(&text()).unwrap();
    for (blocks, refused) in [(0, false), (5, true), (16, false)] {
        study["sensitivity"]["saltelli_blocks"] = blocks.into();
        let opened = Study::from_json(&study.to_string(), path());
        assert_eq!(opened.is_err(), refused, "{blocks}");
        if let Err(error) = opened {
            assert!(
                error.to_string().contains("saltelli_blocks is 5: expected 0, or at least 16"),
                "{error}"
            );
        }
    }
    study["sensitivity"]["saltelli_blocks"] = 0.into();
    let study = Study::from_json(&study.to_string(), path()).unwrap();
    let some = Study::open(path()).unwrap();
    assert!(study.observations("mechanical").unwrap() < some.observations("mechanical").unwrap());
}

#[test]
fn a_study_says_which_samplings_the_scalar_models_observe_and_how_long() {
    assert_eq!(Study::open(path()).unwrap().scalar_samplings().unwrap(), []);
    let mut study: serde_json::Value = serde_json::from_str(&text()).unwrap();
    study["output"] = "stiffness".into();
    let study = Study::from_json(&study.to_string(), path()).unwrap();
    let slow = study.scalar_samplings().unwrap();
    let names: Vec<_> = slow.iter().map(|sampling| sampling.name.as_str()).collect();
    assert!(names.contains(&"mechanical"), "{names:?}");
    for sampling in &slow {
        assert_eq!(sampling.observations, study.observations(&sampling.name).unwrap());
        assert!(sampling.reason == cdpr_statics::batch::ScalarReason::Output && sampling.seconds > 0.0);
        assert!(sampling.to_string().contains("only the output \"deflection\""), "{sampling}");
    }
}
