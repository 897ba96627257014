//! `cdpr study run` as a user meets it: results, and every kind of bad input.

use crate::common::{Bench, cdpr_in, text, unwrapped};
use crate::study_refused::refused;
use cdpr_robot::significant;
use serde_json::{Value, json};
use std::process::Output;

/// CAROCA and a small study of it, to be spoiled.
pub(crate) fn bench() -> Bench {
    Bench::new("caroca.json", |study| {
        study["replicates"] = json!(2);
        study["bootstrap_resamples"] = json!(10);
        for sampling in study["samplings"].as_object_mut().unwrap().values_mut() {
            sampling["observations"] = json!(64);
        }
        for surface in study["surfaces"].as_object_mut().unwrap().values_mut() {
            surface["x"]["points"] = json!(5);
            surface["y"]["points"] = json!(4);
        }
    })
}

/// Asks for the measures of sensitivity, from so few observations that those of regressions fail.
fn measure(bench: &Bench) {
    bench.change("study.json", |study| {
        study["sensitivity"] = json!({
            "observations": 20, "saltelli_blocks": 16, "morris_blocks": 4, "derivative_points": 4,
            "expansion": {"max_degree": 1, "norm": 1.0, "interactions": 1}
        });
    });
}

/// Takes out the pose that tight limits of tension do not hold.
fn leave_out_the_asymmetric_pose(bench: &Bench) {
    bench.change("study.json", |study| {
        study["samplings"].as_object_mut().unwrap().remove("geometrical_asymmetric");
    });
}

fn run(bench: &Bench, arguments: &[&str]) -> Output {
    bench.study(&[&["run", "study.json", "--out", "out"], arguments].concat())
}

/// Standard output of a run that must succeed.
fn printed(bench: &Bench, arguments: &[&str]) -> String {
    let output = run(bench, arguments);
    assert!(output.status.success(), "{}", unwrapped(output.stderr));
    text(output.stdout)
}

/// The message of a run that must fail, without panicking.
pub(crate) fn refusal(bench: &Bench, arguments: &[&str]) -> String {
    let output = run(bench, arguments);
    let text = unwrapped(output.stderr);
    assert_ne!(output.status.code(), Some(0), "{text}");
    assert!(!text.contains("panicked"), "{text}");
    text
}

fn read(bench: &Bench, file: &str) -> String {
    std::fs::read_to_string(bench.path(file)).unwrap()
}

#[test]
fn a_study_writes_tables_figures_and_a_summary() {
    let bench = bench();
    let output = run(&bench, &["--details"]);
    let (text, errors) = (text(output.stdout), unwrapped(output.stderr));
    assert!(output.status.success(), "{errors}");
    assert!(errors.is_empty(), "progress is silent when not on a terminal");
    assert!(text.contains("Mean deflection ") && text.contains("surface_E_rho"));
    let summary = bench.json("out/summary.json");
    let mechanical = &summary["studies"]["mechanical"];
    assert_eq!(mechanical["observations"], 64);
    assert_eq!(mechanical["failed"]["infeasible_tension"], 0);
    assert_eq!(mechanical["t_student"].as_object().unwrap().len(), 62);
    assert!((mechanical["magnitude_mm"]["nominal"].as_f64().unwrap() - 1.33125).abs() < 1e-4);
    assert!(mechanical["fits"].as_array().unwrap().iter().any(|fit| fit["law"] == "uniform"));
    let table = read(&bench, "out/mechanical.csv");
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(header.len(), 1 + 62 + 4 + 2);
    assert_eq!(
        (header[1], header[62], header[66], header[67]),
        ("d_mass", "d_dt8", "magnitude_mm", "status")
    );
    assert_eq!(lines.count(), 64);
    assert_eq!(read(&bench, "out/surface_E_rho.csv").lines().count(), 1 + 20);
    let report = read(&bench, "out/report.html");
    for figure in [
        "robot",
        "mechanical",
        "geometrical",
        "surface_E_rho",
        "surface_rho_m",
        "anchor_points",
        "exit_points",
    ] {
        let svg = read(&bench, &format!("out/{figure}.svg"));
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{figure}");
        // The report draws the robot in space.
        assert!(report.contains(&svg) != (figure == "robot"), "{figure}");
    }
    let printed = run(&bench, &["--resume", "--format", "json"]).stdout;
    assert_eq!(serde_json::from_slice::<Value>(&printed).unwrap(), summary);
}

#[test]
fn a_study_of_frequencies_names_them_in_every_file_and_can_be_read_again() {
    let bench = bench();
    measure(&bench);
    bench.change("robot.json", |robot| {
        robot["platform"]["inertia"] = json!([[30.0, 1.0, 0.0], [1.0, 40.0, 0.0], [0.0, 0.0, 50.0]]);
    });
    bench.change("study.json", |study| {
        study["output"] = json!("frequency");
        let plane = json!({
            "title": "Plane", "error_model": "table_4", "observations": 8,
            "poses": { "grid": {
                "x": { "min": -1.0, "max": 1.0, "points": 2 }, "y": { "min": -1.0, "max": 1.0, "points": 2 },
                "z": { "min": 1.75, "max": 1.75, "points": 1 }
            } }
        });
        let error_model = study["samplings"]["mechanical"]["error_model"].clone();
        study["samplings"]["plane"] = plane;
        study["samplings"]["plane"]["error_model"] = error_model;
    });
    let text = printed(&bench, &["--details"]);
    assert!(
        text.contains("mean [Hz]") && text.contains("Mean frequency ") && text.contains("[mHz]; t-Student"),
        "{text}"
    );
    let summary = bench.json("out/summary.json");
    let mechanical = &summary["studies"]["mechanical"];
    let frequency = &mechanical["frequency_hz"];
    let mean = frequency["mean"].as_f64().unwrap();
    assert!((mean / frequency["nominal"].as_f64().unwrap() - 1.0).abs() < 0.05, "{frequency}");
    assert_eq!(mechanical["output"], "frequency");
    assert!(mechanical["signed_effects_hz"]["youngs_modulus"]["effect"].as_f64().unwrap() > 0.0);
    assert!(mechanical["sensitivity"]["inputs"][0]["morris_std_hz"].is_number());
    assert!(summary["studies"]["plane"]["mean_hz"]["min"].is_number());
    assert!(summary["studies"]["surface_E_rho"]["frequency_hz"]["nominal"].is_number());

    let header = |file: &str| read(&bench, file).lines().next().unwrap().to_owned();
    let table = read(&bench, "out/mechanical.csv");
    assert!(header("out/mechanical.csv").ends_with(",d_dt8,frequency_hz,status,reason"));
    let values = table.lines().skip(1).map(|line| line.split(',').nth(63).unwrap().parse::<f64>().unwrap());
    assert!((values.sum::<f64>() / 64.0 - mean).abs() < 1e-9);
    assert!(header("out/plane.csv").contains(",nominal_hz,mean_hz,std_hz,min_hz,max_hz,dominant,"));
    let measures = header("out/mechanical_sensitivity.csv");
    // A frequency is no vector.
    assert!(
        measures.contains(",signed_effect_hz,") && measures.ends_with(",sobol_total_high,activity"),
        "{measures}"
    );
    assert!(header("out/surface_E_rho.csv").ends_with(",frequency_hz,status"));
    let drawn = ["mechanical", "mechanical_effects", "plane_mean", "surface_E_rho", "anchor_points"];
    for svg in drawn.map(|name| read(&bench, &format!("out/{name}.svg"))) {
        assert!(svg.contains("frequency") && !svg.contains("magnitude"), "{svg}");
    }
    let report = read(&bench, "out/report.html");
    assert!(report.contains("Lowest natural frequency [Hz]"));
    assert!(["the magnitude", "mean magnitude", "magnitude ["].iter().all(|words| !report.contains(words)));

    // What was written is read back, and printed, under the same names.
    let drawn = cdpr_in(&bench.path("."), &["study", "report", "out"]);
    assert!(drawn.status.success(), "{}", crate::common::unwrapped(drawn.stderr));
    assert_eq!(read(&bench, "out/report.html"), report);
    let status: Value = serde_json::from_str(&bench.done(&["status", "out", "--format", "json"])).unwrap();
    assert_eq!(status["samplings"]["mechanical"]["provisional_frequency_hz"]["mean"].as_f64(), Some(mean));
    let again = run(&bench, &["--resume", "--format", "json"]).stdout;
    assert_eq!(serde_json::from_slice::<Value>(&again).unwrap(), summary);
}

#[test]
fn the_files_are_the_same_on_any_number_of_threads() {
    let bench = bench();
    measure(&bench);
    let files = |threads: &str| -> Vec<Vec<u8>> {
        assert!(run(&bench, &["--overwrite", "--threads", threads]).status.success());
        ["summary.json", "geometrical_asymmetric.csv"]
            .map(|file| std::fs::read(bench.path("out").join(file)).unwrap())
            .into()
    };
    assert_eq!(files("1"), files("4"));
}

#[test]
fn measures_of_sensitivity_have_a_table_a_figure_a_part_of_the_summary_and_a_table_on_the_terminal() {
    let bench = bench();
    measure(&bench);
    let text = printed(&bench, &["--details"]);
    for words in ["Sobol' total", "sum of all", "first 10 of every measure: ", "left out: regression: "] {
        assert!(text.contains(words), "`{words}` is not in: {text}");
    }
    let summary = bench.json("out/summary.json");
    for name in ["mechanical", "geometrical", "geometrical_asymmetric"] {
        let table = read(&bench, &format!("out/{name}_sensitivity.csv"));
        let (header, rows) = table.split_once('\n').unwrap();
        // Nobody has asked for Shapley effects.
        assert_eq!(
            header,
            "input,t_student,signed_effect_mm,derivative_share,regression_share,rank_regression_share,\
             morris_mean_absolute_mm,morris_low_mm,morris_high_mm,morris_reliable,morris_std_mm,\
             dgsm_total_bound,dgsm_total_bound_high,first_lower,first_lower_low,total_lower,total_lower_low,\
             total_upper,total_upper_high,expansion_first,expansion_total,sobol_first,sobol_first_low,sobol_first_high,sobol_total,sobol_total_low,sobol_total_high,vector_first,\
             vector_first_low,vector_first_high,vector_total,vector_total_low,vector_total_high,activity"
        );
        assert_eq!((rows.lines().count(), &rows[..5]), (62, "mass,"));
        let figure = read(&bench, &format!("out/{name}_sensitivity.svg"));
        assert!(figure.starts_with("<svg"));
        let sensitivity = &summary["studies"][name]["sensitivity"];
        assert_eq!(sensitivity["methods"]["sobol"]["observations"], 16 * 64);
        assert_eq!(sensitivity["inputs"][2]["input"], "youngs_modulus");
        assert_eq!(sensitivity["inputs"][2]["regression_share"], Value::Null);
        assert!(sensitivity["sums"]["b"]["sobol_first"].is_number());
    }
}

#[test]
fn a_folder_of_results_runs_again_and_gives_the_same_summary() {
    let bench = bench();
    assert!(run(&bench, &["--observations", "40"]).status.success());
    bench.done(&["run", "out/study.json", "--out", "again"]);
    for file in ["study.json", "robot.json", "summary.json", "mechanical.csv"] {
        let [first, again] =
            ["out", "again"].map(|folder| std::fs::read(bench.path(folder).join(file)).unwrap());
        assert!(first == again, "{file}");
    }
    let study = bench.json("out/study.json");
    assert_eq!(study["robot"], "robot.json");
    assert_eq!(study["samplings"]["mechanical"]["observations"], 40);
    let timings = bench.json("out/timings.json");
    assert!(timings["all"].as_f64().unwrap() >= timings["seconds"]["surface_E_rho"].as_f64().unwrap());
}

#[test]
fn observations_that_fail_stop_nothing() {
    let bench = bench();
    // Tension limits so tight that most perturbed robots have no distribution; the nominal one has.
    bench.change("robot.json", |robot| robot["tension_limits"] = json!({"min": 500.0, "max": 650.0}));
    let output = run(&bench, &[]);
    let text = text(output.stdout);
    // At the non-symmetric pose even the nominal robot has none: that is said before anything runs.
    assert!(!output.status.success(), "{text}");
    leave_out_the_asymmetric_pose(&bench);
    // With the payload, its cables are strained beyond the limit.
    assert_eq!(run(&bench, &[]).status.code(), Some(3));
    let summary = bench.json("out/summary.json");
    let failed = summary["studies"]["mechanical"]["failed"]["infeasible_tension"].as_u64().unwrap();
    assert!(failed > 0 && failed < 64, "{failed}");
    let table = read(&bench, "out/mechanical.csv");
    assert_eq!(table.lines().filter(|line| line.contains(",infeasible_tension,")).count() as u64, failed);
}

#[test]
fn what_cannot_be_computed_from_the_observations_left_is_noted_and_the_rest_written() {
    let bench = bench();
    // Every heavier platform fails: no mean over the upper half of the mass.
    bench.change("robot.json", |robot| robot["tension_limits"] = json!({"min": 1.0, "max": 578.5}));
    leave_out_the_asymmetric_pose(&bench);
    let output = run(&bench, &["--details"]);
    assert_eq!(output.status.code(), Some(3));
    let text = text(output.stdout);
    assert!(text.contains("mechanical: t_student: input `mass`: 0 observations above the middle"), "{text}");
    let summary = bench.json("out/summary.json");
    let mechanical = &summary["studies"]["mechanical"];
    assert!(mechanical["magnitude_mm"]["mean"].as_f64().unwrap() > 1.0);
    assert_eq!(mechanical["t_student"], json!({}));
    assert!(mechanical["notes"][0].as_str().unwrap().starts_with("t_student: "));
}

#[test]
fn an_unbounded_law_at_the_first_point_of_the_sequence_names_the_field_to_change() {
    let law = json!({"law": {"normal": {"mean": 0.0, "std": 1.0}}});
    let file = "error: study.json: samplings.mechanical.first_index: ";
    refused(
        |_, s| {
            s["error_models"]["table_3"]["mass"] = law.clone();
            s["samplings"]["mechanical"]["first_index"] = json!(0);
        },
        &[file, "`mass` is unbounded below", "start at index 1"],
    );
}

#[test]
fn a_run_writes_a_report_and_so_does_its_folder_alone() {
    let bench = bench();
    assert!(run(&bench, &[]).status.success());
    let written = read(&bench, "out/report.html");
    assert!(written.starts_with("<!DOCTYPE html>") && written.contains("id=\"figure-mechanical\""));
    // The folder is complete by itself.
    let moved = bench.path("moved");
    std::fs::rename(bench.path("out"), &moved).unwrap();
    for file in ["study.json", "robot.json"] {
        std::fs::remove_file(bench.path(file)).unwrap();
    }
    let report = |arguments: &[&str]| cdpr_in(&bench.path("."), &[&["study", "report"], arguments].concat());
    let output = report(&["moved", "--out", "again.html"]);
    assert!(output.status.success(), "{}", unwrapped(output.stderr));
    assert_eq!(text(output.stdout), "report in again.html\n");
    assert!(read(&bench, "again.html") == written);

    let refusal = |expected: &str| {
        let output = report(&["moved"]);
        let text = unwrapped(output.stderr);
        assert!(!output.status.success() && text.contains(expected) && !text.contains("panicked"), "{text}");
    };
    let table = std::fs::read_to_string(moved.join("surface_E_rho.csv")).unwrap();
    std::fs::write(moved.join("surface_E_rho.csv"), table.replace("ok", "maybe,ok")).unwrap();
    refusal("surface_E_rho.csv is not what the run has written here: it was changed");
    // Without the list of files nothing says what they were.
    std::fs::remove_file(moved.join("cdpr-results.json")).unwrap();
    let short = table.trim_end().rsplit_once('\n').unwrap().0;
    std::fs::write(moved.join("surface_E_rho.csv"), short).unwrap();
    refusal("surface_E_rho.csv: rows is 19: expected a grid of 20 points");
    std::fs::write(moved.join("surface_E_rho.csv"), table.replace("ok", "maybe,ok")).unwrap();
    refusal("surface_E_rho.csv: row 1 is ");
    std::fs::write(moved.join("summary.json"), "{\"study\": 1}").unwrap();
    refusal("summary.json: line 1, column 11: study: invalid type");
    std::fs::remove_file(moved.join("summary.json")).unwrap();
    refusal("has no summary.json: analyse it with cdpr study merge");
}

#[test]
fn the_range_of_an_output_is_that_of_robots_that_differ_from_the_nominal_one() {
    let bench = bench();
    bench.change("study.json", |study| study["output"] = json!("position"));
    let text = printed(&bench, &[]).replace('\n', " ");
    let table = read(&bench, "out/mechanical.csv");
    let mut rows = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = rows.next().unwrap();
    let place = header.iter().position(|name| *name == "position_error_mm").unwrap();
    let of_row = |row: Vec<&str>| {
        let deviates = row[1..63].iter().any(|cell| cell.parse::<f64>().unwrap() != 0.0);
        (deviates, row[place].parse::<f64>().unwrap())
    };
    let rows: Vec<(bool, f64)> = rows.map(of_row).collect();
    // The second point of Sobol's sequence is the middle of all laws, the nominal robot.
    assert_eq!(rows.iter().position(|(deviates, _)| !deviates), Some(1));
    assert!(rows[1].1 < 1e-6, "{}", rows[1].1);
    let others = || rows.iter().filter(|(deviates, _)| *deviates).map(|(_, error)| *error);
    let [min, max] = [others().fold(f64::INFINITY, f64::min), others().fold(0.0, f64::max)];
    let values = &bench.json("out/summary.json")["studies"]["mechanical"]["position_error_mm"];
    assert_eq!((values["min"].as_f64(), values["max"].as_f64()), (Some(min), Some(max)));
    assert!(
        text.contains(&format!("range {} to {} mm.", significant(min, 4), significant(max, 4))),
        "{text}"
    );
}
