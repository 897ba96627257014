//! How fast samplings of studies run. Nothing is written.
//!
//! ```text
//! throughput STUDY SAMPLING [OBSERVATIONS [THREADS]]   one line of JSON: time, memory and results
//! throughput LIST [NAME]                               a table of robots and poses, on one thread
//! ```
//!
//! The list is `data/benchmarks/throughput.json`; NAME is a part of the names of its robots. The intervals of
//! replicates and the measures of sensitivity are observations of their own and are left out. All cores
//! compute if THREADS is left out.

#![allow(clippy::print_stderr, clippy::print_stdout)]

use cdpr_number::lanes::Unit;
use cdpr_study::{Session, Study, analyse, observe};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;
use std::time::Instant;

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

fn main() -> Outcome {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let [path, rest @ ..] = &arguments[..] else { return Err("which study file, or which list?".into()) };
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    if file["format"] == "cdpr-throughput/1" {
        return table(&file, Path::new(path), rest.first().copied().unwrap_or_default());
    }
    let [name, rest @ ..] = rest else { return Err("which sampling of the study?".into()) };
    let observations = rest.first().map_or(Ok(1_000_000), |number| number.parse())?;
    if let Some(threads) = rest.get(1) {
        rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
    }
    println!("{}", json!(measured(Path::new(path), name, observations)?));
    Ok(())
}

/// Observes a sampling; returns its figures.
fn measured(path: &Path, name: &str, observations: usize) -> Outcome<Map<String, Value>> {
    let mut study = Study::open(path)?;
    study.set_observations(observations)?;
    study.file.replicates = 0;
    study.file.sensitivity = None;
    let sampling = study.sampling(name)?;
    let clock = Instant::now();
    let session = Session::in_memory();
    let tally = observe(&sampling, &session)?;
    let observed = clock.elapsed().as_secs_f64();
    let summary = analyse(&sampling, &tally, &session)?;
    let wall = clock.elapsed().as_secs_f64();
    let threads = rayon::current_num_threads();
    let each = |seconds: f64| 1e6 * seconds * threads as f64 / observations as f64;
    let values = summary.values.map(|values| json!({ "mean": values.mean, "std": values.std }));
    let line = [
        ("sampling", json!(sampling.name)),
        ("observations", json!(observations)),
        ("failed", json!(summary.failed.values().sum::<usize>())),
        ("scalar", json!(summary.scalar)),
        ("threads", json!(threads)),
        ("wall_s", json!(wall)),
        ("us_per_observation_core", json!(each(wall))),
        ("us_without_analysis", json!(each(observed))),
        ("peak_memory_mib", json!(peak_memory_mib())),
        (summary.output.name(), json!(values)),
    ];
    Ok(line.map(|(name, value)| (name.to_owned(), value)).into_iter().collect())
}

/// Largest resident memory of this process so far; `None` where the system does not say.
fn peak_memory_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib / 1024.0)
}

/// Runs of each robot and vector unit.
const RUNS: usize = 5;

/// Prints a row for each robot of a list, and the mean of all.
fn table(list: &Value, path: &Path, part: &str) -> Outcome {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let data = path.parent().and_then(Path::parent).unwrap_or(Path::new("."));
    let folder = tempfile::tempdir()?;
    println!(
        "| robot | poses | median of {RUNS} runs [µs] | least [µs] | greatest [µs] | slowest pose [µs] | with AVX2 [µs] | \
         times as long | by the scalar models | failed |\n|---|---|---|---|---|---|---|---|---|---|"
    );
    let mut medians: Vec<f64> = Vec::new();
    for case in list["cases"].as_array().into_iter().flatten() {
        let name = case["name"].as_str().unwrap_or_default();
        if name.to_lowercase().contains(&part.to_lowercase()) {
            medians.push(row(case, name, data, folder.path())?);
        }
    }
    let count = medians.len() as f64;
    let geometric = (medians.iter().map(|median| median.ln()).sum::<f64>() / count).exp();
    eprintln!("of {count} robots: geometric mean {geometric:.2} us");
    Ok(())
}

/// What the observations of a robot took.
#[derive(Default)]
struct Run {
    /// For each pose, without the analysis [us].
    times: Vec<f64>,
    failed: u64,
    scalar: u64,
    why: BTreeMap<String, u64>,
}

impl Run {
    fn new(study: &Path, poses: usize, observations: usize) -> Outcome<Self> {
        let mut run = Self::default();
        for pose in 0..poses {
            let line = measured(study, &format!("all/{pose:04}"), observations)?;
            run.times.push(line["us_without_analysis"].as_f64().unwrap_or(f64::NAN));
            run.failed += line["failed"].as_u64().unwrap_or_default();
            run.scalar += line["scalar"]["count"].as_u64().unwrap_or_default();
            for (reason, count) in line["scalar"]["why"].as_object().into_iter().flatten() {
                *run.why.entry(reason.clone()).or_default() += count.as_u64().unwrap_or_default();
            }
        }
        Ok(run)
    }

    fn mean(&self) -> f64 {
        self.times.iter().sum::<f64>() / self.times.len() as f64
    }
}

/// Prints the row of a robot; returns the median of its runs [us].
fn row(case: &Value, name: &str, data: &Path, folder: &Path) -> Outcome<f64> {
    let robot = case["robot"].as_str().ok_or("a case without a robot")?;
    let mut robot: Value = serde_json::from_str(&std::fs::read_to_string(data.join(robot))?)?;
    for (field, value) in case["changes"].as_object().into_iter().flatten() {
        robot[field] = value.clone();
    }
    let poses = case["poses"].as_array().ok_or("a case without poses")?.len();
    let observations = usize::try_from(case["observations"].as_u64().ok_or("a case without observations")?)?;
    std::fs::write(folder.join("robot.json"), robot.to_string())?;
    let study = folder.join("study.json");
    std::fs::write(&study, study_of(case).to_string())?;
    let runs = |unit: Unit| -> Outcome<Vec<Run>> {
        let mut runs = (0..RUNS)
            .map(|_| unit.run(|| Run::new(&study, poses, observations)))
            .collect::<Outcome<Vec<_>>>()?;
        runs.sort_by(|one, other| one.mean().total_cmp(&other.mean()));
        Ok(runs)
    };
    let widest = runs(Unit::Widest)?;
    let [least, median, greatest] = [0, RUNS / 2, RUNS - 1].map(|k| &widest[k]);
    let narrow = match Unit::all().contains(&Unit::Avx2) {
        true => Some(runs(Unit::Avx2)?[RUNS / 2].mean()),
        false => None,
    };
    let all = (poses * observations) as f64;
    let optional = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.2}"));
    let why: Vec<String> = median.why.iter().map(|(reason, count)| format!("{reason} {count}")).collect();
    println!(
        "| {name} | {poses} | {:.2} | {:.2} | {:.2} | {:.2} | {} | {} | {:.2} % {} | {:.2} % |",
        median.mean(),
        least.mean(),
        greatest.mean(),
        median.times.iter().copied().fold(0.0, f64::max),
        optional(narrow),
        optional(narrow.map(|narrow| narrow / median.mean())),
        100.0 * median.scalar as f64 / (all - median.failed as f64).max(1.0),
        why.join(", "),
        100.0 * median.failed as f64 / all,
    );
    Ok(median.mean())
}

/// The study of a robot: uniform laws of the half widths in `errors`.
fn study_of(case: &Value) -> Value {
    let errors = case["errors"].as_object().into_iter().flatten().map(|(parameter, half)| {
        let half = half.as_f64().unwrap_or(f64::NAN);
        (parameter.clone(), json!({"law": {"uniform": {"min": -half, "max": half}}}))
    });
    let errors: Map<String, Value> = errors.collect();
    let free = if case["free"].is_null() { json!([]) } else { case["free"].clone() };
    json!({
        "format": "cdpr-study/1",
        "name": case["name"],
        "robot": "robot.json",
        "payload": case["payload"],
        "seed": 1,
        "replicates": 0,
        "confidence": 0.95,
        "bootstrap_resamples": 1,
        "error_models": { "errors": errors },
        "samplings": { "all": {
            "title": case["name"],
            "poses": { "list": case["poses"] },
            "free": free,
            "error_model": "errors",
            "observations": case["observations"],
        } },
    })
}
