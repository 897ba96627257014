//! A study of one's own: CoGiRo in the middle of its workspace, exit points known to 5 mm and anchor points
//! to 2 mm.

#![allow(clippy::print_stdout)]

use cdpr_study::{Session, Study, analyse, observe};
use std::time::Instant;

const STUDY: &str = r#"{
  "format": "cdpr-study/1", "name": "CoGiRo", "robot": "cogiro.json", "payload": 50.0, "seed": 1,
  "replicates": 4, "confidence": 0.95, "bootstrap_resamples": 100,
  "error_models": {"survey": {
    "a": {"law": {"normal": {"mean": 0.0, "std": 0.002}}},
    "b": {"law": {"uniform": {"min": -0.005, "max": 0.005}}},
    "youngs_modulus": {"law": {"triangular": {"min": -2e10, "mode": 0.0, "max": 1e10}}}
  }},
  "samplings": {"middle": {"title": "CoGiRo at 2 m height", "pose": {"position": [0.0, 0.0, 2.0]},
    "error_model": "survey", "observations": 1024, "first_index": 1}}
}"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/robots/own_study.json");
    let study = Study::from_json(STUDY, beside.as_ref())?;
    let sampling = study.sampling("middle")?;
    let clock = Instant::now();
    let observations = observe(&sampling, &Session::in_memory())?;
    let summary = analyse(&sampling, &observations, &Session::in_memory())?;
    let magnitude = summary.values.ok_or("too few observations succeeded")?;
    println!("deflection {:.3} mm +- {:.3} mm ({:.2?})", magnitude.mean, magnitude.std, clock.elapsed());
    let mut effects: Vec<_> = summary.signed_effects.iter().collect();
    effects.sort_by(|a, b| b.1.effect.abs().total_cmp(&a.1.effect.abs()));
    for (parameter, effect) in effects.iter().take(5) {
        println!("{parameter:16} {:+.4} mm  [{:+.4}, {:+.4}]", effect.effect, effect.low, effect.high);
    }
    Ok(())
}
