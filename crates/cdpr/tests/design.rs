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

/// A planar robot of 14 kg on four cables, whose lower exits are at the floor.
fn wall() -> Value {
    let cable =
        |[x, z]: [f64; 2], [a, c]: [f64; 2]| json!({"exit_point": [x, 0, z], "anchor_point": [a, 0, c]});
    json!({
        "format": "cdpr-robot/1", "name": "Wall", "gravity": 9.81, "plane": "xz",
        "platform": {"mass": 14, "center_of_mass": [0.03, 0, -0.02], "inertia": 0.4},
        "cable": {"diameter": 0.002, "section": 1.6e-6, "linear_density": 0.016, "youngs_modulus": 9e10},
        "tension_limits": {"min": 15, "max": 700}, "tension_reference": 150,
        "cables": [
            cable([0.0, 0.1], [-0.2, -0.12]), cable([4.0, 0.0], [0.2, -0.12]),
            cable([4.1, 3.1], [0.2, 0.12]), cable([-0.1, 3.0], [-0.2, 0.12]),
        ],
    })
}

/// Anchor points that move with the symmetry of the platform.
fn anchors(output: &str) -> Value {
    json!({
        "format": "cdpr-design/1", "payload": 3, "wrench": [10, 0, 0, 0, 2, 0], "starts": 4,
        "variables": [{
            "parameters": ["a1.z", "a2.z", "a3.z", "a4.z"], "signs": [1, 1, -1, -1], "bounds": [-0.3, 0.2]
        }],
        "poses": {"list": [{"position": [1.2, 0, 1]}, {"position": [2.6, 0, 2]}]},
        "objective": {"output": output},
    })
}

/// A robot and a design of it in a folder, and what the program says.
fn designed(robot: &Value, design: &Value, more: &[&str]) -> (std::process::Output, TempDir) {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("robot.json"), robot.to_string()).unwrap();
    std::fs::write(folder.path().join("design.json"), design.to_string()).unwrap();
    let call = [&["design", "robot.json", "design.json", "--out", "best.json"], more].concat();
    (cdpr_in(folder.path(), &call), folder)
}

#[test]
fn a_design_whose_cables_cross_says_which() {
    let (said, folder) = designed(&wall(), &anchors("deflection"), &[]);
    let said = unwrapped(said.stdout).replace('\n', " ");
    assert!(said.contains("touch or cross at pose 1: the search does not look at clearances."), "{said}");
    let checked = cdpr_in(folder.path(), &["robot", "check", "best.json"]);
    assert!(unwrapped(checked.stdout).contains("0.0 mm from cable"), "{said}");
    let (found, _folder) = designed(&wall(), &anchors("deflection"), &["--format", "json"]);
    let found: Value = serde_json::from_slice(&found.stdout).unwrap();
    assert_eq!(found["best"]["crossings"]["pose"], 0, "{found}");
    let mut apart = anchors("deflection");
    apart["variables"][0]["bounds"] = json!([-0.3, -0.1]);
    let (said, _folder) = designed(&wall(), &apart, &[]);
    assert!(!unwrapped(said.stdout).contains("cross"));
}

#[test]
fn a_stiffness_of_a_design_is_also_said_by_the_length_of_the_new_robot() {
    let mut design = anchors("stiffness");
    design["variables"][0]["bounds"] = json!([-0.3, -0.1]);
    let (found, folder) = designed(&wall(), &design, &["--format", "json"]);
    let found: Value = serde_json::from_slice(&found.stdout).unwrap();
    let own = &found["best"]["own_stiffness"];
    std::fs::write(folder.path().join("poses.csv"), "x,y,z\n1.2,0,1\n2.6,0,2\n").unwrap();
    let place = ["path", "best.json", "--poses", "poses.csv", "--payload", "3", "--force", "10,0,0"];
    let place = [&place[..], &["--moment", "0,2,0", "--format", "json"]].concat();
    let rows = String::from_utf8(cdpr_in(folder.path(), &place).stdout).unwrap();
    let rows = rows.lines().map(|row| serde_json::from_str::<Value>(row).unwrap());
    let least =
        rows.map(|row| row["least_stiffness_n_per_m"].as_f64().unwrap()).fold(f64::INFINITY, f64::min);
    assert!((own["stiffness"].as_f64().unwrap() / least - 1.0).abs() < 1e-6, "{own} {least}");
    assert!((found["best"]["objective"].as_f64().unwrap() / least - 1.0).abs() > 1e-3, "{found}");
    let (said, _folder) = designed(&wall(), &design, &[]);
    let said = unwrapped(said.stdout).replace('\n', " ");
    assert!(
        said.contains("the characteristic length of the robot as it is. That of the new robot is"),
        "{said}"
    );
}

#[test]
fn bounds_in_millimetres_are_questioned_and_poses_without_a_name_are_explained() {
    let mut design = anchors("length");
    design["variables"] = json!([{"parameters": ["b4.x"], "bounds": [-120, -80]}]);
    let (asked, _folder) = designed(&wall(), &design, &[]);
    let said = unwrapped(asked.stderr).replace('\n', " ");
    assert!(said.contains("question: variables[0].bounds is -120"), "{said}");
    assert!(said.contains("b4.x is -0.1") && said.contains("if it is in mm"), "{said}");
    assert_eq!(asked.status.code(), Some(3), "{said}");
    design["variables"][0]["bounds"] = json!([-0.12, -0.08]);
    let (fine, _folder) = designed(&wall(), &design, &[]);
    assert!(!unwrapped(fine.stderr).contains("question"));
    design["poses"] = json!([[1.2, 0, 1]]);
    let (refused, _folder) = designed(&wall(), &design, &[]);
    let said = unwrapped(refused.stderr);
    assert!(said.contains("poses: a list: expected {\"list\": [{\"position\": [x, y, z]}, ..]}"), "{said}");
}

#[test]
fn a_mean_of_greatest_tensions_that_has_a_kink_says_what_kinks() {
    let robot = json!({
        "format": "cdpr-robot/1", "name": "Camera", "gravity": 9.81,
        "platform": {"mass": 6, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {"section": 2.8e-6, "linear_density": 0.0, "youngs_modulus": 4.5e10},
        "tension_limits": {"min": 1, "max": 900},
        "cables": [
            {"exit_point": [-3, 0, 4], "anchor_point": [0, 0, 0]},
            {"exit_point": [3, 0, 4], "anchor_point": [0, 0, 0]},
            {"exit_point": [0, 5, 4], "anchor_point": [0, 0, 0]},
        ],
    });
    // Both cables are pulled most where the exits are as far from the platform.
    let design = json!({
        "format": "cdpr-design/1", "payload": 4, "starts": 2,
        "variables": [{"parameters": ["b1.x", "b2.x"], "bounds": [-4, -2.5]}],
        "poses": {"list": [{"position": [0, 1, 2]}]},
        "objective": {"output": "tension", "over": "mean"},
    });
    let (said, _folder) = designed(&robot, &design, &[]);
    let said = unwrapped(said.stdout).replace('\n', " ");
    assert!(said.contains("where another cable becomes the one that is pulled most"), "{said}");
}
