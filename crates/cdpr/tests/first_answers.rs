//! The first answer of each command, without `--details`: at most 80 columns, for robots that differ.

use crate::common::{answered, cdpr, cdpr_in, data, data_path, json_file, text};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

/// Robots with a pose that each of them holds, and what its commands need.
const ROBOTS: [(&str, &str, &[&str]); 6] = [
    ("caroca", "0,0,1.75", &[]),
    ("cogiro", "0,0,2", &[]),
    ("fast", "0,0,140", &[]),
    ("ipanema-1", "0.1,0.05,1", &[]),
    ("four-cables", "0.5,0.3,2", &["--free", "roll,pitch"]),
    ("ipanema-3", "0,0,1.5", &[]),
];

/// What a command prints, which must be narrow.
fn narrow(folder: &Path, arguments: &[&str]) -> String {
    let output = cdpr_in(folder, arguments);
    let wide = |line: &&str| line.chars().count() > 80;
    let (printed, said) = (text(output.stdout), text(output.stderr));
    assert_eq!(said.lines().find(wide), None, "{arguments:?}");
    assert!(matches!(output.status.code(), Some(0 | 3)), "{arguments:?}: {said}");
    assert!(!printed.is_empty(), "{arguments:?} prints nothing");
    for line in printed.lines() {
        let columns = line.chars().count();
        assert!(columns <= 80, "{arguments:?}: {columns} columns: {line}");
    }
    printed
}

/// Asserts that a command begins with a sentence about the robot, and no table.
fn begins_with_sentence(printed: &str, name: &str) {
    let first = printed.lines().next().unwrap();
    assert!(first.starts_with(name), "{first}");
    assert!(printed.chars().take_while(|c| *c != '\u{250c}').any(|c| c == '.'), "{printed}");
}

/// A name of a hundred columns would fill the first line.
#[test]
fn a_long_name_leaves_the_first_line_to_the_answer() {
    let folder = TempDir::new().unwrap();
    let name =
        "The robot above the northern half of the hall, with the light cables of last year, as surveyed";
    for (robot, pose, free) in ROBOTS {
        let mut file = json_file(data(&format!("robots/{robot}.json")));
        file["name"] = name.into();
        std::fs::write(folder.path().join("long.json"), file.to_string()).unwrap();
        let pose = format!("--pose={pose}");
        for command in ["inverse", "stiffness", "modes", "capacity", "safety"] {
            let printed = narrow(folder.path(), &[&[command, "long.json", &pose], free].concat());
            let first = printed.lines().next().unwrap();
            assert!(first.starts_with("The robot abo") && first.contains("..."), "{command}: {printed}");
        }
        let checked = narrow(folder.path(), &["robot", "check", "long.json"]);
        let first = checked.lines().next().unwrap();
        assert!(first.contains("...") && first.ends_with('.'), "{checked}");
    }
}

#[test]
fn answers_at_a_pose_are_a_sentence_and_80_columns_wide() {
    let folder = TempDir::new().unwrap();
    for (robot, pose, free) in ROBOTS {
        let name = json_file(data(&format!("robots/{robot}.json")))["name"].as_str().unwrap().to_owned();
        let law = data_path("cables/caroca-4mm-law.json");
        for (command, more) in [
            ("inverse", &[][..]),
            ("deflection", &["--payload", "1"]),
            ("stiffness", &[]),
            ("modes", &[]),
            ("capacity", if free.is_empty() { &["--with", "tilt=2"] } else { &[] }),
            ("safety", &[]),
            ("derivatives", &["--payload", "1", "--uncertainty", "a=0.001"]),
            ("hysteresis", &["--payload", "1", "--law", &law]),
        ] {
            let pose = format!("--pose={pose}");
            let printed = narrow(folder.path(), &[&[command, robot, &pose], more, free].concat());
            begins_with_sentence(&printed, &name);
        }
    }
}

#[test]
fn answers_about_a_robot_and_its_calibration_are_80_columns_wide() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    for (robot, pose, free) in ROBOTS {
        let at = format!("--pose={pose}");
        let held = [&["inverse", robot, &at, "--format", "json"], free].concat();
        let held: Value = serde_json::from_str(&answered(cdpr_in(here, &held))).unwrap();
        let lengths: Vec<_> = held["lengths"].as_array().unwrap().iter().map(ToString::to_string).collect();
        narrow(here, &["direct", robot, "--lengths", &lengths.join(","), &at, "--with", "certificate"]);
        let name = |what: &str| format!("{robot}-{what}");
        let [x, y, z]: [f64; 3] =
            pose.split(',').map(|x| x.parse().unwrap()).collect::<Vec<_>>().try_into().unwrap();
        let around = |c: f64| format!("{}:{}:2", c - 0.02, c + 0.02);
        let region = format!("--region={},{},{z}", around(x), around(y));
        let map = name("map");
        let results = ["--with", "capacity,distances", "--wrench", "0:1,0,0,0,0,0", "--out", &map];
        narrow(here, &[&["workspace", robot, &region, "--payload", "1"], &results[..], free].concat());
        for command in [&["robot", "show"], &["robot", "check"], &["explore", "--out"]] {
            let page = name("page.html");
            let file: &[&str] = if command[0] == "explore" { &[&page, robot] } else { &[robot] };
            narrow(here, &[&command[..], file].concat());
        }
        let (plan, table, fit) = (name("plan.csv"), name("table.csv"), name("fit"));
        let known = ["--uncertainty", "a=0.001", "--noise", "position=1e-4,rotation=1e-4,length=1e-4"];
        let calibrate = |command: &[&str], more: &[&str]| {
            narrow(here, &[&["calibrate"], command, &known, more].concat());
        };
        calibrate(&["plan", robot, &region, "--number", "3", "--out", &plan], free);
        calibrate(&["identify", robot, "--poses", &plan], free);
        calibrate(&["simulate", robot, "--poses", &plan, "--seed", "1", "--out", &table], free);
        calibrate(&["fit", robot, &table, "--out", &fit], &[]);
    }
}

#[test]
fn answers_of_studies_tables_and_cables_are_80_columns_wide() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    for (robot, pose, free) in ROBOTS {
        let at = format!("--pose={pose}");
        let (study, results) = (format!("{robot}.json"), format!("{robot}-results"));
        narrow(here, &[&["study", "new", robot, &at, "--out", &study], free].concat());
        narrow(here, &["study", "run", &study, "--observations", "40", "--out", &results]);
        for command in ["status", "report"] {
            narrow(here, &["study", command, &results]);
        }
    }
    let [study, record] = ["studies/caroca.json", "cables/caroca-4mm-record.csv"].map(data_path);
    std::fs::copy(data("tables/ishigami.csv"), here.join("ishigami.csv")).unwrap();
    narrow(
        here,
        &["study", "tolerances", &study, "--sampling", "mechanical", "--limit", "deflection_mm<1.4"],
    );
    narrow(here, &["analyse", "ishigami.csv"]);
    narrow(here, &["robot", "list"]);
    let range = ["--range", "5-10", "--range", "10-30", "--breaking-force", "10290"];
    narrow(
        here,
        &[&["cable", "modulus", &record, "--length", "1", "--section", "1.2566e-5"], &range[..]].concat(),
    );
    narrow(here, &["cable", "density", "--mass", "0.203", "--length", "2"]);
    let cable = ["cable", "catenary", "weight=0.9957,stiffness=1.28e6", "--length", "4.45"];
    narrow(here, &[&cable[..], &["--end", "4.1,-1.7"]].concat());
}

#[test]
fn a_proof_is_of_the_distance_to_the_exact_equilibrium_which_residuals_do_not_state() {
    let folder = TempDir::new().unwrap();
    let held = answered(cdpr(&["inverse", "cogiro", "--pose", "0,0,2", "--format", "json"]));
    let case = folder.path().join("case.json");
    std::fs::write(&case, held).unwrap();
    let direct = ["direct", "cogiro", "--from", case.to_str().unwrap(), "--with", "certificate"];
    let found: Value =
        serde_json::from_str(&answered(cdpr(&[&direct[..], &["--format", "json"]].concat()))).unwrap();
    assert!(found["residual"]["force_n"].as_f64() < found["certificate"]["force_n"].as_f64(), "{found}");
    let said = answered(cdpr(&direct)).replace('\n', " ");
    assert!(said.contains("proved: an exact equilibrium is within "), "{said}");
    assert!(
        said.contains(" N of this one, whose residuals are what is left of the equations here;"),
        "{said}"
    );
}
