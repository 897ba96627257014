//! Studies of how a platform swings and of its amplitude where it is shaken.

use crate::output::{observed, of_four_cables, of_two_robots, opened, same, small_measures, study};
use cdpr_dynamics::{FrequencyResponse, Modes, Wanted, modes_at, worst_amplitude};
use cdpr_robot::Axis;
use cdpr_statics::{DirectProblem, DirectStart, Load, Vector3, WantedPose, set_point_lengths};
use cdpr_study::{AlongAxis, AmplitudeSpec, InputMeasures, Output, Session, Study, analyse, observe};
use serde_json::json;

/// What a loop over robots finds of one of them by hand: its lengths, its rest with the payload, its motions
/// or its response up to a higher frequency.
fn by_hand(study: &Study, deviations: &[f64]) -> f64 {
    let sampling = study.sampling("point").unwrap();
    let deviating = study.robot.perturbed(deviations).unwrap();
    let wanted = WantedPose::at(&sampling.pose).tension_offsets(&deviating.tension_offsets);
    let lengths = set_point_lengths(&deviating.robot, wanted).unwrap();
    let problem = DirectProblem::new(&deviating.robot, &lengths, &sampling.load).unwrap();
    let rest = problem.direct(DirectStart::Pose(&sampling.pose)).unwrap().equilibrium;
    let Some(AmplitudeSpec { frequency, damping, drag, marker, along }) = study.file.amplitude else {
        let slowest = problem.modes(&rest).unwrap()[0].frequency;
        let modes = Modes::new(&problem, &rest, Wanted::Below(2.0 * slowest)).unwrap().modes;
        let swings = modes.iter().max_by(|one, other| one.swing_share.total_cmp(&other.swing_share));
        return swings.unwrap().frequency;
    };
    let damping = cdpr_dynamics::Damping { stretch: damping, drag };
    let response = FrequencyResponse::new(&problem, &rest, 3.0 * frequency, damping).unwrap();
    let lever = rest.pose.rotation * Vector3::from(marker);
    let (per_force, _) = response.at(frequency).unwrap().at_point(&lever);
    1e3 * match along {
        Some(_) => per_force[(2, 2)].norm(),
        None => worst_amplitude(&per_force),
    }
}

/// Studies of CoGiRo and CAROCA: how they swing, how far they are shaken in the worst direction and along z.
fn studies() -> Vec<Study> {
    let mut along = of_two_robots("amplitude");
    for study in &mut along {
        let spec = study.file.amplitude.unwrap();
        study.file.amplitude = Some(AmplitudeSpec { along: Some(AlongAxis::Z), ..spec });
    }
    let [swinging, worst] = ["platform_frequency", "amplitude"].map(of_two_robots);
    swinging.into_iter().chain(worst).chain(along).collect()
}

#[test]
fn vibrations_of_a_study_are_those_of_a_loop_over_its_robots() {
    for study in studies() {
        let sampling = study.sampling("point").unwrap();
        let values = observed(&sampling);
        for (deviations, measured) in values.iter().step_by(7) {
            let (found, expected) = (measured.value(), by_hand(&study, deviations));
            let off = (found / expected - 1.0).abs();
            assert!(off < 3e-6, "{} {}: {found} {expected}", study.robot.name, study.file.output);
        }
        let none = vec![0.0; values[0].0.len()];
        let off = (sampling.nominal_value / by_hand(&study, &none) - 1.0).abs();
        assert!(off < 3e-6, "{} {}: {off}", study.robot.name, study.file.output);
    }
}

#[test]
fn vibrations_have_indices_to_first_order_and_a_verdict() {
    for mut study in studies().into_iter().take(4) {
        study.file.error_models["all"].shift_remove("b");
        study.file.sensitivity = Some(small_measures());
        let sampling = study.sampling("point").unwrap();
        let session = Session::in_memory();
        let tally = observe(&sampling, &session).unwrap();
        let summary = analyse(&sampling, &tally, &session).unwrap();
        assert_eq!(summary.output, study.file.output);
        assert!(summary.notes.iter().all(|note| note.contains("of the energy of this motion")));
        assert!(!summary.verdict.sentences.is_empty());
        let sensitivity = summary.sensitivity.unwrap();
        assert_eq!(sensitivity.methods["dgsm"].failed, 0, "{:?}", sensitivity.notes);
        for method in ["regression", "morris", "expansion", "sobol"] {
            assert!(sensitivity.methods.contains_key(method), "{method}");
        }
        // Those of the derivatives and those of the regression name the same greatest share.
        let greatest = |of: fn(&InputMeasures) -> Option<f64>| {
            let shares = sensitivity.inputs.iter().filter_map(|input| Some((&input.input, of(input)?)));
            shares.max_by(|one, other| one.1.total_cmp(&other.1)).map(|(name, _)| name)
        };
        if study.file.output == Output::Amplitude {
            assert_eq!(greatest(|input| input.derivative_share), greatest(|input| input.regression_share));
        }
    }
}

#[test]
fn an_amplitude_without_its_force_and_a_force_without_it_are_refused() {
    let refused = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut file = study("cogiro", [1.0, 0.5, 2.0], "amplitude");
        change(&mut file);
        opened(&file).unwrap_err().to_string()
    };
    let error = refused(&|file| drop(file.as_object_mut().unwrap().remove("amplitude")));
    assert!(error.contains("output is amplitude: expected `amplitude`, too"), "{error}");
    let error = refused(&|file| file["output"] = json!("stiffness"));
    assert!(error.contains("amplitude is 2 Hz: expected output amplitude"), "{error}");
    for (field, value) in [("frequency", 0.0), ("damping", -1.0), ("drag", -0.5)] {
        let error = refused(&|file| file["amplitude"][field] = json!(value));
        assert!(error.contains(&format!("amplitude.{field} is {value:?}")), "{error}");
    }
    let error = refused(&|file| file["amplitude"]["along"] = json!("up"));
    assert!(error.contains("`x`, `y` or `z`") || error.contains("`x`, `y`, `z`"), "{error}");
    let error = opened(&study("caroca", [0.0, 0.0, 1.75], "amplitude")).unwrap_err().to_string();
    assert!(error.contains("output is amplitude: expected a robot with `platform.inertia`"), "{error}");
    assert_eq!(AlongAxis::Z, serde_json::from_value(json!("z")).unwrap());
    let study = opened(&study("cogiro", [1.0, 0.5, 2.0], "amplitude")).unwrap();
    assert_eq!(study.file.amplitude.unwrap().at().along.map(Axis::index), None);
    // The frequency determines the observations.
    let mut other = study.clone();
    other.file.amplitude = Some(AmplitudeSpec { frequency: 2.5, ..study.file.amplitude.unwrap() });
    assert_ne!(study.hash().unwrap(), other.hash().unwrap());
}

#[test]
fn the_frequency_of_a_robot_with_four_cables_is_that_of_its_free_motion() {
    let [_, study] = of_four_cables("frequency");
    let sampling = study.sampling("point").unwrap();
    let free = &study.file.samplings["point"].free;
    let wanted = WantedPose::at(&sampling.pose).free(free);
    let modes = modes_at(&study.robot, wanted, &Load::none(), Wanted::OfPlatform).unwrap();
    let platform = modes.lowest().unwrap().frequency;
    // A tenth of a kilogram at the centre of mass of one kilogram.
    same(sampling.nominal_value, platform, 0.1);
    assert!((0.5..2.0).contains(&sampling.nominal_value), "{}", sampling.nominal_value);
    assert!(observed(&sampling).iter().all(|(_, found)| (found.value() / platform - 1.0).abs() < 0.2));
}
