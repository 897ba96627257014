//! How fast a sampling of a study runs, in one line of JSON:
//! `cargo run --release -p cdpr-study --example throughput -- STUDY SAMPLING [OBSERVATIONS [THREADS]]`.
//!
//! Nothing is written. The intervals of replicates and the measures of sensitivity are observations of their
//! own and are left out. All cores compute if THREADS is left out.

#![allow(clippy::print_stdout)]

use cdpr_study::{Session, Study, analyse, observe};
use serde_json::json;
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("which study file?")?;
    let name = arguments.next().ok_or("which sampling of the study?")?;
    let observations = arguments.next().map_or(Ok(1_000_000), |number| number.parse())?;
    if let Some(threads) = arguments.next() {
        rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
    }
    let mut study = Study::open(Path::new(&path))?;
    study.set_observations(observations)?;
    study.file.replicates = 0;
    study.file.sensitivity = None;
    let sampling = study.sampling(&name)?;
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
