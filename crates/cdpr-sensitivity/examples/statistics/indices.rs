//! Errors of Sobol' indices and how often their intervals hold the true ones.

use cdpr_sensitivity::{
    Bootstrap, Estimate, Order, SaltelliDesign, SensitivityError, SobolIndices, observe, sobol_indices,
};

use crate::functions::{Function, all};

/// Blocks behind the values that count as true.
const TRUE_BLOCKS: usize = 1 << 18;

/// Prints, for each function, coverage and errors over 64, 256 and 1024 blocks.
pub(crate) fn table(studies: u64) -> Result<(), SensitivityError> {
    println!(
        "{studies} studies each. S and T: share of the intervals of 95 % that hold the index [%], mean and"
    );
    println!("least over the inputs; largest root mean square error; mean half width over that error");
    println!("{:22}{:>7}{:>37}{:>37}", "function", "blocks", "S", "T");
    for function in all() {
        let exact = indices(&function, TRUE_BLOCKS, u64::MAX)?;
        for blocks in [64, 256, 1024] {
            let found: Vec<SobolIndices> =
                (0..studies).map(|seed| indices(&function, blocks, seed)).collect::<Result<_, _>>()?;
            print!("{:22}{blocks:>7}", function.name);
            let first = |indices: &SobolIndices, i: usize| indices.inputs[i].first;
            let total = |indices: &SobolIndices, i: usize| indices.inputs[i].total;
            for of in [first, total] {
                row(exact.inputs.len(), |i| {
                    (of(&exact, i).value, found.iter().map(|found| of(found, i)).collect())
                });
            }
            println!();
        }
    }
    Ok(())
}

/// Prints one cell of the table, from the exact value and the estimates of each input.
fn row(inputs: usize, estimates: impl Fn(usize) -> (f64, Vec<Estimate>)) {
    let [mut mean, mut least, mut error, mut width] = [0.0, 100.0_f64, 0.0, 0.0];
    for (exact, estimates) in (0..inputs).map(estimates) {
        let average =
            |f: &dyn Fn(&Estimate) -> f64| estimates.iter().map(f).sum::<f64>() / estimates.len() as f64;
        let held = 100.0 * average(&|e| f64::from(e.low <= exact && exact <= e.high));
        let rms = average(&|e| (e.value - exact).powi(2)).sqrt();
        mean += held / inputs as f64;
        least = least.min(held);
        if rms > error {
            (error, width) = (rms, average(&|e| 0.5 * e.width()) / rms);
        }
    }
    print!("{:>20}{error:>10.5}{width:>7.1}", format!("{mean:.1} {least:.1}"));
}

/// Indices of a study of so many blocks.
pub(crate) fn indices(
    function: &Function,
    blocks: usize,
    seed: u64,
) -> Result<SobolIndices, SensitivityError> {
    let design = SaltelliDesign::scrambled(function.inputs.clone(), blocks, Order::First, seed)?;
    let outputs = observe(&design, function.model)?;
    sobol_indices(&design, &outputs, Bootstrap { resamples: 200, seed }, 0.95)
}
