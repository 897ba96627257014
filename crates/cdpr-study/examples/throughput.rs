//! How fast one sampling of a study runs: time, memory and results in one line of JSON. Nothing is written.
//!
//! `cargo run -p cdpr-study --example throughput -- STUDY --sampling NAME [--observations N] [--threads N]`;
//! `cargo xtask throughput` and `cargo xtask scaling` run it.

#![allow(clippy::print_stdout)]

use cdpr_study::{Session, Study, analyse, observe};
use serde_json::json;
use std::error::Error;
use std::time::Instant;

/// Observations without `--observations`.
const OBSERVATIONS: usize = 1_000_000;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("expected a study file")?;
    let (mut sampling, mut observations, mut threads) = (None, OBSERVATIONS, 0);
    while let Some(option) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("{option}: expected a value"))?;
        match option.as_str() {
            "--sampling" => sampling = Some(value),
            "--observations" => observations = value.parse()?,
            "--threads" => threads = value.parse()?,
            _ => return Err(format!("{option}: expected --sampling, --observations or --threads").into()),
        }
    }
    let sampling = sampling.ok_or("expected --sampling NAME")?;
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    let mut study = Study::open(path.as_ref())?;
    study.set_observations(observations)?;
    // The intervals of replicates and the measures of sensitivity are observations of their own.
    study.file.replicates = 0;
    study.file.sensitivity = None;
    let sampling = study.sampling(&sampling)?;
    let clock = Instant::now();
    let session = Session::in_memory();
    let tally = observe(&sampling, &session)?;
    let observed = clock.elapsed().as_secs_f64();
    let summary = analyse(&sampling, &tally, &session)?;
    let wall = clock.elapsed().as_secs_f64();
    let threads = rayon::current_num_threads();
    let each = |seconds: f64| 1e6 * seconds * threads as f64 / observations as f64;
    let values = summary.values.map(|values| json!({ "mean": values.mean, "std": values.std }));
    let line = json!({
        "sampling": sampling.name,
        "observations": observations,
        "failed": summary.failed.values().sum::<usize>(),
        "scalar": summary.scalar,
        "threads": threads,
        "wall_s": wall,
        "us_per_observation_core": each(wall),
        "us_without_analysis": each(observed),
        "peak_memory_mib": peak_memory_mib(),
        (summary.output.name()): values,
    });
    println!("{line}");
    Ok(())
}

/// Largest resident memory of this process so far; `None` where the system does not say.
fn peak_memory_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib / 1024.0)
}
