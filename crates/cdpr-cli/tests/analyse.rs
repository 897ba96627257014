//! `cdpr analyse`: tables of users and of studies.

use crate::common::{Bench, answered, cdpr, cdpr_in, data_path, text};
use serde_json::{Value, json};
use tempfile::TempDir;

fn json_of(arguments: &[&str]) -> Value {
    serde_json::from_str(&answered(cdpr(&[arguments, &["--json"]].concat()))).unwrap()
}

#[test]
fn a_table_with_failed_rows_says_which_inputs_matter_and_which_rows_failed() {
    let table = data_path("tables/ishigami.csv");
    let found = json_of(&["analyse", &table, "--limit", "y<9"]);
    assert_eq!(found["inputs"], json!(["x1", "x2", "x3", "x4"]));
    let bad: Vec<&Value> =
        found["first_bad_cells"].as_array().unwrap().iter().map(|cell| &cell["row"]).collect();
    assert_eq!(bad, [17, 230, 411]);
    let analysis = &found["outputs"]["y"];
    assert_eq!((&analysis["summary"]["count"], &analysis["summary"]["failed"]), (&json!(497), &json!(3)));
    let p = |k: usize| analysis["inputs"][k]["dependence"]["p_value"].as_f64().unwrap();
    assert!(p(0) < 1e-4 && p(1) < 0.05 && p(2) < 1e-4 && p(3) > 0.05);
    // The exact shares are 0.314 and 0.442.
    let first = |k: usize| analysis["inputs"][k]["first"]["value"].as_f64().unwrap();
    assert!((first(0) - 0.314).abs() < 0.1 && (first(1) - 0.442).abs() < 0.1);
    let printed = answered(cdpr(&["analyse", &table]));
    assert!(printed.contains("no number: row 230, column y: empty"), "{printed}");
    assert!(printed.contains("certain to matter (p < 0.05 / 4): x1, x3, x2"), "{printed}");
}

#[test]
fn a_vector_of_columns_has_an_index_for_each_input() {
    let table = data_path("tables/ishigami.csv");
    let found = json_of(&["analyse", &table, "--input", "x1,x2,x3", "--vector", "y,x4"]);
    assert_eq!(found["vector"]["columns"], json!(["y", "x4"]));
    let index = |input: &str, of: &str, end: &str| found["vector"]["bures"][input][of][end].as_f64().unwrap();
    // Half of the first-order indices 0.314 and 0.442, of 13.8 of the variance 13.8 + 3.3.
    for (input, share) in [("x1", 0.314), ("x2", 0.442), ("x3", 0.0)] {
        let exact = 0.5 * share * 13.8 / (13.8 + std::f64::consts::PI.powi(2) / 3.0);
        assert!((index(input, "means", "value") - exact).abs() < 0.05, "{input}");
        assert!(index(input, "index", "low") < index(input, "index", "high"));
    }
    assert!(index("x3", "index", "value") > 0.03, "x3 changes the spread of y");
    let printed = answered(cdpr(&["analyse", &table, "--vector", "y"]));
    assert!(printed.contains("(y): how much an input moves the law of this vector"), "{printed}");
}

#[test]
fn the_same_table_gives_the_same_numbers_on_any_number_of_threads() {
    let table = data_path("tables/ishigami.csv");
    let on = |threads: &str| json_of(&["analyse", &table, "--threads", threads]);
    assert_eq!(on("1"), on("3"));
}

#[test]
fn a_report_is_written_over_the_one_in_its_own_folder_on_request_and_over_no_other() {
    let folder = TempDir::new().unwrap();
    let table = data_path("tables/ishigami.csv");
    let analyse = ["analyse", &table, "--out", "analysis"];
    answered(cdpr_in(folder.path(), &analyse));
    assert_eq!(cdpr_in(folder.path(), &analyse).status.code(), Some(1));
    answered(cdpr_in(folder.path(), &[&analyse[..], &["--overwrite"]].concat()));
    let page = std::fs::read_to_string(folder.path().join("analysis/report.html")).unwrap();
    assert!(page.contains("<circle") && page.contains("<polyline") && !page.contains("<script"));
    std::fs::create_dir(folder.path().join("mine")).unwrap();
    std::fs::write(folder.path().join("mine/report.html"), "mine").unwrap();
    assert!(!cdpr_in(folder.path(), &["analyse", &table, "--out", "mine"]).status.success());
    assert_eq!(std::fs::read_to_string(folder.path().join("mine/report.html")).unwrap(), "mine");
}

#[test]
fn a_folder_of_results_has_the_deviations_as_inputs_and_the_last_column_as_output() {
    let bench = Bench::new("caroca.json", |study| {
        study["surfaces"] = json!({});
        study["replicates"] = json!(0);
        study.as_object_mut().unwrap().remove("comparison");
    });
    let run = ["study", "run", "study.json", "--out", "results", "--observations", "100"];
    answered(cdpr_in(&bench.path("."), &run));
    let several = cdpr_in(&bench.path("."), &["analyse", "results"]);
    assert_eq!(several.status.code(), Some(1));
    assert!(text(several.stderr).contains("mechanical"));
    let printed =
        answered(cdpr_in(&bench.path("."), &["analyse", "results", "--table", "mechanical", "--json"]));
    let found: Value = serde_json::from_str(&printed).unwrap();
    let inputs = found["inputs"].as_array().unwrap();
    assert!(inputs.iter().all(|name| name.as_str().unwrap().starts_with("d_")));
    assert_eq!(found["outputs"].as_object().unwrap().keys().collect::<Vec<_>>(), ["rms_mm"]);
}

#[test]
fn wrong_columns_limits_and_tables_are_refused_with_what_would_be_right() {
    let table = data_path("tables/ishigami.csv");
    for (arguments, code, words) in [
        (vec!["--output", "z"], 1, "output is z: expected a column of numbers, one of x1, x2, x3, x4, y"),
        (vec!["--input", "x*", "--output", "x1"], 1, "input is x1: expected a column that is no output"),
        (vec!["--vector", "z"], 1, "vector is z: expected a column of numbers"),
        (vec!["--limit", "y=3"], 2, "expected COLUMN<VALUE, with <, <=, > or >="),
        (vec!["--output", "status"], 1, "output is status"),
        (vec!["--level", "1.5"], 1, "level = 1.5: expected a number between 0 and 1"),
    ] {
        let output = cdpr(&[&["analyse", table.as_str()], &arguments[..]].concat());
        assert_eq!(output.status.code(), Some(code), "{arguments:?}");
        let message = text(output.stderr);
        assert!(message.contains(words), "{message}");
    }
}
