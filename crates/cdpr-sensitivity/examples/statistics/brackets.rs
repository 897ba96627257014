//! How often bounds by derivatives hold the total index, and how far they are from it.

use cdpr_sensitivity::{SampleDesign, SensitivityError, Slopes, SobolDesign, brackets};

use crate::exact::{NEAR, sobol_values};
use crate::functions::{Function, all};

/// Prints, for each function with derivatives, how often the bounds hold T.
pub(crate) fn table(studies: u64) -> Result<(), SensitivityError> {
    println!("{studies} studies of N outputs with gradients on a scrambled sequence: share of inputs with");
    println!("L <= T <= U, of the estimates and of the outer ends of their intervals of 95 % [%]; mean and");
    println!("greatest U - L of the estimates; the same of the bound C nu / V alone");
    println!("{:22}{:>7}{:>10}{:>10}{:>18}{:>18}", "function", "N", "held", "intervals", "U - L", "C nu / V");
    for function in all().into_iter().filter(is_smooth) {
        let exact = sobol_values(&function)?.1;
        for points in [64, 256, 1024] {
            row(&function, &exact, points, studies)?;
        }
    }
    Ok(())
}

fn row(function: &Function, exact: &[f64], points: usize, studies: u64) -> Result<(), SensitivityError> {
    let share = 100.0 / (studies as f64 * exact.len() as f64);
    let [mut held, mut within] = [0.0; 2];
    let [mut width, mut greatest, mut plain, mut plain_greatest] = [0.0, 0.0_f64, 0.0, 0.0_f64];
    for seed in 0..studies {
        let design = SobolDesign::scrambled(function.inputs.clone(), points, seed)?;
        let slopes = slopes(&design, function)?;
        let found = brackets(&design, &slopes, 0.95, seed)?;
        let bounds = cdpr_sensitivity::dgsm(&design, &slopes, 0.95)?;
        for ((bracket, exact), bound) in found.iter().zip(exact).zip(&bounds.inputs) {
            let (lower, upper) = (bracket.total_lower, bracket.total_upper);
            let near = NEAR * exact;
            let holds = |low: f64, high: f64| low <= exact + near && exact - near <= high;
            held += if holds(lower.value, upper.value) { share } else { 0.0 };
            within += if holds(lower.low, upper.high) { share } else { 0.0 };
            width += 0.01 * share * (upper.value - lower.value);
            greatest = greatest.max(upper.value - lower.value);
            let total = bound.total_bound.map_or(f64::INFINITY, |bound| bound.value);
            plain += 0.01 * share * total;
            plain_greatest = plain_greatest.max(total);
        }
    }
    let both = |mean: f64, greatest: f64| format!("{mean:.4} {greatest:.3}");
    println!(
        "{:22}{points:>7}{held:>10.1}{within:>10.1}{:>18}{:>18}",
        function.name,
        both(width, greatest),
        both(plain, plain_greatest)
    );
    Ok(())
}

/// Whether a function has derivatives wherever it is evaluated.
pub(crate) fn is_smooth(function: &Function) -> bool {
    function.name != "step" && !function.name.contains("fail")
}

/// Outputs with central differences.
pub(crate) fn slopes(
    design: &SobolDesign,
    function: &Function,
) -> Result<Vec<Option<Slopes>>, SensitivityError> {
    let inputs = design.inputs();
    let at = |index: usize| {
        let mut row = vec![0.0; inputs.len()];
        design.row(index, &mut row)?;
        let mut slope = |i: usize| {
            let (x, h) = (row[i], 1e-6 * inputs[i].law.std());
            let mut at = |x: f64| {
                row[i] = x;
                (function.model)(&row)
            };
            let slope = at(x + h).zip(at(x - h)).map(|(above, below)| (above - below) / (2.0 * h));
            row[i] = x;
            slope
        };
        let gradient: Option<Vec<f64>> = (0..inputs.len()).map(&mut slope).collect();
        Ok((function.model)(&row).zip(gradient).map(|(output, gradient)| Slopes { output, gradient }))
    };
    (0..design.points()).map(at).collect()
}
