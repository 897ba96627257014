//! The part of `cargo xtask caroca-study` on how CAROCA is built: with the pulleys that lead its cables, and
//! with the cable behind them.
//!
//! The study of Table 4 runs again on the robot with pulleys, with leads, and with both.

#![allow(clippy::print_stdout)]

use crate::cable::deflections;
use crate::cargo::{Outcome, number, read_json, root, study as run_study, write};
use serde_json::json;
use std::fmt::Write as _;
use std::path::Path;

/// Radius of the pulleys of CAROCA [m], in its model of CASPR (BSD-3).
const RADIUS: f64 = 0.045;

/// Cable between winch and pulley [m]: about the height of the frame.
const LEAD: f64 = 3.0;

/// Name of the folder, words of the table, whether there are pulleys and leads.
const ROBOTS: [(&str, &str, [bool; 2]); 3] = [
    ("pulleys", "pulleys of 45 mm", [true, false]),
    ("leads", "leads of 3 m", [false, true]),
    ("both", "pulleys of 45 mm and leads of 3 m", [true, true]),
];

const SAMPLINGS: [&str; 2] = ["geometrical", "geometrical_asymmetric"];

/// Parameters of the table.
const LARGEST: usize = 5;

/// Adds to the results in `out`; `settings` are options of `cdpr study run` other than its folder.
pub(crate) fn run(out: &Path, settings: &[String]) -> Outcome {
    let folder = out.join("led");
    let data = |file: &str| read_json(&root().join("data").join(file));
    let (robot, study) = (data("robots/caroca.json")?, data("studies/caroca.json")?);
    let mut summaries = vec![("as in the paper", out.join("summary.json"))];
    for (name, words, [pulleys, leads]) in ROBOTS {
        let (mut robot, mut study) = (robot.clone(), study.clone());
        robot["name"] = json!(format!("CAROCA with {words}"));
        let errors = &mut study["error_models"]["table_4"];
        let law = |half: f64| json!({"law": {"uniform": {"min": -half, "max": half}}});
        if pulleys {
            robot["pulley"] = json!({"radius": RADIUS, "axis": [0, 0, 1]});
            (errors["r"], errors["tilt"]) = (law(5e-4), law(0.01));
        }
        if leads {
            robot["lead"] = json!(LEAD);
            errors["lead"] = law(0.05);
        }
        let samplings = study["samplings"].as_object_mut().ok_or("the study has no samplings")?;
        samplings.retain(|sampling, _| SAMPLINGS.contains(&sampling.as_str()));
        study["name"] = robot["name"].clone();
        study["robot"] = json!(format!("{name}-robot.json"));
        study.as_object_mut().map(|study| study.remove("surfaces"));
        let path = |suffix: &str| folder.join(format!("{name}-{suffix}.json"));
        for (suffix, value) in [("robot", &robot), ("study", &study)] {
            write(&path(suffix), &format!("{value:#}\n"))?;
        }
        run_study(&path("study"), &folder.join(name), settings)?;
        summaries.push((words, folder.join(name).join("summary.json")));
    }
    let text = compared(&summaries)?;
    print!("{text}");
    write(&folder.join("led.txt"), &text)
}

/// Deflections and largest parameters of each summary.
fn compared(summaries: &[(&str, std::path::PathBuf)]) -> Outcome<String> {
    let mut text =
        "static deflection under 50 kg, ranges of Table 4, radii ± 0.5 mm, axes ± 10 mrad, leads ± 50 mm\n"
            .to_owned();
    for sampling in SAMPLINGS {
        let mut first = None;
        writeln!(text, "\n{sampling}")?;
        for (words, path) in summaries {
            let summary = read_json(path)?;
            let (mean, std) = deflections(&summary, sampling)?;
            let moved = 100.0 * (mean / *first.get_or_insert(mean) - 1.0);
            let effects = summary["studies"][sampling]["t_student"].as_object();
            let mut effects: Vec<_> =
                effects.into_iter().flatten().map(|(name, t)| (name, number(t))).collect();
            effects.retain(|(_, t)| t.is_finite());
            effects.sort_by(|one, other| other.1.total_cmp(&one.1));
            let largest: Vec<_> =
                effects.iter().take(LARGEST).map(|(name, t)| format!("{name} {t:.1}")).collect();
            writeln!(text, "  {words:<36} {mean:.3} ± {std:.3} mm {moved:+4.0} %   {}", largest.join(", "))?;
        }
    }
    Ok(text + "mean ± standard deviation, how far the mean moves, and the largest t-Student indices\n")
}
