//! Expansions fitted to exact derivatives of robots, beside those of values alone at equal cost.
//!
//! ```text
//! cargo run --release -p cdpr-study --example gradients -- STUDIES [ROBOT ...]
//! ```
//!
//! The study of each robot is its template; the indices that count as true are Sobol' indices.

#![allow(clippy::print_stdout)]

use cdpr_sensitivity::{
    Bootstrap, Expansion, Order, SaltelliDesign, SampleDesign, SensitivityError, Shares, Slopes, SobolDesign,
    Truncation, expansion, gradient_expansion, sobol_indices,
};
use cdpr_statics::Observer;
use cdpr_statics::batch::{Observation, ObservationSlopes};
use cdpr_study::{Sampling, Study, observe_rows, open_robot, template};
use std::error::Error;
use std::path::Path;
use std::time::Instant;

const ROBOTS: [&str; 4] = ["caroca", "cogiro", "segesta", "fast"];
const BLOCKS: usize = 1 << 14;
/// Observations that one with its gradient costs in lanes.
const COST: f64 = 3.5;
/// That of studies.
const TRUNCATION: Truncation = Truncation { max_degree: 3, norm: 0.75, interactions: 2 };

/// A robot, observed in lanes.
struct Case<'a> {
    sampling: &'a Sampling<'a>,
    observer: Observer<'a>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let studies = std::env::args().nth(1).and_then(|count| count.parse().ok()).unwrap_or(10);
    println!(
        "| robot, k | reference | N | N values | N with gradients | {COST} N values | took part | cost |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    let named: Vec<String> = std::env::args().skip(2).collect();
    for name in ROBOTS.into_iter().filter(|robot| named.is_empty() || named.iter().any(|one| one == robot)) {
        let path = format!("{}/../../data/robots/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let path = Path::new(&path);
        let text = template(&open_robot(path)?, &format!("{name}.json"), None, None, &[])?;
        let study = Study::from_json(&text, path)?;
        let sampling = &study.sampling("all")?;
        let observer = Observer::new(sampling.robot, sampling.pose, &sampling.load)?;
        let case = Case { sampling, observer };
        let (exact, reference) = case.sobol()?;
        let cost = case.cost()?;
        for points in [16, 32, 64] {
            let [own, enhanced, equal, took_part] = case.errors(&exact, points, studies)?;
            let k = exact.len() / 2;
            println!(
                "| {name}, {k} | {reference:.1e} | {points} | {own:.1e} | {enhanced:.1e} | {equal:.1e} | \
                 {took_part:.0} | {cost:.1} |"
            );
        }
    }
    Ok(())
}

impl Case<'_> {
    /// First-order and total indices, and the root mean square of their standard errors.
    fn sobol(&self) -> Result<(Vec<f64>, f64), SensitivityError> {
        let inputs = self.sampling.design.inputs().to_vec();
        let design = SaltelliDesign::scrambled(inputs, BLOCKS, Order::First, 1)?;
        let found =
            sobol_indices(&design, &self.values(&design), Bootstrap { resamples: 100, seed: 1 }, 0.95)?;
        let all = || found.inputs.iter().map(|of| of.first).chain(found.inputs.iter().map(|of| of.total));
        let squares = all().map(|of| ((of.high - of.low) / 3.92).powi(2)).sum::<f64>();
        Ok((all().map(|of| of.value).collect(), (squares / all().count() as f64).sqrt()))
    }

    /// How many observations one with its gradient takes as long as, on one thread.
    fn cost(&self) -> Result<f64, SensitivityError> {
        let design = SobolDesign::scrambled(self.sampling.design.inputs().to_vec(), 256, 1)?;
        let mut rows = vec![0.0; 256 * design.inputs().len()];
        design.rows(0, &mut rows)?;
        let deviations = self.sampling.errors.deviations(&rows);
        let fastest = |run: &dyn Fn() -> usize| {
            let one = |_| {
                let clock = Instant::now();
                assert_eq!(run(), 256);
                clock.elapsed().as_secs_f64()
            };
            (0..50).map(one).fold(f64::INFINITY, f64::min)
        };
        let values = fastest(&|| self.observer.observe::<Observation>(&deviations).len());
        Ok(fastest(&|| self.observer.observe::<ObservationSlopes>(&deviations).len()) / values)
    }

    /// Root mean square errors of all indices, from values, values with gradients, and as many values as
    /// these cost; share of the studies in which gradients took part [%].
    fn errors(&self, exact: &[f64], points: usize, studies: u64) -> Result<[f64; 4], SensitivityError> {
        let mut sums = [0.0; 4];
        for seed in 0..studies {
            let scrambled =
                |points: usize| SobolDesign::scrambled(self.sampling.design.inputs().to_vec(), points, seed);
            let of_values = |points: usize| -> Result<Expansion, SensitivityError> {
                let design = scrambled(points)?;
                expansion(&design, &self.values(&design), TRUNCATION)
            };
            let design = scrambled(points)?;
            let enhanced = gradient_expansion(&design, &self.slopes(&design), TRUNCATION)?;
            let found = [of_values(points)?, enhanced, of_values((COST * points as f64) as usize)?];
            for (sum, of) in sums.iter_mut().zip(&found) {
                *sum += square(&of.indices(), exact) / studies as f64;
            }
            sums[3] += f64::from(u8::from(found[1].derivatives)) / studies as f64;
        }
        let [own, enhanced, equal, took_part] = sums;
        Ok([own.sqrt(), enhanced.sqrt(), equal.sqrt(), 100.0 * took_part])
    }

    fn values(&self, design: &impl SampleDesign) -> Vec<Option<f64>> {
        observe_rows(design, 0..design.points(), |rows| {
            let deviations = self.sampling.errors.deviations(rows);
            let found = self.observer.observe::<Observation>(&deviations).into_iter();
            found.map(|of| of.ok().map(|of| 1e3 * of.magnitude())).collect()
        })
    }

    fn slopes(&self, design: &impl SampleDesign) -> Vec<Option<Slopes>> {
        let errors = &self.sampling.errors;
        let in_mm = |of: ObservationSlopes| Slopes {
            output: 1e3 * of.observation.magnitude(),
            gradient: errors.gradient(&of.magnitude).iter().map(|slope| 1e3 * slope).collect(),
        };
        observe_rows(design, 0..design.points(), |rows| {
            let found = self.observer.observe(&errors.deviations(rows)).into_iter();
            found.map(|of| of.ok().map(in_mm)).collect()
        })
    }
}

/// Mean square error of all indices, those of the first order first.
fn square(found: &[Shares], exact: &[f64]) -> f64 {
    let all = found.iter().map(|of| of.closed).chain(found.iter().map(|of| of.total));
    all.zip(exact).map(|(found, exact)| (found - exact).powi(2)).sum::<f64>() / exact.len() as f64
}
