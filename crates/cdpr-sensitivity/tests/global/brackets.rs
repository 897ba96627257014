//! Bounds of Sobol' indices by derivatives hold the indices that are known.

use crate::global::functions::{self, Function};
use cdpr_sensitivity::{
    Bootstrap, Bracket, IndependentSample, Input, Law, Order, RandomDesign, SaltelliDesign, SampleDesign,
    SensitivityError, Slopes, SobolDesign, Steps, brackets, dgsm, sobol_indices,
};

/// Outputs with central differences.
fn slopes<D: IndependentSample>(design: &D, model: &(impl Fn(&[f64]) -> f64 + Sync)) -> Vec<Option<Slopes>> {
    let at = |index: usize| {
        let mut row = vec![0.0; design.inputs().len()];
        design.row(index, &mut row).unwrap();
        let gradient = (0..row.len())
            .map(|i| {
                let x = row[i];
                let h = 1e-6 * design.inputs()[i].law.std();
                row[i] = x + h;
                let above = model(&row);
                row[i] = x - h;
                let below = model(&row);
                row[i] = x;
                (above - below) / (2.0 * h)
            })
            .collect();
        Some(Slopes { output: model(&row), gradient })
    };
    (0..design.points()).map(at).collect()
}

fn of_function(function: &Function, points: usize, seed: u64) -> Vec<Bracket> {
    let design = SobolDesign::scrambled(function.inputs.clone(), points, seed).unwrap();
    brackets(&design, &slopes(&design, &function.model), 0.95, seed).unwrap()
}

#[test]
fn bounds_hold_the_indices_of_functions_and_those_of_a_linear_one_are_narrow() {
    for function in functions::all() {
        let found = of_function(&function, 1024, 1);
        for (i, bracket) in found.iter().enumerate() {
            let (first, total) = (function.first[i], function.total[i]);
            let name = format!("{} {}: {bracket:?} {first} {total}", function.name, bracket.input);
            assert!(bracket.first_lower.low <= first, "{name}");
            assert!(bracket.total_lower.low <= total && total <= bracket.total_upper.high, "{name}");
            assert!(bracket.total_lower.value <= bracket.total_upper.value + 1e-9, "{name}");
        }
    }
    // ν is 1.216 times the share: the eigenfunctions beyond the first take most of the rest away.
    for (bracket, share) in of_function(&functions::linear(), 64, 1).iter().zip(functions::linear().total) {
        assert!(bracket.total_lower.value > 0.999 * share - 1e-9, "{bracket:?} {share}");
        assert!(bracket.total_upper.value < share + 0.002, "{bracket:?} {share}");
    }
}

#[test]
fn intervals_hold_the_bounds_for_independent_rows() {
    // 200 studies of few rows: the index lies between the outer ends almost always.
    let function = functions::ishigami();
    let mut outside = 0;
    for seed in 0..200 {
        let design = RandomDesign::new(function.inputs.clone(), 100, seed).unwrap();
        let found = brackets(&design, &slopes(&design, &function.model), 0.95, seed).unwrap();
        for (bracket, total) in found.iter().zip(&function.total) {
            outside += usize::from(bracket.total_lower.low > *total || bracket.total_upper.high < *total);
        }
    }
    // 600 brackets; each end is outside in 2.5 % at most where the bound is exact.
    assert!(outside < 40, "{outside} of 600");
}

#[test]
fn upper_bounds_hold_indices_however_small_and_squares_however_rare() {
    // The last inputs of Bratley's function have T = 7.6e-5, which few rows decide; the tolerance is far
    // below it.
    const STUDIES: usize = 100;
    for (function, rows) in
        [(functions::bratley(), 64), (functions::bratley(), 200), (functions::with_a_small_part(), 64)]
    {
        let mut below = vec![[0; 2]; function.inputs.len()];
        for seed in 0..STUDIES as u64 {
            let random = RandomDesign::new(function.inputs.clone(), rows, seed).unwrap();
            let found = [
                brackets(&random, &slopes(&random, &function.model), 0.95, seed).unwrap(),
                of_function(&function, rows, seed),
            ];
            for (kind, found) in found.iter().enumerate() {
                for (i, (bracket, total)) in found.iter().zip(&function.total).enumerate() {
                    below[i][kind] += usize::from(bracket.total_upper.high < total * (1.0 - 1e-6));
                }
            }
        }
        // 2.5 expected at most; 8 is three standard deviations above.
        assert!(below.iter().flatten().all(|&below| below <= 8), "{} {rows}: {below:?}", function.name);
    }
}

#[test]
fn bounds_at_the_level_of_each_input_hold_all_inputs_of_a_study_together() {
    // The verdict of a study takes 1 - 0.05 / inputs for each input (Bonferroni).
    const STUDIES: u64 = 200;
    for function in functions::all().into_iter().chain([functions::with_a_small_part()]) {
        let level = 1.0 - 0.05 / function.inputs.len() as f64;
        let mut wrong = [0; 2];
        for seed in 0..STUDIES {
            let random = RandomDesign::new(function.inputs.clone(), 64, seed).unwrap();
            let scrambled = SobolDesign::scrambled(function.inputs.clone(), 64, seed).unwrap();
            let found = [
                brackets(&random, &slopes(&random, &function.model), level, seed).unwrap(),
                brackets(&scrambled, &slopes(&scrambled, &function.model), level, seed).unwrap(),
            ];
            for (wrong, found) in wrong.iter_mut().zip(&found) {
                let is_outside = |(bracket, total): (&Bracket, &f64)| {
                    bracket.total_lower.low > total * (1.0 + 1e-6)
                        || bracket.total_upper.high < total * (1.0 - 1e-6)
                };
                *wrong += usize::from(found.iter().zip(&function.total).any(is_outside));
            }
        }
        // 10 expected at most; 19 is three standard deviations above.
        assert!(wrong.iter().all(|&wrong| wrong <= 19), "{}: {wrong:?}", function.name);
    }
}

#[test]
fn the_bound_of_each_input_holds_where_it_is_called_reliable() {
    let function = functions::bratley();
    let (mut wrong, mut reliable) = (vec![0; 10], vec![0; 10]);
    for seed in 0..200 {
        let design = RandomDesign::new(function.inputs.clone(), 128, seed).unwrap();
        let found = dgsm(&design, &slopes(&design, &function.model), 0.95).unwrap();
        for (i, (measure, total)) in found.inputs.iter().zip(&function.total).enumerate() {
            let bound = measure.total_bound.unwrap();
            assert!(bound.low <= bound.value && bound.value <= bound.high, "{measure:?}");
            reliable[i] += usize::from(measure.reliable);
            wrong[i] += usize::from(measure.reliable && bound.high < *total);
        }
    }
    // 5 expected at most; 11 is three standard deviations above. Squares that are rare are not called
    // reliable.
    assert!(wrong.iter().all(|&wrong| wrong <= 11), "{wrong:?}");
    assert!(reliable[0] == 200 && reliable[9] <= 2, "{reliable:?}");
}

#[test]
fn every_law_has_bounds() {
    let laws = [
        Law::Normal { mean: 1.0, std: 2.0 },
        Law::Triangular { min: 0.0, mode: 1.0, max: 3.0 },
        Law::LogNormal { log_mean: 0.0, log_std: 0.5 },
        Law::Beta { alpha: 2.0, beta: 5.0, min: -1.0, max: 1.0 },
    ];
    let inputs: Vec<Input> =
        laws.iter().enumerate().map(|(i, law)| Input::continuous(format!("x{i}"), *law)).collect();
    let design = SobolDesign::scrambled(inputs.clone(), 512, 3).unwrap();
    let weights = [1.0, -2.0, 3.0, 0.5];
    let linear = |x: &[f64]| x.iter().zip(weights).map(|(x, w)| w * x).sum::<f64>();
    let found = brackets(&design, &slopes(&design, &linear), 0.95, 1).unwrap();
    let parts: Vec<f64> = laws.iter().zip(weights).map(|(law, w)| (w * law.std()).powi(2)).collect();
    let variance: f64 = parts.iter().sum();
    for (bracket, part) in found.iter().zip(parts) {
        let share = part / variance;
        // The lower bounds of all others leave no more to an input than its share.
        assert!((bracket.total_lower.value - share).abs() < 1e-6, "{bracket:?} {share}");
        assert!((bracket.total_upper.value - share).abs() < 1e-6, "{bracket:?} {share}");
    }
    // A product: no input acts alone.
    let product = |x: &[f64]| (x[0] - laws[0].mean()) * (x[2] - laws[2].mean());
    for bracket in &brackets(&design, &slopes(&design, &product), 0.95, 1).unwrap()[..3] {
        assert!(bracket.first_lower.value < 0.05, "{bracket:?}");
        let total = if bracket.input == "x1" { 0.0 } else { 1.0 };
        assert!(bracket.total_lower.low <= total && total <= bracket.total_upper.high + 1e-9, "{bracket:?}");
        assert!(bracket.input == "x1" || bracket.total_lower.value > 0.8, "{bracket:?}");
    }
}

#[test]
fn few_rows_and_constant_outputs_are_refused() {
    let design = RandomDesign::new(functions::linear().inputs, 39, 1).unwrap();
    let found = brackets(&design, &slopes(&design, &functions::linear().model), 0.95, 1);
    assert!(found.unwrap_err().to_string().contains("expected at least 40"));
    let design = RandomDesign::new(functions::linear().inputs, 50, 1).unwrap();
    assert!(brackets(&design, &slopes(&design, &|_: &[f64]| 1.0), 0.95, 1).is_err());
}

/// Where the bounds would not hold they are refused: failed rows, an output that jumps, coarse steps.
#[test]
fn bounds_that_do_not_hold_are_refused() {
    let inputs = || {
        let law = Law::Uniform { min: -1.0, max: 1.0 };
        vec![Input::continuous("a", law), Input::continuous("b", law)]
    };
    let design = SobolDesign::scrambled(inputs(), 256, 1).unwrap();
    let mut failing = slopes(&design, &|x: &[f64]| x[0] + 0.1 * x[1]);
    failing[7] = None;
    let found = brackets(&design, &failing, 0.95, 1);
    assert_eq!(found, Err(SensitivityError::Failed { failed: 1, count: 256 }));
    let jumping = slopes(&design, &|x: &[f64]| if x[0] > 0.3 { 1.0 } else { 0.0 } + 1e-3 * x[1]);
    let found = brackets(&design, &jumping, 0.95, 1);
    assert!(matches!(found, Err(SensitivityError::Jumps { sum }) if sum < 0.01), "{found:?}");
    let stepped = |step: f64| {
        let law = Law::Uniform { min: -1.5, max: 1.5 };
        let coarse = Input::stepped("a", law, Steps::Nearest { step });
        let design = SobolDesign::scrambled(vec![coarse, Input::continuous("b", law)], 256, 1).unwrap();
        brackets(&design, &slopes(&design, &|x: &[f64]| x[0] + x[1]), 0.95, 1)
    };
    assert_eq!(stepped(1.5), Err(SensitivityError::Stepped { input: "a".to_owned() }));
    // Short steps count as a wider law: 3 levels in 0.1 are 31, of 1.0022 times the variance.
    let fine = stepped(0.1).unwrap();
    let levels = Input::stepped("a", Law::Uniform { min: -1.5, max: 1.5 }, Steps::Nearest { step: 0.1 });
    let share = levels.std().powi(2) / (levels.std().powi(2) + 0.75);
    assert!((share - 0.5).abs() > 5e-4, "{share}");
    assert!(fine[0].total_lower.low <= share && share <= fine[0].total_upper.high, "{fine:?} {share}");
}

#[test]
fn steps_count_in_the_moments_of_an_input() {
    let law = Law::Uniform { min: -1.5, max: 1.5 };
    let of = |steps| Input::stepped("a", law, steps);
    // -1.5, 0 and 1.5 with 1/4, 1/2, 1/4, and with 1/3 each.
    assert!((of(Steps::Nearest { step: 1.5 }).std().powi(2) - 1.125).abs() < 1e-12);
    assert!((of(Steps::EqualMass { step: 1.5 }).std().powi(2) - 1.5).abs() < 1e-12);
    assert_eq!(
        (Input::continuous("a", law).std(), of(Steps::Nearest { step: 1.5 }).mean()),
        (law.std(), 0.0)
    );
}

/// Rows fail where `a` is negative: the others are half as wide in `a`, and its index is that of these.
#[test]
fn indices_of_rows_that_do_not_fail_are_those_of_their_laws() {
    let law = Law::Uniform { min: -1.0, max: 1.0 };
    let inputs = vec![Input::continuous("a", law), Input::continuous("b", law)];
    let design = SaltelliDesign::scrambled(inputs, 1024, Order::First, 3).unwrap();
    let mut row = [0.0; 2];
    let outputs: Vec<Option<f64>> = (0..design.points())
        .map(|index| {
            design.row(index, &mut row).unwrap();
            (row[0] > 0.0).then(|| row[0] + row[1])
        })
        .collect();
    let bootstrap = Bootstrap { resamples: 200, seed: 1 };
    let found = sobol_indices(&design, &outputs, bootstrap, 0.95).unwrap().inputs;
    // Variances 1/12 and 1/3.
    assert!((found[0].total.value - 0.2).abs() < 0.03, "{:?}", found[0].total);
    assert!((found[1].total.value - 0.8).abs() < 0.05, "{:?}", found[1].total);
}
