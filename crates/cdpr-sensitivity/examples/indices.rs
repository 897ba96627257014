//! Every method of global sensitivity on Ishigami's function: y = sin x1 + 7 sin² x2 + 0.1 x3⁴ sin x1.
//!
//! The exact indices are S = 0.314, 0.442, 0 and T = 0.558, 0.442, 0.244.
//!
//! ```text
//! cargo run --release -p cdpr-sensitivity --example indices
//! ```
#![allow(clippy::print_stdout)]

use std::f64::consts::PI;

use cdpr_sensitivity::{
    Bootstrap, Input, LatinHypercube, Law, MorrisDesign, Order, SaltelliDesign, SampleDesign,
    SensitivityError, Slopes, Target, Truncation, dgsm, expansion, morris_effects, observe, rank_regression,
    regression, until_tight,
};

fn ishigami(x: &[f64]) -> Option<f64> {
    Some(x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin())
}

fn slopes(x: &[f64]) -> Option<Slopes> {
    let waves = [(1.0 + 0.1 * x[2].powi(4)) * x[0].cos(), 7.0 * (2.0 * x[1]).sin()];
    let gradient = vec![waves[0], waves[1], 0.4 * x[2].powi(3) * x[0].sin()];
    Some(Slopes { output: ishigami(x)?, gradient })
}

fn main() -> Result<(), SensitivityError> {
    let law = Law::Uniform { min: -PI, max: PI };
    let inputs = ["x1", "x2", "x3"].map(|name| Input::continuous(name, law)).to_vec();
    let level = 0.95;

    // Sobol' indices, with twice as many blocks until all intervals are narrower than 0.1.
    let start = SaltelliDesign::scrambled(inputs.clone(), 64, Order::Second, 1)?;
    let target = Target { width: 0.1, level, max_blocks: 1 << 16 };
    let run = until_tight(start, target, Bootstrap { resamples: 1000, seed: 1 }, ishigami)?;
    for step in &run.steps {
        println!("{:6} blocks: widest interval {:.3}", step.blocks, step.widest());
    }
    let indices = &run.steps[run.steps.len() - 1];

    // One sample of 512 points for all the others but Morris's.
    let sample = LatinHypercube::new(inputs.clone(), 512, 1)?;
    let outputs = observe(&sample, ishigami)?;
    let model = expansion(&sample, &outputs, Truncation { max_degree: 10, norm: 1.0, interactions: 3 })?;
    let shares = model.indices();
    let (values, ranks) = (regression(&sample, &outputs)?, rank_regression(&sample, &outputs)?);
    let mut row = [0.0; 3];
    let mut gradient = |index| {
        sample.row(index, &mut row)?;
        Ok(slopes(&row))
    };
    let gradients: Vec<_> =
        (0..sample.points()).map(&mut gradient).collect::<Result<_, SensitivityError>>()?;
    let measures = dgsm(&sample, &gradients, level)?;

    let screening = MorrisDesign::radial(inputs, 128, 1)?;
    let effects = morris_effects(&screening, &observe(&screening, ishigami)?, level)?;

    println!(
        "       Sobol' first       total            PCE first  total  T bound   SRC²  SRRC²     mu*  sigma"
    );
    for (i, index) in indices.inputs.iter().enumerate() {
        let interval = |e: cdpr_sensitivity::Estimate| format!("{:5.3} ± {:5.3}", e.value, 0.5 * e.width());
        println!(
            "{:5} {} {}   {:9.3} {:6.3} {:8.3} {:6.3} {:6.3} {:7.2} {:6.2}",
            index.input,
            interval(index.first),
            interval(index.total),
            shares[i].closed,
            shares[i].total,
            measures.inputs[i].total_bound.map_or(f64::NAN, |bound| bound.high),
            values.inputs[i].share,
            ranks.inputs[i].share,
            effects[i].mean_absolute.value,
            effects[i].std,
        );
    }
    println!("leave-one-out error of the expansion: {:.1e}", model.leave_one_out);
    println!("R² of values {:.3}, of ranks {:.3}", values.r_squared, ranks.r_squared);
    Ok(())
}
