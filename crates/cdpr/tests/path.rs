//! `cdpr path`: each row is what the other commands say of its pose.

use crate::common::{answered, cdpr, data_path, text, unwrapped};
use serde_json::Value;
use tempfile::TempDir;

/// A robot, a position that its cables hold, and a way from there [m].
const PATHS: [(&str, [f64; 3], [f64; 3]); 3] = [
    ("robots/caroca.json", [0.5, -0.2, 1.75], [0.4, 0.1, 0.2]),
    ("robots/cogiro.json", [0.5, -0.2, 2.0], [-1.0, 0.5, 0.3]),
    ("robots/ipanema-1.json", [0.1, 0.2, 1.0], [0.3, -0.3, 0.1]),
];

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// The poses of a path of six steps, as `--pose` has them, and their file.
fn poses([x, y, z]: [f64; 3], way: [f64; 3]) -> (Vec<String>, String) {
    let at = |k: i32| {
        let share = f64::from(k) / 6.0;
        format!("{:?},{:?},{:?}", x + share * way[0], y + share * way[1], z + share * way[2])
    };
    let poses: Vec<_> = (0..=6).map(at).collect();
    let file = format!("x_m,y_m,z_m\n{}\n", poses.join("\n"));
    (poses, file)
}

/// Rows of a path, which says how many poses are held and may warn of cables that vibrate slowly.
fn rows_of(arguments: &[&str]) -> String {
    let output = cdpr(arguments);
    let said = unwrapped(output.stderr);
    assert!(output.status.success(), "{said}");
    let (first, rest) = said.split_once('\n').unwrap();
    let tensions = if arguments.contains(&"--payload") { "unloaded at" } else { "tensions" };
    assert!(first.contains(&format!(" poses held, {tensions} ")) && first.len() <= 80, "{said}");
    assert!(rest.is_empty() || rest.starts_with("note: no frequencies: "), "{said}");
    text(output.stdout)
}

#[test]
fn a_path_tells_of_each_pose_what_the_other_commands_say() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("path.csv");
    for (robot, from, way) in PATHS {
        let (poses, file) = poses(from, way);
        std::fs::write(&path, file).unwrap();
        let robot = data_path(robot);
        let load = ["--payload", "5", "--format", "json"];
        let arguments = [&["path", &robot, "--poses", path.to_str().unwrap()], &load[..]].concat();
        let rows = rows_of(&arguments);
        assert_eq!(rows.lines().count(), poses.len());
        for (row, pose) in rows.lines().zip(&poses) {
            let row: Value = serde_json::from_str(row).unwrap();
            let ask = |command: &str, more: &[&str]| -> Value {
                let arguments = [&[command, &robot, "--pose", pose, "--format", "json"], more].concat();
                serde_json::from_str(&answered(cdpr(&arguments))).unwrap()
            };
            let (inverse, deflection) = (ask("inverse", &[]), ask("deflection", &load[..2]));
            assert_eq!(row["jump"], false);
            for name in ["lengths", "tensions", "exit_tensions"] {
                for (on_path, alone) in numbers(&row[name]).iter().zip(numbers(&inverse[name])) {
                    assert!((on_path / alone - 1.0).abs() < 1e-9, "{robot} {name}: {on_path} {alone}");
                }
            }
            let (on_path, alone) =
                (row["magnitude_mm"].as_f64().unwrap(), deflection["magnitude_mm"].as_f64().unwrap());
            assert!((on_path / alone - 1.0).abs() < 1e-6, "{robot}: {on_path} mm, {alone} mm");
            // The sag of a taut parabola is w c h/8T over its chord c and horizontal part h (Irvine 1981).
            let content: Value = serde_json::from_str(&std::fs::read_to_string(&robot).unwrap()).unwrap();
            let weight = content["cable"]["linear_density"].as_f64().unwrap() * 9.81;
            let each = numbers(&row["sags"]).into_iter().zip(numbers(&row["lengths"]));
            for ((sag, length), tension) in each.zip(numbers(&row["tensions"])) {
                let most = weight * length * length / (8.0 * (tension - weight * length));
                assert!(0.0 < sag && sag < 1.05 * most, "{robot}: {sag} m of {most} m");
            }
        }
    }
}

#[test]
fn the_frequency_of_a_path_without_load_is_that_of_the_modes() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("path.csv");
    let (robot, from, way) = PATHS[1];
    let (poses, file) = poses(from, way);
    std::fs::write(&path, file).unwrap();
    let robot = data_path(robot);
    let rows = rows_of(&["path", &robot, "--poses", path.to_str().unwrap()]);
    let mut table = csv::Reader::from_reader(rows.as_bytes());
    let column = |headers: &csv::StringRecord, name: &str| headers.iter().position(|h| h == name).unwrap();
    let headers = table.headers().unwrap().clone();
    for (row, pose) in table.records().zip(&poses) {
        let row = row.unwrap();
        assert_eq!(&row[column(&headers, "status")], "held");
        let found: f64 = row[column(&headers, "lowest_frequency_hz")].parse().unwrap();
        let modes: Value = serde_json::from_str(&answered(cdpr(&[
            "modes", &robot, "--number", "1", "--pose", pose, "--format", "json",
        ])))
        .unwrap();
        let first = modes["modes"][0]["frequency_hz"].as_f64().unwrap();
        assert!((found / first - 1.0).abs() < 3e-6, "{found} Hz, {first} Hz");
        // Nothing displaces it but rounding.
        assert!(row[column(&headers, "magnitude_mm")].parse::<f64>().unwrap() < 1e-9);
    }
}

#[test]
fn the_standard_deviations_of_a_path_are_those_of_the_derivatives() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("path.csv");
    for (robot, from, way) in PATHS {
        let (poses, file) = poses(from, way);
        std::fs::write(&path, file).unwrap();
        let robot = data_path(robot);
        let figure = folder.path().join("path.svg");
        let errors = ["--payload", "5", "--uncertainty", "a=0.001,b=0.002,mass=0.5"];
        let files = ["--poses", path.to_str().unwrap(), "--figure", figure.to_str().unwrap()];
        let arguments = [&["path", &robot], &errors[..], &files[..]].concat();
        let rows = rows_of(&arguments);
        let rows: Vec<std::collections::HashMap<String, String>> =
            csv::Reader::from_reader(rows.as_bytes()).deserialize().map(Result::unwrap).collect();
        assert_eq!(rows.len(), poses.len());
        for (row, pose) in rows.iter().zip(&poses).step_by(3) {
            let ask = ["derivatives", &robot, "--pose", pose, "--payload", "5", "--format", "json"];
            let found: Value = serde_json::from_str(&answered(cdpr(&ask))).unwrap();
            let names = found["parameters"].as_array().unwrap();
            let std = |slope: &dyn Fn(usize) -> f64| {
                let deviation = |name: &str| match name.split('.').next().unwrap() {
                    "mass" => 0.5,
                    name if name.starts_with('a') => 0.001,
                    name if name.starts_with('b') => 0.002,
                    _ => 0.0,
                };
                let part = |k: usize| (slope(k) * deviation(names[k].as_str().unwrap())).powi(2);
                (0..names.len()).map(part).sum::<f64>().sqrt()
            };
            let same = |name: &str, expected: f64| {
                let on_path: f64 = row[name].parse().unwrap();
                assert!((on_path / expected - 1.0).abs() < 1e-5, "{robot} {name}: {on_path} {expected}");
            };
            same("std_magnitude_mm", std(&|k| found["magnitude_mm"][k].as_f64().unwrap()));
            same("std_dz_mm", std(&|k| found["deflection_mm"][k][2].as_f64().unwrap()));
            same("std_length_2_m", std(&|k| found["lengths"][k][1].as_f64().unwrap()));
        }
        // Drawn again over itself, but over nothing else.
        assert!(std::fs::read_to_string(&figure).unwrap().contains("along a path of 7 poses"));
        assert_eq!(rows_of(&arguments).lines().count(), 1 + poses.len());
        std::fs::write(&figure, "<svg>mine</svg>").unwrap();
        assert_eq!(cdpr(&arguments).status.code(), Some(1));
        assert_eq!(std::fs::read_to_string(&figure).unwrap(), "<svg>mine</svg>");
        std::fs::remove_file(&figure).unwrap();
    }
}

#[test]
fn a_pose_that_is_not_held_is_a_row_with_its_reason() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("path.csv");
    std::fs::write(&path, "x_m,y_m,z_m\n0,0,1.75\n30,0,1.75\n0.1,0,1.75\n").unwrap();
    let output = cdpr(&["path", &data_path("robots/caroca.json"), "--poses", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(3));
    let rows = text(output.stdout);
    let status: Vec<_> = rows.lines().skip(1).map(|line| line.split(',').nth(7).unwrap()).collect();
    assert_eq!(status, ["held", "infeasible_tension", "held"]);
}

#[test]
fn a_single_pose_is_no_path_and_no_option_of_it() {
    let help = text(cdpr(&["path", "--help"]).stdout);
    assert!(
        help.contains("--poses <FILE>") && !help.contains("--pose <") && !help.contains("--rpy"),
        "{help}"
    );
    let refused = cdpr(&["path", "caroca", "--pose", "0,0,1.75"]);
    let said = unwrapped(refused.stderr);
    assert!(refused.status.code() == Some(2) && said.contains("expected --poses FILE"), "{said}");
}

/// The time of a planner, in any unit, with a gap or in another order.
#[test]
fn a_gap_in_the_times_of_a_planner_is_questioned() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plan.csv").display().to_string();
    let call = |command: &str, header: &str, lines: &[&str]| {
        std::fs::write(&path, format!("{header}\n{}\n", lines.join("\n"))).unwrap();
        let further: &[&str] = if command == "inverse" { &["--with", "path"] } else { &[] };
        let output = cdpr(&[&[command, "cogiro", "--poses", &path, "--format", "csv"], further].concat());
        (output.status.code(), unwrapped(output.stderr))
    };
    let even = ["0,0,0,2", "100,0.01,0,2", "200,0.02,0,2", "300,0.03,0,2", "400,0.04,0,2"];
    let mut gap = even;
    gap[4] = "3300,0.5,0,2";
    for command in ["path", "inverse"] {
        let (code, said) = call(command, "t_ms,x_m,y_m,z_m", &even);
        assert!(code == Some(0) && !said.contains("question"), "{said}");
        for header in ["t_ms,x_m,y_m,z_m", "Time [ms],x_m,y_m,z_m"] {
            let (code, said) = call(command, header, &gap);
            assert!(
                code == Some(3) && said.contains("is 3.3 s: the line before is 3.00 s earlier"),
                "{said}"
            );
        }
    }
    let (code, said) = call("path", "timestamp,x_m,y_m,z_m", &[even[1], even[0]]);
    assert!(
        code == Some(3) && said.contains("line 3: timestamp is 0 s: the line before has 100 s"),
        "{said}"
    );
}
