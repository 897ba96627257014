//! `cdpr calibrate fit` as a user meets it.

use crate::common::{answered, cdpr, data_path, text, unwrapped};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

/// A change of the cells of a table.
type Change<'a> = &'a dyn Fn(&mut Vec<Vec<String>>);

const NOISE: &str = "position=1e-4,rotation=1e-4,length=1e-4";

/// A folder with `measurements.csv` of a campaign of 30 poses.
fn campaign() -> (TempDir, String) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("measurements.csv").display().to_string();
    let poses = folder.path().join("poses.csv");
    let candidates = std::fs::read_to_string(data_path("calibration/caroca-candidates.csv")).unwrap();
    let lines: Vec<&str> = candidates.lines().collect();
    let few: Vec<&str> = lines[1..].iter().step_by(9).copied().collect();
    std::fs::write(&poses, format!("{}\n{}\n", lines[0], few.join("\n"))).unwrap();
    let model = data_path("calibration/caroca-tolerances.json");
    let output = cdpr(&[
        "calibrate",
        "simulate",
        &data_path("robots/caroca.json"),
        "--poses",
        poses.to_str().unwrap(),
        "--uncertainty",
        &model,
        "--noise",
        NOISE,
        "--seed",
        "3",
        "--out",
        &path,
    ]);
    assert!(output.status.success(), "{}", unwrapped(output.stderr));
    (folder, path)
}

fn calibrate(measurements: &str, out: &Path, more: &[&str]) -> std::process::Output {
    let (robot, out) = (data_path("robots/caroca.json"), out.display().to_string());
    let first = ["calibrate", "fit", &robot, measurements, "--out", &out, "--format", "json"];
    cdpr(&[&first[..], more].concat())
}

/// The same table with one cell or header changed.
fn changed(path: &str, change: impl Fn(&mut Vec<Vec<String>>)) {
    let text = std::fs::read_to_string(path).unwrap();
    let mut cells: Vec<Vec<String>> =
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
    change(&mut cells);
    let lines: Vec<String> = cells.iter().map(|line| line.join(",")).collect();
    std::fs::write(path, lines.join("\n") + "\n").unwrap();
}

#[test]
fn noise_stated_in_millimetres_makes_chi_square_too_small_and_is_questioned() {
    let (folder, path) = campaign();
    let model = data_path("calibration/caroca-tolerances.json");
    let noise = "position=0.05,rotation=0.05,length=0.05";
    let output = calibrate(&path, &folder.path().join("out"), &["--uncertainty", &model, "--noise", noise]);
    assert_eq!(output.status.code(), Some(3), "{}", unwrapped(output.stderr));
    let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
    let warnings = summary["warnings"].as_array().unwrap();
    let is_of_noise = |warning: &Value| {
        let warning = warning.as_str().unwrap();
        warning.contains("far too small: is the noise stated in mm where it is m, or too large?")
    };
    assert!(warnings.iter().any(is_of_noise), "{summary}");
    assert!(summary["p_value_of_less"].as_f64().unwrap() < 1e-4, "{summary}");
}

#[test]
fn a_campaign_gives_a_robot_and_what_is_left_and_a_study_takes_both() {
    let (folder, path) = campaign();
    let model = data_path("calibration/caroca-tolerances.json");
    let out = folder.path().join("out");
    let output = calibrate(&path, &out, &["--uncertainty", &model, "--noise", NOISE]);
    assert_eq!(output.status.code(), Some(0), "{}", unwrapped(output.stderr));
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let summary: Value = serde_json::from_str(&read("summary.json")).unwrap();
    assert_eq!(printed, summary);
    let parameter = &summary["parameters"]["a1.x"];
    for field in ["before", "after", "std"] {
        assert!(parameter[field].is_f64(), "{parameter}");
    }
    assert_eq!(parameter["identifiable"], true);
    let (chi_square, degrees) =
        (summary["chi_square"].as_f64().unwrap(), summary["degrees_of_freedom"].as_f64().unwrap());
    assert!((chi_square / degrees - 1.0).abs() < 0.5);
    assert!(summary["position_std_after_m"].as_f64() < summary["position_std_before_m"].as_f64());
    assert!(summary["warnings"].as_array().unwrap().is_empty(), "{summary}");
    assert!(read("report.html").contains("Parameters before and after"));
    let robot: Value = serde_json::from_str(&read("calibrated.json")).unwrap();
    assert!(robot["source"].as_str().unwrap().starts_with("calibrated by cdpr"));
    assert_eq!(robot["cables"][0]["anchor_point"][0], parameter["after"]);
    let posterior: Value = serde_json::from_str(&read("posterior.json")).unwrap();
    assert_eq!(posterior["format"], "cdpr-errors/1");
    assert_eq!(posterior["parameters"].as_array().unwrap().len(), 50);

    // A study with the posterior.
    let mut study: Value =
        serde_json::from_str(&std::fs::read_to_string(data_path("calibration/position-after.json")).unwrap())
            .unwrap();
    let file = folder.path().join("study.json");
    study["robot"] = "out/calibrated.json".into();
    study["error_models"]["errors"]["file"] = "out/posterior.json".into();
    std::fs::write(&file, study.to_string()).unwrap();
    let results = folder.path().join("results").display().to_string();
    let output = cdpr(&["study", "run", file.to_str().unwrap(), "--out", &results, "--observations", "256"]);
    let error = unwrapped(output.stderr);
    assert!(output.status.success(), "{error}");

    // Derivatives with the posterior: g' C g, correlations included.
    let (calibrated, study) = (out.join("calibrated.json"), format!("{}:errors", file.display()));
    let at = ["--pose", "0.3,0.2,1.5", "--payload", "50", "--format", "json"];
    let errors = ["--uncertainty", &study];
    let asked = [&["derivatives", calibrated.to_str().unwrap()], &at[..], &errors[..]].concat();
    let found: Value = serde_json::from_str(&answered(cdpr(&asked))).unwrap();
    let names = found["parameters"].as_array().unwrap();
    let slope = |name: &Value| {
        found["magnitude_mm"][names.iter().position(|known| known == name).unwrap()].as_f64().unwrap()
    };
    let slopes: Vec<f64> = posterior["parameters"].as_array().unwrap().iter().map(slope).collect();
    let row = |row: &Value| -> f64 {
        row.as_array().unwrap().iter().zip(&slopes).map(|(c, g)| c.as_f64().unwrap() * g).sum()
    };
    let covariance = posterior["covariance"].as_array().unwrap();
    let variance: f64 = covariance.iter().zip(&slopes).map(|(c, g)| row(c) * g).sum();
    let std = found["uncertainty"]["std_mm"].as_f64().unwrap();
    assert!((std / variance.sqrt() - 1.0).abs() < 1e-6, "{std} {}", variance.sqrt());
    let shares = found["uncertainty"]["shares"].as_object().unwrap().values();
    assert!((shares.map(|share| share.as_f64().unwrap()).sum::<f64>() - 1.0).abs() < 1e-9);

    // The same folder takes a further calibration on request, one of a user does not.
    let further = ["--uncertainty", &model, "--noise", NOISE, "--overwrite"];
    assert_eq!(calibrate(&path, &out, &further[..4]).status.code(), Some(1));
    assert_eq!(calibrate(&path, &out, &further).status.code(), Some(0));
    let own = folder.path().join("own");
    std::fs::create_dir(&own).unwrap();
    std::fs::write(own.join("summary.json"), "mine").unwrap();
    let refused = calibrate(&path, &own, &["--uncertainty", &model, "--noise", NOISE]);
    assert_eq!(refused.status.code(), Some(1));
    assert_eq!(std::fs::read_to_string(own.join("summary.json")).unwrap(), "mine");
}

#[test]
fn a_position_is_not_known_where_base_and_tracker_may_move_together() {
    let (folder, path) = campaign();
    let fit = |unknown: &[&str]| -> Value {
        let out = folder.path().join(format!("out{}", unknown.len()));
        let settings = ["--parameters", "a,b", "--noise", NOISE, "--with", "folds=0"];
        let output = calibrate(&path, &out, &[&settings[..], unknown].concat());
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", unwrapped(output.stderr)))
    };
    let known = fit(&[]);
    assert!(known["position_std_after_m"].as_f64().unwrap() < 1e-3, "{known}");
    assert!(known.get("position_depends_on").is_none());
    // All exits and the tracker moved alike read the same.
    let moved = fit(&["--unknown", "frame"]);
    assert!(moved["position_std_after_m"].is_null() && moved.get("workspace").is_none(), "{moved}");
    let names = moved["position_depends_on"].as_array().unwrap();
    assert!(names.contains(&"b1.x".into()) && names.contains(&"frame.r.x".into()), "{names:?}");
    assert!(!names.contains(&"a1.x".into()), "{names:?}");
}

#[test]
fn bad_measurements_are_named_by_line_and_column() {
    let payload = |(i, row): (usize, &mut Vec<String>)| {
        row.push(if i == 0 { "payload_kg" } else { "-500" }.to_owned());
    };
    let cases: [(Change, &str); 17] = [
        (
            &|cells| cells.iter_mut().enumerate().for_each(payload),
            "line 2, column payload_kg: -500: expected a payload above -180 kg, the platform's mass",
        ),
        (&|cells| cells[3][2] = "NaN".to_owned(), "line 4, column l3_m: `NaN`: expected a finite number"),
        (&|cells| cells[5][0] = "4100".to_owned(), "line 6, column l1_m: 4100: expected a length in m"),
        (&|cells| cells[0][1] = "l9_m".to_owned(), "column l9_m: expected one of the 8 cables of the robot"),
        (&|cells| cells[0][8] = "width_m".to_owned(), "column width_m: expected a name such as x_m"),
        (&|cells| cells[2].truncate(4), "line 3: 4 cells: expected"),
        (&|cells| cells[3][9] = "inf".to_owned(), "line 4, column y_m: `inf`: expected a finite number"),
        (&|cells| cells[3][9] = "1197.5".to_owned(), "line 4, column y_m: 1197.5: expected a place in m"),
        (&|cells| cells[0][9] = "x_mm".to_owned(), "column x_mm: expected each quantity once"),
        (&|cells| cells[6][2] = "-3".to_owned(), "line 7, column l3_m: -3: expected a length above zero"),
        (&|cells| cells[6][11] = "5".to_owned(), "line 7, column qw: 5: expected the quaternion"),
        (
            &|cells| cells[0][0] = "l1_mm".to_owned(),
            "column l1_mm: expected lengths near those of a straight cable",
        ),
        (&|cells| cells.truncate(1), "measurements is empty: expected a row for each pose below a header"),
        (&|cells| cells.clear(), "measurements is empty: expected a row for each pose below a header"),
        // Lengths of another pose, and of a smaller robot.
        (&|cells| (0..8).for_each(|k| cells[11][k] = cells[21][k].clone()), "line 12, column l"),
        (
            &|cells| cells[11][..8].iter_mut().for_each(scale),
            "that of a straight cable at the measured pose: the row may be of",
        ),
        (&|cells| cells[4][3].clear(), "line 5: column l4_m is empty"),
    ];
    for (change, words) in cases {
        let (folder, path) = campaign();
        changed(&path, change);
        let output = calibrate(&path, &folder.path().join("out"), &["--noise", NOISE]);
        let error = unwrapped(output.stderr);
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains(words), "`{words}` is not in: {error}");
    }
    let (folder, path) = campaign();
    changed(&path, |cells| cells.truncate(5));
    let error = unwrapped(calibrate(&path, &folder.path().join("out"), &["--noise", NOISE]).stderr);
    assert!(error.contains("56 measurements for 82 unknowns, 32 of them lengths"), "{error}");
}

fn scale(cell: &mut String) {
    *cell = (0.5 * cell.parse::<f64>().unwrap()).to_string();
}

#[test]
fn what_cannot_be_written_and_settings_that_cannot_be_meant_are_refused() {
    let (folder, path) = campaign();
    let out = folder.path().join("out");
    for (more, words) in [
        (&["--noise", "position=0"][..], "noise position is 0: expected a standard deviation from 1e-15"),
        (&["--noise", "tensoin=1"], "noise tensoin is 1: expected one of position"),
        (&["--noise", "cov_x_m_y=1"], "noise cov_x_m_y is 1: expected two different quantities"),
        (&["--noise", NOISE, "--share", "r"], "share is r: expected parameters that are sought"),
        (&["--noise", NOISE, "--bounds", "mass=1"], "`mass=1`: expected name=least:greatest"),
        (&["--noise", NOISE, "--bounds", "lead=0:1"], "bounds is lead: expected the name of something"),
        (&["--noise", NOISE, "--unknown", "drum"], "error of sensors is drum: expected one of"),
    ] {
        let output = calibrate(&path, &out, more);
        let error = unwrapped(output.stderr);
        assert!(!output.status.success() && error.contains(words), "`{words}` is not in: {error}");
    }
    // A file stands where the folder should be made: it stays as it is.
    let before = std::fs::read_to_string(&path).unwrap();
    let output = calibrate(&path, Path::new(&path), &["--noise", NOISE]);
    let error = unwrapped(output.stderr);
    assert!(output.status.code() == Some(1) && error.contains("cannot write"), "{error}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), before);
    assert!(!out.join("summary.json").exists());
}

#[test]
fn swapped_columns_and_rows_of_other_poses_are_warned_of() {
    let model = data_path("calibration/caroca-tolerances.json");
    let (folder, path) = campaign();
    changed(&path, |cells| cells[7][8] = (cells[7][8].parse::<f64>().unwrap() + 0.3).to_string());
    let output = calibrate(&path, &folder.path().join("out"), &["--uncertainty", &model, "--noise", NOISE]);
    assert_eq!(output.status.code(), Some(3), "{}", unwrapped(output.stderr));
    let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
    let warnings = summary["warnings"].to_string();
    assert!(warnings.contains("line 8 alone makes"), "{warnings}");
    assert_eq!(summary["row_apart"]["others_fit"], false);
    assert_eq!(summary["outliers"][0]["line"], 8);
    for (columns, words) in [
        ((9, 10), "column y_m and z_m: expected them the other way round"),
        ((1, 2), "column l2_m and l3_m:"),
    ] {
        let (folder, path) = campaign();
        changed(&path, |cells| cells[1..].iter_mut().for_each(|line| line.swap(columns.0, columns.1)));
        let output =
            calibrate(&path, &folder.path().join("out"), &["--uncertainty", &model, "--noise", NOISE]);
        let error = unwrapped(output.stderr);
        assert!(output.status.code() == Some(1) && error.contains(words), "{error}");
    }
}

#[test]
fn a_loss_by_which_outliers_count_less_is_proposed_once() {
    let model = data_path("calibration/caroca-tolerances.json");
    let (folder, path) = campaign();
    changed(&path, |cells| {
        for (row, off) in [(7, 0.3), (12, 0.1)] {
            cells[row][8] = (cells[row][8].parse::<f64>().unwrap() + off).to_string();
        }
    });
    let out = folder.path().join("out").display().to_string();
    let fit = ["calibrate", "fit", "caroca", &path, "--uncertainty", &model, "--noise", NOISE, "--out", &out];
    for (loss, proposed) in [
        ("loss=huber", "Leave it out, or let it count still less: --with loss=cauchy."),
        ("loss=cauchy", "Leave it out."),
    ] {
        let said =
            text(cdpr(&[&fit[..], &["--overwrite", "--with", loss]].concat()).stdout).replace('\n', " ");
        assert!(said.contains("line 8 (x_m) makes") && said.contains(proposed), "{said}");
        assert!(!said.contains(loss), "{said}");
    }
}

/// A constant that all lengths lack, or that the robot file lacks, such as a lead.
#[test]
fn one_constant_of_all_lengths_is_named_as_one() {
    let model = data_path("calibration/caroca-tolerances.json");
    let longer_by = |metres: f64| {
        let (folder, path) = campaign();
        changed(&path, |cells| {
            for cell in cells[1..].iter_mut().flat_map(|line| &mut line[..8]) {
                *cell = (cell.parse::<f64>().unwrap() + metres).to_string();
            }
        });
        let output =
            calibrate(&path, &folder.path().join("out"), &["--uncertainty", &model, "--noise", NOISE]);
        (output.status.code(), unwrapped(output.stderr), text(output.stdout))
    };
    for (metres, words) in [
        (-0.5, "l1_m to l8_m: expected lengths that are 0.501 m longer, all of them"),
        (0.5, "l1_m to l8_m: expected lengths that are 0.499 m shorter, all of them"),
    ] {
        let (code, error, _) = longer_by(metres);
        assert!(code == Some(1) && error.contains(words) && error.contains("lead"), "{error}");
    }
    let (code, error, found) = longer_by(-0.05);
    assert_eq!(code, Some(3), "{error}");
    let summary: Value = serde_json::from_str(&found).unwrap();
    let constant = &summary["length_constant"];
    assert!((constant["error_m"].as_f64().unwrap() + 0.05).abs() < 5e-3, "{constant}");
    assert!(constant["share"].as_f64().unwrap() > 0.9, "{constant}");
    assert!(summary["warnings"].to_string().contains("one constant error of all lengths, -4"), "{summary}");
}

/// Lengths of incremental encoders, each with a constant error.
#[test]
fn constant_errors_of_lengths_are_named_whatever_is_sought() {
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (table, points) = (path("table.csv"), ["--uncertainty", "a=0.0005,b=0.0005"]);
    let simulate = ["calibrate", "simulate", "caroca", "--region=-2:2:3,-1:1:3,1:2.5:3", "--noise", NOISE];
    let errors = ["--unknown", "length_offset=0.005", "--seed", "3", "--out", &table];
    assert!(cdpr(&[&simulate[..], &points, &errors].concat()).status.success());
    for (sought, words) in [
        (&points[..], "constant errors of the lengths explain 84 % of chi-square, with -9.0 mm in cable 1"),
        (&["--parameters", "mass"], "residuals of cable 1, l1_m, average -4.6 mm"),
    ] {
        let fit = ["calibrate", "fit", "caroca", &table, "--noise", NOISE, "--overwrite", "--out"];
        let output = cdpr(&[&fit[..], &[&path("out")], sought].concat());
        assert_eq!(output.status.code(), Some(3));
        let said = text(output.stdout).replace('\n', " ");
        assert!(said.contains(words) && said.contains("fit length_offset, too"), "{said}");
    }
}
