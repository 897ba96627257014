//! The index of Wasserstein and Bures against linear models, whose index is known, and one that moves no
//! mean.

use crate::common::rows;
use approx::assert_abs_diff_eq;
use cdpr_sensitivity::{
    Input, Law, RandomDesign, SensitivityError, SobolDesign, WassersteinBures, wasserstein_bures,
};

/// Columns of rows.
fn columns(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    (0..rows[0].len()).map(|i| rows.iter().map(|row| row[i]).collect()).collect()
}

fn found(rows: &[Vec<f64>], model: impl Fn(&[f64]) -> Vec<f64>) -> Vec<WassersteinBures> {
    let outputs: Vec<Option<Vec<f64>>> = rows.iter().map(|row| Some(model(row))).collect();
    wasserstein_bures(&columns(rows), &outputs, 0.95, 1).unwrap()
}

/// Normal inputs, a uniform one, and one without an effect.
fn inputs() -> Vec<Input> {
    let normal = Law::Normal { mean: 2.0, std: 1.0 };
    let half = 3.0_f64.sqrt();
    let uniform = Law::Uniform { min: -half, max: half };
    let laws = [normal, uniform, normal, normal, normal];
    laws.into_iter().enumerate().map(|(i, law)| Input::continuous(format!("x{i}"), law)).collect()
}

/// Components 3 x0 + 4 x1, 2 x2 and x3, turned in space.
fn linear(x: &[f64]) -> Vec<f64> {
    let y = [3.0 * x[0] + 4.0 * x[1], 2.0 * x[2], x[3]];
    let [one, other] = [0.6, 0.8];
    let turned = [one * y[0] - other * y[1], other * y[0] + one * y[1], y[2]];
    vec![turned[0], one * turned[1] - other * turned[2], other * turned[1] + one * turned[2]]
}

/// Variances are 25, 4 and 1; that of the first component is 16 where x0 is fixed, 9 where x1 is.
const EXACT: [f64; 5] = [1.0 - 25.0 / 30.0, 1.0 - 20.0 / 30.0, 4.0 / 30.0, 1.0 / 30.0, 0.0];
const MEANS: [f64; 5] = [9.0 / 60.0, 16.0 / 60.0, 4.0 / 60.0, 1.0 / 60.0, 0.0];

#[test]
fn a_linear_model_has_the_index_of_its_covariances() {
    let design = RandomDesign::new(inputs(), 1 << 16, 1).unwrap();
    for (i, of) in found(&rows(&design, 1), linear).iter().enumerate() {
        assert_abs_diff_eq!(of.index.value, EXACT[i], epsilon = 4e-3);
        assert_abs_diff_eq!(of.means.value, MEANS[i], epsilon = 4e-3);
    }
}

#[test]
fn intervals_of_independent_rows_hold_the_index_as_often_as_their_level() {
    for points in [128, 512] {
        let mut held = [0; 10];
        for seed in 0..200 {
            let design = RandomDesign::new(inputs(), points, seed).unwrap();
            for (i, of) in found(&rows(&design, 1), linear).iter().enumerate() {
                let holds = |of: cdpr_sensitivity::Estimate, exact: f64| of.low <= exact && exact <= of.high;
                held[i] += u32::from(holds(of.index, EXACT[i]));
                held[5 + i] += u32::from(holds(of.means, MEANS[i]));
            }
        }
        // 190 expected; 177 is four standard deviations below.
        assert!(held.iter().all(|held| *held >= 178), "{points}: {held:?}");
    }
}

#[test]
fn an_input_that_moves_the_spread_alone_has_an_index() {
    let normal = Law::Normal { mean: 0.0, std: 1.0 };
    let inputs = vec![
        Input::continuous("scale", Law::Uniform { min: 0.0, max: 1.0 }),
        Input::continuous("x", normal),
        Input::continuous("y", normal),
    ];
    let design = RandomDesign::new(inputs, 1 << 14, 2).unwrap();
    let found = found(&rows(&design, 1), |x| vec![x[0] * x[1], x[0] * x[2]]);
    // Roots of the variances: x0, of mean 1/2, and 1/√3 of all rows.
    assert_abs_diff_eq!(found[0].index.value, 1.0 - 0.5 * 3.0_f64.sqrt(), epsilon = 0.01);
    assert_abs_diff_eq!(found[0].means.value, 0.0, epsilon = 0.01);
    // x1 moves the mean of the first component and its spread, of mean √(2/π) / √12 beside 1/√3.
    let exact = 0.5 - 0.25 * (2.0 / std::f64::consts::PI).sqrt();
    assert_abs_diff_eq!(found[1].index.value, exact, epsilon = 0.01);
    assert_abs_diff_eq!(found[1].means.value, 3.0 / 16.0, epsilon = 0.01);
}

#[test]
fn an_input_that_decides_the_vector_has_the_index_one_and_failures_are_left_out() {
    let design = RandomDesign::new(inputs(), 400, 3).unwrap();
    let rows = rows(&design, 1);
    let output = |row: &Vec<f64>| (row[3] < 3.5).then(|| vec![row[0], -2.0 * row[0], 0.0]);
    let outputs: Vec<Option<Vec<f64>>> = rows.iter().map(output).collect();
    let found = wasserstein_bures(&columns(&rows), &outputs, 0.95, 1).unwrap();
    assert_abs_diff_eq!(found[0].index.value, 1.0, epsilon = 1e-6);
    assert_abs_diff_eq!(found[0].means.value, 0.5, epsilon = 1e-6);
}

#[test]
fn rows_of_a_sequence_are_refused() {
    let design = SobolDesign::scrambled(inputs(), 1024, 1).unwrap();
    let rows = rows(&design, 1);
    let outputs: Vec<Option<Vec<f64>>> = rows.iter().map(|row| Some(linear(row))).collect();
    let error = wasserstein_bures(&columns(&rows), &outputs, 0.95, 1).unwrap_err();
    assert!(matches!(error, SensitivityError::DependentRows { .. }), "{error}");
}

#[test]
fn a_wrong_table_is_refused() {
    let columns = vec![(0..100).map(f64::from).collect::<Vec<f64>>()];
    let estimate = |outputs: &[Option<Vec<f64>>]| wasserstein_bures(&columns, outputs, 0.95, 1);
    let constant = vec![Some(vec![1.0, 2.0]); 100];
    assert!(matches!(estimate(&constant), Err(SensitivityError::ConstantSample { .. })));
    assert!(matches!(estimate(&constant[..80]), Err(SensitivityError::LengthMismatch { .. })));
    let mut outputs = constant;
    outputs[7] = Some(vec![1.0]);
    assert!(matches!(estimate(&outputs), Err(SensitivityError::LengthMismatch { .. })));
    outputs[7] = Some(vec![1.0, f64::NAN]);
    assert!(matches!(estimate(&outputs), Err(SensitivityError::NotFinite { .. })));
    outputs.iter_mut().skip(63).for_each(|output| *output = None);
    assert!(matches!(estimate(&outputs), Err(SensitivityError::OutOfRange { .. })));
}
