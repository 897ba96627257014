//! A calibration of CAROCA from its beginning: tolerances, study, plan, campaign, calibrated robot, study with
//! what is left. Prints its figures, and writes the robot that later studies take.

use crate::cargo::{answer, number, output, parsed, root, write};
use serde_json::Value;
use std::path::Path;

/// Noise of the tracker and of the winches.
const NOISE: &str = "position=1e-4,rotation=1e-4,length=1e-4";

/// Criteria of plans beside the one whose poses are measured.
const CRITERIA: [&str; 2] = ["information", "mean-at-work"];

pub(crate) fn run() -> Result<(), String> {
    let target = root().join("target/calibration");
    std::fs::create_dir_all(&target).map_err(|error| format!("cannot make {}: {error}", target.display()))?;
    let data = |name: &str| root().join("data/calibration").join(name).display().to_string();
    let at = |name: &str| target.join(name).display().to_string();
    let robot = root().join("data/robots/caroca.json").display().to_string();
    let (model, candidates) = (data("caroca-tolerances.json"), data("caroca-candidates.csv"));
    let (plan, campaign, calibrated) = (at("plan.csv"), at("campaign.csv"), at("calibrated"));
    for output in ["position", "deflection"] {
        study(&target, &format!("{output}-before"))?;
    }
    for criterion in CRITERIA.into_iter().rev() {
        let choose =
            ["calibrate", "plan", &robot, "--poses", &candidates, "--number", "20", "--uncertainty", &model];
        let work = ["--work=-1.5:1.5:3,-0.8:0.8:3,1.5:2:2", "--noise", "position=1e-4,rotation=1e-4"];
        let out = ["--with", &format!("criterion={criterion}"), "--out", &plan];
        let found = answer(&[&choose[..], &work, &out].concat(), &[0])?;
        for (set, name) in [("plan", criterion), ("random", "random"), ("outermost", "outermost")] {
            let of = |field: &str| number(&found[set][field]);
            println!(
                "20 poses, {name}: {:.2} bit, {:.2} % of the std of parameters left, {:.4} mm at work in the \
                 mean, {:.4} mm at the worst",
                of("information_bits"),
                100.0 * of("parameters"),
                1e3 * of("mean_at_work"),
                1e3 * of("worst_at_work")
            );
        }
    }
    let simulate =
        ["calibrate", "simulate", &robot, "--poses", &plan, "--seed", "1", "--uncertainty", &model];
    output(&[&simulate[..], &["--noise", NOISE, "--out", &campaign]].concat(), &[0])?;
    let fit = ["calibrate", "fit", &robot, &campaign, "--uncertainty", &model, "--noise", NOISE];
    let summary = answer(&[&fit[..], &["--out", &calibrated]].concat(), &[0])?;
    let parameters = summary["parameters"].as_object().ok_or("no parameters")?;
    let told = parameters.values().filter(|of| of["identifiable"] == true).count();
    println!(
        "{} rows: chi-square {:.1} with {} degrees of freedom, {told} of {} identifiable; position {:.4} mm \
         before, {:.4} mm after; left out {:.4} mm",
        summary["rows"],
        number(&summary["chi_square"]),
        summary["degrees_of_freedom"],
        parameters.len(),
        1e3 * number(&summary["position_std_before"]),
        1e3 * number(&summary["position_std_after"]),
        1e3 * number(&summary["residuals"]["position"]["rms_predicted"])
    );
    for name in ["before", "after"] {
        let map = summary["workspace"][name].as_array().ok_or("no map")?;
        let of = || map.iter().filter_map(Value::as_f64).map(|std| 1e3 * std);
        let (least, greatest) = (of().fold(f64::INFINITY, f64::min), of().fold(0.0, f64::max));
        println!("position over the workspace, {name}: {least:.4} mm to {greatest:.4} mm");
    }
    for name in ["calibrated", "posterior"] {
        copy(
            &target.join(format!("calibrated/{name}.json")),
            Path::new(&data(&format!("caroca-{name}.json"))),
        )?;
    }
    for output in ["position", "deflection"] {
        study(&target, &format!("{output}-after"))?;
    }
    Ok(())
}

/// Runs a study of the example and prints its means.
fn study(target: &Path, name: &str) -> Result<(), String> {
    let file = root().join("data/calibration").join(format!("{name}.json")).display().to_string();
    let out = target.join(name);
    output(&["study", "run", &file, "--out", &out.display().to_string(), "--overwrite"], &[0])?;
    let summary = parsed(&read(&out.join("summary.json"))?)?;
    for (sampling, of) in summary["studies"].as_object().ok_or("no studies")? {
        let fields = of.as_object().ok_or("no sampling")?;
        let statistics = fields.iter().find(|(name, of)| name.ends_with("_mm") && of["mean"].is_number());
        let (_, of) = statistics.ok_or("no statistics")?;
        println!("{name}, {sampling}: {:.4} ± {:.4} mm", number(&of["mean"]), number(&of["std"]));
    }
    Ok(())
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    write(to, &read(from)?)
}
