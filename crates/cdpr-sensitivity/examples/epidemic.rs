//! What decides an epidemic: the model of W. O. Kermack and A. G. McKendrick (1927) with uncertain
//! parameters.
//!
//! ```text
//! s' = -β s i,   i' = β s i - γ i,   r' = γ i
//! ```
//!
//! s, i and r are shares of the population, 1 / γ is the time for which a person infects others and β /
//! γ the number of persons that one infects at first. A share v of the population is immune at the
//! beginning, and i starts at i0. The outputs are the largest share that is ill at once, and the share
//! that falls ill in all.
//!
//! ```text
//! cargo run --release -p cdpr-sensitivity --example epidemic
//! ```
#![allow(clippy::print_stdout)]

use cdpr_sensitivity::{
    Bootstrap, Input, Law, MorrisDesign, Order, RandomDesign, SaltelliDesign, SampleDesign, SensitivityError,
    SobolDesign, Truncation, expansion, morris_effects, observe, sobol_indices, wasserstein_bures,
};

/// Largest share that is ill at once, and share that falls ill within two years; x is (R0, 1 / γ [d], v, i0).
fn epidemic(x: &[f64]) -> [f64; 2] {
    const STEP: f64 = 0.25;
    let (gamma, beta) = (1.0 / x[1], x[0] / x[1]);
    let slope = |[s, i]: [f64; 2]| [-beta * s * i, beta * s * i - gamma * i];
    let start = [1.0 - x[2] - x[3], x[3]];
    let (mut state, mut peak) = (start, x[3]);
    for _ in 0..(730.0 / STEP) as usize {
        // Heun's method.
        let one = slope(state);
        let other = slope([state[0] + STEP * one[0], state[1] + STEP * one[1]]);
        for (value, (one, other)) in state.iter_mut().zip(one.into_iter().zip(other)) {
            *value += 0.5 * STEP * (one + other);
        }
        peak = peak.max(state[1]);
    }
    [peak, start[0] - state[0]]
}

fn main() -> Result<(), SensitivityError> {
    let inputs = vec![
        Input::continuous("R0", Law::TruncatedNormal { mean: 2.5, std: 0.5, min: 1.0, max: 5.0 }),
        Input::continuous("days ill", Law::LogNormal { log_mean: 1.8, log_std: 0.3 }),
        Input::continuous("immune", Law::Beta { alpha: 2.0, beta: 4.0, min: 0.0, max: 0.6 }),
        Input::continuous("i0", Law::Uniform { min: 1e-5, max: 1e-3 }),
    ];
    let peak = |x: &[f64]| Some(epidemic(x)[0]);
    let level = 0.95;

    // Screening: 64 blocks of 5 runs.
    let design = MorrisDesign::trajectories(inputs.clone(), 64, 4, 1)?;
    let effects = morris_effects(&design, &observe(&design, peak)?, level)?;

    // Shares of the variance of the peak: 256 blocks of 6 runs, and a polynomial model of 128 runs.
    let design = SaltelliDesign::scrambled(inputs.clone(), 256, Order::First, 1)?;
    let bootstrap = Bootstrap { resamples: 1000, seed: 1 };
    let indices = sobol_indices(&design, &observe(&design, peak)?, bootstrap, level)?;
    let design = SobolDesign::scrambled(inputs.clone(), 128, 1)?;
    let truncation = Truncation { max_degree: 6, norm: 0.75, interactions: 2 };
    let model = expansion(&design, &observe(&design, peak)?, truncation)?;

    // Both outputs together, as one vector of shares of the population: 1024 independent rows.
    let design = RandomDesign::new(inputs, 1024, 1)?;
    let mut columns = vec![Vec::new(); 4];
    let (mut row, mut vectors) = ([0.0; 4], Vec::new());
    for index in 0..design.points() {
        design.row(index, &mut row)?;
        columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
        vectors.push(Some(epidemic(&row).to_vec()));
    }
    let moved = wasserstein_bures(&columns, &vectors, level, 1)?;

    println!("peak: standard deviation {:.3} of the population", indices.variance.sqrt());
    println!("expansion of degree {}, leave-one-out error {:.1e}", model.degree, model.leave_one_out);
    println!("input      mu*      S within           T within           T of expansion   both outputs");
    let rows = effects.iter().zip(&indices.inputs).zip(model.indices()).zip(&moved);
    for (((effect, index), shares), moved) in rows {
        let within = |of: cdpr_sensitivity::Estimate| format!("{:6.3} to {:5.3}", of.low, of.high);
        println!(
            "{:9} {:5.3}{}   {}    {}    {:8.3}     {}",
            effect.input,
            effect.mean_absolute.value,
            if effect.reliable { " " } else { "?" },
            within(index.first),
            within(index.total),
            shares.total,
            within(moved.index)
        );
    }
    Ok(())
}
