//! Samplings with correlated inputs.

use crate::sensitivity::{SMALL, changed, input, measured};
use cdpr_sensitivity::SampleDesign;
use cdpr_study::{SensitivitySpec, Session, observe};

const CORRELATED: (&str, &str) = (
    "\"error_model\": \"table_3\",",
    "\"error_model\": \"table_3\", \"first_index\": 1, \
     \"correlations\": [{\"between\": [\"youngs_modulus\", \"mass\"], \"value\": 0.8}],",
);

#[test]
fn a_parameter_that_acts_only_through_its_correlation_has_a_shapley_effect() {
    let mut study = changed(&[CORRELATED]).unwrap();
    let spec = SensitivitySpec { shapley_walks: 512, ..SMALL };
    study.file.sensitivity = Some(spec);
    let found = measured(&study, "mechanical", &spec);
    // The modulus has nearly all of the variance. By C = 0.8 of uniform laws the mass explains 0.62 of it;
    // half of what both explain is its own.
    let (modulus, mass) = (input(&found, "youngs_modulus"), input(&found, "mass"));
    let correlation = 6.0 / std::f64::consts::PI * 0.4_f64.asin();
    let shared = 0.5 * correlation * correlation;
    for (of, exact) in [(modulus, 1.0 - shared), (mass, shared)] {
        let (low, high) = (of.shapley_low.unwrap(), of.shapley_high.unwrap());
        assert!(low - 0.01 < exact && exact < high + 0.01 && high - low < 0.2, "{exact}: {low} {high}");
    }
    assert!((found.sums["all"]["shapley"] - 1.0).abs() < 1e-9);
    // What needs independent inputs is left out by name.
    assert!(found.notes[0].starts_with("t_student, derivatives, morris, dgsm"), "{:?}", found.notes);
    let methods: Vec<_> = found.methods.keys().map(String::as_str).collect();
    assert_eq!(methods, ["regression", "rank_regression", "shapley"]);
    assert!(mass.sobol_total.is_none() && mass.t_student.is_none());

    // Without correlations it is the share of Sobol' indices.
    let study = changed(&[]).unwrap();
    let found = measured(&study, "mechanical", &spec);
    let modulus = input(&found, "youngs_modulus");
    assert!(modulus.shapley_low.unwrap() < 0.9945 && modulus.shapley_high.unwrap() > 0.9945, "{modulus:?}");
}

#[test]
fn correlated_deviations_are_observed_as_such() {
    let study = changed(&[CORRELATED]).unwrap();
    let sampling = study.sampling("mechanical").unwrap();
    let place = |name| sampling.design.inputs().iter().position(|input| input.name == name).unwrap();
    let (i, j, k) = (place("youngs_modulus"), place("mass"), sampling.design.inputs().len());
    let mut pairs = Vec::new();
    let each = |part: &cdpr_study::Part| -> Vec<[f64; 2]> {
        part.rows.chunks(k).map(|row| [row[i], row[j]]).collect()
    };
    cdpr_study::observe_into(&sampling, &Session::in_memory(), each, |part| {
        pairs.extend(part);
        Ok(())
    })
    .unwrap();
    let mean = |of: &dyn Fn(&[f64; 2]) -> f64| pairs.iter().map(of).sum::<f64>() / pairs.len() as f64;
    let [x, y] = [mean(&|pair| pair[0]), mean(&|pair| pair[1])];
    let product = mean(&|pair| (pair[0] - x) * (pair[1] - y));
    let scale = (mean(&|pair| (pair[0] - x).powi(2)) * mean(&|pair| (pair[1] - y).powi(2))).sqrt();
    let expected = 6.0 / std::f64::consts::PI * 0.4_f64.asin();
    assert!((product / scale - expected).abs() < 0.02, "{}", product / scale);
    let found = cdpr_study::analyse(
        &sampling,
        &observe(&sampling, &Session::in_memory()).unwrap(),
        &Session::in_memory(),
    );
    let found = found.unwrap();
    assert!(found.t_student.is_empty() && found.signed_effects.is_empty());
    assert!(found.notes.iter().any(|note| note.contains("the inputs are correlated")), "{:?}", found.notes);
}

#[test]
fn correlations_that_cannot_be_are_refused() {
    let refusal = |correlations: &str| {
        let to =
            format!("\"error_model\": \"table_3\", \"first_index\": 1, \"correlations\": [{correlations}],");
        changed(&[("\"error_model\": \"table_3\",", &to)]).unwrap_err().to_string()
    };
    let unknown = refusal("{\"between\": [\"mass\", \"m\"], \"value\": 0.5}");
    assert!(unknown.contains("correlations[0].between is m: expected the name of an input"), "{unknown}");
    let one = refusal("{\"between\": [\"mass\", \"youngs_modulus\"], \"value\": 1.0}");
    assert!(one.contains("value is 1: expected a number above -1 and below 1"), "{one}");
    let same = refusal("{\"between\": [\"mass\", \"mass\"], \"value\": 0.5}");
    assert!(same.contains("two different inputs"), "{same}");
    let of =
        |i: &str, j: &str, value: f64| format!("{{\"between\": [\"{i}\", \"{j}\"], \"value\": {value}}}");
    let contradiction =
        [of("a1.x", "a1.y", 0.9), of("a1.y", "a1.z", 0.9), of("a1.x", "a1.z", -0.9)].join(", ");
    let refused = refusal(&contradiction);
    assert!(refused.contains("correlations is contradictory for `a1.z`: expected"), "{refused}");
}
