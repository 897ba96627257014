//! Shapley effects against closed forms.

use super::functions::ishigami;
use crate::common::uniform;
use cdpr_sensitivity::{
    Group, Input, Law, SampleDesign, SensitivityError, ShapleyDesign, ShapleyEffect, observe, shapley_effects,
};

fn normal(k: usize) -> Vec<Input> {
    (1..=k).map(|i| Input::continuous(format!("x{i}"), Law::Normal { mean: 1.0, std: 1.0 })).collect()
}

fn effects(design: &ShapleyDesign, model: impl Fn(&[f64]) -> f64 + Sync) -> Vec<ShapleyEffect> {
    shapley_effects(design, &observe(design, |x| Some(model(x))).unwrap(), 0.95).unwrap()
}

/// Correlation matrix of four inputs, the last of which depends on none.
fn correlation() -> Vec<Vec<f64>> {
    [[1.0, 0.8, -0.3, 0.0], [0.8, 1.0, 0.1, 0.0], [-0.3, 0.1, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
        .map(|row| row.to_vec())
        .to_vec()
}

/// c(u) = var of `E (b x | x_u)` of standard normal inputs: `w_uᵀ C_uu⁻¹ w_u` with `w = C b` (A. B. Owen, C.
/// Prieur, *On Shapley value for measuring importance of dependent inputs*, 2017, section 4).
fn explained(b: &[f64], c: &[Vec<f64>], of: &[usize]) -> f64 {
    let w = |i: usize| (0..b.len()).map(|j| c[i][j] * b[j]).sum::<f64>();
    // Elimination of C_uu, which is positive definite.
    let mut a: Vec<Vec<f64>> =
        of.iter().map(|&i| of.iter().map(|&j| c[i][j]).chain([w(i)]).collect()).collect();
    let mut sum = 0.0;
    for p in 0..of.len() {
        let pivot = a[p].clone();
        sum += pivot[of.len()] * pivot[of.len()] / pivot[p];
        for row in a.iter_mut().skip(p + 1) {
            let factor = row[p] / pivot[p];
            row.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= factor * y);
        }
    }
    sum
}

/// Effects (SH2) over all orders of the groups.
fn exact(b: &[f64], c: &[Vec<f64>], groups: &[Vec<usize>]) -> Vec<f64> {
    let k = groups.len();
    let all = explained(b, c, &(0..b.len()).collect::<Vec<_>>());
    let members = |set: usize| -> Vec<usize> {
        (0..k).filter(|g| set >> g & 1 == 1).flat_map(|g| groups[g].clone()).collect()
    };
    let factorial = |n: usize| (1..=n).product::<usize>() as f64;
    (0..k)
        .map(|g| {
            let without = (0..1_usize << k).filter(|set| set >> g & 1 == 0);
            let part = |set: usize| {
                let size = set.count_ones() as usize;
                let weight = factorial(size) * factorial(k - 1 - size) / factorial(k);
                weight * (explained(b, c, &members(set | 1 << g)) - explained(b, c, &members(set)))
            };
            without.map(part).sum::<f64>() / all
        })
        .collect()
}

#[test]
fn the_closed_form_of_two_inputs_is_that_of_owen_and_prieur() {
    let (b, rho) = ([2.0_f64, -1.0], 0.6);
    let c = vec![vec![1.0, rho], vec![rho, 1.0]];
    let variance = b[0] * b[0] + b[1] * b[1] + 2.0 * rho * b[0] * b[1];
    // Owen and Prieur (2017), theorem 4.
    let first = b[0] * b[0] * (1.0 - 0.5 * rho * rho) + rho * b[0] * b[1] + 0.5 * rho * rho * b[1] * b[1];
    let found = exact(&b, &c, &[vec![0], vec![1]]);
    assert!((found[0] - first / variance).abs() < 1e-14 && (found[0] + found[1] - 1.0).abs() < 1e-14);
}

#[test]
fn effects_of_a_linear_model_of_correlated_normal_inputs_are_those_of_the_closed_form() {
    // x2 has no coefficient, and an effect through x1.
    let b = [2.0, 0.0, 1.0, 1.5];
    let model = |x: &[f64]| x.iter().zip(b).map(|(x, b)| b * x).sum::<f64>();
    for groups in [vec![vec![0], vec![1], vec![2], vec![3]], vec![vec![3, 0], vec![1], vec![2]]] {
        let exact = exact(&b, &correlation(), &groups);
        let named = groups.iter().enumerate().map(|(g, of)| Group::new(format!("g{g}"), of.clone()));
        let design = ShapleyDesign::new(normal(4), 40_000, 1).unwrap().correlated(&correlation()).unwrap();
        let design = design.grouped(named.collect()).unwrap();
        let found = effects(&design, model);
        let sum: f64 = found.iter().map(|of| of.effect.value).sum();
        assert!((sum - 1.0).abs() < 1e-12);
        for (found, exact) in found.iter().zip(&exact) {
            assert!((found.effect.value - exact).abs() < 0.01, "{exact}: {found:?}");
            assert!(found.effect.width() < 0.03);
        }
        assert!(exact[1] > 0.1);
    }
}

#[test]
fn intervals_hold_the_effects_in_93_of_100_studies() {
    let b = [2.0, 0.0, 1.0, 1.5];
    let exact = exact(&b, &correlation(), &[vec![0], vec![1], vec![2], vec![3]]);
    let mut held = [0; 4];
    for seed in 0..400 {
        let design = ShapleyDesign::new(normal(4), 200, seed).unwrap().correlated(&correlation()).unwrap();
        let found = effects(&design, |x| x.iter().zip(b).map(|(x, b)| b * x).sum());
        for ((held, found), exact) in held.iter_mut().zip(found).zip(&exact) {
            *held += usize::from(found.effect.low <= *exact && *exact <= found.effect.high);
        }
    }
    // 93 % of 400.
    assert!(held.iter().all(|held| *held >= 372), "{held:?}");
}

#[test]
fn without_correlation_interactions_are_shared_equally() {
    let function = ishigami();
    let design = ShapleyDesign::new(function.inputs, 40_000, 2).unwrap();
    let found = effects(&design, &function.model);
    let (first, total) = (&function.first, &function.total);
    for i in 0..3 {
        let exact = 0.5 * (first[i] + total[i]);
        assert!((found[i].effect.value - exact).abs() < 0.01, "{exact}: {:?}", found[i]);
    }
}

#[test]
fn every_row_of_a_walk_has_the_joint_law_of_the_inputs() {
    let design = ShapleyDesign::new(normal(4), 20_000, 3).unwrap().correlated(&correlation()).unwrap();
    let mut sums = vec![[[0.0; 4]; 4]; 5];
    let mut row = [0.0; 4];
    for index in 0..design.points() {
        design.row(index, &mut row).unwrap();
        for i in 0..4 {
            for j in 0..4 {
                sums[index % 5][i][j] += (row[i] - 1.0) * (row[j] - 1.0) / 20_000.0;
            }
        }
    }
    let correlation = correlation();
    for (found, expected) in sums.iter().flat_map(|sums| sums.iter().zip(&correlation)) {
        for (found, expected) in found.iter().zip(expected) {
            // Five standard deviations of a variance.
            assert!((found - expected).abs() < 0.05, "{found} {expected}");
        }
    }
}

#[test]
fn failed_runs_are_missed_by_the_inputs_that_change_beside_them() {
    let design = ShapleyDesign::new(uniform(3, 0.0, 1.0), 100, 2).unwrap();
    let mut outputs = observe(&design, |x| Some(x[0] + 2.0 * x[1] - x[2])).unwrap();
    // Between the first and the second change of the first walk, and at an end of the second.
    (outputs[1], outputs[4]) = (None, None);
    let found = shapley_effects(&design, &outputs, 0.95).unwrap();
    let mut walks: Vec<usize> = found.iter().map(|of| of.walks).collect();
    walks.sort_unstable();
    assert_eq!(walks, [98, 98, 99]);
}

#[test]
fn what_no_effect_can_be_found_of_is_refused() {
    let design = ShapleyDesign::new(normal(4), 20, 1).unwrap();
    let constant = shapley_effects(&design, &vec![Some(1.0); design.points()], 0.95).unwrap_err();
    assert!(matches!(constant, SensitivityError::ConstantSample { .. }), "{constant}");
    let few = ShapleyDesign::new(normal(4), 8, 1).unwrap();
    let outputs = observe(&few, |x| Some(x[0])).unwrap();
    assert!(matches!(shapley_effects(&few, &outputs, 0.95), Err(SensitivityError::InvalidInput { .. })));
    let partial = design.clone().grouped(vec![Group::new("p", [0, 1])]).unwrap_err();
    assert!(matches!(partial, SensitivityError::WrongGroup { .. }), "{partial}");
    let mut wrong = correlation();
    wrong[0][1] = 0.7;
    assert!(matches!(design.correlated(&wrong), Err(SensitivityError::NotACorrelation { .. })));
}
