//! `cdpr design`: the verdict first, the robot of the optimum as a file, and what no robot can do.

use crate::common::{answered, cdpr, cdpr_in, data, data_path, json_file, unwrapped};
use serde_json::{Value, json};
use tempfile::TempDir;

#[test]
fn a_design_begins_with_its_verdict_and_its_robot_is_a_robot_file() {
    let folder = TempDir::new().unwrap();
    let design = data_path("designs/caroca-pulleys.json");
    let best = folder.path().join("best.json");
    let printed = answered(cdpr(&["design", "caroca", &design, "--out", best.to_str().unwrap()]));
    let first = printed.lines().next().unwrap();
    assert!(first.starts_with("CAROCA: the greatest deflection falls from "), "{first}");
    assert!(
        printed.replace('\n', " ").contains("(best of 175 configurations, all of them evaluated)"),
        "{printed}"
    );
    assert!(printed.lines().all(|line| line.chars().count() <= 80), "{printed}");
    let found: Value =
        serde_json::from_str(&answered(cdpr(&["design", "caroca", &design, "--format", "json"]))).unwrap();
    let outputs = found["best"]["outputs"].as_array().unwrap();
    let place = ["deflection", best.to_str().unwrap(), "--pose", "0,0,1.75", "--payload", "50"];
    let again: Value =
        serde_json::from_str(&answered(cdpr(&[&place[..], &["--format", "json"]].concat()))).unwrap();
    let magnitude = again["magnitude_mm"].as_f64().unwrap();
    assert!((magnitude / outputs[0].as_f64().unwrap() - 1.0).abs() < 1e-9, "{magnitude} {outputs:?}");
}

#[test]
fn what_no_robot_can_do_ends_with_three_and_a_wrong_field_with_its_line() {
    let folder = TempDir::new().unwrap();
    let mut design = json_file(data("designs/caroca-pulleys.json"));
    let mut run = |field: &str, value: Value| {
        design[field] = value;
        std::fs::write(folder.path().join("design.json"), format!("{design:#}")).unwrap();
        cdpr_in(folder.path(), &["design", "caroca", "design.json"])
    };
    let lost = run("limits", json!({"deflection": 0.01}));
    assert_eq!(lost.status.code(), Some(3));
    let said = unwrapped(lost.stdout);
    assert!(said.contains("no robot was found that holds all 4 poses within the limits"), "{said}");
    // The first choices are the robot as it is.
    let list = "x,y,z,yaw_deg\n0,0,1.75,0\n0.5,-0.2,1.75,10\n1.5,0.5,1.25,0\n-1.5,-0.5,1.25,0\n";
    std::fs::write(folder.path().join("poses.csv"), list).unwrap();
    let place = ["deflection", "caroca", "--poses", "poses.csv", "--payload", "50", "--format", "json"];
    let rows = answered(cdpr_in(folder.path(), &place));
    let deflections: Vec<f64> = rows
        .lines()
        .map(|row| serde_json::from_str::<Value>(row).unwrap()["magnitude_mm"].as_f64().unwrap())
        .collect();
    let greatest = deflections.iter().copied().fold(0.0, f64::max);
    let pose = 1 + deflections.iter().position(|of| *of == greatest).unwrap();
    let expected = format!("at pose {pose} the deflection is {greatest:.3} mm, its limit 0.01000 mm");
    assert!(said.replace('\n', " ").contains(&expected), "{said}: {expected}");
    let refused = run("payload", json!(-2));
    assert_eq!(refused.status.code(), Some(1));
    let said = unwrapped(refused.stderr);
    assert!(said.contains("payload is -2: expected a finite mass, zero or more [kg] (line "), "{said}");
    let robot = cdpr(&["design", "caroca", &data_path("robots/caroca.json")]);
    let said = unwrapped(robot.stderr);
    assert!(said.contains("is a robot file: expected a design file"), "{said}");
}

#[test]
fn a_front_is_a_table_in_text_and_csv_and_a_robot_file_for_each_point() {
    let folder = TempDir::new().unwrap();
    let mut design = json_file(data("designs/caroca-pulleys.json"));
    design["pareto"] = json!({"output": "position", "over": "mean"});
    design["errors"] = json!({"b": {"law": {"normal": {"mean": 0, "std": 1e-3}}}});
    std::fs::write(folder.path().join("design.json"), design.to_string()).unwrap();
    let run = |more: &[&str]| {
        answered(cdpr_in(folder.path(), &[&["design", "caroca", "design.json"], more].concat()))
    };
    let printed = run(&["--out", "best.json"]);
    assert!(
        printed.starts_with("CAROCA: the greatest deflection against the mean position error,"),
        "{printed}"
    );
    assert!(printed.contains("taken as normal") && printed.lines().all(|line| line.chars().count() <= 80));
    assert!(
        printed.replace('\n', " ").contains("175 of 175 configurations hold all poses within the limits; ")
    );
    let found: Value = serde_json::from_str(&run(&["--format", "json"])).unwrap();
    assert_eq!(found["evaluations"], 175);
    let points = found["points"].as_array().unwrap();
    let table = run(&["--format", "csv"]);
    let mut rows = table.lines();
    let header = "worst_magnitude_mm,mean_position_error_mm,exchange,kkt_residual,optimal,half length,half width,\
        height";
    assert_eq!(rows.next(), Some(header));
    assert!(points.len() > 1 && rows.clone().count() == points.len(), "{table}");
    for (k, (point, row)) in points.iter().zip(rows).enumerate() {
        let cells: Vec<&str> = row.split(',').collect();
        for i in 0..2 {
            assert_eq!(cells[i].parse::<f64>().unwrap(), point["objectives"][i].as_f64().unwrap());
        }
        let robot = json_file(folder.path().join(format!("best-{}.json", k + 1)));
        assert_eq!(robot["cables"][0]["exit_point"][0], point["variables"][0]);
    }
}
