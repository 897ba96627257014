//! Estimators of tables: how often intervals of the first-order index hold it, and how often tests and levels
//! of noise are passed without an effect.

use cdpr_sensitivity::{
    Estimate, GivenData, Rows, SensitivityError, delta, dependence, dependence_of_event, pawn, rank_indices,
};

use crate::exact::sobol_values;
use crate::functions::{Function, all};
use crate::measures::random;

/// Prints, for each function, coverage and errors on independent rows.
pub(crate) fn table(studies: u64) -> Result<(), SensitivityError> {
    println!("{studies} studies each of independent random rows. S by ranks: share of the intervals of 95 %");
    println!("that hold the index [%], mean and least over the inputs; largest root mean square and largest");
    println!("mean error; mean half width over the root mean square error");
    println!("{:22}{:>7}{:>20}{:>10}{:>10}{:>7}", "function", "rows", "held", "error", "bias", "width");
    for function in all() {
        let exact = sobol_values(&function)?.0;
        for rows in [50, 200, 1000] {
            ranks(&function, &exact, rows, studies)?;
        }
    }
    Ok(())
}

/// Prints how often each test finds an effect of outputs that are dealt to the rows at random.
pub(crate) fn table_of_levels(studies: u64) -> Result<(), SensitivityError> {
    println!("outputs dealt to the rows at random: share found above the level of 5 % (1 %) [%];");
    println!("delta, of ranks, is the same for all outputs without equal values: of two functions alone");
    println!(
        "{:22}{:>7}{:>20}{:>20}{:>10}{:>10}",
        "function", "rows", "dependence", "of an event", "PAWN", "delta"
    );
    for function in
        all().into_iter().filter(|function| function.inputs.len() <= 10 && !function.name.contains("fail"))
    {
        for rows in [20, 50, 200] {
            levels(&function, rows, studies)?;
        }
    }
    Ok(())
}

fn ranks(function: &Function, exact: &[f64], rows: usize, studies: u64) -> Result<(), SensitivityError> {
    let of_study = |seed| rank_indices(&random(function, rows, seed)?, 0.95, seed);
    let found = (0..studies).map(of_study).collect::<Result<Vec<_>, _>>()?;
    let [mut mean, mut least, mut error, mut bias, mut width] = [0.0, 100.0_f64, 0.0, 0.0, 0.0];
    for (i, exact) in exact.iter().enumerate() {
        let average = |f: &dyn Fn(&Estimate) -> f64| {
            found.iter().map(|found| f(&found[i])).sum::<f64>() / studies as f64
        };
        let held = 100.0 * average(&|e| f64::from(e.low <= *exact && *exact <= e.high));
        let rms = average(&|e| (e.value - exact).powi(2)).sqrt();
        let off = average(&|e| e.value - exact);
        mean += held / found[0].len() as f64;
        least = least.min(held);
        if rms > error {
            (error, width) = (rms, average(&|e| 0.5 * e.width()) / rms);
        }
        if off.abs() > f64::abs(bias) {
            bias = off;
        }
    }
    let held = format!("{mean:.1} {least:.1}");
    println!("{:22}{rows:>7}{held:>20}{error:>10.4}{bias:>10.4}{width:>7.1}", function.name);
    Ok(())
}

fn levels(function: &Function, rows: usize, studies: u64) -> Result<(), SensitivityError> {
    let of_delta = ["Ishigami", "step"].contains(&function.name);
    let [mut five, mut one, mut event_five, mut event_one, mut noisy, mut noisy_delta] = [0.0; 6];
    for seed in 0..studies {
        let table = random(function, rows, seed)?;
        // Outputs of other rows.
        let other = random(function, rows, seed + (1 << 40))?;
        let dealt =
            GivenData::new(vec!["x".to_owned()], vec![table.columns()[0].clone()], other.outputs().to_vec())?;
        let share = 100.0 / studies as f64;
        let count = |sum: &mut f64, counts: bool| *sum += if counts { share } else { 0.0 };
        let limits = Rows { most: 2000, seed };
        let p = dependence(&dealt, limits)?[0].p_value;
        count(&mut five, p <= 0.05);
        count(&mut one, p <= 0.01);
        let values: Vec<f64> = dealt.outputs().iter().copied().map(|y| y.unwrap_or(f64::INFINITY)).collect();
        let mut sorted = values.clone();
        sorted.sort_by(f64::total_cmp);
        let happens: Vec<bool> = values.iter().map(|y| *y > sorted[rows * 4 / 5]).collect();
        let p = dependence_of_event(dealt.columns(), &happens, limits).map_or(1.0, |found| found[0].p_value);
        count(&mut event_five, p <= 0.05);
        count(&mut event_one, p <= 0.01);
        let found = pawn(&dealt, seed)?[0];
        count(&mut noisy, found.median > found.noise);
        if of_delta {
            let found = delta(&dealt, 0.95, seed)?[0];
            count(&mut noisy_delta, found.delta > found.noise);
        }
    }
    let both = |five: f64, one: f64| format!("{five:.1} ({one:.1})");
    println!(
        "{:22}{rows:>7}{:>20}{:>20}{noisy:>10.1}{:>10}",
        function.name,
        both(five, one),
        both(event_five, event_one),
        if of_delta { format!("{noisy_delta:.1}") } else { "-".to_owned() }
    );
    Ok(())
}
