//! Chaos expansions: polynomials that they recover, exact indices; noise, steps and failures.

use super::functions::{self, Function};
use crate::common::{rows, uniform};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use cdpr_sensitivity::{
    Expansion, Input, LatinHypercube, Law, SampleDesign, SensitivityError, SobolDesign, Steps, Truncation,
    expansion, observe,
};
use proptest::prelude::*;

const FULL: Truncation = Truncation { max_degree: 4, norm: 1.0, interactions: 3 };

fn fit<D: cdpr_sensitivity::IndependentSample>(
    design: &D,
    truncation: Truncation,
    model: impl Fn(&[f64]) -> f64 + Sync,
) -> Expansion {
    expansion(design, &observe(design, |x| Some(model(x))).unwrap(), truncation).unwrap()
}

fn assert_indices(found: &Expansion, function: &Function, tolerance: f64) {
    for (shares, (first, total)) in found.indices().iter().zip(function.first.iter().zip(&function.total)) {
        assert_abs_diff_eq!(shares.closed, first, epsilon = tolerance);
        assert_abs_diff_eq!(shares.total, total, epsilon = tolerance);
    }
}

#[test]
fn a_linear_model_is_its_own_expansion() {
    let function = functions::linear();
    let design = SobolDesign::scrambled(function.inputs.clone(), 64, 1).unwrap();
    let found = fit(&design, FULL, &function.model);
    assert_indices(&found, &function, 1e-12);
    assert_eq!(found.terms.iter().filter(|term| term.coefficient.abs() > 1e-12).count(), 3);
    assert_relative_eq!(found.mean, 3.0, max_relative = 1e-13);
    assert_relative_eq!(found.variance(), 38.0 / 12.0, max_relative = 1e-12);
    assert!(found.leave_one_out < 1e-24, "{}", found.leave_one_out);
}

#[test]
fn ishigamis_function_is_found_from_512_points() {
    let function = functions::ishigami();
    let design = SobolDesign::scrambled(function.inputs.clone(), 512, 1).unwrap();
    let found = fit(&design, Truncation { max_degree: 12, norm: 1.0, interactions: 3 }, &function.model);
    // Blatman and Sudret 2011, table 3: errors of 1e-3 from some 400 points.
    assert!(found.leave_one_out < 1e-5, "{}", found.leave_one_out);
    assert_indices(&found, &function, 1e-3);
    let pairs = found.pairs();
    let strongest = pairs.iter().max_by(|one, other| one.share.total_cmp(&other.share)).unwrap();
    assert_eq!(strongest.inputs, [0, 2]);
    assert_abs_diff_eq!(strongest.share, function.total[2], epsilon = 1e-3);

    let outer = found.group(&["x1", "x3"]).unwrap();
    assert_abs_diff_eq!(outer.closed, 1.0 - function.first[1], epsilon = 1e-3);
    assert_abs_diff_eq!(outer.closed + found.group(&["x2"]).unwrap().total, 1.0, epsilon = 1e-12);
    let all = found.group(&["x1", "x2", "x3"]).unwrap();
    assert_relative_eq!(all.closed, 1.0, epsilon = 1e-12);
    let error = found.group(&["x1", "x9"]).unwrap_err();
    assert_eq!(error, SensitivityError::UnknownInput { name: "x9".into() });
}

#[test]
fn indices_of_kinked_and_of_many_inputs_are_as_accurate_as_the_leave_one_out_error() {
    for (function, truncation, largest) in [
        (functions::sobol_g(), Truncation { max_degree: 10, norm: 0.75, interactions: 2 }, 0.1),
        (functions::morris(), Truncation { max_degree: 4, norm: 1.0, interactions: 4 }, 0.1),
    ] {
        let design = LatinHypercube::new(function.inputs.clone(), 1000, 1).unwrap();
        let found = fit(&design, truncation, &function.model);
        assert!(found.leave_one_out < largest, "{}: {}", function.name, found.leave_one_out);
        // What is not explained, and the noise that it makes in each coefficient: 2 c √(ε / n), four times.
        let error = found.leave_one_out;
        assert_indices(&found, &function, error + 4.0 * (error / 1000.0).sqrt());
    }
}

#[test]
fn the_leave_one_out_error_is_that_of_new_points() {
    let function = functions::sobol_g();
    let truncation = Truncation { max_degree: 8, norm: 0.75, interactions: 2 };
    let design = SobolDesign::scrambled(function.inputs.clone(), 512, 1).unwrap();
    let found = fit(&design, truncation, &function.model);
    let square = |row: &Vec<f64>| ((function.model)(row) - found.predict(row).unwrap()).powi(2);
    let sum: f64 = rows(&design.replicate(2), 1).iter().map(square).sum();
    let variance = design_variance(&function);
    // The mean of 512 squares, of a deviation of some percent of it.
    assert_relative_eq!(found.leave_one_out, sum / 512.0 / variance, max_relative = 0.35);
}

/// Variance of Sobol's G: V_1 / S_1 with V_1 = 1/3.
fn design_variance(function: &Function) -> f64 {
    1.0 / 3.0 / function.first[0]
}

#[test]
fn normal_and_other_laws_have_polynomials_of_their_own() {
    let normal = Law::Normal { mean: 2.0, std: 0.5 };
    let triangular = Law::Triangular { min: 0.0, mode: 0.2, max: 1.0 };
    let inputs = vec![Input::continuous("n", normal), Input::continuous("t", triangular)];
    let design = SobolDesign::scrambled(inputs, 256, 1).unwrap();
    // z² + z is √2 ψ_2 + 1 + ψ_1; F of the triangular law is uniform: its part has a variance of 1/12.
    let found = fit(&design, FULL, |x| {
        let z = (x[0] - 2.0) / 0.5;
        z * z + z + triangular.cdf(x[1])
    });
    assert_relative_eq!(found.variance(), 3.0 + 1.0 / 12.0, max_relative = 1e-8);
    assert_relative_eq!(found.mean, 1.5, max_relative = 1e-8);
    assert_relative_eq!(found.indices()[0].total, 3.0 / (3.0 + 1.0 / 12.0), max_relative = 1e-8);
    let row = [2.7, 0.4];
    assert_relative_eq!(found.predict(&row).unwrap(), 1.96 + 1.4 + triangular.cdf(0.4), max_relative = 1e-8);
}

#[test]
fn a_stepped_input_is_expanded_in_polynomials_of_its_levels() {
    let law = Law::Uniform { min: -1.0, max: 1.0 };
    let steps = Steps::Nearest { step: 0.04 };
    let inputs = vec![Input::stepped("a", law, steps), Input::continuous("b", law)];
    let design = SobolDesign::scrambled(inputs, 256, 1).unwrap();
    let found = fit(&design, FULL, |x| 2.0 * x[0] + x[1] + x[0] * x[1]);
    assert!(found.leave_one_out < 1e-24);
    // 51 levels, of which the two at the ends have half the weight of the others.
    let levels = (1.0 + 0.5 * 0.04_f64.powi(2)) / 3.0;
    let variance = 4.0 * levels + 1.0 / 3.0 + levels / 3.0;
    assert_relative_eq!(found.indices()[0].closed, 4.0 * levels / variance, max_relative = 1e-10);
}

#[test]
fn a_sum_of_lognormal_inputs_is_exact_and_a_sum_of_logarithms_is_expanded_in_probabilities() {
    let law = Law::LogNormal { log_mean: 0.0, log_std: 1.0 };
    let inputs = vec![Input::continuous("a", law), Input::continuous("b", law)];
    let design = SobolDesign::scrambled(inputs, 256, 1).unwrap();
    let sum = fit(&design, FULL, |x| x[0] + x[1]);
    let exact = 2.0 * 1.0_f64.exp() * 1.0_f64.exp_m1();
    assert_relative_eq!(sum.variance(), exact, max_relative = 1e-10);
    assert!(sum.polynomials.iter().all(|polynomials| polynomials.probability.is_none()));
    let logarithms = fit(&design, FULL, |x| x[0].ln() + x[1].ln());
    assert!(logarithms.polynomials.iter().all(|polynomials| polynomials.probability == Some(law)));
    assert_relative_eq!(logarithms.variance(), 2.0, max_relative = 0.05);
}

#[test]
fn an_expansion_of_pure_noise_has_hardly_a_term_and_a_large_error() {
    let design = SobolDesign::scrambled(uniform(10, 0.0, 1.0), 400, 1).unwrap();
    let noise = |x: &[f64]| (1e6 * x.iter().sum::<f64>()).sin();
    let found = fit(&design, FULL, noise);
    // The best of some 600 candidates explains about 2 ln 600 / 400 of it by chance.
    assert!(found.leave_one_out > 0.9, "{}", found.leave_one_out);
    assert!(found.terms.len() < 5 && found.indices().iter().all(|shares| shares.total.is_finite()));
}

#[test]
fn failures_are_left_out_and_counted() {
    let design = SobolDesign::scrambled(uniform(3, -1.0, 1.0), 200, 1).unwrap();
    let outputs = observe(&design, |x| (x[0] < 0.5).then_some(x[0] + x[1] * x[2])).unwrap();
    let found = expansion(&design, &outputs, FULL).unwrap();
    assert_eq!((found.observed, found.failed), (150, 50));
    assert_relative_eq!(found.variance(), 1.0 / 3.0 + 1.0 / 9.0, max_relative = 1e-10);
}

#[test]
fn what_cannot_be_expanded_is_an_error() {
    let design = SobolDesign::scrambled(uniform(3, -1.0, 1.0), 40, 1).unwrap();
    let outputs = observe(&design, |x| Some(x[0])).unwrap();
    let error = |outputs: &[Option<f64>], truncation| expansion(&design, outputs, truncation).unwrap_err();
    let range = |error| match error {
        SensitivityError::OutOfRange { field, .. } => field,
        _ => "another error",
    };
    assert_eq!(range(error(&outputs, Truncation { max_degree: 0, ..FULL })), "degree");
    assert_eq!(range(error(&outputs, Truncation { max_degree: 101, ..FULL })), "degree");
    assert_eq!(range(error(&outputs, Truncation { interactions: 0, ..FULL })), "interactions");
    assert_eq!(range(error(&[outputs[..9].to_vec(), vec![None; 31]].concat(), FULL)), "observed outputs");
    for norm in [0.0, 1.1, f64::NAN] {
        let error = error(&outputs, Truncation { norm, ..FULL });
        assert!(matches!(error, SensitivityError::InvalidParameter { field: "norm", .. }));
    }
    assert_eq!(error(&[Some(1.0); 40], FULL), SensitivityError::ConstantSample { value: 1.0, count: 40 });
    let mut infinite = outputs.clone();
    infinite[7] = Some(f64::INFINITY);
    assert!(matches!(error(&infinite, FULL), SensitivityError::NotFinite { index: 7, .. }));

    let many = SobolDesign::scrambled(uniform(300, -1.0, 1.0), 100, 1).unwrap();
    let outputs = observe(&many, |x| Some(x[0])).unwrap();
    assert_eq!(range(expansion(&many, &outputs, FULL).unwrap_err()), "candidate terms");
    let found = fit(&design, FULL, |x| x[0]);
    assert!(matches!(found.predict(&[0.0; 2]), Err(SensitivityError::LengthMismatch { field: "row", .. })));
}

proptest! {
    #[test]
    fn any_polynomial_within_the_truncation_is_found_again(
        coefficients in prop::collection::vec(-3.0..3.0_f64, 5),
        seed in 0..1000_u64,
    ) {
        let laws = [Law::Uniform { min: 1.0, max: 2.0 }, Law::Normal { mean: -1.0, std: 3.0 }];
        let inputs = ["u", "n"].iter().zip(laws).map(|(name, law)| Input::continuous(*name, law)).collect();
        let design = LatinHypercube::new(inputs, 80, seed).unwrap();
        let model = |x: &[f64]| {
            let (u, n) = (x[0] - 1.5, x[1] / 3.0);
            let powers = [u, n, u * n, u * u * n, n * n * n];
            10.0 + u + powers.iter().zip(&coefficients).map(|(power, c)| power * c).sum::<f64>()
        };
        let found = fit(&design, FULL, model);
        prop_assert!(found.leave_one_out < 1e-18, "{}", found.leave_one_out);
        for row in [[1.2, -4.0], [1.9, 5.0]] {
            prop_assert!((found.predict(&row).unwrap() - model(&row)).abs() < 1e-8);
        }
    }
}
