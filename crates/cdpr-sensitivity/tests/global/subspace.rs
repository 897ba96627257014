//! Active subspaces of functions whose directions are known.

use crate::common::uniform;
use cdpr_sensitivity::{
    Bootstrap, Input, Law, RandomDesign, SampleDesign, Slopes, SobolDesign, active_subspace,
};

const BOOTSTRAP: Bootstrap = Bootstrap { resamples: 200, seed: 7 };

fn slopes<D: SampleDesign>(design: &D, at: impl Fn(&[f64]) -> (f64, Vec<f64>)) -> Vec<Option<Slopes>> {
    let mut row = vec![0.0; design.inputs().len()];
    let of_row = |index| {
        design.row(index, &mut row).unwrap();
        let (output, gradient) = at(&row);
        Some(Slopes { output, gradient })
    };
    (0..design.points()).map(of_row).collect()
}

#[test]
fn a_ridge_function_has_one_direction() {
    // exp(0.7 x1 + 0.3 x2): Constantine (2015), section 1.2.
    let design = SobolDesign::scrambled(uniform(2, -1.0, 1.0), 64, 1).unwrap();
    let at = |x: &[f64]| {
        let y = (0.7 * x[0] + 0.3 * x[1]).exp();
        (y, vec![0.7 * y, 0.3 * y])
    };
    let found = active_subspace(&design, &slopes(&design, at), BOOTSTRAP, 0.95).unwrap();
    assert!(found.eigenvalues[1].value.abs() < 1e-15 * found.eigenvalues[0].value);
    let length = 0.7_f64.hypot(0.3);
    assert!((found.directions[0][0] - 0.7 / length).abs() < 1e-12);
    assert!((found.activity[0] - 0.49 / 0.58).abs() < 1e-12);
    assert_eq!(found.needed(0.999, 0.95).unwrap(), [1, 1, 1]);
}

#[test]
fn eigenvalues_of_a_quadratic_form_are_known_and_within_their_intervals() {
    // f = xᵀ A x / 2 of standard normal inputs: C = A². A has the eigenvalues 3, 2, 1 along turned axes.
    let turn = 0.4_f64;
    let axes = [[turn.cos(), turn.sin(), 0.0], [-turn.sin(), turn.cos(), 0.0], [0.0, 0.0, 1.0]];
    let gradient = |x: &[f64]| -> Vec<f64> {
        let along: Vec<f64> = axes.iter().map(|axis| axis.iter().zip(x).map(|(a, x)| a * x).sum()).collect();
        (0..3).map(|i| (0..3).map(|k| (3.0 - k as f64) * along[k] * axes[k][i]).sum()).collect()
    };
    let inputs: Vec<Input> =
        (1..=3).map(|i| Input::continuous(format!("x{i}"), Law::Normal { mean: 0.0, std: 1.0 })).collect();
    let mut held = 0;
    for seed in 0..100 {
        let design = RandomDesign::new(inputs.clone(), 400, seed).unwrap();
        let at = |x: &[f64]| {
            let g = gradient(x);
            (0.5 * g.iter().zip(x).map(|(g, x)| g * x).sum::<f64>(), g)
        };
        let found = active_subspace(&design, &slopes(&design, at), BOOTSTRAP, 0.95).unwrap();
        for (eigenvalue, exact) in found.eigenvalues.iter().zip([9.0, 4.0, 1.0]) {
            assert!((eigenvalue.value / exact - 1.0).abs() < 0.5);
            held += usize::from(eigenvalue.low <= exact && exact <= eigenvalue.high);
        }
        let along: f64 = found.directions[0].iter().zip(axes[0]).map(|(w, a)| w * a).sum();
        assert!(along.abs() > 0.95, "{seed}: {along}");
        assert_eq!(found.needed(0.5, 0.95).unwrap()[0], 1);
        assert!((found.activity.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
    // Quantiles of a bootstrap hold a little less than their level of 95 %.
    assert!(held >= 273, "{held} of 300");
}

#[test]
fn directions_are_of_inputs_in_standard_deviations() {
    // 2 x1 + x2, where x2 has a range four times as wide.
    let mut inputs = uniform(2, -1.0, 1.0);
    inputs[1].law = Law::Uniform { min: -4.0, max: 4.0 };
    let design = SobolDesign::scrambled(inputs, 32, 1).unwrap();
    let at = |x: &[f64]| (2.0 * x[0] + x[1], vec![2.0, 1.0]);
    let found = active_subspace(&design, &slopes(&design, at), BOOTSTRAP, 0.95).unwrap();
    assert!((found.eigenvalues[0].value - 20.0 / 3.0).abs() < 1e-12);
    assert!((found.directions[0][1] - 4.0 / 20.0_f64.sqrt()).abs() < 1e-12);
}
