//! `cdpr analyse`: tables of users and of studies.

use crate::common::{Bench, answered, cdpr, cdpr_in, data_path, text, unwrapped};
use serde_json::{Value, json};
use tempfile::TempDir;

fn json_of(arguments: &[&str]) -> Value {
    serde_json::from_str(&answered(cdpr(&[arguments, &["--format", "json"]].concat()))).unwrap()
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
    let certain =
        printed.lines().find(|line| line.starts_with("y: 3 of 4 inputs are certain to matter: ")).unwrap();
    assert!(["x1", "x2", "x3"].iter().all(|x| certain.contains(x)) && !certain.contains("x4"), "{printed}");
    assert!(printed.contains("not analysed: status"), "{printed}");
}

/// What a table says, and the exit code.
fn of_table(name: &str) -> (Value, i32) {
    let output = cdpr(&["analyse", &data_path(&format!("tables/{name}")), "--format", "json"]);
    let code = output.status.code().unwrap();
    (serde_json::from_str(&text(output.stdout)).unwrap(), code)
}

#[test]
fn tables_of_designs_and_of_words_have_their_shares_and_contrasts() {
    let (found, code) = of_table("switch-40-percent.csv");
    let switch = &found["outputs"]["y"]["inputs"][0];
    assert_eq!(code, 0);
    assert!((switch["half"]["effect"].as_f64().unwrap() - 4.91).abs() < 0.005, "{switch}");
    assert!((switch["first"]["value"].as_f64().unwrap() - 0.988).abs() < 0.002, "{switch}");
    assert_eq!(found["outputs"]["y"]["verdict"]["certain"][0]["input"], json!("switch"));

    let (found, _) = of_table("two-factors-three-levels.csv");
    let inputs = &found["outputs"]["y"]["inputs"];
    for (input, exact) in [(0, 0.892857), (1, 0.107143)] {
        let shares = &inputs[input]["shares"];
        assert!((shares["closed"].as_f64().unwrap() - exact).abs() < 1e-5, "{shares}");
        assert!((shares["total"].as_f64().unwrap() - exact).abs() < 1e-5, "{shares}");
    }
    // Of 9 different rows the tests, which look at one input at a time, find A; the shares have the 11 % of
    // B.
    let certain = found["outputs"]["y"]["verdict"]["certain"].as_array().unwrap();
    assert_eq!(certain.iter().map(|of| &of["input"]).collect::<Vec<_>>(), [&json!("A")]);

    let (found, code) = of_table("l9-text-levels.csv");
    assert_eq!((&found["inputs"], code), (&json!(["temp", "mat", "speed"]), 0));
    let of = &found["outputs"]["y"];
    assert_eq!(of["inputs"][0]["levels"][0], json!({"level": "high", "rows": 3, "mean": 94.0 / 3.0}));
    assert_eq!(of["inputs"][0]["half"], Value::Null);
    assert!(of["inputs"][0]["first"]["value"].as_f64().unwrap() > 0.9, "{of}");
    assert_eq!(of["verdict"]["certain"][0]["input"], json!("temp"), "{}", of["verdict"]);
}

#[test]
fn what_a_table_may_not_mean_is_asked_and_ends_with_three() {
    let folder = TempDir::new().unwrap();
    let table = folder.path().join("odd.csv");
    let wave = |row: usize, k: f64| (k * (row * row) as f64).sin();
    let rows = (1..=123).map(|row| {
        let y = if row == 60 { 1e6 } else { wave(row, 0.7) };
        format!("{row},{},4,{},{y}\n", wave(row, 0.7), wave(row, 0.7) + 0.1)
    });
    std::fs::write(&table, format!("run,x,c,y1,y2\n{}", rows.collect::<String>())).unwrap();
    let output = cdpr(&["analyse", table.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(3));
    let printed = text(output.stdout);
    for words in [
        "question: y1 looks like an output and is taken for an input of y2",
        "question: input `run` numbers the rows",
        "question: input `c` is constant",
        "question: 1 value of the output lies 1.000e6 or more from the median",
        "related, cause or not: ",
        "y1: depends on `x`",
    ] {
        assert!(printed.contains(words), "{words}: {printed}");
    }
    let named = cdpr(&["analyse", table.to_str().unwrap(), "--input", "x", "--output", "y1"]);
    assert_eq!(named.status.code(), Some(0), "{}", text(named.stdout));
}

#[test]
fn counts_without_end_are_refused_before_anything_is_computed() {
    let folder = TempDir::new().unwrap();
    let wide = folder.path().join("wide.csv");
    let line =
        |row: usize| (0..3000).map(|k| ((row * k) % 97).to_string()).collect::<Vec<_>>().join(",") + "\n";
    std::fs::write(&wide, (1..=20).map(line).collect::<String>()).unwrap();
    let wider = folder.path().join("wider.csv");
    let line = |row: usize| vec![row.to_string(); 60_000].join(",") + "\n";
    std::fs::write(&wider, (1..=9).map(line).collect::<String>()).unwrap();
    let begun = std::time::Instant::now();
    for (arguments, code, words) in [
        (vec![wide.to_str().unwrap()], 1, "inputs = 2999: expected 1 to 1000"),
        (vec![wider.to_str().unwrap()], 1, "inputs = 59999: expected 1 to 1000"),
    ] {
        let output = cdpr(&[&["analyse"], &arguments[..]].concat());
        assert_eq!(output.status.code(), Some(code), "{arguments:?}");
        let message = unwrapped(output.stderr);
        assert!(message.contains(words), "{message}");
    }
    // Compared one by one, 60 000 names take half a minute.
    assert!(begun.elapsed().as_secs() < 15, "{:?}", begun.elapsed());
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
    // Three rows failed: y has no number there, x4 has one.
    let usual = json_of(&["analyse", &table, "--vector", "y,x4"]);
    assert_eq!((&usual["inputs"], &usual["unused"]), (&json!(["x1", "x2", "x3"]), &json!(["status"])));
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
    // As on the terminal: no number whose interval is wider, and inputs in the order of the verdict.
    let measures =
        page.split("<caption>Measures of each input").nth(1).unwrap().split("</table>").next().unwrap();
    assert!(measures.contains("not resolved") && !measures.contains('\u{b1}'), "{measures}");
    let place = |input: &str| measures.find(&format!(">{input}<")).unwrap();
    assert!(place("x2") < place("x1") && place("x1") < place("x3"), "{measures}");
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
    });
    let run = ["study", "run", "study.json", "--out", "results", "--observations", "100"];
    answered(cdpr_in(&bench.path("."), &run));
    let several = cdpr_in(&bench.path("."), &["analyse", "results"]);
    assert_eq!(several.status.code(), Some(1));
    assert!(unwrapped(several.stderr).contains("mechanical"));
    let printed =
        answered(cdpr_in(&bench.path("."), &["analyse", "results/mechanical.csv", "--format", "json"]));
    let found: Value = serde_json::from_str(&printed).unwrap();
    let inputs = found["inputs"].as_array().unwrap();
    assert!(inputs.iter().all(|name| name.as_str().unwrap().starts_with("d_")));
    assert_eq!(found["outputs"].as_object().unwrap().keys().collect::<Vec<_>>(), ["magnitude_mm"]);
}

#[test]
fn inputs_that_are_certain_in_the_own_table_of_a_study_have_a_share_and_the_cause_is_among_them() {
    // The modulus has more than 99 % of the deflection of CAROCA and CoGiRo, and 76 % of that of IPAnema 1.
    for (robot, rows) in
        [("caroca", "200"), ("caroca", "500"), ("caroca", "2000"), ("cogiro", "500"), ("ipanema-1", "500")]
    {
        let folder = TempDir::new().unwrap();
        cdpr_in(folder.path(), &["study", "new", robot, "--out", "study.json"]);
        let path = folder.path().join("study.json");
        let mut study: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
        (study["surfaces"], study["replicates"]) = (json!({}), json!(0));
        study.as_object_mut().unwrap().remove("sensitivity");
        std::fs::write(&path, study.to_string()).unwrap();
        cdpr_in(folder.path(), &["study", "run", "study.json", "--out", "results", "--observations", rows]);
        let analyse = ["analyse", "results/all.csv", "--output", "dz_mm", "--format", "json"];
        let found: Value = serde_json::from_str(&answered(cdpr_in(folder.path(), &analyse))).unwrap();
        assert_eq!(found["inputs"].as_array().unwrap().len(), 62);
        let verdict = &found["outputs"]["dz_mm"]["verdict"];
        let names = |list: &str| -> Vec<String> {
            let found = verdict[list].as_array().unwrap().iter();
            found.map(|of| of["input"].as_str().unwrap().to_owned()).collect()
        };
        // All other inputs of CAROCA and CoGiRo have less than 0.5 %, those of IPAnema but two about 2 %.
        let certain = names("certain");
        assert_eq!(certain[0], "d_youngs_modulus", "{robot}, {rows} rows: {verdict}");
        assert!(certain.len() == 1 || robot == "ipanema-1", "{robot}, {rows} rows: {certain:?}");
        assert!(certain[1..].iter().all(|name| name.starts_with("d_cog")), "{robot}: {certain:?}");
        let concerns = verdict["conditions"].as_array().unwrap().iter();
        assert!(concerns.clone().any(|of| of["concern"] == json!("sequence")), "{robot}: {verdict}");
    }
}

#[test]
fn the_own_table_of_a_study_has_shares_by_the_expansion_and_says_so() {
    let bench = Bench::new("caroca.json", |study| {
        (study["surfaces"], study["replicates"]) = (json!({}), json!(0));
        study.as_object_mut().unwrap().remove("sensitivity");
    });
    let run = ["study", "run", "study.json", "--out", "results", "--observations", "500"];
    answered(cdpr_in(&bench.path("."), &run));
    let printed = answered(cdpr_in(&bench.path("."), &["analyse", "results/mechanical.csv"]));
    assert!(printed.contains("(expansion)"), "{printed}");
    assert!(printed.contains("and these are of a sequence"), "{printed}");
}

#[test]
fn counts_of_one_are_in_the_singular_and_columns_of_words_and_numbers_are_questioned() {
    let folder = TempDir::new().unwrap();
    let wave = |row: usize| (0.7 * (row * row) as f64).sin();
    let mut rows: String =
        (0..40).map(|row| format!("{},{},{}\n", wave(row), wave(row + 50), wave(row))).collect();
    rows.push_str(",0.5,0.25\n");
    std::fs::write(folder.path().join("t.csv"), format!("x,z,y\n{rows}")).unwrap();
    let printed = answered(cdpr_in(folder.path(), &["analyse", "t.csv", "--limit", "y<0.999", "--details"]));
    for words in ["t.csv: 41 rows, 2 inputs, 1 output", "1 row is left out: ", "model: 1 term up to degree 1"]
    {
        assert!(printed.contains(words), "{words}: {printed}");
    }
    let mixed = |row: usize| if row.is_multiple_of(3) { format!("{row}.5") } else { format!("word {row}") };
    let rows: String = (0..40).map(|row| format!("{},{},{}\n", wave(row), mixed(row), wave(row))).collect();
    std::fs::write(folder.path().join("t.csv"), format!("x,load,y\n{rows}")).unwrap();
    let output = cdpr_in(folder.path(), &["analyse", "t.csv"]);
    let printed = text(output.stdout);
    assert_eq!(output.status.code(), Some(3), "{printed}");
    let question =
        "question: column load is taken for words and not analysed: line 3 has `word 1` and line 2 has `0.5`";
    assert!(printed.contains(question), "{printed}");
    let named = cdpr_in(folder.path(), &["analyse", "t.csv", "--input", "x", "--output", "y"]);
    assert_eq!(named.status.code(), Some(0), "{}", text(named.stdout));
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
        (vec!["--with", "confidence=1.5"], 1, "level = 1.5: expected a number between 0 and 1"),
    ] {
        let output = cdpr(&[&["analyse", table.as_str()], &arguments[..]].concat());
        assert_eq!(output.status.code(), Some(code), "{arguments:?}");
        let message = unwrapped(output.stderr);
        assert!(message.contains(words), "{message}");
    }
}
