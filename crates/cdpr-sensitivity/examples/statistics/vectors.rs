//! How often intervals of the index of Wasserstein and Bures hold it, for linear models of normal and uniform
//! inputs, whose index is exact, on random rows.

use cdpr_sensitivity::{
    Input, Law, RandomDesign, SampleDesign, SensitivityError, WassersteinBures, wasserstein_bures,
};

/// A name, effects of each input on each of three components (orthogonal to those of other components), and
/// whether inputs are normal.
type Case = (&'static str, Vec<[f64; 3]>, bool);

/// Prints coverage, error and bias.
pub(crate) fn table(studies: u64) -> Result<(), SensitivityError> {
    println!(
        "{studies} studies each: share of the intervals of 95 % that hold the index [%], mean and least of"
    );
    println!("the inputs; largest root mean square error; largest mean error; the same of the part by means");
    println!("| model | rows | index: held | error | mean error | means: held | error | mean error |");
    println!("|---|---|---|---|---|---|---|---|");
    let even = vec![[3.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]];
    let many = (0..20).map(|i| [0, 1, 2].map(|j| if i % 3 == j { 1.0 / (1.0 + i as f64) } else { 0.0 }));
    let cases: [Case; 4] = [
        ("5 normal", even.clone(), true),
        ("5 uniform", even, false),
        ("20 normal", many.clone().collect(), true),
        ("20 uniform", many.collect(), false),
    ];
    for case in &cases {
        for points in [64, 256, 1024, 4096] {
            row(case, points, studies)?;
        }
    }
    Ok(())
}

fn row(case: &Case, points: usize, studies: u64) -> Result<(), SensitivityError> {
    let (name, effects, is_normal) = case;
    let half = 3.0_f64.sqrt();
    let law = match is_normal {
        true => Law::Normal { mean: 0.0, std: 1.0 },
        false => Law::Uniform { min: -half, max: half },
    };
    let inputs = || (0..effects.len()).map(|i| Input::continuous(format!("x{i}"), law)).collect();
    let exact: Vec<[f64; 2]> = effects.iter().map(|of| exact(effects, *of)).collect();
    let mut sums = vec![[[0.0; 3]; 2]; effects.len()];
    for seed in 0..studies {
        let found = estimate(&RandomDesign::new(inputs(), points, seed)?, effects, seed)?;
        for ((found, exact), sums) in found.iter().zip(&exact).zip(&mut sums) {
            for ((of, exact), sums) in [found.index, found.means].iter().zip(exact).zip(sums) {
                let held = of.low <= *exact && *exact <= of.high;
                let error = of.value - exact;
                *sums = [sums[0] + f64::from(u8::from(held)), sums[1] + error * error, sums[2] + error];
            }
        }
    }
    print!("| {name} | {points} |");
    for kind in 0..2 {
        let share = |i: usize| sums.iter().map(move |of| of[kind][i] / studies as f64);
        let mean = 100.0 * share(0).sum::<f64>() / effects.len() as f64;
        let least = 100.0 * share(0).fold(1.0, f64::min);
        let bias = share(2).fold(0.0_f64, |most, bias| if bias.abs() > most.abs() { bias } else { most });
        print!(" {mean:.1} / {least:.1} | {:.4} | {bias:.4} |", share(1).fold(0.0, f64::max).sqrt());
    }
    println!();
    Ok(())
}

fn estimate<D: SampleDesign>(
    design: &D,
    effects: &[[f64; 3]],
    seed: u64,
) -> Result<Vec<WassersteinBures>, SensitivityError> {
    let mut columns = vec![Vec::new(); effects.len()];
    let mut row = vec![0.0; effects.len()];
    let mut outputs = Vec::new();
    for index in 0..design.points() {
        design.row(index, &mut row)?;
        columns.iter_mut().zip(&row).for_each(|(column, x)| column.push(*x));
        let component = |j: usize| row.iter().zip(effects).map(|(x, of)| x * of[j]).sum();
        let y: [f64; 3] = [0, 1, 2].map(component);
        // Turned, so that the components are correlated.
        let (a, b) = (0.6 * y[0] - 0.8 * y[1], 0.8 * y[0] + 0.6 * y[1]);
        outputs.push(Some(vec![a, 0.6 * b - 0.8 * y[2], 0.8 * b + 0.6 * y[2]]));
    }
    wasserstein_bures(&columns, &outputs, 0.95, seed)
}

/// Index and its part by the means, of an input that acts on one component: its variance is another one
/// where the input is fixed.
fn exact(effects: &[[f64; 3]], of: [f64; 3]) -> [f64; 2] {
    let variance = |j: usize| effects.iter().map(|of| of[j] * of[j]).sum::<f64>();
    let whole: f64 = (0..3).map(variance).sum();
    let rest = |j: usize| (variance(j) * (variance(j) - of[j] * of[j])).sqrt();
    let own: f64 = of.iter().map(|effect| effect * effect).sum();
    [1.0 - (0..3).map(rest).sum::<f64>() / whole, 0.5 * own / whole]
}
