//! Regression coefficients against NumPy's and exact ones; correlated, stepped and collinear inputs.

use super::functions;
use crate::common::uniform;
use approx::{assert_abs_diff_eq, assert_relative_eq};
use cdpr_evidence::accept;
use cdpr_sensitivity::{
    Correlated, Input, JointSample, LatinHypercube, Law, Regression, SensitivityError, SobolDesign, Steps,
    observe, rank_correlation, rank_regression, regression,
};

#[derive(serde::Deserialize)]
struct Reference {
    regression: ReferenceRegression,
}

#[derive(serde::Deserialize)]
struct ReferenceRegression {
    points: usize,
    values: ReferenceCoefficients,
    ranks: ReferenceCoefficients,
}

#[derive(serde::Deserialize)]
struct ReferenceCoefficients {
    standardized: Vec<f64>,
    partial: Vec<f64>,
    r_squared: f64,
}

fn of_model<D: JointSample>(design: &D, model: impl Fn(&[f64]) -> f64 + Sync) -> Regression {
    regression(design, &observe(design, |x| Some(model(x))).unwrap()).unwrap()
}

#[test]
fn coefficients_are_those_of_numpy() {
    let text = include_str!("../../../../data/reference/indices.json");
    let reference = serde_json::from_str::<Reference>(text).unwrap().regression;
    let function = functions::ishigami();
    let design = SobolDesign::new(function.inputs, 0, reference.points).unwrap();
    let outputs = observe(&design, |x| Some((function.model)(x))).unwrap();
    for (found, expected) in [
        (regression(&design, &outputs).unwrap(), reference.values),
        (rank_regression(&design, &outputs).unwrap(), reference.ranks),
    ] {
        assert_abs_diff_eq!(found.r_squared, expected.r_squared, epsilon = 1e-13);
        for (i, coefficient) in found.inputs.iter().enumerate() {
            accept("V-STATISTICS-005", (coefficient.standardized - expected.standardized[i]).abs());
            accept("V-STATISTICS-005", (coefficient.partial - expected.partial[i]).abs());
        }
    }
}

#[test]
fn squares_are_the_shares_of_a_linear_model() {
    let function = functions::linear();
    let design = LatinHypercube::new(function.inputs, 4096, 1).unwrap();
    let found = of_model(&design, &function.model);
    assert_relative_eq!(found.r_squared, 1.0, epsilon = 1e-12);
    for ((coefficient, share), partial) in found.inputs.iter().zip(function.first).zip([1.0, 1.0, -1.0, 0.0])
    {
        // The columns of a Latin hypercube are correlated by about 1 / √4096.
        assert_abs_diff_eq!(coefficient.share, share, epsilon = 0.02);
        assert_eq!(coefficient.share, coefficient.standardized.powi(2));
        // An exact fit but for rounding: 1e-15 of an inert input may correlate as it likes.
        if share > 0.0 {
            assert_abs_diff_eq!(coefficient.partial, partial, epsilon = 1e-12);
        }
    }
}

#[test]
fn ranks_straighten_a_monotonic_model() {
    let design = SobolDesign::scrambled(uniform(2, 0.0, 1.0), 2048, 1).unwrap();
    let outputs = observe(&design, |x| Some((20.0 * (x[0] + 0.01 * x[1])).exp())).unwrap();
    let (values, ranks) =
        (regression(&design, &outputs).unwrap(), rank_regression(&design, &outputs).unwrap());
    assert!(values.r_squared < 0.6 && ranks.r_squared > 0.999, "{values:?} {ranks:?}");
}

#[test]
fn correlated_inputs_have_the_coefficients_of_their_model() {
    // y = x1 + x2 with correlation 0.8: variance 3.6, so that both have 1 / √3.6, and squares that do not add
    // up to 1.
    let law = Law::Normal { mean: 0.0, std: 1.0 };
    let inputs = ["x1", "x2"].map(|name| Input::continuous(name, law)).to_vec();
    let sobol = SobolDesign::scrambled(inputs, 4096, 1).unwrap();
    let design = Correlated::new(sobol, &[vec![1.0, 0.8], vec![0.8, 1.0]]).unwrap();
    let found = of_model(&design, |x| x[0] + x[1]);
    for coefficient in &found.inputs {
        assert_abs_diff_eq!(coefficient.standardized, 3.6_f64.sqrt().recip(), epsilon = 0.005);
    }
    assert_relative_eq!(found.r_squared, 1.0, epsilon = 1e-12);
    // An input that acts through its correlation alone has no coefficient of its own.
    let found = of_model(&design, |x| x[0]);
    assert_abs_diff_eq!(found.inputs[1].standardized, 0.0, epsilon = 1e-12);
}

#[test]
fn equal_values_share_their_mean_rank() {
    let law = Law::Uniform { min: 0.0, max: 1.0 };
    let input = Input::stepped("x", law, Steps::Nearest { step: 0.5 });
    let design = SobolDesign::scrambled(vec![input], 64, 1).unwrap();
    // Both have ranks of 16, 32, 16 equal values: any other order among them would not be a straight line.
    let outputs = observe(&design, |x| Some(x[0].powi(5))).unwrap();
    assert_relative_eq!(rank_regression(&design, &outputs).unwrap().r_squared, 1.0, epsilon = 1e-12);
}

#[test]
fn rank_correlation_is_that_of_spearman() {
    let correlation = rank_correlation(&[1.0, 2.0, 3.0, 4.0, 5.0], &[5.0, 6.0, 7.0, 8.0, 7.0]).unwrap();
    // SciPy's spearmanr.
    assert_abs_diff_eq!(correlation, 0.820_782_681_668_123_3, epsilon = 1e-15);
    assert_abs_diff_eq!(
        rank_correlation(&[1.0, 2.0, 9.0], &[3.0, 0.0, -1e9]).unwrap(),
        -1.0,
        epsilon = 1e-15
    );
    assert_eq!(rank_correlation(&[1.0, 1.0, 1.0], &[1.0, 2.0, 3.0]), None);
}

#[test]
fn failures_are_left_out_and_counted() {
    let design = SobolDesign::scrambled(uniform(2, -1.0, 1.0), 256, 1).unwrap();
    // A model that fails where it would not be linear.
    let outputs = observe(&design, |x| (x[0] > -0.5).then_some(x[0] + 2.0 * x[1])).unwrap();
    let found = regression(&design, &outputs).unwrap();
    assert_eq!((found.observed + found.failed, found.failed), (256, 64));
    assert_relative_eq!(found.r_squared, 1.0, epsilon = 1e-12);
}

#[test]
fn collinear_inputs_too_few_outputs_and_a_constant_output_are_errors() {
    let steps = Steps::Nearest { step: 1.0 };
    let law = Law::TruncatedNormal { mean: 0.0, std: 1e-3, min: -1.0, max: 1.0 };
    let inputs = vec![uniform(1, 0.0, 1.0).remove(0), Input::stepped("still", law, steps)];
    let design = SobolDesign::scrambled(inputs, 64, 1).unwrap();
    let outputs = observe(&design, |x| Some(x[0])).unwrap();
    let error = regression(&design, &outputs).unwrap_err();
    assert_eq!(error, SensitivityError::Collinear { input: "still".into() });

    // Two values of each of two inputs, one the opposite of the other on those points that have not failed.
    let law = Law::Uniform { min: -1.0, max: 1.0 };
    let inputs = ["x1", "x2"].map(|name| Input::stepped(name, law, Steps::EqualMass { step: 1.0 })).to_vec();
    let design = SobolDesign::scrambled(inputs, 64, 1).unwrap();
    let outputs = observe(&design, |x| (x[0] == -x[1]).then_some(x[0])).unwrap();
    let error = regression(&design, &outputs).unwrap_err();
    assert_eq!(error, SensitivityError::Collinear { input: "x2".into() });

    let design = SobolDesign::scrambled(uniform(3, 0.0, 1.0), 4, 1).unwrap();
    let error = regression(&design, &[Some(1.0), Some(2.0), Some(3.0), Some(4.0)]).unwrap_err();
    assert!(matches!(error, SensitivityError::OutOfRange { field: "observed outputs", minimum: 5, .. }));
    let design = SobolDesign::scrambled(uniform(1, 0.0, 1.0), 4, 1).unwrap();
    let error = rank_regression(&design, &[Some(3.0); 4]).unwrap_err();
    assert_eq!(error, SensitivityError::ConstantSample { value: 3.0, count: 4 });
    let error = regression(&design, &[Some(3.0), Some(f64::NAN), None, None]).unwrap_err();
    assert!(matches!(error, SensitivityError::NotFinite { field: "outputs", index: 1, .. }));
}
