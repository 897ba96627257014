//! Designs of several tests.

use cdpr_sensitivity::{Input, Law, SampleDesign};
use rayon::prelude::*;

/// Inputs `x1`, `x2`, ... of one uniform law.
pub(crate) fn uniform(count: usize, min: f64, max: f64) -> Vec<Input> {
    (1..=count).map(|i| Input::continuous(format!("x{i}"), Law::Uniform { min, max })).collect()
}

/// Inputs from 0 to 1.
pub(crate) fn unit(count: usize) -> Vec<Input> {
    uniform(count, 0.0, 1.0)
}

/// All rows of a design.
pub(crate) fn rows(design: &impl SampleDesign, threads: usize) -> Vec<Vec<f64>> {
    let row = |index| {
        let mut row = vec![f64::NAN; design.inputs().len()];
        design.row(index, &mut row).unwrap();
        row
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| (0..design.points()).into_par_iter().map(row).collect())
}
