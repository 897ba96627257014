//! Rows that are left out, and rows whose runs have failed.

use crate::verdict::{concerns, table};
use cdpr_sensitivity::{Analyser, Concern, GivenData, Input, Law, RandomDesign, observe};

#[test]
fn a_number_of_the_row_is_recognized_where_rows_are_left_out_and_has_no_remedy_of_an_order() {
    let wave = |row: usize, k: f64| (k * row as f64 * row as f64).sin();
    let kept = |row: &usize| row % 7 != 3;
    let rows: Vec<usize> = (1..=120).filter(kept).collect();
    let column = |of: &dyn Fn(usize) -> f64| rows.iter().map(|&row| of(row)).collect::<Vec<f64>>();
    let output = column(&|row| wave(row, 0.7));
    let made = |order: &dyn Fn(usize) -> f64| {
        table(vec![column(&|row| wave(row, 0.7)), column(order)], output.clone())
    };
    let found = Analyser::new(1).verdict(&made(&|row| row as f64)).unwrap();
    assert!(concerns(&found, Concern::RowNumber) && !concerns(&found, Concern::RowsInOrder), "{found:?}");
    // A time is no number of the row: its column is named.
    let found = Analyser::new(1).verdict(&made(&|row| 0.37 * row as f64)).unwrap();
    assert!(!concerns(&found, Concern::RowNumber), "{found:?}");
    let order = found.conditions.iter().find(|of| of.concern == Concern::RowsInOrder).unwrap();
    assert!(order.text.contains("`x2`"), "{order:?}");
}

/// Rows of four independent uniform inputs and y = 3 x1 with noise; those fail for which `fails` is true.
fn selected(seed: u64, fails: impl Fn(&[f64]) -> bool + Sync) -> GivenData {
    let inputs: Vec<Input> =
        (1..=4).map(|i| Input::continuous(format!("x{i}"), Law::Uniform { min: -1.0, max: 1.0 })).collect();
    let design = RandomDesign::new(inputs, 300, seed).unwrap();
    let model = |x: &[f64]| (!fails(x)).then(|| 3.0 * x[0] + 0.5 * x[3]);
    GivenData::of_design(&design, &observe(&design, model).unwrap()).unwrap()
}

#[test]
fn inputs_that_failed_runs_make_dependent_are_said_to_be_independent_in_all_rows() {
    let of = |data: &GivenData| Analyser::new(1).verdict(data).unwrap();
    for seed in 0..8 {
        let found = of(&selected(seed, |x| x[0] + x[1] > 0.4));
        assert!(concerns(&found, Concern::FailedRuns), "{seed}: {found:?}");
        assert!(!concerns(&found, Concern::DependentInputs), "{seed}: {found:?}");
        let first = found.related.iter().find(|of| of.input == "x1").unwrap();
        assert_eq!(first.reasons, ["depends on `x2` in the rows with an output only"], "{seed}");
        // Failures that no input causes leave all inputs independent.
        let by_chance = of(&selected(seed, |x| (1e4 * x[2]).fract().abs() < 0.3));
        assert!(!concerns(&by_chance, Concern::FailedRuns), "{seed}: {by_chance:?}");
    }
    // Inputs that depend on each other in all rows stay so, whichever runs fail.
    let data = selected(1, |x| x[0] + x[1] > 0.4);
    let mut columns = data.columns().to_vec();
    columns[1] = columns[0].iter().zip(&columns[2]).map(|(one, other)| one + 0.5 * other).collect();
    let data = GivenData::new(data.names().to_vec(), columns, data.outputs().to_vec()).unwrap();
    let found = of(&data);
    assert!(
        concerns(&found, Concern::DependentInputs) && !concerns(&found, Concern::FailedRuns),
        "{found:?}"
    );
}
