//! Screening of Ishigami's function: y = sin x1 + 7 sin² x2 + 0.1 x3⁴ sin x1, x uniform on [-π, π], and an
//! inert x4.
//!
//! T. Ishigami, T. Homma, *An importance quantification technique in uncertainty analysis for computer
//! models* (1990). The exact effect of x1 is (4/π)(1 + 0.1 π⁴/5) = 3.754; those of x2, x3 and x4 are 0. x2
//! and x3 act through even functions, whose mean is the same in both halves. Screening by halves does not
//! detect them, unlike a variance-based index.
//!
//! ```text
//! cargo run --release -p cdpr-sensitivity --example ishigami
//! ```
#![allow(clippy::print_stdout)]

use std::f64::consts::PI;

use cdpr_sensitivity::{
    Bootstrap, Input, Law, Replicate, Sample, SampleDesign, SensitivityError, SobolDesign, effect_intervals,
    fit_all, student_effects,
};

fn ishigami(x: &[f64]) -> Option<f64> {
    Some(x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin())
}

fn run(design: &SobolDesign) -> Result<Vec<Option<f64>>, SensitivityError> {
    let mut row = vec![0.0; design.inputs().len()];
    let mut output = |index| {
        design.row(index, &mut row)?;
        Ok(ishigami(&row))
    };
    (0..design.points()).map(&mut output).collect()
}

fn main() -> Result<(), SensitivityError> {
    let law = Law::Uniform { min: -PI, max: PI };
    let inputs = ["x1", "x2", "x3", "x4"].map(|name| Input::continuous(name, law)).to_vec();
    let design = SobolDesign::new(inputs, 0, 2048)?;
    let outputs = run(&design)?;

    let sample = Sample::new(&outputs)?;
    println!("{:#?}", sample.summary());

    let effects = student_effects(&design, &outputs)?;
    let replicate = |seed| {
        let design = design.replicate(seed);
        run(&design).map(|outputs| Replicate { design, outputs })
    };
    let replicates = (0..16).map(replicate).collect::<Result<Vec<_>, _>>()?;
    let intervals = effect_intervals(&replicates, 0.95)?;
    println!("input      t    effect    95 % interval over 16 replicates");
    for (effect, interval) in effects.effects.iter().zip(&intervals) {
        let (name, t, signed) = (&effect.input, effect.student, effect.effect);
        println!("{name}    {t:6.2}  {signed:8.4}    {:8.4} to {:8.4}", interval.low, interval.high);
    }

    println!("law fitted, AIC, KS distance, p-value");
    for fit in fit_all(&sample, Bootstrap { resamples: 199, seed: 1 })? {
        println!("{:?}  {:.1}  {:.4}  {:.3}", fit.family, fit.aic, fit.ks_distance, fit.p_value);
    }
    Ok(())
}
