//! `cdpr study throughput`: how fast a sampling runs, in one line of JSON.

use crate::arguments::{Preference, Threads};
use crate::error::ProgramError;
use crate::output::progress;
use cdpr_study::{Session, analyse, observe};
use serde_json::json;
use std::path::Path;
use std::time::Instant;

pub(crate) fn run(
    path: &Path,
    sampling: &str,
    observations: usize,
    preference: &Preference,
    threads: &Threads,
) -> Result<(), ProgramError> {
    threads.start()?;
    let mut study = preference.open_study(path)?;
    study.set_observations(observations)?;
    // The intervals of replicates and the measures of sensitivity are observations of their own.
    study.file.replicates = 0;
    study.file.sensitivity = None;
    let sampling = study.sampling(sampling)?;
    let clock = Instant::now();
    let bar = progress(observations, "observations");
    let tick = |done: usize| bar.inc(done as u64);
    let session = Session { tick: &tick, ..Session::in_memory() };
    let tally = observe(&sampling, &session)?;
    let observed = clock.elapsed().as_secs_f64();
    let summary = analyse(&sampling, &tally, &session)?;
    let wall = clock.elapsed().as_secs_f64();
    bar.finish_and_clear();
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
