//! The measures of sensitivity agree where they should, and one that fails leaves a note.

use cdpr_sensitivity::SampleDesign;
use cdpr_study::{
    InputMeasures, MEASURES, SensitivitySpec, SensitivitySummary, Session, Study, StudyError, Truncation,
    VectorOutput, measure, observe,
};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

pub(crate) fn text() -> String {
    std::fs::read_to_string(path()).unwrap()
}

pub(crate) fn path() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca-sensitivity.json"))
}

pub(crate) const SMALL: SensitivitySpec = SensitivitySpec {
    observations: 500,
    saltelli_blocks: 256,
    bootstrap_resamples: 200,
    morris_blocks: 32,
    morris_levels: None,
    derivative_points: 64,
    shapley_walks: 0,
    bures_observations: 0,
    vector: VectorOutput::Displacement,
    gradient_expansion: false,
    expansion: Truncation { max_degree: 2, norm: 0.75, interactions: 2 },
};

pub(crate) fn of_sampling(name: &str, spec: &SensitivitySpec) -> SensitivitySummary {
    let study = Study::open(path()).unwrap();
    let sampling = study.sampling(name).unwrap();
    let session = Session::in_memory();
    measure(&sampling, spec, &observe(&sampling, &session).unwrap(), &session).unwrap()
}

/// Measures that were left out; a doubt about intervals leaves nothing out.
pub(crate) fn left_out(found: &SensitivitySummary) -> Vec<&str> {
    let is_doubt = |note: &&String| note.ends_with("the intervals are an indication only");
    let notes = found.notes.iter().filter(|note| !is_doubt(note));
    notes.map(|note| note.split(':').next().unwrap()).collect()
}

pub(crate) fn input<'a>(found: &'a SensitivitySummary, name: &str) -> &'a InputMeasures {
    found.inputs.iter().find(|input| input.input == name).unwrap()
}

/// Without the wall times, which differ from run to run.
fn timeless(mut found: SensitivitySummary) -> SensitivitySummary {
    found.methods.values_mut().for_each(|method| method.seconds = 0.0);
    found
}

#[test]
fn derivatives_and_sobol_indices_agree_on_the_share_of_the_modulus() {
    let found = of_sampling("mechanical", &SMALL);
    assert_eq!((found.methods.len(), left_out(&found)), (10, vec![]));
    let modulus = input(&found, "youngs_modulus");
    let share = modulus.derivative_share.unwrap();
    assert!((share - 0.9945).abs() < 1e-4, "{share}");
    let (low, high) = (modulus.sobol_first_low.unwrap(), modulus.sobol_first_high.unwrap());
    assert!(low < share && share < high, "{share} is not in {low} .. {high}");
    for other in [modulus.regression_share, modulus.rank_regression_share, modulus.expansion_total] {
        assert!((other.unwrap() - share).abs() < 0.02, "{other:?}");
    }
    assert!(modulus.dgsm_total_bound >= modulus.sobol_total_low);

    // A model that is almost the sum of its inputs.
    for (name, sum) in &found.sums["all"] {
        // The modulus has nearly all of it, and the error that its interval tells.
        let error = if ["sobol", "vector"].iter().any(|one| name.starts_with(one)) {
            0.5 * (high - low)
        } else {
            0.02
        };
        assert!((sum - 1.0).abs() < error, "{name}: {sum}");
    }
    let without_all = found.sums.iter().filter(|(group, _)| **group != "all");
    let of_groups: f64 = without_all.map(|(_, sums)| sums["sobol_first"]).sum();
    assert!((of_groups - found.sums["all"]["sobol_first"]).abs() < 1e-12);
    assert!(found.methods["regression"].r_squared.unwrap() > 0.98);
    assert!(found.methods["expansion"].leave_one_out.unwrap() < 0.01);
}

#[test]
fn bounds_by_derivatives_hold_the_sobol_indices_of_every_parameter() {
    let spec = SensitivitySpec { saltelli_blocks: 4096, derivative_points: 256, ..SMALL };
    for name in ["mechanical", "geometrical", "geometrical_asymmetric"] {
        let found = of_sampling(name, &spec);
        // Where few points decide the mean square, the bracket rests on the shares of the other inputs.
        let is_decided = |input: &&InputMeasures| input.dgsm_total_bound_high.is_some();
        assert!(4 * found.inputs.iter().filter(is_decided).count() > 3 * found.inputs.len(), "{name}");
        for input in &found.inputs {
            let indices = [
                (input.sobol_first_low, input.sobol_first_high, input.first_bracket()),
                (input.sobol_total_low, input.sobol_total_high, input.total_bracket()),
            ];
            for (low, high, bracket) in indices {
                let [lower, upper] = bracket.unwrap();
                assert!(lower <= upper, "{input:?}");
                // The interval of the index and the bracket have a common point.
                assert!(low.unwrap() <= upper && lower <= high.unwrap(), "{name}: {input:?}");
            }
            let width = input.total_upper_high.unwrap() - input.total_lower_low.unwrap();
            let most = if is_decided(&input) { 0.15 } else { 0.5 };
            assert!(width < most, "{name}: {width}, {input:?}");
        }
    }
}

/// The study with these fields in place of the first ones of their names.
pub(crate) fn changed(changes: &[(&str, &str)]) -> Result<Study, StudyError> {
    let mut text = text();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    Study::from_json(&text, path())
}

pub(crate) fn measured(study: &Study, name: &str, spec: &SensitivitySpec) -> SensitivitySummary {
    let sampling = study.sampling(name).unwrap();
    let session = Session::in_memory();
    measure(&sampling, spec, &observe(&sampling, &session).unwrap(), &session).unwrap()
}

const GROUPS: (&str, &str) = (
    "\"samplings\": {",
    "\"groups\": {\"cable 1\": [\"a1\", \"b1.x\", \"b1\", \"dt1\"], \"exits\": [\"b\"], \
     \"modulus\": [\"youngs_modulus\"]}, \
     \"samplings\": {",
);

#[test]
fn indices_of_groups_are_those_of_their_inputs_and_what_these_cause_together() {
    let mut study = changed(&[GROUPS]).unwrap();
    study.file.sensitivity = Some(SMALL);
    let found = measured(&study, "geometrical", &SMALL);
    let names: Vec<_> = found.groups.iter().map(|group| (group.group.as_str(), group.inputs.len())).collect();
    assert_eq!(names, [("cable 1", 7), ("exits", 24), ("modulus", 1)]);
    for group in &found.groups {
        let of_group = |input: &&InputMeasures| group.inputs.contains(&input.input);
        let sum: f64 = found.inputs.iter().filter(of_group).filter_map(|input| input.derivative_share).sum();
        // The robot is nearly linear at this pose.
        let (low, high) = (group.sobol_first_low.unwrap(), group.sobol_first_high.unwrap());
        assert!(low - 0.05 < sum && sum < high + 0.05, "{sum}: {group:?}");
        assert!(group.sobol_total_high.unwrap() > sum - 0.05 && group.morris_mean_absolute.unwrap() > 0.0);
    }
    let ticked = AtomicUsize::new(0);
    let tick = |done: usize| {
        ticked.fetch_add(done, Ordering::Relaxed);
    };
    let session = Session { tick: &tick, ..Session::in_memory() };
    let sampling = study.sampling("geometrical").unwrap();
    measure(&sampling, &SMALL, &observe(&sampling, &session).unwrap(), &session).unwrap();
    let replicates = sampling.design.points() * study.file.replicates;
    assert_eq!(ticked.into_inner() + replicates, study.observations("geometrical").unwrap());
}

#[test]
fn groups_of_unknown_names_are_refused() {
    let wrong = ("\"samplings\": {", "\"groups\": {\"p\": [\"a1\", \"c9\"]}, \"samplings\": {");
    let error = changed(&[wrong]).unwrap_err().to_string();
    assert!(error.contains("groups.p is c9: expected the name of an input"), "{error}");
}

#[test]
fn what_a_study_asks_for_beside_agrees_with_sobol_indices() {
    let mut study = changed(&[]).unwrap();
    let spec = SensitivitySpec { bures_observations: 4096, gradient_expansion: true, ..SMALL };
    study.file.sensitivity = Some(spec);
    let found = measured(&study, "mechanical", &spec);
    for of in &found.inputs {
        let (first, total) = (of.gradient_expansion_first.unwrap(), of.gradient_expansion_total.unwrap());
        assert!((total - of.expansion_total.unwrap()).abs() < 2e-3, "{of:?}");
        assert!(first <= total && of.sobol_total_low.unwrap() < total + 1e-2, "{of:?}");
        // The means are half of the first-order index of the vector.
        let (means, index) = (of.bures_means.unwrap(), of.bures.unwrap());
        assert!((2.0 * means - of.vector_first.unwrap()).abs() < 0.15, "{of:?}");
        assert!(index > means - 0.02 && of.bures_low.unwrap() < index && index < of.bures_high.unwrap());
    }
    assert_eq!(found.methods["gradient_expansion"].derivatives, Some(true));
    assert!(found.methods["gradient_expansion"].leave_one_out.unwrap() < 0.01);
    let modulus = input(&found, "youngs_modulus");
    assert!(modulus.bures.unwrap() > 0.5 && modulus.bures_means.unwrap() > 0.45, "{modulus:?}");
    let few = ("\"morris_blocks\": 128", "\"morris_blocks\": 128, \"bures_observations\": 10");
    let error = changed(&[few]).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("bures_observations") && error.contains("0, or at least 64"), "{error}");
}

#[test]
fn indices_of_poses_count_rotations_by_their_length() {
    let of = |length: f64| {
        let mut study = changed(&[]).unwrap();
        let vector = VectorOutput::Pose { characteristic_length: length };
        let spec = SensitivitySpec { bures_observations: 1024, vector, ..SMALL };
        study.file.sensitivity = Some(spec);
        measured(&study, "geometrical_asymmetric", &spec)
    };
    let spec = SensitivitySpec { bures_observations: 1024, ..SMALL };
    let plain = measured(&changed(&[]).unwrap(), "geometrical_asymmetric", &spec);
    // A length of nothing leaves the displacement; the output itself is the same in any case.
    let [short, long] = [1e-9, 1e3].map(of);
    let near = |one: Option<f64>, other: Option<f64>| (one.unwrap() - other.unwrap()).abs() < 1e-6;
    let mut moved = 0.0_f64;
    for ((plain, short), long) in plain.inputs.iter().zip(&short.inputs).zip(&long.inputs) {
        assert_eq!((plain.sobol_first, plain.sobol_total), (short.sobol_first, long.sobol_total));
        assert!(near(plain.vector_first, short.vector_first) && near(plain.bures, short.bures), "{short:?}");
        moved = moved.max((long.vector_total.unwrap() - plain.vector_total.unwrap()).abs());
    }
    assert!(moved > 0.1, "{moved}");
    assert_eq!(short.vector, VectorOutput::Pose { characteristic_length: 1e-9 });

    let of_vector = |vector: &str| {
        let to = format!("\"morris_blocks\": 128, \"vector\": {vector}");
        changed(&[("\"morris_blocks\": 128", &to)]).map(|study| study.file.sensitivity.unwrap().vector)
    };
    let pose = of_vector("{\"pose\": {\"characteristic_length\": 0.5}}").unwrap();
    assert_eq!(pose, VectorOutput::Pose { characteristic_length: 0.5 });
    assert_eq!(of_vector("\"displacement\"").unwrap(), VectorOutput::Displacement);
    let error = of_vector("{\"pose\": {\"characteristic_length\": 0.0}}").unwrap_err().to_string();
    assert!(error.contains("vector.pose.characteristic_length is 0: expected a length above 0"), "{error}");
    let stiffness = ("\"payload\"", "\"output\": \"stiffness\", \"payload\"");
    let to = "\"morris_blocks\": 128, \"vector\": {\"pose\": {\"characteristic_length\": 0.5}}";
    let error = changed(&[stiffness, ("\"morris_blocks\": 128", to)]).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("sensitivity.vector is pose: expected no pose, or"), "{error}");
}

#[test]
fn errors_of_the_position_have_indices_of_the_pose() {
    let mut study = changed(&[]).unwrap();
    study.file.output = cdpr_study::Output::Position;
    let mut of = |vector| {
        let spec = SensitivitySpec { saltelli_blocks: 16, vector, ..SMALL };
        study.file.sensitivity = Some(spec);
        let found = measured(&study, "mechanical", &spec);
        let total = |of: &InputMeasures| [of.vector_total.unwrap(), of.sobol_total.unwrap()];
        found.inputs.iter().map(total).collect::<Vec<_>>()
    };
    let plain = of(VectorOutput::Displacement);
    let [short, long] = [1e-9, 1e3].map(|length| of(VectorOutput::Pose { characteristic_length: length }));
    let mut moved = 0.0_f64;
    for ((plain, short), long) in plain.iter().zip(&short).zip(&long) {
        assert!((plain[0] - short[0]).abs() < 1e-6 && plain[1] == short[1] && plain[1] == long[1]);
        moved = moved.max((plain[0] - long[0]).abs());
    }
    assert!(moved > 0.01, "{moved}");
}

#[test]
fn trajectories_take_the_place_of_radial_blocks() {
    let spec = SensitivitySpec { morris_levels: Some(4), ..SMALL };
    let (radial, found) = (of_sampling("mechanical", &SMALL), of_sampling("mechanical", &spec));
    let effect = |of: &SensitivitySummary| input(of, "youngs_modulus").morris_mean_absolute.unwrap();
    assert_ne!(effect(&radial), effect(&found));
    // The effect of a nearly linear input is its slope times its range, wherever it is taken.
    assert!((effect(&radial) / effect(&found) - 1.0).abs() < 0.02);
}

#[test]
fn all_measures_lead_with_the_modulus_and_their_ranks_are_correlated() {
    let found = of_sampling("geometrical", &SMALL);
    let agreement = &found.agreement;
    assert_eq!(agreement.first, 10);
    assert!(agreement.inputs.iter().any(|input| input == "youngs_modulus"), "{agreement:?}");
    assert_eq!(found.leading()[0].input, "youngs_modulus");
    // Nobody has asked for an expansion of derivatives.
    let ranks = |of: &&cdpr_study::Measure| of.ranks && of.name != "gradient_expansion_total";
    let ranking: Vec<_> = MEASURES.iter().filter(ranks).map(|one| one.name).collect();
    assert_eq!(agreement.measures, ranking);
    for (i, row) in agreement.rank_correlation.iter().enumerate() {
        for (j, correlation) in row.iter().enumerate() {
            let correlation = correlation.unwrap();
            assert!((correlation - agreement.rank_correlation[j][i].unwrap()).abs() < 1e-12);
            assert!((0.4..1.0 + 1e-12).contains(&correlation), "{i} {j}: {correlation}");
        }
        assert!((row[i].unwrap() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn what_acts_only_together_with_others_has_a_total_index_and_no_share_of_its_own() {
    // Near the corner the deflection is least, but for curvature, where the centre of mass is nominal.
    let expansion = Truncation { norm: 1.0, ..SMALL.expansion };
    let found =
        of_sampling("geometrical_asymmetric", &SensitivitySpec { saltelli_blocks: 2048, expansion, ..SMALL });
    let center = input(&found, "cog.x");
    assert!(center.derivative_share.unwrap() < 0.001);
    assert!(center.regression_share.unwrap() < 0.02);
    assert!(center.sobol_total_low.unwrap() > 0.08, "{center:?}");
    assert!(center.expansion_total.unwrap() > center.expansion_first.unwrap());
    assert!(center.morris_std > center.morris_mean_absolute);
}

#[test]
fn the_numbers_do_not_depend_on_the_number_of_threads_and_every_observation_is_told() {
    let mut study = Study::open(path()).unwrap();
    study.file.sensitivity = Some(SMALL);
    let sampling = study.sampling("geometrical_asymmetric").unwrap();
    let on = |threads| {
        let ticked = AtomicUsize::new(0);
        let tick = |done: usize| {
            ticked.fetch_add(done, Ordering::Relaxed);
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let session = Session { tick: &tick, ..Session::in_memory() };
        let found = pool.install(|| {
            let tally = observe(&sampling, &session).unwrap();
            measure(&sampling, &SMALL, &tally, &session).unwrap()
        });
        (timeless(found), ticked.into_inner())
    };
    let one = on(1);
    assert_eq!(one, on(3));
    let replicates = 2000 * study.file.replicates;
    assert_eq!(one.1 + replicates, study.observations("geometrical_asymmetric").unwrap());
}

#[test]
fn a_measure_that_fails_is_a_note() {
    // 20 observations do not tell 62 coefficients.
    let spec = SensitivitySpec { observations: 20, ..SMALL };
    let found = of_sampling("mechanical", &spec);
    assert_eq!(left_out(&found), ["regression", "rank_regression"]);
    assert!(found.notes[0].contains("64"), "{:?}", found.notes);
    assert!(found.inputs.iter().all(|input| input.regression_share.is_none() && input.sobol_first.is_some()));
    assert!(!found.sums["all"].contains_key("regression_share"));
    assert!(!found.agreement.measures.iter().any(|name| name == "regression_share"));
    assert_eq!(found.leading()[0].input, "youngs_modulus");
}
