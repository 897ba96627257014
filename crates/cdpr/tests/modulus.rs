//! `cdpr cable modulus` and `cdpr cable density` as a user meets them.

use crate::common::{cdpr, data_path, text, unwrapped};
use serde_json::Value;
use std::process::Output;

fn record() -> String {
    data_path("cables/caroca-4mm-record.csv")
}

fn modulus(record: &str, more: &[&str]) -> Output {
    let specimen = ["--breaking-force", "10290", "--section", "1.2566370614e-5", "--length", "1"];
    cdpr(&[&["cable", "modulus", record], &specimen[..], more].concat())
}

#[test]
fn moduli_of_several_ranges_come_as_json_and_the_loop_as_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let figure = folder.path().join("loop.svg");
    let more =
        ["--range", "5-10", "--range", "10-20", "--format", "json", "--figure", figure.to_str().unwrap()];
    let output = modulus(&record(), &more);
    assert!(output.status.success(), "{}", unwrapped(output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let number = |path: &str| found.pointer(path).and_then(Value::as_f64).unwrap();
    assert!((number("/ranges/0/loading/modulus_gpa") - 83.2).abs() < 1e-6);
    assert!((number("/ranges/1/unloading/modulus_gpa") - 105.1).abs() < 1e-6);
    assert!(number("/ranges/0/loading/standard_uncertainty_gpa") > 7.0);
    assert!(number("/dissipated_energy_j") > 0.0);
    assert!(std::fs::read_to_string(figure).unwrap().contains("elongation [mm]"));
    // The answer is first, and no word of the header is broken.
    let printed = text(modulus(&record(), &["--range", "5-10"]).stdout);
    assert!(printed.starts_with("83.20 GPa +- "), "{printed}");
    for header in [" phase ", " modulus [GPa] ", " independent ", " greatest "] {
        assert!(printed.contains(header), "{printed}");
    }
}

#[test]
fn the_law_of_a_record_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let law = folder.path().join("law.json");
    let output = modulus(&record(), &["--range", "5-10", "--law", law.to_str().unwrap()]);
    assert!(output.status.success(), "{}", unwrapped(output.stderr));
    let law = cdpr_study::open_law(&law).unwrap();
    assert!(
        (law.loading[1].modulus / 8.32e10 - 1.0).abs() < 1e-9
            && law.unloading.unwrap().turning_tension == 3087.0
    );
}

#[test]
fn a_breaking_force_in_another_unit_is_questioned() {
    let all = [
        "--breaking-force",
        "10.29",
        "--section",
        "1.2566370614e-5",
        "--length",
        "1",
        "--range",
        "10000-20000",
    ];
    let said = unwrapped(cdpr(&[&["cable", "modulus", &record()], &all[..]].concat()).stderr);
    assert!(
        said.contains("--breaking-force is 10.290 N: less than the greatest force of the record, 3087.000 N"),
        "{said}"
    );
}

#[test]
fn a_loop_that_gives_energy_is_questioned() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("exchanged.csv");
    let record = std::fs::read_to_string(record()).unwrap();
    let mut lines: Vec<&str> = record.lines().filter(|line| line.contains("loading")).collect();
    // Run through from its end, the loop is the same the other way round.
    lines.reverse();
    let exchanged: Vec<String> = lines
        .iter()
        .map(|line| match line.strip_suffix(",unloading") {
            Some(numbers) => format!("{numbers},loading\n"),
            None if line.starts_with("3087,") => format!("{line}\n"),
            None => line.replace(",loading", ",unloading\n"),
        })
        .collect();
    std::fs::write(&file, format!("force_n,elongation_mm,phase\n{}", exchanged.concat())).unwrap();
    let output = modulus(file.to_str().unwrap(), &["--range", "5-10"]);
    let said = unwrapped(output.stderr);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("less than zero: a cable gives no energy"), "{said}");
}

#[test]
fn what_cannot_be_answered_ends_with_an_error_that_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let bad = folder.path().join("bad.csv");
    std::fs::write(
        &bad,
        "force_n,elongation_mm,phase\n1,1,loading\n1,2,loading\n1,1,unloading\n0,0,unloading\n",
    )
    .unwrap();
    for (record, range, words) in [
        (record().as_str(), "30-40", "the range 30 to 40 % of the breaking force is not in the record"),
        (record().as_str(), "30-10", "range is 10: expected an upper end above the lower one"),
        (bad.to_str().unwrap(), "5-10", "bad.csv: line 3: force_n is 1: expected more than 1 of line 2"),
        ("no-such-file.csv", "5-10", "cannot read no-such-file.csv"),
    ] {
        let output = modulus(record, &["--range", range]);
        let message = unwrapped(output.stderr);
        assert!(!output.status.success() && output.stdout.is_empty() && message.contains(words), "{message}");
    }
}

#[test]
fn a_weighing_gives_the_linear_density_with_its_error() {
    let weighing = ["--mass", "0.203", "--length", "2", "--errors", "mass=0.001,length=0.001"];
    let output = cdpr(&[&["cable", "density"], &weighing[..], &["--format", "json"]].concat());
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!((found["linear_density_kg_per_m"].as_f64().unwrap() - 0.1015).abs() < 1e-12);
    assert!((found["error_kg_per_m"].as_f64().unwrap() - 5.5075e-4).abs() < 1e-12);
    let refused = cdpr(&["cable", "density", "--mass", "1", "--length", "0"]);
    assert!(!refused.status.success());
    assert!(unwrapped(refused.stderr).contains("length is 0: expected a length"));
}
