//! A robot of 10 cm with 10 g on thin cables: its numbers are not hidden; and what an answer says of robots
//! whose cables cross, are few, or have no room for a load.

use crate::common::{answered, cdpr, cdpr_in, data, data_path, json_file, text, unwrapped};
use serde_json::{Value, json};
use std::path::Path;
use tempfile::TempDir;

/// CAROCA with a seventieth of its size, thin cables of rubber and pulleys without law.
fn small(folder: &Path) -> String {
    let mut robot = json_file(data("robots/caroca.json"));
    robot["name"] = json!("Small");
    robot["platform"]["mass"] = json!(0.01);
    robot["cable"] =
        json!({"diameter": 1e-4, "section": 7.854e-9, "linear_density": 1e-5, "youngs_modulus": 1e9});
    robot["tension_limits"] = json!({"min": 0.001, "max": 1.0});
    for cable in robot["cables"].as_array_mut().unwrap() {
        for point in ["exit_point", "anchor_point"] {
            for number in cable[point].as_array_mut().unwrap() {
                *number = json!(number.as_f64().unwrap() / 70.0);
            }
        }
    }
    let path = folder.join("small.json");
    std::fs::write(&path, robot.to_string()).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Numbers of a line that are not zero, though small, have digits.
fn hides(line: &str) -> bool {
    // Zeros only, with a unit behind that is not that of a direction.
    ["0.000 N", "0.0 N", " 0.000 mm", "0.0000 mm", "0.0 mm", "0.000 kg", "0.000 m "]
        .iter()
        .any(|zero| line.contains(zero))
}

#[test]
fn numbers_of_a_small_robot_are_not_zeros() {
    let folder = TempDir::new().unwrap();
    let (here, robot) = (folder.path(), small(folder.path()));
    std::fs::write(here.join("poses.csv"), "x_m,y_m,z_m\n0,0,0.02\n0.005,0,0.025\n").unwrap();
    let at = ["--pose", "0,0,0.025"];
    let load = ["--payload", "0.001"];
    let mut pulleys = json_file(&robot);
    for cable in pulleys["cables"].as_array_mut().unwrap() {
        cable["pulley"] = json!({"radius": 0.002, "axis": [0, 0, 1]});
    }
    std::fs::write(here.join("pulleys.json"), pulleys.to_string()).unwrap();
    let friction = ["--with", "friction=0.1,bearing=0.01"];
    for arguments in [
        &[&["inverse", &robot][..], &at].concat()[..],
        &[&["deflection", &robot][..], &at, &load].concat(),
        &[&["stiffness", &robot][..], &at].concat(),
        &[&["capacity", &robot][..], &at].concat(),
        &[&["safety", &robot][..], &at].concat(),
        &[&["hysteresis", "pulleys.json"][..], &at, &load, &friction].concat(),
        &["path", &robot, "--poses", "poses.csv", "--payload", "0.001"],
        &[
            "workspace",
            &robot,
            "--region=-0.01:0.01:5,-0.01:0.01:5,0.025",
            "--payload",
            "0.001",
            "--details",
            "--with",
            "capacity,distances,boundary",
            "--out",
            "map",
        ],
    ] {
        let output = cdpr_in(here, arguments);
        let (printed, said) = (text(output.stdout), text(output.stderr));
        assert!(matches!(output.status.code(), Some(0 | 3)), "{arguments:?}: {said}");
        assert_eq!(printed.lines().chain(said.lines()).find(|line| hides(line)), None, "{arguments:?}");
    }
    let printed = |arguments: &[&str]| text(cdpr_in(here, arguments).stdout);
    let tensions = printed(&[&["inverse", &robot][..], &at].concat());
    // The tensions in the table have the digits of the sentence.
    assert!(tensions.matches(" 0.02").count() + tensions.matches(" 0.03").count() >= 16, "{tensions}");
    assert!(!tensions.contains(" 0.030 "), "{tensions}");
    let stiffness = printed(&[&["stiffness", &robot][..], &at].concat());
    let last = stiffness.lines().last().unwrap();
    assert!(
        last.split_whitespace().any(|entry| !entry.trim_matches(['-', '0', '.']).is_empty()),
        "{stiffness}"
    );
    let area = printed(&[
        "workspace",
        &robot,
        "--region=-0.01:0.01:5,-0.01:0.01:5,0.025",
        "--with",
        "boundary",
        "--out",
        "area",
    ]);
    assert!(area.contains("The region held has 0.000400") || area.contains("has 4.0000e-4 m2"), "{area}");
}

#[test]
fn cables_that_cross_are_something_wrong() {
    let folder = TempDir::new().unwrap();
    let mut robot = json_file(data("robots/caroca.json"));
    let fine = cdpr(&["capacity", "caroca", "--pose", "0,0,1.75"]);
    assert_eq!(fine.status.code(), Some(0));
    assert!(text(fine.stdout).contains("mm apart"));
    // Two cables whose anchor points are so near to the crossing that the thick cables touch.
    robot["cable"]["diameter"] = json!(0.4);
    std::fs::write(folder.path().join("thick.json"), robot.to_string()).unwrap();
    let output = cdpr_in(folder.path(), &["capacity", "thick.json", "--pose", "0,0,1.75"]);
    let printed = text(output.stdout);
    assert_eq!(output.status.code(), Some(3), "{printed}");
    assert!(
        printed.contains(" cross") && !printed.contains("-1") && !printed.contains(" apart"),
        "{printed}"
    );
    let output =
        cdpr_in(folder.path(), &["capacity", "thick.json", "--pose", "0,0,1.75", "--format", "json"]);
    let found: Value = serde_json::from_str(&text(output.stdout)).unwrap();
    assert_eq!(output.status.code(), Some(3));
    let least = |name: &str| found[name].as_f64().unwrap_or(0.0);
    assert!(least("nearest_cables_mm").min(least("nearest_to_platform_mm")) < 0.0, "{found}");
    let map = |robot| {
        let region = ["--region=0:0.1:2,0:0.1:2,1.75", "--with", "distances", "--out"];
        let folder_of_map = format!("{robot}-map");
        let output =
            cdpr_in(folder.path(), &[&["workspace", robot], &region[..], &[&folder_of_map]].concat());
        (output.status.code(), text(output.stdout).replace('\n', " "))
    };
    let (code, printed) = map("thick.json");
    let said = "At 4 of 4 positions held cables touch or cross each other or the platform, first at (0, 0, 1.750) \
                m: ";
    assert!(code == Some(3) && printed.contains(said), "{code:?} {printed}");
    let (code, printed) = map("caroca");
    assert!(code == Some(0) && !printed.contains(" cross"), "{code:?} {printed}");
}

#[test]
fn commands_without_free_coordinates_say_what_takes_them() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("poses.csv"), "x,y,z\n0.5,0.3,2\n0.4,0.2,2\n").unwrap();
    let at = ["--pose", "0.5,0.3,2", "--out"];
    // CASPR apart, what grab lacks first is a place for its pulleys.
    for robot in ["four-cables", "grab"] {
        for arguments in [
            &["path", robot, "--poses", "poses.csv"][..],
            &["path", robot, "--poses", "poses.csv", "--with", "seconds=2"],
            &[&["robot", "export", "four-cables", "--to", "mjcf"][..], &at, &["a.xml"]].concat(),
            &["robot", "export", robot, "--to", "table", "--region=0:1:2,0:1:2,2", "--out", "a.csv"],
        ] {
            let output = cdpr_in(folder.path(), arguments);
            let said = unwrapped(output.stderr);
            assert_eq!(output.status.code(), Some(1), "{arguments:?}: {said}");
            assert!(said.contains("cables or more; `cdpr inverse"), "{arguments:?}: {said}");
            assert!(!said.contains("as many names"), "{arguments:?}: {said}");
        }
    }
}

/// Tensions of least norm are at their limit before there is a load.
#[test]
fn a_map_says_why_kept_lengths_hold_nothing_with_a_least_norm() {
    let folder = TempDir::new().unwrap();
    let map = |more: &[&str]| {
        let region = ["workspace", "ipanema-1", "--region=::9,::9,1.5", "--payload", "2", "--overwrite"];
        text(cdpr_in(folder.path(), &[&region[..], &["--out", "map"], more].concat()).stdout)
    };
    let words = "with the lengths kept the load takes";
    let joined = |printed: String| printed.split_whitespace().collect::<Vec<_>>().join(" ");
    let least = joined(map(&[]));
    assert!(least.contains(words) && least.contains("--tension-reference mid"), "{least}");
    let middle = joined(map(&["--tension-reference", "mid"]));
    assert!(!middle.contains(words), "{middle}");
}

#[test]
fn a_certificate_that_is_not_tried_says_why() {
    let pose = ["--pose", "0,0,1.75"];
    let found = text(cdpr(&[&["inverse", "caroca-law", "--format", "json"][..], &pose].concat()).stdout);
    let found: Value = serde_json::from_str(&found).unwrap();
    let lengths: Vec<_> = found["lengths"].as_array().unwrap().iter().map(ToString::to_string).collect();
    let direct = ["direct", "caroca-law", "--lengths", &lengths.join(","), "--with", "certificate"];
    let output = cdpr(&[&direct[..], &pose].concat());
    let printed = text(output.stdout) + &text(output.stderr);
    let printed = printed.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(output.status.code(), Some(3), "{printed}");
    assert!(printed.contains("no box is tried") && !printed.contains("times itself"), "{printed}");
}

#[test]
fn a_point_mass_is_said_to_have_no_rotation() {
    let robot = data_path("../docs/how-to/planner/stadium.json");
    let at = ["--pose", "5,3,12"];
    let said =
        |command: &str, more: &[&str]| unwrapped(cdpr(&[&[command, &robot], &at[..], more].concat()).stdout);
    // As it is, lines of a matrix are indented.
    let stiffness = text(cdpr(&["stiffness", &robot, "--pose", "5,3,12"]).stdout);
    for absent in ["rotation", "N/rad", "its symmetric part"] {
        assert!(!stiffness.contains(absent), "{absent}: {stiffness}");
    }
    // Three rows of three numbers.
    let matrix: Vec<_> = stiffness.lines().skip_while(|line| !line.starts_with("K [N/m]:")).skip(1).collect();
    assert!(matrix.len() == 3 && matrix.iter().all(|row| row.split_whitespace().count() == 3), "{matrix:?}");
    let held = answered(cdpr(&["inverse", &robot, "--pose", "5,3,12", "--format", "json"]));
    let lengths: Value = serde_json::from_str(&held).unwrap();
    let lengths: Vec<String> =
        lengths["lengths"].as_array().unwrap().iter().map(ToString::to_string).collect();
    let direct = said("direct", &["--lengths", &lengths.join(",")]);
    assert!(direct.contains(" rests at (") && !direct.contains("roll"), "{direct}");
    let shown = unwrapped(cdpr(&["robot", "show", &robot]).stdout);
    assert!(shown.contains("3 free motions, point mass of 40 kg") && !shown.contains("inertia"), "{shown}");
    let derived = said("derivatives", &["--payload", "5", "--details"]);
    assert!(
        derived.contains(" b1.x ") && !derived.contains(" a1.x ") && !derived.contains("cog"),
        "{derived}"
    );
    let folder = TempDir::new().unwrap();
    let figure = folder.path().join("motion.svg");
    let events = data_path("events/payload-dropped.json");
    let drop = ["--payload", "60", "--events", &events, "--until", "0.1"];
    let moved = said("simulate", &[&drop[..], &["--figure", figure.to_str().unwrap()]].concat());
    assert!(moved.contains(" moves up to ") && !moved.contains(" deg "), "{moved}");
    assert!(moved.replace('\n', " ").contains("Energy: the kinetic one is at most"), "{moved}");
    let svg = std::fs::read_to_string(&figure).unwrap();
    assert!(svg.contains("from the rest [mm]") && !svg.contains("rotation"), "{svg}");
}

#[test]
fn a_stiffness_is_printed_twice_only_where_a_printed_digit_differs() {
    let said = |robot: &str, more: &[&str]| {
        unwrapped(cdpr(&[&["stiffness", robot, "--pose", "0.5,0.3,1.75"], more].concat()).stdout)
    };
    // A moment of constant components has a skew part.
    assert!(said("caroca", &["--moment", "50,0,20"]).contains("its symmetric part"));
    for robot in ["caroca", "cogiro", "ipanema-3"] {
        let said = said(robot, &[]);
        let (whole, symmetric) = said.split_once("its symmetric part").unwrap_or((&said, ""));
        let last = |text: &str| text.lines().rev().take(6).map(str::to_owned).collect::<Vec<_>>();
        assert_ne!(last(whole), last(symmetric), "{said}");
    }
}
