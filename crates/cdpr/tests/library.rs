//! The library of robots: every one is listed, checked, studied and mapped.

use crate::common::{answered, cdpr, cdpr_in, data, json_file, text, unwrapped};
use cdpr_robot::Robot;
use cdpr_robot::library::{CABLES, ROBOTS};
use serde_json::{Value, json};
use tempfile::TempDir;

/// Robots of which `check` warns, with the place of the warning and what is behind it.
const EXPLAINED: [(&str, &str, &str); 2] =
    [("copacabana-handling", "cables[4]", CLOSELY), ("copacabana-handling", "cables[6]", CLOSELY)];

const CLOSELY: &str =
    "its upper exit points lead to the lower anchor points, so that cables pass each other closely";

#[test]
fn robots_and_cables_are_listed_with_a_line_each() {
    let listed = answered(cdpr(&["robot", "list"]));
    for file in ROBOTS.iter().chain(CABLES) {
        assert!(listed.lines().any(|line| line.contains(&format!(" {} ", file.name))), "{}", file.name);
    }
}

#[test]
fn what_a_robot_is_fits_in_a_few_lines() {
    let one = answered(cdpr(&["robot", "show", "cogiro"]));
    for words in ["CoGiRo: 8 cables, 6 free motions", "grade: surveyed", "assumed: The modulus of 100 GPa"] {
        assert!(one.contains(words), "{words}: {one}");
    }
    for file in ROBOTS {
        let said = answered(cdpr(&["robot", "show", file.name]));
        let before_the_source: Vec<&str> =
            said.lines().take_while(|line| !line.starts_with("source")).collect();
        assert!((6..=8).contains(&before_the_source.len()), "{said}");
    }
    let entry: Value =
        serde_json::from_str(&answered(cdpr(&["robot", "show", "irma4u", "--format", "json"]))).unwrap();
    assert_eq!((&entry["grade"], &entry["mass_kg"]), (&json!("surveyed"), &json!(12.992)));
}

#[test]
fn a_name_takes_the_place_of_a_robot_file_and_a_wrong_one_finds_those_near_it() {
    let by_name = answered(cdpr(&["inverse", "caroca", "--pose", "0,0,1.75"]));
    let file = crate::common::data_path("robots/caroca.json");
    assert_eq!(by_name, answered(cdpr(&["inverse", &file, "--pose", "0,0,1.75"])));
    let refused = cdpr(&["robot", "check", "cogira"]);
    assert_eq!(refused.status.code(), Some(1));
    assert_eq!(
        unwrapped(refused.stderr),
        "error: no file and no robot of the library is called `cogira`: near are cogiro; `cdpr robot list` \
         lists them all\n"
    );
}

#[test]
fn check_is_clean_or_explained_for_every_robot() {
    for file in ROBOTS {
        let output = cdpr(&["robot", "check", file.name, "--format", "json"]);
        let findings: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
        let warnings = findings.iter().filter(|finding| finding["severity"] == "warning");
        let warned: Vec<_> = warnings.map(|finding| finding["field"].as_str().unwrap()).collect();
        let explained: Vec<_> =
            EXPLAINED.iter().filter(|entry| entry.0 == file.name).map(|entry| entry.1).collect();
        assert_eq!(warned, explained, "{}", file.name);
    }
}

#[test]
fn a_study_and_a_map_run_for_every_robot() {
    let folder = TempDir::new().unwrap();
    let run = |arguments: &[&str]| {
        let output = cdpr_in(folder.path(), arguments);
        // Some robots hold less than half of a map.
        let is_map = arguments[0] == "workspace" && output.status.code() == Some(3);
        assert!(output.status.success() || is_map, "{arguments:?}: {}", unwrapped(output.stderr));
    };
    for name in ROBOTS.iter().map(|file| file.name) {
        let file = format!("{name}.json");
        let template = cdpr_in(folder.path(), &["study", "new", name, "--out", &file]);
        assert!(template.status.success(), "{name}: {}", unwrapped(template.stderr));
        let mut study = json_file(folder.path().join(&file));
        assert_eq!(study["robot"], name);
        study.as_object_mut().unwrap().remove("sensitivity");
        study["replicates"] = json!(0);
        study["samplings"]["all"]["observations"] = json!(32);
        for axis in ["x", "y"] {
            study["surfaces"]["modulus_mass"][axis]["points"] = json!(3);
        }
        std::fs::write(folder.path().join(&file), study.to_string()).unwrap();
        let out = format!("{name}-study");
        run(&["study", "run", &file, "--out", &out]);
        let summary = json_file(folder.path().join(out).join("summary.json"));
        let sampling = &summary["studies"]["all"];
        assert!(sampling["magnitude_mm"]["std"].as_f64().unwrap() > 0.0, "{name}: {sampling}");

        let position = &study["samplings"]["all"]["pose"]["position"];
        let [x, y, z] = [0, 1, 2].map(|axis| position[axis].as_f64().unwrap());
        let size = robot(name).platform_size();
        let part = format!("--region={}:{}:3,{}:{}:3,{z}:{z}:1", x - size, x + size, y - size, y + size);
        let map = format!("{name}-map");
        let free: &[&str] = if robot(name).is_fully_actuated() { &[] } else { &["--free", "roll,pitch"] };
        run(&[&["workspace", name, &part, "--out", &map], free].concat());
        let columns = &json_file(folder.path().join(map).join("workspace.json"))["columns"];
        assert_eq!(columns["status"][4], "held", "{name}: {columns}");
    }
}

#[test]
fn a_study_and_a_map_of_robots_with_four_cables_find_roll_and_pitch() {
    let folder = TempDir::new().unwrap();
    let positions =
        [("four-cables", [0.3, 0.2, 2.5]), ("grab", [1.28, -0.19, -0.92]), ("irma4u", [0.2, 0.1, 0.8])];
    for (name, position) in positions {
        let study = json!({
            "format": "cdpr-study/1", "name": name, "robot": name, "payload": 0.1, "seed": 1,
            "replicates": 0, "confidence": 0.95, "bootstrap_resamples": 20, "surfaces": {},
            "error_models": {"points": {"a": {"law": {"uniform": {"min": -0.002, "max": 0.002}}}}},
            "samplings": {"all": {"title": "all", "pose": {"position": position}, "free": ["roll", "pitch"],
                "error_model": "points", "observations": 32}}
        });
        let file = format!("{name}.json");
        std::fs::write(folder.path().join(&file), study.to_string()).unwrap();
        let [x, y, z] = position;
        let place = format!("--region={x}:{x}:1,{y}:{y}:1,{z}:{z}:1");
        let (results, map) = (format!("{name}-study"), format!("{name}-map"));
        for arguments in [
            &["study", "run", &file, "--out", &results][..],
            &["workspace", name, &place, "--free", "roll,pitch", "--out", &map],
        ] {
            let output = cdpr_in(folder.path(), arguments);
            assert!(output.status.success(), "{arguments:?}: {}", unwrapped(output.stderr));
        }
        let summary = json_file(folder.path().join(results).join("summary.json"));
        let spread = &summary["studies"]["all"]["magnitude_mm"]["std"];
        assert!(spread.as_f64().is_some_and(|spread| spread > 0.0), "{name}: {summary}");
        let columns = &json_file(folder.path().join(map).join("workspace.json"))["columns"];
        assert_eq!(columns["status"][0], "held", "{name}: {columns}");
    }
}

/// The robot of that name.
fn robot(name: &str) -> Robot {
    Robot::from_json(cdpr_robot::library::named(ROBOTS, name).unwrap().text).unwrap()
}

#[test]
fn stiffness_by_a_law_and_breaking_forces_that_differ_are_shown() {
    let law = answered(cdpr(&["robot", "show", "caroca-law"])).replace('\n', " ");
    assert!(law.contains(" N by youngs_modulus, ") && law.contains(" N by the elastic law"), "{law}");
    let mut robot = json_file(data("robots/caroca.json"));
    for (i, force) in [(0, json!(5000)), (1, json!(null))] {
        let mut cable = robot["cable"].clone();
        match force.is_null() {
            true => drop(cable.as_object_mut().unwrap().remove("breaking_force")),
            false => cable["breaking_force"] = force,
        }
        robot["cables"][i]["cable"] = cable;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mixed.json");
    std::fs::write(&path, robot.to_string()).unwrap();
    let shown = cdpr(&["robot", "show", path.to_str().unwrap()]);
    let shown = text(shown.stdout).replace('\n', " ");
    assert!(shown.contains("breaking force 5000 to 10290 N, that of 1 cable not known"), "{shown}");
}

#[test]
fn a_template_is_replaced_where_it_is_asked_for_and_quiet_says_its_name_alone() {
    let folder = tempfile::tempdir().unwrap();
    let new = |more: &[&str]| {
        let call = ["study", "new", "caroca", "--out", "study.json", "--payload"];
        cdpr_in(folder.path(), &[&call[..], more].concat())
    };
    assert_eq!(answered(new(&["5", "-q"])), "study.json is a study of caroca\n");
    assert_eq!(new(&["6"]).status.code(), Some(1));
    assert_eq!(json_file(folder.path().join("study.json"))["payload"], 5.0);
    assert!(answered(new(&["7", "--overwrite"])).lines().count() > 20);
    assert_eq!(json_file(folder.path().join("study.json"))["payload"], 7.0);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn warnings_are_above_notes() {
    let mut robot = json_file(data("robots/caroca.json"));
    let anchor = |i: usize| robot["cables"][i]["anchor_point"].clone();
    let [one, other] = [0, 1].map(anchor);
    (robot["cables"][0]["anchor_point"], robot["cables"][1]["anchor_point"]) = (other, one);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("exchanged.json");
    std::fs::write(&path, robot.to_string()).unwrap();
    let printed = text(cdpr(&["robot", "check", path.to_str().unwrap()]).stdout);
    let [warning, note] = ["\nwarning: ", "\nnote: "].map(|word| printed.find(word).unwrap());
    assert!(warning < note, "{printed}");
}
