//! Latin hypercubes, Halton's sequence and correlated designs.

use crate::common::{rows, unit};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use cdpr_sensitivity::{
    Correlated, Halton, Input, LatinHypercube, Law, RandomDesign, SampleDesign, SensitivityError,
    SobolDesign, Steps,
};

fn column(rows: &[Vec<f64>], input: usize) -> Vec<f64> {
    rows.iter().map(|row| row[input]).collect()
}

fn correlation(x: &[f64], y: &[f64]) -> f64 {
    let n = x.len() as f64;
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let sum = |f: &dyn Fn(f64, f64) -> f64| x.iter().zip(y).map(|(x, y)| f(x - mx, y - my)).sum::<f64>();
    sum(&|x, y| x * y) / (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt()
}

#[test]
fn each_cell_of_a_latin_hypercube_holds_one_value() {
    for points in [1, 7, 100] {
        let random = LatinHypercube::new(unit(3), points, 5).unwrap();
        let centred = LatinHypercube::centred(unit(3), points, 5).unwrap();
        for design in [&random, &centred] {
            let rows = rows(design, 1);
            for input in 0..3 {
                let mut cells: Vec<usize> =
                    column(&rows, input).iter().map(|u| (u * points as f64) as usize).collect();
                cells.sort_unstable();
                assert_eq!(cells, (0..points).collect::<Vec<_>>());
            }
        }
        let middle = |row: &Vec<f64>| row.iter().all(|u| ((u * points as f64).fract() - 0.5).abs() < 1e-10);
        assert!(rows(&centred, 1).iter().all(middle));
    }
}

#[test]
fn columns_of_a_latin_hypercube_are_not_correlated() {
    let rows = rows(&LatinHypercube::new(unit(4), 4000, 9).unwrap(), 2);
    for i in 0..4 {
        for j in 0..i {
            // Deviation 1 / √4000 = 0.016.
            assert!(correlation(&column(&rows, i), &column(&rows, j)).abs() < 0.064);
        }
    }
}

#[test]
fn haltons_points_are_the_mirrored_digits_of_their_index() {
    let rows = rows(&Halton::new(unit(3), 1, 8).unwrap(), 1);
    let base2 = [0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875, 0.0625];
    let base3 = [3.0, 6.0, 1.0, 4.0, 7.0, 2.0, 5.0, 8.0].map(|ninths| ninths / 9.0);
    assert_eq!(column(&rows, 0), base2);
    column(&rows, 1).iter().zip(base3).for_each(|(u, exact)| assert_relative_eq!(*u, exact, epsilon = 1e-15));
    assert_relative_eq!(rows[5][2], 1.0 / 5.0 + 1.0 / 25.0, epsilon = 1e-15);
}

#[test]
fn scrambled_haltons_points_are_balanced_in_each_base_and_break_the_lines_of_large_ones() {
    let design = Halton::scrambled(unit(62), 1024, 3).unwrap();
    let rows = rows(&design, 2);
    for (input, base) in [(0, 2), (1, 3), (2, 5), (3, 7)] {
        let cells = base * base;
        let whole = 1024 / cells * cells;
        let mut counts = vec![0; cells];
        for u in &column(&rows, input)[..whole] {
            counts[(u * cells as f64) as usize] += 1;
        }
        assert!(counts.iter().all(|&count| count == whole / cells), "{base}: {counts:?}");
    }
    assert!(rows.iter().flatten().all(|u| *u > 0.0 && *u < 1.0));
    // Bases 283 and 293, the first 256 points: a line in the plain sequence.
    let of = |rows: &[Vec<f64>]| correlation(&column(&rows[..256], 60), &column(&rows[..256], 61));
    let plain = self::rows(&Halton::new(unit(62), 1, 256).unwrap(), 2);
    assert!(of(&plain) > 0.99 && of(&rows).abs() < 0.5, "{} {}", of(&plain), of(&rows));
}

#[test]
fn scrambled_points_are_uniform_over_seeds() {
    // The mean over seeds of u and u² of one point: 1/2 and 1/3, of deviations 0.0046 and 0.0047.
    let seeds = 4000;
    for (index, input) in [(0, 0), (5, 20), (1000, 61)] {
        let (mut first, mut second) = (0.0, 0.0);
        for seed in 0..seeds {
            let mut row = [0.0; 62];
            Halton::scrambled(unit(62), 1001, seed).unwrap().row(index, &mut row).unwrap();
            first += row[input] / seeds as f64;
            second += row[input] * row[input] / seeds as f64;
        }
        assert!((first - 0.5).abs() < 0.019 && (second - 1.0 / 3.0).abs() < 0.019, "{first} {second}");
    }
}

#[test]
fn correlated_normal_inputs_have_their_laws_and_the_correlations_asked_for() {
    let law = |mean, std| Law::Normal { mean, std };
    let inputs = vec![
        Input::continuous("a", law(1.0, 2.0)),
        Input::continuous("b", law(0.0, 1.0)),
        Input::continuous("c", Law::Uniform { min: -1.0, max: 1.0 }),
    ];
    let matrix = [vec![1.0, 0.9, -0.3], vec![0.9, 1.0, 0.0], vec![-0.3, 0.0, 1.0]];
    let design = Correlated::new(SobolDesign::scrambled(inputs, 4096, 1).unwrap(), &matrix).unwrap();
    let rows = rows(&design, 2);
    let columns = [column(&rows, 0), column(&rows, 1), column(&rows, 2)];
    for (column, (mean, std)) in columns.iter().zip([(1.0, 2.0), (0.0, 1.0), (0.0, 3.0_f64.sqrt().recip())]) {
        let summary = cdpr_sensitivity::Sample::of_values(column).unwrap().summary();
        assert_abs_diff_eq!(summary.mean, mean, epsilon = 0.01);
        assert_relative_eq!(summary.std, std, max_relative = 0.01);
    }
    assert_abs_diff_eq!(correlation(&columns[0], &columns[1]), 0.9, epsilon = 0.005);
    assert_abs_diff_eq!(correlation(&columns[1], &columns[2]), 0.0, epsilon = 0.01);
    // Of a normal and a uniform variable: √(3/π) of that of the scores.
    let mixed = (3.0 / std::f64::consts::PI).sqrt() * -0.3;
    assert_abs_diff_eq!(correlation(&columns[0], &columns[2]), mixed, epsilon = 0.01);
}

#[test]
fn correlated_steps_keep_their_levels_and_weights() {
    let law = Law::Uniform { min: 0.0, max: 4.0 };
    let steps = Steps::EqualMass { step: 1.0 };
    let inputs = ["a", "b"].map(|name| Input::stepped(name, law, steps)).to_vec();
    let sobol = SobolDesign::scrambled(inputs, 2000, 1).unwrap();
    let design = Correlated::new(sobol, &[vec![1.0, 0.7], vec![0.7, 1.0]]).unwrap();
    let rows = rows(&design, 2);
    for input in 0..2 {
        for level in 0..5 {
            let count = rows.iter().filter(|row| row[input] == f64::from(level)).count();
            assert!((380..=420).contains(&count), "{count}");
        }
    }
    assert!(correlation(&column(&rows, 0), &column(&rows, 1)) > 0.6);
}

#[test]
fn correlations_of_zero_change_nothing() {
    let sobol = SobolDesign::scrambled(unit(2), 64, 1).unwrap();
    let design = Correlated::new(sobol.clone(), &[vec![1.0, 0.0], vec![0.0, 1.0]]).unwrap();
    for (one, other) in rows(&sobol, 1).iter().flatten().zip(rows(&design, 1).iter().flatten()) {
        assert_abs_diff_eq!(one, other, epsilon = 1e-9);
    }
}

#[test]
fn a_matrix_that_is_not_a_correlation_matrix_is_an_error() {
    let error =
        |matrix: &[Vec<f64>]| Correlated::new(RandomDesign::new(unit(2), 8, 1).unwrap(), matrix).unwrap_err();
    let index = |error| match error {
        SensitivityError::NotACorrelation { row, column, expected, .. } => (row, column, expected),
        _ => (9, 9, "another error"),
    };
    let of = |a: f64, b: f64, c: f64, d: f64| index(error(&[vec![a, b], vec![c, d]]));
    assert_eq!(of(1.0, 0.5, 0.4, 1.0), (1, 0, "a finite symmetric matrix"));
    assert_eq!(of(1.0, f64::NAN, f64::NAN, 1.0), (1, 0, "a finite symmetric matrix"));
    assert_eq!(of(1.0, 0.5, 0.5, 2.0), (1, 1, "1 on the diagonal"));
    assert_eq!(of(1.0, -1.0, -1.0, 1.0), (1, 1, "a positive definite matrix"));
    assert!(matches!(
        error(&[vec![1.0, 0.0]]),
        SensitivityError::LengthMismatch { value: 1, expected: 2, .. }
    ));
    let ragged = error(&[vec![1.0, 0.0], vec![1.0]]);
    assert!(matches!(ragged, SensitivityError::LengthMismatch { value: 1, expected: 2, .. }));
    let plain = SobolDesign::new(unit(2), 0, 8).unwrap();
    let error = Correlated::new(plain, &[vec![1.0, 0.5], vec![0.5, 1.0]]).unwrap_err();
    assert_eq!(error, SensitivityError::UnboundedAtZero { name: "x1".into() });
}

#[test]
fn rows_are_the_same_on_one_thread_and_on_four_and_replicates_differ() {
    fn check(design: &impl SampleDesign) {
        let one = design.replicate(3);
        assert_eq!(rows(&one, 1), rows(&one, 4));
        assert_eq!((one.seed(), one.points()), (Some(3), design.points()));
        assert_ne!(rows(&one, 1), rows(&design.replicate(4), 1));
        assert_eq!(rows(&one, 1), rows(&design.replicate(4).replicate(3), 1));
        assert!(design.row(design.points(), &mut [0.0; 3]).is_err());
        assert!(design.row(0, &mut [0.0; 2]).is_err());
    }
    let latin = LatinHypercube::new(unit(3), 50, 1).unwrap();
    let matrix = [vec![1.0, 0.5, 0.0], vec![0.5, 1.0, 0.5], vec![0.0, 0.5, 1.0]];
    check(&LatinHypercube::centred(unit(3), 50, 1).unwrap());
    check(&Halton::new(unit(3), 0, 50).unwrap());
    check(&Correlated::new(latin.clone(), &matrix).unwrap());
    check(&latin);
}

#[test]
fn sizes_out_of_range_and_unbounded_laws_at_zero_are_errors() {
    let normal = vec![Input::continuous("x", Law::Normal { mean: 0.0, std: 1.0 })];
    let error = Halton::new(normal.clone(), 0, 8).unwrap_err();
    assert_eq!(error, SensitivityError::UnboundedAtZero { name: "x".into() });
    assert!(rows(&Halton::new(normal, 1, 8).unwrap(), 1).iter().all(|row| row[0].is_finite()));
    for error in [
        Halton::new(vec![], 0, 8).unwrap_err(),
        Halton::new(unit(1), 0, 0).unwrap_err(),
        Halton::scrambled(unit(2049), 8, 1).unwrap_err(),
        LatinHypercube::new(vec![], 8, 1).unwrap_err(),
        LatinHypercube::centred(unit(1), 0, 1).unwrap_err(),
    ] {
        assert!(matches!(error, SensitivityError::OutOfRange { .. }), "{error}");
    }
    let input = Input::continuous("b", Law::Uniform { min: 1.0, max: 0.0 });
    let error = LatinHypercube::new(vec![input], 8, 1).unwrap_err();
    assert!(error.to_string().starts_with("input `b`: max = 0"), "{error}");
}
