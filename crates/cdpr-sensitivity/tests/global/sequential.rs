//! Doubling a design until its intervals are tight.

use std::sync::atomic::{AtomicUsize, Ordering};

use cdpr_sensitivity::{
    Bootstrap, Input, Law, Order, SaltelliDesign, SampleDesign, SensitivityError, Target, sobol_indices,
    until_tight,
};

const BOOTSTRAP: Bootstrap = Bootstrap { resamples: 200, seed: 1 };

fn design() -> SaltelliDesign {
    let law = Law::Normal { mean: 1.0, std: 0.5 };
    let inputs = ["one", "two"].map(|name| Input::continuous(name, law)).to_vec();
    SaltelliDesign::scrambled(inputs, 64, Order::First, 4).unwrap()
}

fn product(x: &[f64]) -> Option<f64> {
    Some(x[0] * x[1])
}

#[test]
fn the_first_design_with_tight_intervals_is_the_last_and_no_point_is_run_twice() {
    let runs = AtomicUsize::new(0);
    let counted = |x: &[f64]| {
        runs.fetch_add(1, Ordering::Relaxed);
        product(x)
    };
    let target = Target { width: 0.1, level: 0.95, max_blocks: 1 << 16 };
    let run = until_tight(design(), target, BOOTSTRAP, counted).unwrap();
    let (last, before) = run.steps.split_last().unwrap();
    assert!(run.tight && last.widest() <= 0.1 && !before.is_empty());
    assert!(before.iter().all(|indices| indices.widest() > 0.1));
    assert_eq!(run.outputs.len(), run.design.points());
    assert_eq!(runs.into_inner(), run.design.points());
    // The same as if it had been run at once.
    let at_once = design().resized(run.design.blocks()).unwrap();
    assert_eq!(*last, sobol_indices(&at_once, &run.outputs, BOOTSTRAP, 0.95).unwrap());
    // S = 4 / 9 and T = 5 / 9 of both: mean 1, variance 1/4, so that V = 1/4 + 1/4 + 1/16.
    for index in &last.inputs {
        assert!((index.first.value - 4.0 / 9.0).abs() < 0.1 && (index.total.value - 5.0 / 9.0).abs() < 0.1);
    }
}

#[test]
fn a_run_that_reaches_its_maximum_is_not_tight() {
    let target = Target { width: 1e-6, level: 0.95, max_blocks: 255 };
    let run = until_tight(design(), target, BOOTSTRAP, product).unwrap();
    assert!(!run.tight);
    assert_eq!(run.steps.iter().map(|indices| indices.blocks).collect::<Vec<_>>(), [64, 128]);
}

#[test]
fn a_width_of_zero_is_an_error() {
    let target = Target { width: 0.0, level: 0.95, max_blocks: 255 };
    let error = until_tight(design(), target, BOOTSTRAP, product).unwrap_err();
    assert!(matches!(error, SensitivityError::InvalidParameter { field: "width", .. }));
}
