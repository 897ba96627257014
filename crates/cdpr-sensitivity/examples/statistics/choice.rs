//! How often the choice of a fitted law is right, wrong or undecided.

use cdpr_sensitivity::{
    BestFit, Bootstrap, Evidence, Family, Input, Law, RandomDesign, Sample, SensitivityError, fit_all,
    observe,
};

const LAWS: [(&str, Family, Law); 11] = [
    ("uniform 0..1", Family::Uniform, Law::Uniform { min: 0.0, max: 1.0 }),
    ("normal 0, 1", Family::Normal, Law::Normal { mean: 0.0, std: 1.0 }),
    ("normal 5, 1", Family::Normal, Law::Normal { mean: 5.0, std: 1.0 }),
    ("logistic", Family::Logistic, Law::Logistic { location: 0.0, scale: 1.0 }),
    ("Laplace", Family::Laplace, Law::Laplace { location: 0.0, scale: 1.0 }),
    ("Gumbel", Family::Gumbel, Law::Gumbel { location: 0.0, scale: 1.0 }),
    ("lognormal 0.5", Family::LogNormal, Law::LogNormal { log_mean: 0.0, log_std: 0.5 }),
    ("lognormal 1", Family::LogNormal, Law::LogNormal { log_mean: 0.0, log_std: 1.0 }),
    ("exponential", Family::Weibull, Law::Weibull { shape: 1.0, scale: 1.0 }),
    ("Weibull 1.5", Family::Weibull, Law::Weibull { shape: 1.5, scale: 1.0 }),
    ("Weibull 3", Family::Weibull, Law::Weibull { shape: 3.0, scale: 1.0 }),
];

/// Samples of the bootstrap: enough for a p-value of 0.025.
const RESAMPLES: usize = 39;

/// Prints the shares of right, wrong and rejecting choices, and of the right family named as best.
pub(crate) fn table(studies: u64) -> Result<(), SensitivityError> {
    println!("{studies} samples each [%]: named right / decided and right / decided and wrong / rejected");
    println!("{:14}{:>26}{:>26}{:>26}{:>26}", "law", "n = 10", "20", "50", "200");
    let mut pooled = [0.0; 4];
    for (name, family, law) in LAWS {
        print!("{name:14}");
        for (n, pooled) in [10, 20, 50, 200].into_iter().zip(&mut pooled) {
            let [mut named, mut right, mut wrong, mut rejected] = [0.0; 4];
            for seed in 0..studies {
                let design = RandomDesign::new(vec![Input::continuous("x", law)], n, seed)?;
                let sample = Sample::new(&observe(&design, |x| Some(x[0]))?)?;
                let fits = fit_all(&sample, Bootstrap { resamples: RESAMPLES, seed })?;
                let Some(best) = BestFit::of(&fits) else { continue };
                let correct = best.family == family;
                let share = 100.0 / studies as f64;
                named += if correct { share } else { 0.0 };
                match (best.evidence, correct) {
                    (Evidence::Undecided, _) => {}
                    (Evidence::Decided, true) => right += share,
                    (Evidence::Decided, false) => wrong += share,
                    (Evidence::Rejected, _) => rejected += share,
                }
            }
            *pooled += wrong / LAWS.len() as f64;
            print!("{:>26}", format!("{named:.1} / {right:.1} / {wrong:.1} / {rejected:.1}"));
        }
        println!();
    }
    println!("wrong over all laws: {}", pooled.map(|wrong| format!("{wrong:.1}")).join(", "));
    Ok(())
}
