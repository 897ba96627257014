//! Expansions of values and derivatives together.

use crate::common::{rows, uniform, unit};
use approx::assert_abs_diff_eq;
use cdpr_sensitivity::{
    Expansion, Input, Law, SensitivityError, Slopes, SobolDesign, Steps, Truncation, expansion,
    gradient_expansion,
};

const FULL: Truncation = Truncation { max_degree: 4, norm: 1.0, interactions: 3 };

/// Output and gradient of a model.
type Model = fn(&[f64]) -> (f64, Vec<f64>);

fn slopes(design: &SobolDesign, model: Model) -> Vec<Option<Slopes>> {
    let of_row = |row: Vec<f64>| {
        let (output, gradient) = model(&row);
        Some(Slopes { output, gradient })
    };
    rows(design, 1).into_iter().map(of_row).collect()
}

fn fit(inputs: Vec<Input>, points: usize, model: Model) -> [Expansion; 2] {
    let design = SobolDesign::scrambled(inputs, points, 1).unwrap();
    let slopes = slopes(&design, model);
    let outputs: Vec<Option<f64>> = slopes.iter().map(|of| Some(of.as_ref()?.output)).collect();
    [gradient_expansion(&design, &slopes, FULL).unwrap(), expansion(&design, &outputs, FULL).unwrap()]
}

/// x1 x2 + x3³ + x1² x2². There are 34 products up to its degree.
fn polynomial(x: &[f64]) -> (f64, Vec<f64>) {
    let output = x[0] * x[1] + x[2].powi(3) + (x[0] * x[1]).powi(2);
    let of_first = x[1] + 2.0 * x[0] * x[1] * x[1];
    (output, vec![of_first, x[0] + 2.0 * x[0] * x[0] * x[1], 3.0 * x[2] * x[2]])
}

#[test]
fn a_polynomial_is_found_from_fewer_points_than_terms() {
    // Skewed laws need a few points more; the tail of a lognormal law with a deviation of 0.5 takes more than
    // 96.
    let laws = [
        (Law::Uniform { min: -1.0, max: 2.0 }, 24),
        (Law::Normal { mean: 1.0, std: 0.5 }, 24),
        (Law::Beta { alpha: 2.0, beta: 3.0, min: 0.0, max: 2.0 }, 24),
        (Law::TruncatedNormal { mean: 0.0, std: 1.0, min: -1.0, max: 2.0 }, 24),
        (Law::LogNormal { log_mean: 0.0, log_std: 0.25 }, 32),
        (Law::Gumbel { location: 0.0, scale: 1.0 }, 32),
    ];
    for (law, points) in laws {
        let inputs: Vec<Input> = (0..3).map(|i| Input::continuous(format!("x{i}"), law)).collect();
        let [found, plain] = fit(inputs, points, polynomial);
        assert!(found.derivatives && !plain.derivatives, "{law:?}");
        assert!(found.leave_one_out < 1e-18 && plain.leave_one_out > 1e-6, "{law:?} {}", found.leave_one_out);
        for x in [[0.3, 1.2, 0.7], [1.5, 0.2, 1.9]] {
            assert_abs_diff_eq!(found.predict(&x).unwrap(), polynomial(&x).0, epsilon = 1e-7);
        }
    }
}

/// OTL-like: smooth, and no polynomial.
fn smooth(x: &[f64]) -> (f64, Vec<f64>) {
    let output = (x[0] + 0.5 * x[1]).exp() / (1.0 + 0.2 * x[2]);
    (output, vec![output, 0.5 * output, -0.2 * output / (1.0 + 0.2 * x[2])])
}

#[test]
fn derivatives_bring_the_indices_of_a_smooth_model_nearer() {
    let [_, exact] = fit(unit(3), 4096, smooth);
    let [found, plain] = fit(unit(3), 16, smooth);
    let error = |of: &Expansion| {
        let pairs = of.indices().into_iter().zip(exact.indices());
        pairs.map(|(one, other)| (one.total - other.total).abs()).fold(0.0, f64::max)
    };
    assert!(found.derivatives && 4.0 * error(&found) < error(&plain), "{} {}", error(&found), error(&plain));
}

#[test]
fn derivatives_of_a_step_are_left_out() {
    // They are zero wherever there is a derivative.
    let step: Model = |x| (f64::from(u8::from(x[0] + 0.3 * x[1] > 0.2)), vec![0.0; 2]);
    let [found, plain] = fit(uniform(2, -1.0, 1.0), 128, step);
    assert!(!found.derivatives);
    assert_eq!(found, plain);
}

#[test]
fn steps_and_failures() {
    let law = Law::Uniform { min: -1.0, max: 1.0 };
    let input = |name: &str| Input::stepped(name, law, Steps::Nearest { step: 0.25 });
    let model: Model = |x| (x[0] * x[1] + x[0].powi(3), vec![x[1] + 3.0 * x[0] * x[0], x[0]]);
    let design = SobolDesign::scrambled(vec![input("x1"), input("x2")], 32, 1).unwrap();
    let mut given = slopes(&design, model);
    given[3] = None;
    let found = gradient_expansion(&design, &given, FULL).unwrap();
    assert_eq!((found.observed, found.failed), (31, 1));
    assert_abs_diff_eq!(found.predict(&[0.5, -0.75]).unwrap(), model(&[0.5, -0.75]).0, epsilon = 1e-9);
    given[4].as_mut().unwrap().gradient.pop();
    let error = gradient_expansion(&design, &given, FULL).unwrap_err();
    assert!(matches!(error, SensitivityError::LengthMismatch { .. }), "{error}");
}
