//! Seconds for 10^5 direct solves on all cores, each from 1 cm away along each axis, and the sum of all
//! heights: what `crates/cdpr-python/benches/direct_batch.py` is compared with.
//!
//! ```text
//! cargo run --release -p cdpr-statics --example direct_batch
//! ```
#![allow(clippy::print_stdout)]

use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{DirectStart, Load, StaticsError, direct, inverse};
use rayon::prelude::*;
use std::time::Instant;

fn main() -> Result<(), StaticsError> {
    let robot = Robot::from_library("caroca")?;
    let share = |k: u32, step: f64| (f64::from(k) * step).fract() - 0.5;
    let cases: Vec<(Vec<f64>, Pose)> = (0..100_000)
        .into_par_iter()
        .map(|k| {
            let z = 1.75 + 0.5 * share(k, 0.25);
            let pose =
                Pose::at(2.0 * share(k, 0.754_877_666_246_692_7), share(k, 0.569_840_290_998_053_2), z);
            let start = pose.moved(Vector3::repeat(0.01), Vector3::zeros());
            Ok((inverse(&robot, &pose, &Load::none())?.lengths, start))
        })
        .collect::<Result<_, StaticsError>>()?;
    let mut times: Vec<f64> = Vec::new();
    for _ in 0..5 {
        let clock = Instant::now();
        let found = cases
            .par_iter()
            .map(|(lengths, start)| direct(&robot, lengths, &Load::none(), DirectStart::Pose(start)))
            .collect::<Result<Vec<_>, _>>()?;
        // What an answer of the Python package has, too.
        let softest: Vec<f64> =
            found.par_iter().map(|solution| solution.stability.least_stiffness()).collect();
        times.push(clock.elapsed().as_secs_f64());
        let heights: f64 = found.iter().map(|solution| solution.equilibrium.pose.position.z).sum();
        println!("{:.3} s, {heights}, {}", times[times.len() - 1], softest[0]);
    }
    times.sort_by(f64::total_cmp);
    println!("median {:.3} s", times[times.len() / 2]);
    Ok(())
}
