//! Derivative-based measures: exact values, and bounds that hold.

use crate::common::rows;
use std::f64::consts::PI;

use super::functions;
use approx::assert_relative_eq;
use cdpr_sensitivity::{Input, Law, SensitivityError, Slopes, SobolDesign, dgsm, poincare_constant};

fn slopes(design: &SobolDesign, model: impl Fn(&[f64]) -> (f64, Vec<f64>)) -> Vec<Option<Slopes>> {
    let slopes = |(output, gradient)| Some(Slopes { output, gradient });
    rows(design, 1).iter().map(|row| slopes(model(row))).collect()
}

fn ishigami(x: &[f64]) -> (f64, Vec<f64>) {
    let (s, c, p) = (x[0].sin(), x[0].cos(), 0.1 * x[2].powi(4));
    let y = s + 7.0 * x[1].sin().powi(2) + p * s;
    (y, vec![c * (1.0 + p), 7.0 * (2.0 * x[1]).sin(), 0.4 * x[2].powi(3) * s])
}

#[test]
fn measures_of_ishigamis_function_are_exact_and_bound_its_total_indices() {
    let function = functions::ishigami();
    let design = SobolDesign::scrambled(function.inputs, 8192, 1).unwrap();
    let found = dgsm(&design, &slopes(&design, ishigami), 0.95).unwrap();
    // E (1 + x⁴/10)² / 2, 49/2, E 0.16 x⁶ / 2.
    let exact =
        [0.5 * (1.0 + 0.2 * PI.powi(4) / 5.0 + 0.01 * PI.powi(8) / 9.0), 24.5, 0.08 * PI.powi(6) / 7.0];
    for ((measure, exact), total) in found.inputs.iter().zip(exact).zip(&function.total) {
        let interval = measure.mean_square;
        assert!(interval.low <= exact && exact <= interval.high, "{measure:?} {exact}");
        assert_relative_eq!(interval.value, exact, max_relative = 0.01);
        let bound = measure.total_bound.unwrap().value;
        assert_relative_eq!(bound, 4.0 * exact / found.variance, max_relative = 0.01);
        assert!(bound > *total);
    }
}

#[test]
fn the_bound_of_a_linear_model_of_normal_inputs_is_the_index_itself() {
    let normal = |name: &str, std| Input::continuous(name, Law::Normal { mean: 1.0, std });
    let design = SobolDesign::scrambled(vec![normal("a", 0.5), normal("b", 2.0)], 4096, 3).unwrap();
    let found = dgsm(&design, &slopes(&design, |x| (3.0 * x[0] + x[1], vec![3.0, 1.0])), 0.9).unwrap();
    for (measure, exact) in found.inputs.iter().zip([2.25 / 6.25, 4.0 / 6.25]) {
        assert_relative_eq!(measure.total_bound.unwrap().value, exact, max_relative = 0.01);
    }
}

#[test]
fn constants_are_those_of_the_literature_and_bound_the_variance_of_the_identity() {
    let range = (3.0 / PI) * (3.0 / PI);
    let (min, max) = (-1.0, 2.0);
    let cases = [
        (Law::Uniform { min, max }, Some(range)),
        (Law::Normal { mean: 0.0, std: 0.7 }, Some(0.49)),
        // E. Bobkov: 4 scale², exact for Laplace's law.
        (Law::Laplace { location: 1.0, scale: 0.5 }, Some(1.0)),
        (Law::LogNormal { log_mean: 0.0, log_std: 1.0 }, None),
        (Law::Logistic { location: 0.0, scale: 0.5 }, Some(1.0)),
        (Law::Gumbel { location: 0.0, scale: 0.5 }, Some(1.0)),
        (Law::Weibull { shape: 0.9, scale: 1.0 }, None),
    ];
    for (law, exact) in cases {
        let constant = poincare_constant(&law);
        assert_eq!(constant.is_some(), exact.is_some(), "{law:?}");
        if let (Some(constant), Some(exact)) = (constant, exact) {
            assert_relative_eq!(constant, exact, max_relative = 1e-12);
        }
    }
    let by_elements = [
        (Law::TruncatedNormal { mean: 0.0, std: 1.0, min: -40.0, max: 50.0 }, 1.0),
        (Law::TruncatedNormal { mean: 0.0, std: 7e4, min, max }, range),
        (Law::Beta { alpha: 1.0, beta: 1.0, min, max }, range),
        // The eigenfunctions are J0(√λ y) on both sides, 1 - (2 / 3 x²) of Laguerre, exponential tails.
        (Law::Triangular { min: -1.0, mode: 0.0, max: 1.0 }, 2.404_825_557_695_773_f64.powi(-2)),
        (Law::Weibull { shape: 2.0, scale: 3.0 }, 9.0 / 4.0),
    ];
    for (law, exact) in by_elements {
        assert_relative_eq!(poincare_constant(&law).unwrap(), exact, max_relative = 3e-6);
    }
    let exponential = poincare_constant(&Law::Weibull { shape: 1.0, scale: 1.0 }).unwrap();
    assert_relative_eq!(exponential, 4.0, max_relative = 1e-3);
    let others = [
        Law::Beta { alpha: 0.5, beta: 2.0, min, max },
        Law::Triangular { min, mode: 0.0, max },
        Law::Beta { alpha: 2.0, beta: 5.0, min, max },
        Law::Weibull { shape: 2.0, scale: 1.0 },
        Law::Logistic { location: 0.0, scale: 1.0 },
        Law::Gumbel { location: 0.0, scale: 1.0 },
    ];
    for law in others {
        // g = x in Poincaré's inequality.
        assert!(poincare_constant(&law).unwrap() >= law.std() * law.std(), "{law:?}");
    }
}

#[test]
fn failures_are_counted_and_what_is_wrong_is_an_error() {
    let function = functions::ishigami();
    let design = SobolDesign::scrambled(function.inputs, 64, 1).unwrap();
    let good = slopes(&design, ishigami);
    let mut holed = good.clone();
    (holed[3], holed[9]) = (None, None);
    let found = dgsm(&design, &holed, 0.95).unwrap();
    assert_eq!((found.observed, found.failed), (62, 2));

    let changed = |change: &dyn Fn(&mut Slopes)| {
        let mut slopes = good.clone();
        slopes[5].iter_mut().for_each(change);
        dgsm(&design, &slopes, 0.95).unwrap_err()
    };
    let not_finite = changed(&|slopes| slopes.gradient[1] = f64::INFINITY);
    assert!(matches!(not_finite, SensitivityError::NotFinite { field: "gradient", index: 5, .. }));
    let not_finite = changed(&|slopes| slopes.output = f64::NAN);
    assert!(matches!(not_finite, SensitivityError::NotFinite { field: "outputs", index: 5, .. }));
    let short = changed(&|slopes| slopes.gradient.truncate(2));
    assert!(matches!(short, SensitivityError::LengthMismatch { field: "gradient", value: 2, expected: 3 }));
    let constant = dgsm(&design, &slopes(&design, |_| (1.0, vec![0.0; 3])), 0.95).unwrap_err();
    assert_eq!(constant, SensitivityError::ConstantSample { value: 1.0, count: 64 });
    let few = dgsm(&design, &[vec![None; 63], good[..1].to_vec()].concat(), 0.95).unwrap_err();
    assert!(matches!(few, SensitivityError::OutOfRange { field: "observed outputs", value: 1, .. }));
}
