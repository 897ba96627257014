//! The part of `cargo xtask caroca-study` on real cables (sections 4.2.1 to 4.2.3 of the paper).
//!
//! It prints Table 2 beside the moduli that follow from its record, runs a cycle of the payload, and compares
//! the paper's deflections with those of a modulus that depends on the tension.

#![allow(clippy::print_stdout)]

use crate::cargo::{answer, cdpr, number, output, read_json, root};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;

/// Summary that each row of the table of deflections is read from, and its label.
const ROWS: [(&str, &str); 3] = [
    ("summary.json", "E = 102.2 GPa ± 2 GPa, as in the paper"),
    ("cable/operating-point/summary.json", "E of the cables' law at their tensions ± 2 GPa"),
    ("cable/law/summary.json", "the law in the model"),
];
const STUDIES: [&str; 2] = ["operating-point", "law"];

/// Adds to the results in `out`; `settings` are options of `cdpr study run` other than its folder.
pub(crate) fn run(out: &Path, settings: &[&str]) -> Result<(), String> {
    let folder = out.join("cable");
    std::fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let data = |file: &str| root().join("data").join(file).display().to_string();
    let figure = |name: &str| folder.join(name).display().to_string();
    let (record, table) = (data("cables/caroca-4mm-record.csv"), data("cables/caroca-4mm.json"));
    let (robot, law) = (data("robots/caroca.json"), data("cables/caroca-4mm-law.json"));
    let moduli = moduli(&record, &read_json(Path::new(&table))?, &figure("loop.svg"))?;
    let cycle = [
        "hysteresis",
        &robot,
        "--law",
        &law,
        "--pose",
        "0,0,1.75",
        "--payload",
        "50",
        "--figure",
        &figure("cycle.svg"),
    ];
    let mut text = format!("{moduli}\n{}\n", output(&cycle, &[0])?);
    for study in STUDIES {
        let (file, results) = (data(&format!("studies/caroca-{study}.json")), figure(study));
        let arguments = [
            &["--out".to_owned(), results][..],
            &settings.iter().map(ToString::to_string).collect::<Vec<_>>(),
        ]
        .concat();
        cdpr(&["study", "run", &file], &arguments)?;
    }
    write!(text, "{}", moved(out)?).map_err(|error| error.to_string())?;
    print!("{text}");
    let path = folder.join("cable.txt");
    std::fs::write(&path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    println!("\ntables and pictures of the cable in {}", folder.display());
    Ok(())
}

/// Moduli of a published table next to those that follow from its record, with the loop as a figure.
///
/// Those agree whose computed modulus rounds to the published one.
fn moduli(record: &str, table: &Value, figure: &str) -> Result<String, String> {
    let ranges = table["ranges"].as_array().ok_or("the published table has no ranges")?;
    let ranges: Vec<String> = ranges.iter().map(|range| format!("{}-{}", range[0], range[1])).collect();
    let [force, section] = [&table["breaking_force"], &table["section"]].map(ToString::to_string);
    let mut command = vec!["cable", "modulus", record, "--breaking-force", &force, "--section", &section];
    command.extend(["--length", "1", "--figure", figure]);
    command.extend(ranges.iter().flat_map(|range| ["--range", range]));
    let found = answer(&command, &[0])?;
    let mut text = format!("{}\n\n", table["source"].as_str().unwrap_or_default());
    for (k, range) in ranges.iter().enumerate() {
        for phase in ["loading", "unloading"] {
            let published = &table[format!("{phase}_gpa")][k];
            let computed = number(&found["ranges"][k][phase]["modulus_gpa"]);
            // 0.05 for 83.2, 0.5 for 115; the record has rounded digits, too.
            let decimals = published.to_string().split_once('.').map_or(0, |(_, decimals)| decimals.len());
            let off = (computed - number(published)).abs();
            let word = if off <= 0.5 * 0.1_f64.powi(decimals as i32) + 1e-6 { "agrees" } else { "DIFFERS" };
            writeln!(text, "{range:>6} %  {phase:<9}  published {published:>6} GPa  from the record {computed:7.2}  {word}")
                .map_err(|error| error.to_string())?;
        }
    }
    Ok(text)
}

/// Table of the deflections of Fig. 5a, and how far they move.
fn moved(out: &Path) -> Result<String, String> {
    let mut text = format!(
        "static deflection under 50 kg, ranges of Table 4\n{:<50} {:>22} {:>22}\n",
        "", "symmetric pose", "non-symmetric pose"
    );
    let mut first: Vec<f64> = Vec::new();
    for (file, words) in ROWS {
        let path = out.join(file);
        let summary = read_json(&path)?;
        let mut cells = Vec::new();
        for sampling in ["geometrical", "geometrical_asymmetric"] {
            cells.push(
                deflections(&summary, sampling)
                    .ok_or_else(|| format!("{}: no deflection of {sampling}", path.display()))?,
            );
        }
        if first.is_empty() {
            first = cells.iter().map(|(mean, _)| *mean).collect();
        }
        let cell = |((mean, std), first): (&(f64, f64), &f64)| {
            format!("{mean:.3} ± {std:.3} mm {:+3.0} %", 100.0 * (mean / first - 1.0))
        };
        let cells: Vec<String> = cells.iter().zip(&first).map(cell).collect();
        writeln!(text, "{words:<50} {:>22} {:>22}", cells[0], cells[1]).map_err(|error| error.to_string())?;
    }
    Ok(text + "mean ± standard deviation, and how far the mean moves\n")
}

/// Mean and standard deviation of a sampling in a summary [mm]; `None` for too few observations.
pub(crate) fn deflections(summary: &Value, sampling: &str) -> Option<(f64, f64)> {
    let number = |name: &str| {
        summary.pointer(&format!("/studies/{sampling}/magnitude_mm/{name}")).and_then(Value::as_f64)
    };
    number("mean").zip(number("std"))
}
