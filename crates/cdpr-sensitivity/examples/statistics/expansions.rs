//! Errors of expansions in the polynomials of each law, and in those of the uniform law of 2 F - 1.

use cdpr_sensitivity::{
    Expansion, Input, Law, SampleDesign, SensitivityError, SobolDesign, Steps, Truncation, expansion, observe,
};

use crate::functions;

const TRUNCATION: Truncation = Truncation { max_degree: 4, norm: 1.0, interactions: 2 };
/// Observations that judge a prediction.
const TESTS: usize = 1 << 14;

/// A model, and its inputs.
type Case = (&'static str, Vec<Input>, fn(&[f64]) -> f64);

/// Prints the share of the variance that expansions of 256 observations do not predict.
pub(crate) fn table(studies: u64) -> Result<(), SensitivityError> {
    println!("{studies} studies each of 256 observations, degree up to 4: mean square error of predictions");
    println!("as a share of the variance, mean and greatest over the studies");
    println!("{:24}{:>24}{:>24}", "", "as chosen", "Legendre in 2 F - 1");
    for (name, inputs, model) in cases() {
        let uniform = |i: &Input| Input::continuous(i.name.clone(), Law::Uniform { min: 0.0, max: 1.0 });
        let probabilities: Vec<Input> = inputs.iter().map(uniform).collect();
        let of_probabilities = |u: &[f64]| {
            let row: Vec<f64> = inputs.iter().zip(u).map(|(input, &u)| input.value(u)).collect();
            model(&row)
        };
        let (mut own, mut legendre) = ([0.0; 2], [0.0; 2]);
        for seed in 0..studies {
            let errors = [error(&inputs, &model, seed)?, error(&probabilities, &of_probabilities, seed)?];
            for (sums, error) in [&mut own, &mut legendre].into_iter().zip(errors) {
                *sums = [sums[0] + error / studies as f64, sums[1].max(error)];
            }
        }
        let cell = |[mean, greatest]: [f64; 2]| format!("{mean:.1e} {greatest:.1e}");
        println!("{name:24}{:>24}{:>24}", cell(own), cell(legendre));
    }
    Ok(())
}

/// Mean square error of predictions over the variance.
fn error(
    inputs: &[Input],
    model: &(impl Fn(&[f64]) -> f64 + Sync),
    seed: u64,
) -> Result<f64, SensitivityError> {
    let design = SobolDesign::scrambled(inputs.to_vec(), 256, seed)?;
    let found: Expansion = expansion(&design, &observe(&design, |x| Some(model(x)))?, TRUNCATION)?;
    let tests = SobolDesign::scrambled(inputs.to_vec(), TESTS, seed + 1_000_000)?;
    let (mut row, mut outputs, mut square) = (vec![0.0; inputs.len()], Vec::new(), 0.0);
    for index in 0..TESTS {
        tests.row(index, &mut row)?;
        let output = model(&row);
        outputs.push(output);
        square += (output - found.predict(&row)?).powi(2) / TESTS as f64;
    }
    let mean = outputs.iter().sum::<f64>() / TESTS as f64;
    let variance = outputs.iter().map(|y| (y - mean).powi(2)).sum::<f64>() / TESTS as f64;
    Ok(square / variance)
}

fn cases() -> Vec<Case> {
    let all = |law: Law, count: usize| -> Vec<Input> {
        (0..count).map(|i| Input::continuous(format!("x{}", i + 1), law)).collect()
    };
    let stepped = |law: Law, step: f64| -> Vec<Input> {
        (0..3).map(|i| Input::stepped(format!("x{}", i + 1), law, Steps::Nearest { step })).collect()
    };
    let sum = |x: &[f64]| x.iter().sum::<f64>();
    let product = |x: &[f64]| x[0] * x[1] + x[2].powi(3);
    let borehole = functions::all().into_iter().find(|function| function.name == "Borehole");
    let truncated = Law::TruncatedNormal { mean: 0.0, std: 1.0, min: -1.0, max: 2.0 };
    let mut cases: Vec<Case> = vec![
        ("lognormal 0.5, sum", all(Law::LogNormal { log_mean: 0.0, log_std: 0.5 }, 3), sum),
        ("lognormal 1, sum", all(Law::LogNormal { log_mean: 0.0, log_std: 1.0 }, 3), sum),
        ("lognormal 0.5, products", all(Law::LogNormal { log_mean: 0.0, log_std: 0.5 }, 3), product),
        ("exponential, products", all(Law::Weibull { shape: 1.0, scale: 1.0 }, 3), product),
        ("Gumbel, products", all(Law::Gumbel { location: 0.0, scale: 1.0 }, 3), product),
        ("truncated normal, prod.", all(truncated, 3), product),
        ("3 levels, products", stepped(Law::Uniform { min: -1.0, max: 1.0 }, 1.0), product),
        ("lognormal 0.5, ln", all(Law::LogNormal { log_mean: 0.0, log_std: 0.5 }, 3), |x| x[0].ln() + x[1]),
        ("lognormal 1, ln", all(Law::LogNormal { log_mean: 0.0, log_std: 1.0 }, 3), |x| {
            x[0].ln() + x[1].ln()
        }),
        ("logistic, atan", all(Law::Logistic { location: 0.0, scale: 1.0 }, 3), |x| {
            x[0].atan() + x[1].atan()
        }),
    ];
    if let Some(borehole) = borehole {
        cases.push(("Borehole", borehole.inputs, |x| functions::borehole(x)));
    }
    cases
}
