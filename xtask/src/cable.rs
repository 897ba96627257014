//! The part of `cargo xtask caroca-study` on real cables (sections 4.2.1 to 4.2.3 of the paper).
//!
//! It prints Table 2 next to the moduli that follow from its record, runs a cycle of the payload, and
//! compares the paper's deflections with those of a modulus that depends on the tension.

#![allow(clippy::print_stdout)]

use crate::cargo::{
    Outcome, answer, cdpr_command, made, number, read_json, root, study as run_study, text, text_of, write,
};
use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;

/// Summary that each row of the table of deflections is read from, and its label.
const ROWS: [(&str, &str); 3] = [
    ("summary.json", "E = 102.2 GPa ± 2 GPa, as in the paper"),
    ("cable/operating-point/summary.json", "E of the cables' law at their tensions ± 2 GPa"),
    ("cable/law/summary.json", "the law in the model"),
];
const STUDIES: [&str; 2] = ["operating-point", "law"];

/// Adds to the results in `out`; `settings` are options of `cdpr study run` other than its folder.
pub(crate) fn run(out: &Path, settings: &[String]) -> Outcome {
    let folder = out.join("cable");
    made(&folder)?;
    let data = |file: &str| root().join("data").join(file);
    let figure = |name: &str| folder.join(name).display().to_string();
    let record = data("cables/caroca-4mm-record.csv").display().to_string();
    let moduli = moduli(&record, &read_json(&data("cables/caroca-4mm.json"))?, &figure("loop.svg"))?;
    let mut cycle = cdpr_command(&["hysteresis", "caroca", "--pose", "0,0,1.75", "--payload", "50"]);
    cycle.arg("--law").arg(data("cables/caroca-4mm-law.json")).arg("--figure").arg(folder.join("cycle.svg"));
    let cycle = text_of(&mut cycle, &[0])?;
    for study in STUDIES {
        run_study(&data(&format!("studies/caroca-{study}.json")), &folder.join(study), settings)?;
    }
    let text = format!("{moduli}\n{cycle}\n{}", moved(out)?);
    print!("{text}");
    write(&folder.join("cable.txt"), &text)?;
    println!("\ntables and pictures of the cable in {}", folder.display());
    Ok(())
}

/// Moduli of a published table next to those that follow from its record, with the loop as a figure.
///
/// Those agree whose computed modulus rounds to the published one.
fn moduli(record: &str, table: &Value, figure: &str) -> Outcome<String> {
    let ranges = table["ranges"].as_array().ok_or("the published table has no ranges")?;
    let ranges: Vec<String> = ranges.iter().map(|range| format!("{}-{}", range[0], range[1])).collect();
    let [force, section] = [&table["breaking_force"], &table["section"]].map(ToString::to_string);
    let mut command = vec!["cable", "modulus", record, "--breaking-force", &force, "--section", &section];
    command.extend(["--length", "1", "--figure", figure]);
    command.extend(ranges.iter().flat_map(|range| ["--range", range]));
    let found = answer(&command, &[0])?;
    let mut lines = format!("{}\n\n", text(&table["source"]));
    for (k, range) in ranges.iter().enumerate() {
        for phase in ["loading", "unloading"] {
            let published = &table[format!("{phase}_gpa")][k];
            let computed = number(&found["ranges"][k][phase]["modulus_gpa"]);
            // 0.05 for 83.2, 0.5 for 115; the record has rounded digits, too.
            let decimals = published.to_string().split_once('.').map_or(0, |(_, decimals)| decimals.len());
            let off = (computed - number(published)).abs();
            let word = if off <= 0.5 * 0.1_f64.powi(decimals as i32) + 1e-6 { "agrees" } else { "DIFFERS" };
            let published = format!("{phase:<9}  published {published:>6} GPa");
            writeln!(lines, "{range:>6} %  {published}  from the record {computed:7.2}  {word}")?;
        }
    }
    Ok(lines)
}

/// Table of the deflections of Fig. 5a, and how far they move.
fn moved(out: &Path) -> Outcome<String> {
    let mut text = format!(
        "static deflection under 50 kg, ranges of Table 4\n{:<50} {:>22} {:>22}\n",
        "", "symmetric pose", "non-symmetric pose"
    );
    let mut first = [None; 2];
    for (file, words) in ROWS {
        let summary = read_json(&out.join(file))?;
        write!(text, "{words:<50}")?;
        for (sampling, first) in ["geometrical", "geometrical_asymmetric"].iter().zip(&mut first) {
            let (mean, std) = deflections(&summary, sampling)?;
            let moved = 100.0 * (mean / *first.get_or_insert(mean) - 1.0);
            write!(text, " {:>22}", format!("{mean:.3} ± {std:.3} mm {moved:+3.0} %"))?;
        }
        text += "\n";
    }
    Ok(text + "mean ± standard deviation, and how far the mean moves\n")
}

/// Mean and standard deviation of a sampling in a summary [mm].
pub(crate) fn deflections(summary: &Value, sampling: &str) -> Outcome<(f64, f64)> {
    let of = &summary["studies"][sampling]["magnitude_mm"];
    let both = of["mean"].as_f64().zip(of["std"].as_f64());
    Ok(both.ok_or_else(|| format!("the summary has no deflection of {sampling}: too few observations"))?)
}
